"""Checkpoints, merging, noise thresholds and denoising from Python."""

import sys

import numpy as np
import pytest
from small_scenes import FLOOR, QUAD, finished, floor_scene

gonio = pytest.importorskip("gonio")

PASSES = ["color", "illuminance", "sample_count"]


def arrays(film):
    return {name: np.asarray(film[name]) for name in film.passes}


def same(first, second):
    first, second = arrays(first), arrays(second)
    return first.keys() == second.keys() and all(np.array_equal(first[name], second[name]) for name in first)


def test_a_render_goes_on_from_its_checkpoint(tmp_path):
    scene = floor_scene(width=130, height=70, samples=48, passes=PASSES)
    whole = finished(scene)
    with gonio.Render(scene) as render:
        next(render)
        render.checkpoint(tmp_path / "a.checkpoint")
    with gonio.Render(scene, resume=tmp_path / "a.checkpoint") as render:
        assert render.wait()
        assert same(render.film(), whole)


def test_parts_merge_to_the_whole(tmp_path):
    scene = floor_scene(samples=48, passes=PASSES)
    whole = finished(scene)
    paths = []
    for first, end in ((0, 8), (8, 32), (32, 48)):
        scene.set(sample_range=(first, end))
        paths.append(tmp_path / f"{first}.part")
        with gonio.Render(scene) as render:
            assert render.wait()
            assert render.film().samples == end - first
            render.checkpoint(paths[-1])
    assert same(gonio.merge(paths[::-1]), whole)
    with pytest.raises(gonio.FormatError, match="samples 8:32 are missing"):
        gonio.merge([paths[0], paths[2]])
    scene.set(sample_range=None)
    assert same(finished(scene), whole)


def test_a_checkpoint_of_another_scene_is_refused(tmp_path):
    path = tmp_path / "a.checkpoint"
    with gonio.Render(floor_scene()) as render:
        assert render.wait()
        render.checkpoint(path)
    with pytest.raises(gonio.FormatError, match="its samples is 4, 8 was asked for"):
        gonio.Render(floor_scene(samples=8), resume=path)
    other = floor_scene()
    other.add_light("sphere", (1.0, 1.0, 1.0), radius=0.1)
    with pytest.raises(gonio.FormatError, match="another scene"):
        gonio.Render(other, resume=path)
    with pytest.raises(FileNotFoundError):
        gonio.Render(other, resume=tmp_path / "b.checkpoint")


def test_a_noise_threshold_ends_quiet_zones():
    film = finished(floor_scene(width=64, height=64, samples=512, noise_threshold=0.05, min_samples=16, passes=PASSES))
    counts = np.asarray(film["sample_count"])
    assert film.samples == counts.min() and film.mean_samples == pytest.approx(counts.mean())
    assert 16 <= counts.min() and counts.mean() < 400
    uniform = finished(floor_scene(width=64, height=64, samples=512, passes=PASSES))
    assert np.asarray(film["illuminance"]).mean() == pytest.approx(np.asarray(uniform["illuminance"]).mean(), rel=5e-3)
    with pytest.raises(gonio.SettingError, match="noise threshold"):
        gonio.Render(floor_scene(noise_threshold=0.1, sample_range=(0, 2)))


def exact_and_noisy():
    """A film with a denoiser's guides, and the same with noise on its colour."""
    exact = finished(floor_scene(samples=64, width=96, height=96, passes=["color", "illuminance", "denoising_albedo", "denoising_normal"]))
    color = np.array(exact["color"])
    color[..., :3] *= np.random.default_rng(3).gamma(4.0, 0.25, (96, 96, 1)).astype("f4")
    return exact, exact.with_pass("color", color)


def error(film, exact):
    """The median leaves the lamp's own pixels out."""
    return np.median(np.abs(np.asarray(film["color"]) - np.asarray(exact["color"]))[..., :3])


def test_denoising_takes_noise_out():
    pytest.importorskip("pyoidn")
    exact, noisy = exact_and_noisy()
    film = gonio.denoise(noisy)
    assert error(film, exact) < 0.3 * error(noisy, exact)
    assert all(np.array_equal(film[name], noisy[name]) for name in film.passes if name != "color")
    assert np.array_equal(np.asarray(film["color"])[..., 3], np.asarray(noisy["color"])[..., 3])


def test_the_quick_filter_takes_noise_out():
    exact, noisy = exact_and_noisy()
    film = noisy.edge_aware()
    assert error(film, exact) < 0.4 * error(noisy, exact)
    assert film.passes == ["color"] and film.size == noisy.size and film.samples == noisy.samples
    assert np.array_equal(np.asarray(film["color"])[..., 3], np.asarray(noisy["color"])[..., 3])
    with pytest.raises(KeyError, match="denoising_albedo"):
        finished(floor_scene()).edge_aware()


