"""Renders every stage below a folder small, onto pages of thumbnails with their names. Needs Pillow.

    python tests/validate/stages/contact_sheet.py ../shared/data/usd --out out/contact
"""

import argparse
import pathlib
import subprocess
import sys

from PIL import Image, ImageDraw

COLUMNS, ROWS = 6, 6
WIDTH, HEIGHT, CAPTION = 240, 150, 34
ENDINGS = {".usd", ".usda", ".usdc", ".usdz"}


def rendered(stage, picture, samples):
    """Renders a stage; gives the last line that tells of a problem, or nothing."""
    line = [sys.executable, "-m", "gonio.cli", "render", stage, "-o", picture, "--res", WIDTH, HEIGHT, "--spp", samples, "--time-limit", 30]
    try:
        done = subprocess.run([str(word) for word in line], capture_output=True, text=True, errors="replace", timeout=180)
    except subprocess.TimeoutExpired:
        return "takes longer than three minutes"
    told = [line.removeprefix("gonio: ") for line in done.stderr.splitlines() if "error: " in line or "warning: " in line]
    return told[0] if told else ""


def page(entries, path):
    """Draws thumbnails with names and messages."""
    sheet = Image.new("RGB", (COLUMNS * WIDTH, ROWS * (HEIGHT + CAPTION)), "white")
    draw = ImageDraw.Draw(sheet)
    for number, (name, picture, told) in enumerate(entries):
        x, y = number % COLUMNS * WIDTH, number // COLUMNS * (HEIGHT + CAPTION)
        if picture.exists():
            sheet.paste(Image.open(picture).convert("RGB"), (x, y))
        draw.text((x + 2, y + HEIGHT), name[-39:], fill="black")
        draw.text((x + 2, y + HEIGHT + 14), told[:39], fill="firebrick")
    sheet.save(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/contact"))
    parser.add_argument("--spp", type=int, default=16)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    stages = sorted(path for path in options.folder.rglob("*") if path.suffix.lower() in ENDINGS)
    entries = []
    for number, stage in enumerate(stages):
        picture = options.out / f"{number:03}.png"
        told = rendered(stage, picture, options.spp)
        entries.append((str(stage.relative_to(options.folder)), picture, told))
        print(f"{number + 1}/{len(stages)} {entries[-1][0]}: {told}", flush=True)
    size = COLUMNS * ROWS
    for first in range(0, len(entries), size):
        page(entries[first : first + size], options.out / f"page_{first // size + 1}.png")


if __name__ == "__main__":
    main()
