"""Nodes of textures that are computed: noise, cells, waves, bricks.

Where Blender's versions differ, these follow the one that runs.
[Cycles' kernel/svm of 3.4, 4.0, 4.1, 4.2, 4.5, 5.0, 5.2]
"""

from __future__ import annotations

import math
from collections.abc import Callable

import bpy

from ..program import Value
from .geometry import generated
from .row import Node, Row
from .texture_mapping import mapped

_DEEPEST = 15.0  # octaves beyond the first
_BIAS, _SHRINK = 1e-6, 0.999999  # that keep whole numbers off the edges of a pattern


def texture_vector(node: Node) -> Value:
    """Where a texture is looked up: what its Vector is linked to, else generated coordinates; by its mapping."""
    return mapped(node.vector("Vector") if node.is_linked("Vector") else generated(node), node.node.texture_mapping)


def _point(node: Node, dimensions: int) -> Value:
    """Where a texture of so many dimensions is looked up: its Vector, its W or both, scaled."""
    axes = []
    if dimensions > 1:
        vector = texture_vector(node)
        axes = [vector[i] for i in range(min(dimensions, 3))]
    if dimensions in {1, 4}:
        axes.append(node.number("W"))
    scale = node.number("Scale")
    return node.program.joined(*(axis * scale for axis in axes))


def _octaves(detail: Value) -> Value:
    """From how many there are beyond the first."""
    return detail.at_least(0.0).at_most(_DEEPEST) + 1.0


def _noise_op(node: Node, name: str, point: Value, *inputs: Value) -> Value:
    wraps = bpy.app.version >= (4, 2)
    return node.op(f"{name}_{len(point.parts)}d", point, *inputs, settings=[wraps])


_OFFSETS = {"HETERO_TERRAIN": ("Offset",), "HYBRID_MULTIFRACTAL": ("Offset", "Gain")}
_OFFSETS["RIDGED_MULTIFRACTAL"] = _OFFSETS["HYBRID_MULTIFRACTAL"]


def _fractal(node: Node, kind: str, is_normalized: bool, *inputs: Value) -> Callable[[Value], Value]:
    """A fractal of a type of Blender's, of the octaves, roughness and lacunarity that are inputs."""
    op = f"noise_{kind.lower()}{'_normalized' if kind == 'FBM' and is_normalized else ''}"
    offsets = [node.number(name) for name in _OFFSETS.get(kind, ())]
    return lambda point: _noise_op(node, op, point, *inputs, *offsets)


def _moved(node: Node, point: Value, seed: int) -> Value:
    """Moved far enough that the noise there is another one."""
    count = len(point.parts)
    seeds = [[seed] if count == 1 else [seed, axis] for axis in range(count)]
    random = [node.op(f"white_noise_{len(key)}d", node.program.joined(*map(node.program.number, key))) for key in seeds]
    return node.program.joined(*(point[i] + (random[i] * 100.0 + 100.0) for i in range(count)))


def _noise(node: Node) -> Value:
    settings = node.node
    dimensions = int(settings.noise_dimensions[0])
    point = _point(node, dimensions)
    distortion = node.number("Distortion")
    if not distortion.is_always(0.0):
        noises = [_noise_op(node, "noise", _moved(node, point, seed)) for seed in range(dimensions)]
        point = node.program.joined(*(point[i] + noises[i] * distortion for i in range(dimensions)))
    roughness = node.number("Roughness").at_least(0.0)
    fractal = _fractal(
        node,
        getattr(settings, "noise_type", "FBM"),  # from Blender 4.1
        getattr(settings, "normalize", True),  # from 4.0, as Lacunarity
        _octaves(node.number("Detail")),
        roughness if bpy.app.version >= (4, 1) else roughness.at_most(1.0),
        node.number("Lacunarity") if node.has("Lacunarity") else node.program.number(2.0),
    )
    if node.output != "Color":
        return fractal(point)
    return node.program.joined(fractal(point), *(fractal(_moved(node, point, dimensions + i)) for i in range(2)))


