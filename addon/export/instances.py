"""What the depsgraph tells of its instances, all at once."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from numpy.typing import DTypeLike, NDArray

_WORD = 0xFFFFFFFF


@dataclass(frozen=True)
class Instances:
    """N instances, objects that stand for themselves among them."""

    object_to_world: NDArray[np.float32]  # (N, 4, 4)
    is_instance: NDArray[np.bool_]  # (N,); False: an object that stands for itself
    random: NDArray[np.float32]  # (N,), of those that are
    generated: NDArray[np.float32]  # (N, 3), where the instancer has them
    uv: NDArray[np.float32]  # (N, 2), likewise

    @staticmethod
    def read(instances: Any) -> Instances:
        """instances: `Depsgraph.object_instances`."""
        count = len(instances)

        def values(name: str, *shape: int, dtype: DTypeLike = np.float32) -> NDArray[Any]:
            flat = np.empty(count * math.prod(shape), dtype)
            instances.foreach_get(name, flat)
            return flat.reshape(count, *shape)

        is_instance = values("is_instance", dtype=np.bool_)
        return Instances(
            object_to_world=values("matrix_world", 4, 4).transpose(0, 2, 1),  # Blender's columns come first
            is_instance=is_instance,
            random=_random(values("random_id", dtype=np.int32).view(np.uint32)),
            generated=np.where(is_instance[:, None], np.float32(0.5) * (values("orco", 3) - 1), np.float32(0)),
            uv=values("uv", 2),
        )

    def random_of(self, name: str, indices: list[int]) -> NDArray[np.float32]:
        """Of some, whose object has the name: an object that stands for itself is known by it alone."""
        own = _random(np.array(_hashed(_hashed_name(name)), np.uint32))
        return np.where(self.is_instance[indices], self.random[indices], own)


def particle_numbers(
    instance: bpy.types.DepsgraphObjectInstance, names: frozenset[str], frame: float
) -> dict[str, tuple[float, ...]]:
    """What Particle Info tells of what an instance stands for, of each four numbers: "Index" is always there, 0 of what
    is no particle; of the other names those that Blender tells, of children none. frame: the scene's.
    """
    if not instance.is_instance or not instance.particle_system:
        return {"Index": (0.0,) * 4}
    index = instance.persistent_id[0]
    result: dict[str, tuple[float, ...]] = {"Index": (float(index),) * 4}
    particles = instance.particle_system.particles
    if names and index < len(particles):
        particle = particles[index]
        numbers = {"Age": frame - particle.birth_time, "Lifetime": particle.lifetime, "Size": particle.size}
        vectors = {
            "Location": particle.location,
            "Velocity": particle.velocity,
            "Angular Velocity": particle.angular_velocity,
        }
        result |= {name: (number,) * 4 for name, number in numbers.items() if name in names}
        result |= {name: (*vector, 1.0) for name, vector in vectors.items() if name in names}
    return result


def _random(words: NDArray[np.uint32]) -> NDArray[np.float32]:
    """[0, 1] as Cycles has it. [Cycles 4.5 scene/object.cpp:491]"""
    return words.astype(np.float32) * np.float32(1 / _WORD)


def _hashed_name(name: str) -> int:
    """[Cycles 4.5 util/hash.h, hash_string]"""
    result = 0
    for letter in name.encode():
        result = (37 * result + letter) & _WORD
    return result


def _hashed(word: int) -> int:
    """[Jenkins06] lookup3's final mixing of the word and 0, seeded as in Cycles 4.5 util/hash.h, hash_uint2."""
    seed = (0xDEADBEEF + (2 << 2) + 13) & _WORD
    words = [(seed + word) & _WORD, seed, seed]
    for x, y, turn in ((2, 1, 14), (0, 2, 11), (1, 0, 25), (2, 1, 16), (0, 2, 4), (1, 0, 14), (2, 1, 24)):
        turned = (words[y] << turn | words[y] >> (32 - turn)) & _WORD
        words[x] = ((words[x] ^ words[y]) - turned) & _WORD
    return words[2]
