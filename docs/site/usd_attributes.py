"""The page on gonio's own attributes of USD prims: the rows of tables that name them, from all pages."""

from __future__ import annotations

import re
from pathlib import Path

ROW = re.compile(r"^\| `(?:primvars:)?gonio:[^|]*\|[^|]*\|.*\|$")
HEADING = re.compile(r"^#+ (.*)$")
INTRODUCTION = """# USD attributes

Attributes of gonio's own, for what USD has no words for. Each table links to the page that explains it. Cameras, lights, materials and render
settings of USD itself are followed as they are; [what of them](docs/usd.md#render-settings-products-and-variables), and [what is left
out](docs/unsupported.md#usd-stages).
"""
# Those that stand in sentences.
OTHERS = """## Others

| attribute | type | what |
| --- | --- | --- |
| `gonio:fisheye` | double | of a Camera: an equidistant fisheye with this full field of view in degrees ([glare](docs/measuring.md#from-pictures)) |
| `gonio:hideLights` | bool | of RenderSettings: the camera sees no lamp ([what that means](docs/usd.md#lamps-before-the-camera)) |
| `primvars:gonio:visibility:camera` | bool | of a light: false hides it from the camera; `ri`'s and `arnold`'s attributes of that meaning count too |

Measured materials are shaders of the id `gonio:MeasuredBSDF` ([inputs](docs/measured-materials.md#in-usd)).
"""


def page(docs: Path) -> str:
    """The tables, page by page, with links from the repository's root."""
    lines = [INTRODUCTION]
    for path in sorted(docs.glob("*.md")):
        text = path.read_text().splitlines()
        rows = [row for row in text if ROW.match(row)]
        if rows and path.name != "unsupported.md":
            title = next(found[1] for line in text if (found := HEADING.match(line)))
            lines += [
                f"## {title}",
                "",
                f"From [{title}](docs/{path.name}).",
                "",
                "| attribute | type | what |",
                "| --- | --- | --- |",
                *rows,
                "",
            ]
    return "\n".join([*lines, OTHERS])