def _musgrave(node: Node) -> Value:
    """Before Blender 4.1. Its octaves are one less than those of Noise."""
    kind = node.node.musgrave_type
    lacunarity = node.number("Lacunarity").at_least(1e-5)
    roughness = node.program.each("math_power", lacunarity, 0.0 - node.number("Dimension").at_least(1e-5))
    octaves = node.number("Detail").at_least(0.0).at_most(_DEEPEST)
    if kind == "HETERO_TERRAIN":  # which has its first octave in full, and then that part of the second
        octaves = octaves + node.program.each("math_less_than", octaves, 1.0)
    point = _point(node, int(node.node.musgrave_dimensions[0]))
    return _fractal(node, kind, False, octaves, roughness, lacunarity)(point)


_METRICS = ("EUCLIDEAN", "MANHATTAN", "CHEBYCHEV", "MINKOWSKI")
_VORONOI_OUTPUTS = {"Distance": slice(0, 1), "Color": slice(1, 4), "Position": slice(4, 7), "W": slice(7, 8)}


def _voronoi(node: Node) -> Value:
    settings = node.node
    feature, metric = settings.feature, settings.distance
    has_octaves = node.has("Detail")  # from Blender 4.0
    zero = node.program.number(0.0)
    point = _point(node, int(settings.voronoi_dimensions[0]))
    octaves = [zero, zero, zero]
    if has_octaves:
        detail = node.number("Detail").at_least(0.0).at_most(_DEEPEST)
        octaves = [detail, node.number("Roughness").clamped(), node.number("Lacunarity")]
    inputs = [node.number("Randomness").clamped()]
    if feature in {"F1", "F2", "SMOOTH_F1"}:
        smoothness = (node.number("Smoothness") / 2.0).at_least(0.0).at_most(0.5) if feature == "SMOOTH_F1" else zero
        exponent = node.number("Exponent") if metric == "MINKOWSKI" else zero
        inputs = [*octaves, smoothness, exponent, *inputs]
    elif feature == "DISTANCE_TO_EDGE":
        inputs = [*octaves, *inputs]
    is_bounded, has_new_hash = not has_octaves, bpy.app.version >= (5, 0)
    numbers = [_METRICS.index(metric), getattr(settings, "normalize", False), is_bounded, has_new_hash]
    result = node.op(f"voronoi_{feature.lower()}_{len(point.parts)}d", point, *inputs, settings=numbers)
    if len(result.parts) == 1:
        return result
    value = result[_VORONOI_OUTPUTS[node.output]]
    return value / node.number("Scale") if node.output in {"Position", "W"} else value


def _wave(node: Node) -> Value:
    settings = node.node
    point = (texture_vector(node) * node.number("Scale") + _BIAS) * _SHRINK
    if settings.wave_type == "BANDS":
        direction = settings.bands_direction
        wave = (
            (point[0] + point[1] + point[2]) * 10.0 if direction == "DIAGONAL" else point["XYZ".index(direction)] * 20.0
        )
    else:
        axes = [0.0 if axis == settings.rings_direction else 1.0 for axis in "XYZ"]
        wave = node.op("vector_length", point * node.program.colour(axes)) * 20.0
    wave = wave + node.number("Phase Offset")
    distortion = node.number("Distortion")
    if not distortion.is_always(0.0):
        roughness = node.number("Detail Roughness")
        noise = _fractal(
            node,
            "FBM",
            True,
            _octaves(node.number("Detail")),
            roughness if bpy.app.version >= (4, 1) else roughness.clamped(),
            node.program.number(2.0),
        )
        wave = wave + distortion * (noise(point * node.number("Detail Scale")) * 2.0 - 1.0)
    each = node.program.each
    if settings.wave_profile == "SIN":
        return each("math_sine", wave - math.pi / 2) * 0.5 + 0.5
    wave = wave / (2 * math.pi)
    if settings.wave_profile == "SAW":
        return each("math_fract", wave)
    return each("math_absolute", wave - each("math_floor", wave + 0.5)) * 2.0


