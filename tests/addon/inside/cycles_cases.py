"""One scene per light type, rendered by Cycles and by Pivot in each light sampling; as files in the folder.

Materials are what both engines mean by them: before Blender 4.0 Principled is another, so that there is no plastic.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import bpy
import parts

OLD = bpy.app.version < (4, 0)
SIZE = 48
CYCLES_SAMPLES = 256
PIVOT_SAMPLES = {"JOINT": 128, "SPTD": 128, "MIS": 128, "LIGHT": 512, "BSDF": 1024}
IN_EVERY_SAMPLING = ("point", "spot", "soft_point", "soft_spot", "sun", "disk", "lobes", "bounces")
SOFT: dict[str, Any] = {"shadow_soft_size": 1.0}
SPHERE: dict[str, Any] = {"shadow_soft_size": 0.4} | ({} if OLD else {"use_soft_falloff": False})
CONE = {"spot_size": math.radians(70), "spot_blend": 0.3}
LIGHTS: dict[str, dict[str, Any]] = {
    "point": {"type": "POINT", "energy": 200} | SPHERE,
    "spot": {"type": "SPOT", "energy": 200} | SPHERE | CONE,
    "soft_point": {"type": "POINT", "energy": 200} | SOFT,
    "soft_spot": {"type": "SPOT", "energy": 200} | SOFT | CONE,
    "sun": {"type": "SUN", "energy": 2, "angle": 0.1 if OLD else 0.6},
    "square": {"type": "AREA", "energy": 60, "shape": "SQUARE", "size": 2.5},
    "rectangle": {"type": "AREA", "energy": 60, "shape": "RECTANGLE", "size": 3, "size_y": 1},
    "disk": {"type": "AREA", "energy": 60, "shape": "DISK", "size": 2.5},
    "ellipse": {"type": "AREA", "energy": 60, "shape": "ELLIPSE", "size": 3, "size_y": 1},
    "nodes": {"type": "AREA", "energy": 20, "shape": "SQUARE", "size": 2.5, "use_nodes": True},
}
if bpy.app.version >= (4, 4):
    LIGHTS["exposed"] = {"type": "POINT", "energy": 100, "exposure": 1} | SPHERE
    LIGHTS["raw"] = {"type": "AREA", "energy": 30, "shape": "DISK", "size": 2.5, "normalize": False}
    LIGHTS["warm"] = {"type": "POINT", "energy": 200, "use_temperature": True, "temperature": 3000} | SPHERE

BLUE = (0.1, 0.3, 0.6, 1)
MATERIALS: dict[str, tuple[str, str, dict[str, Any]]] = {
    "glossy": ("ShaderNodeBsdfGlossy", "GGX", {"Color": BLUE, "Roughness": 0.4}),
}
if not OLD:
    PRINCIPLED = {
        "plastic": ("GGX", {"Roughness": 0.3}),
        "rough_plastic": ("MULTI_GGX", {"Roughness": 0.9}),
        "dense_plastic": ("MULTI_GGX", {"Roughness": 0.3, "IOR": 2.0}),
        "tinted_plastic": ("MULTI_GGX", {"Specular_Tint": (1, 0.3, 0.2, 1), "Specular_IOR_Level": 1.0}),
        "metal": ("MULTI_GGX", {"Roughness": 0.8, "Metallic": 1}),
        "half_metal": ("MULTI_GGX", {"Roughness": 0.4, "Metallic": 0.5}),
        "lamp": ("GGX", {"Emission_Color": (1, 0.5, 0.2, 1), "Emission_Strength": 0.5}),
    }
    for name, (distribution, inputs) in PRINCIPLED.items():
        MATERIALS[name] = ("ShaderNodeBsdfPrincipled", distribution, {"Base_Color": BLUE} | inputs)
    MATERIALS["rough_glossy"] = ("ShaderNodeBsdfGlossy", "MULTI_GGX", {"Color": BLUE, "Roughness": 0.8})


def main(folder: Path) -> Any:
    """Returns the names of each light sampling's scenes, and those of the materials from left to right."""
    rendered: dict[str, list[str]] = {light_sampling: [] for light_sampling in PIVOT_SAMPLES}
    scenes = LIGHTS | {"world": {}, "world_nodes": {}, "bounces": LIGHTS["square"], "lobes": LIGHTS["square"]}
    scenes["glass"] = LIGHTS["square"]
    for name, light in scenes.items():
        _scene(name, dict(light))
        if name == "lobes":
            _add_lobes()
        if name == "glass":
            _add_glass()
        bounces = {"bounces": 3, "glass": 8}.get(name, 0)
        # The mean of many highlights is off by 0.3 % by four times fewer.
        _cycles(folder / f"{name}_CYCLES.exr", bounces, 1024 if name == "lobes" else CYCLES_SAMPLES)
        for light_sampling, scenes in rendered.items():
            if _is_compared(name, light_sampling):
                _pivot(folder / f"{name}_{light_sampling}.exr", bounces, light_sampling)
                scenes.append(name)
    return {"lights": rendered, "materials": _materials(folder)}


