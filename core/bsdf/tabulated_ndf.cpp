#include "core/bsdf/tabulated_ndf.h"

#include <tbb/parallel_for.h>

#include "core/math/quadrature.h"
#include "core/sampling/warp.h"
#include "core/tables/axes.h"

namespace pivot {
namespace {

constexpr std::size_t albedo_points = 1024;

Vec3f half_vector(const Vec3f& wo, const Vec3f& wi) { return normalize(wo + wi); }

}  // namespace

TabulatedNdf::TabulatedNdf(std::size_t size, std::vector<float> pixels)
    : image_(size, std::move(pixels)),
      sigma_(image_),
      fit_(pivot::fit(image_)),
      fit_probability_(std::clamp(1.0f - 2.0f * fit_.error, 0.25f, 0.95f)) {
    for (const TiltedGgx& lobe : fit_.lobes) fit_axes_.push_back(own_axes(lobe));
    const auto azimuth_of = [](std::size_t i) { return 2.0f * pi<float> * static_cast<float>(i) / albedo_azimuths; };
    tbb::parallel_for(std::size_t(0), albedo_elevations, [&](std::size_t row) {
        const float place = std::max(static_cast<float>(row) / (albedo_elevations - 1), 1e-3f);
        for (std::size_t i = 0; i < albedo_azimuths; ++i)
            albedo_[row * albedo_azimuths + i] = measured_albedo(direction_at(place, azimuth_of(i), alpha()));
    });
    for (const auto& node : gauss_rule<16>)
        for (std::size_t i = 0; i < albedo_azimuths; ++i) {
            // even in cos^2, which is 2 cos d cos
            const float z = std::sqrt(node.x), sine = safe_sqrt(1.0f - node.x), azimuth = azimuth_of(i);
            average_albedo_ +=
                node.weight / albedo_azimuths * albedo({sine * std::cos(azimuth), sine * std::sin(azimuth), z});
        }
}

float TabulatedNdf::lambda(const Vec3f& w_local) const {
    return std::max(sigma_(w_local) / std::max(w_local.z, tiny<float>) - 1.0f, 0.0f);
}

float TabulatedNdf::eval(const Vec3f& wo_local, const Vec3f& wi_local) const {
    if (!(wi_local.z > 0.0f)) return 0.0f;
    const float density = image_.density(half_vector(wo_local, wi_local));
    if (!(density > 0.0f)) return 0.0f;
    return density / ((1.0f + lambda(wo_local) + lambda(wi_local)) * 4.0f * wo_local.z);
}

float TabulatedNdf::visible_pdf(const Vec3f& wo_local, const Vec3f& h_local) const {
    float seen = 0.0f, all = 0.0f;
    for (const TiltedGgx& lobe : fit_.lobes) {
        seen += ndf(lobe, h_local);
        all += projected_area(lobe, wo_local);
    }
    return seen * std::max(dot(wo_local, h_local), 0.0f) / std::max(all, tiny<float>);
}

float TabulatedNdf::pdf_omega(const Vec3f& wo_local, const Vec3f& wi_local) const {
    const Vec3f h = half_vector(wo_local, wi_local);
    const float cos_oh = dot(wo_local, h);
    if (!(h.z > 0.0f && cos_oh > 0.0f)) return 0.0f;
    return lerp(image_.pdf_omega(h), visible_pdf(wo_local, h), fit_probability_) / (4.0f * cos_oh);
}

Vec3f TabulatedNdf::sample(const Vec3f& wo_local, float u_part, const Vec2f& u) const {
    Vec3f h;
    if (u_part < fit_probability_) {
        float all = 0.0f;
        for (const TiltedGgx& lobe : fit_.lobes) all += projected_area(lobe, wo_local);
        float left = u_part / fit_probability_ * all;
        const TiltedGgx* chosen = &fit_.lobes.back();
        for (const TiltedGgx& lobe : fit_.lobes) {
            const float area = projected_area(lobe, wo_local);
            if (left < area) {
                chosen = &lobe;
                break;
            }
            left -= area;
        }
        h = sample_visible(*chosen, wo_local, u);
    } else {
        h = image_.sample(u);
    }
    return 2.0f * dot(wo_local, h) * h - wo_local;
}

float TabulatedNdf::measured_albedo(const Vec3f& wo_local) const {
    float sum = 0.0f;
    for (std::size_t i = 0; i < albedo_points; ++i) {
        const Vec2f u = golden_point(static_cast<float>(i), albedo_points);
        const float turns = static_cast<float>(i) * 0.7548777f, u_part = turns - std::floor(turns);
        const Vec3f wi = sample(wo_local, u_part, u);
        const float value = eval(wo_local, wi);
        if (value > 0.0f) sum += value / pdf_omega(wo_local, wi);
    }
    return std::min(sum / albedo_points, 1.0f);
}

float TabulatedNdf::albedo(const Vec3f& wo_local) const {
    const TableCell<float> row = table_cell(elevation_coordinate(wo_local, alpha()), albedo_elevations);
    const float turn = std::atan2(wo_local.y, wo_local.x) * (0.5f / pi<float>);
    const float column = (turn < 0.0f ? turn + 1.0f : turn) * albedo_azimuths;
    const auto whole = static_cast<std::size_t>(column);
    const float across = column - static_cast<float>(whole);
    const auto at = [&](std::size_t r) {
        const float* values = &albedo_[r * albedo_azimuths];
        return lerp(values[whole % albedo_azimuths], values[(whole + 1) % albedo_azimuths], across);
    };
    const auto first = static_cast<std::size_t>(row.index);
    return lerp(at(first), at(first + 1), row.weight);
}

std::size_t TabulatedNdf::memory_bytes() const {
    return sizeof(*this) + image_.memory_bytes() + fit_.lobes.size() * (sizeof(TiltedGgx) + sizeof(OwnAxes));
}

}  // namespace pivot
