"""Install, enable, render, disable, enable again, render, uninstall: life.py ZIP FOLDER."""

import sys
from pathlib import Path

import bpy
import numpy  # noqa: F401

ADDON = "bl_ext.user_default.gonio"


def render(path: Path) -> None:
    """Renders the default scene to a file with Gonio."""
    scene = bpy.context.scene
    scene.render.engine = "GONIO"
    scene.gonio.samples = 16
    scene.render.resolution_x, scene.render.resolution_y = 160, 120
    scene.render.filepath = str(path)
    assert bpy.ops.render.render(write_still=True) == {"FINISHED"}
    picture = bpy.data.images.load(str(path))
    values = list(picture.pixels)
    assert max(values[::4]) > min(values[::4]), "the picture is flat"
    bpy.data.images.remove(picture)


def main() -> None:
    archive, folder = sys.argv[1], Path(sys.argv[2])
    # A gonio of the environment must not stand in for the zip's.
    sys.path[:] = [path for path in sys.path if not path.endswith("site-packages")]
    bpy.ops.wm.read_factory_settings()
    done = bpy.ops.extensions.package_install_files(filepath=archive, repo="user_default", enable_on_install=True)
    assert done == {"FINISHED"}
    import gonio

    assert str(folder) in gonio.__file__, f"another gonio than the zip's: {gonio.__file__}"
    render(folder / "picture.png")
    bpy.ops.preferences.addon_disable(module=ADDON)
    assert not hasattr(bpy.types.Scene, "gonio")
    bpy.ops.preferences.addon_enable(module=ADDON)
    render(folder / "again.png")
    repository = [repo.module for repo in bpy.context.preferences.extensions.repos].index("user_default")
    bpy.ops.extensions.package_uninstall(repo_index=repository, pkg_id="gonio")
    assert not hasattr(bpy.types.Scene, "gonio")


main()
