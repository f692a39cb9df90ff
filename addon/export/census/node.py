"""Shader nodes: their settings, and their inputs by identifier.

No table is a node that is not known: it is reported as a whole.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from .table import Table, split_mark

NODE = {
    "Node": Table(
        used="type mute inputs outputs internal_links name bl_idname bl_label",
        no_meaning="""
        location width width_hidden height dimensions label parent use_custom_color color select show_options
        show_preview hide show_texture bl_description bl_icon bl_static_type bl_width_default bl_width_min bl_width_max
        bl_height_default bl_height_min bl_height_max location_absolute color_tag warning_propagation panel_states@5.2
        """,
    ),
    "ShaderNodeBsdfPrincipled": Table(used="distribution subsurface_method"),
    "ShaderNodeSubsurfaceScattering": Table(used="falloff"),
    "ShaderNodeBsdfAnisotropic": Table(used="distribution"),
    "ShaderNodeBsdfGlossy": Table(used="distribution"),
    "ShaderNodeBsdfGlass": Table(used="distribution"),
    "ShaderNodeBsdfRefraction": Table(used="distribution"),
    "ShaderNodeBsdfMetallic": Table(used="distribution fresnel_type"),
    "ShaderNodeBsdfSheen": Table(used="distribution"),
    "ShaderNodeBsdfToon": Table(used="component"),
    "ShaderNodeBsdfHair": Table(used="component"),
    "ShaderNodeBsdfHairPrincipled": Table(used="model parametrization"),
    "ShaderNodeVolumeScatter": Table(used="phase"),
    "ShaderNodeVolumeCoefficients": Table(used="phase"),
    "ShaderNodeOutputMaterial": Table(used="is_active_output target"),
    "ShaderNodeOutputWorld": Table(used="is_active_output target"),
    "ShaderNodeOutputLight": Table(used="is_active_output target"),
    "ShaderNodeTexIES": Table(used="mode ies filepath"),
    "ShaderNodeUVMap": Table(used="uv_map from_instancer"),
    "ShaderNodeMath": Table(used="operation use_clamp"),
    "ShaderNodeVectorMath": Table(used="operation"),
    "ShaderNodeMix": Table(used="data_type factor_mode blend_type clamp_factor clamp_result"),
    "ShaderNodeMixRGB": Table(used="blend_type use_clamp", no_meaning="use_alpha"),
    "ShaderNodeCombineColor": Table(used="mode"),
    "ShaderNodeSeparateColor": Table(used="mode"),
    "ShaderNodeClamp": Table(used="clamp_type"),
    "ShaderNodeMapRange": Table(used="clamp interpolation_type data_type"),
    "ShaderNodeVectorRotate": Table(used="rotation_type invert"),
    "ShaderNodeMapping": Table(used="vector_type"),
    "ShaderNodeRGBCurve": Table(used="mapping"),
    "ShaderNodeVectorCurve": Table(used="mapping"),
    "ShaderNodeFloatCurve": Table(used="mapping"),
    "ShaderNodeValToRGB": Table(used="color_ramp"),
    "ShaderNodeTexNoise": Table(
        used="texture_mapping noise_dimensions noise_type normalize", no_meaning="color_mapping"
    ),
    "ShaderNodeTexMusgrave": Table(
        used="texture_mapping musgrave_dimensions musgrave_type", no_meaning="color_mapping"
    ),
    "ShaderNodeTexVoronoi": Table(
        used="texture_mapping voronoi_dimensions distance feature normalize", no_meaning="color_mapping"
    ),
    "ShaderNodeTexWave": Table(
        used="texture_mapping wave_type bands_direction rings_direction wave_profile", no_meaning="color_mapping"
    ),
    "ShaderNodeTexMagic": Table(used="texture_mapping turbulence_depth", no_meaning="color_mapping"),
    "ShaderNodeTexBrick": Table(
        used="texture_mapping offset offset_frequency squash squash_frequency", no_meaning="color_mapping"
    ),
    "ShaderNodeTexChecker": Table(used="texture_mapping", no_meaning="color_mapping"),
    "ShaderNodeTexGabor": Table(used="texture_mapping gabor_type", no_meaning="color_mapping"),
    "ShaderNodeAmbientOcclusion": Table(used="samples inside only_local"),
    "ShaderNodeTexGradient": Table(used="texture_mapping gradient_type", no_meaning="color_mapping"),
    "ShaderNodeTexWhiteNoise": Table(used="noise_dimensions"),
    "ShaderNodeTexCoord": Table(used="object from_instancer"),
    "ShaderNodeTangent": Table(used="direction_type axis uv_map"),
    "ShaderNodeWireframe": Table(used="use_pixel_size"),
    "ShaderNodeAttribute": Table(used="attribute_type attribute_name"),
    "ShaderNodeVertexColor": Table(used="layer_name"),
    "ShaderNodeVectorTransform": Table(used="vector_type convert_from convert_to"),
    "ShaderNodeNormalMap": Table(used="space uv_map convention@5.2", no_meaning="base@5.2"),
    "ShaderNodeBump": Table(used="invert"),
    "ShaderNodeDisplacement": Table(used="space"),
    # These are reported whenever they are met.
    "ShaderNodeBevel": Table(no_meaning="samples"),
    "ShaderNodeVectorDisplacement": Table(no_meaning="space"),
    "ShaderNodeTexImage": Table(
        used="image image_user texture_mapping projection projection_blend interpolation extension",
        no_meaning="color_mapping",
    ),
    "ShaderNodeTexSky": Table(
        used="""
        texture_mapping sky_type sun_direction turbidity sun_disc sun_size sun_intensity sun_elevation sun_rotation
        altitude air_density dust_density aerosol_density@5.0 ozone_density
        """,
        no_meaning="color_mapping ground_albedo",
    ),
    "ShaderNodeTexEnvironment": Table(
        used="image image_user texture_mapping projection interpolation", no_meaning="color_mapping"
    ),
}


@dataclass(frozen=True)
class Inputs:
    """The inputs of one kind of node. Each list is of identifiers between commas."""

    used: str = ""
    linked: str = ""  # left out where something is linked to them
    left_out: tuple[tuple[str, float], ...] = ()  # left out but at this value, which changes nothing
    no_meaning: str = ""  # without what is reported anyway

    def names(self) -> dict[str, str]:
        """Each identifier, with the Blender version it is marked with or ""."""
        listed = [*_listed(f"{self.used},{self.linked},{self.no_meaning}"), *(entry for entry, _ in self.left_out)]
        return dict(split_mark(entry) for entry in listed)

    def neutral_values(self) -> Iterator[tuple[str, float | None]]:
        """The identifiers of what is left out, with the value that changes nothing; None where only a link counts."""
        for entry in _listed(self.linked):
            yield split_mark(entry)[0], None
        for entry, neutral in self.left_out:
            yield split_mark(entry)[0], neutral


def _listed(names: str) -> list[str]:
    return [name.strip() for name in names.split(",") if name.strip()]


INPUTS = {
    "ShaderNodeBsdfPrincipled": Inputs(
        used="Base Color, Metallic, Roughness, IOR, Specular, Specular IOR Level, Specular Tint, Emission,"
        "Emission Color, Emission Strength, Normal, Transmission Weight, Transmission, Transmission Roughness, Alpha,"
        "Anisotropic, Anisotropic Rotation, Tangent, Coat Weight, Coat Roughness, Coat IOR, Coat Tint, Coat Normal,"
        "Clearcoat, Clearcoat Roughness, Clearcoat Normal, Diffuse Roughness, Sheen, Sheen Weight, Sheen Tint,"
        "Sheen Roughness, Subsurface Weight, Subsurface, Subsurface Radius, Subsurface Color, Subsurface Scale,"
        "Subsurface IOR, Subsurface Anisotropy, Thin Film Thickness, Thin Film IOR, Thin Wall@5.2",
        left_out=(("Transmission Dispersion Scale@5.3", 0.0),),
        no_meaning="Transmission Dispersion Abbe Number@5.3, Weight",
    ),
    "ShaderNodeBsdfDiffuse": Inputs("Color, Roughness, Normal", no_meaning="Weight"),
    "ShaderNodeBsdfSheen": Inputs("Color, Roughness, Normal", no_meaning="Weight"),
    "ShaderNodeBsdfVelvet": Inputs("Color, Sigma, Normal", no_meaning="Weight"),
    "ShaderNodeBsdfToon": Inputs("Color, Size, Smooth, Normal", no_meaning="Weight"),
    "ShaderNodeBsdfHair": Inputs("Color, Offset, RoughnessU, RoughnessV, Tangent", no_meaning="Weight"),
    # What is Huang's alone is reported with the model.
    "ShaderNodeBsdfHairPrincipled": Inputs(
        "Color, Melanin, Melanin Redness, Tint, Absorption Coefficient, Roughness, Radial Roughness, Coat, IOR, Offset,"
        "Random Color, Random Roughness, Random",
        no_meaning="Weight, Aspect Ratio, R lobe, TT lobe, TRT lobe",
    ),
    "ShaderNodeSubsurfaceScattering": Inputs(
        "Color, Scale, Radius, IOR, Roughness, Anisotropy, Normal", no_meaning="Weight"
    ),
    "ShaderNodeBsdfTranslucent": Inputs("Color, Normal", no_meaning="Weight"),
    "ShaderNodeBsdfGlossy": Inputs("Color, Roughness, Normal", no_meaning="Weight"),
    "ShaderNodeBsdfAnisotropic": Inputs("Color, Roughness, Normal, Anisotropy, Rotation, Tangent", no_meaning="Weight"),
    "ShaderNodeBsdfMetallic": Inputs(
        "Base Color, Edge Tint, Roughness, Normal, IOR, Extinction, Anisotropy, Rotation, Tangent,"
        "Thin Film Thickness@5.0, Thin Film IOR@5.0",
        no_meaning="Weight",
    ),
    "ShaderNodeBsdfGlass": Inputs(
        "Color, Roughness, IOR, Normal, Thin Film Thickness@5.0, Thin Film IOR@5.0",
        no_meaning="Weight, Anisotropy@5.3, Rotation@5.3, Tangent@5.3",
    ),
    "ShaderNodeBsdfRefraction": Inputs("Color, Roughness, IOR, Normal", no_meaning="Weight"),
    "ShaderNodeBsdfTransparent": Inputs("Color", no_meaning="Weight"),
    "ShaderNodeBsdfRayPortal": Inputs("Color", linked="Position, Direction", no_meaning="Weight"),
    "ShaderNodeHoldout": Inputs("", no_meaning="Weight"),
    "ShaderNodeEmission": Inputs("Color, Strength", no_meaning="Weight"),
    "ShaderNodeBackground": Inputs("Color, Strength", no_meaning="Weight"),
    "ShaderNodeVolumeScatter": Inputs(
        "Color, Density, Anisotropy, Backscatter, Alpha, Diameter",
        no_meaning="Weight, IOR",  # of phase functions that are reported
    ),
    "ShaderNodeVolumeAbsorption": Inputs("Color, Density", no_meaning="Weight"),
    "ShaderNodeVolumeCoefficients": Inputs(
        "Absorption Coefficients, Scatter Coefficients, Emission Coefficients, Anisotropy, Backscatter, Alpha,Diameter",
        no_meaning="Weight, IOR",
    ),
    "ShaderNodeVolumePrincipled": Inputs(
        "Color, Color Attribute, Density, Density Attribute, Anisotropy, Absorption Color, Emission Strength,"
        "Emission Color, Blackbody Intensity, Blackbody Tint, Temperature, Temperature Attribute",
        no_meaning="Weight",
    ),
    "ShaderNodeVolumeInfo": Inputs(),
    "ShaderNodeMixShader": Inputs("Fac, Shader, Shader_001"),
    "ShaderNodeAddShader": Inputs("Shader, Shader_001"),
    "ShaderNodeOutputMaterial": Inputs("Surface, Displacement, Volume", no_meaning="Thickness"),
    "ShaderNodeOutputWorld": Inputs("Surface, Volume"),
    "ShaderNodeOutputLight": Inputs("Surface"),
    "ShaderNodeRGB": Inputs(),
    "ShaderNodeValue": Inputs(),
    "ShaderNodeNewGeometry": Inputs(),
    "ShaderNodeUVMap": Inputs(),
    "ShaderNodeMath": Inputs("Value, Value_001, Value_002"),
    "ShaderNodeVectorMath": Inputs("Vector, Vector_001, Vector_002, Scale"),
    "ShaderNodeMix": Inputs(
        "Factor_Float, Factor_Vector, A_Float, B_Float, A_Vector, B_Vector, A_Color, B_Color",
        no_meaning="A_Rotation, B_Rotation",
    ),
    "ShaderNodeMixRGB": Inputs("Fac, Color1, Color2"),
    "ShaderNodeBlackbody": Inputs("Temperature"),
    "ShaderNodeCombineColor": Inputs("Red, Green, Blue"),
    "ShaderNodeCombineRGB": Inputs("R, G, B"),
    "ShaderNodeCombineHSV": Inputs("H, S, V"),
    "ShaderNodeCombineXYZ": Inputs("X, Y, Z"),
    "ShaderNodeSeparateColor": Inputs("Color"),
    "ShaderNodeSeparateRGB": Inputs("Image"),
    "ShaderNodeSeparateHSV": Inputs("Color"),
    "ShaderNodeSeparateXYZ": Inputs("Vector"),
    "ShaderNodeWavelength": Inputs("Wavelength"),
    "ShaderNodeLightFalloff": Inputs("Strength, Smooth"),
    "ShaderNodeTexIES": Inputs("Vector, Strength"),
    "ShaderNodeClamp": Inputs("Value, Min, Max"),
    "ShaderNodeMapRange": Inputs(
        "Value, From Min, From Max, To Min, To Max, Steps, Vector, From_Min_FLOAT3, From_Max_FLOAT3, To_Min_FLOAT3,"
        "To_Max_FLOAT3, Steps_FLOAT3"
    ),
    "ShaderNodeVectorRotate": Inputs("Vector, Center, Axis, Angle, Rotation"),
    "ShaderNodeMapping": Inputs("Vector, Location, Rotation, Scale"),
    "ShaderNodeNormal": Inputs("Normal"),
    "ShaderNodeGamma": Inputs("Color, Gamma"),
    "ShaderNodeInvert": Inputs("Fac, Color"),
    "ShaderNodeBrightContrast": Inputs("Color, Bright, Contrast"),
    "ShaderNodeHueSaturation": Inputs("Hue, Saturation, Value, Fac, Color"),
    "ShaderNodeRGBCurve": Inputs("Fac, Color"),
    "ShaderNodeVectorCurve": Inputs("Fac, Vector"),
    "ShaderNodeFloatCurve": Inputs("Factor, Value"),
    "ShaderNodeValToRGB": Inputs("Fac"),
    "ShaderNodeRGBToBW": Inputs("Color"),
    "ShaderNodeTexNoise": Inputs("Vector, W, Scale, Detail, Roughness, Lacunarity, Offset, Gain, Distortion"),
    "ShaderNodeTexMusgrave": Inputs("Vector, W, Scale, Detail, Dimension, Lacunarity, Offset, Gain"),
    "ShaderNodeTexVoronoi": Inputs("Vector, W, Scale, Detail, Roughness, Lacunarity, Smoothness, Exponent, Randomness"),
    "ShaderNodeTexWave": Inputs("Vector, Scale, Distortion, Detail, Detail Scale, Detail Roughness, Phase Offset"),
    "ShaderNodeTexMagic": Inputs("Vector, Scale, Distortion"),
    "ShaderNodeTexBrick": Inputs(
        "Vector, Color1, Color2, Mortar, Scale, Mortar Size, Mortar Smooth, Bias, Brick Width, Row Height"
    ),
    "ShaderNodeTexChecker": Inputs("Vector, Color1, Color2, Scale"),
    "ShaderNodeTexGradient": Inputs("Vector"),
    "ShaderNodeTexGabor": Inputs("Vector, Scale, Frequency, Anisotropy, Orientation 2D, Orientation 3D"),
    "ShaderNodeAmbientOcclusion": Inputs("Color, Distance, Normal"),
    "ShaderNodeTexWhiteNoise": Inputs("Vector, W"),
    "ShaderNodeTexCoord": Inputs(),
    "ShaderNodeTangent": Inputs(),
    "ShaderNodeWireframe": Inputs("Size"),
    "ShaderNodeAttribute": Inputs(),
    "ShaderNodeVertexColor": Inputs(),
    "ShaderNodeObjectInfo": Inputs(),
    "ShaderNodeParticleInfo": Inputs(),
    "ShaderNodeHairInfo": Inputs(),
    "ShaderNodePointInfo": Inputs(),
    "ShaderNodeLightPath": Inputs(),
    "ShaderNodeCameraData": Inputs(),
    "ShaderNodeLayerWeight": Inputs("Blend, Normal"),
    "ShaderNodeFresnel": Inputs("IOR, Normal"),
    "ShaderNodeVectorTransform": Inputs("Vector"),
    "ShaderNodeNormalMap": Inputs("Color, Strength"),
    "ShaderNodeBump": Inputs("Height, Strength, Distance, Filter Width, Normal"),
    "ShaderNodeDisplacement": Inputs("Height, Midlevel, Scale, Normal"),
    # These are reported whenever they are met.
    "ShaderNodeBevel": Inputs("Normal", no_meaning="Radius"),
    "ShaderNodeVectorDisplacement": Inputs(no_meaning="Vector, Midlevel, Scale"),
    "ShaderNodeTexImage": Inputs("Vector"),
    "ShaderNodeTexEnvironment": Inputs("Vector"),
    "ShaderNodeTexSky": Inputs("Vector"),
}
