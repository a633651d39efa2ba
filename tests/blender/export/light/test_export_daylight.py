"""Sun and sky of a world: by place and time, and by Blender's Sky Texture."""

import pytest

K = 177.83


def world_with(build=None, **settings):
    """Descriptions of a world's lights, the recording scene, and the report; `build` fills the tree as in `test_export_light.world_of`."""
    import bpy
    from recorder import Recorder, module

    world = bpy.data.worlds.new("World")
    if bpy.app.version < (5, 0, 0):
        world.use_nodes = True
    tree = world.node_tree
    tree.nodes.clear()
    if build is not None:
        tree.links.new(build(tree), tree.nodes.new("ShaderNodeOutputWorld").inputs["Surface"])
    for name, value in settings.items():
        setattr(world.gonio, name, value)
    scene, report = Recorder(), module("report").Report()
    images = module("export.images").Images(scene, module("export.slots").Slots())
    return module("export.world").domes(world, images, report)[0], scene, report


@pytest.mark.blender
def test_a_place_and_a_time_become_sky_and_sun(tmp_path):
    import gonio
    import numpy as np
    from recorder import empty

    empty()
    place = {"latitude": 48.0, "longitude": 16.0, "utc_offset": 2.0, "day": 21, "month": 6, "year": 2025, "hour": 13.5}
    (sky, sun), scene, report = world_with(use_daylight=True, north=0.0, **place)
    found = gonio.daylight(48.0, 16.0, "2025-06-21T13:30+02:00")
    assert sky["shape"] == {"Dome": {"format": "LatLong"}} and sky["emission"]["radiance"] == [1.0] * 3
    assert np.dot(sun["emission"]["radiance"], [0.2126, 0.7152, 0.0722]) == pytest.approx(found.direct_illuminance, rel=1e-5)
    assert sun["transform"]["columns"][2] == pytest.approx(found.sun_direction, abs=1e-5)
    axes = np.array(sky["transform"]["columns"][:3])
    # East, up and south of the picture in a world with +Y to the north.
    assert np.allclose(axes, [[1, 0, 0], [0, 0, 1], [0, -1, 0]]) and np.linalg.det(axes) == pytest.approx(1.0)
    assert scene.textures[0]["pixels"].shape == (512, 1024, 4) and not report.diagnostics
    # True north to the right of +Y: the noon sun, in the south, moves to the left.
    (_, turned), _, _ = world_with(use_daylight=True, north=np.pi / 2, **place)
    east, north, up = found.sun_direction
    assert turned["transform"]["columns"][2] == pytest.approx([north, -east, up], abs=1e-5)


@pytest.mark.blender
def test_every_sky_of_the_panel_is_known(tmp_path):
    from recorder import empty, module

    empty()
    for key, *_ in module("properties.world").SKIES:
        found, _, report = world_with(use_daylight=True, sky=key, hour=12.0)
        assert found and not report.diagnostics, (key, [line.text for line in report.diagnostics])


@pytest.mark.blender
def test_cities_set_the_place(tmp_path):
    import bpy
    from recorder import empty, module

    empty()
    world = bpy.data.worlds.new("World")
    for key, (_, latitude, longitude, offset) in module("properties.world").CITIES.items():
        world.gonio.city = key
        found = (world.gonio.latitude, world.gonio.longitude, world.gonio.utc_offset)
        assert found == pytest.approx((latitude, longitude, offset), abs=1e-4)
        # A place's clock shows noon within two hours of the sun's.
        assert abs(longitude / 15.0 - offset) < 2.1, key


@pytest.mark.blender
def test_a_day_that_is_not_is_told(tmp_path):
    from recorder import empty

    empty()
    found, _, report = world_with(use_daylight=True, day=31, month=2)
    assert not found and "day: 31" in report.diagnostics[0].text


