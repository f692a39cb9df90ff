"""Render passes: what the core calls them, what each Blender calls them, and how they reach a render layer."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from .export.mattes import Mattes
from .named_passes import NamedPass, named_passes
from .report import Reporter


@dataclass(frozen=True)
class Pass:
    core_name: str  # of Session.read
    name: str  # in Blender before 5.0
    name_5_0: str
    channels: str
    kind: str  # of RenderEngine.register_pass
    switch: str
    settings: str = ""  # the part of bpy.types.ViewLayer that has the switch: "pivot", or "cycles" with its addon
    of_surfaces: bool = False  # kept only where one of them is on
    is_light: bool = False  # that Monte Carlo alone tells apart
    is_exposed: bool = False  # light, which the film's exposure scales

    def blender_name(self, version: tuple[int, ...] = bpy.app.version) -> str:
        return self.name_5_0 if version >= (5, 0) else self.name

    def switches(self, view_layer: bpy.types.ViewLayer) -> Any | None:
        """What has the switch, None without the addon."""
        return getattr(view_layer, self.settings, None) if self.settings else view_layer

    def is_on(self, view_layer: bpy.types.ViewLayer) -> bool:
        return getattr(self.switches(view_layer), self.switch, False)


def _of_surfaces(name: str, name_5_0: str, channels: str, kind: str, switch: str) -> Pass:
    return Pass(name, name, name_5_0, channels, kind, f"use_pass_{switch}", of_surfaces=True)


def _light(name: str, name_5_0: str, switch: str) -> Pass:
    return replace(_of_surfaces(name, name_5_0, "RGB", "COLOR", switch), is_light=True, is_exposed=True)


_DIFFUSE_COLOR = Pass("DiffCol", "DiffCol", "Diffuse Color", "RGB", "COLOR", "use_pass_diffuse_color")

SHADOW_CATCHER = "Shadow Catcher"

PASSES = (
    Pass("Combined", "Combined", "Combined", "RGBA", "COLOR", "use_pass_combined", is_exposed=True),
    Pass("Depth", "Depth", "Depth", "Z", "VALUE", "use_pass_z"),
    Pass("Normal", "Normal", "Normal", "XYZ", "VECTOR", "use_pass_normal"),
    Pass("Position", "Position", "Position", "XYZ", "VECTOR", "use_pass_position"),
    _DIFFUSE_COLOR,
    Pass("Emit", "Emit", "Emission", "RGB", "COLOR", "use_pass_emit", is_exposed=True),
    Pass(
        "VolumeDir", "VolumeDir", "Volume Direct", "RGB", "COLOR", "use_pass_volume_direct", "cycles", is_exposed=True
    ),
    Pass(
        "VolumeInd",
        "VolumeInd",
        "Volume Indirect",
        "RGB",
        "COLOR",
        "use_pass_volume_indirect",
        "cycles",
        is_exposed=True,
    ),
    Pass("Indirect", "Indirect", "Indirect", "RGB", "COLOR", "use_pass_indirect", "pivot", is_exposed=True),
    Pass(
        "Noisy Image",
        "Noisy Image",
        "Noisy Image",
        "RGBA",
        "COLOR",
        "denoising_store_passes",
        "cycles",
        is_exposed=True,
    ),
    Pass(
        "Denoising Normal", "Denoising Normal", "Denoising Normal", "XYZ", "VECTOR", "denoising_store_passes", "cycles"
    ),
    Pass(
        "Denoising Albedo", "Denoising Albedo", "Denoising Albedo", "RGB", "COLOR", "denoising_store_passes", "cycles"
    ),
    Pass("Depth", "Denoising Depth", "Denoising Depth", "Z", "VALUE", "denoising_store_passes", "cycles"),
    _light("DiffDir", "Diffuse Direct", "diffuse_direct"),
    _light("DiffInd", "Diffuse Indirect", "diffuse_indirect"),
    _light("GlossDir", "Glossy Direct", "glossy_direct"),
    _light("GlossInd", "Glossy Indirect", "glossy_indirect"),
    _light("TransDir", "Transmission Direct", "transmission_direct"),
    _light("TransInd", "Transmission Indirect", "transmission_indirect"),
    _of_surfaces("GlossCol", "Glossy Color", "RGB", "COLOR", "glossy_color"),
    _of_surfaces("TransCol", "Transmission Color", "RGB", "COLOR", "transmission_color"),
    replace(_of_surfaces("Env", "Environment", "RGB", "COLOR", "environment"), is_exposed=True),
    _of_surfaces("AO", "Ambient Occlusion", "RGB", "COLOR", "ambient_occlusion"),
    _of_surfaces("UV", "UV", "UVA", "VECTOR", "uv"),
    _of_surfaces("Vector", "Vector", "XYZW", "VECTOR", "vector"),
    _of_surfaces("Mist", "Mist", "Z", "VALUE", "mist"),
    _of_surfaces("IndexOB", "Object Index", "X", "VALUE", "object_index"),
    _of_surfaces("IndexMA", "Material Index", "X", "VALUE", "material_index"),
    Pass(SHADOW_CATCHER, SHADOW_CATCHER, SHADOW_CATCHER, "RGB", "COLOR", "use_pass_shadow_catcher", "cycles"),
    Pass("Method", "Method", "Method", "RGB", "COLOR", "use_pass_method", "pivot"),
    Pass("Error", "Error", "Error", "X", "VALUE", "use_pass_error", "pivot"),
)


@dataclass(frozen=True)
class MattePasses:
    """Cryptomatte's passes of one kind of ids: each two ranks of an id and its share of the pixel."""

    kind: str  # of Session.read_mattes, and of mattes.Mattes
    name: str  # before a number of two digits
    switch: str

    def names(self, view_layer: bpy.types.ViewLayer) -> list[str]:
        """Of those that this view layer gets."""
        count = (view_layer.pass_cryptomatte_depth + 1) // 2 if getattr(view_layer, self.switch) else 0
        return [f"{self.name}{number:02d}" for number in range(count)]


