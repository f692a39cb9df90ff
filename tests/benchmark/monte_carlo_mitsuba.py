"""Inside a Python with Mitsuba 3: build a scene of monte_carlo_scenes.py and render it (see monte_carlo_worker.py).

DRJIT_LIBLLVM_PATH: a recent libLLVM (19 works); the llvm variants abort with those of 14 to 16 on a CPU with AVX-512.
"""

from __future__ import annotations

import math
from typing import Any

import mitsuba as mi
import monte_carlo_scenes as scenes
import monte_carlo_worker as worker
import numpy as np
from numpy.typing import NDArray

mi.set_variant("llvm_ad_rgb")


def _rgb(color: tuple[float, float, float]) -> dict[str, Any]:
    return {"type": "rgb", "value": list(color)}


def _bsdf(material: scenes.Material) -> dict[str, Any]:
    if material.kind == "DIFFUSE":
        return {"type": "diffuse", "reflectance": _rgb(material.color)}
    return {
        "type": "roughconductor",
        "material": "none",
        "distribution": "ggx",
        "alpha": max(material.roughness**2, 1e-3),
        "specular_reflectance": _rgb(material.color),
    }


def _shape(shape: scenes.Shape) -> Any:
    matrix = shape.world_from_object()
    if shape.kind == "PLANE":
        return {"type": "rectangle", "to_world": mi.ScalarTransform4f(matrix), "bsdf": _bsdf(shape.material)}
    vertices, triangles = scenes.sphere_mesh()
    properties = mi.Properties()
    properties["bsdf"] = mi.load_dict(_bsdf(shape.material))
    mesh = mi.Mesh("sphere", len(vertices), len(triangles), has_vertex_normals=True, props=properties)
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = np.ravel(vertices @ matrix[:3, :3].T + matrix[:3, 3]).astype(np.float32)
    parameters["vertex_normals"] = np.ravel(vertices).astype(np.float32)  # the scale is the same along all axes
    parameters["faces"] = np.ravel(triangles).astype(np.uint32)
    parameters.update()
    return mesh


def _light(light: scenes.LightSource) -> dict[str, Any]:
    """Radiance by Blender's units: power / (4 pi^2 r^2) of a sphere, power / (pi area) of an area light."""
    if light.kind == "POINT":
        radius = light.size_m[0]
        radiance = light.power_w / (4 * math.pi**2 * radius**2)
        shape = {"type": "sphere", "center": list(light.location), "radius": radius}
    else:
        x, y = light.size_m
        area = x * y * (math.pi / 4 if light.kind == "ELLIPSE" else 1.0)
        radiance = light.power_w / (math.pi * area)
        # Mitsuba's shapes shine along their z, Blender's lights along -z.
        flip = np.diag([1.0, -1.0, -1.0, 1.0])
        matrix = scenes.look_at(light.location, light.target) @ flip @ np.diag([x / 2, y / 2, 1.0, 1.0])
        kind = "disk" if light.kind == "ELLIPSE" else "rectangle"
        shape = {"type": kind, "to_world": mi.ScalarTransform4f(matrix)}
    emitter = {"type": "area", "radiance": _rgb(tuple(radiance * c for c in light.color))}
    return shape | {"emitter": emitter, "bsdf": {"type": "null"}}


class Mitsuba:
    """settings: none."""

    def __init__(self, scene: scenes.Scene, settings: dict[str, Any]) -> None:
        description: dict[str, Any] = {
            "type": "scene",
            "integrator": {"type": "path", "max_depth": 2, "hide_emitters": True, "rr_depth": 100},
        }
        for index, shape in enumerate(scene.shapes):
            description[f"shape{index}"] = _shape(shape)
        for index, light in enumerate(scene.lights):
            description[f"light{index}"] = _light(light)
        # Mitsuba's camera looks along its z, with x to the left.
        to_world = scenes.look_at(scene.eye, scene.target) @ np.diag([-1.0, 1.0, -1.0, 1.0])
        description["sensor"] = {
            "type": "perspective",
            "fov_axis": "x",
            "fov": math.degrees(2 * math.atan(scene.half_width)),
            "to_world": mi.ScalarTransform4f(to_world),
            "sampler": {"type": "multijitter"},
            "film": {
                "type": "hdrfilm",
                "width": scenes.WIDTH,
                "height": scenes.HEIGHT,
                "rfilter": {"type": "box"},
                "pixel_format": "rgb",
            },
        }
        self._scene = mi.load_dict(description)

    def render(self, samples: int, seed: int) -> NDArray[np.float32]:
        return np.array(mi.render(self._scene, spp=samples, seed=seed))[::-1]


if __name__ == "__main__":
    worker.main({"mitsuba": Mitsuba}, scenes.SCENES)
