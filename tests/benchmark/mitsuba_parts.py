"""Inside a Python with Mitsuba 3: what scenes are made of, in Mitsuba's words, and their render.

DRJIT_LIBLLVM_PATH: a recent libLLVM (19 works); the llvm variants abort with those of 14 to 16.
"""

from __future__ import annotations

import math
from typing import Any

import mitsuba as mi
import numpy as np
from numpy.typing import NDArray

mi.set_variant("llvm_ad_rgb")

Matrix = NDArray[np.float64]
Triple = tuple[float, float, float]
Description = dict[str, Any]


def rgb(color: Triple) -> Description:
    return {"type": "rgb", "value": list(color)}


def diffuse(color: Triple) -> Description:
    return {"type": "diffuse", "reflectance": rgb(color)}


def glossy(color: Triple, roughness: float) -> Description:
    """GGX of one colour at all angles."""
    return {
        "type": "roughconductor",
        "material": "none",
        "distribution": "ggx",
        "alpha": max(roughness**2, 1e-3),
        "specular_reflectance": rgb(color),
    }


def two_sided(bsdf: Description) -> Description:
    return {"type": "twosided", "bsdf": bsdf}


def emission(radiance: Triple) -> Description:
    return {"type": "area", "radiance": rgb(radiance)}


def mesh(name: str, positions: Matrix, normals: Matrix, triangles: NDArray[np.int32], **parts: Description) -> Any:
    """In world space, with a normal for each vertex; parts: its bsdf, and its emitter if it shines."""
    properties = mi.Properties()
    for key, part in parts.items():
        properties[key] = mi.load_dict(part)
    made = mi.Mesh(name, len(positions), len(triangles), has_vertex_normals=True, props=properties)
    parameters = mi.traverse(made)
    parameters["vertex_positions"] = np.ravel(positions).astype(np.float32)
    parameters["vertex_normals"] = np.ravel(normals).astype(np.float32)
    parameters["faces"] = np.ravel(triangles).astype(np.uint32)
    parameters.update()
    return made


# -- lamps, by Blender's units; other light passes through them
def _lamp(shape: Description, radiance: float, color: Triple) -> Description:
    return shape | {"emitter": emission(tuple(radiance * c for c in color)), "bsdf": {"type": "null"}}


def sphere_light(center: Triple, radius_m: float, power_w: float, color: Triple) -> Description:
    shape = {"type": "sphere", "center": list(center), "radius": radius_m}
    return _lamp(shape, power_w / (4 * math.pi**2 * radius_m**2), color)


def _facing(kind: str, world_from_light: Matrix, half_x_m: float, half_y_m: float) -> Description:
    """Mitsuba's shapes shine along their z, Blender's lights along -z."""
    flip = np.diag([1.0, -1.0, -1.0, 1.0])
    to_world = world_from_light @ flip @ np.diag([half_x_m, half_y_m, 1.0, 1.0])
    return {"type": kind, "to_world": mi.ScalarTransform4f(to_world)}


def area_light(
    world_from_light: Matrix, size_m: tuple[float, float], is_ellipse: bool, power_w: float, color: Triple
) -> Description:
    x, y = size_m
    area_m2 = x * y * (math.pi / 4 if is_ellipse else 1.0)
    shape = _facing("disk" if is_ellipse else "rectangle", world_from_light, x / 2, y / 2)
    return _lamp(shape, power_w / (math.pi * area_m2), color)


def sun_light(world_from_light: Matrix, angle_rad: float, irradiance: float, color: Triple) -> Description:
    """A disk that is far off: Mitsuba's own `directional` is a point of the sky."""
    far_m, half_angle_rad = 1e5, angle_rad / 2
    radius_m = far_m * math.tan(half_angle_rad)
    far = world_from_light.copy()
    far[:3, 3] = far_m * far[:3, 2]
    shape = _facing("disk", far, radius_m, radius_m)
    return _lamp(shape, irradiance / (math.pi * math.sin(half_angle_rad) ** 2), color)


def camera(world_from_camera: Matrix, half_width: float, width_px: int, height_px: int) -> Description:
    """half_width: of the view plane at distance 1. Mitsuba's camera looks along its z, with x to the left."""
    return {
        "type": "perspective",
        "fov_axis": "x",
        "fov": math.degrees(2 * math.atan(half_width)),
        "to_world": mi.ScalarTransform4f(world_from_camera @ np.diag([-1.0, 1.0, -1.0, 1.0])),
        "near_clip": 0.01,
        "far_clip": 1e6,
        "sampler": {"type": "multijitter"},
        "film": {
            "type": "hdrfilm",
            "width": width_px,
            "height": height_px,
            "rfilter": {"type": "box"},
            "pixel_format": "rgb",
        },
    }


class Mitsuba:
    """things: shapes and lights by any name. hide_emitters: from the camera, the world too."""

    def __init__(self, things: Description, sensor: Description, max_bounces: int, hide_emitters: bool) -> None:
        integrator = {"type": "path", "max_depth": max_bounces + 2, "hide_emitters": hide_emitters}
        self._scene = mi.load_dict({"type": "scene", "integrator": integrator, "sensor": sensor} | things)

    def render(self, samples: int, seed: int) -> NDArray[np.float32]:
        return np.array(mi.render(self._scene, spp=samples, seed=seed))[::-1]
