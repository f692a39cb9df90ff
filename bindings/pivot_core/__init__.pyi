"""
Pivot's core, one build per x86-64 level.
"""

from __future__ import annotations
import collections.abc
import numpy
import numpy.typing
import typing
from . import bsdf, distributions, film, sampling, shading, tables

__all__: list[str] = [
    "bsdf",
    "distributions",
    "film",
    "sampling",
    "shading",
    "tables",
    "AreaLight",
    "CentralCylindrical",
    "CubeMapFace",
    "Equirectangular",
    "FisheyeEquidistant",
    "FisheyeEquisolid",
    "FisheyePolynomial",
    "Image",
    "LOBES",
    "LOBES_WITH_NDF",
    "Lens",
    "MAX_LOBES",
    "Material",
    "Medium",
    "Mesh",
    "MirrorBall",
    "Orthographic",
    "Perspective",
    "Program",
    "RenderSettings",
    "Scene",
    "Session",
    "SessionLights",
    "Shader",
    "SharedMeshes",
    "SphereLight",
    "SpotLight",
    "SunLight",
    "TabulatedNdf",
    "VoxelGrid",
    "arch",
    "fog_lamp_pdf",
    "fog_lamp_samples",
    "mean_lamp_share",
    "ops",
    "run_op",
    "version",
]

class VoxelGrid:
    """
    Numbers on a regular grid, interpolated linearly. values: (z, y, x) or (z, y, x, 3), at least 0; that at [k, j, i] stands at the point (i, j, k) of grid space, and beyond the outermost they fall to 0 within one voxel. They are kept with 16 bits, in parts of the largest of 8^3 around, and not where that is 0. grid_from_object: (4, 4). Rays are in grid space: origin, and direction by metre.
    """
    def __init__(
        self,
        values: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        grid_from_object: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    ) -> None: ...
    def at(
        self, points: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        The values (N, 3) at points (N, 3) of grid space; of one channel, the same thrice.
        """
    def at_each(
        self, points: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        The same, point by point.
        """
    def cells(
        self,
        origin: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"],
        direction: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
        near_m: typing.SupportsFloat | typing.SupportsIndex,
        far_m: typing.SupportsFloat | typing.SupportsIndex,
    ) -> list[typing.Annotated[list[float], "FixedSize(3)"]]:
        """
        (near_m, far_m, majorant) of each part of a ray where the grid is not empty, in order.
        """
    def density_integral(
        self,
        origin: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"],
        direction: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
        near_m: typing.SupportsFloat | typing.SupportsIndex,
        far_m: typing.SupportsFloat | typing.SupportsIndex,
    ) -> float:
        """
        The integral of the density along a ray.
        """
    def sample_collisions(
        self,
        origin: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"],
        direction: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
        near_m: typing.SupportsFloat | typing.SupportsIndex,
        far_m: typing.SupportsFloat | typing.SupportsIndex,
        sigma_t: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
        throughput: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
        seed: typing.SupportsInt | typing.SupportsIndex,
        count: typing.SupportsInt | typing.SupportsIndex,
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        (count, 4): distances in m, infinite where a ray goes through, and the throughput from there on.
        """
    def transmittances(
        self,
        origin: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"],
        direction: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
        near_m: typing.SupportsFloat | typing.SupportsIndex,
        far_m: typing.SupportsFloat | typing.SupportsIndex,
        sigma_t: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
        seed: typing.SupportsInt | typing.SupportsIndex,
        count: typing.SupportsInt | typing.SupportsIndex,
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        (count, 3): unbiased estimates of exp(-sigma_t density_integral).
        """
    @property
    def memory_bytes(self) -> int: ...
    @property
    def most(self) -> float:
        """
        No value is above it.
        """

class Medium:
    """
    Fog. scattering: a list of (sigma_s in 1/m as RGB, anisotropy, phase), phase HENYEY_GREENSTEIN, whose anisotropy is the mean cosine, or PIVOT, whose anisotropy is g_p. absorption: sigma_a in 1/m; emission: radiance per m. density multiplies scattering and absorption, emission_grid the emission.
    """
    def __init__(
        self,
        *,
        scattering: collections.abc.Sequence[
            tuple[
                typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"],
                typing.SupportsFloat | typing.SupportsIndex,
                str,
            ]
        ] = [],
        absorption: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ] = [0.0, 0.0, 0.0],
        emission: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ] = [0.0, 0.0, 0.0],
        density: VoxelGrid | None = None,
        emission_grid: VoxelGrid | None = None,
    ) -> None: ...

