"""Quantities of lights added in Python, and the figures of their files."""

import math

import gonio
import numpy as np
import pytest

IES = """IESNA:LM-63-2002
TILT=NONE
1 1000 1 3 1 1 2 {size}
1 1 10
0 90 180
0
100 100 100
"""
DOWN = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 1], [0, 0, 0, 1]]


def efficacy(name: str) -> float:
    """Lumens of a watt of a lamp's spectrum."""
    lamp = gonio.illuminant(name)
    return gonio.spectrum_figures(lamp["wavelengths_nm"], lamp["power"])["ler"]


def lux(shape: str, **keywords) -> float:
    """Illuminance one metre straight under a light."""
    scene = gonio.Scene()
    corners = np.array([[-5, -5, 0], [5, -5, 0], [5, 5, 0], [-5, 5, 0]], np.float32)
    floor = scene.add_mesh(corners, np.array([[0, 1, 2], [0, 2, 3]], np.int32))
    scene.add_instance(floor, [scene.add_material(base_color=0.5)])
    scene.add_light(shape, transform=DOWN, visible=False, **keywords)
    scene.add_camera([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0.5], [0, 0, 0, 1]], fov=0.5)
    scene.set(width=16, height=16, samples=64, integrator="direct", passes=["illuminance"])
    with gonio.Render(scene) as rendering:
        rendering.wait()
        assert not rendering.diagnostics
        return float(np.asarray(rendering.film()["illuminance"]).mean())


@pytest.mark.parametrize(
    ("shape", "keywords", "expected"),
    [
        ("point", {"lumens": 100.0}, 100.0 / (4 * math.pi)),
        ("point", {"lumens": 100.0, "temperature": 2700.0, "dimming": 0.5}, 50.0 / (4 * math.pi)),
        ("sphere", {"lumens": 100.0, "radius": 0.002}, 100.0 / (4 * math.pi)),
        ("rectangle", {"lumens": 100.0, "width": 0.005, "height": 0.005}, 100.0 / math.pi),
        ("disk", {"watts": 1.0, "radius": 0.002}, 177.83 / math.pi),
        ("point", {"watts": 10.0, "spectrum": "HP1"}, 10.0 * efficacy("HP1") / (4 * math.pi)),
        ("point", {"candela": 30.0}, 30.0),
        ("point", {"lux": 30.0}, 30.0),
        ("point", {"lux": (30.0, 3.0)}, 270.0),
        ("point", {"candela": 30.0, "cosine_power": 4.0}, 30.0),
        ("point", {"lumens": 100.0, "cosine_power": 4.0}, 100.0 * 5 / (2 * math.pi)),
        ("point", {"lumens": 100.0, "spot": (60.0, 0.0)}, 100.0 / (2 * math.pi * (1 - math.cos(math.radians(30))))),
        ("distant", {"lux": 1000.0}, 1000.0),
        ("dome", {"nits": 100.0}, 100.0 * math.pi),
    ],
)
def test_illuminance_straight_on(shape, keywords, expected):
    assert lux(shape, **keywords) == pytest.approx(expected, rel=5e-3)


@pytest.mark.parametrize("size", ["0 0 0", "0.05 0.05 0", "-0.05 -0.05 0.05", "-0.05 -0.05 -0.05"])
def test_luminaires(size):
    goniogram, _ = gonio.read_goniogram(IES.format(size=size).encode(), "lamp.ies")
    # A body of 5 cm at 1 m is nearer with its lower side: 5 % at most.
    assert lux("luminaire", goniogram=goniogram) == pytest.approx(100.0, rel=0.06)
    assert lux("luminaire", goniogram=goniogram, lamp_lumens=250.0) == pytest.approx(25.0, rel=0.06)
    assert lux("point", goniogram=goniogram) == pytest.approx(100.0, rel=1e-3)


def test_what_is_wrong_is_told():
    with pytest.raises(gonio.SettingError, match="one quantity"):
        lux("point", lumens=1.0, candela=1.0)
    with pytest.raises(gonio.SettingError, match="no setting"):
        lux("point", lumen=1.0)


def test_figures_of_a_file():
    found = gonio.goniogram_figures(IES.format(size="0 0 0").encode(), "lamp.ies")
    assert found["flux_lm"] == pytest.approx(400 * math.pi)
    assert found["lamp_flux_lm"] == 1000
    assert found["peak_cd"] == 100 and found["watts"] == 10
    assert [point for point in found["cuts"][0] if point[0] == 90.0] == [[90.0, 100.0]]
