#include "core/shaders/lamp_mean.h"

#include "core/shaders/lamp.h"

namespace pivot {
namespace {

constexpr std::uint32_t sides = 64;

/// Evenly spread over the sphere. [Fibonacci spiral]
Vec3f side(std::uint32_t k) {
    const float z = 1.0f - (2.0f * static_cast<float>(k) + 1.0f) / sides, r = std::sqrt(1.0f - z * z);
    const float turn = 2.399963f * static_cast<float>(k);
    return {r * std::cos(turn), r * std::sin(turn), z};
}

Vec3f middle(const SphereLight& sphere) { return sphere.center; }
Vec3f middle(const SpotLight& spot) { return spot.sphere.center; }
Vec3f middle(const SunLight&) { return Vec3f(0.0f); }
Vec3f middle(const AreaLight& area) { return area.center; }

float distance_m(const SphereLight& sphere) { return std::max(3.0f * sphere.radius_m, 1.0f); }
float distance_m(const SpotLight& spot) { return distance_m(spot.sphere); }
float distance_m(const SunLight&) { return 0.0f; }
float distance_m(const AreaLight& area) { return std::max(3.0f * std::sqrt(area.area_m2), 1.0f); }

}  // namespace

float mean_lamp_share(const Shader& shader, const Light& light) {
    shader.program.make_image_levels();
    const CameraFacts nobody;
    Registers registers;
    float sum = 0.0f, weights = 0.0f;
    const auto [centre, away_m] =
        std::visit([](const auto& kind) { return std::pair(middle(kind), distance_m(kind)); }, light);
    for (std::uint32_t k = 0; k < sides; ++k) {
        const Vec3f from = centre + away_m * side(k);
        const Vec2f u((static_cast<float>(k) + 0.5f) / sides, std::fmod(0.618034f * static_cast<float>(k), 1.0f));
        const auto place = sample_light(light, from, u);
        if (!place) continue;
        const float weight = mean_component(abs(place->radiance));
        if (!(weight > 0.0f)) continue;
        sum += weight * mean_component(abs(lamp_share({shader, nobody}, light, from, place->wi, 1, registers)));
        weights += weight;
    }
    return weights > 0.0f && std::isfinite(sum) ? sum / weights : 0.0f;
}

}  // namespace pivot