class TabulatedNdf:
    """
    A distribution of microfacet normals as a picture: what the lobe 'tabulated' takes as its ndf. Immutable.
    """
    def __init__(self, pixels: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> None:
        """
        pixels (n, n): D of the normal h whose x is the column's and y the row's, from -1 to 1; of any scale. Raises ValueError where they are no density.
        """
    def albedo(
        self, wo_local: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        What is reflected towards each direction (n, 3) of light that is 1 all around, (n,).
        """
    def density(
        self, h_local: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        D (n,), 1/sr, of normals (n, 3).
        """
    def g1(
        self, w_local: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        The part of what faces each direction (n, 3) that it sees, (n,).
        """
    def sigma(
        self, w_local: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        The integral of max(w.h, 0) D(h) dw, (n,), of directions (n, 3) above the surface.
        """
    @property
    def alpha(self) -> float:
        """
        Of a GGX distribution about as rough.
        """
    @property
    def fit(self) -> list:
        """
        Tilted GGX lobes that it is about the sum of: (weight, (shift of slopes), (A's xx, yx, yy)).
        """
    @property
    def fit_error(self) -> float:
        """
        The part of the projected area that lies elsewhere.
        """
    @property
    def memory_bytes(self) -> int: ...

class Material:
    """
    A Lambert lobe beneath one GGX lobe, further lobes, and emission; colours are linear RGB.

    The lobe's Fresnel is a Schlick curve from conductor_f0 to conductor_f90, less conductor_dip times the weight of F82, cos (1 - cos)^6, in which conductor_weight is multiplied, plus, times dielectric_weight, the curve of a dielectric of dielectric_ior whose reflectance at normal incidence is scaled by dielectric_tint. alpha must be in [0, 1], dielectric_ior at least 1. weight: the share of the surface that these are, multiplied into them. transparency: the colour of light that goes straight on; opacity: how much of the surface there is beside, which tells paths how often to pass and is multiplied into all else already; None: what transparency leaves of 1.

    lobes: up to MAX_LOBES beside these, each a kind and its parameters, as LOBES names them; what is not given is as here, or 1.
    """
    def __init__(
        self,
        *,
        diffuse: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ] = [0.0, 0.0, 0.0],
        alpha: typing.SupportsFloat | typing.SupportsIndex = 0.5,
        conductor_f0: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ] = [0.0, 0.0, 0.0],
        conductor_f90: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ] = [0.0, 0.0, 0.0],
        conductor_weight: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        dielectric_weight: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        dielectric_ior: typing.SupportsFloat | typing.SupportsIndex = 1.5,
        dielectric_tint: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ] = [1.0, 1.0, 1.0],
        multiscatter: bool = False,
        weight: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        emission: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ] = [0.0, 0.0, 0.0],
        lobes: collections.abc.Sequence[
            tuple[
                str,
                collections.abc.Mapping[
                    str,
                    typing.SupportsFloat
                    | typing.SupportsIndex
                    | typing.Annotated[
                        collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
                    ]
                    | TabulatedNdf,
                ],
            ]
        ] = [],
        transparency: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ] = [0.0, 0.0, 0.0],
        opacity: typing.SupportsFloat | typing.SupportsIndex | None = None,
        conductor_dip: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ] = [0.0, 0.0, 0.0],
    ) -> None: ...
    def albedo(
        self,
        wo_local: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
    ) -> typing.Annotated[list[float], "FixedSize(3)"]:
        """
        About what it sends towards wo_local where all light around is 1, by which lobes are chosen.
        """
    def evaluate(
        self,
        wo_local: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
        wi_local: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    ) -> tuple:
        """
        BSDF times |cos| (n, 3), and the density of sample() (n, 1), both per steradian; wi_local (n, 3).
        """
    def sample(
        self,
        wo_local: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
        u: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        Directions (n, 3) by u (n, 3) in [0, 1): the first number chooses the lobe, the others place it.
        """

class Image:
    """
    A picture that ops of programs look up; immutable.
    """
    def __init__(self, pixels: numpy.ndarray, srgb: bool = False) -> None:
        """
        pixels (height, width, channels), copied: uint8 and uint16 for 0..1, float16, float32; the first row is the bottom one. Channels: grey; grey, alpha; RGB; RGBA. srgb: the colours are encoded so.
        """
    def level(self, index: typing.SupportsInt | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float32]:
        """
        (height, width, 4) linear: the picture, and from 1 on its copies of half the size of the one before.
        """
    @property
    def level_count(self) -> int: ...
    @property
    def memory_bytes(self) -> int: ...

class SphereLight:
    """
    A sphere of radius_m; intensity in W/sr, Blender's power / (4 pi). facing_disk: a disk turned to each point it lights instead, Blender's soft falloff.
    """
    def __init__(
        self,
        position: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
        radius_m: typing.SupportsFloat | typing.SupportsIndex,
        intensity: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
        facing_disk: bool = False,
    ) -> None: ...

class SpotLight:
    """
    A sphere that shines along direction, with a smooth step from the cone's edge inwards over the share blend of its versine; with cosine, times the cosine from the axis.
    """
    def __init__(
        self,
        position: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
        radius_m: typing.SupportsFloat | typing.SupportsIndex,
        intensity: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
        direction: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
        cos_half_angle: typing.SupportsFloat | typing.SupportsIndex,
        blend: typing.SupportsFloat | typing.SupportsIndex,
        facing_disk: bool = False,
        cosine: bool = False,
    ) -> None: ...

class SunLight:
    """
    Light from a cap of directions around direction (towards the sun); irradiance of a surface that faces it.
    """
    def __init__(
        self,
        direction: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
        half_angle_rad: typing.SupportsFloat | typing.SupportsIndex,
        irradiance: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
    ) -> None: ...

class AreaLight:
    """
    A parallelogram center +- half_u +- half_v, or the ellipse in it, shining towards cross(half_u, half_v) with the given radiance, as if behind slats where spread_rad is less than pi.
    """
    def __init__(
        self,
        center: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"],
        half_u: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"],
        half_v: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"],
        radiance: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
        ellipse: bool = False,
        spread_rad: typing.SupportsFloat | typing.SupportsIndex = 3.1415927410125732,
    ) -> None: ...

class Program:
    """
    Ops over registers, run at each place of a surface.
    """
    def __init__(self) -> None: ...
    def add(
        self,
        op: str,
        inputs: collections.abc.Sequence[
            tuple[typing.SupportsInt | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex]
        ],
        settings: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = [],
        neighbour: typing.SupportsInt | typing.SupportsIndex = 0,
        image: Image | None = None,
    ) -> int:
        """
        Appends an op and returns its first register. inputs: (register, 0.0), or (-1, a constant), for each number. neighbour 1 and 2: what it would give at the places beside, along two directions; from 3 on: at those of bump_neighbour. image: of an op that looks one up.
        """
    def bump_neighbour(self, filter_width: typing.SupportsFloat | typing.SupportsIndex) -> int:
        """
        The first of two neighbours along the directions that bump mapping takes, filter_width footprints away.
        """
    def run_at(
        self,
        positions_object: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        object_to_world: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        registers: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
        *,
        attributes: collections.abc.Mapping[
            typing.SupportsInt | typing.SupportsIndex, typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
        ] = {},
        color: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(4)"
        ] = [1.0, 1.0, 1.0, 1.0],
        pass_index: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        random: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        object_attributes: collections.abc.Mapping[
            typing.SupportsInt | typing.SupportsIndex,
            typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(4)"],
        ] = {},
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        The chosen registers, (N, registers), at points (N, 3) within an object. What shaders ask of the mesh is in attributes, by Scene.attribute_id: (N, 1..4); of the object in color, pass_index, random, and object_attributes by the same. There is no normal, ray or camera.
        """
    def run_nowhere(self) -> list[float]:
        """
        The registers where there is no surface.
        """
    @property
    def ops(self) -> list[str]:
        """
        The names of its ops, in order.
        """

class Shader:
    """
    A Material of which some numbers are a program's registers.
    """
    @typing.overload
    def __init__(self, constants: Material) -> None: ...
    @typing.overload
    def __init__(
        self,
        constants: Material,
        program: Program,
        varying: collections.abc.Mapping[str, collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex]],
    ) -> None:
        """
        varying: by the name of Material's argument, the register of each number, -1 for one that is constant; 'normal': the shading normal in world space; or 'own_normal', where displacement turns the surface's own; 'tangent': which way x lies of pictures of microfacets, world space.
        """

