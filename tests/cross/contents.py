"""What is in wheels and extension zips: symbols, libraries, sizes and manifests, for every system.

    python contents.py dist/wheels/*.whl dist/*.zip

Prints a line a file and ends with 1 where something is not as it should be. Needs LIEF and abi3info (`pip install lief abi3info`).
"""

import argparse
import base64
import csv
import hashlib
import io
import re
import sys
import tomllib
import zipfile
from pathlib import Path

import lief
from modules import Broken, check_elf, check_mach, check_pe, demand

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "blender-addon"))
from build import platform_of

# Megabytes of the module, unpacked: the levels of x86 are three more than ARM's one.
SIZES = {"x86_64": (4, 60), "arm64": (2, 40)}


def oldest_system(name: str) -> tuple[int, int]:
    """The C library or the system that a wheel's name promises to do with; one of this machine alone promises nothing."""
    found = re.search(r"-(?:manylinux|macosx)_(\d+)_(\d+)_", name)
    return (int(found[1]), int(found[2])) if found else (99, 0)


def check_record(wheel: zipfile.ZipFile) -> None:
    """Every file is listed with its digest."""
    names = [name for name in wheel.namelist() if not name.endswith("/")]
    record = next(name for name in names if name.endswith(".dist-info/RECORD"))
    listed = {row[0]: row[1] for row in csv.reader(io.StringIO(wheel.read(record).decode())) if row}
    demand(set(listed) == set(names), f"RECORD and content differ in {sorted(set(listed) ^ set(names))}")
    for name in names:
        if name != record:
            digest = base64.urlsafe_b64encode(hashlib.sha256(wheel.read(name)).digest()).rstrip(b"=").decode()
            demand(listed[name] == f"sha256={digest}", f"{name} is not what RECORD says")


def check_wheel(content: bytes, name: str) -> str:
    """A line about a wheel."""
    platform = platform_of(Path(name))
    system, processor = platform.split("-")
    demand("-cp311-abi3-" in name, "it is not built for the stable interface of Python 3.11")
    with zipfile.ZipFile(io.BytesIO(content)) as wheel:
        check_record(wheel)
        names = wheel.namelist()
        for part in ("gonio/__init__.py", "gonio/py.typed", "gonio/_gonio.pyi", "gonio/cli.py"):
            demand(part in names, f"{part} is missing")
        demand(sum("/licenses/" in part for part in names) >= 4, "licences are missing")
        modules = [part for part in names if re.fullmatch(r"gonio/_gonio\.[^/]*(so|pyd)", part)]
        demand(modules == ["gonio/_gonio.pyd" if system == "windows" else "gonio/_gonio.abi3.so"], f"its modules are {modules}")
        code = wheel.read(modules[0])
    parsed = lief.parse(io.BytesIO(code))
    check = {"linux": check_elf, "macos": check_mach, "windows": check_pe}[system]
    kind = {"linux": lief.ELF.Binary, "macos": lief.MachO.Binary, "windows": lief.PE.Binary}[system]
    demand(isinstance(parsed, kind), f"its module is {type(parsed).__name__}")
    libraries = check(parsed, code, processor == "arm64", oldest_system(name))
    smallest, largest = SIZES["arm64" if processor == "arm64" else "x86_64"]
    megabytes = len(code) / 1e6
    demand(smallest <= megabytes <= largest, f"its module has {megabytes:.1f} MB")
    return f"{platform}: wheel {len(content) / 1e6:.1f} MB, module {megabytes:.1f} MB, imports {', '.join(sorted(set(libraries)))}"


def check_extension(path: Path) -> str:
    """A line about an extension zip."""
    with zipfile.ZipFile(path) as packed:
        names = packed.namelist()
        demand("blender_manifest.toml" in names, "blender_manifest.toml is missing")
        manifest = tomllib.loads(packed.read("blender_manifest.toml").decode())
        wheels = manifest["wheels"]
        demand(len(wheels) == 1, f"its manifest names {len(wheels)} wheels")
        inside = wheels[0].removeprefix("./")
        demand(inside in names, f"{inside} is missing")
        wheel = Path(inside).name
        demand(manifest["platforms"] == [platform_of(Path(wheel))], f"its platforms are {manifest['platforms']}, its wheel is {wheel}")
        demand(manifest["version"] == wheel.split("-")[1], f"its version is {manifest['version']}, its wheel is {wheel}")
        demand(path.name == f"gonio-{manifest['version']}-{manifest['platforms'][0]}.zip", "its name is not that of its platform")
        strays = [name for name in names if "__pycache__" in name or name.endswith((".pyc", "/build.py")) or name == "build.py"]
        demand(not strays, f"it holds {strays}")
        demand("__init__.py" in names, "__init__.py is missing")
        return f"extension of {len(names)} files, {path.stat().st_size / 1e6:.1f} MB; " + check_wheel(packed.read(inside), wheel)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", type=Path)
    broken = 0
    for path in parser.parse_args().files:
        try:
            line = check_extension(path) if path.suffix == ".zip" else check_wheel(path.read_bytes(), path.name)
        except Broken as problem:
            broken, line = broken + 1, f"BROKEN: {problem}"
        print(f"{path.name}: {line}")
    raise SystemExit(1 if broken else 0)


if __name__ == "__main__":
    main()
