"""No page, message or help text has somebody install a package that is on no index: gonio is installed from the file that was built."""

import pathlib
import re

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
# "pip install", options, and gonio as a name: with extras, a version, or alone.
BY_NAME = re.compile(r"(?<!name )(?:pip|pipx|uv pip|uv tool|conda) install (?:-\S+ )*['\"]?gonio(?:\[|[=<>~!]|['\"]|\s|$)", re.MULTILINE)
TEXT = {".md", ".py", ".rs", ".pyi", ".toml", ".html"}
LEFT_OUT = {"target", "out", "dist", "node_modules"}


def files():
    for folder in (".", "docs", "examples", "rust-core", "usd", "blender-addon"):
        top = REPOSITORY / folder
        found = top.glob("*") if folder == "." else top.rglob("*")
        yield from (path for path in found if path.suffix in TEXT and not LEFT_OUT & set(path.parts))


def test_gonio_is_installed_from_its_file():
    assert not [str(path.relative_to(REPOSITORY)) for path in files() if BY_NAME.search(path.read_text())]


def test_what_is_looked_for_is_found():
    for wrong in ("pip install gonio", "pip install 'gonio[usd]'", "python -m pip install -U gonio==1.0", "uv pip install gonio\n"):
        assert BY_NAME.search(wrong), wrong
    for right in ("pip install dist/here/gonio-*.whl", "pip install gonio-0.1.whl", "pip install usd-core"):
        assert not BY_NAME.search(right), right
