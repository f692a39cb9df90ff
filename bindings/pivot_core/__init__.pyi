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
    "Material",
    "RenderSettings",
    "Scene",
    "Session",
    "SphereLight",
    "SpotLight",
    "SunLight",
    "arch",
    "version",
]

class Material:
    """
    A Lambert lobe beneath one GGX lobe, and emission; colours are linear RGB.

    The lobe's Fresnel is a Schlick curve from conductor_f0 to conductor_f90, in which conductor_weight is multiplied, plus, times dielectric_weight, the curve of a dielectric of dielectric_ior whose reflectance at normal incidence is scaled by dielectric_tint. alpha must be in [0, 1], dielectric_ior at least 1.
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
        emission: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ] = [0.0, 0.0, 0.0],
    ) -> None: ...

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
    A parallelogram center +- half_u +- half_v, or the ellipse in it, shining towards cross(half_u, half_v) with the given radiance.
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
    ) -> None: ...

class Scene:
    """
    Meshes, instances, materials, lights, world and camera, edited by id. Metres; world space is z up.
    """
    def __init__(self) -> None: ...
    def add_instances(
        self,
        name: str,
        mesh: typing.SupportsInt | typing.SupportsIndex,
        object_to_world: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        materials: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
        camera_visible: bool = True,
    ) -> int:
        """
        object_to_world (N, 4, 4) row-major; materials: an id per slot, a slot past the end uses the last. Returns the first of N consecutive ids.
        """
    def add_light(self, name: str, light: SphereLight | SpotLight | SunLight | AreaLight) -> int: ...
    def add_material(self, name: str, material: Material) -> int: ...
    def add_mesh(
        self,
        name: str,
        positions: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        corner_vertices: typing.Annotated[numpy.typing.ArrayLike, numpy.int32],
        triangle_corners: typing.Annotated[numpy.typing.ArrayLike, numpy.int32],
        corner_normals: typing.Annotated[numpy.typing.ArrayLike, numpy.float32] | None = None,
        vertex_normals: typing.Annotated[numpy.typing.ArrayLike, numpy.float32] | None = None,
        corner_uvs: typing.Annotated[numpy.typing.ArrayLike, numpy.float32] | None = None,
        triangle_slots: typing.Annotated[numpy.typing.ArrayLike, numpy.int32] | None = None,
    ) -> int:
        """
        positions (V, 3), corner_vertices (C,), triangle_corners (T, 3), corner_normals (C, 3) or vertex_normals (V, 3), without both flat shading, corner_uvs (C, 2), triangle_slots (T,) material slots. Returns the mesh's id.
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
    ) -> tuple:
        """
        The light that each u (n,) in [0, 1) chooses down the light tree, (n,), -1 where none reaches the point, and with which probability, (n,).
        """
    def intersect(
        self,
        origins: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        directions: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        packets: bool = True,
    ) -> tuple:
        """
        Closest hits of rays (n, 3), unit directions: distance_m (n,), infinite where there is none; instance and triangle (n,), -1 where there is none; barycentric (n, 2).
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
        Its nodes, the root first, each as (child (n,): a node, or ~light; center (n, 3); radius_m (n,); radiance (n,), the mean over colours; sun_versine (n,)): the spheres, or where sun_versine is above 0 the caps, that stand for the children.
        """
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
    ) -> None:
        """
        camera_to_world (4, 4): the camera looks down its -z. view_plane: (left, right, bottom, top) of the full frame at z = -1. window: (x0, y0, x1, y1), the pixels to render, from the bottom left.
        """
    def set_instance_materials(
        self,
        id: typing.SupportsInt | typing.SupportsIndex,
        materials: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
    ) -> None:
        """
        materials: as in add_instances.
        """
    def set_instance_transform(
        self,
        id: typing.SupportsInt | typing.SupportsIndex,
        object_to_world: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    ) -> None: ...
    def set_instance_visibility(self, id: typing.SupportsInt | typing.SupportsIndex, camera_visible: bool) -> None: ...
    def set_light(
        self, id: typing.SupportsInt | typing.SupportsIndex, light: SphereLight | SpotLight | SunLight | AreaLight
    ) -> None: ...
    def set_material(self, id: typing.SupportsInt | typing.SupportsIndex, material: Material) -> None: ...
    def set_world(
        self,
        radiance: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ],
    ) -> None: ...

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
    ) -> None: ...

class Session:
    """
    A render by native threads. Sessions may share a scene, which must not be edited until all have ended. bytes_per_pixel: what one allocates for each pixel of its window, the counts of adaptive sampling included.
    """

    bytes_per_pixel: typing.ClassVar[int] = 112
    def __init__(self, scene: Scene, settings: RenderSettings) -> None: ...
    def read(self, pass_name: str) -> numpy.typing.NDArray[numpy.float32]:
        """
        A pass as float32 (height, width, channels), bottom row first. Combined: premultiplied RGBA; Depth along the camera's axis, 1e10 where nothing is; Normal, Position: world space; DiffCol; Emit. Of the analytic integrator, black elsewhere: Method, the colours of the methods taken; Error, the relative error predicted.
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
    def progress(self) -> float:
        """
        0..1
        """
    @property
    def samples_done(self) -> int:
        """
        Samples complete over the whole window.
        """
    @property
    def width(self) -> int: ...

arch: str
version: str
