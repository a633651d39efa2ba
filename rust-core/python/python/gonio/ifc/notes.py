"""What is told of a model: what was left out or taken by default, each kind once, with names and GlobalIds."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Any

# As many are named of a kind.
NAMED = 3


def label(entity: Any) -> str:
    """What messages call an element: its class, name and GlobalId."""
    name = getattr(entity, "Name", None)
    words = f"{entity.is_a()} {name!r}" if name else str(entity.is_a())
    return f"{words} ({getattr(entity, 'GlobalId', None) or f'#{entity.id()}'})"


class Notes:
    """Messages, in the order in which their kinds came up."""

    def __init__(self) -> None:
        self._of: dict[str, dict[str, None]] = {}

    def say(self, what: str) -> None:
        """A message about the model as a whole."""
        self._of.setdefault(what, {})

    def of(self, what: str, entity: Any) -> None:
        """A message about an element; those that say the same become one."""
        self._of.setdefault(what, {})[label(entity)] = None

    @contextlib.contextmanager
    def sound(self, entity: Any) -> Iterator[None]:
        """What goes on within is left out, and told, where the element's data is not what IFC's schema says."""
        try:
            yield
        except Exception as error:  # Whatever code meets in data of the wrong type.
            self.of(f"malformed, and left out in part ({type(error).__name__}: {error})", entity)

    def lines(self) -> list[str]:
        """The messages."""
        return [_line(what, list(labels)) for what, labels in self._of.items()]


def _line(what: str, labels: list[str]) -> str:
    if not labels:
        return what
    more = f" and {len(labels) - NAMED} more" if len(labels) > NAMED else ""
    return f"{what}: {', '.join(labels[:NAMED])}{more}"
