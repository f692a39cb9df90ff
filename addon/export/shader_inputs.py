"""What inputs of shader nodes mean, whichever node has them."""

from __future__ import annotations

from .nodes import Owner, Socket, colour, number
from .program import Value
from .surface import Surface


def ggx_alpha(feed: Socket, owner: Owner) -> Value:
    """GGX alpha of a shader with a Roughness."""
    if getattr(feed.node, "distribution", "") == "SHARP":
        return owner.program.number(0.0)
    roughness = number(feed.input("Roughness"), owner).clamped()
    return roughness * roughness


def is_multiscatter(feed: Socket, owner: Owner) -> bool:
    """Whether the core gives back what single scattering between microfacets loses."""
    distribution = feed.node.distribution
    if distribution not in {"GGX", "MULTI_GGX", "SHARP", "BECKMANN", "ASHIKHMIN_SHIRLEY"}:
        name = feed.node.bl_rna.properties["distribution"].enum_items[distribution].name
        owner.warn(feed.node, f"{name} is not supported, it is shown as GGX")
    return distribution == "MULTI_GGX"


def is_beckmann(feed: Socket) -> bool:
    return feed.node.distribution == "BECKMANN"


def any_ior(feed: Socket, owner: Owner) -> Value:
    return number(feed.input("IOR"), owner).at_least(1e-5)


def emitted(tint: Socket, strength: Socket, owner: Owner) -> Value:
    factor = number(strength, owner)
    return owner.program.colour((0, 0, 0)) if factor.is_always(0) else colour(tint, owner, unknown=1.0) * factor


def let_through(tint: Value) -> Surface:
    return Surface.of(tint.program, transparency=tint.widened(), opacity=tint.program.number(0.0))
