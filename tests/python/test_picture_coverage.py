"""What pictures say of coverage: PNG's colours are not multiplied by it, a sky that is seen covers, holdouts pierce it."""

import gonio
import numpy as np
import pytest
from gonio.medium import haze
from png_reader import png
from small_scenes import QUAD, above, finished

LIGHT, SKY = 0.3, 0.6


def srgb(x):
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * np.maximum(x, 1e-9) ** (1 / 2.4) - 0.055)


def edge(model="Emission", sky=None, **settings):
    """A slanted half of the picture shines evenly, or is a hole; the rest is nothing, or a sky."""
    scene = gonio.Scene()
    scene.set(**{"width": 16, "height": 16, "samples": 64, "filter": "box", "filter_width": 1.0, "passes": ["color"], **settings})
    half = scene.add_mesh(np.array([[-9, 0, 9], [-0.5, 0, 9], [0.5, 0, -9], [-9, 0, -9]], "f4"), QUAD)
    shining = [["emission_color", {"Constant": [LIGHT, LIGHT, LIGHT, 1.0]}]] if model == "Emission" else []
    closure = {"weight": {"Constant": [1.0] * 4}, "model": model, "parameters": shining}
    scene.add_instance(half, [scene.put_material({"origin": "half", "closures": [closure]})])
    if sky is not None:
        scene.add_light("dome", [sky] * 3)
    scene.add_camera(above(8), fov=40)
    return scene


def shown(film, path, **look):
    film.write_picture(path, "none", **look)
    return png(path)[0].astype(float)


def partly(coverage, least=0.02):
    """Pixels at the edge."""
    found = (coverage > least) & (coverage < 0.98)
    assert found.sum() > 8
    return found


@pytest.mark.parametrize("sky", [None, SKY])
def test_colours_of_edges_are_those_of_the_thing(tmp_path, sky):
    film = finished(edge() if sky is None else edge(sky=sky, film_transparent=True))
    coverage, pixels = np.asarray(film["color"])[..., 3], shown(film, tmp_path / "a.png")
    assert np.abs(pixels[..., 3] - 255 * coverage).max() < 0.51
    assert np.abs(pixels[coverage > 0][:, :3] - 255 * srgb(LIGHT)).max() < 0.51
    assert (pixels[coverage == 0] == 0).all() and partly(coverage).any()
    deep = shown(film, tmp_path / "b.png", space="rec2020-pq")
    assert np.abs(deep[..., 3] - 65535 * coverage).max() < 0.51 and np.ptp(deep[coverage > 0][:, 1]) < 3
    # What hosts take is multiplied.
    mapped = np.asarray(film.tone_mapped("none")["color"])
    assert mapped == pytest.approx(np.asarray(film["color"]), abs=1e-6)


def test_a_sky_that_is_seen_covers(tmp_path):
    film = finished(edge(sky=SKY))
    values, pixels = np.asarray(film["color"]), shown(film, tmp_path / "a.png")
    assert (pixels[..., 3] == 255).all()
    assert np.abs(pixels[..., :3] - 255 * srgb(values[..., :3])).max() < 0.51
    # EXR files say what surfaces cover.
    assert values[..., 3].min() == 0.0 and values[..., 3].max() == 1.0 and partly(values[..., 3]).any()
    assert (np.frombuffer(film.picture("none").tobytes(), np.uint8).reshape(pixels.shape) == pixels).all()


@pytest.mark.parametrize("antialiasing", ["sampled", "adaptive"])
def test_holdouts_pierce_the_sky(tmp_path, antialiasing):
    trees = {"integrator": "whitted", "antialiasing": antialiasing} if antialiasing == "adaptive" else {}
    film = finished(edge("Holdout", sky=SKY, **trees))
    pixels, values = shown(film, tmp_path / "a.png"), np.asarray(film["color"])
    covered = pixels[..., 3] / 255
    assert covered.min() == 0.0 and covered.max() == 1.0 and (values[..., 3] == 0.0).all()
    if antialiasing == "sampled":
        assert covered == pytest.approx(values[..., 0] / SKY, abs=0.51 / 255)
        assert np.abs(pixels[covered > 0][:, :3] - 255 * srgb(SKY)).max() < 0.51
        assert partly(covered).any()


