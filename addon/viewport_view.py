"""What a 3D view looks at, and the part of it that is rendered."""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import ModuleType
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from .export.optics import Optics, lens_of, optics_of

_KINDS = tuple(
    property_.identifier
    for property_ in bpy.types.SpaceView3D.bl_rna.properties
    if property_.identifier.startswith("show_object_viewport_")
)

Corners = tuple[float, float, float, float]  # left, bottom, right, top


@dataclass(frozen=True)
class View:
    """A camera that sees what a 3D view does."""

    camera_to_world: tuple[tuple[float, ...], ...]  # (4, 4)
    optics: Optics  # of the whole region
    size_px: tuple[int, int]  # of the region
    window_px: tuple[int, int, int, int]  # left, bottom, right, top of what is rendered of it

    def set_camera(self, core: ModuleType, core_scene: Any, pixel_px: float) -> Corners:
        """Have a pivot_core.Scene seen so, by pixels of about this edge. Returns what they cover, in the region's."""
        size = [max(1, round(side / pixel_px)) for side in self.size_px]
        edges_px = [side_px / side for side_px, side in zip(self.size_px, size, strict=True)] * 2
        left, bottom, right, top = self.window_px
        x0, y0 = int(left / edges_px[0]), int(bottom / edges_px[1])
        x1, y1 = (-int(-side // edge_px) for side, edge_px in zip((right, top), edges_px, strict=False))
        window = x0, y0, min(x1, size[0]), min(y1, size[1])
        width, height = size
        core_scene.set_camera(
            np.array(self.camera_to_world), width=width, height=height, window=window, **self.optics.arguments(core)
        )
        x0, y0, x1, y1 = (side * edge_px for side, edge_px in zip(window, edges_px, strict=True))
        return x0, y0, x1, y1

    def place_of(self, corners: Corners, other: View) -> Corners:
        """Where in this region lies what another view shows at `corners` of its own.

        Their planes tell: while a region is resized, a picture of its size before is as large as it was.
        """
        placed = []
        for axis in (0, 1):
            low, high = other.optics.view_plane[2 * axis : 2 * axis + 2]
            own_low, own_high = self.optics.view_plane[2 * axis : 2 * axis + 2]
            for side_px in corners[axis::2]:
                on_plane = low + (high - low) * side_px / other.size_px[axis]
                placed.append((on_plane - own_low) / (own_high - own_low) * self.size_px[axis])
        left, right, bottom, top = placed
        return left, bottom, right, top


def view_of(context: bpy.types.Context, depsgraph: bpy.types.Depsgraph) -> View:
    """What the 3D view of a context looks at."""
    space, region_3d, region = context.space_data, context.region_data, context.region
    projection = np.array(region_3d.window_matrix)
    is_orthographic = bool(projection[3, 3] == 1)
    # A point (x, y, -1) projects to scale * x + offset in -1..1; without perspective any (x, y, z) does.
    scale = projection[[0, 1], [0, 1]]
    offset = projection[:2, 3] if is_orthographic else -projection[:2, 2]
    (left, bottom), (right, top) = (tuple(map(float, (side - offset) / scale)) for side in (-1, 1))
    size_px = region.width, region.height
    camera_to_world = np.array(region_3d.view_matrix.inverted())
    corners, clip_m, lens, panorama = (0.0, 0.0, 1.0, 1.0), (space.clip_start, space.clip_end), None, None
    camera = _camera(space, region_3d, depsgraph)
    if camera is not None:
        frame = [corner.xy if is_orthographic else corner.xy / -corner.z for corner in _frame(camera, depsgraph)]
        (x0, y0), (x1, y1) = ((scale * corner + offset + 1) / 2 for corner in (frame[2], frame[0]))
        corners = _rendered(camera, space, depsgraph.scene.render, (x0, y0, x1, y1))
        if camera.data.type == "PANO":
            panorama = _panorama(camera, camera_to_world, depsgraph.scene.render, (x0, y0, x1, y1))
        clip_m = camera.data.clip_start, camera.data.clip_end
        lens = lens_of(camera.data, camera_to_world)
    else:
        if is_orthographic:  # it sees as far behind itself as before it
            clip_m = -clip_m[1] / 2, clip_m[1] / 2
        if space.use_render_border:
            corners = _border(space, "render_border_", corners)
    kind = ("Orthographic",) if is_orthographic else ("Perspective",)
    return View(
        camera_to_world=tuple(map(tuple, camera_to_world.tolist())),
        optics=panorama or Optics((left, right, bottom, top), clip_m, kind, lens),
        size_px=size_px,
        window_px=_window(corners, size_px),
    )


def _camera(space: Any, region_3d: Any, depsgraph: bpy.types.Depsgraph) -> Any:
    """The evaluated camera that a 3D view looks through, None where it looks by itself."""
    camera = space.camera if space.use_local_camera else depsgraph.scene.camera
    if region_3d.view_perspective != "CAMERA" or camera is None or camera.type != "CAMERA":
        return None
    return camera.evaluated_get(depsgraph)


def _frame(camera: Any, depsgraph: bpy.types.Depsgraph) -> Any:
    """The corners of a camera's frame in its own space: the top right one, then clockwise."""
    return camera.data.view_frame(scene=depsgraph.scene)


def _panorama(camera: Any, camera_to_world: NDArray[np.float64], render: Any, frame: Corners) -> Optics:
    """A panoramic camera's, so that its frame in the region, in shares of that, shows what is rendered."""
    width, height = render.resolution_x * render.pixel_aspect_x, render.resolution_y * render.pixel_aspect_y
    rendered = optics_of(camera, camera_to_world, camera.data.shift_x, width, height)
    sides = []
    for low, high, begin, end in zip(
        rendered.view_plane[::2], rendered.view_plane[1::2], frame, frame[2:], strict=False
    ):
        sides += [low + (high - low) * (share - begin) / (end - begin) for share in (0.0, 1.0)]
    return replace(rendered, view_plane=tuple(map(float, sides)))


def _rendered(camera: Any, space: Any, render: Any, frame: Corners) -> Corners:
    """What is rendered about a camera's frame. All corners are shares of the region."""
    if render.use_border:
        return _border(render, "border_", frame)
    is_alone = camera.data.show_passepartout and camera.data.passepartout_alpha == 1 and space.overlay.show_overlays
    return frame if is_alone else (0.0, 0.0, 1.0, 1.0)


def _border(settings: Any, prefix: str, around: Corners) -> Corners:
    left, bottom, right, top = around
    x0, x1 = (left + getattr(settings, f"{prefix}{side}_x") * (right - left) for side in ("min", "max"))
    y0, y1 = (bottom + getattr(settings, f"{prefix}{side}_y") * (top - bottom) for side in ("min", "max"))
    return x0, y0, x1, y1


def _window(corners: Corners, size_px: tuple[int, int]) -> tuple[int, int, int, int]:
    """The region's pixels that lie within, one at least."""
    width, height = size_px
    x0, y0, x1, y1 = (round(corner * side) for corner, side in zip(corners, size_px * 2, strict=True))
    x0, y0 = min(max(x0, 0), width - 1), min(max(y0, 0), height - 1)
    return x0, y0, min(max(x1, x0 + 1), width), min(max(y1, y0 + 1), height)


def local_parts(space: Any) -> tuple[bool, ...]:
    """What of the scene a 3D view shows beside others: whether only some of it, and of which kinds."""
    kinds = (getattr(space, kind) for kind in _KINDS)
    return space.local_view is not None, space.use_local_collections, *kinds


def shows_all(space: Any) -> bool:
    is_local, has_own_collections, *kinds = local_parts(space)
    return not is_local and not has_own_collections and all(kinds)
