"""Illumination maps from Python."""

import math

import numpy as np
import pytest
from small_scenes import QUAD

gonio = pytest.importorskip("gonio")

# Flux of a sphere of 0.1 m and 1000 cd/m²: π L A.
LUMENS = math.pi * 1000 * 4 * math.pi * 0.01
SQUARE = np.array([[0, 0.5, 0], [2, 0.5, 0], [2, 0.5, -2], [0, 0.5, -2]], "f4")


def test_texels_and_triangles(floor, tmp_path):
    scene = floor()
    square = scene.add_mesh(SQUARE, QUAD, uvs=np.array([[0.25, 0.25], [0.75, 0.25], [0.75, 0.75], [0.25, 0.75]], "f4"))
    scene.add_instance(square, name="/Room/Square")
    maps = gonio.illumination_map(scene, prims=["/Room"], uv="st", resolution=(16, 8), error=0, paths=1 << 18, colours=True)
    (texels,) = maps.surfaces
    assert (texels.name, texels.size, texels.placement) == ("/Room/Square", (16, 8), 0)
    lux, errors = np.asarray(texels.illuminance()), np.asarray(texels.standard_errors())
    assert lux.shape == errors.shape == (8, 16) and np.isfinite(lux).sum() == 32
    # All texels of the square are of one size.
    assert np.nanmean(lux) == pytest.approx(texels.mean()) and texels.flux() == pytest.approx(texels.mean() * texels.area)
    assert np.asarray(texels.colours()).reshape(8, 16, 3)[4, 8] == pytest.approx([lux[4, 8]] * 3, rel=1e-5)
    # The floor below sends some of its light up.
    assert texels.corners is None and 0 < texels.mean("back") < 0.5 * texels.mean()
    assert maps.paths == 1 << 18 and maps.emitted == pytest.approx(LUMENS, rel=2e-3) and maps.diagnostics == []
    texels.write(tmp_path / "square.exr")
    divided = gonio.illumination_map(scene, prims=["/Room"], texel=0.5, error=0, paths=1 << 18).surfaces[0]
    assert divided.size is None and divided.flux() == pytest.approx(texels.flux(), rel=1e-6)
    corners = np.asarray(divided.corners).reshape(-1, 3, 3)
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    assert areas.sum() == pytest.approx(4) and areas.max() <= 0.25
    assert (np.asarray(divided.illuminance()) * areas).sum() == pytest.approx(divided.flux())
    assert divided.instances == 1
    # The square's two triangles are of one size; corners lie further from the lamp than the middle does.
    triangles = np.asarray(divided.of_triangles())
    assert triangles.mean() == pytest.approx(divided.mean())
    assert not np.asarray(divided.of_triangles(quantity="indirect")).any()
    at_corners = np.asarray(divided.at_corners())
    assert at_corners.shape == (2, 3) and (at_corners > 0).all() and at_corners[0, 0] == at_corners[1, 0]
    assert not np.asarray(texels.of_triangles()).any() and np.asarray(texels.at_corners("back", quantity="error")).shape == (2, 3)
    with pytest.raises(gonio.SettingError, match="texture coordinates"):
        divided.write(tmp_path / "divided.exr")


def test_views(floor):
    scene = floor()
    maps = gonio.illumination_map(scene, texel=0.25, error=0, paths=1 << 20)
    view = np.asarray(maps.view(scene))
    assert view.shape == (32, 32)
    middle = math.pi * 1000 * (0.1 / 2) ** 2
    assert view[15:17, 15:17].mean() == pytest.approx(middle, rel=0.12)
    assert np.asarray(maps.view(scene, quantity="indirect"))[16, 16] == 0
    scene.add_instance(0)
    with pytest.raises(gonio.SettingError, match="other surfaces"):
        maps.view(scene)


def test_bad_wishes(floor):
    scene = floor()
    for wish, message in [
        ({"prims": ["/Nowhere"]}, "/Nowhere"),
        ({"uv": "map9"}, "map9"),
        ({"texel": -1.0}, "texel"),
        ({"texel": 0.1, "resolution": (4, 4)}, "resolution"),
        ({"resolution": (4, 4)}, "coordinates"),
        ({"texel": 1e-4, "memory": 1 << 20}, "memory"),
        ({"paths": 0}, "paths"),
        ({"error": math.nan}, "error"),
    ]:
        with pytest.raises(gonio.Error, match=message):
            gonio.illumination_map(scene, **wish)
    with pytest.raises(gonio.Cancelled):
        gonio.illumination_map(scene, error=0, paths=1 << 30, cancelled=lambda: True)
