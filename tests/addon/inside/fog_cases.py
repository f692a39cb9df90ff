"""Fog as exported: media of materials and the world, and what is said of them."""

from __future__ import annotations

import sys
from dataclasses import asdict
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import parts
from recording import record

HAS_PHASES = bpy.app.version >= (4, 3)
COLOR, OTHER = (0.8, 0.4, 0.2, 1), (0.25, 0.09, 0.04, 1)


def main(folder: Path) -> Any:
    parts.clear()
    parts.camera()
    for make in (_exact, _mixes, _phases, _reported):
        make()
    recording = record()
    return {
        "media": {name: medium and asdict(medium) for name, medium in recording.media.items()},
        "without_surface": sorted(recording.without_surface),
        "reports": recording.reports,
        "slots": [_slots(*slots) for slots in ((0, 1, 2), (2, 2, 2), (0, 0, 7))],
        "analytic": [_analytic(*radiance) for radiance in ((0, 0, 0), (0, 0, 1))],
        "worlds": [_world(surface) for surface in (True, False)],
        "cosines": _mean_cosines(),
    }


def fog(name: str, kind: str, **inputs: Any) -> Any:
    """A used material of one volume node; returns the node."""
    material, tree = parts.material(name)
    node = tree.nodes.new(kind)
    for key, value in inputs.items():
        node.inputs[key.replace("_", " ")].default_value = value
    tree.links.new(node.outputs[0], tree.nodes["Material Output"].inputs["Volume"])
    parts.quad(f"{name} quad", material=material)
    return node


