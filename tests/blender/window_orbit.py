"""Goes round 280,000 triangles in a real window: blender -p 0 0 960 540 --python window_orbit.py -- SECONDS REST LOG [SETTING=VALUE ...].

Needs the extension installed, and the files heads.py and scenes.py beside this one. The viewport fills the window, in direct light; settings of the scene
are set as asked for. After the orbit the view rests for some seconds, in which the picture gets its samples, and Blender quits. The log gets pictures a
second and what they take.
"""

import importlib
import math
import sys
import time
from pathlib import Path
from statistics import median

import bpy
from mathutils import Quaternion

SECONDS, REST, LOG, *CHOSEN = sys.argv[sys.argv.index("--") + 1 :]
SECONDS, REST = float(SECONDS), float(REST)
ADDON = "bl_ext.user_default.gonio"
# Seconds before anything is counted, and between two steps of the view.
WARM, PAUSE = 3.0, 1 / 60
STEP = Quaternion((0.0, 0.0, 1.0), math.radians(1.0))
sys.path.append(str(Path(__file__).parent))
# By number of the picture: when it was drawn first, its columns, and what the drawing took.
drawn, callbacks, turned = {}, [], []


def view():
    """The 3D viewport."""
    return next(area for area in bpy.context.window_manager.windows[0].screen.areas if area.type == "VIEW_3D")


def watch() -> None:
    """Times the engine's drawing and that of its pictures."""
    engine, drawing = (importlib.import_module(f"{ADDON}.{name}") for name in ("engine.render_engine", "draw.viewport"))
    draw, view_draw = drawing.ViewportDrawing.draw, engine.GonioRenderEngine.view_draw

    def timed_draw(self, of, context, scene, picture):
        start = time.perf_counter()
        draw(self, of, context, scene, picture)
        drawn.setdefault(picture.number, (start, picture.width, time.perf_counter() - start))

    def timed_view_draw(self, context, depsgraph):
        start = time.perf_counter()
        view_draw(self, context, depsgraph)
        callbacks.append((start, time.perf_counter() - start))

    drawing.ViewportDrawing.draw, engine.GonioRenderEngine.view_draw = timed_draw, timed_view_draw


def fill(area) -> None:
    """Makes a viewport as large as the window, without what lies over it."""
    region = next(region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0], area=area, region=region):
        bpy.ops.screen.screen_full_area(use_hide_panels=True)
    space = view().spaces.active
    space.overlay.show_overlays = space.show_gizmo = False


def prepare() -> float | None:
    from heads import add_heads

    bpy.ops.preferences.addon_enable(module=ADDON)
    bpy.context.preferences.view.show_splash = False
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    add_heads()
    settings = bpy.context.scene.gonio
    bpy.context.scene.render.engine = "GONIO"
    settings.use_preview_direct_light = True
    for name, _, value in (each.partition("=") for each in CHOSEN):
        kind = type(getattr(settings, name))
        setattr(settings, name, value == "True" if kind is bool else kind(value))
    fill(view())
    space = view().spaces.active
    space.region_3d.view_distance, space.region_3d.view_location = 8.0, (0.0, 0.0, 0.8)
    watch()
    space.shading.type = "RENDERED"
    bpy.app.timers.register(turn, first_interval=WARM)
    return None


def turn() -> float | None:
    now = time.perf_counter()
    turned.append(now)
    if now - turned[0] > WARM + SECONDS:
        report(turned[0] + WARM, now)
        bpy.app.timers.register(leave, first_interval=REST)
        return None
    region = view().spaces.active.region_3d
    region.view_rotation = STEP @ region.view_rotation
    return PAUSE


def leave() -> None:
    bpy.ops.wm.quit_blender()


def report(start: float, end: float) -> None:
    """Writes what was counted between two times."""
    region = next(region for region in view().regions if region.type == "WINDOW")
    shown = [each for each in drawn.values() if start <= each[0] < end]
    took = [seconds for at, seconds in callbacks if start <= at < end]
    with open(LOG, "w", encoding="utf-8") as log:
        log.write(
            f"{len(shown) / (end - start):.1f} updates a second, {median(width for _, width, _ in shown)} of {region.width} columns in the median, "
            f"{region.height} rows; drawing one {median(seconds for *_, seconds in shown) * 1e3:.1f} ms, the engine's callback {median(took) * 1e3:.1f} ms, "
            f"{len(took) / (end - start):.1f} callbacks a second\n"
        )


bpy.app.timers.register(prepare, first_interval=2.0)
