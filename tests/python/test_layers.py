"""Which module of the Blender extension and of the package imports which, wherever in a file it does: no large circles."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
FOLDERS = {"blender-addon": 3, "rust-core/python/python/gonio": 3}


def imported(tree, module, known):
    """The modules that a file's imports name, those inside functions too."""
    for node in ast.walk(tree):
        if not isinstance(node, ast.ImportFrom) or node.level == 0:
            continue
        parts = module.split(".")
        package = parts[: len(parts) - node.level + (module in known["packages"])]
        base = [*package, *(node.module or "").split(".")] if node.module else package
        for alias in node.names:
            inner = ".".join([*base, alias.name])
            yield inner if inner in known["modules"] else ".".join(base)


def circles(folder):
    """Sets of modules that import each other; packages' own files hand on and are left out."""
    files = {".".join(path.relative_to(folder).with_suffix("").parts): path for path in folder.rglob("*.py")}
    packages = {name.removesuffix(".__init__") for name in files if name.endswith("__init__")}
    known = {"modules": set(files) | packages, "packages": packages}
    arrows = {}
    for name, path in files.items():
        if not name.endswith("__init__"):
            arrows[name] = {target for target in imported(ast.parse(path.read_text()), name, known) if target in files and target != name}
    reached = {}
    for name in arrows:
        found, waiting = set(), [name]
        while waiting:
            new = arrows.get(waiting.pop(), set()) - found
            found |= new
            waiting += new
        reached[name] = found
    return {frozenset(other for other in found if name in reached[other]) for name, found in reached.items() if name in found}


@pytest.mark.parametrize(("folder", "most"), FOLDERS.items())
def test_no_circle_of_imports_is_large(folder, most):
    assert [sorted(circle) for circle in circles(ROOT / folder) if len(circle) > most] == []


def test_a_circle_is_found(tmp_path):
    for name, text in {"a": "from .b import x", "b": "def f():\n    from . import c", "c": "from .a import y", "d": "from .a import z"}.items():
        (tmp_path / f"{name}.py").write_text(text)
    assert circles(tmp_path) == {frozenset("abc")}
