"""Hair, hair curves and point clouds in scenes, and what strands know, against Cycles."""

import pytest


def curves_of(points, name, cover=None, radius=0.02):
    """A hair curves object through the given points, one array a curve."""
    import bpy
    import numpy as np

    made = bpy.data.hair_curves.new(name)
    made.add_curves([len(each) for each in points])
    flat = np.concatenate(points).astype(np.float32)
    made.position_data.foreach_set("vector", flat.reshape(-1))
    made.attributes.new("radius", "FLOAT", "POINT").data.foreach_set("value", np.full(len(flat), radius, dtype=np.float32))
    if cover is not None:
        made.materials.append(cover)
    thing = bpy.data.objects.new(name, made)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def exported():
    import bpy
    from gonio_extension.export import Exporter
    from gonio_extension.report import Report

    report = Report()
    scene = Exporter(report).sync(bpy.context.evaluated_depsgraph_get()).to_dict()
    return scene, [line.text for line in report.diagnostics]


@pytest.mark.blender
def test_hair_curves_come_as_they_are():
    import bpy
    import numpy as np

    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.cycles_curves.shape = "THICK"
    points = [np.array([(0, 0, 0), (0, 0, 1), (0, 1, 2)]), np.array([(1, 0, 0), (1, 0, 1), (1, 1, 1), (1, 1, 2)]), np.array([(5, 5, 5)])]
    curves_of(points, "Strands")
    scene, told = exported()
    (curves,) = scene["curves"]
    # A single point is no curve.
    assert curves["counts"] == [3, 4] and (curves["basis"], curves["wrap"], curves["shape"]) == ("CatmullRom", "Pinned", "Round")
    assert np.allclose(curves["points"], np.concatenate(points[:2])) and np.allclose(curves["widths"]["values"], 0.04)
    assert scene["instances"][0]["mesh"] == {"curves": 0} and not told


@pytest.mark.blender
def test_particle_hair_stands_on_its_emitter():
    import bpy
    import numpy as np

    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.mesh.primitive_uv_sphere_add(radius=1.0, location=(1, 2, 3))
    ball = bpy.context.object
    for name in ("Skin", "Fur"):
        ball.data.materials.append(bpy.data.materials.new(name))
    ball.modifiers.new("Fur", "PARTICLE_SYSTEM")
    settings = ball.particle_systems[0].settings
    settings.type, settings.count, settings.hair_length, settings.material = "HAIR", 20, 0.5, 2
    settings.display_step, settings.root_radius, settings.tip_radius, settings.radius_scale = 3, 1.0, 0.5, 0.1
    settings.use_close_tip = False
    scene, told = exported()
    (curves,) = scene["curves"]
    assert len(curves["counts"]) == 20 and not told
    roots = np.array(curves["points"])[np.cumsum([0, *curves["counts"][:-1]])]
    assert np.allclose(np.linalg.norm(roots, axis=1), 1.0, atol=0.02)
    widths = np.array(curves["widths"]["values"])
    assert np.isclose(widths.max(), 0.1) and np.isclose(widths.min(), 0.05)
    placed = {str(each["mesh"]): each["materials"] for each in scene["instances"]}
    assert placed["{'curves': 0}"] == [scene["instances"][0]["materials"][1]]
    ball.show_instancer_for_viewport = False
    scene, _ = exported()
    assert [each["mesh"] for each in scene["instances"]] == [{"curves": 0}]


def leaning_strands(kind, named, values, *, samples, points, angle, turn=0.0):
    """Five ribbons with a shader of attributes and inputs, leaning towards the camera and away from it; lit by suns from before and from behind."""
    import beside_cycles
    import bpy
    import numpy as np

    made = beside_cycles.scene(4, samples=samples)
    made.render.resolution_x = made.render.resolution_y = 48
    made.cycles_curves.shape, made.cycles.max_bounces = "RIBBONS", 0
    made.camera.location, made.camera.rotation_euler = (0.0, -6.0, 0.0), (np.pi / 2, 0.0, 0.0)
    for about_x in (70.0, 250.0):
        lamp = bpy.data.lights.new("Sun", "SUN")
        lamp.energy, lamp.angle = 3.0, np.radians(angle)
        sun = bpy.data.objects.new("Sun", lamp)
        sun.rotation_euler = (np.radians(about_x), 0.0, turn)
        made.collection.objects.link(sun)
    cover, tree, end = beside_cycles.material("Strand")
    shader = tree.nodes.new(kind)
    for name, value in named.items():
        setattr(shader, name, value)
    for name, value in values.items():
        if name in shader.inputs:
            shader.inputs[name].default_value = value
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    ends = [(-1.5, -1.2), (-0.75, -0.6), (0.0, 0.0), (0.75, 0.6), (1.5, 1.2)]
    ways = [np.array([(x, y * t, 1.6 * t) for t in np.linspace(-1.0, 1.0, points)]) for x, y in ends]
    return curves_of(ways, "Strands", cover, radius=0.2)


