"""`gonio.sample_bsdf`: made-up samples of known scattering, and a room lit through the measurement of a blind."""

import gonio
import numpy as np
import pytest


def sheet(scene, material, half=10.0, z=0.0):
    """A square across z, whose front looks up."""
    points = np.array([[-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]], "f4")
    scene.add_instance(scene.add_mesh(points, np.array([[0, 1, 2], [0, 2, 3]], "i4"), name="sheet"), [material])


def paper(colour=(0.6, 0.6, 0.6)):
    scene = gonio.Scene()
    sheet(scene, scene.add_material("paper", base_color=colour, specular_weight=0.0))
    return scene


def blind(scene):
    """Slats of 0.1 m, 0.1 m apart along y, turned by 45°: light from +y is caught, from −y it passes."""
    slats = 200
    edge = 0.05 * np.sqrt(0.5)
    one = np.array([[-10, -edge, -edge], [10, -edge, -edge], [10, edge, edge], [-10, edge, edge]])
    places = 0.1 * (np.arange(slats) - slats / 2)
    points = np.concatenate([one + [0, y, 0] for y in places]).astype("f4")
    triangles = np.concatenate([np.array([[0, 1, 2], [0, 2, 3]]) + 4 * i for i in range(slats)]).astype("i4")
    white = scene.add_material("white", base_color=(0.7, 0.7, 0.7), specular_weight=0.0)
    scene.add_instance(scene.add_mesh(points, triangles, name="slats"), [white], name="blind")


def test_paper():
    reading = gonio.sample_bsdf(paper(), window=((-1, -1), (1, 1)), basis="quarter", error=0.05, threads=2)
    assert reading.converged and reading.error <= 0.05 and reading.diagnostics == []
    assert np.asarray(reading.totals("reflection-front")) == pytest.approx(np.full(41, 0.6), rel=0.03)
    assert not np.asarray(reading.shares("transmission-back")).any() and not np.asarray(reading.lost("back")).any()
    shares, errors = (np.asarray(found("reflection-back")) for found in (reading.shares, reading.standard_errors))
    assert shares.shape == errors.shape == (41, 41)
    mean = shares.mean(axis=0)
    assert (abs(shares - mean) < 6 * errors + 1e-3).all() and np.median(errors / shares) < 0.05


def test_files_are_read_back(tmp_path):
    reading = gonio.sample_bsdf(paper((0.6, 0.4, 0.2)), window=((-1, -1), (1, 1)), basis="quarter", sides="front", colour=True, error=0.1)
    path = tmp_path / "paper.xml"
    reading.write(path)
    found, made = gonio.MeasuredBsdf.from_file(path), reading.bsdf()
    assert found.channels == made.channels == ["X", "Y", "Z"] and "reflection-front" in found.sides
    wi, wo = np.array([[0.0, 0.6, 0.8]]), np.array([[0.6, 0.0, 0.8]])
    values = np.asarray(found.eval(wi, wo, rgb=True))
    assert values == pytest.approx(np.asarray(made.eval(wi, wo, rgb=True)), rel=1e-5)
    assert values[0] == pytest.approx(0.8 * np.array([0.6, 0.4, 0.2]) / np.pi, rel=0.15)
    with pytest.raises(gonio.SettingError, match="side"):
        reading.totals("reflection-back")


def test_a_blind_lights_a_room_as_its_measurement_does():
    """A broad beam at 40° onto a blind of grey slats, from either side, and the light 2 m below it."""
    made = gonio.Scene()
    blind(made)
    reading = gonio.sample_bsdf(made, window=((-0.5, -0.05), (0.5, 0.05)), error=0.1, sides="front", threads=2)
    assert max(np.asarray(reading.lost("front"))[:-12]) < 0.01

    def light_below(scene, side):
        c, s = np.cos(np.radians(40)), side * np.sin(np.radians(40))
        scene.add_light("distant", (1000.0,) * 3, angle=8.0, transform=[[1, 0, 0, 0], [0, c, s, 0], [0, -s, c, 0], [0, 0, 0, 1]])
        scene.add_grid(corner=(-0.05, -0.05, -1), edges=((0.1, 0, 0), (0, 0.1, 0)), spacing=0.0125)
        values = np.asarray(gonio.measure(scene, samples=512).grids[0].values)
        return values.mean()

    for side in (-1, 1):
        whole = gonio.Scene()
        blind(whole)
        flat = gonio.Scene()
        number = flat.put_measured(reading.bsdf(), name="blind")
        sheet(flat, flat.put_material({"closures": [{"model": "Measured", "measured": number}]}))
        assert light_below(flat, side) == pytest.approx(light_below(whole, side), rel=0.04)


def test_what_cannot_be_measured_is_told():
    for scene, options, words in (
        (gonio.Scene(), {}, "no geometry"),
        (paper(), {"window": ((0, 0), (0, 1))}, "window"),
        (paper(), {"up": (0, 0, 1)}, "up"),
        (paper(), {"basis": "third"}, "basis"),
        (paper(), {"error": 2.0}, "error"),
    ):
        with pytest.raises(gonio.SettingError, match=words):
            gonio.sample_bsdf(scene, **options)
    told = []
    with pytest.raises(gonio.Cancelled):
        gonio.sample_bsdf(paper(), error=0.0, rays=1 << 30, progress=lambda *now: told.append(now) or len(told) < 3)
    assert len(told) == 3 and told[0][1] == 290 << 30