def _is_compared(name: str, light_sampling: str) -> bool:
    """The default everywhere, the others on some; material samples alone would not find a small light."""
    small = {"point", "spot", "sun"} if OLD else {"point", "spot"}
    return light_sampling == "JOINT" or (name in IN_EVERY_SAMPLING and not (light_sampling == "BSDF" and name in small))


def _scene(name: str, light: dict[str, Any]) -> None:
    """A diffuse ground with a plastic and a metal ball, the light obliquely above."""
    parts.clear()
    parts.size(SIZE, SIZE)
    parts.camera((0, -7, 5), (math.radians(54), 0, 0)).data.lens = 40
    ground = parts.quad("ground", material=parts.shaded("ground", "ShaderNodeBsdfDiffuse", Color=(0.7, 0.5, 0.3, 1))[0])
    ground.scale = (4, 4, 1)
    blue = (0.1, 0.3, 0.6, 1)
    if OLD:
        plastic, _ = parts.shaded("matte", "ShaderNodeBsdfDiffuse", Color=blue)
    else:
        plastic, node = parts.shaded("plastic", "ShaderNodeBsdfPrincipled", Base_Color=blue, Roughness=0.3)
        node.distribution = "GGX"
    _ball("plastic", (-1.2, 0, 1), plastic)
    metal, node = parts.shaded("metal", "ShaderNodeBsdfGlossy", Color=(0.9, 0.7, 0.4, 1), Roughness=0.3)
    node.distribution = "GGX"
    _ball("metal", (1.2, 0, 1), metal)
    if light:
        turned = parts.light(name, light.pop("type"), (1.5, -2, 4), **light)
        turned.rotation_euler = (math.radians(27), math.radians(20), 0.3)
        turned.scale = (1.2, 0.8, 1) if turned.data.type == "AREA" else (1, 1, 1)
        if turned.data.use_nodes:
            _feed(turned.data.node_tree, turned.data.node_tree.nodes["Emission"])
    else:
        tree = parts.world((0.5, 0.7, 0.9)).node_tree
        if name == "world_nodes":
            _feed(tree, tree.nodes["Background"])


def _add_lobes() -> None:
    """A ball of two highlights mixed, in the place of the plastic one, and a paper screen that lights shine through."""
    material, tree = parts.material("lacquer")
    clear, dull = (tree.nodes.new("ShaderNodeBsdfGlossy") for _ in range(2))
    for node, color, roughness in ((clear, (0.9, 0.9, 0.9, 1), 0.35), (dull, (0.8, 0.2, 0.1, 1), 0.8)):
        node.distribution = "GGX"
        node.inputs["Color"].default_value, node.inputs["Roughness"].default_value = color, roughness
    _mix(tree, clear, dull)
    bpy.data.objects["plastic"].data.materials[0] = material
    material, tree = parts.material("paper")
    inside, outside = (tree.nodes.new(f"ShaderNodeBsdf{kind}") for kind in ("Translucent", "Diffuse"))
    inside.inputs["Color"].default_value, outside.inputs["Color"].default_value = (0.2, 0.7, 0.3, 1), (0.5, 0.1, 0.1, 1)
    _mix(tree, inside, outside)
    screen = parts.quad("paper", (0.2, -2.2, 1), material)
    screen.rotation_euler = (math.radians(80), 0, 0.4)
    parts.light("behind", "POINT", (0.2, -0.9, 2.8), energy=60, **SPHERE)


def _add_glass() -> None:
    """Balls of clear and of frosted glass in the places of the plastic and the metal one, and a sky around."""
    looks = {"plastic": {"Roughness": 0.0}, "metal": {"Roughness": 0.3, "Color": (0.7, 0.9, 0.8, 1)}}
    for name, look in looks.items():
        material, node = parts.shaded("glass", "ShaderNodeBsdfGlass", IOR=1.5, **look)
        node.distribution = "GGX"
        bpy.data.objects[name].data.materials[0] = material
    parts.world((0.3, 0.4, 0.5))


def _mix(tree: Any, a: Any, b: Any) -> None:
    """Two shaders by halves, as the material's surface."""
    mix = tree.nodes.new("ShaderNodeMixShader")
    for index, node in enumerate((a, b), start=1):
        tree.links.new(node.outputs[0], mix.inputs[index])
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs["Surface"])


