#include "core/scene/ray_tracer.h"

#include <algorithm>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include "core/scene/embree.h"
#include "core/simd/pack.h"

namespace pivot {
namespace {

constexpr std::uint32_t still_id = 0;
constexpr std::uint32_t shadow_mask = hides_light | filters_light;
/// So many triangles of meshes with several instances are traced as if each were a mesh of its own: some 50 MB.
constexpr std::size_t max_copied_triangles = 1u << 19;
/// Where meshes have shared BVHs, so many triangles of small ones are put into one BVH anew for each scene: some 5 ms.
constexpr std::size_t max_rebuilt_triangles = 1u << 15;

/// The instance that a hit's ids name; no_instance where nothing was hit.
std::uint32_t instance_of(std::uint32_t world_id, std::uint32_t geometry_id) {
    return world_id == still_id || world_id == no_instance ? geometry_id : world_id - 1;
}

#ifdef __AVX2__
using BatchRays = RTCRay8;
using BatchHits = RTCRayHit8;
constexpr auto intersect_batch = rtcIntersect8;
constexpr auto occluded_batch = rtcOccluded8;
#else
using BatchRays = RTCRay4;
using BatchHits = RTCRayHit4;
constexpr auto intersect_batch = rtcIntersect4;
constexpr auto occluded_batch = rtcOccluded4;
#endif
static_assert(std::extent_v<decltype(BatchRays::tfar)> == batch_size && no_instance == RTC_INVALID_GEOMETRY_ID);

/// For rays of one origin and about one direction: they go down the BVH together, not one by one.
void intersect_coherent(RTCScene scene, BatchHits& hits, const int* valid) {
#if RTC_VERSION_MAJOR >= 4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    intersect_batch(valid, scene, &hits, &arguments);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    intersect_batch(valid, scene, &context, &hits);
#endif
}

/// Fills a packet with a batch; `valid` is -1 for lanes that are rays, else 0. Returns whether any is.
bool fill_packet(BatchRays& packet, int* valid, const RayOf<Batch>& rays, const WordBatch& mask) {
    const auto put = [](const Batch& from, float* to) { from.store_unaligned(to); };
    put(rays.origin.x, packet.org_x), put(rays.origin.y, packet.org_y), put(rays.origin.z, packet.org_z);
    put(rays.direction.x, packet.dir_x), put(rays.direction.y, packet.dir_y), put(rays.direction.z, packet.dir_z);
    put(rays.near_m, packet.tnear), put(rays.far_m, packet.tfar), put(Batch(0.0f), packet.time);
    bool any = false;
    for (std::size_t i = 0; i < batch_size; ++i) {
        valid[i] = packet.tfar[i] > 0.0f ? -1 : 0;
        any = any || valid[i];
        packet.flags[i] = 0;
    }
    mask.store_unaligned(packet.mask);
    return any;
}

/// Of rays that were asked whether they are occluded: 1 for each that is not, else 0.
Batch met_nothing(const BatchRays& rays) {
    return select(Batch::load_unaligned(rays.tfar) > Batch(0.0f), Batch(1.0f), Batch(0.0f));
}

/// Calls visit(first, count, RayOf<Batch>) with so many rays from `first` on, in as many lanes.
template <class Visit>
void for_each_batch(std::span<const Ray> rays, const Visit& visit) {
    constexpr Ray no_ray{.origin = Vec3f(0.0f), .direction = Vec3f(0.0f), .near_m = 0.0f, .far_m = 0.0f};
    for (std::size_t first = 0; first < rays.size(); first += batch_size) {
        const std::size_t count = std::min(batch_size, rays.size() - first);
        std::array<const Ray*, batch_size> lanes;
        for (std::size_t i = 0; i < batch_size; ++i) lanes[i] = i < count ? &rays[first + i] : &no_ray;
        visit(first, count, pack<RayOf>(lanes));
    }
}

// Has Embree ask a callback of each hit; it hands the context back to it.
#if RTC_VERSION_MAJOR >= 4
using Context = RTCRayQueryContext;

template <class Arguments>
Arguments* filter_by(RTCFilterFunctionN filter, Context& context, Arguments& arguments) {
    rtcInitRayQueryContext(&context);
    arguments.flags = static_cast<RTCRayQueryFlags>(arguments.flags | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
    arguments.filter = filter;
    arguments.context = &context;
    return &arguments;
}
#else
using Context = RTCIntersectContext;

Context* filter_by(RTCFilterFunctionN filter, Context& context) {
    rtcInitIntersectContext(&context);
    context.filter = filter;
    return &context;
}
#endif

/// What keep_crossing needs beside a hit.
struct CrossingQuery {
    Context context;
    std::vector<Crossing>* found;
};

/// Keeps a hit and has Embree look on behind it.
void keep_crossing(const RTCFilterFunctionNArguments* arguments) {
    auto* query = reinterpret_cast<CrossingQuery*>(arguments->context);
    const std::uint32_t world_id = RTCHitN_instID(arguments->hit, arguments->N, 0, 0);
    query->found->push_back({RTCRayN_tfar(arguments->ray, arguments->N, 0),
                             instance_of(world_id, RTCHitN_geomID(arguments->hit, arguments->N, 0)),
                             RTCHitN_primID(arguments->hit, arguments->N, 0)});
    arguments->valid[0] = 0;
}

/// What keep_filtered needs beside a hit, likewise.
struct FilterQuery {
    Context context;
    const std::array<std::uint32_t, batch_size>* most;
    const RayTracer::IsOpaque* is_opaque;
    std::vector<RayTracer::Filtered>* found;
    std::array<std::uint32_t, batch_size> counts{};
};

/// Keeps what a shadow ray passes and has Embree look on, until something hides the light.
void keep_filtered(const RTCFilterFunctionNArguments* arguments) {
    auto* query = reinterpret_cast<FilterQuery*>(arguments->context);
    const unsigned n = arguments->N;
    for (unsigned i = 0; i < n; ++i) {
        if (arguments->valid[i] == 0) continue;
        const std::size_t lane = RTCRayN_id(arguments->ray, n, i);
        const RayHit hit{RTCRayN_tfar(arguments->ray, n, i),
                         instance_of(RTCHitN_instID(arguments->hit, n, i, 0), RTCHitN_geomID(arguments->hit, n, i)),
                         RTCHitN_primID(arguments->hit, n, i),
                         {RTCHitN_u(arguments->hit, n, i), RTCHitN_v(arguments->hit, n, i)}};
        if (query->counts[lane] == (*query->most)[lane] || (*query->is_opaque)(hit.instance, hit.triangle)) continue;
        ++query->counts[lane];
        query->found->push_back({lane, hit});
        arguments->valid[i] = 0;
    }
}

void set_transform(RTCGeometry geometry, const Transform& transform) {
    const Mat3<float>& m = transform.linear;
    const Vec3f& t = transform.translation;
    const float columns[12] = {m[0].x, m[0].y, m[0].z, m[1].x, m[1].y, m[1].z, m[2].x, m[2].y, m[2].z, t.x, t.y, t.z};
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
}

}  // namespace

struct RayTracer::Implementation {
    enum class Side { none, still, moving };
    struct Placed {
        std::uint32_t mesh;
        Transform world_from_object;
        std::uint32_t visibility;
        bool has_moved;
        Side side = Side::none;             ///< where it is attached; commit() does that: adding is quick
        std::size_t copied_triangles = 0;   ///< of what is still and has copies
        std::vector<Vec3f> positions = {};  ///< of the mesh in world space, of what is still
    };

