"""
Owen-scrambled Sobol points, over NumPy arrays.
"""

from __future__ import annotations
import numpy
import numpy.typing
import typing

__all__: list[str] = ["owen_scramble", "pixel_samplers", "points", "sobol_second", "to_unit"]

def owen_scramble(
    fraction: typing.Annotated[numpy.typing.ArrayLike, numpy.uint32],
    seed: typing.Annotated[numpy.typing.ArrayLike, numpy.uint32],
) -> typing.Any:
    """
    A 32-bit fraction (...), each bit flipped or not by those above it and the seed.
    """

def pixel_samplers(
    x: typing.Annotated[numpy.typing.ArrayLike, numpy.uint32],
    y: typing.Annotated[numpy.typing.ArrayLike, numpy.uint32],
    seed: typing.SupportsInt | typing.SupportsIndex,
    log2_samples: typing.SupportsInt | typing.SupportsIndex,
    sample: typing.Annotated[numpy.typing.ArrayLike, numpy.uint32],
) -> tuple:
    """
    What points() takes, pixel_seed and sample (n,), of samples (n,) below 2^log2_samples of the pixels at (x, y), both (n,): those of a square of pixels are successive points of one sequence.
    """

def points(
    pixel_seed: typing.Annotated[numpy.typing.ArrayLike, numpy.uint32],
    sample: typing.Annotated[numpy.typing.ArrayLike, numpy.uint32],
    dimension: typing.SupportsInt | typing.SupportsIndex,
    batches: bool = True,
) -> numpy.typing.NDArray[numpy.float32]:
    """
    The points (n, 2) in [0, 1) of samples (n,) of pixels (n,): in SIMD batches, or one by one.
    """

def sobol_second(index: typing.Annotated[numpy.typing.ArrayLike, numpy.uint32]) -> typing.Any:
    """
    The second Sobol dimension of an index (...), a 32-bit fraction; the first is the index, bits reversed.
    """

def to_unit(fraction: typing.Annotated[numpy.typing.ArrayLike, numpy.uint32]) -> typing.Any:
    """
    A 32-bit fraction (...) as float32 in [0, 1).
    """
