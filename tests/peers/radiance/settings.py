"""The settings that are run, each curve from quick to fine."""

import shlex
from pathlib import Path

import measured_by
from equal_error import CACHED, GONIO, TRACED, Setting

SAMPLES = (16, 64, 256, 1024, 4096, 16384, 65536)
# Every point by itself: ambient values are not interpolated, and the default `-as 512` would cost more than it brings.
# Openings seen in part, as through the door, want `-ds` well below the default 0.2.
WITHOUT_CACHE = (
    "-ab 0 -ds .05",
    "-ab 2 -ad 32 -as 0 -aa 0 -ds .05 -lw 2e-2",
    "-ab 3 -ad 64 -as 0 -aa 0 -ds .05 -lw 1e-2",
    "-ab 5 -ad 128 -as 0 -aa 0 -ds .05 -lw 2e-3",
    "-ab 8 -ad 256 -as 0 -aa 0 -ds .02 -dt 0 -lw 5e-4",
    "-ab 12 -ad 1024 -as 0 -aa 0 -ds .02 -dt 0 -lw 1e-4",
    "-ab 12 -ad 4096 -as 0 -aa 0 -ds .02 -dt 0 -lw 3e-5",
)
# Ambient values are kept and interpolated.
WITH_CACHE = (
    "-ab 2 -ad 128 -as 32 -aa .3 -ar 16 -ds .05",
    "-ab 3 -ad 256 -as 64 -aa .2 -ar 32 -ds .05",
    "-ab 5 -ad 512 -as 128 -aa .2 -ar 64 -ds .02 -dt 0",
    "-ab 8 -ad 1024 -as 256 -aa .15 -ar 128 -ds .02 -dt 0",
)


def settings(most_samples: int, most: int) -> list[Setting]:
    """Gonio's up to so many samples, and the first so many of each of Radiance's curves."""
    ours = [Setting(GONIO, f"--spp {samples}") for samples in SAMPLES if samples <= most_samples]
    return ours + [Setting(TRACED, each) for each in WITHOUT_CACHE[:most]] + [Setting(CACHED, each) for each in WITH_CACHE[:most]]


def measured(setting: Setting, stage: Path, peer: measured_by.Radiance, seed: int) -> measured_by.Measured:
    """A run of a setting; Radiance's random numbers differ from run to run."""
    options = shlex.split(setting.options)
    return measured_by.by_gonio(stage, int(options[1]), seed) if setting.curve == GONIO else peer.measure(options)