    bool finds_crossings;
    std::shared_ptr<MeshBvhs> shared;  ///< none: it has its own
    bool filters = false;              ///< whether rays stop at what a callback says
    std::shared_ptr<const EmbreeDevice> device;
    Owned<RTCScene> world;  ///< still_id is the still scene; id + 1 an instance that is traced in its own space
    Owned<RTCScene> still;  ///< instances in world space: one BVH, and no transforms on the way
    Owned<RTCGeometry> still_in_world;
    std::unordered_map<std::uint32_t, std::shared_ptr<const Mesh>> meshes;
    std::unordered_map<std::uint32_t, std::shared_ptr<const MeshBvh>> mesh_bvhs;  ///< of those that instances need
    std::map<std::uint32_t, Placed> placed;
    std::size_t copied_triangles = 0, moving_count = 0;
    bool still_changed = true, changed = true;

    /// What rays are traced in: where nothing moves, the still scene needs no other around it.
    RTCScene traced() const { return moving_count > 0 ? world.get() : still.get(); }

    Owned<RTCGeometry> make_instance(RTCScene scene, const Transform& world_from_object) const {
        Owned<RTCGeometry> geometry(rtcNewGeometry(device->handle.get(), RTC_GEOMETRY_TYPE_INSTANCE));
        rtcSetGeometryInstancedScene(geometry.get(), scene);
        set_transform(geometry.get(), world_from_object);
        return geometry;
    }

