"""The page of the node operations is that of the table, and all of its operations are there."""

import importlib.util
import pathlib
import re
import sys

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]


def script():
    found = importlib.util.spec_from_file_location("operations", REPOSITORY / "docs" / "site" / "operations.py")
    module = sys.modules["operations"] = importlib.util.module_from_spec(found)
    found.loader.exec_module(module)
    return module


def test_the_page_is_of_the_table():
    module = script()
    assert module.PAGE.read_text() == module.page(), "`python docs/site/operations.py` writes it anew"


def test_every_operation_is_there():
    found = {operation.name: operation for operation in script().operations()}
    table = (REPOSITORY / "rust-core" / "nodes" / "src" / "table.rs").read_text().split("\noperations! {")[1]
    names = re.findall(r"^        ([A-Z]\w+)(?= ?[({<]| \{)", table, re.MULTILINE)
    assert len(found) == len(names) > 50 and set(found) == set(names)
    assert found["Mix"].inputs == ["a", "b", "share"] and found["Dot"].inputs == ["a (3)", "b (3)"]
    assert found["Brick" + "Texture"].outputs == "2, the others 0" and found["Position"].inputs == []
    assert {name for name, _, _ in found["Image"].fields} == {"texture", "wrap", "filter", "scale", "bias", "fallback"}
    assert all(operation.words.endswith(".") for operation in found.values())