def means_of_strands(tmp_path):
    """The mean of each of the five, in Cycles and in Gonio."""
    import beside_cycles
    import numpy as np

    return [np.array([band.mean() for band in np.split(picture, (10, 19, 28, 37), axis=1)]) for picture in beside_cycles.both(tmp_path)]


@pytest.mark.blender
def test_scales_lean_as_in_cycles(tmp_path):
    import numpy as np

    kinds = [("ShaderNodeBsdfHairPrincipled", {"model": "CHIANG"})]
    kinds += [("ShaderNodeBsdfHair", {"component": part}) for part in ("Reflection", "Transmission")]
    for kind, named in kinds:
        leaning_strands(kind, named, {"Offset": 0.25, "RoughnessV": 0.8, "Radial Roughness": 0.8}, samples=256, points=5, angle=5.0)
        # The other way round they are as far apart as they are bright.
        cycles, gonio = means_of_strands(tmp_path)
        assert np.allclose(gonio, cycles, rtol=0.05, atol=0.01 * cycles.max()), (kind, named, cycles, gonio)


@pytest.mark.blender
def test_elliptic_strands_are_as_in_cycles(tmp_path):
    import numpy as np

    # Flat along the curves' normals, which turn; and an aspect above 1, which Cycles takes for its inverse. Without a tilt of the scales, for which
    # Cycles has another brightness in directions of lamps than in those it samples.
    for aspect, roughness in ((0.5, 0.3), (1.6, 0.5)):
        values = {"Aspect Ratio": aspect, "Roughness": roughness, "Secondary Reflection": 0.7, "Offset": 0.0}
        named = {"model": "HUANG"}
        strands = leaning_strands("ShaderNodeBsdfHairPrincipled", named, values, samples=400, points=9, angle=20.0, turn=0.5)
        tilt = np.tile(np.linspace(0.0, 1.5, 9), 5).astype(np.float32)
        strands.data.attributes.new("tilt", "FLOAT", "POINT").data.foreach_set("value", tilt)
        cycles, gonio = means_of_strands(tmp_path)
        assert np.allclose(gonio, cycles, rtol=0.05), (aspect, gonio / cycles)


@pytest.mark.blender
def test_normals_of_strands_are_blenders(tmp_path):
    import bpy
    import numpy as np
    from gonio_extension.export import strand_normals

    turns = np.linspace(0.0, 3.0, 60)
    spiral = np.stack([np.cos(turns), np.sin(turns), 0.3 * turns], axis=1)
    for mode in (0, 1):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        curves = curves_of([spiral, spiral[::-1] * 2.0], "Strands").data
        curves.attributes.new("normal_mode", "INT8", "CURVE").data.foreach_set("value", np.full(2, mode, dtype=np.int32))
        tilt = np.linspace(0.0, 2.0, 120).astype(np.float32)
        curves.attributes.new("tilt", "FLOAT", "POINT").data.foreach_set("value", tilt)
        points, begins, ends = np.concatenate([spiral, spiral[::-1] * 2.0]), np.array([0, 60]), np.array([60, 120])
        tangents = np.concatenate([np.gradient(part, axis=0) for part in (points[:60], points[60:])])
        found = strand_normals.of_curves(curves, tangents, begins, ends)
        # Those that Blender has not freed by then are unit vectors.
        told = np.array([curves.normals[place].vector[:] for place in range(120)])
        whole = np.abs(np.linalg.norm(told, axis=1) - 1.0) < 1e-3
        assert whole.sum() > 60 and np.abs(found - told)[whole].max() < 0.05, (mode, whole.sum(), np.abs(found - told)[whole].max())
