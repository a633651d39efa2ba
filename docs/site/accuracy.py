"""What the page on validation holds, in short: its sections, their cases, and how many hold."""

from __future__ import annotations

import re
from pathlib import Path

MARK = "<!-- summary of validation.md -->"


def summary(validation: Path) -> str:
    """A table with a row for each section whose tables say what holds."""
    lines = ["| section | cases | hold |", "| --- | ---: | ---: |"]
    for section in re.split(r"^## ", validation.read_text(), flags=re.MULTILINE)[1:]:
        title, *body = section.splitlines()
        held = [line.rstrip(" |").rsplit("|", 1)[-1].strip() for line in body if line.startswith("|")]
        cases = [word for word in held if word in ("yes", "no")]
        if cases:
            lines.append(f"| [{title}](validation.md#{slug(title)}) | {len(cases)} | {cases.count('yes')} |")
    return "\n".join(lines)


def slug(title: str) -> str:
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")
