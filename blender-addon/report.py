# SPDX-License-Identifier: GPL-3.0-or-later
"""What could not be shown as it is in the file: diagnostics with the place they came from."""

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from .unsupported import LIMITS

log = logging.getLogger("gonio")

SEVERITIES = ("ERROR", "WARNING", "INFO")


@dataclass(frozen=True)
class Diagnostic:
    """One line of the report.

    `kind` is the type of the data-block `name` ("Material", "Object", "Image", ...; "Render" for what the renderer said);
    `material` and `node` say where the jump button leads, `node` is a path through groups, "Group/Noise Texture".
    """

    severity: str
    kind: str
    name: str
    message: str
    material: str | None = None
    node: str | None = None

    @property
    def place(self) -> str:
        """The data-block, and the node in it."""
        return f"{self.name} > {self.node}" if self.node else self.name

    @property
    def text(self) -> str:
        """Place first, then what was found."""
        return f"{self.place}: {self.words}" if self.place else self.message

    @property
    def words(self) -> str:
        """The message, without the node's name if it begins with that."""
        return self.message.removeprefix(f"{self.node.rpartition('/')[2]}: ") if self.node else self.message


@dataclass(frozen=True)
class Counted:
    """What is said of one place or of several: the first of them, and how many there are."""

    first: Diagnostic
    count: int

    @property
    def text(self) -> str:
        """The first place and how many more there are, then what was found."""
        line = self.first
        if self.count == 1:
            return line.text
        return f"{line.place or line.kind} and {self.count - 1} more: {line.words}"


class Report:
    """Diagnostics of one exporter, each once, in the order in which they were found."""

    def __init__(self) -> None:
        self._lines: dict[Diagnostic, None] = {}
        self._by_place: dict[tuple[str, str], list[Diagnostic]] = {}
        # Paths of the shader nodes of each data-block that reach what is shown.
        self._nodes: dict[tuple[str, str], set[str]] = {}
        # Windows ask at every drawing.
        self._counted: list[Counted] | None = None

    def add(
        self, kind: str, name: str, message: str, *, severity: str = "WARNING", material: str | None = None, node: str | None = None
    ) -> None:
        """Adds a line; one that stands already is not added again."""
        line = Diagnostic(severity, kind, name, message, material, node)
        if line not in self._lines:
            self._lines[line], self._counted = None, None
            self._by_place.setdefault((kind, name), []).append(line)

    def tell(self, limit: str, kind: str, name: str, subject: str = "", *, material: str | None = None, node: str | None = None) -> None:
        """Adds the line of an entry of the table of limits; `subject` says more exactly what was asked for."""
        told = LIMITS[limit]
        self.add(kind, name, told.line(subject), severity=told.severity, material=material, node=node)

    def saw(self, kind: str, name: str, node: str) -> None:
        """Counts a shader node of a data-block."""
        self._nodes.setdefault((kind, name), set()).add(node)

    @contextmanager
    def guard(self, kind: str, name: str, consequence: str, **place) -> Iterator[None]:
        """What fails within costs its own data-block alone: a line says why, and what happens instead."""
        try:
            yield
        except Exception as problem:
            self.add(kind, name, f"{words_of(problem)}; {consequence}", severity="ERROR", **place)

    def add_render(self, diagnostics: list[tuple[str, str]]) -> None:
        """What the renderer itself has to say, pairs of origin and message, in the place of what it said before."""
        self.forget_all("Render")
        for origin, message in diagnostics:
            # That light paths run by themselves is no fault.
            self.add("Render", origin, message, severity="INFO" if message.endswith("(caustics)") else "WARNING")

    def add_texture_notes(self, statistics: dict[str, Any] | None) -> None:
        """What came up while textures were read within a memory limit; to be called when the render has ended."""
        for note in statistics["notes"] if statistics else ():
            self.add("Render", "texture cache", note)

    def add_guiding(self, words: str | None) -> None:
        """What path guiding has learned, where it is not followed; to be called when the render has ended."""
        if words and ("given up" in words or "not learned" in words):
            _, _, found = words.partition(": ")
            self.add("Render", "path guiding", found)

    def forget(self, kind: str, name: str) -> None:
        """Drops the lines of a data-block that is exported again."""
        self._nodes.pop((kind, name), None)
        for line in self._by_place.pop((kind, name), ()):
            del self._lines[line]
            self._counted = None

    def forget_all(self, kind: str) -> None:
        """Drops the lines of all data-blocks of a kind."""
        for place in [place for place in self._by_place.keys() | self._nodes.keys() if place[0] == kind]:
            self.forget(*place)

    def clear(self) -> None:
        """Drops all lines."""
        self._lines, self._by_place, self._nodes, self._counted = {}, {}, {}, None

    @property
    def diagnostics(self) -> list[Diagnostic]:
        """All lines, the most severe first."""
        return sorted(self._lines, key=lambda line: SEVERITIES.index(line.severity))

    @property
    def counted(self) -> list[Counted]:
        """Lines that say the same taken together, the most severe first."""
        if self._counted is None:
            alike: dict[tuple[str, str, str], list[Diagnostic]] = {}
            for line in self.diagnostics:
                alike.setdefault((line.severity, line.kind, line.message), []).append(line)
            self._counted = [Counted(lines[0], len(lines)) for lines in alike.values()]
        return self._counted

    @property
    def nodes(self) -> tuple[int, int]:
        """How many shader nodes are shown as they are, and how many there are; a node that a line names is not shown as it is."""
        named = {(line.kind, line.name, line.node) for line in self._lines if line.node is not None}
        seen = {(*place, node) for place, nodes in self._nodes.items() for node in nodes} | named
        return len(seen) - len(named), len(seen)

    def summary(self) -> str:
        """One sentence for a status bar; empty when there is nothing to say."""
        lines = [line for line in self.counted if line.first.severity != "INFO"]
        if not lines:
            return ""
        more = f", and {len(lines) - 1} more in the Gonio Report panel" if len(lines) > 1 else ""
        return f"{lines[0].text}{more}"


def words_of(problem: Exception) -> str:
    """An exception as a sentence; one that nobody foresaw is named by its type, and goes to the log."""
    words = str(problem)
    if isinstance(problem, OSError) or type(problem).__module__.partition(".")[0] in ("gonio", "_gonio"):
        return words
    log.warning("Gonio left something out", exc_info=problem)
    return f"{type(problem).__name__}: {words}" if words else type(problem).__name__


_latest = Report()


def publish(report: Report) -> None:
    """Makes a report the one that the panel shows."""
    global _latest
    _latest = report


def latest() -> Report:
    """The report that the panel shows."""
    return _latest
