"""Lookups in images, against NumPy's, and the copies that footprints are looked up in."""

from __future__ import annotations

import mmap
from pathlib import Path
from typing import Any

import numpy as np
import pivot_core
import pytest
from numpy.typing import NDArray

Floats = NDArray[np.float64]
CLOSEST, LINEAR, CUBIC = range(3)
REPEAT, EXTEND, CLIP, MIRROR = range(4)


def decoded(encoded: Any) -> Floats:
    encoded = np.asarray(encoded, float)
    return np.where(encoded < 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def looked_up(
    image: pivot_core.Image,
    uv: Any,
    step: tuple[float, float] = (0, 0),
    interpolation: int = LINEAR,
    extension: int = REPEAT,
    unassociate: bool = False,
    closed_u: bool = False,
) -> Floats:
    """(N, 4) at uv (N, 2). step: the footprint along u and along v."""
    uv = np.asarray(uv, np.float32)
    inputs = np.concatenate([uv, uv + np.float32([step[0], 0]), uv + np.float32([0, step[1]])], 1)
    return pivot_core.run_op("image", inputs, [interpolation, extension, unassociate, closed_u], image)


def some_pixels(dtype: Any, shape: tuple[int, int, int]) -> Any:
    random = np.random.default_rng(3).random(shape)
    if np.issubdtype(dtype, np.integer):
        return (random * np.iinfo(dtype).max).astype(dtype)
    return (random * 3 - 1).astype(dtype)


def numbers(pixels: Any) -> Floats:
    scale = np.iinfo(pixels.dtype).max if np.issubdtype(pixels.dtype, np.integer) else 1
    return pixels.astype(float) / scale


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16, np.float16, np.float32])
@pytest.mark.parametrize("channels", [1, 2, 3, 4])
def test_the_middle_of_a_texel_is_its_value(dtype: Any, channels: int) -> None:
    pixels = some_pixels(dtype, (5, 7, channels))
    y, x = np.mgrid[:5, :7]
    uv = np.stack([(x + 0.5) / 7, (y + 0.5) / 5], -1).reshape(-1, 2)
    stored = numbers(pixels).reshape(-1, channels)
    rgb = stored[:, :3] if channels >= 3 else np.repeat(stored[:, :1], 3, 1)
    alpha = stored[:, -1] if channels % 2 == 0 else np.ones(35)
    for interpolation in (CLOSEST, LINEAR):
        found = looked_up(pivot_core.Image(pixels), uv, interpolation=interpolation)
        assert found == pytest.approx(np.column_stack([rgb, alpha]), abs=3e-6)


def wrapped(place: int, size: int, extension: int) -> int | None:
    if extension == CLIP and not 0 <= place < size:
        return None
    if extension == MIRROR:
        place %= 2 * size
        return place if place < size else 2 * size - 1 - place
    return place % size if extension == REPEAT else min(max(place, 0), size - 1)


def weights(interpolation: int, t: float) -> list[float]:
    if interpolation == LINEAR:
        return [1 - t, t]
    return [(1 - t) ** 3 / 6, (3 * t**3 - 6 * t**2 + 4) / 6, (-3 * t**3 + 3 * t**2 + 3 * t + 1) / 6, t**3 / 6]