def _exact() -> None:
    fog("scatter", "ShaderNodeVolumeScatter", Color=COLOR, Density=3, Anisotropy=0.5)
    fog("mirror", "ShaderNodeVolumeScatter", Color=COLOR, Anisotropy=1)
    fog("absorption", "ShaderNodeVolumeAbsorption", Color=COLOR, Density=2)
    fog("bright", "ShaderNodeVolumeAbsorption", Color=(2, 0.5, 0.5, 1))
    fog("empty", "ShaderNodeVolumeScatter", Density=0)
    fog("negative", "ShaderNodeVolumeScatter", Density=-1)
    fog("emission", "ShaderNodeEmission", Color=COLOR, Strength=5)
    fog("principled", "ShaderNodeVolumePrincipled", Color=COLOR, Density=2, Absorption_Color=OTHER, Anisotropy=-0.25)
    fog("glow", "ShaderNodeVolumePrincipled", Density=0, Emission_Color=COLOR, Emission_Strength=4)
    fog(
        "fire", "ShaderNodeVolumePrincipled", Density=0, Blackbody_Intensity=0.5, Blackbody_Tint=COLOR, Temperature=2000
    )
    node = fog("milky", "ShaderNodeVolumeScatter", Color=COLOR)
    tree = node.id_data
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    tree.links.new(diffuse.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    node = fog("own_phase", "ShaderNodeVolumeScatter", Color=COLOR, Anisotropy=0.5)
    bpy.data.materials["own_phase"].pivot.phase = "PIVOT"
    math = fog("folded", "ShaderNodeVolumeScatter", Color=COLOR)
    value = math.id_data.nodes.new("ShaderNodeMath")
    value.operation, value.inputs[0].default_value, value.inputs[1].default_value = "MULTIPLY", 3, 4
    math.id_data.links.new(value.outputs[0], math.inputs["Density"])


def _mixes() -> None:
    for name, kind in (("mixed", "ShaderNodeMixShader"), ("added", "ShaderNodeAddShader")):
        mix = fog(name, kind)
        tree = mix.id_data
        if name == "mixed":
            mix.inputs[0].default_value = 0.25
        first = 1 if name == "mixed" else 0
        forward, absorbing = (tree.nodes.new(f"ShaderNodeVolume{each}") for each in ("Scatter", "Principled"))
        forward.inputs["Color"].default_value, forward.inputs["Anisotropy"].default_value = COLOR, 0.8
        absorbing.inputs["Color"].default_value, absorbing.inputs["Density"].default_value = OTHER, 2
        for index, node in enumerate((forward, absorbing), start=first):
            tree.links.new(node.outputs[0], mix.inputs[index])
    same = fog("same_lobe", "ShaderNodeAddShader")
    for index in (0, 1):
        node = same.id_data.nodes.new("ShaderNodeVolumeScatter")
        node.inputs["Color"].default_value = COLOR
        same.id_data.links.new(node.outputs[0], same.inputs[index])


def _phases() -> None:
    if not HAS_PHASES:
        return
    inputs = {"Color": COLOR, "Density": 2, "Anisotropy": 0.5, "Alpha": 2, "Backscatter": 0.125, "Diameter": 10}
    for phase in ("FOURNIER_FORAND", "DRAINE", "RAYLEIGH", "MIE"):
        node = fog(phase, "ShaderNodeVolumeScatter")
        node.phase = phase
        for socket in node.inputs:  # those of the other phase functions have no name
            if socket.identifier in inputs:
                socket.default_value = inputs[socket.identifier]
    node = fog("coefficients", "ShaderNodeVolumeCoefficients", Anisotropy=0.5)
    for name, value in (("Scatter", (1, 2, 3)), ("Absorption", (4, 5, 6)), ("Emission", (7, 8, 9))):
        node.inputs[f"{name} Coefficients"].default_value = value


def _reported() -> None:
    noisy = fog("noisy", "ShaderNodeVolumeScatter", Color=COLOR)
    noise = noisy.id_data.nodes.new("ShaderNodeTexNoise")
    noisy.id_data.links.new(noise.outputs[0], noisy.inputs["Anisotropy"])
    fog("surface", "ShaderNodeBsdfDiffuse")


def _slots(*slots: int) -> Any:
    """A strip of faces of these slots: a surface, fog with one, and fog without. What is exported of each part."""
    parts.clear()
    parts.camera()
    mesh = bpy.data.meshes.new("strip")
    corners = [(x, y, 0) for x in range(4) for y in range(2)]
    mesh.from_pydata(corners, [], [(2 * x, 2 * x + 2, 2 * x + 3, 2 * x + 1) for x in range(3)])
    parts.link("strip", mesh)
    parts.shaded("grey", "ShaderNodeBsdfDiffuse")
    fog("clear", "ShaderNodeVolumeScatter")
    milky = fog("milky", "ShaderNodeVolumeScatter").id_data
    diffuse = milky.nodes.new("ShaderNodeBsdfDiffuse")
    milky.links.new(diffuse.outputs[0], milky.nodes["Material Output"].inputs["Surface"])
    for name in ("grey", "milky", "clear"):
        mesh.materials.append(bpy.data.materials[name])
    mesh.polygons.foreach_set("material_index", slots)
    recording = record()
    strips = [group for group in recording.instances if group.name == "strip"]
    arrays = [recording.meshes[group.mesh] for group in strips]
    return [
        {
            "materials": group.materials,
            "slots": None if mesh.triangle_slots is None else mesh.triangle_slots.tolist(),
            "triangles": len(mesh.triangle_corners),
        }
        for group, mesh in zip(strips, arrays, strict=True)
    ]


def _analytic(*radiance: float) -> list[str]:
    """What is said of fog that scatters, and of fog that does not, in a world of this light."""
    parts.clear()
    parts.camera()
    parts.world(radiance)
    fog("scatter", "ShaderNodeVolumeScatter")
    fog("absorption", "ShaderNodeVolumeAbsorption")
    bpy.context.scene.pivot.integrator = "ANALYTIC"
    return record().reports


def _world(has_surface: bool) -> Any:
    """What fills a world, and its light."""
    parts.clear()
    parts.camera()
    tree = parts.world((0.5, 0.25, 1)).node_tree
    node = tree.nodes.new("ShaderNodeVolumeScatter")
    node.inputs["Color"].default_value, node.inputs["Density"].default_value = COLOR, 0.5
    output = next(each for each in tree.nodes if each.type == "OUTPUT_WORLD")
    tree.links.new(node.outputs[0], output.inputs["Volume"])
    if not has_surface:
        tree.links.remove(output.inputs["Surface"].links[0])
    recording = record()
    return {
        "medium": asdict(recording.world_medium),
        "radiance": recording.world,
        "reports": recording.reports,
    }


def _mean_cosines() -> Any:
    """Draine's, and the share that Henyey-Greenstein scatters backwards, by the addon and by sums over mu."""
    phase = sys.modules["pivot.export.phase"]
    mu = (np.arange(200000) + 0.5) / 100000 - 1

    def draine(g: float, alpha: float) -> Any:
        return (1 + alpha * mu * mu) / (1 + g * g - 2 * g * mu) ** 1.5

    backwards = []
    for share in (0.4, 0.125, 0.01):
        g = phase.henyey_greenstein_of_backscatter(share)
        p = draine(g, 0.0)
        backwards.append((share, p[mu < 0].sum() / p.sum()))
    means = []
    for g, alpha in ((0.5, 2.0), (-0.3, 10.0), (0.0, 5.0)):
        p = draine(g, alpha)
        means.append((phase.draine_mean_cosine(g, alpha), (p * mu).sum() / p.sum()))
    return {"backwards": backwards, "means": means}
