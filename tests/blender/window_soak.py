"""Random edits in a real window, with the rendered viewport on: blender --python window_soak.py -- STEPS SEED LOG [ENGINE].

Needs the extension installed. One step every third of a second: edits, undo, mode switches, final renders, playback, resizing, several viewports.
Another engine shows how much memory Blender itself takes for the same steps. The log gets a line a step, with the process's memory in MB, and at the end PASS or what went wrong; Blender quits then.
"""

import os
import random
import sys
import traceback
from statistics import median

import bpy
from mathutils import Euler, Quaternion

STEPS, SEED, LOG, ENGINE = (*sys.argv[sys.argv.index("--") + 1 :], "GONIO")[:4]
STEPS, SEED = int(STEPS), int(SEED)
ADDON = "bl_ext.user_default.gonio"
# The scene stays as large as it is early on.
MOST_MESHES = 5
# Steps whose memory is compared, then and at the end.
SPAN = 40
chance = random.Random(SEED)
log = open(LOG, "w", encoding="utf-8", buffering=1)  # noqa: SIM115
state = {"step": -1, "sizes": [], "rendering": False}


def memory() -> float:
    """Resident memory in MB."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


def window():
    return bpy.context.window_manager.windows[0]


def views():
    """The 3D viewports of the window."""
    return [area for area in window().screen.areas if area.type == "VIEW_3D"]


def inside(area):
    """The context of a viewport."""
    region = next(region for region in area.regions if region.type == "WINDOW")
    return bpy.context.temp_override(window=window(), area=area, region=region)


def meshes():
    return [each for each in window().view_layer.objects if each.type == "MESH"]


def orbit():
    for area in views():
        area.spaces.active.region_3d.view_rotation @= Quaternion((0, 0, 1), chance.uniform(-0.5, 0.5))


def move():
    if meshes():
        each = chance.choice(meshes())
        each.location = [chance.uniform(-3, 3) for _ in range(3)]
        each.rotation_euler = Euler([chance.uniform(-3, 3) for _ in range(3)])


def add():
    if len(meshes()) > MOST_MESHES:
        delete()
        return
    with inside(views()[0]):
        kind = chance.choice(("cube", "uv_sphere", "monkey", "ico_sphere"))
        getattr(bpy.ops.mesh, f"primitive_{kind}_add")(location=[chance.uniform(-3, 3) for _ in range(3)])


def delete():
    if len(meshes()) > 3:
        bpy.data.meshes.remove(chance.choice(meshes()).data)
        window().view_layer.update()


def material():
    if not bpy.data.materials:
        bpy.data.materials.new("Material").use_nodes = True
    one = chance.choice(bpy.data.materials)
    shader = next((node for node in one.node_tree.nodes if node.type == "BSDF_PRINCIPLED"), None)
    if shader is not None:
        shader.inputs["Base Color"].default_value = [chance.random() for _ in range(3)] + [1.0]
        shader.inputs["Roughness"].default_value = chance.random()
        shader.inputs["Metallic"].default_value = chance.choice((0.0, 1.0))
    for each in meshes():
        if not each.data.materials:
            each.data.materials.append(one)


def unknown_node():
    for one in bpy.data.materials:
        if one.node_tree is not None and len(one.node_tree.nodes) < 20:
            one.node_tree.nodes.new(chance.choice(("ShaderNodeTexNoise", "ShaderNodeTexGabor", "ShaderNodeMath")))


def lamp():
    for each in bpy.data.lights:
        each.energy = chance.uniform(10, 2000)
        each.color = [chance.random() for _ in range(3)]


def world():
    tree = window().scene.world.node_tree
    tree.nodes["Background"].inputs["Color"].default_value = [chance.random() for _ in range(3)] + [1.0]


def undo():
    with inside(views()[0]):
        if bpy.ops.ed.undo.poll():
            bpy.ops.ed.undo()


def redo():
    with inside(views()[0]):
        if bpy.ops.ed.redo.poll():
            bpy.ops.ed.redo()


def push():
    with inside(views()[0]):
        bpy.ops.ed.undo_push(message="soak")


def shading():
    views()[0].spaces.active.shading.type = chance.choice(("SOLID", "WIREFRAME", "RENDERED"))


def edit_mode():
    if meshes():
        window().view_layer.objects.active = chance.choice(meshes())
        with inside(views()[0]):
            bpy.ops.object.mode_set(mode="EDIT")
            bpy.ops.mesh.select_all(action="SELECT")
            bpy.ops.transform.resize(value=(chance.uniform(0.7, 1.4),) * 3)
            bpy.ops.object.mode_set(mode="OBJECT")


def sidebar():
    space = views()[0].spaces.active
    space.show_region_ui = not space.show_region_ui


def quad():
    """Four viewports in one, each with a session of its own. (Blender itself crashes on undo after areas are split and closed by scripts.)"""
    with inside(views()[0]):
        bpy.ops.screen.region_quadview()


def border():
    space = views()[0].spaces.active
    space.use_render_border = not space.use_render_border
    space.render_border_min_x, space.render_border_max_x = 0.2, 0.7
    space.render_border_min_y, space.render_border_max_y = 0.3, 0.9


def camera_view():
    region = views()[0].spaces.active.region_3d
    region.view_perspective = chance.choice(("CAMERA", "PERSP", "ORTHO"))


def play():
    scene = window().scene
    scene.frame_set(scene.frame_current % 50 + 1)


def settings():
    own = window().scene.gonio
    own.max_bounces = chance.randint(0, 12)
    own.film_exposure = chance.choice((0.5, 1.0))
    window().scene.render.film_transparent = chance.random() < 0.2


def final():
    render = window().scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = 320, 180, 100
    window().scene.gonio.samples = 4
    with bpy.context.temp_override(window=window()):
        bpy.ops.render.render(chance.choice(("INVOKE_DEFAULT", "EXEC_DEFAULT")))


ACTIONS = (orbit, orbit, move, move, add, delete, material, material, unknown_node, lamp, world, undo, undo, redo, shading, edit_mode)
ACTIONS += (sidebar, quad, quad, border, camera_view, play, settings, final)
# Each of the first steps does everything, so that the caches of Blender and of the driver are full after them.
WARM = 20


def act(action):
    log.write(f"{state['step']} {action.__name__} ")
    log.flush()
    try:
        action()
        # As after any operator: Blender's undo takes edits for granted that it was not told of.
        if action not in (undo, redo):
            push()
    except Exception:
        log.write(f"FAILED\n{traceback.format_exc()}\n")


def step() -> float | None:
    if bpy.app.is_job_running("RENDER"):
        return 0.2
    state["step"] += 1
    if state["step"] >= STEPS:
        return finish()
    # Undo leads back to the engine that the file had first.
    window().scene.render.engine = ENGINE
    warm = state["step"] < WARM
    actions = chance.sample(ACTIONS, len(ACTIONS)) if warm else [chance.choice(ACTIONS)]
    if state["step"] % 10 == 0:
        for area in views():
            area.spaces.active.shading.type = "RENDERED"
    for action in actions:
        act(action)
        if warm:
            bpy.ops.wm.redraw_timer(type="DRAW_WIN_SWAP", iterations=1)
    # Four viewports hold four pictures: steps with one are compared with one another.
    if not views()[0].spaces.active.region_quadviews:
        state["sizes"].append((state["step"], memory()))
    log.write(f"{memory():.0f} MB, {len(meshes())} meshes\n")
    return 0.33


def finish() -> None:
    early = [size for number, size in state["sizes"] if WARM <= number < WARM + SPAN]
    late = [size for number, size in state["sizes"] if number >= STEPS - SPAN]
    log.write(f"memory after {WARM} steps {median(early):.0f} MB, at the end {median(late):.0f} MB\nPASS\n")
    bpy.ops.wm.quit_blender()


def start() -> float | None:
    bpy.ops.preferences.addon_enable(module=ADDON)
    bpy.context.preferences.view.show_splash = False
    # Blender's own undo steps grow by copies of meshes; they are not what is looked at.
    bpy.context.preferences.edit.undo_steps = 8
    scene = window().scene
    scene.render.engine = ENGINE
    push()
    for area in views():
        area.spaces.active.shading.type = "RENDERED"
    bpy.app.timers.register(step, first_interval=1.0, persistent=True)
    return None


bpy.app.timers.register(start, first_interval=2.0, persistent=True)
