// Which media a ray crosses, and where. The world's is everywhere; another fills what the faces of its material
// surround. Where several overlap they add.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/scene/few_triangles.h"
#include "core/scene/instance.h"
#include "core/scene/ray_tracer.h"
#include "core/shaders/shader.h"

namespace pivot {

/// A medium where it stands.
struct PlacedMedium {
    std::shared_ptr<const Medium> medium;
    Transform object_from_world;                 ///< to the space that its grids are placed in
    Vec3f low, high;                             ///< of world space, around it
    Rgb sigma_s, sigma_t;                        ///< the medium's, 1/m, where its density is 1
    std::optional<std::array<Vec3f, 2>> box;     ///< of object space, corners of what it fills where that is a box
    std::uint32_t light_group = no_light_group;  ///< of what it emits
    LinkSets link_sets{};                        ///< by which lights find it

    bool varies() const { return !medium->is_homogeneous(); }
};

/// A part of a ray in which the media are the same.
struct MediumInterval {
    float near_m, far_m;
    std::uint32_t first, count;  ///< places in MediaAlong::active
};

/// What a ray crosses, in order; and room to find it with, for rays to come.
struct MediaAlong {
    std::vector<MediumInterval> intervals;
    std::vector<std::uint32_t> active;  ///< ids of placed media
    std::vector<Crossing> crossings;
    struct Passage {
        float distance_m;
        std::uint32_t medium;
        bool enters;  ///< or leaves
    };
    std::vector<Passage> passages;
    std::vector<std::uint8_t> is_inside;  ///< of each medium that is passed

    std::span<const std::uint32_t> active_in(const MediumInterval& interval) const {
        return std::span(active).subspan(interval.first, interval.count);
    }
};

class Media {
   public:
    Media(const std::shared_ptr<const Medium>& world, std::uint32_t world_light_group,
          std::span<const std::shared_ptr<const Mesh>> meshes, std::span<const std::optional<Instance>> instances,
          std::span<const Shader> shaders);

    /// No media at all: rays need not ask.
    bool is_empty() const { return placed_.empty(); }
    std::uint32_t count() const { return static_cast<std::uint32_t>(placed_.size()); }
    const PlacedMedium& at(std::uint32_t id) const { return placed_[id]; }

    /// Whether all media are even, and fill boxes or all space.
    bool are_even_boxes() const { return are_even_boxes_; }

    /// The media between a ray's origin and its far_m. A ray starts within what it leaves first.
    void find_along(const Ray& ray, MediaAlong& along) const;

   private:
    struct Boundary {
        const Mesh* mesh;
        const Instance* instance;
        std::vector<std::uint32_t> medium_of_slot;  ///< ids; none: no_medium
    };
    static constexpr std::uint32_t no_medium = ~0u;

    void find_passages(const Ray& ray, MediaAlong& along) const;
    /// No ray stays within what it leaves by an edge that rounding missed, or by a hole: it leaves with the box around.
    void leave_boxes(const Ray& ray, MediaAlong& along) const;
    std::uint32_t medium_of(const Boundary& boundary, std::uint32_t triangle) const;

    std::vector<PlacedMedium> placed_;  ///< the world's comes first
    bool has_world_ = false, are_even_boxes_ = false;
    std::vector<Boundary> boundaries_;
    FewTriangles few_triangles_;         ///< all boundaries, where they are few
    std::unique_ptr<RayTracer> tracer_;  ///< of the boundaries, where they are many
};

}  // namespace pivot
