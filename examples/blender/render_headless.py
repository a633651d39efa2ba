"""Renders a .blend with Gonio and prints the illuminance of the picture: `blender -b room.blend -P render_headless.py -- out.exr 64`.

With a Python that has bpy and the extension installed: `python render_headless.py room.blend out.exr 64`.
"""

import sys
from pathlib import Path

import bpy

ADDON = "bl_ext.user_default.gonio"


def enable() -> None:
    """Switches the extension on; a Blender that has it on keeps it."""
    if ADDON not in bpy.context.preferences.addons:
        bpy.ops.preferences.addon_enable(module=ADDON)


def prepare(scene: bpy.types.Scene, samples: int, path: Path) -> None:
    """Chooses Gonio, Cycles' settings of the file, the lux pass and multilayer EXR."""
    scene.render.engine = "GONIO"
    if hasattr(scene, "cycles"):
        bpy.ops.gonio.settings_from_cycles()
    scene.gonio.samples = samples
    for layer in scene.view_layers:
        layer.gonio.use_pass_luminance = layer.gonio.use_pass_illuminance = True
    image = scene.render.image_settings
    if hasattr(image, "media_type"):
        image.media_type = "MULTI_LAYER_IMAGE"
    image.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.filepath = str(path.resolve())


def main() -> None:
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
    if arguments[0].endswith(".blend"):
        bpy.ops.wm.open_mainfile(filepath=arguments.pop(0))
    enable()
    prepare(bpy.context.scene, int(arguments[1]), Path(arguments[0]))
    bpy.ops.render.render(write_still=True)


main()
