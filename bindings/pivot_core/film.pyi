"""
The pixel filter and the sample counts of adaptive sampling.
"""

from __future__ import annotations
import numpy
import numpy.typing
import typing

__all__: list[str] = ["filter_offsets", "pilot_samples", "sample_counts"]

def filter_offsets(
    pixel_filter: str,
    width_px: typing.SupportsFloat | typing.SupportsIndex,
    u: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
) -> numpy.typing.NDArray[numpy.float32]:
    """
    Offsets (n, 2) from the pixel's centre, in pixels, for random numbers u (n, 2) in [0, 1).
    """

def pilot_samples(max_samples: typing.SupportsInt | typing.SupportsIndex) -> int:
    """
    How many samples every pixel gets when at most max_samples are allowed.
    """

def sample_counts(
    blocks: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    relative_error: typing.SupportsFloat | typing.SupportsIndex,
    max_samples: typing.SupportsInt | typing.SupportsIndex,
) -> numpy.typing.NDArray[numpy.uint32]:
    """
    How many samples each pixel gets, (height, width), after a pilot that found the means `blocks` (height, width, n) of four samples each; what is not finite was left out.
    """
