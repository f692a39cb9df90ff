"""A scene as it is edited: a render between edits leaves no trace in the next picture; and what its meshes may hold."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pivot_core
import pytest

from tests.core.scenes import Floats, add_plane, add_sphere, place, render, set_camera


@dataclass
class Edited:
    """A scene with what its edits name: materials, meshes, instances and lamps by their ids."""

    scene: pivot_core.Scene
    grey: int
    glow: int
    red_glow: int
    panel: int
    ball: int
    bulb: int
    red_panel: int
    lamp: int


def lamp_at(x: float, strength: float = 20.0) -> pivot_core.SphereLight:
    return pivot_core.SphereLight((x, -2, 3), 0.3, (strength,) * 3)


def built() -> Edited:
    """A floor and a ball under a bulb and a panel that shine, and a lamp."""
    scene = pivot_core.Scene()
    grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.5,) * 3, alpha=0.3, dielectric_weight=1.0))
    glow = scene.add_material("glow", pivot_core.Material(emission=(8, 8, 8)))
    red_glow = scene.add_material("red glow", pivot_core.Material(emission=(9, 1, 1)))
    panel = add_plane(scene, 0.5)
    scene.add_instances("floor", add_plane(scene, 10), place(), [grey])
    sphere = add_sphere(scene, 16)
    bulb = scene.add_instances("bulb", sphere, place(-1.2, 0, 0.8, 0.3), [glow])
    ball = scene.add_instances("ball", sphere, place(0, 0, 0.5, 0.5), [grey])
    red_panel = scene.add_instances("red panel", panel, place(1.2, 0, 1.2), [red_glow])
    lamp = scene.add_light("lamp", lamp_at(1.0))
    set_camera(scene, (0, -5, 3), (0, 0, 0.5), (24, 18), 0.35)
    return Edited(scene, grey, glow, red_glow, panel, ball, bulb, red_panel, lamp)


EDITS: dict[str, Callable[[Edited], object]] = {
    "material": lambda e: e.scene.set_material(e.grey, pivot_core.Material(diffuse=(0.1, 0.4, 0.2), alpha=0.2)),
    "colour under emission": lambda e: e.scene.set_material(
        e.glow, pivot_core.Material(diffuse=(0.9,) * 3, emission=(8, 8, 8))
    ),
    "emission": lambda e: e.scene.set_material(e.glow, pivot_core.Material(emission=(2, 4, 9))),
    "emission off": lambda e: e.scene.set_material(e.glow, pivot_core.Material(diffuse=(0.8,) * 3)),
    "emission on": lambda e: e.scene.set_material(e.grey, pivot_core.Material(emission=(0.1, 0.2, 0.1))),
    "an instance's materials": lambda e: e.scene.set_instance_materials(e.bulb, [e.red_glow]),
    "materials that shine": lambda e: e.scene.set_instance_materials(e.ball, [e.glow]),
    "a lamp": lambda e: e.scene.set_light(e.lamp, lamp_at(-1.0, 40.0)),
    "another lamp": lambda e: e.scene.add_light("other", lamp_at(-2.0)),
    "a lamp less": lambda e: e.scene.remove_light(e.lamp),
    "world": lambda e: e.scene.set_world((0.2, 0.3, 0.4)),
    "camera": lambda e: set_camera(e.scene, (1, -5, 2), (0, 0, 0.5), (24, 18), 0.35),
    "a move": lambda e: e.scene.set_instance_transform(e.ball, place(0.4, -0.6, 0.7, 0.5)[0]),
    "a move of light": lambda e: e.scene.set_instance_transform(e.bulb, place(-0.9, -0.5, 1.2, 0.3)[0]),
    "hidden from the camera": lambda e: e.scene.set_instance_visibility(e.ball, hidden_from=["CAMERA"]),
    "light hidden from the camera": lambda e: e.scene.set_instance_visibility(e.bulb, hidden_from=["CAMERA"]),
    "an instance less": lambda e: e.scene.remove_instance(e.ball),
    "light less": lambda e: e.scene.remove_instance(e.bulb),
    "more light": lambda e: e.scene.add_instances("more", e.panel, place(0, 0, 1.8), [e.red_glow]),
}
INTEGRATORS = {
    "monte carlo": {"samples": 4, "max_bounces": 1},
    "bent cones": {"integrator": "ANALYTIC", "occlusion": "BENT_CONE", "samples": 1},
}


def picture(edited: Edited, integrator: str) -> Floats:
    return render(edited.scene, **INTEGRATORS[integrator])


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("edit", EDITS)
def test_an_edit_between_renders_is_one_before_the_first(edit: str, integrator: str) -> None:
    fresh, edited = built(), built()
    before = picture(edited, integrator)
    for scene in (fresh, edited):
        EDITS[edit](scene)
    after = picture(edited, integrator)
    np.testing.assert_array_equal(after, picture(fresh, integrator))
    assert (after != before).any()


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_edits_one_after_the_other(integrator: str) -> None:
    """Each of those that leave their objects there, a render after each."""
    fresh, edited = built(), built()
    for name, edit in EDITS.items():
        if name.endswith("less"):
            continue
        picture(edited, integrator)
        for scene in (fresh, edited):
            edit(scene)
    np.testing.assert_array_equal(picture(edited, integrator), picture(fresh, integrator))


def test_an_instance_hidden_and_shown_is_what_it_was() -> None:
    """Of instances in world space, and of one that was moved and is traced in its own."""
    edited = built()
    edited.scene.set_instance_transform(edited.bulb, place(-0.9, -0.5, 1.2, 0.3)[0])
    shown = picture(edited, "monte carlo")
    for instance in (edited.ball, edited.bulb):
        edited.scene.set_instance_visibility(instance, hidden_from=["CAMERA"])
        assert (picture(edited, "monte carlo") != shown).any()
        edited.scene.set_instance_visibility(instance, hidden_from=[])
        np.testing.assert_array_equal(picture(edited, "monte carlo"), shown)


def test_an_edit_that_is_refused_changes_nothing() -> None:
    edited = built()
    before = picture(edited, "monte carlo")
    with pytest.raises(ValueError, match="object 'ball' has no material id"):
        edited.scene.set_instance_materials(edited.ball, [])
    with pytest.raises(ValueError, match="material 9 is not in the scene"):
        edited.scene.set_instance_materials(edited.ball, [9])
    with pytest.raises(ValueError, match="instance 9 is not in the scene"):
        edited.scene.set_instance_visibility(9, hidden_from=["CAMERA"])
    second_is_broken = np.concatenate([place(0, 0, 2), np.full((1, 4, 4), np.nan, np.float32)])
    with pytest.raises(ValueError, match="object 'two': its transform is not finite"):
        edited.scene.add_instances("two", edited.panel, second_is_broken, [edited.grey])
    np.testing.assert_array_equal(picture(edited, "monte carlo"), before)


def test_an_edit_in_another_thread_is_all_in_the_picture_or_refused() -> None:
    """A wall of tiles, one edit, that a session meets at any time of it."""
    side = 160
    x, z = (grid.ravel() for grid in np.meshgrid(np.linspace(-1, 1, side), np.linspace(-1, 1, side)))
    tiles = np.repeat(place(scale=2 / side), side * side, 0)
    tiles[:, :3, 3] = np.stack([x, np.zeros_like(x), z], -1)
    tiles[:, :3, :3] = tiles[:, :3, [0, 2, 1]]  # facing the camera

    def meet(wait_s: float) -> tuple[bool, float, float]:
        """Whether the edit was taken, the covered share of the picture, and how long the edit took."""
        scene = pivot_core.Scene()
        white = scene.add_material("white", pivot_core.Material(emission=(1, 1, 1)))
        tile = add_plane(scene, 1.0)
        set_camera(scene, (0, -4, 0), size=(32, 32), half_width=0.2)
        taken, took_s = [], []

        def edit() -> None:
            start_s = time.perf_counter()
            try:
                scene.add_instances("tiles", tile, tiles, [white])
                taken.append(True)
            except RuntimeError:  # the scene is being rendered
                taken.append(False)
            took_s.append(time.perf_counter() - start_s)

        session = pivot_core.Session(scene, pivot_core.RenderSettings(samples=1, max_bounces=0, transparent_film=True))
        thread = threading.Thread(target=edit)
        thread.start()
        time.sleep(wait_s)
        session.start()
        thread.join()
        while not session.wait(10.0):
            pass
        return taken[0], float(session.read("Combined")[..., 3].mean()), took_s[0]

    *_, edit_s = meet(1.0)
    for share in np.linspace(0.0, 1.0, 24):
        taken, covered, _ = meet(share * edit_s)
        assert covered == (1.0 if taken else 0.0)


def test_normals_of_vertices_are_those_of_their_corners() -> None:
    """A cap of four triangles around a tip, smooth."""
    vertices = np.array([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 0.5]], np.float32)
    corners = np.array([0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4])
    normals = vertices + np.array([0, 0, 1], np.float32)

    def shown(**given: Floats) -> Floats:
        scene = pivot_core.Scene()
        shiny = scene.add_material("shiny", pivot_core.Material(diffuse=(0.5,) * 3, alpha=0.3, dielectric_weight=1.0))
        mesh = scene.add_mesh("cap", vertices, corners, np.arange(12).reshape(4, 3), **given)
        scene.add_instances("cap", mesh, place(), [shiny])
        scene.add_light("lamp", lamp_at(1.0))
        set_camera(scene, (0, -3, 3), (0, 0, 0), (24, 18), 0.35)
        return render(scene, samples=4)

    np.testing.assert_array_equal(shown(vertex_normals=normals), shown(corner_normals=normals[corners]))
    assert (shown(vertex_normals=normals) != shown()).any()
    with pytest.raises(ValueError, match="mesh 'cap': give corner_normals or vertex_normals, not both"):
        shown(vertex_normals=normals, corner_normals=normals[corners])
    with pytest.raises(ValueError, match="mesh 'cap': the normal of vertex 1 is not finite"):
        shown(vertex_normals=np.where(np.arange(5)[:, None] == 1, np.nan, normals))
