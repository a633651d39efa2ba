"""The stubs say what the module has."""

import os
import pathlib
import re
import subprocess
import sys
import textwrap

import gonio
import pytest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "tests" / "docs"))
from blocks import blocks  # noqa: E402

PAGES = [REPOSITORY / "README.md", *sorted((REPOSITORY / "docs").glob("*.md"))]


@pytest.mark.timeout(240)
def test_stubs_match_the_module(tmp_path, pytestconfig):
    pytest.importorskip("mypy")
    # Half a minute goes into numpy's own stubs; the cache keeps what was found.
    environment = {**os.environ, "MYPY_CACHE_DIR": str(pytestconfig.cache.mkdir("mypy"))}
    line = [sys.executable, "-m", "mypy.stubtest", "gonio._gonio"]
    done = subprocess.run(line, capture_output=True, text=True, cwd=tmp_path, env=environment, timeout=230)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.timeout(240)
def test_the_package_is_typed(tmp_path, pytestconfig):
    pytest.importorskip("mypy")
    environment = {**os.environ, "MYPY_CACHE_DIR": str(pytestconfig.cache.mkdir("mypy"))}
    line = [sys.executable, "-m", "mypy", "--strict", "-m", "gonio.scene"]
    done = subprocess.run(line, capture_output=True, text=True, cwd=tmp_path, env=environment, timeout=230)
    assert done.returncode == 0, done.stdout + done.stderr


def python_of(page):
    """The Python of a page: blocks that tests run, shown or not, and README's example; None without any."""
    if page.name == "README.md":
        found = re.findall(r"^((?:    import [^\n]*\n)(?:(?:    [^\n]*)?\n)*)", page.read_text(), re.MULTILINE)
        return "\n".join(textwrap.dedent(block) for block in found)
    code = [block.text for block in blocks(page.parent, page.name) if (block.kind, block.name) == ("run", "python")]
    return "\n\n".join(code) if code else None


def test_pages_have_python():
    assert {"README.md", "first-python.md", "recipes.md"} <= {page.name for page in PAGES if python_of(page)}


@pytest.mark.timeout(240)
def test_examples_and_pages_are_strictly_typed(tmp_path, pytestconfig):
    pytest.importorskip("mypy")
    for page in PAGES:
        if (code := python_of(page)) is not None:
            (tmp_path / f"{page.stem.replace('-', '_')}_page.py").write_text(code)
    sources = [*sorted(tmp_path.glob("*_page.py")), *sorted((REPOSITORY / "examples" / "python").glob("*.py"))]
    environment = {**os.environ, "MYPY_CACHE_DIR": str(pytestconfig.cache.mkdir("mypy"))}
    line = [sys.executable, "-m", "mypy", "--strict", "--python-version", "3.11", *map(str, sources)]
    done = subprocess.run(line, capture_output=True, text=True, cwd=tmp_path, env=environment, timeout=230)
    assert done.returncode == 0, done.stdout + done.stderr


def test_everything_public_has_words():
    things = {name: getattr(gonio, name) for name in gonio.__all__ if not isinstance(getattr(gonio, name), str)}
    silent = [name for name, thing in things.items() if not thing.__doc__]
    for name, thing in things.items():
        classes = [base for base in thing.__mro__ if base.__module__.startswith("gonio")] if isinstance(thing, type) else []
        members = [member for base in classes for member in vars(base) if not member.startswith("_")]
        silent += [f"{name}.{member}" for member in members if not getattr(thing, member).__doc__]
    assert not silent


def test_the_simd_level_is_known():
    assert gonio.simd_level in {"avx512", "avx2", "sse4.2", "sse42", "neon", "scalar"}
