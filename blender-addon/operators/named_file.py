# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of the files that operators write."""

from pathlib import Path


def end_name(operator, ending: str) -> bool:
    """Gives a file that was named without an ending this one; whether its name has changed."""
    path = Path(operator.filepath)
    if not path.name or path.suffix:
        return False
    operator.filepath = str(path.with_suffix(ending))
    return True
