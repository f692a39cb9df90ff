"""Materials as exported, and what is said of them."""

from __future__ import annotations

import sys
from dataclasses import asdict
from pathlib import Path
from typing import Any

import bpy
import parts
from recording import Shader, record

NEW = bpy.app.version >= (4, 0)
SPECULAR = "Specular IOR Level" if NEW else "Specular"
EMISSION = "Emission Color" if NEW else "Emission"
RED, GREEN, WHITE = (0.8, 0.1, 0.05, 1), (0.1, 0.6, 0.2, 1), (1, 1, 1, 1)


def main(folder: Path) -> Any:
    parts.clear()
    parts.camera()
    for make in (_exact, _networks, _nearest, _special):
        make()
    second = parts.quad("second user", material=bpy.data.materials["noise"])  # reported with its first user only
    second.location.x = 9
    recording = record()
    return {
        "materials": {name: _plain(material) for name, material in recording.materials.items()},
        "reports": recording.reports,
        "override": _override(),
        "newer": _newer(),
    }


def _plain(material: Any) -> Any:
    """A Material as it is; of a Shader its constants, and what varies."""
    if isinstance(material, Shader):
        return asdict(material.constants) | {"varying": sorted(material.varying)}
    return asdict(material) | {"varying": []}


def use(material: Any) -> None:
    parts.quad(f"{material.name} quad", material=material)


def shader(name: str, kind: str, **inputs: Any) -> Any:
    """A used material of one shader node; returns the node."""
    material, node = parts.shaded(name, kind, **inputs)
    use(material)
    return node


def feed(node: Any, socket: str, kind: str, output: int = 0) -> Any:
    """A new node linked to an input of another."""
    feeding = node.id_data.nodes.new(kind)
    node.id_data.links.new(feeding.outputs[output], node.inputs[socket])
    return feeding


def _exact() -> None:
    principled = "ShaderNodeBsdfPrincipled"
    shader("default", principled).distribution = "GGX"
    shader("plastic", principled, Base_Color=RED, Roughness=0.3, **{SPECULAR: 0.25}).distribution = "MULTI_GGX"
    shader("metal", principled, Base_Color=RED, Metallic=1, Roughness=0.2)
    if NEW:
        shader("edged_metal", principled, Base_Color=RED, Metallic=1, Specular_Tint=(0.9, 0.9, 0.9, 1))
    if bpy.app.version >= (4, 3):
        node = shader("metallic_node", "ShaderNodeBsdfMetallic", Base_Color=RED, Edge_Tint=(0.9, 0.9, 0.9, 1))
        node.fresnel_type = "F82"
    shader("half_metal", principled, Base_Color=RED, Metallic=0.5, Roughness=0.2)
    shader("matte", principled, Base_Color=RED, **{SPECULAR: 0})
    shader("dense", principled, IOR=2.0)
    shader("tinted", principled, Base_Color=RED, Specular_Tint=(0.5, 1, 0.25, 1) if NEW else 0.5)
    shader("lamp", principled, Emission_Strength=4, **{EMISSION: (0.5, 0.25, 1, 1)})
    shader("diffuse", "ShaderNodeBsdfDiffuse", Color=RED, Roughness=0)
    shader("glossy", "ShaderNodeBsdfGlossy", Color=RED, Roughness=0.4).distribution = "GGX"
    shader("glossy_multi", "ShaderNodeBsdfGlossy", Color=RED, Roughness=0.4).distribution = "MULTI_GGX"
    shader("emission", "ShaderNodeEmission", Color=(1, 0.5, 0.25, 1), Strength=6)


