"""How long after an edit the viewport's first picture comes, and what that time goes to.

Blender evaluates the edited scene first, which takes as long with any engine; that is printed and not counted.
"""

import itertools
import statistics

import pytest

# From the evaluated edit to the first picture, in seconds.
LONGEST = 0.15
TRIES = 9


def prepared():
    """An empty file under an even sky."""
    import bpy
    from scenes import empty

    scene = empty()
    scene.gonio.preview_samples = 1
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)
    return bpy.data, scene


def measured(what, edit, *, height=3.0):
    """The median seconds from Blender's evaluation of an edit, which gets a number that counts up, to the first picture that shows it."""
    from mathutils import Matrix
    from viewport import Viewport

    view = Viewport(Matrix.Translation((0, 0, height)))
    view.draw()
    view.finish()
    numbers = itertools.count(1)
    tries = []
    for _ in range(TRIES):
        tries.append(view.first_picture_after(lambda: edit(next(numbers))))
        # Later stages would share the processor with the next edit.
        view.finish()
    view.close()
    names = ("depsgraph", "export", "scene", "compile", "picture")
    parts = {name: statistics.median(times.get(name, 0.0) for _, times in tries) for name in names}
    whole = statistics.median(whole for whole, _ in tries)
    print(f"{what}: {whole * 1e3:.0f} ms; " + ", ".join(f"{name} {taken * 1e3:.1f}" for name, taken in parts.items()))
    return statistics.median(whole - times["depsgraph"] for whole, times in tries)


def quarter_million(data):
    """An object of 281,250 triangles."""
    import bpy

    bpy.ops.mesh.primitive_grid_add(x_subdivisions=375, y_subdivisions=375)
    bpy.ops.object.shade_smooth()
    return bpy.context.object


def unit(data):
    """A small square mesh."""
    mesh = data.meshes.new("Unit")
    mesh.from_pydata([(0, 0, 0), (0.5, 0, 0), (0.5, 0.5, 0), (0, 0.5, 0)], [], [(0, 1, 2, 3)])
    return mesh


@pytest.mark.validate
@pytest.mark.blender(seconds=900)
def test_edits_of_280_thousand_triangles():
    from scenes import diffuse

    data, _ = prepared()
    thing = quarter_million(data)
    material = diffuse("Surface", (0.5, 0.5, 0.5))
    thing.data.materials.append(material)
    colour = material.node_tree.nodes["Diffuse BSDF"].inputs["Color"]

    def move(number):
        thing.location.x = 0.01 * number

    def paint(number):
        colour.default_value = (0.05 * number, 0.5, 0.5, 1.0)

    def bend(number):
        thing.data.vertices[0].co.z = 0.01 * number
        thing.data.update()

    taken = [measured(f"280,000 triangles, {edit.__name__}", edit) for edit in (move, paint, bend)]
    assert max(taken) < LONGEST


@pytest.mark.validate
@pytest.mark.blender(seconds=900)
def test_moving_one_of_20_thousand_instances():
    from recorder import scattered

    data, scene = prepared()
    scattered(unit(data))
    other = data.objects.new("Other", unit(data))
    scene.collection.objects.link(other)

    def move(number):
        other.location = (0.1 * number, 0, 1)

    assert measured("20,164 instances of one group", move, height=200.0) < LONGEST


@pytest.mark.validate
@pytest.mark.blender(seconds=900)
def test_moving_one_of_20_thousand_objects():
    data, scene = prepared()
    mesh = unit(data)
    for number in range(20_000):
        thing = data.objects.new(f"Thing {number}", mesh)
        thing.location = (number % 142 - 71, number // 142 - 71, 0)
        scene.collection.objects.link(thing)

    def move(number):
        thing.location.z = 0.01 * number

    assert measured("20,000 objects", move, height=200.0) < LONGEST
