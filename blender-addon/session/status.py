# SPDX-License-Identifier: GPL-3.0-or-later
"""What the status bar says."""


def clock(seconds: float) -> str:
    """1:02:03 or 2:03."""
    whole = max(0, round(seconds))
    hours, minutes = whole // 3600, whole // 60 % 60
    return f"{hours}:{minutes:02d}:{whole % 60:02d}" if hours else f"{minutes}:{whole % 60:02d}"


def text(progress, samples: int) -> str:
    """Samples so far and the time left; `samples` is 0 when there is no limit."""
    parts = [f"Sample {progress.samples}/{samples}" if samples else f"Sample {progress.samples}"]
    if progress.samples == 0 and progress.fraction == 0.0:
        parts = ["Preparing the scene"]
    elif progress.remaining is not None and progress.fraction < 1.0 and samples:
        parts.append(f"{clock(progress.remaining)} left")
    return ", ".join(parts)
