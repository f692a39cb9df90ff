// added_lobe RED GREEN BLUE EXPONENT < QUERIES > ANSWERS: what a surface is that has the lobe of added_lobe.h beside
// its base, by the functions that all surfaces share. Both are structs of floats, as below; all answers by floats, then
// all by batches.
#include "core/bsdf/lobes/added_lobe.h"

#include <cstdio>
#include <cstdlib>
#include <vector>

#include "core/bsdf/surface.h"
#include "core/simd/pack.h"

using namespace pivot;

template <class T>
struct Query {
    Vec3<T> wo_local, wi_local;
    T u_lobe;
    Vec2<T> u;
};

template <class T>
struct Answer {
    Vec3<T> eval_base, eval;
    T pdf_omega, albedo;  // of the lobe alone: its mean over colours
    Vec3<T> sample;
};

template <class T>
Answer<T> answer(const MaterialOf<T>& material, const Query<T>& query) {
    const SurfaceOf<T> surface = make_surface(material, query.wo_local);
    return {eval_base(surface, query.wi_local), eval(surface, query.wi_local), pdf_omega(surface, query.wi_local),
            lobe_albedo(surface).above, sample(surface, query.u_lobe, query.u)};
}

Material material_with(const Minnaert<float>::Parameters& parameters) {
    Material material{};
    material.diffuse = {0.3f, 0.2f, 0.1f};
    for_each_lobe_kind<float>([&]<class L>(float kind) {
        if constexpr (std::is_same_v<L, Minnaert<float>>) material.lobes[0].kind = kind;
    });
    material.lobes[0].write(parameters);
    return material;
}

int main(int, char** arguments) {
    const auto number = [&](std::size_t i) { return std::strtof(arguments[i], nullptr); };
    const Material material = material_with({{number(1), number(2), number(3)}, number(4)});
    std::vector<Query<float>> queries;
    for (Query<float> query; std::fread(&query, sizeof(query), 1, stdin) == 1;) queries.push_back(query);

    std::vector<Answer<float>> by_float, by_batch;
    for (const Query<float>& query : queries) by_float.push_back(answer(material, query));
    for (std::size_t first = 0; first < queries.size(); first += batch_size) {
        std::array<const Query<float>*, batch_size> lanes;
        for (std::size_t i = 0; i < batch_size; ++i) lanes[i] = &queries[std::min(first + i, queries.size() - 1)];
        const auto answers = unpack<Answer>(answer(broadcast<MaterialOf>(material), pack<Query>(lanes)));
        for (std::size_t i = 0; i < std::min(batch_size, queries.size() - first); ++i) by_batch.push_back(answers[i]);
    }
    for (const auto& answers : {by_float, by_batch})
        std::fwrite(answers.data(), sizeof(Answer<float>), answers.size(), stdout);
}
