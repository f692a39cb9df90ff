"""Rays through pivot_core.Scene: packets against single rays."""

from __future__ import annotations

import numpy as np
import pivot_core
from scenes import Floats, add_plane, add_sphere, place, set_camera


def balls() -> pivot_core.Scene:
    """Spheres in rows over a plane, one instance each."""
    scene = pivot_core.Scene()
    material = scene.add_material("m", pivot_core.Material(diffuse=(1, 1, 1)))
    scene.add_instances("floor", add_plane(scene, 4.0), place(), [material])
    rows = [place(x, y, 1.0, 0.7) for x in (-2.0, 0.0, 2.0) for y in (-2.0, 0.0, 2.0)]
    scene.add_instances("ball", add_sphere(scene, 16), np.concatenate(rows), [material])
    set_camera(scene, (0, -9, 3))
    return scene


def scattered_rays(count: int) -> tuple[Floats, Floats]:
    """From around the balls towards them and past them; count is no multiple of a packet's width."""
    generator = np.random.default_rng(7)
    origins = generator.uniform(-6, 6, (count, 3)).astype(np.float32)
    directions = generator.uniform(-3, 3, (count, 3)) - origins
    return origins, (directions / np.linalg.norm(directions, axis=1, keepdims=True)).astype(np.float32)


def test_packets_hit_what_single_rays_hit() -> None:
    scene = balls()
    origins, directions = scattered_rays(5003)
    packet, single = (scene.intersect(origins, directions, packets=packets) for packets in (True, False))
    hit = single[1] >= 0
    assert 0.3 < hit.mean() < 0.99
    # An edge between two triangles may go to either, each with its own rounding.
    same = (packet[1] == single[1]) & (packet[2] == single[2])
    assert same.mean() > 0.999
    np.testing.assert_allclose(packet[0], single[0], rtol=1e-4)
    np.testing.assert_allclose(packet[3][same], single[3][same], atol=1e-4)


def test_packets_are_occluded_where_single_rays_are() -> None:
    scene = balls()
    origins, directions = scattered_rays(5003)
    far_m = np.random.default_rng(8).uniform(0, 12, len(origins)).astype(np.float32)
    packet, single = (scene.occluded(origins, directions, far_m, packets=packets) for packets in (True, False))
    np.testing.assert_array_equal(packet, single)
    distance_m = scene.intersect(origins, directions)[0]
    assert (single == (distance_m < far_m)).mean() > 0.999


def test_packets_end_where_the_rays_end() -> None:
    scene = balls()
    origins, directions = scattered_rays(3)
    assert [len(part) for part in scene.intersect(origins, directions)] == [3, 3, 3, 3]
    assert scene.occluded(origins[:0], directions[:0], np.zeros(0, np.float32)).shape == (0,)


def test_what_was_moved_is_hit_where_what_stays_is() -> None:
    """Moved back and forth, removed, scaled flat: before its move in world space, after it in a space of its own."""
    origins, directions = scattered_rays(5003)
    moved, still = balls(), balls()
    rows = [place(x, y, 1.0, 0.7) for x in (-2.0, 0.0, 2.0) for y in (-2.0, 0.0, 2.0)]
    for number, transform in enumerate(rows):
        moved.set_instance_transform(1 + number, np.eye(4))
        moved.set_instance_transform(1 + number, transform[0])

    def compare() -> Floats:
        (still_m, hit, *_), (moved_m, hit_moved, *_) = (
            scene.intersect(origins, directions) for scene in (still, moved)
        )
        assert (hit == hit_moved).mean() > 0.999
        np.testing.assert_allclose(still_m[hit == hit_moved], moved_m[hit == hit_moved], rtol=1e-4)
        return hit

    before = compare()
    for scene in (still, moved):
        scene.set_instance_transform(5, place(0.0, 0.0, 4.0, 1.5)[0])
        scene.remove_instance(3)
        scene.set_instance_transform(0, np.diag([1.0, 1.0, 0.0, 1.0]))
    after = compare()
    assert (before == 3).any()
    assert not (after == 3).any()
    assert (after == 5).sum() > 1.2 * (before == 5).sum()
    assert (after == 0).any()
