"""Links of pages: files of the repository, as they stand on a page, turned into files of the site."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Callable

FENCE = re.compile(r"^ *(```|~~~)")
# An image or a link with its target: everything up to the bracket, then the path, then the place on the page.
LINK = re.compile(r"(\]\()([^)\s#]+)(#[^)\s]*)?(\))")
INDENTED = re.compile(r"^(    |\t)")


def rewrite(text: str, turn: Callable[[str], str]) -> str:
    """The Markdown with every relative target of a link turned; code stays as it is."""
    lines, fenced = [], False
    for line in text.splitlines():
        if FENCE.match(line):
            fenced = not fenced
        elif not fenced and not INDENTED.match(line):
            line = LINK.sub(lambda found: _turned(found, turn), line)
        lines.append(line)
    return "\n".join(lines) + "\n"


def _turned(found: re.Match[str], turn: Callable[[str], str]) -> str:
    head, target, place, tail = found.groups()
    return head + (target if ":" in target else turn(target)) + (place or "") + tail


def in_repository(page: str, target: str) -> str:
    """The path in the repository of what a page there links to; one that leaves it begins with two dots."""
    return posixpath.normpath(posixpath.join(posixpath.dirname(page), target))


def between(page: str, target: str) -> str:
    """The link from one file of the site to another."""
    return posixpath.relpath(target, posixpath.dirname(page) or ".")
