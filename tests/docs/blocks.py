"""Blocks of pages that the tests run: those after a comment that says so.

`<!-- run: sh -->` and `<!-- run: python -->` stand before a block, fenced or indented, or hold one themselves where readers need not see it.
`<!-- file: NAME -->` stands before what a file holds; `<!-- file: NAME from PAGE -->` takes it from another page.
"""

import re
import textwrap
from dataclasses import dataclass

MARK = re.compile(r"<!-- (run|file): (\S+)(?: from (\S+))?(?:\n(.*?))?\s*-->\n", re.DOTALL)
FENCED = re.compile(r"\s*```[^\n]*\n(.*?)^```$", re.DOTALL | re.MULTILINE)
INDENTED = re.compile(r"\s*?((?:^(?:    [^\n]*)?\n)+)", re.MULTILINE)


@dataclass(frozen=True)
class Block:
    """A block of a page: what to do with it (`run`, `file`), its language or the file's name, and its text."""

    kind: str
    name: str
    text: str


def blocks(folder, page):
    """The marked blocks of a page, in their order."""
    text = (folder / page).read_text()
    found = []
    for mark in MARK.finditer(text):
        kind, name, other, hidden = mark.groups()
        if other:
            found += [block for block in blocks(folder, other) if block.kind == "file" and block.name == name]
        else:
            found.append(Block(kind, name, hidden + "\n" if hidden else _after(text, mark.end(), page)))
    return found


def _after(text, start, page):
    block = FENCED.match(text, start) or INDENTED.match(text, start)
    assert block and block[1].strip(), f"{page}: no block after the comment in line {text.count(chr(10), 0, start)}"
    return textwrap.dedent(block[1])
