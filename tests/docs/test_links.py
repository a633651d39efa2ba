"""Links between the pages of the repository lead somewhere, and so do their places within pages."""

import pathlib
import re

import pytest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
PAGES = [*REPOSITORY.glob("*.md"), *REPOSITORY.glob("docs/*.md"), *REPOSITORY.glob("examples/*.md"), *REPOSITORY.glob("tests/peers/*/*.md")]
LINK = re.compile(r"\]\(([^)\s#]*)(?:#([^)\s]*))?\)")


def prose(path):
    """The lines of a page that are not code."""
    fenced, lines = False, []
    for line in path.read_text().splitlines():
        if line.lstrip().startswith("```"):
            fenced = not fenced
        elif not fenced and not line.startswith("    "):
            lines.append(line)
    return lines


def places(path):
    """The names of a page's headings, as links have them."""
    headings = [line.lstrip("#").strip() for line in prose(path) if re.match(r"#+ ", line)]
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES, ids=lambda path: str(path.relative_to(REPOSITORY)))
def test_links_lead_somewhere(page):
    broken = []
    for target, place in LINK.findall("\n".join(prose(page))):
        if ":" in target:
            continue
        path = (page.parent / target).resolve() if target else page
        if not path.exists() or (place and path.suffix == ".md" and place not in places(path)):
            broken.append(f"{target}#{place}" if place else target)
    assert not broken