class Perspective:
    """
    Places are those of the plane at z = -1 in camera space.
    """
    def __init__(self) -> None: ...

class Orthographic:
    """
    Places are x and y of camera space, in m.
    """
    def __init__(self) -> None: ...

class Equirectangular:
    """
    Longitude, to the right of the camera's axis, and latitude (from, to) over the unit square, in radians.
    """
    def __init__(
        self,
        longitude: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(2)"
        ],
        latitude: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(2)"
        ],
    ) -> None: ...

class CentralCylindrical:
    """
    Longitude in radians, and height over the radius (from, to) over the unit square.
    """
    def __init__(
        self,
        longitude: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(2)"
        ],
        height: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(2)"],
    ) -> None: ...

class FisheyeEquidistant:
    """
    The angle from the axis, even over the disk in the unit square.
    """
    def __init__(self, fov_rad: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class FisheyeEquisolid:
    """
    Solid angle around the axis, even over a sensor (width, height).
    """
    def __init__(
        self,
        lens_mm: typing.SupportsFloat | typing.SupportsIndex,
        fov_rad: typing.SupportsFloat | typing.SupportsIndex,
        sensor_mm: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(2)"
        ],
    ) -> None: ...

class FisheyePolynomial:
    """
    The angle from the axis, its sign turned, as a polynomial of the radius on a sensor (width, height): radians per mm^k.
    """
    def __init__(
        self,
        coefficients: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(5)"
        ],
        fov_rad: typing.SupportsFloat | typing.SupportsIndex,
        sensor_mm: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(2)"
        ],
    ) -> None: ...

class CubeMapFace:
    """
    A quarter turn each way, even in both angles.
    """
    def __init__(self) -> None: ...

class MirrorBall:
    """
    What a ball of mirror shows from afar.
    """
    def __init__(self) -> None: ...

class Lens:
    """
    A thin lens in focus at a distance; blades: sides of its stop, below 3 it is round; ratio: how much narrower it is along x.
    """
    def __init__(
        self,
        radius_m: typing.SupportsFloat | typing.SupportsIndex,
        focus_m: typing.SupportsFloat | typing.SupportsIndex,
        blades: typing.SupportsInt | typing.SupportsIndex = 0,
        rotation_rad: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        ratio: typing.SupportsFloat | typing.SupportsIndex = 1.0,
    ) -> None: ...

class SharedMeshes:
    """
    What scenes share that are made one after the other: meshes and their BVHs.
    """
    def __init__(self) -> None: ...

