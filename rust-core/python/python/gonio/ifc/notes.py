"""What is told of a model: what was left out or taken by default, each kind once, with names and GlobalIds."""

from __future__ import annotations

from typing import Any

# As many are named of a kind.
NAMED = 3


def label(entity: Any) -> str:
    """What messages call an element: its class, name and GlobalId."""
    name = getattr(entity, "Name", None)
    return f"{entity.is_a()} {name!r} ({entity.GlobalId})" if name else f"{entity.is_a()} ({entity.GlobalId})"


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

    def lines(self) -> list[str]:
        """The messages."""
        return [_line(what, list(labels)) for what, labels in self._of.items()]


def _line(what: str, labels: list[str]) -> str:
    if not labels:
        return what
    more = f" and {len(labels) - NAMED} more" if len(labels) > NAMED else ""
    return f"{what}: {', '.join(labels[:NAMED])}{more}"
