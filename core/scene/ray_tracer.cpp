#include "core/scene/ray_tracer.h"

#include <algorithm>
#include <utility>

#include "core/scene/embree.h"
#include "core/scene/instance_bvhs.h"
#include "core/simd/pack.h"

namespace pivot {
namespace {

constexpr std::uint32_t shadow_mask = hides_light | filters_light;

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
    put(rays.near_m, packet.tnear), put(rays.far_m, packet.tfar), put(rays.time, packet.time);
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
                             InstanceBvhs::instance_of(world_id, RTCHitN_geomID(arguments->hit, arguments->N, 0)),
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
        const RayHit hit{
            RTCRayN_tfar(arguments->ray, n, i),
            InstanceBvhs::instance_of(RTCHitN_instID(arguments->hit, n, i, 0), RTCHitN_geomID(arguments->hit, n, i)),
            RTCHitN_primID(arguments->hit, n, i),
            {RTCHitN_u(arguments->hit, n, i), RTCHitN_v(arguments->hit, n, i)},
            RTCRayN_time(arguments->ray, n, i)};
        if (query->counts[lane] == (*query->most)[lane] || (*query->is_opaque)(hit.instance, hit.triangle)) continue;
        ++query->counts[lane];
        query->found->push_back({lane, hit});
        arguments->valid[i] = 0;
    }
}

/// 1 for each ray that meets none of those whom the mask sees, else 0.
Batch meet_nothing(RTCScene scene, const RayOf<Batch>& rays, std::uint32_t mask) {
    alignas(64) int valid[batch_size];
    BatchRays r;
    if (fill_packet(r, valid, rays, WordBatch(mask))) trace(occluded_batch, scene, r, valid);
    return met_nothing(r);
}

}  // namespace

RayTracer::RayTracer(std::shared_ptr<MeshBvhs> shared, bool finds_crossings)
    : bvhs_(std::make_unique<InstanceBvhs>(std::move(shared), finds_crossings)) {}

RayTracer::~RayTracer() = default;

void RayTracer::set_mesh(std::uint32_t mesh_id, std::shared_ptr<const Mesh> mesh) {
    bvhs_->set_mesh(mesh_id, std::move(mesh));
}

void RayTracer::set_instance(std::uint32_t instance_id, std::uint32_t mesh_id, const Transform& world_from_object,
                             std::uint32_t visibility) {
    bvhs_->set_instance(instance_id, mesh_id, world_from_object, visibility);
}

void RayTracer::set_instance_motion(std::uint32_t instance_id, std::shared_ptr<const MovingTransform> motion) {
    bvhs_->set_instance_motion(instance_id, std::move(motion));
}

void RayTracer::set_visibility(std::uint32_t instance_id, std::uint32_t visibility) {
    bvhs_->set_visibility(instance_id, visibility);
}

void RayTracer::remove_instance(std::uint32_t instance_id) { bvhs_->remove_instance(instance_id); }

void RayTracer::commit() { bvhs_->commit(); }

std::optional<RayHit> RayTracer::intersect(const Ray& ray, Visibility from) const {
    RTCRayHit r{};
    r.ray = to_embree(ray, from);
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    trace(rtcIntersect1, bvhs_->traced(), r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return RayHit{r.ray.tfar,
                  InstanceBvhs::instance_of(r.hit.instID[0], r.hit.geomID),
                  r.hit.primID,
                  {r.hit.u, r.hit.v},
                  ray.time};
}

bool RayTracer::occluded(const Ray& ray) const {
    RTCRay r = to_embree(ray, shadow_mask);
    trace(rtcOccluded1, bvhs_->traced(), r);
    return r.tfar < 0.0f;
}

std::array<Vec3f, 2> RayTracer::bounds() const {
    RTCBounds box;
    rtcGetSceneBounds(bvhs_->traced(), &box);
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
    rtcIntersect1(bvhs_->traced(), &r, filter_by(keep_crossing, query.context, arguments));
#else
    rtcIntersect1(bvhs_->traced(), filter_by(keep_crossing, query.context), &r);
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
        const auto visible = store(meet_nothing(bvhs_->traced(), batch, shadow_mask));
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
        intersect_coherent(bvhs_->traced(), r, valid);
    else if (any)
        trace(intersect_batch, bvhs_->traced(), r, valid);
    std::array<std::uint32_t, batch_size> instances;
    for (std::size_t i = 0; i < batch_size; ++i)
        instances[i] = InstanceBvhs::instance_of(r.hit.instID[0][i], r.hit.geomID[i]);
    return {.distance_m = Batch::load_unaligned(r.ray.tfar),
            .instance = WordBatch::load_unaligned(instances.data()),
            .triangle = WordBatch::load_unaligned(r.hit.primID),
            .barycentric = {Batch::load_unaligned(r.hit.u), Batch::load_unaligned(r.hit.v)},
            .time = rays.time};
}

Batch RayTracer::visibility(const RayOf<Batch>& rays) const { return meet_nothing(bvhs_->traced(), rays, hides_light); }

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
    occluded_batch(valid, bvhs_->traced(), &r, filter_by(keep_filtered, query.context, arguments));
#else
    occluded_batch(valid, bvhs_->traced(), filter_by(keep_filtered, query.context), &r);
#endif
    return met_nothing(r);
}

}  // namespace pivot