class Scene:
    """
    Meshes, instances, materials, lights, world and camera, edited by id. Metres; world space is z up.
    """
    @typing.overload
    def __init__(self) -> None: ...
    @typing.overload
    def __init__(self, shared: SharedMeshes) -> None:
        """
        One of several that take meshes from each other.
        """
    def add_curves(
        self,
        name: str,
        positions: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        radii_m: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        offsets: typing.Annotated[numpy.typing.ArrayLike, numpy.int32],
        shape: str = "RIBBON",
        subdivisions: typing.SupportsInt | typing.SupportsIndex = 3,
        point_attributes: collections.abc.Mapping[str, typing.Annotated[numpy.typing.ArrayLike, numpy.float32]] = {},
        segment_slots: typing.Annotated[numpy.typing.ArrayLike, numpy.int32] | None = None,
    ) -> int:
        """
        Catmull-Rom splines through positions (P, 3), as thick as radii_m (P,) say; offsets (C + 1,): where each curve starts, and P. shape: RIBBON, which faces each ray, in so many straight subdivisions a segment, or ROUND; of BALL each point is one. point_attributes by name, (P, 1..4); segment_slots (S,): material slots. Returns the id of what is a mesh to all other functions.
        """
    def add_instances(
        self,
        name: str,
        mesh: typing.SupportsInt | typing.SupportsIndex,
        object_to_world: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        materials: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
        hidden_from: collections.abc.Sequence[str] = [],
        holdout: bool = False,
        matte: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(2)"
        ] = [0.0, 0.0],
        color: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(4)"
        ] = [1.0, 1.0, 1.0, 1.0],
        pass_index: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        random: typing.Annotated[numpy.typing.ArrayLike, numpy.float32] | None = None,
        particle_index: typing.Annotated[numpy.typing.ArrayLike, numpy.float32] | None = None,
        generated: typing.Annotated[numpy.typing.ArrayLike, numpy.float32] | None = None,
        uv: typing.Annotated[numpy.typing.ArrayLike, numpy.float32] | None = None,
        attributes: collections.abc.Mapping[
            str, typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(4)"]
        ] = {},
        own_attributes: collections.abc.Mapping[str, typing.Annotated[numpy.typing.ArrayLike, numpy.float32]] = {},
        light_group: typing.SupportsInt | typing.SupportsIndex = -1,
        links: typing.Annotated[collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], "FixedSize(2)"] = [
            18446744073709551615,
            18446744073709551615,
        ],
        link_sets: typing.Annotated[
            collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], "FixedSize(2)"
        ] = [0, 0],
        shadow_catcher: bool = False,
    ) -> int:
        """
        object_to_world (N, 4, 4) row-major; materials: an id per slot, a slot past the end uses the last; hidden_from: which rays do not meet them, of CAMERA, DIFFUSE, GLOSSY, TRANSMISSION, VOLUME_SCATTER and SHADOW; holdout: a camera sees a hole in their place; matte: ids of the object and the asset. What shaders ask of them: color, pass_index and attributes by name; of each, random and particle_index (N,), own_attributes (N, 4) by name, and from its instancer generated (N, 3) and uv (N, 2). light_group: of their emission, which passes show apart. links: of their light, masks of the sets of receivers that it lights and of blockers whose shadows it casts; link_sets: their own of both, by number. shadow_catcher: stand-ins for real things. Returns the first of N consecutive ids.
        """
    def add_light(
        self,
        name: str,
        light: SphereLight | SpotLight | SunLight | AreaLight,
        hidden_from: collections.abc.Sequence[str] = [],
        max_bounces: typing.SupportsInt | typing.SupportsIndex = 4294967295,
        light_group: typing.SupportsInt | typing.SupportsIndex = -1,
        links: typing.Annotated[collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], "FixedSize(2)"] = [
            18446744073709551615,
            18446744073709551615,
        ],
        shader: Shader | None = None,
    ) -> int:
        """
        hidden_from: what it does not light, of DIFFUSE, GLOSSY and TRANSMISSION, by surfaces, and VOLUME_SCATTER; SHADOW: nothing hides it. max_bounces: of a path that it lights; 0: what a camera sees alone. light_group, links: as in add_instances. shader: by Monte Carlo its emission is what is left of the light, from each place of the lamp.
        """
    def add_material(
        self,
        name: str,
        material: Shader,
        medium: Medium | None = None,
        has_surface: bool = True,
        pass_index: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        matte: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        filters_shadows: bool = True,
    ) -> int:
        """
        A Material or a Shader; medium: a Medium within what it surrounds; without has_surface rays pass, and nothing but the medium is there; without filters_shadows it hides light, whatever is seen through it.
        """
    def add_mesh(
        self,
        name: str,
        positions: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        corner_vertices: typing.Annotated[numpy.typing.ArrayLike, numpy.int32],
        triangle_corners: typing.Annotated[numpy.typing.ArrayLike, numpy.int32],
        corner_normals: typing.Annotated[numpy.typing.ArrayLike, numpy.float32] | None = None,
        vertex_normals: typing.Annotated[numpy.typing.ArrayLike, numpy.float32] | None = None,
        triangle_slots: typing.Annotated[numpy.typing.ArrayLike, numpy.int32] | None = None,
        vertex_attributes: collections.abc.Mapping[str, typing.Annotated[numpy.typing.ArrayLike, numpy.float32]] = {},
        corner_attributes: collections.abc.Mapping[str, typing.Annotated[numpy.typing.ArrayLike, numpy.float32]] = {},
    ) -> int:
        """
        positions (V, 3), corner_vertices (C,), triangle_corners (T, 3), corner_normals (C, 3) or vertex_normals (V, 3), without both flat shading, triangle_slots (T,) material slots; attributes by name, (V, 1..4) and (C, 1..4): what shaders read. Returns the mesh's id.
        """
    def add_shared_mesh(self, mesh: Mesh) -> int:
        """
        A mesh of another scene that was made with the same SharedMeshes. Returns its id in this one.
        """
    def attribute_id(self, name: str) -> int:
        """
        What programs call a mesh's attribute.
        """
    def bent_cones(
        self,
        origins: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        directions: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    ) -> tuple:
        """
        Where rays (n, 3) hit, the cap that surrounding geometry leaves free: axis (n, 3), versine (n,).
        ValueError where a ray meets nothing.
        """
    def choice_probabilities(
        self,
        material: Material,
        position: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
        wo: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"],
        cut_nodes: typing.SupportsInt | typing.SupportsIndex = 1,
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        With which probability choose_lights takes each lamp, (lamps,).
        """
    def choose_lights(
        self,
        material: Material,
        position: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
        wo: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"],
        u: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        cut_nodes: typing.SupportsInt | typing.SupportsIndex = 1,
    ) -> tuple:
        """
        The light that each u (n,) in [0, 1) chooses down the light tree, (n,), -1 where none reaches the point, and with which probability, (n,).
        """
    def intersect(
        self,
        origins: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        directions: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        packets: bool = True,
        times: typing.Annotated[numpy.typing.ArrayLike, numpy.float32] | None = None,
    ) -> tuple:
        """
        Closest hits of rays (n, 3), unit directions, at times (n,), else in the middle: distance_m (n,), infinite where there is none; instance and triangle (n,), -1 where there is none; barycentric (n, 2).
        """
    def light_densities(
        self,
        material: Material,
        position: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
        wo: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"],
        light_sampling: str,
        light_samples: typing.SupportsInt | typing.SupportsIndex,
        wi: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    ) -> tuple:
        """
        Of sample_lights at directions wi (n, 3): the density of a path's samples of each light per steradian (n, lights), 0 where they would add nothing; what is reflected of the light's radiance (n, lights, 3); the density of BSDF samples (n,); which lights share with these by the balance heuristic (lights,).
        """
    def light_tree(self) -> list:
        """
        Its nodes, the root first, each as (child (n,): a node, or ~light; mean (n, 3), the place, of suns the direction; variance_m2 (n,) of places about it, across any line of sight; bound_m (n,), how far parts are from it at most; intensity (n,) in W/sr towards any side at most, the mean over colours; axis (n, 3), where it shines most, or 0; sharpness (n,) of that Gaussian).
        """
    def mesh(self, id: typing.SupportsInt | typing.SupportsIndex) -> Mesh: ...
    def occluded(
        self,
        origins: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        directions: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        far_m: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        packets: bool = True,
    ) -> numpy.typing.NDArray[numpy.bool]:
        """
        Whether rays (n, 3) meet anything nearer than far_m (n,).
        """
    def remove_instance(self, id: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def remove_light(self, id: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def sample_lights(
        self,
        material: Material,
        position: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
        wo: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"],
        light_sampling: str,
        light_samples: typing.SupportsInt | typing.SupportsIndex,
        count: typing.SupportsInt | typing.SupportsIndex,
        seed: typing.SupportsInt | typing.SupportsIndex,
    ) -> tuple:
        """
        The light samples of `count` paths that meet a surface at `position`, its normal up: wi (n, 3) and what each adds if nothing is in the way, (n, 3); those that add nothing are left out. light_samples: 1, chosen among the lights; or as many as a first vertex takes.
        """
    def seen_shares(
        self,
        origins: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        directions: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        light: SphereLight | SpotLight | SunLight | AreaLight | None,
    ) -> tuple:
        """
        Where rays (n, 3) hit, the shares of a light, or with None of the world, that the bent cone leaves to the
        diffuse and the glossy lobe: (n,) each. Rays come from the viewer; the light need not be in the scene.
        """
    def set_aov(
        self,
        material: typing.SupportsInt | typing.SupportsIndex,
        aov: typing.SupportsInt | typing.SupportsIndex,
        value_material: typing.SupportsInt | typing.SupportsIndex,
    ) -> None:
        """
        An AOV shows what another material would emit where a camera sees this one.
        """
    def set_camera(
        self,
        camera_to_world: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        view_plane: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(4)"
        ],
        width: typing.SupportsInt | typing.SupportsIndex,
        height: typing.SupportsInt | typing.SupportsIndex,
        window: typing.Annotated[collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], "FixedSize(4)"]
        | None = None,
        clip_start_m: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        clip_end_m: typing.SupportsFloat | typing.SupportsIndex = ...,
        projection: Perspective
        | Orthographic
        | Equirectangular
        | CentralCylindrical
        | FisheyeEquidistant
        | FisheyeEquisolid
        | FisheyePolynomial
        | CubeMapFace
        | MirrorBall
        | None = None,
        lens: Lens | None = None,
        motion: typing.Annotated[numpy.typing.ArrayLike, numpy.float32] | None = None,
        shutter: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] | None = None,
        blurs: bool = True,
    ) -> None:
        """
        camera_to_world (4, 4): the camera looks down its -z. view_plane: (left, right, bottom, top) of the full frame, in places of the projection, which is a Perspective unless one is given. window: (x0, y0, x1, y1), the pixels to render, from the bottom left. lens: a pinhole unless one is given. motion: (S, 4, 4), camera_to_world at even times while the shutter is open. shutter: how far it is open, at even times; all the time unless that is given. Without blurs all is seen in the middle of that, and the Vector pass tells how it moves.
        """
    def set_instance_materials(
        self,
        id: typing.SupportsInt | typing.SupportsIndex,
        materials: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
    ) -> None:
        """
        materials: as in add_instances.
        """
    def set_instance_motion(
        self,
        id: typing.SupportsInt | typing.SupportsIndex,
        object_to_world: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    ) -> None:
        """
        object_to_world (S, 4, 4), at even times from when the shutter opens to when it closes: 2 to 129 steps.
        """
    def set_instance_transform(
        self,
        id: typing.SupportsInt | typing.SupportsIndex,
        object_to_world: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    ) -> None: ...
    def set_instance_visibility(
        self, id: typing.SupportsInt | typing.SupportsIndex, hidden_from: collections.abc.Sequence[str]
    ) -> None: ...
    def set_light(
        self,
        id: typing.SupportsInt | typing.SupportsIndex,
        light: SphereLight | SpotLight | SunLight | AreaLight,
        hidden_from: collections.abc.Sequence[str] = [],
        max_bounces: typing.SupportsInt | typing.SupportsIndex = 4294967295,
    ) -> None: ...
    def set_material(
        self,
        id: typing.SupportsInt | typing.SupportsIndex,
        material: Shader,
        medium: Medium | None = None,
        has_surface: bool = True,
    ) -> None: ...
    def set_mesh_motion(
        self,
        id: typing.SupportsInt | typing.SupportsIndex,
        positions: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]],
        corner_normals: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]] | None = None,
        vertex_normals: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]] | None = None,
    ) -> None:
        """
        Of each step, likewise, what add_mesh or add_curves was given, which is the middle of the motion.
        """
    def set_world(
        self,
        radiance: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
    ) -> None: ...
    def set_world_aov(self, aov: typing.SupportsInt | typing.SupportsIndex, value: Shader) -> None:
        """
        The same of a Shader in the world's place.
        """
    def set_world_light_group(self, light_group: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def set_world_medium(self, medium: Medium | None) -> None:
        """
        A Medium that fills all space, or None.
        """
    def set_world_rules(
        self,
        hidden_from: collections.abc.Sequence[str] = [],
        max_bounces: typing.SupportsInt | typing.SupportsIndex = 4294967295,
    ) -> None:
        """
        As of lights.
        """
    def set_world_shader(self, shader: Shader) -> None:
        """
        A Shader whose emission is the light from each direction.
        """
    @property
    def has_shadow_catchers(self) -> bool: ...

class Mesh:
    """
    A scene's mesh, for scenes to come.
    """

class RenderSettings:
    """
    What the artist sets; see the README's table.
    """
    def __init__(
        self,
        *,
        integrator: str = "MONTE_CARLO",
        samples: typing.SupportsInt | typing.SupportsIndex = 64,
        seed: typing.SupportsInt | typing.SupportsIndex = 0,
        max_bounces: typing.SupportsInt | typing.SupportsIndex = 4,
        light_sampling: str = "JOINT",
        error_budget_percent: typing.SupportsFloat | typing.SupportsIndex = 2.0,
        analytic_method: str = "AUTO",
        occlusion: str = "RAY_TRACED",
        time_limit_s: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        threads: typing.SupportsInt | typing.SupportsIndex = 0,
        pixel_filter: str = "BLACKMAN_HARRIS",
        filter_width_px: typing.SupportsFloat | typing.SupportsIndex = 1.5,
        transparent_film: bool = False,
        adaptive: bool = False,
        clamp_indirect: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        filter_glossy: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        indirect: str = "NONE",
        virtual_lights: typing.SupportsInt | typing.SupportsIndex = 4096,
        virtual_light_method: str = "AUTO",
        denoising_passes: bool = False,
        max_passages: typing.SupportsInt | typing.SupportsIndex = 8,
        max_path_passages: typing.SupportsInt | typing.SupportsIndex = 9,
        surface_passes: bool = False,
        uv_attribute: typing.SupportsInt | typing.SupportsIndex = -1,
        mist: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ] = [5.0, 25.0, 2.0],
        mattes: bool = False,
        light_groups: typing.SupportsInt | typing.SupportsIndex = 0,
        aovs: typing.SupportsInt | typing.SupportsIndex = 0,
        bounce_limits: typing.Annotated[
            collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], "FixedSize(4)"
        ] = [4294967295, 4294967295, 4294967295, 4294967295],
        shadow_catchers: bool = False,
        occlusion_distance_m: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> None:
        """
        bounce_limits: of diffuse, of glossy reflections, of those through surfaces and in media.
        """

class SessionLights:
    """
    What an analytic session gathered, for those to come of the same scene.
    """

class Session:
    """
    A render by native threads. Sessions may share a scene, which must not be edited until all have ended.
    """
    @staticmethod
    def bytes_per_pixel(
        adaptive: bool,
        denoising_passes: bool = False,
        surface_passes: bool = False,
        mattes: bool = False,
        named_passes: typing.SupportsInt | typing.SupportsIndex = 0,
    ) -> int:
        """
        What a session allocates for each pixel of its window.
        """
    def __init__(self, scene: Scene, settings: RenderSettings, known_lights: SessionLights = None) -> None:
        """
        known_lights: of a session before, since when the scene has been edited by set_camera alone; taken over where this session would gather the same.
        """
    def read(self, pass_name: str) -> numpy.typing.NDArray[numpy.float32]:
        """
        A pass as float32 (height, width, channels), bottom row first. Combined: premultiplied RGBA; Depth along the camera's axis, 1e10 where nothing is; Normal, Position: world space; DiffCol; Emit; VolumeDir and VolumeInd: what media scatter to the camera of light that comes to them straight, and of other light; Indirect, what came by way of other surfaces and media. Of the analytic integrator, black elsewhere: Method, the colours of the methods taken; Error, the relative error predicted. With denoising_passes, by Monte Carlo, for a denoiser, of each pixel's own samples, which no pixel filter shares: Noisy Image and Noisy Indirect, as Combined and Indirect; Denoising Albedo, of all lobes; Denoising Normal; Direct Variance and Indirect Variance, of Combined without Indirect and of that, over their colours. With surface_passes: by what surfaces reflect light, over their own colours, DiffDir, DiffInd, GlossDir, GlossInd, TransDir and TransInd, which the analytic integrator leaves black; these colours, Diffuse Color, GlossCol and TransCol; Env, what is seen of the world; UV, by the attribute uv_attribute; Vector, see set_camera; Mist, of (start_m, depth_m, power) mist; IndexOB and IndexMA.
        """
    def read_mattes(
        self, kind: str, rank: typing.SupportsInt | typing.SupportsIndex
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        With mattes: as float32 (height, width, 4) two ids and the share of the pixel that each has, from this rank on, the largest share first.
        """
    def read_named(self, which: typing.SupportsInt | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float32]:
        """
        As float32 (height, width, 3) the light of one of the light_groups, which the analytic integrator leaves black, or, counted after these, two of each of the aovs: what shaders give where a camera sees their surfaces, and, in red, the share of the pixel where they do.
        """
    def read_shadow_catchers(self, kind: str) -> numpy.typing.NDArray[numpy.float32]:
        """
        With shadow_catchers. FACTOR: what others leave of light on these, (height, width, 3). NOTHING, ALPHA or WORLD: Combined with nothing in their place, with alpha where they lose light, or with the world behind them, darkened as much.
        """
    def start(self) -> None:
        """
        Starts the threads and returns at once.
        """
    def stop(self) -> None:
        """
        Ends the render within milliseconds; what is done stays readable.
        """
    def wait(self, seconds: typing.SupportsFloat | typing.SupportsIndex) -> bool:
        """
        Whether the render has ended within the given time; raises what failed in it.
        """
    @property
    def bad_samples(self) -> list[str]:
        """
        The first few samples that were not finite and were left out, by pixel and object.
        """
    @property
    def height(self) -> int: ...
    @property
    def lights(self) -> SessionLights:
        """
        SessionLights; None until they are gathered, and of Monte Carlo.
        """
    @property
    def pixel_samples(self) -> int:
        """
        Samples so far, of all pixels and of those around the window whose samples reach it.
        """
    @property
    def progress(self) -> float:
        """
        0..1
        """
    @property
    def samples_done(self) -> int:
        """
        Samples complete over the whole window; under adaptive sampling, of those pixels that take as many.
        """
    @property
    def sampling_s(self) -> float:
        """
        Since the scene was ready for rays, until the render has ended.
        """
    @property
    def virtual_lights(self) -> tuple[int, int, float]:
        """
        How many virtual lights there are, the photons that they are made of, and the seconds that took; once samples are done.
        """
    @property
    def width(self) -> int: ...

def fog_lamp_pdf(
    light: SphereLight | SpotLight | SunLight | AreaLight,
    g: typing.SupportsFloat | typing.SupportsIndex,
    position: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"],
    direction: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"],
    wi: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
) -> numpy.typing.NDArray[numpy.float32]:
    """
    fog_lamp_pdf(light, g, position, direction, wi): the density of fog_lamp_samples at wi (n, 3), 0 beside the lamp: (n,).
    """

def fog_lamp_samples(
    light: SphereLight | SpotLight | SunLight | AreaLight,
    g: typing.SupportsFloat | typing.SupportsIndex,
    position: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"],
    direction: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"],
    u: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
) -> tuple:
    """
    fog_lamp_samples(light, g, position, direction, u): what u (n, 2) in [0, 1) sample of a lamp from a place in fog of Henyey and Greenstein's phase function that a ray along `direction` crosses: wi (n, 3) and their density per steradian (n,).
    """

def mean_lamp_share(shader: Shader, light: SphereLight | SpotLight | SunLight | AreaLight) -> float:
    """
    mean_lamp_share(shader, light): what a lamp's shader leaves of its light on the whole, in grey.
    """

def ops() -> dict:
    """
    ops(): by name, how many numbers each op of a program takes and gives, and whether it reads where it runs.
    """

def run_op(
    name: str,
    inputs: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    settings: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = [],
    image: Image | None = None,
) -> numpy.typing.NDArray[numpy.float32]:
    """
    run_op(name, inputs, settings=[], image=None): what an op makes of constants, (N, outputs) of inputs (N, inputs).
    """

LOBES: dict = {
    "base": {
        "diffuse": (3, 0.0, 3.4028234663852886e38),
        "alpha": (1, 0.0, 1.0),
        "conductor_f0": (3, 0.0, 3.4028234663852886e38),
        "conductor_f90": (3, 0.0, 3.4028234663852886e38),
        "conductor_weight": (1, 0.0, 3.4028234663852886e38),
        "dielectric_weight": (1, 0.0, 3.4028234663852886e38),
        "dielectric_ior": (1, 1.0, 3.4028234663852886e38),
        "dielectric_tint": (3, 0.0, 3.4028234663852886e38),
        "multiscatter": (1, 0.0, 1.0),
        "weight": (1, 0.0, 3.4028234663852886e38),
        "conductor_dip": (3, 0.0, 3.4028234663852886e38),
    },
    "translucent": {"color": (3, 0.0, 3.4028234663852886e38)},
    "tabulated": {
        "diffuse": (3, 0.0, 3.4028234663852886e38),
        "alpha": (1, 0.0, 1.0),
        "conductor_f0": (3, 0.0, 3.4028234663852886e38),
        "conductor_f90": (3, 0.0, 3.4028234663852886e38),
        "conductor_weight": (1, 0.0, 3.4028234663852886e38),
        "dielectric_weight": (1, 0.0, 3.4028234663852886e38),
        "dielectric_ior": (1, 1.0, 3.4028234663852886e38),
        "dielectric_tint": (3, 0.0, 3.4028234663852886e38),
        "multiscatter": (1, 0.0, 1.0),
        "weight": (1, 0.0, 3.4028234663852886e38),
        "conductor_dip": (3, 0.0, 3.4028234663852886e38),
    },
    "dielectric": {
        "reflection": (3, 0.0, 3.4028234663852886e38),
        "transmission": (3, 0.0, 3.4028234663852886e38),
        "f0_tint": (3, 0.0, 3.4028234663852886e38),
        "alpha": (1, 0.0, 1.0),
        "ior": (1, 9.999999747378752e-06, 3.4028234663852886e38),
        "fresnel": (1, 0.0, 1.0),
        "multiscatter": (1, 0.0, 1.0),
        "weight": (1, 0.0, 3.4028234663852886e38),
        "film_ior": (1, 9.999999747378752e-06, 3.4028234663852886e38),
        "film_nm": (1, 0.0, 3.4028234663852886e38),
        "beckmann": (1, 0.0, 1.0),
    },
    "anisotropic": {
        "conductor_f0": (3, 0.0, 3.4028234663852886e38),
        "conductor_f90": (3, 0.0, 3.4028234663852886e38),
        "conductor_dip": (3, 0.0, 3.4028234663852886e38),
        "conductor_weight": (1, 0.0, 3.4028234663852886e38),
        "dielectric_weight": (1, 0.0, 3.4028234663852886e38),
        "dielectric_ior": (1, 1.0, 3.4028234663852886e38),
        "dielectric_tint": (3, 0.0, 3.4028234663852886e38),
        "color": (3, 0.0, 3.4028234663852886e38),
        "alpha_x": (1, 0.0, 1.0),
        "alpha_y": (1, 0.0, 1.0),
        "rotation": (1, -1000.0, 1000.0),
        "normal": (3, -3.4028234663852886e38, 3.4028234663852886e38),
        "multiscatter": (1, 0.0, 1.0),
        "beckmann": (1, 0.0, 1.0),
    },
    "conductor": {
        "n": (3, 0.0, 3.4028234663852886e38),
        "k": (3, 0.0, 3.4028234663852886e38),
        "color": (3, 0.0, 3.4028234663852886e38),
        "alpha_x": (1, 0.0, 1.0),
        "alpha_y": (1, 0.0, 1.0),
        "rotation": (1, -1000.0, 1000.0),
        "normal": (3, -3.4028234663852886e38, 3.4028234663852886e38),
        "multiscatter": (1, 0.0, 1.0),
        "beckmann": (1, 0.0, 1.0),
    },
    "oren_nayar": {
        "weight": (3, 0.0, 3.4028234663852886e38),
        "color": (3, 0.0, 3.4028234663852886e38),
        "roughness": (1, 0.0, 1.0),
        "keeps_energy": (1, 0.0, 1.0),
    },
    "disney_diffuse": {
        "color": (3, 0.0, 3.4028234663852886e38),
        "roughness": (1, 0.0, 1.0),
        "sheen": (3, 0.0, 3.4028234663852886e38),
    },
    "sheen": {"color": (3, 0.0, 3.4028234663852886e38), "roughness": (1, 0.0, 1.0)},
    "velvet": {"color": (3, 0.0, 3.4028234663852886e38), "sigma": (1, 0.0, 1.0)},
    "hair": {
        "color": (3, 0.0, 3.4028234663852886e38),
        "absorption": (3, 0.0, 3.4028234663852886e38),
        "variance": (1, 9.999999974752427e-07, 3.4028234663852886e38),
        "primary_variance": (1, 9.999999974752427e-07, 3.4028234663852886e38),
        "scale": (1, 0.0010000000474974513, 3.4028234663852886e38),
        "tilt_rad": (1, -1.600000023841858, 1.600000023841858),
        "ior": (1, 1.0, 3.4028234663852886e38),
    },
    "subsurface": {
        "color": (3, 0.0, 3.4028234663852886e38),
        "albedo": (3, 0.0, 1.0),
        "radius_m": (3, 0.0, 3.4028234663852886e38),
        "anisotropy": (1, -0.9900000095367432, 0.9900000095367432),
        "ior": (1, 1.0099999904632568, 3.799999952316284),
        "entry_alpha": (1, 0.0, 1.0),
        "cosine_entry": (1, 0.0, 1.0),
        "is_diffusion_length": (1, 0.0, 1.0),
        "is_similar": (1, 0.0, 1.0),
        "is_always_walked": (1, 0.0, 1.0),
        "disney": (1, 0.0, 1.0),
        "roughness": (1, 0.0, 1.0),
    },
    "thin_film": {
        "ior": (1, 1.0, 3.4028234663852886e38),
        "film_ior": (1, 1.0, 3.4028234663852886e38),
        "film_nm": (1, 0.0, 3.4028234663852886e38),
        "f0_tint": (3, 0.0, 3.4028234663852886e38),
        "color": (3, 0.0, 3.4028234663852886e38),
        "alpha_x": (1, 0.0, 1.0),
        "alpha_y": (1, 0.0, 1.0),
        "rotation": (1, -1000.0, 1000.0),
        "normal": (3, -3.4028234663852886e38, 3.4028234663852886e38),
        "multiscatter": (1, 0.0, 1.0),
        "beckmann": (1, 0.0, 1.0),
    },
    "strand": {
        "color": (3, 0.0, 3.4028234663852886e38),
        "transmits": (1, 0.0, 1.0),
        "roughness_along": (1, 0.0, 1.0),
        "roughness_around": (1, 0.0, 1.0),
        "tilt_rad": (1, -1.600000023841858, 1.600000023841858),
    },
    "ashikhmin_shirley": {
        "color": (3, 0.0, 3.4028234663852886e38),
        "alpha_x": (1, 0.0, 1.0),
        "alpha_y": (1, 0.0, 1.0),
        "rotation": (1, -1000.0, 1000.0),
        "normal": (3, -3.4028234663852886e38, 3.4028234663852886e38),
    },
    "toon": {
        "color": (3, 0.0, 3.4028234663852886e38),
        "size": (1, 0.0, 1.0),
        "smooth": (1, 0.0, 1.0),
        "glossy": (1, 0.0, 1.0),
    },
    "metal_film": {
        "n": (3, 0.0, 3.4028234663852886e38),
        "k": (3, 0.0, 3.4028234663852886e38),
        "f82": (3, 0.0, 1.0),
        "has_f82": (1, 0.0, 1.0),
        "film_ior": (1, 1.0, 3.4028234663852886e38),
        "film_nm": (1, 0.0, 3.4028234663852886e38),
        "color": (3, 0.0, 3.4028234663852886e38),
        "alpha_x": (1, 0.0, 1.0),
        "alpha_y": (1, 0.0, 1.0),
        "rotation": (1, -1000.0, 1000.0),
        "normal": (3, -3.4028234663852886e38, 3.4028234663852886e38),
        "multiscatter": (1, 0.0, 1.0),
        "beckmann": (1, 0.0, 1.0),
    },
    "thin_glass": {"color": (3, 0.0, 3.4028234663852886e38), "alpha": (1, 0.0, 1.0)},
    "clearcoat": {
        "weight": (1, 0.0, 3.4028234663852886e38),
        "alpha": (1, 0.0, 0.8999999761581421),
        "normal": (3, -3.4028234663852886e38, 3.4028234663852886e38),
    },
}
LOBES_WITH_NDF: list = ["tabulated"]
MAX_LOBES: int = 3
arch: str
version: str
