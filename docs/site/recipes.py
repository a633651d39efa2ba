"""Pictures of the recipes: `python docs/site/recipes.py` runs the page's blocks in a folder of their own and keeps what they write in docs/recipes.

Runs in the Python that has gonio, with pyoidn and numpy.
"""

from __future__ import annotations

import os
import re
import shutil
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "recipes.md"
PICTURES = ROOT / "docs" / "recipes"
PICTURE = re.compile(r"\]\(recipes/([\w.]+)\)")


def main() -> None:
    """Writes all pictures anew."""
    sys.path.insert(0, str(ROOT / "tests" / "docs"))
    from blocks import blocks

    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        names: dict[str, object] = {"__name__": "page"}
        for block in blocks(PAGE.parent, PAGE.name):
            exec(compile(block.text, PAGE.name, "exec"), names)
        PICTURES.mkdir(exist_ok=True)
        for name in PICTURE.findall(PAGE.read_text()):
            shutil.copyfile(name, PICTURES / name)
        os.chdir(ROOT)


if __name__ == "__main__":
    main()
