"""The page of the paper's tables: its plots are those of its figures, its pictures are there and small."""

import importlib.util
import pathlib
import sys

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
PAGE = REPOSITORY / "docs" / "paper.md"


def script():
    found = importlib.util.spec_from_file_location("paper", REPOSITORY / "docs" / "site" / "paper.py")
    module = sys.modules["paper"] = importlib.util.module_from_spec(found)
    found.loader.exec_module(module)
    return module


def test_plots_are_of_the_tables():
    plots = script().plots(PAGE.read_text())
    assert set(plots) == {"paper-speed.svg", "paper-rays.svg", "paper-frames.svg"}
    for name, drawing in plots.items():
        assert (PAGE.parent / name).read_text() == drawing, f"{name}: `python docs/site/paper.py` draws it anew"


def test_pictures_are_small():
    for name in ("car", "glass", "room"):
        picture = PAGE.parent / f"paper-{name}.png"
        assert picture.name in PAGE.read_text() and 10_000 < picture.stat().st_size < 200_000


def test_measured_tables_take_their_place():
    page = "# P\n\n## A\n\nWords.\n\n| | x |\n| --- | --- |\n| a | 1 |\n\nMore.\n\n## B\n\n| | y |\n| --- | --- |\n| b | 2 |\n"
    measured = "a heading\n\n## A\n\n| | x |\n| --- | --- |\n| a | **3** |\n"
    changed = script().replaced(page, measured)
    assert changed == page.replace("| a | 1 |", "| a | **3** |")
    assert script().tables(changed) == {"A": [{"": "a", "x": "3"}], "B": [{"": "b", "y": "2"}]}
