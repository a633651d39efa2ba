"""What the site has beyond the pages in docs: pages that are written while it is built, files that pages link to, and links between them.

`GONIO_PYTHON` names the Python that has gonio (.venv's without it).
"""

from __future__ import annotations

import functools
import os
import re
from pathlib import Path

import accuracy
import command_line
import gallery
import links
import python_page
import usd_attributes
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

ROOT = Path(__file__).resolve().parents[2]
PYTHON = os.environ.get("GONIO_PYTHON", str(ROOT / ".venv" / "bin" / "python"))
# Pages of the repository that stand elsewhere than in docs.
ELSEWHERE = ("ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md", "examples/README.md")
# What a link of the repository leads to on the site, where that is no file of its own.
INSTEAD = {"README.md": "index.md", "examples": "examples/README.md"}
WRITTEN = {
    "gallery.md": gallery.page,
    "reference/command-line.md": lambda: command_line.page([PYTHON, "-m", "gonio.cli"]),
    "reference/python.md": lambda: python_page.page(PYTHON),
    "reference/usd-attributes.md": lambda: usd_attributes.page(ROOT / "docs"),
}
COMMENT = re.compile(r"^(<!--.*-->)$", re.MULTILINE)
# What the tests of the examples read, and readers do not.
FOR_TESTS = re.compile(r"^<!-- (?:run|file): .*?-->\n", re.MULTILINE | re.DOTALL)


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Leaves pages out of the order that are not there, and puts those under *More* that it does not name."""
    there = {path.name for path in (ROOT / "docs").glob("*.md")} | set(WRITTEN) | set(ELSEWHERE)
    named: set[str] = set()
    config.nav = _present(config.nav, there, named)
    if more := sorted(there - named):
        config.nav.append({"More": more})
    return config


def _present(entries: list, there: set[str], named: set[str]) -> list:
    kept = []
    for entry in entries:
        ((title, inside),) = entry.items()
        if isinstance(inside, list):
            kept.append({title: _present(inside, there, named)})
        elif inside in there:
            named.add(inside)
            kept.append(entry)
    return kept


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Adds written pages, those that stand elsewhere, and all that pages link to."""
    for name in ELSEWHERE:
        files.append(File.generated(config, name, abs_src_path=str(ROOT / name)))
    for name, write in WRITTEN.items():
        files.append(File.generated(config, name, content=write()))
    for file in [file for file in files if file.is_documentation_page()]:
        links.rewrite(file.content_string, functools.partial(_linked, files, config, file.src_uri))
    return files


def _linked(files: Files, config: MkDocsConfig, page: str, target: str) -> str:
    """The link as the site has it. A file of the repository that a page links to comes along."""
    # Pages that are written link as from the repository's root.
    stands = "" if page in WRITTEN else page if page in ELSEWHERE else f"docs/{page}"
    wanted = links.in_repository(stands, target)
    wanted = INSTEAD.get(wanted, wanted)
    place = wanted.removeprefix("docs/")
    if files.get_file_from_path(place) is None and not wanted.startswith("..") and (ROOT / wanted).is_file():
        files.append(File.generated(config, place, abs_src_path=str(ROOT / wanted)))
    return links.between(page, place)


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Links as the site has them; a table that follows a comment is a table, and bars in code are bars."""
    text = FOR_TESTS.sub("", markdown).replace(accuracy.MARK, accuracy.summary(ROOT / "docs" / "validation.md"))
    text = links.rewrite(text, functools.partial(_linked, files, config, page.file.src_uri))
    text = "\n".join(_bars(line) if line.startswith("|") else line for line in text.splitlines())
    return COMMENT.sub(r"\n\1\n", text)


def _bars(row: str) -> str:
    """A row of a table whose code has bars as they are: elsewhere they want a backslash there too."""
    parts = row.split("`")
    parts[1::2] = [code.replace("\\|", "|") for code in parts[1::2]]
    return "`".join(parts)
