"""The buttons that make a picture of microfacets: of an analytic distribution, a weave, a normal or a height map."""

from __future__ import annotations

import math
from typing import Any

import bpy
import numpy as np
from bpy.props import EnumProperty, FloatProperty, IntProperty, StringProperty
from numpy.typing import NDArray

from ..report import RenderError
from .draw import Lobe, Yarn, drawn
from .histogram import height_map_patches, histogram, normal_map_patches
from .image import image_texels, new_image

_DISTRIBUTIONS = (
    ("GGX", "GGX", "A sharp peak and long tails, as Principled and Glossy have it"),
    ("BECKMANN", "Beckmann", "Slopes distributed normally"),
)

_MAPS = (
    ("OPENGL", "Normal Map, OpenGL", "Normals of tangent space, green up"),
    ("DIRECTX", "Normal Map, DirectX", "Normals of tangent space, green down"),
    ("HEIGHT", "Height Map", "Heights, the red channel's"),
)


def _roughness(name: str, default: float) -> Any:
    return FloatProperty(
        name=name, description="The square of it is alpha", default=default, min=0.01, max=1.0, subtype="FACTOR"
    )


def _angle(name: str, description: str, default_degrees: float, most_degrees: float) -> Any:
    return FloatProperty(
        name=name,
        description=description,
        default=math.radians(default_degrees),
        min=-math.radians(most_degrees),
        max=math.radians(most_degrees),
        subtype="ANGLE",
    )


def _material(context: bpy.types.Context) -> bpy.types.Material | None:
    """The Properties editor's, or the active object's."""
    thing = context.active_object
    return getattr(context, "material", None) or (thing.active_material if thing else None)


class _NdfOperator:
    """Makes the picture that _picture() returns the active material's."""

    bl_options = frozenset({"REGISTER", "UNDO"})

    size: IntProperty(name="Size", description="Pixels along a side", default=512, min=64, max=2048, subtype="PIXEL")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        material = _material(context)
        return material is not None and material.library is None

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        return context.window_manager.invoke_props_dialog(self)

    def execute(self, context: bpy.types.Context) -> set[str]:
        material = _material(context)
        try:
            picture = self._picture()
        except RenderError as error:
            self.report({"ERROR"}, f"Pivot: {error}")
            return {"CANCELLED"}
        material.pivot.ndf_image = new_image(f"{material.name} NDF", picture)
        material.pivot.use_ndf_image = True
        return {"FINISHED"}


class PIVOT_OT_ndf_draw(_NdfOperator, bpy.types.Operator):
    """Draw the microfacets of a roughness, to change by hand or to compare others with"""

    bl_idname = "pivot.ndf_draw"
    bl_label = "Draw Distribution"

    distribution: EnumProperty(name="Distribution", items=_DISTRIBUTIONS, default="GGX")
    roughness_x: _roughness("Roughness X", 0.3)
    roughness_y: _roughness("Roughness Y", 0.3)
    rotation: _angle("Rotation", "From the tangent to the direction of Roughness X", 0, 180)

    def _picture(self) -> NDArray[np.float32]:
        alpha = (self.roughness_x**2, self.roughness_y**2)
        return drawn(self.size, [Lobe(alpha, self.rotation, is_beckmann=self.distribution == "BECKMANN")])


class PIVOT_OT_ndf_weave(_NdfOperator, bpy.types.Operator):
    """Draw the microfacets of a cloth: two yarns, the fibres of which rise and fall along them"""

    bl_idname = "pivot.ndf_weave"
    bl_label = "Draw Weave"

    direction_1: _angle("Direction", "From the tangent to the first yarn", 0, 180)
    along_1: _roughness("Roughness Along", 0.35)
    across_1: _roughness("Across", 0.65)
    tilt_1: _angle("Tilt", "Of fibres, one half of them each way", 18, 80)
    direction_2: _angle("Direction", "From the tangent to the second yarn", 90, 180)
    along_2: _roughness("Roughness Along", 0.3)
    across_2: _roughness("Across", 0.6)
    tilt_2: _angle("Tilt", "Of fibres, one half of them each way", 12, 80)
    share: FloatProperty(
        name="First Yarn's Share",
        description="Of the area; the second yarn has the rest",
        default=0.6,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        for yarn, name in ((1, "First Yarn"), (2, "Second Yarn")):
            column = layout.column(align=True)
            column.label(text=name)
            for setting in ("direction", "along", "across", "tilt"):
                column.prop(self, f"{setting}_{yarn}")
        layout.prop(self, "share")
        layout.prop(self, "size")

    def _picture(self) -> NDArray[np.float32]:
        yarns = (
            Yarn(self.direction_1, self.along_1**2, self.across_1**2, self.tilt_1, self.share),
            Yarn(self.direction_2, self.along_2**2, self.across_2**2, self.tilt_2, 1 - self.share),
        )
        return drawn(self.size, [lobe for yarn in yarns for lobe in yarn.lobes()])


class PIVOT_OT_ndf_from_map(_NdfOperator, bpy.types.Operator):
    """Gather the normals of a normal map or a height map, for a surface so far away that the map is not seen"""

    bl_idname = "pivot.ndf_from_map"
    bl_label = "From Normal or Height Map"

    image: StringProperty(name="Image", description="The map; it repeats")
    kind: EnumProperty(name="Kind", items=_MAPS, default="OPENGL")
    height: FloatProperty(
        name="Height",
        description="How far white is above black, in metres of a metre of the map's width",
        default=0.05,
        soft_min=0.0,
        soft_max=1.0,
    )
    roughness: FloatProperty(
        name="Roughness",
        description="Of the surface with the map, as Principled means it: 0 is a mirror, and less than 0.1 is as 0.1",
        default=0.0,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        layout.prop_search(self, "image", bpy.data, "images")
        layout.prop(self, "kind")
        if self.kind == "HEIGHT":
            layout.prop(self, "height")
        layout.prop(self, "roughness")
        layout.prop(self, "size")

    def _picture(self) -> NDArray[np.float32]:
        image = bpy.data.images.get(self.image)
        if image is None:
            named = f"there is no image '{self.image}'" if self.image else "no image is chosen"
            raise RenderError(f"{named} to take normals from. Fix: choose a normal or height map")
        space = image.colorspace_settings
        if not space.is_data:
            raise RenderError(
                f"image '{image.name}': its numbers are colors of the space {space.name}. Fix: set its Color Space to "
                "Non-Color"
            )
        texels = image_texels(image)
        if not np.isfinite(texels).all():
            raise RenderError(f"image '{image.name}': some of its pixels are not finite. Fix: choose another image")
        try:
            patches = self._patches(texels)
            return histogram(self.size, patches, texels.shape[0] * texels.shape[1], self.roughness**2)
        except ValueError as error:
            raise RenderError(f"image '{image.name}': {error}. Fix: choose another image, or Height Map") from error

    def _patches(self, texels: NDArray[np.float32]) -> Any:
        if self.kind == "HEIGHT":
            return height_map_patches(texels[..., 0], self.height)
        if texels.shape[2] < 3:
            raise ValueError("it has a single channel, a normal map has three")
        return normal_map_patches(texels, is_directx=self.kind == "DIRECTX")


_CLASSES = (PIVOT_OT_ndf_draw, PIVOT_OT_ndf_weave, PIVOT_OT_ndf_from_map)


def register() -> None:
    for cls in _CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