def _magic(node: Node) -> Value:
    point, scale = texture_vector(node), node.number("Scale")
    if bpy.app.version >= (5, 2):  # turns are cut off what is scaled, not what is given
        point, scale = point * scale, node.program.number(1.0)
    result = node.op("magic", point, scale, node.number("Distortion"), settings=[node.node.turbulence_depth])
    return result if node.output == "Color" else result.mean()


def _brick(node: Node) -> Value:
    settings = node.node
    point = (texture_vector(node) * node.number("Scale"))[:2]
    inputs = [node.number(name) for name in ("Mortar Size", "Mortar Smooth", "Bias", "Brick Width", "Row Height")]
    numbers = [settings.offset, settings.offset_frequency, settings.squash, settings.squash_frequency]
    result = node.op("brick", point, *inputs, settings=numbers)
    tint, mortar = result[0], result[1]
    if node.output != "Color":
        return mortar
    mixed = node.program.mixed
    return mixed(mortar, mixed(tint, node.colour("Color1"), node.colour("Color2")), node.colour("Mortar"))


def _checker(node: Node) -> Value:
    each = node.program.each
    cell = each("math_floor", (texture_vector(node) * node.number("Scale") + _BIAS) * _SHRINK)
    is_odd = each("math_floored_modulo", cell[0] + cell[1] + cell[2], 2.0)
    if node.output != "Color":
        return is_odd
    return node.program.mixed(is_odd, node.colour("Color2"), node.colour("Color1"))


def _gabor(node: Node) -> Value:
    point, flat = texture_vector(node) * node.number("Scale"), node.node.gabor_type == "2D"
    isotropy = 1.0 - node.number("Anisotropy").clamped()
    orientation = node.number("Orientation 2D") if flat else node.vector("Orientation 3D")
    result = node.op(
        "gabor_2d" if flat else "gabor_3d",
        point[:2] if flat else point,
        node.number("Frequency"),
        isotropy,
        orientation,
    )
    return result[("Value", "Phase", "Intensity").index(node.output)]


def _gradient(node: Node) -> Value:
    kind, point = node.node.gradient_type, texture_vector(node)
    x = point[0]
    if kind == "QUADRATIC":
        x = x.at_least(0.0)
        x = x * x
    elif kind == "EASING":
        x = x.clamped()
        x = x * x * (3.0 - 2.0 * x)
    elif kind == "DIAGONAL":
        x = (x + point[1]) * 0.5
    elif kind == "RADIAL":
        x = node.program.each("math_arctan2", point[1], x) / (2 * math.pi) + 0.5
    elif kind in {"SPHERICAL", "QUADRATIC_SPHERE"}:
        x = (_SHRINK - node.op("vector_length", point)).at_least(0.0)
        x = x * x if kind == "QUADRATIC_SPHERE" else x
    return x.clamped()


def _white_noise(node: Node) -> Value:
    dimensions = int(node.node.noise_dimensions[0])
    axes = [node.vector("Vector")[: min(dimensions, 3)]] if dimensions > 1 else []
    axes += [node.number("W")] if dimensions in {1, 4} else []
    name = "white_noise_color" if node.output == "Color" else "white_noise"
    return node.op(f"{name}_{dimensions}d", node.program.joined(*axes))


ROWS: dict[str, Row] = {
    "TEX_NOISE": _noise,
    "TEX_MUSGRAVE": _musgrave,
    "TEX_VORONOI": _voronoi,
    "TEX_WAVE": _wave,
    "TEX_MAGIC": _magic,
    "TEX_BRICK": _brick,
    "TEX_CHECKER": _checker,
    "TEX_GABOR": _gabor,
    "TEX_GRADIENT": _gradient,
    "TEX_WHITE_NOISE": _white_noise,
}
