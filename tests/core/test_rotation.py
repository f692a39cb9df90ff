"""Matrices of rotations."""

import numpy as np
import pivot_core
from scipy.spatial.transform import Rotation

RANDOM = np.random.default_rng(3)


def matrices(name: str, *inputs: np.ndarray) -> np.ndarray:
    """(N, 3, 3)."""
    return pivot_core.run_op(name, np.hstack(inputs).astype(np.float32)).reshape(-1, 3, 3)


def test_euler_angles_turn_about_x_first() -> None:
    angles = RANDOM.uniform(-7, 7, (100, 3))
    expected = Rotation.from_euler("xyz", angles).as_matrix()
    np.testing.assert_allclose(matrices("euler_rotation", angles), expected, atol=1e-6)


def test_an_axis_may_have_any_length() -> None:
    axes, angles = RANDOM.normal(size=(100, 3)) * 5, RANDOM.uniform(-7, 7, (100, 1))
    expected = Rotation.from_rotvec(axes / np.linalg.norm(axes, axis=1, keepdims=True) * angles).as_matrix()
    np.testing.assert_allclose(matrices("axis_rotation", axes, angles), expected, atol=2e-6)


def test_nothing_turns_about_no_axis() -> None:
    np.testing.assert_array_equal(matrices("axis_rotation", np.array([[0, 0, 0, 2]])), np.eye(3)[None])
