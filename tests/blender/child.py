"""Runs test functions in a process with `bpy`, one after the other.

A line of the input asks for one: `[FILE, FUNCTION, ARGUMENTS]` in JSON. A line of the output answers: whether it passed, was skipped or failed,
and why. What is said meanwhile, by Blender too, goes to the standard error.
"""

import gc
import importlib.util
import inspect
import json
import os
import sys
import traceback
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TESTS = ROOT / "tests"
ADDON = Path(os.environ.get("GONIO_ADDON", ROOT / "blender-addon"))
PACKAGE = "gonio_extension"


def load(name: str, path: Path, folder: Path | None = None):
    """Imports a file under a name; `folder` makes it a package."""
    spec = importlib.util.spec_from_file_location(name, path, submodule_search_locations=[str(folder)] if folder else None)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


def forget() -> None:
    """Drops the modules of the extension and of the tests with all they hold, so that nothing a test has left reaches the next one."""
    for name, module in list(sys.modules.items()):
        path = Path(getattr(module, "__file__", None) or "/")
        if name != "__main__" and (path.is_relative_to(ADDON) or path.is_relative_to(TESTS)):
            del sys.modules[name]
    gc.collect()


def run(file: Path, function: str, arguments: dict) -> tuple[str, str]:
    """Runs a function in the factory's file with the extension loaded anew; how it ended, and why."""
    import bpy

    forget()
    bpy.ops.wm.read_factory_settings()
    extension = load(PACKAGE, ADDON / "__init__.py", ADDON)
    extension.register()
    try:
        test = getattr(load(file.stem, file), function)
        hints = inspect.signature(test).parameters
        test(**{name: Path(value) if name == "tmp_path" else value for name, value in arguments.items() if name in hints})
    except unittest.SkipTest as reason:
        return "skipped", str(reason)
    except BaseException as error:
        traceback.print_exc()
        return "failed", "".join(traceback.format_exception_only(error))
    finally:
        # An engine that is still registered can hang Blender at its exit.
        extension.unregister()
    return "passed", ""


def main() -> int:
    # Blender prints where it likes: the answers have the standard output to themselves.
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    status = 0
    paths = sys.path.copy()
    for line in sys.stdin:
        file, function, arguments = json.loads(line)
        sys.path[:] = [str(Path(file).parent), str(TESTS / "validate"), str(TESTS / "shared"), *paths]
        if importlib.util.find_spec("gonio") is None:
            ended = "skipped", f"the gonio wheel is not installed in {sys.prefix}"
        else:
            ended = run(Path(file), function, arguments)
        sys.stdout.flush()
        status = status or int(ended[0] == "failed")
        print(json.dumps(ended), file=answers, flush=True)
    return status


if __name__ == "__main__":
    ended = main()
    sys.stdout.flush()
    sys.stderr.flush()
    # Blender 4.5 can wait for ever for a thread of its own that closes files late.
    os._exit(ended)
