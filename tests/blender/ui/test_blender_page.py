"""docs/blender.md has a row for each panel and each setting of Cycles, by the tables that the export and the operator use."""

import sys
from pathlib import Path

import pytest

PAGE = Path(__file__).resolve().parents[3] / "docs" / "blender.md"


@pytest.mark.blender
def test_the_page_is_the_tables(tmp_path: Path):
    import os
    import unittest

    import blender_page
    import bpy

    if bpy.app.version[:2] != blender_page.VERSION or not hasattr(bpy.context.scene, "cycles"):
        raise unittest.SkipTest("the page is that of Blender 5.0 with Cycles")
    text = PAGE.read_text(encoding="utf-8")
    before, heading, found = text.partition(blender_page.HEADING)
    if os.environ.get("GONIO_WRITE_PAGE"):
        PAGE.write_text(before + blender_page.HEADING + blender_page.page(), encoding="utf-8")
        return
    assert heading and found == blender_page.page(), "GONIO_WRITE_PAGE=1 with this test writes the page"


if __name__ == "__main__":
    sys.exit("run it with pytest and GONIO_WRITE_PAGE=1")