    RTCScene scene_of_mesh(std::uint32_t mesh_id) {
        std::shared_ptr<const MeshBvh>& bvh = mesh_bvhs[mesh_id];
        if (!bvh) {
            const auto& mesh = meshes.at(mesh_id);
            bvh = shared ? shared->bvh_of(mesh, filters) : std::make_shared<const MeshBvh>(*device, *mesh, filters);
        }
        return bvh->scene.get();
    }

    void attach_still(std::uint32_t id, Placed& instance) {
        const Mesh& mesh = *meshes.at(instance.mesh);
        instance.positions.reserve(mesh.positions.size());
        for (const Vec3f& p : mesh.positions) instance.positions.push_back(instance.world_from_object.point(p));
        const auto geometry = device->make_triangles(mesh, instance.positions);
        rtcSetGeometryMask(geometry.get(), instance.visibility);
        rtcCommitGeometry(geometry.get());
        rtcAttachGeometryByID(still.get(), geometry.get(), id);
        instance.side = Side::still;
        still_changed = true;
    }

    void attach_moving(std::uint32_t id, Placed& instance) {
        const Owned<RTCGeometry> geometry = make_instance(scene_of_mesh(instance.mesh), instance.world_from_object);
        rtcSetGeometryMask(geometry.get(), instance.visibility);
        rtcCommitGeometry(geometry.get());
        rtcAttachGeometryByID(world.get(), geometry.get(), id + 1);
        instance.side = Side::moving;
        ++moving_count;
    }

    void detach(std::uint32_t id, Placed& instance) {
        if (instance.side == Side::still) {
            rtcDetachGeometry(still.get(), id);
            copied_triangles -= std::exchange(instance.copied_triangles, 0);
            instance.positions = {};
            still_changed = true;
        } else if (instance.side == Side::moving) {
            rtcDetachGeometry(world.get(), id + 1);
            --moving_count;
        }
        instance.side = Side::none;
    }

    /// BVHs know when they are built whether callbacks filter hits, which costs where none does.
    void set_filters() {
        const auto is_filter = [](const auto& entry) { return (entry.second.visibility & filters_light) != 0; };
        const bool wanted = finds_crossings || std::ranges::any_of(placed, is_filter);
        if (std::exchange(filters, wanted) == wanted) return;
        for (auto& [id, instance] : placed) detach(id, instance);
        mesh_bvhs.clear();
        changed = still_changed = true;
    }

    std::size_t still_triangles() const {
        std::size_t count = 0;
        for (const auto& [id, instance] : placed) {
            if (instance.side == Side::still) count += meshes.at(instance.mesh)->triangles.size();
        }
        return count;
    }

    /// 1 for each ray that meets none of those whom the mask sees, else 0.
    Batch meet_nothing(const RayOf<Batch>& rays, std::uint32_t mask) const {
        alignas(64) int valid[batch_size];
        BatchRays r;
        if (fill_packet(r, valid, rays, WordBatch(mask))) trace(occluded_batch, traced(), r, valid);
        return met_nothing(r);
    }

