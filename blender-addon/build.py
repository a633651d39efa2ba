# SPDX-License-Identifier: GPL-3.0-or-later
"""Packs the extension: one zip a platform, with that platform's wheel inside.

    python build.py gonio-0.1.0-cp311-abi3-manylinux_2_28_x86_64.whl ... --output-dir dist

Blender's own extension tool validates and packs when there is a `bpy` package in this Python (`pip install bpy`) or `--tool` names it;
without it the zip is written here, with the same content.
"""

import argparse
import importlib.util
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parent
LEFT_OUT = shutil.ignore_patterns("__pycache__", "*.pyc", "wheels", "build.py", ".*")
# What the end of a wheel's name says, and Blender's word for it.
PLATFORMS = (
    ("linux_x86_64", "linux-x64"),
    ("manylinux.*_x86_64", "linux-x64"),
    ("manylinux.*_aarch64", "linux-arm64"),
    ("win_amd64", "windows-x64"),
    ("win_arm64", "windows-arm64"),
    ("macosx.*_arm64", "macos-arm64"),
    ("macosx.*_x86_64", "macos-x64"),
)


def platform_of(wheel: Path) -> str:
    """Blender's name of the platform that a wheel is for."""
    tag = wheel.stem.split("-")[-1]
    for pattern, platform in PLATFORMS:
        if re.fullmatch(pattern, tag):
            return platform
    raise SystemExit(f"{wheel.name}: the platform '{tag}' is none that Blender knows")


def blender_tool() -> Path | None:
    """Blender's extension tool in this Python's `bpy` package."""
    package = importlib.util.find_spec("bpy")
    if package is None or package.origin is None:
        return None
    return next(Path(package.origin).parent.glob("*/scripts/addons_core/bl_pkg/cli/blender_ext.py"), None)


def stage(wheel: Path, platform: str, folder: Path) -> None:
    """Copies the extension with one wheel; the manifest gets the wheel, its version and its platform."""
    shutil.copytree(SOURCE, folder, ignore=LEFT_OUT)
    (folder / "wheels").mkdir()
    shutil.copy2(wheel, folder / "wheels")
    manifest = folder / "blender_manifest.toml"
    text = manifest.read_text(encoding="utf-8")
    for pattern, line in (
        (r"^version = .*$", f'version = "{version_of(wheel)}"'),
        (r"^platforms = .*$", f'platforms = ["{platform}"]'),
        (r"^# `build\.py` .*\nwheels = .*$", f'wheels = ["./wheels/{wheel.name}"]'),
    ):
        text, count = re.subn(pattern, line, text, flags=re.MULTILINE)
        if count != 1:
            raise SystemExit(f"{manifest.name}: expected one line like '{pattern}', found {count}")
    manifest.write_text(text, encoding="utf-8")


def version_of(wheel: Path) -> str:
    """The version in a wheel's name."""
    return wheel.name.split("-")[1]


def pack(folder: Path, archive: Path, tool: Path | None) -> None:
    """Writes the zip."""
    archive.parent.mkdir(parents=True, exist_ok=True)
    if tool is None:
        with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as packed:
            for path in sorted(folder.rglob("*")):
                packed.write(path, path.relative_to(folder))
        return
    run = [sys.executable, str(tool)]
    subprocess.run([*run, "validate", str(folder)], check=True)
    subprocess.run([*run, "build", "--source-dir", str(folder), "--output-filepath", str(archive)], check=True)
    subprocess.run([*run, "validate", str(archive)], check=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("wheels", nargs="+", type=Path, metavar="WHEEL")
    parser.add_argument("--output-dir", type=Path, default=Path("dist"))
    parser.add_argument("--tool", type=Path, help="Blender's blender_ext.py")
    arguments = parser.parse_args()
    for wheel in arguments.wheels:
        platform = platform_of(wheel)
        archive = arguments.output_dir.resolve() / f"gonio-{version_of(wheel)}-{platform}.zip"
        with tempfile.TemporaryDirectory() as temporary:
            folder = Path(temporary) / "gonio"
            stage(wheel, platform, folder)
            pack(folder, archive, arguments.tool or blender_tool())
        sys.stdout.write(f"{archive}\n")


if __name__ == "__main__":
    main()
