"""Elements put into scenes by their descriptions, in the objects that Python has for numbers and lists."""

import array

import gonio
import numpy as np
import pytest

POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "f4")
TRIANGLES = np.array([[0, 1, 2]], "i4")


def closure(colour):
    return {"closures": [{"model": "Diffuse", "parameters": [("base_color", {"Constant": colour})]}]}


def colour_of(scene, material=0):
    return scene.to_dict()["materials"][material]["closures"][0]["parameters"][0][1]["Constant"]


@pytest.mark.parametrize(
    "colour",
    [
        [0.1, 0.5, 1, 0],
        (0.1, 0.5, 1, 0),
        np.array([0.1, 0.5, 1, 0]),
        np.array([0.1, 0.5, 1, 0], "f4"),
        [np.float32(0.1), np.float64(0.5), np.int32(1), np.uint8(0)],
        array.array("d", [0.1, 0.5, 1, 0]),
        memoryview(array.array("f", [0.1, 0.5, 1, 0])),
        [0.1, np.array(0.5), True + 0, 0],
    ],
)
def test_numbers_of_any_kind(colour):
    scene = gonio.Scene()
    scene.put_material(closure(colour))
    # As short as they can be, whatever float32 makes of them.
    assert colour_of(scene) == [0.1, 0.5, 1.0, 0.0]


def test_numpy_counts_and_flags():
    scene = gonio.Scene()
    material = closure([1, 1, 1, 1])
    material["closures"][0]["thin_walled"] = np.bool_(True)
    scene.put_material({**material, "pass_index": np.int64(7)})
    described = scene.to_dict()["materials"][0]
    assert described["pass_index"] == 7 and described["closures"][0]["thin_walled"] is True


def test_large_whole_numbers_are_floats():
    scene = gonio.Scene()
    scene.add_meter((2**70, -(2**63), 0))
    scene.put_meter({"position": [2**70, -(2**63), 2**64 - 1]})
    assert scene.to_dict()["meters"][1]["position"] == [2.0**70, -(2.0**63), 2.0**64]


