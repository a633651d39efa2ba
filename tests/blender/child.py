"""Runs one test function in a process with `bpy`: child.py FILE FUNCTION ARGUMENTS."""

import importlib.util
import inspect
import json
import os
import sys
import traceback
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = "gonio_extension"
SKIPPED = 77


def load(name: str, path: Path, folder: Path | None = None):
    """Imports a file under a name; `folder` makes it a package."""
    spec = importlib.util.spec_from_file_location(name, path, submodule_search_locations=[str(folder)] if folder else None)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


def main() -> int:
    file, function, arguments = Path(sys.argv[1]), sys.argv[2], json.loads(sys.argv[3])
    if importlib.util.find_spec("gonio") is None:
        sys.stderr.write(f"the gonio wheel is not installed in {sys.prefix}\n")
        return SKIPPED
    import bpy

    bpy.ops.wm.read_factory_settings()
    addon = Path(os.environ.get("GONIO_ADDON", ROOT / "blender-addon"))
    sys.path[:0] = [str(file.parent), str(ROOT / "tests" / "validate")]
    extension = load(PACKAGE, addon / "__init__.py", addon)
    extension.register()
    try:
        test = getattr(load(file.stem, file), function)
        hints = inspect.signature(test).parameters
        test(**{name: Path(value) if name == "tmp_path" else value for name, value in arguments.items() if name in hints})
    except unittest.SkipTest as reason:
        sys.stderr.write(f"{reason}\n")
        return SKIPPED
    except BaseException:
        traceback.print_exc()
        return 1
    finally:
        # An engine that is still registered can hang Blender at its exit.
        extension.unregister()
    return 0


if __name__ == "__main__":
    status = main()
    sys.stdout.flush()
    sys.exit(status)
