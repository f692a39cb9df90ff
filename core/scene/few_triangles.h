// A handful of triangles, such as the sides of a box, which rays meet quicker one and all than by a BVH.
#pragma once

#include <vector>

#include "core/scene/ray_tracer.h"

namespace pivot {

class FewTriangles {
   public:
    static constexpr std::size_t most = 64;

    /// Counterclockwise from outside.
    void add(const Vec3f& a, const Vec3f& b, const Vec3f& c, std::uint32_t medium) {
        const std::size_t lane = media_.size() % batch_size;
        if (lane == 0) batches_.push_back({Vec3b(Batch(0.0f)), Vec3b(Batch(0.0f)), Vec3b(Batch(0.0f))});
        const auto put = [&](Vec3b& to, const Vec3f& v) {
            for (int axis = 0; axis < 3; ++axis) {
                Lanes lanes = store(to[axis]);
                lanes[lane] = v[axis];
                to[axis] = load(lanes);
            }
        };
        put(batches_.back().corner, a);
        put(batches_.back().edge_b, b - a);
        put(batches_.back().edge_c, c - a);
        media_.push_back(medium);
    }

    /// Calls visit(distance_m, medium, whether the ray enters) for each that a ray meets ahead, however far. A ray
    /// through an edge meets one of its triangles or both, never none. [Moller97]
    template <class Visit>
    void for_each_crossing(const Ray& ray, const Visit& visit) const {
        constexpr float slack = 1e-6f;
        const Vec3b origin = broadcast(ray.origin), direction = broadcast(ray.direction);
        for (std::size_t k = 0; k < batches_.size(); ++k) {
            const auto& [corner, edge_b, edge_c] = batches_[k];
            const Vec3b p = cross(direction, edge_c), from_corner = origin - corner, q = cross(from_corner, edge_b);
            const Batch determinant = dot(edge_b, p), zero(0.0f);
            const Batch inverse = Batch(1.0f) / select(determinant == zero, Batch(1.0f), determinant);
            const Batch b = dot(from_corner, p) * inverse, c = dot(direction, q) * inverse;
            const Batch distance_m = dot(edge_c, q) * inverse;
            const BatchMask is_met = determinant != zero && distance_m < Batch(1e30f) && b >= Batch(-slack) &&
                                     c >= Batch(-slack) && b + c <= Batch(1.0f + slack) && distance_m > zero;
            if (!any(is_met)) continue;
            const auto met = store(is_met);
            const Lanes distances = store(distance_m), sides = store(determinant);
            for (std::size_t lane = 0; lane < batch_size && k * batch_size + lane < media_.size(); ++lane)
                if (met[lane]) visit(distances[lane], media_[k * batch_size + lane], sides[lane] > 0.0f);
        }
    }

   private:
    struct Triangles {
        Vec3b corner, edge_b, edge_c;
    };
    std::vector<Triangles> batches_;
    std::vector<std::uint32_t> media_;
};

}  // namespace pivot
