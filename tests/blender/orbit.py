"""A scene of 280,000 triangles and a viewport that goes round it. Used inside the child process."""

import math
import time
from dataclasses import dataclass

import bpy
from mathutils import Matrix, Vector
from scenes import diffuse, empty
from viewport import Viewport

# From one picture to the next, radians.
STEP = math.radians(1.0)
# Levels of subdivision that give a head 62,976 triangles.
LEVELS = 3
COLOURS = ((0.6, 0.2, 0.1), (0.2, 0.5, 0.2), (0.2, 0.3, 0.7), (0.7, 0.6, 0.2))


def heads():
    """Four heads on a floor, 280,704 triangles in all, under an area light, a point light and a dim sky."""
    scene = empty()
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.05, 0.06, 0.08, 1)
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=120, y_subdivisions=120, size=12.0)
    bpy.context.object.data.materials.append(diffuse("Floor", (0.5, 0.5, 0.5)))
    for number, colour in enumerate(COLOURS):
        bpy.ops.mesh.primitive_monkey_add(location=(2.0 * (number % 2) - 1.0, 2.0 * (number // 2) - 1.0, 1.0), size=1.5)
        head = bpy.context.object
        modifier = head.modifiers.new("Subdivision", "SUBSURF")
        modifier.levels = modifier.render_levels = LEVELS
        bpy.ops.object.modifier_apply(modifier=modifier.name)
        bpy.ops.object.shade_smooth()
        head.data.materials.append(diffuse(f"Head {number}", colour))
    bpy.ops.object.light_add(type="AREA", location=(3.0, -2.0, 5.0), rotation=(0.5, 0.5, 0.0))
    bpy.context.object.data.energy, bpy.context.object.data.size = 600.0, 2.0
    bpy.ops.object.light_add(type="POINT", location=(-3.0, -3.0, 2.5))
    bpy.context.object.data.energy = 200.0
    return scene


def triangles() -> int:
    """Triangles of all objects."""
    meshes = [each.data for each in bpy.context.scene.objects if each.type == "MESH"]
    for mesh in meshes:
        mesh.calc_loop_triangles()
    return sum(len(mesh.loop_triangles) for mesh in meshes)


def pose(angle: float) -> Matrix:
    """Where the view stands after an angle of the way round, looking at the middle."""
    at = Vector((8.0 * math.sin(angle), -8.0 * math.cos(angle), 4.0))
    return Matrix.Translation(at) @ (Vector((0.0, 0.0, 0.8)) - at).to_track_quat("-Z", "Y").to_matrix().to_4x4()


@dataclass(frozen=True)
class Pace:
    """What an orbit was like."""

    updates_a_second: float
    # From a view to the picture of it, seconds, one for each picture.
    latencies: tuple[float, ...]
    # Columns of each picture.
    widths: tuple[int, ...]


class _Dated:
    """A render that notes how old its view is when its picture is taken."""

    def __init__(self, render, seen: float, ages: list[float]) -> None:
        self._render, self._seen, self._ages = render, seen, ages

    def __getattr__(self, name):
        return getattr(self._render, name)

    def film(self):
        self._ages.append(time.perf_counter() - self._seen)
        return self._render.film()


class Orbit(Viewport):
    """A viewport whose view never rests."""

    def __init__(self) -> None:
        self._angle, self._seen, self._ages = 0.0, 0.0, []
        super().__init__(pose(0.0))

    def _start(self, scene, previous):
        render = super()._start(scene, previous._render if previous is not None else None)
        return _Dated(render, self._seen, self._ages)

    def step(self):
        """Turns the view a little and draws it; gives the picture."""
        self._angle += STEP
        self._seen = time.perf_counter()
        self.region.view_matrix = pose(self._angle).inverted()
        return self.draw()

    def go(self, seconds: float) -> Pace:
        """Turns for some seconds."""
        self._ages.clear()
        widths, number = [], self.session.picture.number if self.session.picture else -1
        start = time.perf_counter()
        while time.perf_counter() - start < seconds:
            picture = self.step()
            if picture is not None and picture.number != number:
                number = picture.number
                widths.append(picture.width)
        taken = time.perf_counter() - start
        return Pace(len(widths) / taken, tuple(self._ages), tuple(widths))
