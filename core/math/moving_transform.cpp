#include "core/math/moving_transform.h"

#include <glm/gtc/quaternion.hpp>

namespace pivot {
namespace {

/// Where a turn between two steps is so small, points that move on its chord are off their circle by 1 / 26000 of its
/// radius at most.
constexpr float max_turn_rad = 0.0175f;

/// A linear map as a rotation after a stretch, which may mirror.
struct Turned {
    glm::quat rotation;
    Mat3<float> stretch;
};

/// [Shoemake92] By averaging a map with its inverse's transpose until it is orthogonal. Of an invertible one.
Turned polar_parts(const Mat3<float>& linear) {
    Mat3<float> rotation = linear;
    for (int i = 0; i < 100; ++i) {
        const Mat3<float> next = 0.5f * (rotation + glm::transpose(glm::inverse(rotation)));
        float change = 0.0f;
        for (int axis = 0; axis < 3; ++axis) change += length_squared(next[axis] - rotation[axis]);
        rotation = next;
        if (change < 1e-12f) break;
    }
    if (glm::determinant(rotation) < 0.0f) rotation = -rotation;
    return {glm::normalize(glm::quat_cast(rotation)), glm::transpose(rotation) * linear};
}

float angle_rad(const glm::quat& a, const glm::quat& b) {
    const glm::quat turn = b * glm::conjugate(a);
    return 2.0f * std::atan2(length(Vec3f(turn.x, turn.y, turn.z)), std::abs(turn.w));
}

}  // namespace

MovingTransform::MovingTransform(std::span<const Transform> steps) {
    const std::size_t segments = steps.size() - 1;
    std::vector<Turned> turned;
    float turn_rad = 0.0f;
    for (const Transform& step : steps) {
        if (!step.is_invertible()) break;
        turned.push_back(polar_parts(step.linear));
        if (turned.size() > 1)
            turn_rad = std::max(turn_rad, angle_rad(turned[turned.size() - 2].rotation, turned.back().rotation));
    }
    std::size_t parts = 1;
    // What is flat at some time does not turn by itself.
    if (turned.size() == steps.size())
        while (turn_rad > max_turn_rad * static_cast<float>(parts) && 2 * parts * segments < max_steps) parts *= 2;
    for (std::size_t i = 0; i < segments; ++i) {
        steps_.push_back(steps[i]);
        for (std::size_t k = 1; k < parts; ++k) {
            const float t = static_cast<float>(k) / static_cast<float>(parts);
            const Mat3<float> stretch = turned[i].stretch + t * (turned[i + 1].stretch - turned[i].stretch);
            steps_.push_back({glm::mat3_cast(glm::slerp(turned[i].rotation, turned[i + 1].rotation, t)) * stretch,
                              steps[i].translation + t * (steps[i + 1].translation - steps[i].translation)});
        }
    }
    steps_.push_back(steps.back());
}

Transform MovingTransform::at(float time) const {
    const BetweenSteps between(time, steps_.size());
    const Transform &a = steps_[between.first], &b = steps_[between.first + 1];
    return {between.of(a.linear, b.linear), between.of(a.translation, b.translation)};
}

}  // namespace pivot
