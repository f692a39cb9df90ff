"""
The pixel filter and the sample counts of adaptive sampling.
"""

from __future__ import annotations
import numpy
import numpy.typing
import typing

__all__: list[str] = ["filter_samples", "sample_counts"]

def filter_samples(
    pixel_filter: str,
    width_px: typing.SupportsFloat | typing.SupportsIndex,
    u: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
) -> tuple:
    """
    For random numbers u (n, 2) in [0, 1): offsets (n, 2) from the pixel's centre, in pixels; weights (n, 2, k) along x and y for the k pixels around and including it.
    """

def sample_counts(
    samples: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    reach_px: typing.SupportsInt | typing.SupportsIndex,
    half_error: typing.SupportsFloat | typing.SupportsIndex,
    relative_error: typing.SupportsFloat | typing.SupportsIndex,
    max_samples: typing.SupportsInt | typing.SupportsIndex,
) -> tuple:
    """
    After a pilot that found radiances `samples` (2, height, width, n), by halves, whose pictures have the mean squared error half_error: how many samples follow for each pixel (height, width), and what each half weighs in the picture (2, height, width).
    """
