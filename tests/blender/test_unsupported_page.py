"""One table says what is not followed: the report's lines and the page's part on Blender come from it."""

import importlib.util
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ADDON = ROOT / "blender-addon"
PAGE = ROOT / "docs" / "unsupported.md"
HEADING = "## Blender\n\n"


def table():
    """The add-on's table; it needs no Blender."""
    spec = importlib.util.spec_from_file_location("gonio_unsupported", ADDON / "unsupported.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules["gonio_unsupported"] = module
    spec.loader.exec_module(module)
    return module


def written(page: str) -> str:
    """A page with the table's part in the place of its own."""
    before, _, _ = page.partition(HEADING)
    return before + HEADING + table().page()


def test_the_page_has_the_rows_of_the_table():
    page = PAGE.read_text(encoding="utf-8")
    assert page == written(page), f"python {Path(__file__).relative_to(ROOT)} writes it"


def test_every_told_entry_is_told_and_every_line_is_of_the_table():
    sources = {path: path.read_text(encoding="utf-8") for path in ADDON.rglob("*.py") if path.name != "unsupported.py"}
    limits = table().LIMITS
    everything = "\n".join(sources.values())
    for name, limit in limits.items():
        # Nodes' own words are made of the table's stand-ins.
        assert not limit.is_told or f'"{name}"' in everything or name == "node", f"nothing tells '{name}'"
    for path, text in sources.items():
        for name in re.findall(r'\.tell\(\s*"([^"]+)"', text):
            assert name in limits and limits[name].is_told, f"{path.name}: '{name}'"


if __name__ == "__main__":
    PAGE.write_text(written(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