@pytest.mark.blender
def test_the_hour_follows_keyframes(tmp_path):
    import bpy
    import gonio
    from recorder import empty, exporter

    empty()
    scene = bpy.context.scene
    world = scene.world = bpy.data.worlds.new("World")
    world.gonio.use_daylight, world.gonio.utc_offset = True, 2.0
    for frame, hour in ((1, 9.0), (11, 17.0)):
        world.gonio.hour = hour
        assert world.gonio.keyframe_insert("hour", frame=frame)
    for curve in _curves(world):
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
    exported, _ = exporter()
    for frame, hour in ((1, "09:00"), (6, "13:00"), (11, "17:00")):
        scene.frame_set(frame)
        sun = exported.sync(bpy.context.evaluated_depsgraph_get()).lights[1]
        expected = gonio.daylight(world.gonio.latitude, world.gonio.longitude, f"2025-06-21T{hour}+02:00").sun_direction
        assert sun["transform"]["columns"][2] == pytest.approx(expected, abs=1e-4)


@pytest.mark.blender
def test_edits_leave_no_pictures_behind(tmp_path):
    import bpy
    from recorder import Recorder, empty, module

    empty()
    world = bpy.data.worlds.new("World")
    world.gonio.use_daylight, world.gonio.sky = True, "OVERCAST"
    scene, report = Recorder(), module("report").Report()
    images, domes = module("export.images").Images(scene, module("export.slots").Slots()), module("export.world").domes
    found = []
    for hour in (9.0, 10.0, 10.0, 11.0, 12.0):
        world.gonio.hour = hour
        ((dome,), _) = domes(world, images, report)
        found.append((dome["texture"], float(scene.textures[dome["texture"]]["pixels"][0, 0, 1])))
    # Another hour is another number, and a brighter sky.
    assert [number for number, _ in found] == [0, 1, 1, 0, 1] and len(scene.textures) == 2
    assert [value for _, value in found] == sorted(value for _, value in found) and scene.calls.count("textures") == 4


def _curves(world):
    action = world.animation_data.action
    if hasattr(action, "fcurves"):
        return action.fcurves
    return [curve for layer in action.layers for strip in layer.strips for bag in strip.channelbags for curve in bag.fcurves]


def sky(tree, kind, **fields):
    """A Sky Texture into a Background."""
    node, shown = tree.nodes.new("ShaderNodeTexSky"), tree.nodes.new("ShaderNodeBackground")
    node.sky_type = kind
    for name, value in fields.items():
        setattr(node, name, value)
    tree.links.new(node.outputs[0], shown.inputs["Color"])
    return shown.outputs[0]


def kinds():
    """The types of Sky Texture that this Blender has."""
    import bpy

    return [item.identifier for item in bpy.types.ShaderNodeTexSky.bl_rna.properties["sky_type"].enum_items]


