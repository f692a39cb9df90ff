"""Inside a Python with Mitsuba 3: build a scene of monte_carlo_scenes.py and render it.

monte_carlo_mitsuba.py < JOBS: does the jobs (see monte_carlo_worker.py).
"""

from __future__ import annotations

from typing import Any

import mitsuba_parts as parts
import monte_carlo_scenes as scenes
import monte_carlo_worker as worker


def _bsdf(material: scenes.Material) -> parts.Description:
    if material.kind == "DIFFUSE":
        return parts.diffuse(material.color)
    return parts.glossy(material.color, material.roughness)


def _shape(shape: scenes.Shape) -> Any:
    matrix = shape.world_from_object()
    if shape.kind == "PLANE":
        to_world = parts.mi.ScalarTransform4f(matrix)
        return {"type": "rectangle", "to_world": to_world, "bsdf": _bsdf(shape.material)}
    vertices, triangles = scenes.sphere_mesh()
    positions = vertices @ matrix[:3, :3].T + matrix[:3, 3]  # the scale is the same along all axes
    return parts.mesh("sphere", positions, vertices, triangles, bsdf=_bsdf(shape.material))


def _light(light: scenes.LightSource) -> parts.Description:
    if light.kind == "POINT":
        return parts.sphere_light(light.location, light.size_m[0], light.power_w, light.color)
    place = scenes.look_at(light.location, light.target)
    return parts.area_light(place, light.size_m, light.kind == "ELLIPSE", light.power_w, light.color)


def make(scene: scenes.Scene, settings: dict[str, Any]) -> parts.Mitsuba:
    """settings: none."""
    things = {f"shape{index}": _shape(shape) for index, shape in enumerate(scene.shapes)}
    things |= {f"light{index}": _light(light) for index, light in enumerate(scene.lights)}
    place = scenes.look_at(scene.eye, scene.target)
    sensor = parts.camera(place, scene.half_width, scenes.WIDTH, scenes.HEIGHT)
    return parts.Mitsuba(things, sensor, max_bounces=0, hide_emitters=True)


if __name__ == "__main__":
    worker.main({"mitsuba": make}, scenes.SCENES)
