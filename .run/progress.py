"""Read a build's or a render's output from stdin, write all of it to a log, and show the person a bar and what matters.

    COMMAND 2>&1 | progress.py TITLE LOG

On a terminal the bar is redrawn in place; elsewhere it is a line at each tenth.
"""

import re
import signal
import sys
import time
from pathlib import Path

# Steps done and in all: ninja's "[3/40]", Cycles' "Sample 3/64", Pivot's "42 %".
STEP = re.compile(r"\[(\d+)/(\d+)\]|Fra:(?P<frame>-?\d+) .*?\| (?:Sample (\d+)/(\d+)|Sample \d+ \| (\d+) %)")
NOISE = re.compile(
    r"$|Fra:|Blender (\d|quit)|Read blend:|Saved: | *Time: |ninja: (no work|Entering|build stopped)|\[\d+/\d+\]|-- "
)
CUT_OFF = re.compile(r"Fra:.*?(?=Error: )")  # a line of progress that an error was printed into
BAR_WIDTH = 30


def steps(found: re.Match[str]) -> tuple[int, int]:
    edge, edges, _, sample, samples, percent = found.groups()
    return (int(percent), 100) if percent else (int(edge or sample), int(edges or samples))


def duration(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"


class Bar:
    """One bar; the time left follows the pace since its first step."""

    def __init__(self, title: str, first_step: int) -> None:
        self.title, self.first_step, self.started_s = title, first_step, time.monotonic()
        self.tenths_shown, self.drawn = -1, False

    def show(self, step: int, total: int) -> None:
        share = step / total
        text = f"{share:4.0%}"
        if step > self.first_step:
            pace_s = (time.monotonic() - self.started_s) / (step - self.first_step)
            text += f"  {duration(pace_s * (total - step))} left"
        if sys.stderr.isatty():
            filled = round(share * BAR_WIDTH)
            text = f"\r\x1b[K{self.title} [{'#' * filled}{'.' * (BAR_WIDTH - filled)}] {text}"
            print(text, end="", file=sys.stderr, flush=True)
        elif int(share * 10) > self.tenths_shown:
            print(self.title, text, file=sys.stderr, flush=True)
        self.tenths_shown, self.drawn = int(share * 10), True

    def clear(self) -> None:
        if self.drawn and sys.stderr.isatty():
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)


def without_fix(error: list[str]) -> str:
    return "".join(error).partition(". Fix: ")[0].rstrip(".\n")


class Messages:
    """What the person reads beside the bar. An error may have many lines, and is printed once, with its fix: Blender
    prints an operator's, before or after the script that called it does, which adds the fix."""

    def __init__(self) -> None:
        self.error: list[str] = []  # the lines so far of the error being read
        self.told: set[str] = set()  # each without its fix

    def add(self, line: str) -> None:
        if self.error and line.startswith(f"{without_fix(self.error)}. Fix: "):
            self.error = []
        elif line.startswith("Error") or (self.error and line.startswith(("Warning", "Wrote "))):
            self.end_error()
        if line.startswith("Error") or self.error:
            self.error.append(line)
        else:
            print(line, end="", file=sys.stdout if line.startswith("Wrote ") else sys.stderr, flush=True)

    def end_error(self) -> None:
        """Print the error being read, which has no more lines."""
        if without_fix(self.error) not in self.told:
            print(*self.error, sep="", end="", file=sys.stderr, flush=True)
        self.told.add(without_fix(self.error))
        self.error = []


def main(title: str, log_path: str) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the command; this ends with its output
    for stream in (sys.stdin, sys.stdout, sys.stderr):
        stream.reconfigure(encoding="utf-8", errors="surrogateescape")  # a file's name may be any bytes
    bar, frame, messages = Bar(title, 0), None, Messages()
    with Path(log_path).open("w", encoding="utf-8", errors="surrogateescape") as log:
        for line in sys.stdin:
            print(line, end="", file=log, flush=True)
            line = CUT_OFF.sub("", line)
            found = STEP.match(line)
            step, total = steps(found) if found else (0, 0)
            if (found and step) or NOISE.match(line):
                messages.end_error()
            if found and step:
                if found["frame"] != frame:
                    frame = found["frame"]
                    bar = Bar(f"{title} frame {frame}", step)
                bar.show(step, total)
            elif not NOISE.match(line):
                bar.clear()
                messages.add(line)
        messages.end_error()
    bar.clear()


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