@pytest.mark.blender
def test_sky_textures_are_as_bright_as_in_cycles(tmp_path):
    import numpy as np
    from recorder import empty, module

    empty()
    # Means by cosine over the upper half, measured with Cycles.
    measured = module("export.material.fallback").SKIES
    assert set(kinds()) <= set(measured)
    for kind in kinds():
        lights, scene, report = world_with(lambda tree, kind=kind: sky(tree, kind))
        pixels = scene.textures[lights[0]["texture"]]["pixels"]
        rows = pixels.shape[0]
        polar = np.pi * (np.arange(rows // 2) + 0.5) / rows
        weights = np.sin(polar) * np.cos(polar)
        mean = (pixels[: rows // 2, :, :3].mean(axis=1) * weights[:, None]).sum(axis=0) / weights.sum()
        assert mean == pytest.approx(np.array(measured[kind]), rel=0.06), (kind, mean)
        assert not report.diagnostics


@pytest.mark.blender
def test_the_disc_of_a_sky_texture_is_a_sun(tmp_path):
    from math import cos, radians, sin

    import numpy as np
    from recorder import empty

    empty()
    kind = "NISHITA" if "NISHITA" in kinds() else "SINGLE_SCATTERING"
    fields = {"sun_elevation": radians(30.0), "sun_rotation": radians(40.0), "sun_size": radians(2.0), "sun_intensity": 0.5}
    (dome, sun), scene, _ = world_with(lambda tree: sky(tree, kind, **fields))
    assert sun["shape"]["Distant"]["angle_deg"] == pytest.approx(2.0, rel=1e-5)
    # Half of four fifths (the limb is darker) of what the atmosphere lets through, 150 W/m² at most.
    assert 30.0 * K < sun["emission"]["radiance"][1] < 0.4 * 150.0 * K
    assert dome["emission"]["radiance"] == pytest.approx([K] * 3)
    towards = [cos(radians(30)) * sin(radians(40)), cos(radians(30)) * cos(radians(40)), sin(radians(30))]
    assert sun["transform"]["columns"][2] == pytest.approx(towards, abs=1e-5)
    # The sky is brightest at the sun, which is not in the picture itself.
    pixels = scene.textures[dome["texture"]]["pixels"][..., :3].sum(axis=-1)
    row, column = np.unravel_index(pixels[:250].argmax(), pixels[:250].shape)
    polar, longitude = np.pi * (row + 0.5) / 512, 2 * np.pi * (0.5 - (column + 0.5) / 1024)
    local = np.array([np.sin(polar) * np.sin(longitude), np.cos(polar), np.sin(polar) * np.cos(longitude)])
    found = np.array(dome["transform"]["columns"][:3]).T @ local
    assert np.dot(found, towards) > cos(radians(8))
    assert len(world_with(lambda tree: sky(tree, kind, sun_disc=False))[0]) == 1


@pytest.mark.blender
def test_a_changed_sky_is_baked_without_its_disc(tmp_path):
    from recorder import empty

    empty()
    kind = "NISHITA" if "NISHITA" in kinds() else "SINGLE_SCATTERING"

    def build(tree):
        end = sky(tree, kind)
        node = tree.nodes.new("ShaderNodeGamma")
        shown = end.node
        tree.links.new(shown.inputs["Color"].links[0].from_socket, node.inputs[0])
        tree.links.new(node.outputs[0], shown.inputs["Color"])
        return end

    found, _, report = world_with(build)
    assert len(found) == 1 and any("disc is left out" in line.text for line in report.diagnostics)


@pytest.mark.blender
def test_the_exposure_of_an_hour_is_one_click_away(tmp_path):
    import bpy
    import numpy
    import scenes

    scene = scenes.lit_floor(samples=256, width=16, height=16)
    bpy.data.objects.remove(scene.objects["Lamp"])
    bpy.data.objects["Floor"].active_material = scenes.diffuse("Grey", (0.18, 0.18, 0.18))
    scene.gonio.film_exposure = 2.0
    assert not bpy.ops.gonio.expose_for_daylight.poll()
    world = scene.world.gonio
    world.use_daylight = True
    scene.gonio.tone_map = "LOCAL"
    assert not bpy.ops.gonio.expose_for_daylight.poll()
    scene.gonio.tone_map = "NONE"
    for hour in (12.0, 18.5):
        world.hour = hour
        assert bpy.ops.gonio.expose_for_daylight() == {"FINISHED"}
        scenes.render(tmp_path / "a.exr")
        found = scenes.read(tmp_path / "a.exr")
        light = sum(weight * found[f"ViewLayer.Combined.{channel}"] for weight, channel in ((0.2126, "R"), (0.7152, "G"), (0.0722, "B")))
        assert numpy.mean(light) * 2.0**scene.view_settings.exposure == pytest.approx(0.18, rel=0.01), hour
    world.hour, before = 0.0, scene.view_settings.exposure
    with pytest.raises(RuntimeError, match="Neither sun nor sky"):
        bpy.ops.gonio.expose_for_daylight()
    assert scene.view_settings.exposure == before
