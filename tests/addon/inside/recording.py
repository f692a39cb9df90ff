"""pivot_core's interface without its work: what the addon hands over in a render, as plain values.

Calls have the core's own parameters, so a misnamed one fails as it would there. Programs and their ops are the core's.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, fields
from types import ModuleType, SimpleNamespace
from typing import Any
from unittest.mock import patch

import bpy
import numpy as np


@dataclass
class Material:
    diffuse: Any = (0, 0, 0)
    alpha: float = 0.5
    conductor_f0: Any = (0, 0, 0)
    conductor_f90: Any = (0, 0, 0)
    conductor_weight: float = 1.0
    dielectric_weight: float = 0.0
    dielectric_ior: float = 1.5
    dielectric_tint: Any = (1, 1, 1)
    multiscatter: bool = False
    weight: float = 1.0
    emission: Any = (0, 0, 0)
    lobes: Any = ()
    transparency: Any = (0, 0, 0)
    opacity: float | None = None
    conductor_dip: Any = (0, 0, 0)


@dataclass
class Shader:
    constants: Material
    program: Any
    varying: dict[str, list[int]]


@dataclass
class VoxelGrid:
    values: Any
    grid_from_object: Any


@dataclass(kw_only=True)
class Medium:
    scattering: Any = ()
    absorption: Any = (0, 0, 0)
    emission: Any = (0, 0, 0)
    density: VoxelGrid | None = None
    emission_grid: VoxelGrid | None = None


@dataclass
class SphereLight:
    position: Any
    radius_m: float
    intensity: Any
    facing_disk: bool = False


@dataclass
class SpotLight:
    position: Any
    radius_m: float
    intensity: Any
    direction: Any
    cos_half_angle: float
    blend: float
    facing_disk: bool = False
    cosine: bool = False


@dataclass
class SunLight:
    direction: Any
    half_angle_rad: float
    irradiance: Any


@dataclass
class AreaLight:
    center: Any
    half_u: Any
    half_v: Any
    radiance: Any
    ellipse: bool = False
    spread_rad: float = math.pi


@dataclass
class RenderSettings:
    integrator: str
    samples: int
    adaptive: bool
    seed: int
    max_bounces: int
    max_passages: int
    max_path_passages: int
    clamp_indirect: float
    filter_glossy: float
    light_sampling: str
    error_budget_percent: float
    analytic_method: str
    occlusion: str
    indirect: str
    virtual_lights: int
    time_limit_s: float
    threads: int
    filter_width_px: float
    transparent_film: bool
    denoising_passes: bool


@dataclass
class Recording:
    """What one render handed over: the scene of its last view layer and frame, and all cameras and reports."""

    meshes: list[SimpleNamespace] = field(default_factory=list)
    instances: list[SimpleNamespace] = field(default_factory=list)
    materials: dict[str, Material | Shader] = field(default_factory=dict)
    media: dict[str, Medium | None] = field(default_factory=dict)  # within each material
    without_surface: set[str] = field(default_factory=set)  # materials
    world_medium: Medium | None = None
    lights: dict[str, Any] = field(default_factory=dict)
    rules: dict[str, Any] = field(default_factory=dict)  # of each light
    lamp_shaders: dict[str, Any] = field(default_factory=dict)  # of lights whose nodes vary
    world: Any = None
    cameras: list[SimpleNamespace] = field(default_factory=list)
    settings: RenderSettings | None = None
    reports: list[str] = field(default_factory=list)
    motions: dict[int, Any] = field(default_factory=dict)  # of instances
    mesh_motions: dict[int, SimpleNamespace] = field(default_factory=dict)

    @property
    def camera(self) -> SimpleNamespace:
        return self.cameras[-1]

    def light(self, name: str) -> dict[str, Any]:
        light = self.lights[name]
        return {"type": type(light).__name__} | {f.name: getattr(light, f.name) for f in fields(light)}


class Scene:
    has_shadow_catchers = False

    def __init__(self) -> None:
        self.recording = recording = _recordings[-1]
        self.attributes: dict[str, int] = {}
        collections = (recording.meshes, recording.instances, recording.materials, recording.media, recording.lights)
        for collection in (*collections, recording.without_surface):
            collection.clear()  # each view layer and frame has a scene of its own
        recording.world_medium = None

    def add_mesh(
        self,
        name: str,
        positions: Any,
        corner_vertices: Any,
        triangle_corners: Any,
        corner_normals: Any = None,
        vertex_normals: Any = None,
        triangle_slots: Any = None,
        vertex_attributes: Any = None,
        corner_attributes: Any = None,
    ) -> int:
        mesh = dict(locals())
        del mesh["self"]
        self.recording.meshes.append(SimpleNamespace(**mesh))
        return len(self.recording.meshes) - 1

    def add_instances(
        self,
        name: str,
        mesh: int,
        object_to_world: Any,
        materials: Any,
        hidden_from: Sequence[str] = (),
        holdout: bool = False,
        matte: Any = (0, 0),
        color: Any = (1, 1, 1, 1),
        pass_index: float = 0,
        random: Any = None,
        particle_index: Any = None,
        generated: Any = None,
        uv: Any = None,
        attributes: Any = None,
        own_attributes: Any = None,
        light_group: int = -1,
        links: Any = (),
        link_sets: Any = (),
        shadow_catcher: bool = False,
    ) -> int:
        self.has_shadow_catchers = self.has_shadow_catchers or shadow_catcher
        materials = [list(self.recording.materials)[material] for material in materials]
        self.recording.instances.append(
            SimpleNamespace(
                name=name,
                mesh=mesh,
                object_to_world=np.array(object_to_world),
                materials=materials,
                hidden_from=list(hidden_from),
                holdout=holdout,
            )
        )
        return len(self.recording.instances) - 1

    def attribute_id(self, name: str) -> int:
        return self.attributes.setdefault(name, len(self.attributes))

    def add_material(
        self,
        name: str,
        material: Material | Shader,
        medium: Medium | None = None,
        has_surface: bool = True,
        pass_index: float = 0,
        matte: float = 0,
        filters_shadows: bool = True,
    ) -> int:
        assert name not in self.recording.materials, f"material {name} came twice"
        self.recording.materials[name] = material
        self.recording.media[name] = medium
        if not has_surface:
            self.recording.without_surface.add(name)
        return len(self.recording.materials) - 1

    def add_light(
        self,
        name: str,
        light: Any,
        hidden_from: Sequence[str] = (),
        max_bounces: int = 1024,
        light_group: int = -1,
        links: Any = (),
        shader: Any = None,
    ) -> int:
        self.recording.lights[name] = light
        if shader is not None:
            self.recording.lamp_shaders[name] = shader
        self.recording.rules[name] = (list(hidden_from), max_bounces)
        return len(self.recording.lights) - 1

    def set_world(self, radiance: Any) -> None:
        self.recording.world = list(radiance)

    def set_world_shader(self, shader: Shader) -> None:
        self.recording.world = shader

    def set_instance_motion(self, id: int, object_to_world: Any) -> None:
        self.recording.motions[id] = np.array(object_to_world)

    def set_mesh_motion(self, id: int, positions: Any, corner_normals: Any = None, vertex_normals: Any = None) -> None:
        self.recording.mesh_motions[id] = SimpleNamespace(
            positions=np.array(positions), corner_normals=corner_normals, vertex_normals=vertex_normals
        )

    def set_world_light_group(self, light_group: int) -> None:
        pass

    def set_world_rules(self, hidden_from: Sequence[str] = (), max_bounces: int = 1024) -> None:
        pass

    def set_world_medium(self, medium: Medium | None) -> None:
        self.recording.world_medium = medium

    def set_camera(
        self,
        camera_to_world: Any,
        view_plane: Any,
        width: int,
        height: int,
        window: Any,
        clip_start_m: float,
        clip_end_m: float,
        projection: Any,
        lens: Any,
        motion: Any = None,
        shutter: Any = None,
        blurs: bool = True,
    ) -> None:
        camera = dict(locals())
        del camera["self"]
        self.recording.cameras.append(SimpleNamespace(**camera))


class Session:
    progress = 1.0
    bad_samples: tuple[str, ...] = ()
    virtual_lights = (0, 0, 0.0)

    @staticmethod
    def bytes_per_pixel(
        adaptive: bool,
        denoising_passes: bool,
        surface_passes: bool = False,
        mattes: bool = False,
        named_passes: int = 0,
    ) -> int:
        return 88

    def __init__(self, scene: Scene, settings: RenderSettings) -> None:
        scene.recording.settings = settings
        self.samples_done = settings.samples
        x0, y0, x1, y1 = scene.recording.cameras[-1].window
        self.width, self.height = x1 - x0, y1 - y0

    def start(self) -> None:
        pass

    def wait(self, seconds: float) -> bool:
        return True

    def stop(self) -> None:
        pass

    def read(self, name: str) -> Any:
        channels = {"Combined": 4, "Depth": 1}.get(name, 3)
        return np.zeros((self.height, self.width, channels), np.float32)


# The core's, recorded as their names and arguments.
OPTICS = (
    "Perspective",
    "Orthographic",
    "Equirectangular",
    "CentralCylindrical",
    "FisheyeEquidistant",
    "FisheyeEquisolid",
    "FisheyePolynomial",
    "CubeMapFace",
    "MirrorBall",
    "Lens",
)

_recordings: list[Recording] = []


@contextmanager
def _in_place_of_the_core() -> Iterator[None]:
    real = sys.modules["pivot.core"].load()
    core: Any = ModuleType("pivot_core")
    for name in ("version", "ops", "run_op", "Program", "Image", "TabulatedNdf"):
        setattr(core, name, getattr(real, name))
    core.mean_lamp_share = lambda shader, light: 3.0
    for name in OPTICS:
        setattr(core, name, lambda *numbers, name=name: (name, *numbers))
    for part in (
        Material,
        Shader,
        VoxelGrid,
        Medium,
        SphereLight,
        SpotLight,
        SunLight,
        AreaLight,
        RenderSettings,
        Scene,
        Session,
    ):
        setattr(core, part.__name__, part)
    engine: Any = sys.modules["pivot.engine"]
    reporter = engine.Reporter
    with (
        patch.dict(sys.modules, pivot_core=core),
        patch.object(
            engine, "Reporter", lambda _, said: reporter(lambda _, text: _recordings[-1].reports.append(text), said)
        ),
    ):
        yield


def record(**operator_arguments: Any) -> Recording:
    """Render the scene and return what the addon handed over."""
    _recordings.append(Recording())
    sys.modules["pivot.engine"].PivotRenderEngine.said_in_job.clear()
    bpy.context.scene.render.engine = "PIVOT"
    with _in_place_of_the_core():
        bpy.ops.render.render(**operator_arguments)
    return _recordings[-1]