@pytest.mark.parametrize("extension", [REPEAT, EXTEND, CLIP, MIRROR])
@pytest.mark.parametrize("interpolation", [LINEAR, CUBIC])
@pytest.mark.parametrize("srgb", [False, True])
def test_what_is_stored_is_interpolated(interpolation: int, extension: int, srgb: bool) -> None:
    """And decoded then, as in Cycles."""
    pixels = some_pixels(np.uint8, (5, 7, 3))
    stored = numbers(pixels)
    uv = np.random.default_rng(1).random((200, 2)) * 6 - 3
    found = looked_up(pivot_core.Image(pixels, srgb=srgb), uv, interpolation=interpolation, extension=extension)
    for (u, v), rgba in zip(uv, found, strict=True):
        x, y = u * 7 - 0.5, v * 5 - 0.5
        expected = np.zeros(4)
        before = 0 if interpolation == LINEAR else 1
        for j, weight_y in enumerate(weights(interpolation, y - np.floor(y))):
            for i, weight_x in enumerate(weights(interpolation, x - np.floor(x))):
                column = wrapped(int(np.floor(x)) + i - before, 7, extension)
                row = wrapped(int(np.floor(y)) + j - before, 5, extension)
                if column is not None and row is not None:
                    expected += weight_x * weight_y * np.append(stored[row, column], 1)
        if srgb:
            expected[:3] = decoded(expected[:3])
        assert rgba == pytest.approx(expected, abs=2e-5)


def test_alpha_is_taken_out_of_colors() -> None:
    pixels = np.array([[[0.2, 0.1, 0.3, 0.5], [0.7, 0.5, 0.2, 1.0], [0.1, 0.2, 0.3, 0.0]]], np.float32)
    uv = [(0.5 / 3, 0.5), (0.5, 0.5), (2.5 / 3, 0.5)]
    found = looked_up(pivot_core.Image(pixels), uv, interpolation=CLOSEST, unassociate=True)
    expected = [(0.4, 0.2, 0.6, 0.5), (0.7, 0.5, 0.2, 1), (0.1, 0.2, 0.3, 0)]
    assert found == pytest.approx(np.array(expected), abs=1e-6)


@pytest.mark.parametrize("srgb", [True, False])
def test_copies_of_cut_out_pictures_keep_their_color(srgb: bool) -> None:
    """A quarter is covered; all of the picture is looked up at once."""
    pixels = np.zeros((64, 64, 4), np.uint8)
    pixels[:32, :32] = 200, 100, 50, 255
    rgba = looked_up(pivot_core.Image(pixels, srgb=srgb), [(0.5, 0.5)], step=(1, 1), unassociate=True)[0]
    color = numbers(pixels[0, 0, :3])
    assert rgba == pytest.approx([*(decoded(color) if srgb else color), 0.25], abs=3 / 255)  # bytes of a quarter


@pytest.mark.parametrize("shape", [(8, 8), (5, 7), (1, 9), (13, 1), (1, 1)])
@pytest.mark.parametrize("dtype", [np.uint8, np.float32])
def test_every_copy_has_the_mean(shape: tuple[int, int], dtype: Any) -> None:
    """In linear light, to half a step of what is stored for each halving."""
    pixels = some_pixels(dtype, (*shape, 4))
    srgb = dtype == np.uint8
    image = pivot_core.Image(pixels, srgb=srgb)
    assert image.level(image.level_count - 1).shape == (1, 1, 4)
    linear = numbers(pixels)
    if srgb:
        linear[..., :3] = decoded(linear[..., :3])
    for index in range(image.level_count):
        level = image.level(index)
        assert max(level.shape[:2]) == max(1, max(shape) >> index)
        error = 1e-6 if dtype == np.float32 else 5e-3
        assert level.mean(axis=(0, 1)) == pytest.approx(linear.mean(axis=(0, 1)), abs=error)


def test_copies_take_no_memory_until_they_are_looked_up() -> None:
    pixels = np.full((4096, 4096, 4), 100, np.uint8)

    def resident_bytes() -> int:
        return int(Path("/proc/self/statm").read_text().split()[1]) * mmap.PAGESIZE

    before = resident_bytes()
    image = pivot_core.Image(pixels)
    alone = resident_bytes() - before
    image.level(image.level_count - 1)
    with_copies = resident_bytes() - before
    assert alone < 1.1 * pixels.nbytes < 1.25 * pixels.nbytes < with_copies
    assert image.memory_bytes == pytest.approx(pixels.nbytes * 4 / 3, rel=1e-3)


