"""Meters, grids and false colour from Python."""

import math

import numpy as np
import pytest
from small_scenes import FLOOR, QUAD, at

gonio = pytest.importorskip("gonio")

# Illuminance under a sphere of 0.1 m and 1000 cd/m² at 2 m: π L (r / d)².
UNDER_LAMP = math.pi * 1000 * (0.1 / 2) ** 2


def test_meters(floor):
    scene = floor()
    assert scene.add_meter((0, 0, 0), normal=(0, 1, 0)) == 0
    assert scene.add_meter((0, 1, 0), facing=(0, -1, 0), quantity="luminance", name="down") == 1
    illuminance, luminance = gonio.measure(scene).meters
    assert float(illuminance) == pytest.approx(UNDER_LAMP, rel=2e-3)
    assert abs(illuminance.value - UNDER_LAMP) < 5 * illuminance.standard_error + 1e-3
    assert luminance.value == pytest.approx(0.5 * UNDER_LAMP / math.pi, rel=5e-3)
    scene.truncate("meters", 0)
    assert gonio.measure(scene).meters == []


def test_limits_of_pictures_do_not_hold(floor):
    scene = floor()
    scene.add_meter((0, 1, 0), normal=(0, -1, 0))
    expected = gonio.measure(scene).meters[0].value
    scene.set(clamp_direct=1e-3, clamp_indirect=1e-3, max_bounces=0)
    assert expected > 0 and gonio.measure(scene).meters[0].value == expected


def test_observers_rate_luminaires():
    """A sphere of 0.1 m, 3 m ahead and 1 m up, before an even sky of 25 cd/m²: CIE 117 by hand."""
    scene = gonio.Scene()
    scene.add_light("dome", (25.0,) * 3)
    scene.add_light("sphere", (4000.0,) * 3, radius=0.1, transform=at(0, 3, 1))
    scene.add_meter((0, 0, 0), facing=(0, 1, 0), quantity="ugr")
    scene.add_meter((0, 0, 0), facing=(0, -1, 0), quantity="ugr", name="away")
    found, away = gonio.measure(scene, samples=4096).meters
    # The table about T/R = 0, H/R = 1/3, over the sphere's disc: it falls to either side.
    along = np.linspace(-1, 1, 201)
    t, h = (k[along[:, None] ** 2 + along**2 < 1] / 30 for k in np.meshgrid(along, along))
    aside, up = abs(t) / 0.1, (h + 1 / 3 - 0.3) / 0.1
    index = (1.9 + 0.45 * up) * (1 - aside) + (1.8 + 0.4 * up) * aside
    solid_angle = math.pi * 0.01 / 10
    rated = 8 * math.log10(0.25 / 25 * 4000**2 * solid_angle * (index**-2).mean())
    assert found.value == pytest.approx(rated, abs=0.02)
    assert away.value == 0.0


def test_half_cylinders_face_somewhere(floor):
    scene = floor()
    scene.add_meter((0, 1, 0), normal=(0, 1, 0), facing=(0, 1, 0), quantity="semicylindrical")
    with pytest.raises(gonio.SceneError, match="along its own axis"):
        gonio.measure(scene)


def test_grids(floor, tmp_path):
    scene = floor()
    mesh = scene.add_mesh(FLOOR, QUAD, name="plane")
    scene.add_grid(mesh=mesh, transform=at(0, 0.5, 0), spacing=0.5, margin=1.0, name="plane")
    scene.add_grid(corner=(-1, 0, 1), edges=((2, 0, 0), (0, 0, -1)), spacing=0.5)
    found = gonio.measure(scene, samples=256)
    plane, rectangle = found.grids
    assert (plane.name, plane.size, plane.unit, plane.quantity) == ("plane", (16, 16), "lx", "illuminance")
    values, positions = np.asarray(plane.values), np.asarray(plane.positions)
    assert values.shape == (16, 16) and positions.shape == (256, 3) and np.allclose(positions[:, 1], 0.5)
    assert plane.average.value == pytest.approx(values.mean())
    assert (plane.min.value, plane.max.value) == (values.min(), values.max())
    assert plane.uniformity == pytest.approx(values.min() / values.mean())
    assert np.asarray(plane.standard_errors).shape == (16, 16)
    assert rectangle.size == (4, 2) and rectangle.spacing == pytest.approx((0.5, 0.5))
    assert (plane.area, rectangle.area) == pytest.approx((100.0, 2.0))
    assert found.csv().count("\r\n") == 1 + 256 + 8
    path = tmp_path / "plane.png"
    picture = plane.picture(max=10, steps=5)
    picture.write(path)
    width, height = picture.size
    assert len(picture.tobytes()) == width * height * 4 and path.read_bytes().startswith(b"\x89PNG")


def test_measuring_again_lends_the_trees(floor):
    scene = floor()
    scene.add_meter((0, 0, 0), normal=(0, 1, 0))
    with gonio.Render(scene) as render:
        render.wait()
        first = gonio.measure(scene, previous=render).meters[0].value
    assert first == gonio.measure(scene).meters[0].value


def test_grids_and_meters_are_part_of_the_scene(floor, tmp_path):
    scene = floor()
    scene.add_meter((0, 0, 0), normal=(0, 1, 0))
    scene.add_grid(edges=((1, 0, 0), (0, 0, -1)))
    scene.save(tmp_path / "scene.gonio")
    again = gonio.Scene.load(tmp_path / "scene.gonio")
    assert again.to_dict()["meters"] == scene.to_dict()["meters"]
    assert gonio.measure(again).csv() == gonio.measure(scene).csv()


def test_what_cannot_be_measured(floor):
    scene = floor()
    with pytest.raises(gonio.SettingError, match="semicylindrical"):
        scene.add_meter((0, 0, 0), quantity="loudness")
    with pytest.raises(ValueError, match="either edges or a mesh"):
        scene.add_grid()
    scene.add_meter((0, 0, 0), normal=(0, 0, 0))
    with pytest.raises(gonio.SceneError, match="normal"):
        gonio.measure(scene)
    scene.truncate("meters", 0)
    scene.add_grid(mesh=99)
    with pytest.raises(gonio.SceneError, match="99"):
        gonio.measure(scene)


def test_a_measurement_can_be_cancelled(floor):
    scene = floor()
    scene.add_grid(edges=((1, 0, 0), (0, 0, -1)), spacing=0.01)
    with pytest.raises(gonio.Cancelled):
        gonio.measure(scene, samples=1 << 20, cancelled=lambda: True)


def test_false_colour():
    values = np.repeat(np.linspace(0, 99, 100, dtype="f4")[None], 20, axis=0)
    picture = gonio.false_colour(values, max=100, steps=4, unit="lx", legend=False)
    pixels = np.frombuffer(picture.tobytes(), "u1").reshape(20, 100, 4)
    assert len(np.unique(pixels[0], axis=0)) == 4 and (pixels == pixels[0]).all()
    assert picture.size == (100, 20) and picture.legend(200).size[1] == 200
    beside = gonio.false_colour(values, max=100, steps=4, unit="lx")
    assert beside.size[0] == 100 + beside.legend(20).size[0]
    lines = gonio.false_colour(values, max=100, steps=4, contours=True, smoothing=0, legend=False)
    changed = (np.frombuffer(lines.tobytes(), "u1").reshape(20, 100, 4) != pixels).any(axis=2)
    assert np.flatnonzero(changed[0]).tolist() == [24, 49, 74]
    with pytest.raises(gonio.SettingError, match="steps"):
        gonio.false_colour(values, steps=0)
    with pytest.raises(gonio.SettingError, match="height"):
        picture.legend(10**9)
