"""The changelog's section of the version that is to be released, as release notes.

    python notes.py [--tag v1.2.3]

Without a tag the section of what is unreleased serves as well. Versions of Cargo.toml, of the extension's manifest and of the tag must agree.
"""

import argparse
import re
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def section(changelog: str, title: str) -> str | None:
    """What stands under a heading like `## [1.2.3] - 2026-01-31`."""
    found = re.search(rf"^## \[{re.escape(title)}\][^\n]*\n(.*?)(?=^## \[|^\[[^\]]+\]: |\Z)", changelog, re.MULTILINE | re.DOTALL)
    return found[1].strip() if found else None


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tag")
    tag = parser.parse_args().tag
    version = tomllib.loads((ROOT / "Cargo.toml").read_text(encoding="utf-8"))["workspace"]["package"]["version"]
    extension = tomllib.loads((ROOT / "blender-addon" / "blender_manifest.toml").read_text(encoding="utf-8"))["version"]
    if extension != version:
        raise SystemExit(f"the extension's manifest has version {extension}, Cargo.toml {version}")
    if tag is not None and tag != f"v{version}":
        raise SystemExit(f"the tag is {tag}, the version {version}")
    changelog = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    notes = section(changelog, version) or (section(changelog, "Unreleased") if tag is None else None)
    if not notes:
        raise SystemExit(f"CHANGELOG.md has no section [{version}]")
    sys.stdout.write(notes + "\n")


if __name__ == "__main__":
    main()