def test_a_footprint_takes_the_mean_of_what_it_covers() -> None:
    """A chessboard of texels is grey from afar, and itself where a texel is wider than a footprint."""
    y, x = np.mgrid[:64, :64]
    image = pivot_core.Image(((x + y) % 2).astype(np.float32)[..., None])
    uv = np.random.default_rng(5).random((100, 2))
    sharp = looked_up(image, uv)
    assert looked_up(image, uv, step=(1 / 64, 1 / 64)) == pytest.approx(sharp, abs=1e-6)
    assert sharp[:, 0].std() > 0.1
    for step in ((2 / 64, 2 / 64), (1e-3, 0.3), (0.3, 0), (7.0, 7.0)):
        assert looked_up(image, uv, step)[:, 0] == pytest.approx(0.5, abs=1e-3)
    blend = looked_up(image, uv, step=(2**0.5 / 64, 2**0.5 / 64))[:, 0]
    assert blend - 0.5 == pytest.approx((sharp[:, 0] - 0.5) / 2, abs=1e-3)


def test_a_long_footprint_is_not_as_wide() -> None:
    """Columns stay apart where the footprint is long along them, and stay as they are."""
    image = pivot_core.Image(np.tile((np.arange(64) % 2).astype(np.float32)[None, :, None], (64, 1, 1)))
    uv = np.random.default_rng(5).random((100, 2))
    assert looked_up(image, uv, step=(0.9 / 64, 6.0 / 64)) == pytest.approx(looked_up(image, uv), abs=1e-5)
    assert looked_up(image, uv, step=(6.0 / 64, 0.5 / 64))[:, 0] == pytest.approx(0.5, abs=1e-3)


def test_an_op_asks_for_its_image() -> None:
    with pytest.raises(ValueError, match="op 'image': it needs an image"):
        pivot_core.run_op("image", np.zeros((1, 6), np.float32), [0, 0, 0, 0])
    with pytest.raises(ValueError, match="op 'image': it needs an image"):
        pivot_core.Program().add("image", [(-1, 0.0)] * 6, [0, 0, 0, 0])


def test_neighbours_across_a_seam_are_near() -> None:
    image = pivot_core.Image(np.arange(16, dtype=np.float32).reshape(1, 16, 1))
    at_seam = looked_up(image, [(0.97, 0.5)], step=(-0.95, 0), closed_u=True)
    assert at_seam == pytest.approx(looked_up(image, [(0.97, 0.5)], step=(0.05, 0)), abs=1e-6)


def test_nonsense_is_looked_up_somewhere() -> None:
    pixels = some_pixels(np.uint8, (5, 7, 3))
    uv = [(np.nan, 0), (np.inf, -np.inf), (1e30, 3), (-1e9, 1e9)]
    for interpolation in (CLOSEST, LINEAR, CUBIC):
        for extension in (REPEAT, EXTEND, CLIP, MIRROR):
            found = looked_up(
                pivot_core.Image(pixels), uv, interpolation=interpolation, extension=extension, step=(np.inf, 1)
            )
            assert np.isfinite(found).all()


def test_bad_pixels_are_named() -> None:
    with pytest.raises(ValueError, match="pixels must have shape"):
        pivot_core.Image(np.zeros((2, 2), np.uint8))
    with pytest.raises(TypeError, match="uint8, uint16, float16 or float32"):
        pivot_core.Image(np.zeros((2, 2, 3)))
    with pytest.raises(ValueError, match="at least one pixel"):
        pivot_core.Image(np.zeros((0, 2, 3), np.uint8))
    with pytest.raises(ValueError, match="1 to 4 channels"):
        pivot_core.Image(np.zeros((2, 2, 5), np.uint8))
    with pytest.raises(ValueError, match="row by row"):
        pivot_core.Image(np.zeros((2, 4, 3), np.uint8)[:, ::2])
