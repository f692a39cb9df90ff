#include <algorithm>

#include "core/scene/scene.h"

namespace pivot {

bool Scene::has_shadow_catchers() const {
    return std::ranges::any_of(instances_,
                               [](const auto& instance) { return instance && instance->is_shadow_catcher; });
}

std::shared_ptr<Scene> Scene::only_shadow_catchers() const {
    auto scene = shared_ ? std::make_shared<Scene>(shared_) : std::make_shared<Scene>();
    scene->attribute_names_ = attribute_names_;
    for (const auto& mesh : meshes_) scene->add_mesh(mesh);
    scene->shaders_ = shaders_;
    for (const auto& instance : instances_)
        if (instance && instance->is_shadow_catcher)
            scene->add_instances(*instance, {&instance->world_from_object, 1}, {&instance->facts, 1});
    for (const NamedLight& named : added_lights_)
        if (named.light) scene->add_light(named.name, *named.light, named.rules, named.group, named.shader);
    scene->world_ = world_;
    scene->environment_ = environment_;
    scene->world_rules_ = world_rules_;
    scene->set_camera(camera_);
    return scene;
}

}  // namespace pivot
