# SPDX-License-Identifier: GPL-3.0-or-later
"""What could not be shown as it is in the file: diagnostics with the place they came from."""

from dataclasses import dataclass

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
    def text(self) -> str:
        """Place first, then what was found."""
        place = f"{self.name} > {self.node}" if self.node else self.name
        return f"{place}: {self.message}" if place else self.message


class Report:
    """Diagnostics of one exporter, each once, in the order in which they were found."""

    def __init__(self) -> None:
        self._lines: dict[Diagnostic, None] = {}
        self._by_place: dict[tuple[str, str], list[Diagnostic]] = {}

    def add(
        self, kind: str, name: str, message: str, *, severity: str = "WARNING", material: str | None = None, node: str | None = None
    ) -> None:
        """Adds a line; one that stands already is not added again."""
        line = Diagnostic(severity, kind, name, message, material, node)
        if line not in self._lines:
            self._lines[line] = None
            self._by_place.setdefault((kind, name), []).append(line)

    def add_render(self, diagnostics: list[tuple[str, str]]) -> None:
        """Adds what the renderer itself had to say, pairs of origin and message."""
        for origin, message in diagnostics:
            self.add("Render", origin, message)

    def forget(self, kind: str, name: str) -> None:
        """Drops the lines of a data-block that is exported again."""
        for line in self._by_place.pop((kind, name), ()):
            del self._lines[line]

    def clear(self) -> None:
        """Drops all lines."""
        self._lines, self._by_place = {}, {}

    @property
    def diagnostics(self) -> list[Diagnostic]:
        """All lines, the most severe first."""
        return sorted(self._lines, key=lambda line: SEVERITIES.index(line.severity))

    def summary(self) -> str:
        """One sentence for a status bar; empty when there is nothing to say."""
        lines = [line for line in self.diagnostics if line.severity != "INFO"]
        if not lines:
            return ""
        more = f", and {len(lines) - 1} more in the Gonio Report panel" if len(lines) > 1 else ""
        return f"{lines[0].text}{more}"


_latest = Report()


def publish(report: Report) -> None:
    """Makes a report the one that the panel shows."""
    global _latest
    _latest = report


def latest() -> Report:
    """The report that the panel shows."""
    return _latest