def _feed(tree: Any, shader: Any) -> None:
    """A black body's colour, and 1.5 x 2 as the strength, half of it by a shader mixed with none."""
    product, body = tree.nodes.new("ShaderNodeMath"), tree.nodes.new("ShaderNodeBlackbody")
    product.operation = "MULTIPLY"
    product.inputs[0].default_value, product.inputs[1].default_value, body.inputs[0].default_value = 1.5, 2, 2500
    tree.links.new(product.outputs[0], shader.inputs["Strength"])
    tree.links.new(body.outputs[0], shader.inputs["Color"])
    mix = tree.nodes.new("ShaderNodeMixShader")
    tree.links.new(shader.outputs[0], mix.inputs[1])
    output = next(node for node in tree.nodes if node.type.startswith("OUTPUT"))
    tree.links.new(mix.outputs[0], output.inputs["Surface"])


def _materials(folder: Path) -> list[str]:
    """A row of balls, one of each material, under an area light and the world; SIZE pixels a ball."""
    parts.clear()
    parts.size(SIZE * len(MATERIALS), SIZE)
    camera = parts.camera((0, -60, 0), (math.pi / 2, 0, 0))
    camera.data.angle = 2 * math.atan(1.1 * len(MATERIALS) / 60)
    for index, (name, (kind, distribution, inputs)) in enumerate(MATERIALS.items()):
        material, node = parts.shaded(name, kind, **inputs)
        node.distribution = distribution
        _ball(name, (2.2 * (index - (len(MATERIALS) - 1) / 2), 0, 0), material)
    parts.world((0.5, 0.5, 0.5))
    light = parts.light("key", "AREA", (0, -12, 12), energy=3000, shape="SQUARE", size=4)
    light.rotation_euler = (math.radians(45), 0, 0)
    _cycles(folder / "materials_CYCLES.exr", 0)
    _pivot(folder / "materials_JOINT.exr", 0, "JOINT")
    return list(MATERIALS)


def _ball(name: str, location: tuple[float, float, float], material: Any) -> Any:
    bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24, location=location)
    ball = bpy.context.object
    ball.name = name
    ball.data.materials.append(material)
    ball.data.polygons.foreach_set("use_smooth", [True] * len(ball.data.polygons))
    return ball


def on_clay(half_extents_m: tuple[float, float] = (4, 4)) -> tuple[Any, Any]:
    """An empty scene but for a camera above a diffuse ground: its material, and the ground."""
    parts.clear()
    parts.size(64, 48)
    parts.camera((0, -7, 3.5), (math.radians(66), 0, 0)).data.lens = 38
    clay, _ = parts.shaded("clay", "ShaderNodeBsdfDiffuse", Color=(0.7, 0.6, 0.5, 1))
    ground = parts.quad("ground", material=clay)
    ground.scale = (*half_extents_m, 1)
    return clay, ground


def _cycles(path: Path, bounces: int, samples: int = CYCLES_SAMPLES, file_format: str = "OPEN_EXR") -> None:
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    settings = scene.cycles
    settings.device = "CPU"
    settings.samples = samples
    settings.use_adaptive_sampling = False
    settings.use_denoising = False
    settings.sample_clamp_indirect = 0
    settings.blur_glossy = 0
    settings.max_bounces = settings.diffuse_bounces = settings.glossy_bounces = bounces
    settings.transmission_bounces = bounces
    _save(path, file_format)


def _pivot(path: Path, bounces: int, light_sampling: str, samples: int = 0, file_format: str = "OPEN_EXR") -> None:
    scene = bpy.context.scene
    scene.render.engine = "PIVOT"
    scene.pivot.samples = samples or PIVOT_SAMPLES[light_sampling]
    scene.pivot.max_bounces = bounces
    scene.pivot.light_sampling = light_sampling
    _save(path, file_format)


def by_both(folder: Path, name: str, bounces: int) -> None:
    """NAME_CYCLES.exr and NAME_MONTE_CARLO.exr."""
    _cycles(folder / f"{name}_CYCLES.exr", bounces)
    _pivot(folder / f"{name}_MONTE_CARLO.exr", bounces, "JOINT")


def directly_by_both(folder: Path, name: str, samples: int = 0, is_analytic: bool = True) -> None:
    """Of direct light: NAME_direct_CYCLES.exr and, by so many samples, NAME_direct_ANALYTIC.exr."""
    _cycles(folder / f"{name}_direct_CYCLES.exr", 0)
    if is_analytic:
        bpy.context.scene.pivot.integrator = "ANALYTIC"
        _pivot(folder / f"{name}_direct_ANALYTIC.exr", 0, "JOINT", samples)


def _save(path: Path, file_format: str = "OPEN_EXR") -> None:
    render = bpy.context.scene.render
    if hasattr(render.image_settings, "media_type"):  # from Blender 5.0
        render.image_settings.media_type = "MULTI_LAYER_IMAGE" if file_format.endswith("MULTILAYER") else "IMAGE"
    render.image_settings.file_format = file_format
    render.image_settings.color_depth = "32"
    render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