@pytest.mark.parametrize(
    ("description", "place"),
    [
        (closure([0.5] * 3), r"closures\[0\]\.parameters\[0\]\[1\]\.Constant: invalid length 3"),
        (closure([0.5] * 5), r"closures\[0\]\.parameters\[0\]\[1\]\.Constant: 5 elements were found, expected 4"),
        (closure([0.5, "red", 0, 0]), r"Constant\[1\]: invalid type: string \"red\", expected f32"),
        (closure([0.5, float("nan"), 0, 0]), r"Constant\[1\]: NaN was found, expected a finite number"),
        (closure([0.5, {1, 2}, 0, 0]), r"Constant\[1\]: invalid type: object of type 'set', expected f32"),
        (closure([0.5, np.zeros(2), 0, 0]), r"Constant\[1\]: invalid type: sequence, expected f32"),
        ({"closures": [{"weight": {"Constant": [1] * 4, "Node": [0, "R"]}}]}, r"closures\[0\]\.weight: .*expected a name, or a dictionary"),
        ({"closures": [{"model": {"Diffuse": 1}}]}, r"closures\[0\]\.model\.Diffuse: invalid type: integer `1`, expected unit"),
        ({"graph": {"nodes": [{"operation": "Add"}]}}, r"graph\.nodes\[0\]: missing field `inputs`"),
        ({"pass_index": 1.5}, r"pass_index: invalid type: floating point `1\.5`, expected u32"),
        ({"pass_index": True}, r"pass_index: invalid type: boolean `true`, expected u32"),
        ({"pass_index": 2**80}, r"pass_index: invalid type: floating point"),
        ({0: "name"}, r"the key 0 is no text"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(description, place):
    with pytest.raises(gonio.SettingError, match="material: the description is not understood: (.*)" + place):
        gonio.Scene().put_material(description)


def test_descriptions_that_hold_themselves():
    endless = []
    endless.append(endless)
    with pytest.raises(gonio.SettingError, match="more than 128 levels deep"):
        gonio.Scene().put_material({"origin": endless})
    # What no element has is not looked at.
    assert gonio.Scene().put_material({"unknown": endless}) == 0


def full_scene():
    scene = gonio.Scene()
    mesh = scene.add_mesh(POINTS, TRIANGLES)
    scene.add_instance(mesh, [scene.add_material(base_color=0.1)])
    scene.add_light("disk", (0.1, 0.2, 0.3), lumens=100.0, spot=(30.0, 0.1))
    scene.add_camera(fov=33.0)
    scene.add_meter((0.1, 0.2, 0.3), quantity="daylight-factor")
    scene.add_grid(mesh=mesh, spacing=0.1)
    return scene


def test_what_a_scene_tells_can_be_put():
    told, again = full_scene().to_dict(), gonio.Scene()
    for kind in ("material", "light", "camera", "meter", "grid"):
        for index in (None, 0):
            assert getattr(again, f"put_{kind}")(told[f"{kind}s"][0], index) == 0
        assert again.to_dict()[f"{kind}s"] == told[f"{kind}s"]


def test_replaced_meshes():
    scene = full_scene()
    assert scene.put_mesh(POINTS * 2, TRIANGLES, name="twice", index=0) == 0
    (mesh,) = scene.to_dict()["meshes"]
    assert mesh["origin"]["name"] == "twice" and mesh["points"][1] == [2.0, 0.0, 0.0]
    with pytest.raises(gonio.SettingError, match="mesh: number 3 was asked for, the scene has 1"):
        scene.put_mesh(POINTS, TRIANGLES, index=3)


def test_placements_of_what_is_not_there():
    scene = full_scene()
    with pytest.raises(gonio.SettingError, match="mesh: 4 was found, the scene has 1 meshes"):
        scene.put_instances(4, [], np.eye(4)[None])
    with pytest.raises(gonio.SettingError, match="materials: 2 was found, the scene has 1 materials"):
        scene.put_instances(0, [0, 2], np.eye(4)[None])


@pytest.mark.parametrize("kind", ["meshes", "instances", "materials", "textures", "measured", "lights", "cameras", "meters", "grids"])
def test_lists_are_cut(kind):
    scene = full_scene()
    before = scene.to_dict()
    scene.truncate(kind, 1)
    assert scene.to_dict() == before
    scene.truncate(kind, 0)
    assert scene.to_dict() == {**before, kind: []}


def test_lists_that_no_scene_has():
    with pytest.raises(gonio.SettingError, match="kind: 'lamps' was found, expected meshes, curves, points, instances"):
        gonio.Scene().truncate("lamps", 0)


def test_apertures_follow_the_picture_unless_they_are_fixed():
    scene = gonio.Scene()
    scene.set(width=100, height=100)
    scene.add_camera()
    camera = scene.to_dict()["cameras"][0]
    scene.set(width=200)
    assert scene.resolution == (200, 100)
    assert scene.to_dict()["cameras"][0]["aperture"] == [2 * camera["aperture"][0], camera["aperture"][1]]
    scene.put_camera(camera, 0)
    scene.set(width=100)
    assert scene.to_dict()["cameras"] == [camera]


def test_the_camera_that_renders():
    scene = gonio.Scene()
    scene.add_camera(name="first")
    scene.add_camera(name="second")
    assert scene.to_dict()["settings"]["camera"] == 1
    scene.set(camera=0)
    assert scene.to_dict()["settings"]["camera"] == 0


def test_loaded_scenes_can_be_built_on(tmp_path):
    full_scene().save(tmp_path / "scene.gonio")
    scene = gonio.Scene.load(tmp_path / "scene.gonio")
    assert type(scene) is gonio.Scene
    assert scene.add_material(base_color=0.5) == 1
