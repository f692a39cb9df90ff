"""Materials whose microfacets' normals are distributed as an image says."""

from __future__ import annotations

from dataclasses import replace

import bpy

from ..report import RenderError, naming
from .context import Context
from .nodes import Owner
from .program import Program, Value
from .shader import MAX_LOBES
from .surface import Surface


def with_ndf(surface: Surface, material: bpy.types.Material, owner: Owner, context: Context) -> Surface:
    """The surface with the material's picture of its microfacets in the place of its roughness, if it has one."""
    if not material.pivot.use_ndf_image:
        return surface
    image = material.pivot.ndf_image
    if image is None:
        owner.reporter.warn(
            f"{owner.name}: its microfacets are to be an image's, but none is chosen, it keeps its roughness. "
            "Fix: choose one in its panel Microfacets from Image"
        )
        return surface
    try:
        with naming(f"image '{image.name}'", "choose another picture of microfacets, or draw one anew"):
            table = context.images.ndf(image)
    except RenderError as error:
        raise RenderError(f"{owner.name}, {error}") from error
    beneath = [highlight for highlight in surface.highlights if not highlight.is_coat]
    surface, exact = surface.without_axes(*beneath).within(MAX_LOBES - 1)
    if not exact:
        owner.reporter.warn(
            f"{owner.name}: more than {MAX_LOBES} lobes with microfacets of an image are not supported, the weakest "
            "highlights are shown as one"
        )
    return replace(surface, ndf=table, tangent=_tangent(owner.program))


def _tangent(program: Program) -> Value:
    """Along u of the UV map that is active for rendering; of meshes without one, around z as Cycles has it."""

    def attribute(name: str) -> Value:
        return program.op("attribute", settings=[program.attribute_id(name), 0.0])[:3]

    centred = attribute("generated:") - 0.5
    around = program.joined(0.0 - centred[1], centred[0], program.number(0.0))
    return program.op("tangent", attribute("tangent:") + around * 1e-4)  # too little to turn one that is there
