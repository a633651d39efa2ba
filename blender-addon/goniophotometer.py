# SPDX-License-Identifier: GPL-3.0-or-later
"""Luminaires as objects of a view layer, and how light leaves them."""

from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import gonio
import numpy as np

from .export import Exporter
from .export.part import Part, frame_of
from .report import Report

ENDINGS = (".ldt", ".ies", ".xml", ".gldf")


@dataclass(frozen=True)
class Luminaire:
    """Objects that are measured together; the frame's −Z is γ = 0, its X C0."""

    name: str
    uids: frozenset
    frame: np.ndarray


def chosen(view_layer, collection, kind: str) -> Luminaire:
    """The luminaire that is selected, the active object with all below it, or a collection; raises ValueError where there is none."""
    active = view_layer.objects.active
    if kind == "COLLECTION":
        things, name = list(collection.all_objects), collection.name
        if not things:
            raise ValueError(f"{name}: the collection is empty; there is no luminaire to measure")
        lead = _topmost(things)
    elif kind == "CHILDREN":
        if active is None:
            raise ValueError("No object is active: choose the luminaire")
        things, lead, name = [active, *active.children_recursive], active, active.name
    else:
        things = list(view_layer.objects.selected)
        if not things:
            raise ValueError("Nothing is selected: select the luminaire")
        lead = active if active in things else _topmost(things)
        name = lead.name
    try:
        frame = frame_of(lead.matrix_world)
    except ValueError as problem:
        raise ValueError(f"{lead.name}: {problem}") from None
    return Luminaire(name, frozenset(thing.session_uid for thing in things), frame)


def _topmost(things):
    """The first of some objects that hangs on none of the others."""
    return next(thing for thing in things if thing.parent not in things)


class Measurement:
    """A luminaire that was exported once, and what is found of it."""

    def __init__(self, depsgraph, luminaire: Luminaire) -> None:
        self.luminaire, self.report, self.progress = luminaire, Report(), None
        self._scene = Exporter(self.report, Part(luminaire.uids, luminaire.frame)).sync(depsgraph)

    def run(self, cancelled=None, **options):
        """Measures with options of `gonio.goniometer`; it asks nothing of Blender, so that any thread may wait for it."""

        def tell(*progress):
            self.progress = progress
            return cancelled is None or not cancelled()

        try:
            reading = gonio.goniometer(self._scene, progress=tell, **options)
        except gonio.SettingError as problem:
            if not str(problem).startswith("luminaire:"):
                raise
            raise ValueError("no light source is within: no lamp, no evenly glowing surface that is shown") from None
        if reading.flux.value <= 0.0:
            raise ValueError(f"no light leaves: {reading.absorbed.value:,.1f} of {reading.emitted.value:,.1f} lm are absorbed within")
        return reading

    def describe_progress(self, wanted: float) -> str:
        """How far it is, in words."""
        if self.progress is None:
            return "starting"
        rays, _, error, _ = self.progress
        reached = "" if error is None else f", peak ± {100 * error:.2g} %" + (f" ({100 * wanted:.2g} % wanted)" if wanted else "")
        return f"{rays / 1e6:,.1f} M rays{reached}"


def write(reading, path: Path, **options) -> tuple[dict, list]:
    """Writes a luminaire's file; gives its figures as its readers see them, and what it cannot hold."""
    left_out = reading.write(path, **options)
    return gonio.goniogram_figures(path.read_bytes(), str(path)), left_out


def figures_of(reading, **options) -> dict:
    """The figures of the file that would be written."""
    with TemporaryDirectory() as folder:
        return write(reading, Path(folder) / "luminaire.ldt", **options)[0]


def figure_lines(reading, figures) -> tuple[str, ...]:
    """A luminaire's figures in words."""
    c, gamma = reading.peak_direction
    ratio = reading.light_output_ratio
    across = " × ".join(f"{angle:.0f}°" for angle in figures["beam_angle_deg"])
    return (
        f"{reading.flux.value:,.1f} lm ± {reading.flux.standard_error:.2g}",
        f"light output ratio {100 * ratio.value:.1f} %",
        f"peak {reading.peak.value:,.1f} cd ± {reading.peak.standard_error:.2g} at C {c:g}°, γ {gamma:g}°",
        f"beam {across}",
        f"absorbed {reading.absorbed.value:,.1f} lm",
    )
