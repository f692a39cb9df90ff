"""What ./run shows of a build's or a render's output: a bar, and every line that matters."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def progress(tmp_path: Path, lines: list[str]) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, ROOT / ".run/progress.py", "Working", tmp_path / "log"]
    return subprocess.run(
        command, input="".join(f"{line}\n" for line in lines), capture_output=True, text=True, check=True
    )


def test_progress_reads_ninja_pivot_and_cycles(tmp_path: Path) -> None:
    lines = [
        "[0/2] Re-checking globbed directories...",
        "[3/4] Building CXX object",
        "Fra:5 Mem:1.00M (Peak 2.00M) | Time:00:01.00 | Exporting the scene",
        "Fra:5 Mem:1.00M (Peak 2.00M) | Time:00:01.00 | Sample 12 | 20 % | 00:09 left",
        "Fra:6 Mem:1.00M (Peak 2.00M) | Time:00:01.00 | Mem:1.00M, Peak:2.00M | Scene, ViewLayer | Sample 8/16",
        "Warning: material 'wood': texture node",
        "Error: no light",
        "Error: no light",
    ]
    ran = progress(tmp_path, [*lines, "Wrote x.png"])
    shown = ["Working  75%  0:00 left", "Working frame 5  20%", "Working frame 6  50%", lines[-3], lines[-1]]
    assert ran.stderr.splitlines() == shown
    assert ran.stdout == "Wrote x.png\n"
    assert (tmp_path / "log").read_text().splitlines() == [*lines, "Wrote x.png"]


def test_progress_keeps_errors_whole(tmp_path: Path) -> None:
    lines = [
        "Error: Python: Traceback (most recent call last):",
        "  first",
        "[1, 2] is part of it",
        "Fra:5 Mem:1.00M (Peak 2.00M) | Exporting",
        "Error: Python: Traceback (most recent call last):",
        "  second",
        "",
        "Error: Python: Traceback (most recent call last):",
        "  second",
        "Fra:5 Mem:1.00M (PeakError: printed into a line",
        "Blender cannot do this",
        "Error: " + "long " * 2000,
    ]
    ran = progress(tmp_path, lines)
    shown = [*lines[:3], *lines[4:6], "Error: printed into a line", *lines[10:]]
    assert ran.stderr.splitlines() == shown


def test_an_error_is_shown_once_with_its_fix(tmp_path: Path) -> None:
    """Blender 3.4 prints its own words before those of the script that knows the fix, and Blender 4.3 after them."""
    bare, helped = "Error: no camera", "Error: no camera. Fix: add one"
    for lines in ([bare, helped], [helped, bare], [bare, helped, bare]):
        assert progress(tmp_path, lines).stderr.splitlines() == [helped]
    others = [bare, "Error: no camera at hand. Fix: add one"]
    assert progress(tmp_path, others).stderr.splitlines() == others


def test_progress_takes_any_bytes(tmp_path: Path) -> None:
    command = [sys.executable, ROOT / ".run/progress.py", "Working", tmp_path / "log"]
    line = b"Error: no such file: caf\xe9.blend\n"
    ran = subprocess.run(command, input=line, capture_output=True, check=True)
    assert ran.stderr == line
    assert (tmp_path / "log").read_bytes() == line


def test_progress_off_a_terminal_is_sparse(tmp_path: Path) -> None:
    ran = progress(tmp_path, [f"[{edge}/1000] Building" for edge in range(1, 1001)])
    shares = [line.split()[1] for line in ran.stderr.splitlines()]
    assert shares == ["0%", *(f"{tenth}0%" for tenth in range(1, 11))]
