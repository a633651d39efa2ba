# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures by wavelength: their files, and how they are rendered."""

from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryFile

import gonio

ENDINGS = (".exr", ".hsr")
# Nanometres from the first band to the last.
REACH = 400
# Bands of Radiance's files, in nm: it reads at most 24 of them.
RADIANCE_BAND = 20


def passes_by_wavelength(view_layer) -> list[str]:
    """Passes of a view layer that are known by wavelength: the colour, illuminance, and light groups with all other light."""
    groups = [f"lightgroup:{group.name}" for group in view_layer.lightgroups]
    if groups:
        groups.append("lightgroup:other")
    return ["color", *(["illuminance"] if view_layer.gonio.use_pass_illuminance else []), *groups]


@dataclass(frozen=True)
class Wanted:
    """A file, and the width of its bands in nm."""

    path: Path
    band: int

    @classmethod
    def checked(cls, path: Path, band: int) -> "Wanted":
        """What can be written, Radiance's files in the bands that it reads; raises ValueError before anything is rendered."""
        if not path.name:
            raise ValueError("No file is named: a picture by wavelength is written to one")
        ending = path.suffix.lower()
        if ending not in ENDINGS:
            raise ValueError(f"{path}: the ending is '{path.suffix}', expected {' or '.join(ENDINGS)}")
        if path.is_dir():
            raise ValueError(f"{path}: it is a folder")
        try:
            with TemporaryFile(dir=path.parent):
                pass
        except OSError as problem:
            raise ValueError(f"{path}: nothing can be written there: {problem.strerror}") from None
        return cls(path, RADIANCE_BAND if ending == ".hsr" else band)

    def render(self, scene: gonio.Scene, cancelled=None):
        """Renders and writes it; it asks nothing of Blender, so that any thread may wait for it."""
        try:
            picture = gonio.spectral_picture(scene, band=self.band, cancelled=cancelled)
        except gonio.SettingError as problem:
            if not str(problem).startswith("part:"):
                raise
            raise ValueError("Sample Subset is on (Sampling, Advanced): a picture by wavelength takes all samples") from None
        if cancelled is not None and cancelled():
            raise gonio.Cancelled("cancelled")
        picture.write(self.path)
        return picture

    def line(self) -> str:
        """What was written, in words."""
        return f"{self.path}: spectral radiance in {REACH // self.band} bands of {self.band} nm"
