"""What the artist is told: faults that end a render, and warnings said once."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager


class RenderError(Exception):
    """A fault that ends the render. Its text names the object and the fix."""


@contextmanager
def naming(thing: str, fix: str) -> Iterator[None]:
    """Turn a ValueError, which the core answers bad values with, into a RenderError naming the thing and the fix."""
    try:
        yield
    except ValueError as error:
        raise RenderError(f"{thing}: {error}. Fix: {fix}") from error


class Reporter:
    """Warnings of one view layer's export and render, each once however many objects meet it.

    say: takes (level, text), as `RenderEngine.report` does: ({'WARNING'}, "..."), what was not said before.
    said: the texts said so far in the run; shared by its layers and frames.
    """

    def __init__(self, say: Callable[[set[str], str], None], said: set[str]) -> None:
        self.warnings: list[str] = []
        self._say = say
        self._said = said

    def warn(self, text: str) -> None:
        if text not in self.warnings:
            self.warnings.append(text)
        if text not in self._said:
            self._said.add(text)
            self._say({"WARNING"}, f"Pivot: {text}")

    def refuse(self) -> None:
        """Raise RenderError if there were warnings, which a strict render takes for errors."""
        if self.warnings:
            count = f"{len(self.warnings)} warnings" if len(self.warnings) > 1 else "1 warning"
            raise RenderError(
                f"{count}, which a strict render takes for errors: {'; '.join(self.warnings)}. "
                "Fix: change what they name, or render without --strict"
            )
