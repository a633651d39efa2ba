"""Building scenes from arrays, and what is refused."""

import array
import math

import gonio
import numpy as np
import pytest

POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], "f4")
TRIANGLES = np.array([[0, 1, 2], [1, 3, 2]], "i4")


def first_mesh(scene):
    return scene.to_dict()["meshes"][0]


def numbers(node):
    """A JSON form of an array, nested or flat or in a dictionary, as a flat list."""
    return np.asarray(node, float).ravel().tolist()


@pytest.mark.parametrize("kind", ["f4", "f8"])
def test_points_of_either_float(kind):
    scene = gonio.Scene()
    assert scene.add_mesh(POINTS.astype(kind), TRIANGLES) == 0
    assert numbers(first_mesh(scene)["points"]) == POINTS.ravel().tolist()


@pytest.mark.parametrize("kind", ["i4", "u4", "i8"])
def test_indices_of_any_integer(kind):
    scene = gonio.Scene()
    scene.add_mesh(POINTS, TRIANGLES.astype(kind))
    assert numbers(first_mesh(scene)["triangles"]) == TRIANGLES.ravel().tolist()


def test_array_and_memoryview_and_strides():
    expected = numbers(POINTS)
    flat = array.array("f", POINTS.ravel())
    wide = np.zeros((4, 6), "f4")
    wide[:, ::2] = POINTS
    for points in (flat, memoryview(POINTS), wide[:, ::2], np.asfortranarray(POINTS), memoryview(POINTS.tobytes()).cast("f")):
        scene = gonio.Scene()
        scene.add_mesh(points, array.array("i", TRIANGLES.ravel()))
        assert numbers(first_mesh(scene)["points"]) == expected


def test_arrays_are_copied(floor, render):
    scene = gonio.Scene()
    points = POINTS.copy()
    scene.add_mesh(points, TRIANGLES)
    points[:] = 7
    assert numbers(first_mesh(scene)["points"]) == numbers(POINTS)


def test_numbers_count_up():
    scene = gonio.Scene()
    assert [scene.add_mesh(POINTS, TRIANGLES) for _ in range(3)] == [0, 1, 2]
    assert [scene.add_material() for _ in range(2)] == [0, 1]
    assert [scene.add_light("sphere"), scene.add_light("dome")] == [0, 1]
    assert "3 meshes" in repr(scene) and "2 lights" in repr(scene)


@pytest.mark.parametrize("values", [4, 6])
def test_normals_and_uvs_at_points_or_corners(values):
    scene = gonio.Scene()
    scene.add_mesh(POINTS, TRIANGLES, normals=np.ones((values, 3), "f4"), uvs=np.ones((values, 2), "f4"))
    said = first_mesh(scene)
    expected = "Vertex" if values == 4 else "FaceVarying"
    assert said["normals"]["interpolation"] == expected and said["primvars"][0]["interpolation"] == expected


@pytest.mark.parametrize(
    ("arguments", "options", "error"),
    [
        (([[0, 0, 0]], TRIANGLES), {}, TypeError),
        (("points", TRIANGLES), {}, TypeError),
        ((POINTS.astype("i4"), TRIANGLES), {}, TypeError),
        ((POINTS.astype("f2"), TRIANGLES), {}, TypeError),
        ((POINTS.astype("c8"), TRIANGLES), {}, TypeError),
        ((POINTS, TRIANGLES.astype("f4")), {}, TypeError),
        ((POINTS, TRIANGLES.astype("i2")), {}, TypeError),
        ((POINTS, TRIANGLES.astype("u8")), {}, TypeError),
        ((POINTS, None), {}, TypeError),
        ((POINTS.ravel()[:10], TRIANGLES), {}, ValueError),
        ((POINTS, TRIANGLES.ravel()[:5]), {}, ValueError),
        ((POINTS, np.array([[0, 1, 4]], "i4")), {}, ValueError),
        ((POINTS, np.array([[0, 1, -1]], "i4")), {}, ValueError),
        ((POINTS, np.array([[0, 1, 2**40]], "i8")), {}, ValueError),
        ((POINTS, TRIANGLES), {"normals": np.ones((5, 3), "f4")}, ValueError),
        ((POINTS, TRIANGLES), {"normals": np.ones(13, "f4")}, ValueError),
        ((POINTS, TRIANGLES), {"uvs": np.ones((4, 3), "f4")}, ValueError),
        ((POINTS, TRIANGLES), {"slots": np.zeros(3, "i4")}, ValueError),
        ((POINTS, TRIANGLES), {"slots": np.full(2, 70000, "i4")}, ValueError),
        ((POINTS, TRIANGLES), {"slots": np.zeros(2, "f4")}, TypeError),
    ],
)
def test_wrong_arrays_are_refused_by_name(arguments, options, error):
    scene = gonio.Scene()
    with pytest.raises(error) as caught:
        scene.add_mesh(*arguments, **options)
    name = next(iter(options), None)
    assert any(word in str(caught.value) for word in ((name if name != "uvs" else "st",) if name else ("points", "triangles")))
    assert scene.to_dict()["meshes"] == [], "nothing is left of a refused mesh"


@pytest.mark.parametrize("shape", [(3, 4), (12,), (2, 2, 3)])
def test_points_of_another_shape(shape):
    scene = gonio.Scene()
    points = np.zeros(shape, "f4")
    if shape == (12,):
        scene.add_mesh(points, TRIANGLES)
    else:
        with pytest.raises(ValueError, match="points"):
            scene.add_mesh(points, TRIANGLES)


def test_byte_orders_of_other_machines_are_refused():
    with pytest.raises(TypeError):
        gonio.Scene().add_mesh(POINTS.astype(">f4"), TRIANGLES)