@pytest.mark.parametrize("sharp", [{"metalness": 1.0, "base_color": (0.8, 0.6, 0.4)}, {"transmission_weight": 1.0}])
def test_denoisers_are_guided_by_what_mirrors_and_glass_show(sharp):
    scene = floor_scene(width=16, height=16, samples=64, passes=["color", "albedo", "denoising_albedo", "denoising_normal"])
    pane = scene.add_material("pane", specular_roughness=0.0, **sharp)
    scene.add_instance(scene.add_mesh(0.2 * FLOOR + [0, 6, 0], QUAD, name="pane"), [pane], name="pane")
    film = finished(scene)
    albedo, shown, normal = (np.asarray(film[name])[4, 4] for name in ("albedo", "denoising_albedo", "denoising_normal"))
    if "metalness" in sharp:
        # Above there is nothing.
        assert albedo.min() > 0.3 and not shown.any() and not normal.any()
    else:
        # The floor below, but for what the pane reflects.
        assert albedo.min() > 0.9 and shown == pytest.approx(np.full(3, 0.48), abs=0.03) and normal[1] > 0.9


def mirrors_and_glass(**settings):
    """The floor and a shining panel under a bright sky, below a mirror, glass, half-open sheets of glass and of paper, and lacquer."""
    scene = floor_scene(width=32, height=32, **settings)
    scene.add_light("dome", (20.0, 30.0, 40.0))
    glass = {"transmission_weight": 1.0, "specular_roughness": 0.0}
    shapes = {
        "mirror": (3.0, (-1.5, 1, 0), {"metalness": 1.0, "base_color": (0.8, 0.6, 0.4), "specular_roughness": 0.0}),
        "glass": (3.0, (1.5, 2, 0), glass),
        "sheet": (2.0, (0, 3, 0), {**glass, "geometry_opacity": 0.6}),
        "paper": (2.0, (1, 4, 1), {"base_color": (0.3, 0.3, 0.3), "geometry_opacity": 0.5}),
        "lacquer": (1.5, (-1.5, 0.5, 2), {"base_color": (0.3, 0.2, 0.1), "coat_weight": 1.0, "coat_roughness": 0.0}),
        "panel": (0.7, (1, 0.5, 1), {"base_color": (0.2, 0.2, 0.2), "emission_color": (300.0, 300.0, 300.0)}),
    }
    for name, (size, place, parameters) in shapes.items():
        mesh = scene.add_mesh(0.1 * size * FLOOR + np.array(place, "f4"), QUAD, name=name)
        scene.add_instance(mesh, [scene.add_material(name, **parameters)], name=name)
    return scene


def test_rays_of_its_own_find_the_light_that_mirrors_and_glass_show():
    def means(seed, *passes):
        film = finished(mirrors_and_glass(samples=16, seed=seed, passes=["color", *passes]))
        return np.asarray(film["color"])[..., :3].mean(axis=2).reshape(4, 8, 4, 8).mean(axis=(1, 3))

    plain, apart = (np.stack([means(seed, *passes) for seed in range(16)]) for passes in ((), ("denoising_light",)))
    difference = plain - apart
    deviation = difference.std(axis=0, ddof=1) / 4.0
    # Of sixteen blocks, a Student's t of 15 degrees of freedom exceeds 5.5 once in a thousand times.
    assert np.all(np.abs(difference.mean(axis=0)) <= 5.5 * deviation + 1e-5 * plain.mean())
    assert apart.var(axis=0).sum() < 0.5 * plain.var(axis=0).sum()


def test_denoisers_leave_light_alone_that_the_camera_sees_sharply():
    pytest.importorskip("pyoidn")
    film = finished(mirrors_and_glass(samples=16, passes=["color", "denoising_albedo", "denoising_normal", "denoising_light"]))
    color, light = np.asarray(film["color"])[..., :3], np.asarray(film["denoising_light"])
    assert np.all(light <= color * (1 + 1e-5) + 1e-3) and light.max() > 100.0
    # Nothing but the rough floor is seen here.
    assert not light[0].any()
    clean = np.asarray(gonio.denoise(film)["color"])[..., :3]
    black = film.with_pass("color", np.concatenate([light, np.ones((32, 32, 1), "f4")], axis=2))
    assert np.asarray(gonio.denoise(black)["color"])[..., :3] == pytest.approx(light, abs=1e-2)
    assert np.all(clean >= light - 1e-3)


def test_denoising_without_the_extra_says_how_to_get_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "pyoidn", None)
    with pytest.raises(gonio.UnsupportedError, match=r"pip install pyoidn"):
        gonio.denoise(finished(floor_scene()))


def test_passes_can_be_replaced():
    film = finished(floor_scene())
    doubled = film.with_pass("color", 2.0 * np.asarray(film["color"]))
    assert np.array_equal(np.asarray(doubled["color"]), 2.0 * np.asarray(film["color"]))
    assert np.array_equal(doubled["illuminance"], film["illuminance"])
    with pytest.raises(ValueError, match="shape"):
        film.with_pass("color", np.zeros((2, 2, 4), "f4"))
