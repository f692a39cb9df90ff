"""What a picture takes in memory and what there is, so that one that cannot fit is refused before it is tried."""

from __future__ import annotations

import resource
from collections.abc import Iterator
from pathlib import Path

from .report import RenderError

_FLOAT_BYTES = 4
# Where a control group says its limit, its use, and how much of that are files that can be dropped: version 2, then 1.
_CGROUPS = {
    "": ("/sys/fs/cgroup", "memory.max", "memory.current", "inactive_file"),
    "memory": ("/sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"),
}


def picture_bytes(width: int, height: int, film_pixel_bytes: int, layer_channels: list[int]) -> int:
    """The most that rendering a picture takes beside its scene.

    film_pixel_bytes: of the core's film. layer_channels: of all passes of each view layer and view. Blender keeps them
    all; one is rendered at a time, which the core and the array handed to Blender hold once more.
    """
    floats = sum(layer_channels) + 2 * max(layer_channels, default=0)
    return width * height * (film_pixel_bytes + _FLOAT_BYTES * floats)


def check_memory(width: int, height: int, needed_bytes: int) -> None:
    """Raise RenderError where a picture of so many pixels takes more memory than there is."""
    free_bytes = available_bytes()
    if needed_bytes > free_bytes:
        raise RenderError(
            f"a picture of {width} x {height} pixels takes {needed_bytes / 1e9:.1f} GB of memory, "
            f"{free_bytes / 1e9:.1f} GB are free. Fix: lower the resolution, switch off passes, or render it by regions"
        )


def peak_bytes() -> int:
    """The most that this process has held.

    What getrusage() tells, which is taken where the kernel tells no more, counts whoever started it.
    """
    status = dict(line.split(":", 1) for line in Path("/proc/self/status").read_text().splitlines())
    known = status.get("VmHWM", str(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss))
    return 1024 * int(known.split()[0])


def available_bytes() -> float:
    """Memory this process may still take: the machine's, or what its control groups leave of it."""
    return min(_machine_bytes(), *_cgroup_bytes())


def _machine_bytes() -> float:
    fields = dict(line.split(":") for line in Path("/proc/meminfo").read_text().splitlines())
    return sum(1024.0 * int(fields[name].split()[0]) for name in ("MemAvailable", "SwapFree"))


def _cgroup_bytes() -> Iterator[float]:
    for line in Path("/proc/self/cgroup").read_text().splitlines():
        _, controllers, path = line.split(":", 2)
        if controllers not in _CGROUPS:
            continue
        root, limit, used, droppable = _CGROUPS[controllers]
        group = Path(root) / path.lstrip("/")
        for folder in (group, *group.parents):
            if (folder / limit).exists():
                yield _free_bytes(folder, limit, used, droppable)
    yield float("inf")


def _free_bytes(folder: Path, limit: str, used: str, droppable: str) -> float:
    text = (folder / limit).read_text().strip()
    if text == "max":
        return float("inf")
    stat = dict(line.split() for line in (folder / "memory.stat").read_text().splitlines())
    return float(text) - float((folder / used).read_text()) + float(stat.get(droppable, 0))
