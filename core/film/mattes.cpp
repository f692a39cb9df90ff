#include "core/film/mattes.h"

#include <algorithm>
#include <utility>

namespace pivot {

void Mattes::add(const Matte& matte, float scale) {
    const auto found = std::ranges::find(mattes_, matte.ids, &Matte::ids);
    if (found == mattes_.end())
        mattes_.push_back({matte.ids, scale * matte.weight});
    else
        found->weight += scale * matte.weight;
}

void Mattes::add(const Mattes& other, float scale) {
    for (const Matte& matte : other.mattes_) add(matte, scale);
}

void Mattes::add(std::span<const SeenMatte> seen, std::size_t first_ray, std::span<const float> weights, float scale) {
    for (const auto& [ray, matte] : seen)
        if (const float weight = weights[ray - first_ray]; weight != 0.0f) add(matte, scale * weight);
}

void Mattes::write(MatteKind kind, std::size_t rank, float per_weight, float* out) const {
    std::vector<std::pair<float, float>> ranked;  // id, weight
    for (const Matte& matte : mattes_) {
        const float id = matte.ids.of(kind);
        const auto found = std::ranges::find(ranked, id, &std::pair<float, float>::first);
        if (found == ranked.end())
            ranked.emplace_back(id, matte.weight);
        else
            found->second += matte.weight;
    }
    std::ranges::stable_sort(ranked, std::greater(), &std::pair<float, float>::second);
    for (std::size_t i = 0; i < 2; ++i) {
        const bool is_there = rank + i < ranked.size() && ranked[rank + i].second > 0.0f;
        out[2 * i] = is_there ? ranked[rank + i].first : 0.0f;
        out[2 * i + 1] = is_there ? ranked[rank + i].second * per_weight : 0.0f;
    }
}

}  // namespace pivot