    void attach_all() {
        std::unordered_map<std::uint32_t, std::size_t> uses;
        for (const auto& [id, instance] : placed) ++uses[instance.mesh];
        for (auto& [id, instance] : placed) {
            if (instance.side != Side::none) continue;
            const std::size_t copied =
                shared || uses[instance.mesh] > 1 ? meshes.at(instance.mesh)->triangles.size() : 0;
            const bool has_room = copied_triangles + copied <= (shared ? max_rebuilt_triangles : max_copied_triangles);
            // What is scaled flat has no space of its own to be traced in.
            if (!instance.world_from_object.is_invertible() || (!instance.has_moved && has_room)) {
                attach_still(id, instance);
                copied_triangles += instance.copied_triangles = copied;
            } else {
                attach_moving(id, instance);
            }
        }
    }
};

RayTracer::RayTracer(std::shared_ptr<MeshBvhs> shared, bool finds_crossings)
    : implementation_(std::make_unique<Implementation>()) {
    auto& self = *implementation_;
    self.finds_crossings = finds_crossings;
    self.device = shared ? shared->device() : std::make_shared<const EmbreeDevice>();
    self.shared = std::move(shared);
    self.world = self.device->make_scene();
    self.still = self.device->make_scene();
    self.still_in_world = self.make_instance(self.still.get(), {});
    rtcSetGeometryMask(self.still_in_world.get(), ~0u);
    rtcAttachGeometryByID(self.world.get(), self.still_in_world.get(), still_id);
    self.device->check();
}

RayTracer::~RayTracer() = default;

void RayTracer::set_mesh(std::uint32_t mesh_id, std::shared_ptr<const Mesh> mesh) {
    implementation_->meshes[mesh_id] = std::move(mesh);
}

void RayTracer::set_instance(std::uint32_t instance_id, std::uint32_t mesh_id, const Transform& world_from_object,
                             std::uint32_t visibility) {
    auto& self = *implementation_;
    const bool was_placed = self.placed.contains(instance_id);
    remove_instance(instance_id);
    self.placed[instance_id] = {mesh_id, world_from_object, visibility, was_placed};
    self.changed = true;
}

void RayTracer::set_visibility(std::uint32_t instance_id, std::uint32_t visibility) {
    auto& self = *implementation_;
    Implementation::Placed& instance = self.placed.at(instance_id);
    if (std::exchange(instance.visibility, visibility) == visibility) return;
    if (instance.side == Implementation::Side::none) return;
    const bool is_still = instance.side == Implementation::Side::still;
    const RTCGeometry geometry =
        rtcGetGeometry(is_still ? self.still.get() : self.world.get(), is_still ? instance_id : instance_id + 1);
    // Embree reads masks as it traces: no BVH holds them, and none is committed for them.
    rtcSetGeometryMask(geometry, visibility);
    rtcCommitGeometry(geometry);
    self.device->check();
}

void RayTracer::remove_instance(std::uint32_t instance_id) {
    auto& self = *implementation_;
    const auto found = self.placed.find(instance_id);
    if (found == self.placed.end()) return;
    self.detach(instance_id, found->second);
    self.placed.erase(found);
    self.device->check();
    self.changed = true;
}

void RayTracer::commit() {
    auto& self = *implementation_;
    self.set_filters();
    if (!self.changed) return;
    self.attach_all();
    if (self.still_changed) {
        self.device->build(self.still.get(), self.still_triangles(), self.filters);
        rtcCommitGeometry(self.still_in_world.get());
    }
    self.device->build(self.world.get(), 0, self.filters);
    self.device->check();
    self.changed = self.still_changed = false;
}

std::optional<RayHit> RayTracer::intersect(const Ray& ray, Visibility from) const {
    RTCRayHit r{};
    r.ray = to_embree(ray, from);
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    trace(rtcIntersect1, implementation_->traced(), r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return RayHit{r.ray.tfar, instance_of(r.hit.instID[0], r.hit.geomID), r.hit.primID, {r.hit.u, r.hit.v}};
}

bool RayTracer::occluded(const Ray& ray) const {
    RTCRay r = to_embree(ray, shadow_mask);
    trace(rtcOccluded1, implementation_->traced(), r);
    return r.tfar < 0.0f;
}

std::array<Vec3f, 2> RayTracer::bounds() const {
    RTCBounds box;
    rtcGetSceneBounds(implementation_->traced(), &box);
    return {Vec3f(box.lower_x, box.lower_y, box.lower_z), Vec3f(box.upper_x, box.upper_y, box.upper_z)};
}

void RayTracer::crossings(const Ray& ray, std::vector<Crossing>& found) const {
    RTCRayHit r{};
    r.ray = to_embree(ray, ~0u);
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    CrossingQuery query{{}, &found};
#if RTC_VERSION_MAJOR >= 4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    rtcIntersect1(implementation_->traced(), &r, filter_by(keep_crossing, query.context, arguments));
#else
    rtcIntersect1(implementation_->traced(), filter_by(keep_crossing, query.context), &r);
#endif
}

void RayTracer::intersect(std::span<const Ray> rays, Visibility from, std::span<std::optional<RayHit>> hits) const {
    const std::vector<std::uint32_t> each(rays.size(), from);
    intersect(rays, each, hits);
}

void RayTracer::intersect(std::span<const Ray> rays, std::span<const std::uint32_t> from,
                          std::span<std::optional<RayHit>> hits) const {
    for_each_batch(rays, [&](std::size_t first, std::size_t count, const RayOf<Batch>& batch) {
        std::array<std::uint32_t, batch_size> masks;
        for (std::size_t i = 0; i < batch_size; ++i) masks[i] = from[std::min(first + i, rays.size() - 1)];
        const std::array<RayHit, batch_size> met =
            unpack<RayHitOf>(intersect(batch, WordBatch::load_unaligned(masks.data())));
        for (std::size_t i = 0; i < count; ++i)
            hits[first + i] = met[i].instance == no_instance ? std::nullopt : std::optional(met[i]);
    });
}

void RayTracer::occluded(std::span<const Ray> rays, std::span<std::uint8_t> occluded_rays) const {
    for_each_batch(rays, [&](std::size_t first, std::size_t count, const RayOf<Batch>& batch) {
        const auto visible = store(implementation_->meet_nothing(batch, shadow_mask));
        for (std::size_t i = 0; i < count; ++i) occluded_rays[first + i] = visible[i] > 0.0f ? 0 : 1;
    });
}

RayHitOf<Batch> RayTracer::intersect(const RayOf<Batch>& rays, const WordBatch& from) const {
    alignas(64) int valid[batch_size];
    BatchHits r;
    const bool any = fill_packet(r.ray, valid, rays, from);
    for (std::size_t i = 0; i < batch_size; ++i) {
        r.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        r.hit.instID[0][i] = no_instance;
    }
    if (any && xsimd::all(from == WordBatch(visible_to_camera)))
        intersect_coherent(implementation_->traced(), r, valid);
    else if (any)
        trace(intersect_batch, implementation_->traced(), r, valid);
    std::array<std::uint32_t, batch_size> instances;
    for (std::size_t i = 0; i < batch_size; ++i) instances[i] = instance_of(r.hit.instID[0][i], r.hit.geomID[i]);
    return {.distance_m = Batch::load_unaligned(r.ray.tfar),
            .instance = WordBatch::load_unaligned(instances.data()),
            .triangle = WordBatch::load_unaligned(r.hit.primID),
            .barycentric = {Batch::load_unaligned(r.hit.u), Batch::load_unaligned(r.hit.v)}};
}

Batch RayTracer::visibility(const RayOf<Batch>& rays) const { return implementation_->meet_nothing(rays, hides_light); }

Batch RayTracer::filtered(const RayOf<Batch>& rays, const std::array<std::uint32_t, batch_size>& most,
                          const IsOpaque& is_opaque, std::vector<Filtered>& found) const {
    alignas(64) int valid[batch_size];
    BatchRays r;
    if (!fill_packet(r, valid, rays, WordBatch(filters_light))) return Batch(0.0f);
    for (std::size_t i = 0; i < batch_size; ++i) r.id[i] = static_cast<unsigned>(i);
    FilterQuery query{{}, &most, &is_opaque, &found};
#if RTC_VERSION_MAJOR >= 4
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    occluded_batch(valid, implementation_->traced(), &r, filter_by(keep_filtered, query.context, arguments));
#else
    occluded_batch(valid, implementation_->traced(), filter_by(keep_filtered, query.context), &r);
#endif
    return met_nothing(r);
}

}  // namespace pivot
