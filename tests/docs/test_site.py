"""The site builds without a warning: every page is found, every link and every place within a page is there, and nothing comes from the network."""

import html.parser
import os
import pathlib
import subprocess
import sys

import pytest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
MKDOCS = pathlib.Path(os.environ.get("GONIO_MKDOCS", REPOSITORY / ".venv-docs" / "bin" / "mkdocs"))


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The site, built strictly, with the pictures that are there."""
    if not MKDOCS.exists():
        pytest.skip(f"{MKDOCS} is not there: `make docs` brings it")
    folder = tmp_path_factory.mktemp("site")
    line = [MKDOCS, "build", "--strict", "-f", REPOSITORY / "docs" / "site" / "mkdocs.yml", "-d", folder]
    environment = {**os.environ, "GONIO_PYTHON": sys.executable, "NO_MKDOCS_2_WARNING": "1"}
    done = subprocess.run(line, capture_output=True, text=True, env=environment, timeout=280)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


class Page(html.parser.HTMLParser):
    """A page's links, the places that others may link to, and its words."""

    def __init__(self, path):
        super().__init__()
        self.links, self.loaded, self.places, self.words = [], [], set(), []
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.places |= {found[name] for name in ("id", "name") if found.get(name)}
        if tag == "a" and found.get("href"):
            self.links.append(found["href"])
        if tag in ("img", "script", "iframe") and found.get("src"):
            self.loaded.append(found["src"])
        if tag == "link" and found.get("href") and found.get("rel") not in ("canonical",):
            self.loaded.append(found["href"])

    def handle_data(self, data):
        self.words.append(data)


@pytest.fixture(scope="module")
def pages(site):
    return {path: Page(path) for path in site.rglob("*.html") if path.name != "404.html"}


def outside(link):
    return link.startswith(("http:", "https:", "//", "mailto:", "data:"))


def test_links_lead_somewhere(site, pages):
    broken = []
    for path, page in pages.items():
        for link in page.links + page.loaded:
            target, _, place = link.partition("#")
            goal = (path.parent / target).resolve() if target else path
            if outside(link) or goal == site:
                continue
            if not goal.is_file() or (place and goal in pages and place not in pages[goal].places):
                broken.append(f"{path.name}: {link}")
    assert not broken


def test_nothing_comes_from_the_network(pages):
    assert not [(path.name, link) for path, page in pages.items() for link in page.loaded if outside(link)]


def test_tables_are_tables(pages):
    assert not [path.name for path, page in pages.items() if "| --- |" in "".join(page.words)]


def test_the_reference_has_every_command_and_name(site, pages):
    import gonio

    python = pages[site / "reference" / "python.html"]
    assert {f"gonio{name}".lower() for name in gonio.__all__ if callable(getattr(gonio, name))} <= python.places
    assert {"gonio-render", "gonio-measure", "gonio-report"} <= pages[site / "reference" / "command-line.html"].places