MATTES = (
    MattePasses("OBJECT", "CryptoObject", "use_pass_cryptomatte_object"),
    MattePasses("MATERIAL", "CryptoMaterial", "use_pass_cryptomatte_material"),
    MattePasses("ASSET", "CryptoAsset", "use_pass_cryptomatte_asset"),
)


def has_mattes(view_layer: bpy.types.ViewLayer) -> bool:
    return any(mattes.names(view_layer) for mattes in MATTES)


def read_mattes(session: Any, pass_name: str) -> NDArray[np.float32] | None:
    """A pass of mattes by Blender's name, None where it is another."""
    for mattes in MATTES:
        if pass_name.startswith(mattes.name):
            return session.read_mattes(mattes.kind, 2 * int(pass_name[len(mattes.name) :]))
    return None


def stamp_mattes(result: bpy.types.RenderResult, mattes: Mattes, view_layer: bpy.types.ViewLayer) -> None:
    """Tell the file which names the ids stand for."""
    for entry in MATTES:
        if entry.names(view_layer):
            for field, value in mattes.metadata(entry.kind, view_layer.name, entry.name).items():
                result.stamp_data_add_field(field=field, value=value)


def register_passes(engine: bpy.types.RenderEngine, scene: bpy.types.Scene, view_layer: bpy.types.ViewLayer) -> None:
    """Tell Blender which passes this view layer will get."""
    for entry in PASSES:
        if entry.is_on(view_layer):
            engine.register_pass(
                scene, view_layer, entry.blender_name(), len(entry.channels), entry.channels, entry.kind
            )
    for mattes in MATTES:
        for name in mattes.names(view_layer):
            engine.register_pass(scene, view_layer, name, 4, "RGBA", "COLOR")
    for named in named_passes(view_layer):
        engine.register_pass(scene, view_layer, named.name, len(named.channels), named.channels, named.kind)


def has_denoising_passes(view_layer: bpy.types.ViewLayer) -> bool:
    """Whether this view layer gets what a denoiser works on."""
    return any(entry.is_on(view_layer) for entry in PASSES if entry.switch == "denoising_store_passes")


def has_surface_passes(view_layer: bpy.types.ViewLayer) -> bool:
    """Whether this view layer gets what passes tell of surfaces and of the light that these reflect."""
    return any(entry.is_on(view_layer) for entry in PASSES if entry.of_surfaces)


def report_passes(scene: bpy.types.Scene, view_layer: bpy.types.ViewLayer, reporter: Reporter) -> None:
    """Say which passes of this view layer stay black."""
    if view_layer.use_pass_vector and scene.render.use_motion_blur and view_layer.use_motion_blur:
        reporter.warn(
            f"view layer '{view_layer.name}': with Motion Blur its Vector pass is black. Fix: use one of the two"
        )
    if scene.pivot.integrator == "ANALYTIC" and any(entry.is_light and entry.is_on(view_layer) for entry in PASSES):
        reporter.warn(
            f"view layer '{view_layer.name}': in the analytic integrator passes of direct and indirect light by "
            "reflection are black. Fix: use Monte Carlo"
        )


def channel_count(view_layer: bpy.types.ViewLayer) -> int:
    """Channels of all passes that this view layer gets."""
    of_mattes = 4 * sum(len(mattes.names(view_layer)) for mattes in MATTES)
    of_named = sum(len(named.channels) for named in named_passes(view_layer))
    return of_mattes + of_named + sum(len(entry.channels) for entry in PASSES if entry.is_on(view_layer))


def film_exposure(scene: bpy.types.Scene) -> float:
    """What light is multiplied by before it becomes a picture: Cycles' own setting, 1 where there is no Cycles."""
    return scene.cycles.film_exposure if hasattr(scene, "cycles") else 1.0


def exposed(pixels: NDArray[np.float32], exposure: float) -> NDArray[np.float32]:
    """Colours, (height, width, 3 or 4), as bright as the film's exposure makes them."""
    return pixels if exposure == 1 else pixels * np.array([exposure] * 3 + [1.0], np.float32)[: pixels.shape[-1]]


def fill_layer(
    layer: Any,
    width: int,
    height: int,
    named: list[NamedPass],
    read: Callable[[str], NDArray[np.float32]],
    exposure: float,
) -> None:
    """Write what has been rendered into every pass of a bpy.types.RenderLayer.

    read: takes the core's pass name, that of mattes or of a named pass; returns (height, width, channels) float32,
    bottom row first. exposure: of the film. A pass that is not Pivot's (Freestyle's, say) becomes zero.
    """
    exposures = {entry.blender_name(): exposure for entry in PASSES if entry.is_exposed}
    exposures |= {entry.name: exposure for entry in named if entry.is_light_group}
    core_names = {entry.blender_name(): entry.core_name for entry in PASSES}
    core_names |= {target.name: target.name for target in layer.passes if target.name.startswith("Crypto")}
    core_names |= {entry.name: entry.name for entry in named}
    if any(entry.of_surfaces and entry.blender_name() in layer.passes for entry in PASSES):
        core_names[_DIFFUSE_COLOR.blender_name()] = "Diffuse Color"  # what the light passes are to be multiplied by
    pixels = [
        np.ravel(exposed(read(core_names[target.name]), exposures.get(target.name, 1.0)))
        if target.name in core_names
        else np.zeros(width * height * target.channels, np.float32)
        for target in layer.passes
    ]
    layer.passes.foreach_set("rect", np.concatenate(pixels))
