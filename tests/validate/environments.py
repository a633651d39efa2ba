"""Virtual environments for the renderers gonio is compared with and the farms it renders on, each in `.venv-<name>` beside the repository's own `.venv`.

`python tests/validate/environments.py [name ...]` makes them ahead of a test run; the tests make what is missing.
"""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
REQUIREMENTS = {
    "bpy50": ["bpy==5.0.*", "numpy"],
    "mitsuba": ["mitsuba>=3.5,<4", "numpy"],
    "luxcore": ["pyluxcore>=2.10,<3", "numpy"],
    "radiance": ["pyradiance>=1.3,<2"],
    "honeybee": ["honeybee-radiance-postprocess>=0.5.25,<0.6", "honeybee-radiance>=1.66,<2"],
    "farm": ["distributed>=2025.1", "openjd-cli>=0.8", "usd-core>=25.5", "numpy"],
}
INSTALL_TIME = 1200


class Unavailable(Exception):
    """The packages cannot be installed here; the message is the end of what pip said."""


def python_of(name: str) -> Path:
    """Path of the Python of environment `name` (a key of `REQUIREMENTS`), made if it is missing; raises `Unavailable`."""
    folder = ROOT / f".venv-{name}"
    python = folder / "bin" / "python"
    ready = folder / "ready"
    wanted = " ".join(REQUIREMENTS[name])
    if ready.is_file() and ready.read_text() == wanted:
        return python
    base = Path(sys.base_prefix) / "bin" / f"python{sys.version_info.major}.{sys.version_info.minor}"
    run([str(base), "-m", "venv", str(folder)])
    run([str(python), "-m", "pip", "install", "--quiet", *REQUIREMENTS[name]])
    ready.write_text(wanted)
    return python


def run(command: list[str]) -> None:
    """Runs one step of an installation; raises `Unavailable` with its last lines when it fails."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=INSTALL_TIME)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise Unavailable(str(error)) from error
    if done.returncode:
        raise Unavailable("\n".join((done.stdout + done.stderr).strip().splitlines()[-3:]))


def main() -> int:
    """Makes the environments named on the command line, or all."""
    for name in sys.argv[1:] or REQUIREMENTS:
        print(name, python_of(name))
    return 0


if __name__ == "__main__":
    sys.exit(main())
