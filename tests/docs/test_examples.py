"""Examples of the pages do what they say: marked blocks run, in their order, in a folder that looks like the repository after `make build`."""

import os
import pathlib
import subprocess
import sys

import pytest
from blocks import blocks

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
DOCS = REPOSITORY / "docs"
PAGES = [path.name for path in sorted(DOCS.glob("*.md")) if "<!-- run: " in path.read_text()]


@pytest.fixture
def repository(tmp_path, monkeypatch):
    """A folder with the examples, an empty `out`, and the environment of these tests as `.venv`."""
    (tmp_path / "examples").symlink_to(REPOSITORY / "examples")
    (tmp_path / ".venv").symlink_to(sys.prefix)
    (tmp_path / "out").mkdir()
    monkeypatch.chdir(tmp_path)
    return tmp_path


def shell(text, folder):
    environment = {**os.environ, "PATH": f"{folder / '.venv' / 'bin'}:{os.environ['PATH']}"}
    done = subprocess.run(["bash", "-e", "-c", text], cwd=folder, env=environment, capture_output=True, text=True, timeout=240)
    assert done.returncode == 0, f"{text}\n{done.stdout}{done.stderr}"


@pytest.mark.parametrize("page", PAGES)
def test_marked_blocks_run(page, repository):
    names = {"__name__": "page"}
    for block in blocks(DOCS, page):
        if block.kind == "file":
            (repository / block.name).write_text(block.text)
        elif block.name == "python":
            exec(compile(block.text, page, "exec"), names)
        else:
            assert block.name == "sh", f"{page}: {block.name} is no language that is run"
            shell(block.text, repository)


def test_pages_have_examples():
    assert {"first-usd.md", "first-python.md", "from-usdrecord.md", "install.md"} <= set(PAGES)
