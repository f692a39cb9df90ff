// Preloaded into a render: keeps the rays that it asks Embree for, and traces them again with nothing around them.
// Compiled and called by monte_carlo_rays.py; for renders in one thread that trace single rays or packets of eight.
#if __has_include(<embree3/rtcore.h>)
#include <embree3/rtcore.h>
#define EMBREE "libembree3.so.3"
#define RAYS(Type) RTCIntersectContext *context, Type *rays
#define GIVEN context, rays
#else
#include <embree4/rtcore.h>
#define EMBREE "libembree4.so.4"
#define RAYS(Type) Type *rays, RTCIntersectArguments *arguments
#define GIVEN rays, arguments
#endif

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <ctime>
#include <vector>

namespace {

constexpr std::size_t width = 8;

struct Call {
    bool is_occlusion, is_single;
    std::uint32_t count;  ///< of rays; they follow those of the call before
};

struct Log {
    bool is_on = false;
    RTCScene scene = nullptr;
    std::vector<Call> calls;
    std::vector<RTCRay> rays;
} seen;

/// Embree's own, which the render has loaded.
template <class Function>
Function* embree(Function*, const char* name) {
    static void* const library = dlopen(EMBREE, RTLD_NOW | RTLD_NOLOAD);
    return reinterpret_cast<Function*>(dlsym(library, name));
}
#define REAL(name)                                         \
    [] {                                                   \
        static const auto function = embree(&name, #name); \
        return function;                                   \
    }()

struct Packet {
    bool is_occlusion;
    alignas(32) std::array<int, width> valid;
    RTCRay8 rays;
};

void set_lane(Packet& packet, std::size_t i, const RTCRay& r) {
    packet.valid[i] = -1;
    RTCRay8& p = packet.rays;
    p.org_x[i] = r.org_x, p.org_y[i] = r.org_y, p.org_z[i] = r.org_z;
    p.dir_x[i] = r.dir_x, p.dir_y[i] = r.dir_y, p.dir_z[i] = r.dir_z;
    p.tnear[i] = r.tnear, p.tfar[i] = r.tfar, p.time[i] = r.time;
    p.mask[i] = r.mask, p.id[i] = r.id, p.flags[i] = r.flags;
}

RTCRay lane(const RTCRay8& packet, std::size_t i) {
    RTCRay r;
    r.org_x = packet.org_x[i], r.org_y = packet.org_y[i], r.org_z = packet.org_z[i];
    r.dir_x = packet.dir_x[i], r.dir_y = packet.dir_y[i], r.dir_z = packet.dir_z[i];
    r.tnear = packet.tnear[i], r.tfar = packet.tfar[i], r.time = packet.time[i];
    r.mask = packet.mask[i], r.id = packet.id[i], r.flags = packet.flags[i];
    return r;
}

void log_packet(const int* valid, RTCScene scene, const RTCRay8& packet, bool is_occlusion) {
    if (!seen.is_on) return;
    seen.scene = scene;
    const std::size_t before = seen.rays.size();
    for (std::size_t i = 0; i < width; ++i) {
        if (valid[i]) seen.rays.push_back(lane(packet, i));
    }
    seen.calls.push_back({is_occlusion, false, static_cast<std::uint32_t>(seen.rays.size() - before)});
}

void log_ray(RTCScene scene, const RTCRay& ray, bool is_occlusion) {
    if (!seen.is_on) return;
    seen.scene = scene;
    seen.rays.push_back(ray);
    seen.calls.push_back({is_occlusion, true, 1});
}

/// The rays as they were traced in packets, without those that were traced alone.
std::vector<Packet> packets_as_traced() {
    std::vector<Packet> packets;
    const RTCRay* ray = seen.rays.data();
    for (const Call& call : seen.calls) {
        if (!call.is_single) packets.push_back({.is_occlusion = call.is_occlusion, .valid = {}, .rays = {}});
        for (std::size_t k = 0; k < call.count; ++k, ++ray) {
            if (!call.is_single) set_lane(packets.back(), k, *ray);
        }
    }
    return packets;
}

/// All rays in the same order, but in full packets.
std::vector<Packet> full_packets() {
    std::vector<Packet> packets;
    struct Place {
        std::size_t packet = 0, lane = width;
    };
    std::array<Place, 2> next;  // of each kind; its packet is full
    const RTCRay* ray = seen.rays.data();
    for (const Call& call : seen.calls) {
        Place& place = next[call.is_occlusion];
        for (std::size_t k = 0; k < call.count; ++k) {
            if (place.lane == width) {
                place = {packets.size(), 0};
                packets.push_back({.is_occlusion = call.is_occlusion, .valid = {}, .rays = {}});
            }
            set_lane(packets[place.packet], place.lane++, *ray++);
        }
    }
    return packets;
}

void set_unhit(RTCRayHit& r) { r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID; }
void set_unhit(RTCRayHit8& r) {
    std::fill_n(r.hit.geomID, width, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(r.hit.instID[0], width, RTC_INVALID_GEOMETRY_ID);
}

/// One of Embree's two questions; valid: of packets.
template <class Hit, class Intersect, class Occluded, class... Valid>
void trace(Hit& hit, bool is_occlusion, Intersect* intersect, Occluded* occluded, Valid... valid) {
#if RTC_VERSION_MAJOR >= 4
    RTCIntersectArguments* const arguments = nullptr;
#else
    RTCIntersectContext fresh;
    rtcInitIntersectContext(&fresh);
    RTCIntersectContext* const context = &fresh;
#endif
    if (is_occlusion) {
        auto* const rays = &hit.ray;
        occluded(valid..., seen.scene, GIVEN);
    } else {
        set_unhit(hit);
        auto* const rays = &hit;
        intersect(valid..., seen.scene, GIVEN);
    }
}

void trace_packets(const std::vector<Packet>& packets) {
    for (const Packet& packet : packets) {
        RTCRayHit8 hit;
        hit.ray = packet.rays;
        trace(hit, packet.is_occlusion, REAL(rtcIntersect8), REAL(rtcOccluded8), packet.valid.data());
    }
}

/// Alone, the rays of those calls that are wanted.
template <class IsWanted>
void trace_singly(const IsWanted& is_wanted) {
    const RTCRay* ray = seen.rays.data();
    for (const Call& call : seen.calls) {
        for (std::size_t k = 0; k < call.count; ++k, ++ray) {
            if (!is_wanted(call)) continue;
            RTCRayHit hit;
            hit.ray = *ray;
            trace(hit, call.is_occlusion, REAL(rtcIntersect1), REAL(rtcOccluded1));
        }
    }
}

template <class Work>
double least_cpu_s(const Work& work) {
    double least = 1e30;
    for (int repeat = 0; repeat < 3; ++repeat) {
        const std::clock_t start = std::clock();
        work();
        least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return least;
}

}  // namespace

extern "C" {

RTC_API void rtcIntersect1(RTCScene scene, RAYS(RTCRayHit)) {
    log_ray(scene, rays->ray, false);
    REAL(rtcIntersect1)(scene, GIVEN);
}

RTC_API void rtcOccluded1(RTCScene scene, RAYS(RTCRay)) {
    log_ray(scene, *rays, true);
    REAL(rtcOccluded1)(scene, GIVEN);
}

RTC_API void rtcIntersect8(const int* valid, RTCScene scene, RAYS(RTCRayHit8)) {
    log_packet(valid, scene, rays->ray, false);
    REAL(rtcIntersect8)(valid, scene, GIVEN);
}

RTC_API void rtcOccluded8(const int* valid, RTCScene scene, RAYS(RTCRay8)) {
    log_packet(valid, scene, *rays, true);
    REAL(rtcOccluded8)(valid, scene, GIVEN);
}

/// Forgets what was kept and keeps what is traced from now on.
void ray_log_start() {
    seen = {};
    seen.is_on = true;
}

void ray_log_stop() { seen.is_on = false; }

/// Of rays that look for the closest hit, or for any.
std::uint64_t ray_log_count(bool is_occlusion) {
    std::uint64_t count = 0;
    for (const Call& call : seen.calls) count += call.is_occlusion == is_occlusion ? call.count : 0;
    return count;
}

/// CPU seconds of the rays that were kept, the scene being as it was: as they were traced,
double ray_log_as_traced_s() {
    const std::vector<Packet> packets = packets_as_traced();
    return least_cpu_s([&] {
        trace_packets(packets);
        trace_singly([](const Call& call) { return call.is_single; });
    });
}

/// all in full packets,
double ray_log_full_packets_s() {
    const std::vector<Packet> packets = full_packets();
    return least_cpu_s([&] { trace_packets(packets); });
}

/// or each alone.
double ray_log_single_s() {
    return least_cpu_s([] { trace_singly([](const Call&) { return true; }); });
}
}