def _networks() -> None:
    mixed, tree = parts.material("mixed")
    mix = tree.nodes.new("ShaderNodeMixShader")
    mix.inputs[0].default_value = 0.25
    diffuse, glossy = (tree.nodes.new(f"ShaderNodeBsdf{kind}") for kind in ("Diffuse", "Glossy"))
    diffuse.inputs["Color"].default_value, glossy.inputs["Color"].default_value = RED, GREEN
    glossy.distribution = "GGX"
    for index, node in enumerate((diffuse, glossy), start=1):
        tree.links.new(node.outputs[0], mix.inputs[index])
    add = tree.nodes.new("ShaderNodeAddShader")
    emission = tree.nodes.new("ShaderNodeEmission")
    emission.inputs["Strength"].default_value = 2
    tree.links.new(mix.outputs[0], add.inputs[0])
    tree.links.new(emission.outputs[0], add.inputs[1])
    tree.links.new(add.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    use(mixed)

    # A colour through a reroute and a muted node; a number from a Value node.
    routed = shader("routed", "ShaderNodeBsdfGlossy")
    routed.distribution = "GGX"
    feed(routed, "Roughness", "ShaderNodeValue").outputs[0].default_value = 0.5
    muted = feed(routed, "Color", "ShaderNodeInvert")
    muted.mute = True
    reroute = feed(muted, "Color", "NodeReroute")
    rgb = routed.id_data.nodes.new("ShaderNodeRGB")
    rgb.outputs[0].default_value = GREEN
    routed.id_data.links.new(rgb.outputs[0], reroute.inputs[0])

    _group()

    # Two outputs: Cycles' own counts.
    outputs = shader("outputs", "ShaderNodeBsdfDiffuse", Color=RED)
    tree = outputs.id_data
    tree.nodes["Material Output"].target = "EEVEE"
    other = tree.nodes.new("ShaderNodeOutputMaterial")
    other.target = "CYCLES"
    green = tree.nodes.new("ShaderNodeBsdfDiffuse")
    green.inputs["Color"].default_value = GREEN
    tree.links.new(green.outputs[0], other.inputs["Surface"])


def _group() -> None:
    """A diffuse shader in a group in a group, its colour an input of the outer one."""
    inner, outer = (_passing_group(name) for name in ("inner", "outer"))
    diffuse = inner.nodes.new("ShaderNodeBsdfDiffuse")
    inner.links.new(inner.nodes["Group Input"].outputs[0], diffuse.inputs["Color"])
    inner.links.new(diffuse.outputs[0], inner.nodes["Group Output"].inputs[0])
    nested = outer.nodes.new("ShaderNodeGroup")
    nested.node_tree = inner
    outer.links.new(outer.nodes["Group Input"].outputs[0], nested.inputs[0])
    outer.links.new(nested.outputs[0], outer.nodes["Group Output"].inputs[0])
    material, tree = parts.material("grouped")
    group = tree.nodes.new("ShaderNodeGroup")
    group.node_tree = outer
    group.inputs[0].default_value = GREEN
    tree.links.new(group.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    use(material)


def _passing_group(name: str) -> Any:
    tree = bpy.data.node_groups.new(name, "ShaderNodeTree")
    if NEW:
        tree.interface.new_socket("Color", in_out="INPUT", socket_type="NodeSocketColor")
        tree.interface.new_socket("Shader", in_out="OUTPUT", socket_type="NodeSocketShader")
    else:
        tree.inputs.new("NodeSocketColor", "Color")
        tree.outputs.new("NodeSocketShader", "Shader")
    for kind in ("Input", "Output"):
        tree.nodes.new(f"NodeGroup{kind}").name = f"Group {kind}"
    return tree


def _nearest() -> None:
    """What Pivot has no exact meaning for."""
    image = bpy.data.images.new("half red", 4, 2)
    image.pixels.foreach_set([1.0, 0.0, 0.0, 1.0] * 4 + [0.0, 0.0, 0.0, 1.0] * 4)
    feed(shader("image", "ShaderNodeBsdfDiffuse"), "Color", "ShaderNodeTexImage").image = image
    feed(shader("no_image", "ShaderNodeBsdfDiffuse"), "Color", "ShaderNodeTexImage")
    feed(shader("noise", "ShaderNodeBsdfDiffuse"), "Color", "ShaderNodeTexNoise", output=1)
    checker = feed(shader("checker", "ShaderNodeBsdfDiffuse"), "Color", "ShaderNodeTexChecker")
    checker.inputs["Color1"].default_value, checker.inputs["Color2"].default_value = (1, 0, 0, 1), (0, 1, 0, 1)
    ramp = feed(shader("ramp", "ShaderNodeBsdfDiffuse"), "Color", "ShaderNodeValToRGB")
    ramp.name = "Ramp"
    ramp.color_ramp.elements[0].color, ramp.color_ramp.elements[1].color = (0, 0, 0, 1), (1, 0, 0.5, 1)
    feed(ramp, "Fac", "ShaderNodeTexGradient", output=1)
    feed(shader("rough_noise", "ShaderNodeBsdfGlossy", Roughness=0.3), "Roughness", "ShaderNodeTexNoise")
    feed(shader("bump", "ShaderNodeBsdfDiffuse", Color=RED), "Normal", "ShaderNodeBump")
    shader("bubble", "ShaderNodeBsdfPrincipled", IOR=0.5)
    shader("glass_bubble", "ShaderNodeBsdfGlass", Color=GREEN, IOR=0.5, Roughness=0.5).distribution = "GGX"
    shader("glass", "ShaderNodeBsdfGlass", Color=GREEN, IOR=1.5, Roughness=0.5).distribution = "GGX"
    shader("refraction", "ShaderNodeBsdfRefraction", Color=RED, IOR=1.2, Roughness=0.5).distribution = "GGX"
    whole = "Transmission_Weight" if NEW else "Transmission"
    shader("window", "ShaderNodeBsdfPrincipled", Base_Color=RED, IOR=1.6, Roughness=0.5, **{whole: 1.0})
    shader("half_glass", "ShaderNodeBsdfPrincipled", Base_Color=RED, Metallic=0.2, **{whole: 0.5})
    if not NEW:
        old = shader("frosted", "ShaderNodeBsdfPrincipled", Roughness=0.2, Transmission=1.0, Transmission_Roughness=0.5)
        old.distribution = "GGX"
    shader("translucent", "ShaderNodeBsdfTranslucent", Color=GREEN)
    shader("see_through", "ShaderNodeBsdfTransparent")
    shader("oren_nayar", "ShaderNodeBsdfDiffuse", Color=RED, Roughness=0.5)
    principled = "ShaderNodeBsdfPrincipled"
    if NEW:
        shader("microfiber", "ShaderNodeBsdfSheen", Color=GREEN, Roughness=0.3).distribution = "MICROFIBER"
        shader("velvet", "ShaderNodeBsdfSheen", Color=GREEN, Roughness=0.3).distribution = "ASHIKHMIN"
        shader("fuzzy", principled, Base_Color=RED, Sheen_Weight=0.5, Sheen_Roughness=0.3, Sheen_Tint=GREEN)
    else:
        shader("velvet", "ShaderNodeBsdfVelvet", Color=GREEN, Sigma=0.3)
        shader("fuzzy", principled, Base_Color=RED, Sheen=0.5, Sheen_Tint=1.0, Roughness=0.4)
    if bpy.app.version >= (4, 3):
        shader("rough_plastic", principled, Base_Color=RED, Diffuse_Roughness=0.7)
    shader("beckmann", "ShaderNodeBsdfGlossy", Color=RED, Roughness=0.5).distribution = "BECKMANN"
    layers = {"Coat Weight" if NEW else "Clearcoat": 1.0, "Subsurface Weight" if NEW else "Subsurface": 1.0}
    shader("coated", "ShaderNodeBsdfPrincipled", Base_Color=RED, Alpha=0.5, **layers)
    feed(shader("fog", "ShaderNodeVolumePrincipled"), "Color", "ShaderNodeTexNoise")
    kind = "Coat" if NEW else "Clearcoat"
    lacquer = {"Coat Weight" if NEW else "Clearcoat": 0.5, f"{kind} Roughness": 0.5}
    shader("lacquered", "ShaderNodeBsdfPrincipled", Base_Color=RED, **lacquer)
    bumpy = shader("bumpy_beneath", "ShaderNodeBsdfPrincipled", Base_Color=RED, **lacquer)
    feed(bumpy, "Normal", "ShaderNodeBump")
    brushed = {"Roughness": 0.5, "Base_Color": RED, "Anisotropic": 0.8, "Anisotropic_Rotation": 0.25, "Metallic": 1}
    shader("brushed", "ShaderNodeBsdfPrincipled", **brushed)
    glossy = {"Color": RED, "Roughness": 0.5, "Rotation": 0.25}
    for name, anisotropy in (("across", 0.75), ("along", -0.75)):
        shader(name, "ShaderNodeBsdfAnisotropic", Anisotropy=anisotropy, **glossy).distribution = "GGX"
    if bpy.app.version >= (4, 3):
        silver = shader("silver", "ShaderNodeBsdfMetallic", Roughness=0.5, Anisotropy=0.8)
        silver.fresnel_type = "PHYSICAL_CONDUCTOR"
        silver.inputs["IOR"].default_value = (0.05, 0.06, 0.05)

    smoke = shader("smoke", "ShaderNodeBsdfDiffuse", Color=RED)
    for socket, kind in (("Volume", "ShaderNodeVolumeScatter"), ("Displacement", "ShaderNodeDisplacement")):
        feed(smoke.id_data.nodes["Material Output"], socket, kind)

    leaf, tree = parts.material("leaf")
    mix = tree.nodes.new("ShaderNodeMixShader")
    diffuse, clear = (tree.nodes.new(f"ShaderNodeBsdf{kind}") for kind in ("Diffuse", "Transparent"))
    diffuse.inputs["Color"].default_value = GREEN
    tree.links.new(clear.outputs[0], mix.inputs[1])
    tree.links.new(diffuse.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    use(leaf)

    image = bpy.data.images.new("leaf", 2, 1, alpha=True)
    feed(shader("cut_out", "ShaderNodeBsdfPrincipled"), "Alpha", "ShaderNodeTexImage", output=1).image = image
    shadowless, tree = parts.material("shadowless")
    mix = tree.nodes.new("ShaderNodeMixShader")
    for index, kind in enumerate(("Diffuse", "Transparent"), start=1):
        tree.links.new(tree.nodes.new(f"ShaderNodeBsdf{kind}").outputs[0], mix.inputs[index])
    path = tree.nodes.new("ShaderNodeLightPath")
    tree.links.new(path.outputs["Is Shadow Ray"], mix.inputs[0])
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    use(shadowless)
    glass, tree = parts.material("shining_glass")
    add = tree.nodes.new("ShaderNodeAddShader")
    for index, kind in enumerate(("BsdfTransparent", "Emission")):
        tree.links.new(tree.nodes.new(f"ShaderNode{kind}").outputs[0], add.inputs[index])
    tree.nodes["Transparent BSDF"].inputs["Color"].default_value = GREEN
    tree.links.new(add.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    use(glass)

    unknown, tree = parts.material("unknown_factor")
    mix = tree.nodes.new("ShaderNodeMixShader")
    feed(mix, mix.inputs[0].name, "ShaderNodeTexNoise")
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = RED
    tree.links.new(diffuse.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    use(unknown)

    lacquer, tree = parts.material("lacquer")
    mix = tree.nodes.new("ShaderNodeMixShader")
    for index, roughness in enumerate((0.5, 0.1), start=1):
        glossy = tree.nodes.new("ShaderNodeBsdfGlossy")
        glossy.distribution = "GGX"
        glossy.inputs["Roughness"].default_value = roughness
        glossy.inputs["Color"].default_value = (1 / index, 1 / index, 1 / index, 1)
        tree.links.new(glossy.outputs[0], mix.inputs[index])
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    use(lacquer)

    paper, tree = parts.material("paper")
    mix = tree.nodes.new("ShaderNodeMixShader")
    for index, (kind, color) in enumerate((("Diffuse", RED), ("Translucent", GREEN)), start=1):
        node = tree.nodes.new(f"ShaderNodeBsdf{kind}")
        node.inputs["Color"].default_value = color
        tree.links.new(node.outputs[0], mix.inputs[index])
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    use(paper)

    frosted, tree = parts.material("frosted_mix")
    mix = tree.nodes.new("ShaderNodeMixShader")
    for index, kind in enumerate(("Glass", "Diffuse"), start=1):
        node = tree.nodes.new(f"ShaderNodeBsdf{kind}")
        node.inputs["Color"].default_value = GREEN
        tree.links.new(node.outputs[0], mix.inputs[index])
        if kind == "Glass":
            node.distribution = "GGX"
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    use(frosted)

    many, tree = parts.material("many_highlights")
    total = None
    for roughness in (0.1, 0.2, 0.3, 0.4, 0.5):
        glossy = tree.nodes.new("ShaderNodeBsdfGlossy")
        glossy.distribution = "GGX"
        glossy.inputs["Roughness"].default_value = roughness
        if total:
            add = tree.nodes.new("ShaderNodeAddShader")
            tree.links.new(total.outputs[0], add.inputs[0])
            tree.links.new(glossy.outputs[0], add.inputs[1])
        total = add if total else glossy
    tree.links.new(total.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    use(many)


def _special() -> None:
    loop, tree = parts.material("loop")
    mix = tree.nodes.new("ShaderNodeMixShader")
    tree.links.new(mix.outputs[0], mix.inputs[1])
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    use(loop)
    use(parts.material("no_surface")[0])
    painted, tree = parts.material("painted")
    rgb = tree.nodes.new("ShaderNodeRGB")
    rgb.outputs[0].default_value = GREEN
    tree.links.new(rgb.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    use(painted)
    parts.quad("bare")
    if bpy.app.version < (5, 0):
        plain = bpy.data.materials.new("plain")
        plain.use_nodes, plain.diffuse_color = False, RED
        use(plain)


def _newer() -> Any:
    """A material and what is said of it where the core lacks an operation, as it will a newer Blender's."""
    parts.clear()
    parts.camera()
    feed(shader("wave", "ShaderNodeEmission"), "Color", "ShaderNodeVectorMath").operation = "SINE"
    core = sys.modules["pivot_core"]
    ops = core.ops
    core.ops = lambda: {name: signature for name, signature in ops().items() if name != "math_sine"}
    try:
        recording = record()
    finally:
        core.ops = ops
    return {"emission": recording.materials["wave"].emission, "reports": recording.reports}


def _override() -> Any:
    """The materials of a render whose view layer overrides them."""
    parts.clear()
    parts.camera()
    parts.quad("red", material=parts.shaded("red", "ShaderNodeBsdfDiffuse")[0])
    parts.quad("bare")
    bpy.context.view_layer.material_override = parts.shaded("clay", "ShaderNodeBsdfDiffuse")[0]
    return [group.materials for group in record().instances]
