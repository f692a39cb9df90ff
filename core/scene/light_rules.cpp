#include "core/scene/light_rules.h"

#include <algorithm>

#include "core/scene/scene.h"

namespace pivot {

void Scene::commit_light_rules() {
    light_rules_.clear();
    for (const NamedLight& named : added_lights_)
        if (named.light) light_rules_.push_back(named.rules);
    for (const SceneTriangle& triangle : scene_triangles_)
        light_rules_.push_back({.lights = instances_[triangle.instance]->visibility & visible_to_paths,
                                .links = instances_[triangle.instance]->links});
    has_light_rules_ = std::ranges::any_of(light_rules_, [](const LightRules& rules) { return rules != LightRules{}; });
    const auto any_has = [&](const auto& what) {
        return std::ranges::any_of(light_rules_, [&](const LightRules& rules) { return what(rules.links); }) ||
               std::ranges::any_of(instances_, [&](const auto& instance) { return instance && what(instance->links); });
    };
    has_links_ = any_has([](const LightLinks& links) { return links != LightLinks{}; });
    has_blockers_ = any_has(has_blockers_of_its_own);
    if (!has_light_rules_) light_rules_.clear();
}

}  // namespace pivot