def test_lamps_before_nothing_are_seen(tmp_path):
    scene = edge("Holdout")
    scene.add_light("sphere", (50.0, 25.0, 0.1), radius=1.0, transform=[[1, 0, 0, 2], [0, 1, 0, 1], [0, 0, 1, 0], [0, 0, 0, 1]])
    pixels = shown(finished(scene), tmp_path / "a.png")
    middle = pixels[8, 11]
    assert middle[3] == 255 and (middle[:2] == 255).all() and pixels[0, 0, 3] == 0


def test_over_black_is_light_over_black(tmp_path):
    film = finished(edge())
    values = np.asarray(film["color"])
    pixels = np.frombuffer(film.picture("none", over_black=True).tobytes(), np.uint8).reshape(16, 16, 4)
    assert (pixels[..., 3] == 255).all()
    assert np.abs(pixels[..., :3] - 255 * srgb(values[..., :3])).max() < 0.51
    film.write_picture(tmp_path / "a.jpg", "none")
    assert (tmp_path / "a.jpg").stat().st_size > 100


def test_shadows_on_nothing_are_black_that_covers(tmp_path):
    scene = edge()
    floor = scene.add_mesh(np.array([[-9, -1, 9], [9, -1, 9], [9, -1, -9], [-9, -1, -9]], "f4"), QUAD)
    grey = scene.add_material(base_color=(0.5,) * 3, specular_weight=0.0)
    scene.put_instances(floor, [grey], np.eye(4)[None], visibility={"shadow_catcher": True})
    scene.add_light("distant", (900.0,) * 3, transform=[[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]], visible=False)
    film = finished(scene)
    values, pixels = np.asarray(film["color"]), shown(film, tmp_path / "a.png")
    caught = (values[..., 3] > 0) & (values[..., :3].max(-1) < 1e-6)
    assert np.abs(pixels[..., 3] - 255 * values[..., 3]).max() < 0.51
    assert (pixels[caught][:, :3] == 0).all()


def test_parts_of_a_render_know_their_holes(tmp_path):
    parts = []
    for first in (0, 256):
        scene = edge("Holdout", sky=SKY, samples=512, sample_range=(first, first + 256))
        with gonio.Render(scene) as render:
            assert render.wait()
            render.checkpoint(tmp_path / f"{first}.part")
        parts.append(tmp_path / f"{first}.part")
    whole, merged = finished(edge("Holdout", sky=SKY, samples=512)), gonio.merge(parts)
    assert (shown(merged, tmp_path / "a.png") == shown(whole, tmp_path / "b.png")).all()


def test_a_denoiser_lets_no_light_out_to_nothing(tmp_path):
    pytest.importorskip("pyoidn")
    film = finished(edge(samples=16, passes=["color", "denoising_albedo", "denoising_normal"]))
    coverage, clean = np.asarray(film["color"])[..., 3], gonio.denoise(film)
    assert (np.asarray(clean["color"])[coverage == 0] == 0).all()
    # Nor is the picture's brightness that of what leaked.
    pixels, plain = (shown(each, tmp_path / f"{name}.png") for name, each in (("clean", clean), ("plain", film)))
    assert (pixels[coverage == 0] == 0).all() and np.abs(pixels[..., 3] - plain[..., 3]).max() <= 1
    assert np.abs(pixels[coverage == 1] - plain[coverage == 1]).mean() < 3


def test_a_denoiser_leaves_haze_whose_samples_were_dark():
    pytest.importorskip("pyoidn")
    scene = gonio.Scene()
    scene.set(width=32, height=32, samples=4, max_bounces=4, passes=["color", "denoising_albedo", "denoising_normal"])
    wall = scene.add_mesh(np.array([[-9, 0, 9], [9, 0, 9], [9, 0, -9], [-9, 0, -9]], "f4"), QUAD)
    scene.add_instance(wall, [scene.add_material(base_color=(0.05,) * 3, specular_weight=0.0)])
    down = gonio.look_at((0, 3, 0), (0, 0, 0), (0, 0, 1))
    scene.add_light("sphere", (1.0, 1.0, 1.0), radius=0.02, candela=900.0, spot=(10.0, 0.1), transform=down)
    scene.put_atmosphere(haze(8.0))
    scene.add_camera(above(8), fov=60)
    film = finished(scene)
    plain, clean = (np.asarray(each["color"])[..., :3].max(axis=-1) for each in (film, gonio.denoise(film)))
    assert (plain == 0).sum() > 20 and (clean > 0).all()
