"""The gallery's pictures have the files that are said to make them."""

import importlib.util
import pathlib
import sys

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]


def gallery():
    place = REPOSITORY / "docs" / "site" / "gallery.py"
    found = importlib.util.spec_from_file_location("gallery", place)
    module = sys.modules["gallery"] = importlib.util.module_from_spec(found)
    found.loader.exec_module(module)
    return module


def test_pictures_have_their_files():
    pictures = gallery().PICTURES
    assert len({picture.name for picture in pictures}) == len(pictures) >= 12
    for picture in pictures:
        assert (REPOSITORY / picture.source).is_file(), picture
        assert f"out/gallery/{picture.name}" in picture.commands[-1], picture


def test_every_python_example_has_its_picture():
    shown = {picture.source for picture in gallery().PICTURES}
    examples = {path.relative_to(REPOSITORY).as_posix() for path in (REPOSITORY / "examples" / "python").glob("*.py")}
    assert examples - shown == {"examples/python/shapes.py"}


def test_a_changed_command_is_another_stamp():
    module = gallery()
    first = module.PICTURES[0]
    other = module.Picture(first.name, first.title, first.words, first.source, ("gonio info x.usda",))
    assert module.stamp(first) == module.stamp(first) != module.stamp(other)
