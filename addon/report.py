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
    """Warnings of one render job, each said once however many objects, layers and frames meet it.

    say: takes (level, text), as `RenderEngine.report` does: ({'WARNING'}, "...").
    said: the texts said so far in the job; shared by its engines.
    """

    def __init__(self, say: Callable[[set[str], str], None], said: set[str]) -> None:
        self._say = say
        self._said = said

    def warn(self, text: str) -> None:
        if text not in self._said:
            self._said.add(text)
            self._say({"WARNING"}, f"Pivot: {text}")