@pytest.mark.parametrize(
    ("call", "word"),
    [
        (lambda s: s.add_material(colour=1.0), "colour"),
        (lambda s: s.add_material(base_color=(1.0, 2.0)), "base_color"),
        (lambda s: s.add_instance(3), "mesh"),
        (lambda s: s.add_light("lamp"), "lamp"),
        (lambda s: s.set(integrator="photons"), "photons"),
        (lambda s: s.set(passes=["colour"]), "colour"),
    ],
)
def test_wrong_settings(call, word):
    with pytest.raises(gonio.SettingError, match=word) as caught:
        call(gonio.Scene())
    error = caught.value
    assert (error.origin, error.path, error.line, error.hint) == (None, None, None, None)


@pytest.mark.parametrize("matrix", [[[1, 0], [0, 1]], [[1, 0, 0, 0]] * 3, "matrix", [[1, 0, 0, 0]] * 3 + [[0, 0, 0]]])
def test_wrong_transforms(matrix):
    scene = gonio.Scene()
    mesh = scene.add_mesh(POINTS, TRIANGLES)
    for add in (lambda: scene.add_instance(mesh, transform=matrix), lambda: scene.add_light("disk", transform=matrix), lambda: scene.add_camera(matrix)):
        with pytest.raises((ValueError, TypeError)):
            add()


def test_numpy_matrices_are_transforms():
    scene = gonio.Scene()
    matrix = np.eye(4)
    matrix[:3, 3] = (1, 2, 3)
    scene.add_light("disk", transform=matrix)
    assert scene.to_dict()["lights"][0]["transform"]["columns"][3] == [1, 2, 3]


def test_exceptions_have_one_root():
    for kind in (gonio.SceneError, gonio.FormatError, gonio.SettingError, gonio.UnsupportedError, gonio.Cancelled):
        assert issubclass(kind, gonio.Error)
    assert issubclass(gonio.Error, Exception) and not issubclass(gonio.Error, OSError)


# Settings that only the renderer can judge.


@pytest.mark.parametrize(
    "settings", [{"width": 0}, {"height": 0}, {"width": 2**31, "height": 2**31}, {"samples": 0}, {"time_limit": math.nan}, {"time_limit": -1.0}]
)
def test_settings_out_of_range(floor, settings):
    with pytest.raises(gonio.SettingError):
        gonio.Render(floor(**settings))


@pytest.mark.parametrize("settings", [{"width": -1}, {"samples": 1.5}, {"seed": 2**40}, {"passes": "color"}, {"width": "wide"}])
def test_settings_of_the_wrong_type(settings):
    with pytest.raises((TypeError, OverflowError)):
        gonio.Scene().set(**settings)


def test_no_camera():
    scene = gonio.Scene()
    scene.add_instance(scene.add_mesh(POINTS, TRIANGLES))
    with pytest.raises(gonio.Error, match="camera"):
        gonio.Render(scene)


def test_an_empty_scene_is_black(render):
    scene = gonio.Scene()
    scene.set(width=8, height=8, samples=1)
    scene.add_camera()
    assert np.asarray(render(scene)["color"]).max() == 0


def test_values_that_are_no_numbers(floor, render):
    points = POINTS.copy()
    points[0] = np.nan
    scene = floor()
    for add in (
        lambda: scene.add_light("rectangle", (math.nan, 1.0, math.inf)),
        lambda: scene.add_light("sphere", radius=math.nan),
        lambda: scene.add_material(base_color=math.inf),
        lambda: scene.add_camera(fov=math.nan),
    ):
        with pytest.raises(gonio.SettingError, match="expected a finite number"):
            add()
    try:
        scene.add_instance(scene.add_mesh(points, TRIANGLES))
        scene.add_instance(0, transform=np.full((4, 4), np.nan))
        film = render(scene)
    except (gonio.Error, ValueError):
        return
    assert all(np.isfinite(np.asarray(film[name])).all() for name in film.passes)


def test_material_numbers_out_of_range(floor, render):
    scene = floor()
    mesh = scene.add_mesh(POINTS, TRIANGLES)
    with pytest.raises((gonio.Error, ValueError)):
        scene.add_instance(mesh, [99])
        render(scene)


# Files.


def test_missing_files():
    with pytest.raises(FileNotFoundError, match="absent"):
        gonio.Scene.load("/nowhere/absent.json")
    with pytest.raises(OSError):
        gonio.Scene().save("/nowhere/absent/scene.json")


def test_a_missing_stage(tmp_path):
    pytest.importorskip("pxr")
    with pytest.raises((FileNotFoundError, gonio.FormatError), match="absent"):
        gonio.load_usd(tmp_path / "absent.usda")


def test_errors_of_a_stage_say_where(tmp_path):
    pytest.importorskip("pxr")
    path = tmp_path / "bad.usda"
    path.write_text("#usda 1.0\n\n\ndef Mesh {{{\n")
    with pytest.raises(gonio.FormatError) as caught:
        gonio.load_usd(str(path))
    assert caught.value.path.endswith("bad.usda") and caught.value.line == 4


def test_strict_stages_name_their_prim(tmp_path):
    pytest.importorskip("pxr")
    path = tmp_path / "bad.usda"
    path.write_text('#usda 1.0\ndef Mesh "Broken"\n{\n    int[] faceVertexCounts = [3]\n    int[] faceVertexIndices = [0, 1, 9]\n    point3f[] points = [(0, 0, 0)]\n}\n')
    assert any(origin.startswith("/Broken") for origin, _ in gonio.load_usd(path).diagnostics)
    with pytest.raises(gonio.SceneError) as caught:
        gonio.load_usd(path, strict=True)
    assert caught.value.origin == "/Broken"
