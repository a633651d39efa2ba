"""`gonio report` for readers of other languages, on paper, and tables that sort and copy in a browser."""

import html
import json
import os
import re
import shutil
import subprocess

import pytest
from test_report import STAGE, LUMINAIRE, Reader

pytest.importorskip("gonio")
pytest.importorskip("pxr")

BROWSER = next(filter(None, map(shutil.which, ["chromium", "chromium-browser", "google-chrome"])), None)
QUICK = ("--point-spp", 64, "--max-bounces", 0, "-q")


@pytest.fixture
def stage(tmp_path):
    (tmp_path / "globe.ies").write_text(LUMINAIRE)
    path = tmp_path / "hall.usda"
    path.write_text(STAGE)
    return path


def written(run, stage, output, *options):
    done = run("report", stage, "-o", output, "--no-pictures", *QUICK, *options)
    assert done.returncode == 0, done.stderr
    return output


@pytest.mark.parametrize(
    ("code", "words"),
    [
        ("de", ["Leuchten", "Berechnungsraster", "Beleuchtungsstärke", "gesamt", "Lichtstärkeverteilungen", "Hersteller: A<b>ME & Sons"]),
        ("fr", ["Luminaires", "Grilles de calcul", "éclairement", "total", "Répartitions lumineuses", "fabricant: A<b>ME & Sons"]),
        ("es", ["Luminarias", "Mallas de cálculo", "iluminancia", "total", "Distribuciones luminosas", "fabricante: A<b>ME & Sons"]),
    ],
)
def test_other_languages_have_their_words_and_numbers(run, stage, tmp_path, code, words):
    text = written(run, stage, tmp_path / "page.html", "--language", code).read_text(encoding="utf-8")
    reader = Reader(text)
    told = [*reader.words, *(cell for table in reader.tables for row in table for cell in row)]
    assert f'<html lang="{code}">' in text
    for word in words:
        assert any(word in each for each in told), word
    # Decimals have commas; names and the files' texts do not change.
    cells = [cell for table in reader.tables for row in table[1:] for cell in row]
    assert "0,50 × 0,50" in cells and "globe.ies" in cells and "100 %" in cells
    assert not any(re.search(r"\d\.\d", cell) for cell in cells), cells
    # No word of the English page is left.
    english = Reader(written(run, stage, tmp_path / "english.html").read_text(encoding="utf-8"))
    names = {cell for table in english.tables for cell in table[0] if " " in cell} - {"flux, lm"}
    assert not names & set(told)


def test_an_unknown_language(run, stage, tmp_path):
    done = run("report", stage, "-o", tmp_path / "page.html", "--language", "xx", check=False)
    assert done.returncode == 2 and "possible values: en, de, fr, es" in done.stderr


@pytest.mark.skipif(BROWSER is None, reason="no Chromium or Chrome is on PATH")
def test_pdf_by_a_browser(run, stage, tmp_path):
    pages = written(run, stage, tmp_path / "page.pdf", "--language", "de").read_bytes()
    assert pages.startswith(b"%PDF") and pages.count(b"/Type /Page\n") >= 2


def test_pdf_without_a_browser(run, stage, tmp_path):
    done = run("report", stage, "-o", tmp_path / "page.pdf", "--no-pictures", *QUICK, env={**os.environ, "PATH": str(tmp_path)})
    assert done.returncode == 1 and "none of chromium, chromium-browser and google-chrome is on PATH" in done.stderr
    assert len(done.stderr.splitlines()) == 1 and not (tmp_path / "page.pdf").exists()


def test_a_page_outlives_a_browser_that_fails(run, stage, tmp_path):
    browser = tmp_path / "bin" / "chromium"
    browser.parent.mkdir()
    browser.write_text("#!/bin/sh\nexit 7\n")
    browser.chmod(0o755)
    done = run("report", stage, "-o", tmp_path / "page.pdf", "--no-pictures", *QUICK, env={**os.environ, "PATH": str(browser.parent)})
    assert done.returncode == 1 and "wrote no PDF: exit status: 7" in done.stderr and f"kept as {tmp_path / 'page.html'}" in done.stderr
    assert "</html>" in (tmp_path / "page.html").read_text(encoding="utf-8") and not (tmp_path / "page.pdf").exists()


def shown(page, script):
    """What a script at the end of a page finds there."""
    told = "document.body.append(Object.assign(document.createElement('pre'), { id: 'told', textContent: JSON.stringify(await (async () => {%s})()) }));"
    asked = page.with_name("asked.html")
    text = page.read_text(encoding="utf-8")
    asked.write_text(text.replace("</body>", f'<script type="module">{told % script}</script></body>'), encoding="utf-8")
    command = [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={page.parent / 'profile'}", "--virtual-time-budget=1000", "--dump-dom", asked]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    return json.loads(html.unescape(re.search(r'<pre id="told">(.*?)</pre>', done.stdout, re.DOTALL)[1]))


@pytest.mark.skipif(BROWSER is None, reason="no Chromium or Chrome is on PATH")
@pytest.mark.parametrize("code", ["en", "de"])
def test_tables_sort_and_copy(run, stage, tmp_path, code):
    page = written(run, stage, tmp_path / "page.html", "--language", code)
    orders = shown(
        page,
        """
        const table = document.querySelector("table");
        const column = () => [...table.tBodies[0].rows].map((row) => row.cells[4].textContent);
        const head = table.tHead.rows[0].cells[4];
        const found = [[head.getAttribute("aria-sort"), column()]];
        for (const _ of [1, 2, 3]) {
            head.querySelector("button").click();
            found.push([head.getAttribute("aria-sort"), column()]);
        }
        return found;
        """,
    )
    assert [way for way, _ in orders] == ["none", "ascending", "descending", "none"]
    rising = sorted(orders[0][1], key=float)
    assert orders[1][1] == rising and orders[2][1] == rising[::-1] and orders[3][1] == orders[0][1]
    copied = shown(
        page,
        """
        const copied = [];
        Object.defineProperty(navigator, "clipboard", { value: { writeText: async (text) => copied.push(text) } });
        for (const button of document.querySelectorAll("button.copy")) button.click();
        await new Promise((resolve) => setTimeout(resolve, 50));
        return [copied, document.querySelector("[role=status]").textContent];
        """,
    )
    texts, told = copied
    assert told == {"en": "Copied", "de": "Kopiert"}[code]
    grid = [line.split("\t") for line in texts[1].splitlines()]
    # Average, least and greatest with their unit, and an error beside each.
    assert grid[0][4:10] == {"en": ["average, lx", "±", "least, lx", "±", "greatest, lx", "±"], "de": ["Mittel, lx", "±", "kleinster, lx", "±", "größter, lx", "±"]}[code]
    numbers = [float(cell.replace(",", ".")) for cell in grid[1][4:10]]
    assert len(grid) == 2 and numbers[0] > numbers[2] > 0 and numbers[1] > 0
    luminaires = [line.split("\t") for line in texts[0].splitlines()]
    assert len({len(line) for line in luminaires}) == 1 and luminaires[-1][0] in ("in all", "gesamt")
