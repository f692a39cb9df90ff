"""A viewport's scene beside one that is exported from nothing: rays in both must give the same, bit by bit."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

WIDTH, HEIGHT = 48, 32
PASSES = ("Combined", "Depth", "Normal", "DiffCol")


def _picture(core: Any, scene: Any) -> dict[str, Any]:
    turned = np.diag([1.0, 1, 1, 1])
    turned[:3, 3] = 0, 0, 12
    scene.set_camera(turned, (-0.6, 0.6, -0.4, 0.4), WIDTH, HEIGHT)
    session = core.Session(scene, core.RenderSettings(samples=1, max_bounces=1))
    session.start()
    session.wait(20.0)
    return {name: session.read(name) for name in PASSES}


def differing(viewport: Any) -> list[str]:
    """The passes in which a new export is not as the viewport's, whose session is ended for it."""
    from pivot.export.mesh_cache import MeshCache
    from pivot.export.scene import export_scene
    from pivot.report import Reporter

    viewport._session.stop()
    viewport._session.wait(20.0)
    reporter = Reporter(lambda level, text: None, set())
    depsgraph = bpy.context.evaluated_depsgraph_get()
    fresh = export_scene(viewport._core, depsgraph, reporter, lambda: None, meshes=MeshCache(viewport._core)).scene
    expected, found = _picture(viewport._core, fresh), _picture(viewport._core, viewport._scene)
    return [name for name in PASSES if not np.array_equal(expected[name], found[name])]
