"""What a wheel's module is made for and what it takes from the system and from Python, by kind of system."""

import re
from collections.abc import Iterable

import lief
from abi3info import DATAS, FUNCTIONS
from abi3info.models import PyVersion
from signature import flaw

INIT = "PyInit__gonio"
# What every Python from this one on has, under these names.
OLDEST_PYTHON = PyVersion(3, 11)
STABLE = {symbol.name for part in (FUNCTIONS, DATAS) for symbol, what in part.items() if what.added <= OLDEST_PYTHON}
LINUX = {"libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "librt.so.1", "libgcc_s.so.1", "libutil.so.1"}
LINUX_LOADERS = {"ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}
# A symbol's library: whatever is loaded.
DYNAMIC_LOOKUP = 0xFE
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
# What the system may do against attacks: it loads the module anywhere, and executes no data.
PROTECTIONS = [getattr(lief.PE.OptionalHeader.DLL_CHARACTERISTICS, flag) for flag in ("DYNAMIC_BASE", "HIGH_ENTROPY_VA", "NX_COMPAT")]
WINDOWS_SETS = re.compile(r"api-ms-win-[a-z0-9-]+\.dll")


class Broken(Exception):
    """What is wrong with a file."""


def demand(holds: bool, problem: str) -> None:
    if not holds:
        raise Broken(problem)


def check_exports(names: Iterable[str], init: str = INIT) -> None:
    """A module shows what Python calls, and nothing else."""
    exported = set(names)
    demand(init in exported, f"no symbol {init}")
    demand(exported == {init}, f"it exports {len(exported)} symbols, such as {sorted(exported - {init})[:3]}")


def check_python(names: Iterable[str]) -> None:
    """What a module takes from Python must be of the stable interface."""
    taken = set(names)
    demand(bool(taken), "it takes nothing from Python")
    demand(taken <= STABLE, f"it takes from Python what is not of the stable interface: {sorted(taken - STABLE)}")


def check_elf(module: "lief.ELF.Binary", _code: bytes, arm: bool, oldest: tuple[int, int]) -> list[str]:
    """The libraries of a Linux module."""
    machine = lief.ELF.ARCH.AARCH64 if arm else lief.ELF.ARCH.X86_64
    demand(module.header.machine_type == machine, f"it is for {module.header.machine_type}")
    check_exports(s.name for s in module.exported_symbols)
    check_python(s.name for s in module.dynamic_symbols if s.shndx == 0 and re.match(r"_?Py", s.name))
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


def check_mach(module: "lief.MachO.Binary", code: bytes, arm: bool, oldest: tuple[int, int]) -> list[str]:
    """The libraries of a macOS module."""
    mach = lief.MachO
    machine = mach.Header.CPU_TYPE.ARM64 if arm else mach.Header.CPU_TYPE.X86_64
    demand(module.header.cpu_type == machine, f"it is for {module.header.cpu_type}")
    check_exports((s.name for s in module.exported_symbols), f"_{INIT}")
    kind = module.header.file_type
    demand(kind in (mach.Header.FILE_TYPE.DYLIB, mach.Header.FILE_TYPE.BUNDLE), f"it is of type {kind}")
    demand(module.has_code_signature or not arm, "it is not signed, and Apple's processors load nothing without")
    if module.has_code_signature:
        problem = flaw(code, module.code_signature.data_offset)
        demand(problem is None, problem or "")
    demand(module.has_build_version, "it does not say what system it is for")
    demand(module.build_version.platform == mach.BuildVersion.PLATFORMS.MACOS, f"it is for {module.build_version.platform}")
    wanted = tuple(module.build_version.minos[:2])
    demand(wanted <= oldest, f"it wants macOS {wanted[0]}.{wanted[1]}")
    check_undefined(module)
    libraries = [library.name for library in module.libraries if library.command != mach.LoadCommand.TYPE.ID_DYLIB]
    demand(set(libraries) <= APPLE, f"it imports {sorted(set(libraries) - APPLE)}")
    return libraries


def check_undefined(module: "lief.MachO.Binary") -> None:
    """What a macOS module leaves to be found in whatever is loaded is Python's alone; each of the rest names its library."""
    undefined = [s for s in module.symbols if s.category == lief.MachO.Symbol.CATEGORY.UNDEFINED]
    anywhere = {s.name.removeprefix("_") for s in undefined if s.library_ordinal & 0xFF == DYNAMIC_LOOKUP}
    check_python(anywhere)
    named = {s.name for s in undefined if s.library_ordinal & 0xFF != DYNAMIC_LOOKUP and re.match(r"__?Py", s.name)}
    demand(not named, f"it looks in one library alone for {sorted(named)}")


def check_pe(module: "lief.PE.Binary", _code: bytes, arm: bool, _oldest: tuple[int, int]) -> list[str]:
    """The libraries of a Windows module."""
    machine = lief.PE.Header.MACHINE_TYPES.ARM64 if arm else lief.PE.Header.MACHINE_TYPES.AMD64
    demand(module.header.machine == machine, f"it is for {module.header.machine}")
    check_exports(entry.name for entry in module.get_export().entries)
    libraries = [library.name.lower() for library in module.imports]
    others = [name for name in libraries if name not in WINDOWS and not WINDOWS_SETS.fullmatch(name)]
    demand(not others, f"it imports {others}")
    python = [library for library in module.imports if library.name.lower() == "python3.dll"]
    demand(bool(python), "it does not import the stable interface python3.dll")
    check_python(entry.name for library in python for entry in library.entries)
    demand(module.header.has_characteristic(lief.PE.Header.CHARACTERISTICS.DLL), "it is no library")
    missing = [flag.name for flag in PROTECTIONS if not module.optional_header.has(flag)]
    demand(not missing, f"it lacks {missing}")
    return libraries
