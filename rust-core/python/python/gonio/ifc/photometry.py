"""Photometric files of light sources: tables become files beside the stage, names lead to files beside the model."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlparse

from .._gonio import Error, goniogram_figures
from . import distribution
from .fixtures import FILES, Fixture
from .notes import Notes, label

# Larger files are no photometry.
MOST_BYTES = 64 << 20


class Photometry:
    """Finds the files of a model at `source`, for a stage at `target`; `radian` is the project's unit of angles."""

    def __init__(self, source: Path, target: Path, radian: float, notes: Notes) -> None:
        self.source, self.target, self.radian, self.notes = source, target, radian, notes
        self._written: dict[tuple[int, float], Path | None] = {}

    def inline(self, fixture: Fixture, table: Any, stated: float) -> Path | None:
        """The file of an IfcLightIntensityDistribution whose lamps have `stated` lm; None, told, where it is none."""
        key = (table.id(), stated)
        if key not in self._written:
            path = self.target.with_name(f"{self.target.stem}_{table.id()}_{stated:g}.ies")
            try:
                self._written[key] = self._write(fixture, table, stated, path)
            except (ValueError, Error, OSError) as error:
                self.notes.of(f"the distribution #{table.id()} cannot be used ({error}), and so no light", fixture.element)
                self._written[key] = None
        return self._written[key]

    def _write(self, fixture: Fixture, table: Any, stated: float, path: Path) -> Path:
        curve = table.LightDistributionCurve
        main, angles, values = distribution.table(table, self.radian)
        name = fixture.element.Name or fixture.element.GlobalId
        flux = _flux(distribution.lm63(name, curve, main, angles, values).encode("utf-8"), path.name)
        if flux <= 0.0:
            raise ValueError("all of its intensities are 0")
        factor, unit = distribution.scale(flux, stated)
        self.notes.of(f"intensities of the distribution #{table.id()} are taken for {unit}: {flux * factor:.4g} lm", fixture.element)
        path.write_text(distribution.lm63(name, curve, main, angles, factor * values), encoding="utf-8")
        return path

    def external(self, fixture: Fixture, reference: Any, stated: float) -> tuple[Path, float | None] | None:
        """The file of an IfcExternalReference, and the flux that it is to have, where that is not its own; None, told, without one."""
        document = getattr(reference, "ReferencedDocument", None)
        words = [reference.Location, getattr(document, "Location", None), reference[1], reference.Name]
        names = [str(word) for word in words if word]
        return self.named(fixture, next((name for name in names if name.lower().endswith(FILES)), names[0] if names else ""), stated)

    def named(self, fixture: Fixture, name: str, stated: float) -> tuple[Path, float | None] | None:
        """The same for a name."""
        if urlparse(name).scheme.lower() in ("http", "https", "ftp"):
            self.notes.of(f"the photometric file is at an address, is not fetched, and gives no light: {name}", fixture.element)
            return None
        path = self._find(name)
        if path is None:
            self.notes.of(f"the photometric file {name!r} is not beside the model, and so no light", fixture.element)
            return None
        try:
            figures = goniogram_figures(path.read_bytes(), path.name)
        except (Error, OSError) as error:
            self.notes.of(f"the photometric file {name!r} cannot be read ({error}), and so no light", fixture.element)
            return None
        known = [flux for flux in (figures["flux_lm"], figures["lamp_flux_lm"]) if flux]
        if stated <= 0.0 or any(abs(stated / flux - 1.0) < distribution.SAME for flux in known):
            return path, None
        self.notes.say(f"the flux of {stated:g} lm, not the {known[0]:.4g} lm of {path.name}, counts for {label(fixture.element)}")
        return path, stated

    def _find(self, name: str) -> Path | None:
        """A file by its path, or by its name beside the model."""
        plain = unquote(urlparse(name).path) if name.lower().startswith("file:") else name
        folder = self.source.parent
        for candidate in (folder / plain.replace("\\", "/"), folder / unquote(re.split(r"[\\/]", plain)[-1])):
            if candidate.is_file() and candidate.stat().st_size <= MOST_BYTES:
                return candidate.resolve()
        return None


def _flux(data: bytes, name: str) -> float:
    return float(goniogram_figures(data, name)["flux_lm"])
