"""The node kinds that random graphs draw from, and the ranges of their inputs.

A kind is a node's bl_idname without "ShaderNode". Kinds, sockets and settings that a Blender lacks are not drawn there:
enums, switches and numbers of a node are found by its RNA, its sockets by asking it. What stands here is only what a
node cannot be asked: the values that make sense.
"""

from __future__ import annotations

import math

Range = tuple[float, float]

# fmt: off
TEXTURES = [
    "TexNoise", "TexVoronoi", "TexWave", "TexMagic", "TexMusgrave", "TexBrick", "TexChecker", "TexGradient",
    "TexWhiteNoise", "TexImage", "TexEnvironment",
]
SOURCES = [
    "TexCoord", "UVMap", "NewGeometry", "ObjectInfo", "ParticleInfo", "Attribute", "VertexColor", "Tangent",
    "CameraData", "LightPath", "LayerWeight", "Fresnel", "Wireframe", "Value", "RGB",
]
OPERATIONS = [
    "Mapping", "Math", "VectorMath", "VectorRotate", "VectorTransform", "Mix", "MixRGB", "ValToRGB", "RGBCurve",
    "VectorCurve", "FloatCurve", "MapRange", "Clamp", "HueSaturation", "BrightContrast", "Gamma", "Invert",
    "SeparateColor", "CombineColor", "SeparateRGB", "CombineRGB", "SeparateHSV", "CombineHSV", "SeparateXYZ",
    "CombineXYZ", "RGBToBW", "Blackbody", "Wavelength", "Normal", "NormalMap", "Bump",
]
# fmt: on
GROUP, REROUTE, MUTED = "Group", "Reroute", "muted"  # shapes of a tree, counted as kinds

# Drawn more often: one row has many settings.
WEIGHTS = {"Math": 4, "VectorMath": 3, "Mix": 3, "TexNoise": 2, "TexVoronoi": 2, "TexImage": 2, "MapRange": 2}

# By kind and socket, or by socket. A socket that is in neither is 0..1 if it is a factor or a colour, else -2..2.
RANGES: dict[str, Range] = {
    "Scale": (0.4, 4),
    "Detail": (0, 4),
    "Roughness": (0, 1),
    "Lacunarity": (1.3, 3),
    "Distortion": (-1, 2),
    "TexWave Distortion": (0, 4),
    "Dimension": (0, 2),
    "TexMusgrave Gain": (0, 3),
    "Randomness": (0, 1),
    "Smoothness": (0, 1),
    "Exponent": (0.4, 5),
    "Detail Scale": (0.3, 2),
    "Detail Roughness": (0, 1),
    "Mortar Size": (0, 0.1),
    "Mortar Smooth": (0, 1),
    "Bias": (-1, 1),
    "Brick Width": (0.2, 1),
    "Row Height": (0.1, 0.6),
    "Rotation": (-math.pi, math.pi),
    "Angle": (-math.pi, math.pi),
    "Mapping Scale": (0.3, 2.5),
    "VectorMath Scale": (-2, 2),
    "Hue": (0, 1),
    "Saturation": (0, 2),
    "HueSaturation Value": (0, 2),
    "Bright": (-0.5, 0.5),
    "Contrast": (-0.5, 1.5),
    "Gamma": (0.3, 3),
    "Temperature": (500, 14000),
    "Wavelength": (360, 800),
    "IOR": (0.4, 3),
    "Blend": (0, 1),
    "Steps": (1, 8),
    "Strength": (0, 1.5),
    "Distance": (0.05, 1),
    "Size": (0.02, 0.2),
}
WIDE = 50.0  # a range so wide is not met by what another node gives: a link is scaled to it

# Settings that are not drawn: they ask for what the scene has not, or for what no picture shows.
FIXED = {"from_instancer": False}


def value_range(kind: str, socket: str, is_factor: bool) -> Range:
    unknown = (0.0, 1.0) if is_factor else (-2.0, 2.0)
    return RANGES.get(f"{kind} {socket}", RANGES.get(socket, unknown))
