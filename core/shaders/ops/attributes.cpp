// What meshes and objects keep for shaders.
#include "core/shaders/ops/hash.h"
#include "core/shaders/ops/tables.h"

namespace pivot {
namespace {

/// Up to four numbers a lane, and how many there are: 0 where a mesh or an object has no such attribute.
struct Read {
    std::array<Lanes, 4> numbers{};
    Lanes width{};

    Vec3b vector() const { return {load(numbers[0]), load(numbers[1]), load(numbers[2])}; }
    /// The fourth: `missing` without an attribute, 1 with one of fewer.
    Batch last(float missing) const {
        const Batch count = load(width);
        return select(count > Batch(3.5f), load(numbers[3]), select(count > Batch(0.5f), Batch(1.0f), Batch(missing)));
    }
    /// As one number: a UV's first, a colour's mean. [Cycles 4.5 svm/attribute.h]
    Batch number() const {
        const Vec3b v = vector();
        return select(load(width) > Batch(2.5f), mean_component(v), v.x);
    }
};

/// settings: the attribute's id.
Read of_mesh(Settings<2> settings, const Place& place) {
    const auto id = static_cast<std::uint32_t>(settings[0]);
    const Lanes u = store(place.barycentric.x), v = store(place.barycentric.y);
    Read read;
    for (std::size_t lane = 0; lane < batch_size; ++lane) {
        const Mesh* mesh = place.lanes.meshes[lane];
        const Attribute* found = mesh ? mesh->attribute(id) : nullptr;
        if (!found) continue;
        const std::uint32_t triangle = place.lanes.triangles[lane];
        const Triangle& t = found->at_corners ? mesh->triangle_corners[triangle] : mesh->triangles[triangle];
        const float* values = found->values.data();
        for (std::uint32_t i = 0; i < found->width; ++i) {
            const float a = values[t.x * found->width + i], b = values[t.y * found->width + i],
                        c = values[t.z * found->width + i];
            read.numbers[i][lane] = a + u[lane] * (b - a) + v[lane] * (c - a);
        }
        if (found->width == 1) read.numbers[1][lane] = read.numbers[2][lane] = read.numbers[0][lane];
        read.width[lane] = static_cast<float>(found->width);
    }
    return read;
}

Read of_object(Settings<2> settings, const Place& place) {
    const auto id = static_cast<std::uint32_t>(settings[0]);
    Read read;
    for (std::size_t lane = 0; lane < batch_size; ++lane) {
        const ObjectFacts* object = place.lanes.objects[lane];
        if (!object || !object->attributes) continue;
        const auto found = std::ranges::find(*object->attributes, id, &ObjectAttribute::id);
        if (found == object->attributes->end()) continue;
        for (std::size_t i = 0; i < 4; ++i) read.numbers[i][lane] = found->value[i];
        read.width[lane] = 4.0f;
    }
    return read;
}

/// settings: the id, and the fourth number where there is none. Gives three numbers, the fourth, and them as one.
template <auto read>
std::tuple<Vec3b, Batch, Batch> attribute(Settings<2> settings, const Place& place) {
    const Read found = read(settings, place);
    return {found.vector(), found.last(settings[1]), found.number()};
}

/// A number that the objects have, 0 in the world.
template <auto number>
Batch fact(const Place& place) {
    return gather([&](std::size_t lane) {
        const ObjectFacts* object = place.lanes.objects[lane];
        return object ? static_cast<float>(number(*object)) : 0.0f;
    });
}

template <auto vector>
Vec3b fact_vector(const Place& place) {
    return gather_vector([&](std::size_t lane) {
        const ObjectFacts* object = place.lanes.objects[lane];
        return object ? Vec3f(vector(*object)) : Vec3f(0.0f);
    });
}

Batch particle_index(const Place& place) {
    return fact<[](const ObjectFacts& o) { return o.particle_index; }>(place);
}

/// [0, 1], as Cycles hashes a particle's index.
Batch particle_random(const Place& place) {
    const auto index = std::bit_cast<WordBatch>(to_index(particle_index(place)));
    return to_unit_inclusive(hash(Words<2>{index, WordBatch(0u)}));
}

constexpr std::array ops{
    op<attribute<of_mesh>>("attribute"),
    op<attribute<of_object>>("object_attribute"),
    op<[](const Place& place) { return place.lanes.corners.world_from_object.translation; }>("object_location"),
    op<fact_vector<[](const ObjectFacts& o) { return o.color; }>>("object_color"),
    op<fact<[](const ObjectFacts& o) { return o.alpha; }>>("object_alpha"),
    op<fact<[](const ObjectFacts& o) { return o.pass_index; }>>("object_index"),
    op<fact<[](const ObjectFacts& o) { return o.random; }>>("object_random"),
    op<particle_index>("particle_index"),
    op<particle_random>("particle_random"),
    op<fact_vector<[](const ObjectFacts& o) { return o.generated; }>>("instance_generated"),
    op<fact_vector<[](const ObjectFacts& o) { return Vec3f(o.uv, 0.0f); }>>("instance_uv"),
};

}  // namespace

std::span<const OpKind> attribute_ops() { return ops; }

}  // namespace pivot
