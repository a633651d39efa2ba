"""What is in wheels and extension zips: symbols, libraries, sizes and manifests, for every system.

    python contents.py dist/wheels/*.whl dist/*.zip

Prints a line a file and ends with 1 where something is not as it should be. Needs LIEF (`pip install lief`).
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

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "blender-addon"))
from build import platform_of

INIT = "PyInit__gonio"
# Megabytes of the module, unpacked: the levels of x86 are three more than ARM's one.
SIZES = {"x86_64": (4, 60), "arm64": (2, 40)}

LINUX = {"libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "librt.so.1", "libgcc_s.so.1", "libutil.so.1"}
LINUX_LOADERS = {"ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}
APPLE = {"/usr/lib/libSystem.B.dylib", "/usr/lib/libiconv.2.dylib", "/usr/lib/libcharset.1.dylib"}
WINDOWS = {
    f"{name}.dll"
    for name in [
        "python3",
        "kernel32",
        "kernelbase",
        "ntdll",
        "msvcrt",
        "ucrtbase",
        "vcruntime140",
        "vcruntime140_1",
        "bcryptprimitives",
        "bcrypt",
        "advapi32",
        "userenv",
        "ws2_32",
        "ole32",
        "shell32",
        "user32",
        "dbghelp",
    ]
}
WINDOWS_SETS = re.compile(r"api-ms-win-[a-z0-9-]+\.dll")


class Broken(Exception):
    """What is wrong with a file."""


def demand(holds: bool, problem: str) -> None:
    if not holds:
        raise Broken(problem)


def oldest_system(name: str) -> tuple[int, int]:
    """The C library or the system that a wheel's name promises to do with; one of this machine alone promises nothing."""
    found = re.search(r"-(?:manylinux|macosx)_(\d+)_(\d+)_", name)
    return (int(found[1]), int(found[2])) if found else (99, 0)


def check_elf(module: "lief.ELF.Binary", arm: bool, oldest: tuple[int, int]) -> list[str]:
    """The libraries of a Linux module."""
    machine = lief.ELF.ARCH.AARCH64 if arm else lief.ELF.ARCH.X86_64
    demand(module.header.machine_type == machine, f"it is for {module.header.machine_type}")
    demand(INIT in {s.name for s in module.exported_symbols}, f"no symbol {INIT}")
    newest = (0, 0)
    for need in module.symbols_version_requirement:
        for version in need.get_auxiliary_symbols():
            if found := re.fullmatch(r"GLIBC_(\d+)\.(\d+)(\.\d+)?", version.name):
                newest = max(newest, (int(found[1]), int(found[2])))
    demand(newest <= oldest, f"it wants glibc {newest[0]}.{newest[1]}")
    stack = [s for s in module.segments if s.type == lief.ELF.Segment.TYPE.GNU_STACK]
    demand(all(lief.ELF.Segment.FLAGS.X not in lief.ELF.Segment.FLAGS(s.flags) for s in stack), "its stack may be executed")
    libraries = list(module.libraries)
    demand(set(libraries) <= LINUX | LINUX_LOADERS, f"it imports {sorted(set(libraries) - LINUX - LINUX_LOADERS)}")
    return libraries


def check_mach(module: "lief.MachO.Binary", arm: bool, oldest: tuple[int, int]) -> list[str]:
    """The libraries of a macOS module."""
    machine = lief.MachO.Header.CPU_TYPE.ARM64 if arm else lief.MachO.Header.CPU_TYPE.X86_64
    demand(module.header.cpu_type == machine, f"it is for {module.header.cpu_type}")
    demand(f"_{INIT}" in {s.name for s in module.exported_symbols}, f"no symbol {INIT}")
    demand(module.has_code_signature or not arm, "it is not signed, and Apple's processors load nothing without")
    wanted = tuple(module.build_version.minos[:2]) if module.has_build_version else (0, 0)
    demand(wanted <= oldest, f"it wants macOS {wanted[0]}.{wanted[1]}")
    libraries = [library.name for library in module.libraries if library.command != lief.MachO.LoadCommand.TYPE.ID_DYLIB]
    demand(set(libraries) <= APPLE, f"it imports {sorted(set(libraries) - APPLE)}")
    return libraries


def check_pe(module: "lief.PE.Binary", arm: bool, _oldest: tuple[int, int]) -> list[str]:
    """The libraries of a Windows module."""
    machine = lief.PE.Header.MACHINE_TYPES.ARM64 if arm else lief.PE.Header.MACHINE_TYPES.AMD64
    demand(module.header.machine == machine, f"it is for {module.header.machine}")
    demand(INIT in {entry.name for entry in module.get_export().entries}, f"no symbol {INIT}")
    libraries = [library.name.lower() for library in module.imports]
    others = [name for name in libraries if name not in WINDOWS and not WINDOWS_SETS.fullmatch(name)]
    demand(not others, f"it imports {others}")
    demand("python3.dll" in libraries, "it does not import the stable interface python3.dll")
    return libraries


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
    libraries = check(parsed, processor == "arm64", oldest_system(name))
    smallest, largest = SIZES["arm64" if processor == "arm64" else "x86_64"]
    megabytes = len(code) / 1e6
    demand(smallest <= megabytes <= largest, f"its module has {megabytes:.1f} MB")
    return f"{platform}: wheel {len(content) / 1e6:.1f} MB, module {megabytes:.1f} MB, imports {', '.join(sorted(libraries))}"


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
