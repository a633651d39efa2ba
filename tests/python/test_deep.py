"""Deep pictures: read back by OpenEXR, they flatten to the flat picture, and hold things at their depths."""

import gonio
import numpy as np
import pytest
from deep_reader import flatten, read
from matte_sheets import SHEETS, sheets
from small_scenes import FLOOR, QUAD, above, at, finished, floor_scene

pytest.importorskip("OpenEXR")
PASSES = ["color", "deep", "depth"]


def deep(film, folder):
    """Header, samples by pixel, and the flat picture."""
    film.write_deep_exr(folder / "deep.exr")
    assert [file.name for file in folder.iterdir()] == ["deep.exr"], "written whole or not at all"
    return *read(folder / "deep.exr"), np.asarray(film["color"]).astype("f8")


def check_flattens(pixels, flat):
    found = flatten(pixels)
    assert abs(found[..., 3] - flat[..., 3]).max() < 1e-5
    assert abs(found[..., :3] - flat[..., :3]).max() < 1e-4 * flat[..., :3].max()


def check_sorted(pixels):
    for samples in pixels.flat:
        begin, end = samples[:, 4], samples[:, 5]
        assert (begin <= end).all() and (end <= begin * 1.00101).all(), samples
        assert (begin[1:] > end[:-1]).all(), samples
        assert (samples[:, 3] >= 0.0).all() and (samples[:, 3] <= 1.0).all() and np.isfinite(samples).all(), samples


def everything(name, material, asset):
    return True


@pytest.mark.parametrize("settings", [{}, {"filter": "gaussian", "filter_width": 3.0}, {"integrator": "whitted", "samples": 8}])
def test_sheets_lie_at_their_depths_with_the_coverage_of_their_own(tmp_path, settings):
    _, pixels, flat = deep(finished(sheets(everything, **{"passes": PASSES, **settings})), tmp_path)
    check_flattens(pixels, flat)
    check_sorted(pixels)
    # Sheets are level, and the camera looks down from 8 m: heights are depths.
    depths = [8.0 - sheet[4] for sheet in SHEETS]
    assert all(np.isclose(sample[4], depths, rtol=2e-4).any() for samples in pixels.flat for sample in samples)
    assert max(len(samples) for samples in pixels.flat) == 4
    for name, _, _, opacity, height, _ in SHEETS:
        # Of samples, alphas times what those before them leave open are what the sheet covers.
        covered = flatten(pixels, 8.0 - height + 0.1)[..., 3] - flatten(pixels, 8.0 - height - 0.1)[..., 3]
        alone = sheets(lambda named, *_, name=name: named == name, **{"passes": ["color"], **settings})
        assert covered.max() > 0.8 * min(opacity, 0.5), name
        seen = np.asarray(finished(alone)["color"])[..., 0]
        assert abs(covered - seen).max() < 1e-4, name


def lit_room(**settings):
    """A floor under a lamp, a clear pane of half the floor, a glossy ball's worth of sheets, before a dome."""
    scene = floor_scene(**{"samples": 32, "passes": PASSES, **settings})
    small = scene.add_mesh(FLOOR * np.float32(0.2), QUAD)
    glass = scene.add_material("glass", transmission_weight=1.0, specular_roughness=0.0)
    gauze = scene.add_material("gauze", base_color=(0.9, 0.3, 0.1), geometry_opacity=0.3)
    scene.add_instance(small, [glass], transform=at(-1.5, 1.0, 0.0), name="glass")
    scene.add_instance(small, [gauze], transform=at(1.0, 1.5, 0.7), name="gauze")
    scene.add_light("dome", (20.0, 30.0, 40.0), name="sky")
    return scene


@pytest.mark.parametrize("settings", [{}, {"film_transparent": True}, {"film_transparent": False}, {"caustics": "on"}, {"noise_threshold": 0.2}])
def test_light_flattens_to_the_colour(tmp_path, settings):
    _, pixels, flat = deep(finished(lit_room(**settings)), tmp_path)
    check_flattens(pixels, flat)
    check_sorted(pixels)


def test_light_goes_to_the_surface_that_sends_it(tmp_path):
    """What is seen in front alone is the picture of a scene whose floor is black and whose gauze is lit as before."""
    scene = floor_scene(samples=64, passes=PASSES, max_bounces=0)
    gauze = scene.add_material("gauze", base_color=(0.9, 0.3, 0.1), specular_weight=0.0, geometry_opacity=0.3)
    scene.add_instance(scene.add_mesh(FLOOR * np.float32(0.2), QUAD), [gauze], transform=at(0.0, 1.0, 0.0), name="gauze")
    _, pixels, flat = deep(finished(scene), tmp_path)
    front, back = flatten(pixels, 7.5), flat - flatten(pixels, 7.5)
    # Beside the lamp, which the camera sees in the middle; metres from it, on the gauze 7 m below the camera.
    middle = (slice(18, 21), slice(12, 20))
    rows, columns = (np.arange(axis.start, axis.stop) + 0.5 - 16 for axis in middle)
    away = np.hypot(rows[:, None], columns[None]) * 2 * 7 * np.tan(np.radians(20)) / 32
    # Lambert's law under a sphere of 0.1 m and 1000 cd/m2, 1 m above.
    irradiance = (1000.0 * np.pi * 0.1**2 / (1 + away**2) ** 1.5).mean()
    assert front[middle][..., 0].mean() == pytest.approx(0.3 * 0.9 * irradiance / np.pi, rel=0.1)
    assert front[middle][..., 3].mean() == pytest.approx(0.3, abs=0.02)
    ratio = front[middle].mean((0, 1))[:3] / front[middle].mean((0, 1))[0]
    assert np.allclose(ratio, [1.0, 1 / 3, 1 / 9], rtol=1e-4)
    # The floor is grey.
    assert np.ptp(back[middle][..., :3].mean((0, 1))) < 1e-3 * flat.max()


def test_edges_are_partly_covered_and_a_sheet_laid_between_comes_out_right(tmp_path):
    """A floor and a sheet rendered apart, composited by depth, are the scene of both."""
    def scene(parts):
        made = gonio.Scene()
        made.set(width=48, height=40, samples=256, film_transparent=True, passes=PASSES)
        for height, light, corners in parts:
            glow = made.add_material("glow", base_color=(0.0, 0.0, 0.0), specular_weight=0.0, emission_color=light)
            mesh = made.add_mesh(np.array([(x, height, z) for x, z in corners], "f4"), QUAD)
            made.add_instance(mesh, [glow], name=f"at {height}")
        made.add_camera(above(8), fov=40)
        return finished(made)

    low = (0.0, (0.2, 0.5, 1.0), [(-2, -2), (1.1, -2), (1.5, 2), (-2, 2)])
    middle = (1.0, (1.0, 0.2, 0.2), [(-1.3, -1), (1.7, -0.4), (1.2, 1.3), (-0.5, 0.8)])
    high = (2.0, (0.1, 0.9, 0.1), [(-0.6, -1.6), (0.3, -1.2), (0.5, 1.4), (-0.2, 1.6)])
    layers = []
    for name, parts in (("outer", [low, high]), ("inner", [middle])):
        folder = tmp_path / name
        folder.mkdir()
        layers.append(deep(scene(parts), folder)[1])
    merged = np.empty(layers[0].shape, object)
    for place in np.ndindex(merged.shape):
        samples = np.concatenate([layer[place] for layer in layers])
        merged[place] = samples[np.argsort(samples[:, 4], kind="stable")]
    found, whole = flatten(merged), np.asarray(scene([low, middle, high])["color"])
    # Inside they agree; at edges that cross, deep pictures know how much is covered, not where in the pixel.
    error = abs(found - whole)
    assert np.median(error) < 1e-5 and error.mean() < 0.01 and error.max() < 0.3
    edges = (found[..., 3] > 0.02) & (found[..., 3] < 0.98)
    assert edges.sum() > 40


def test_the_header_says_where_the_picture_is(tmp_path):
    scene = sheets(everything, passes=PASSES, samples=1)
    scene.set(crop=(8, 4, 40, 30))
    header, pixels, flat = deep(finished(scene), tmp_path)
    assert pixels.shape == flat.shape[:2] == (26, 32)
    assert [tuple(corner) for corner in header["dataWindow"]] == [(8, 4), (39, 29)]
    assert [tuple(corner) for corner in header["displayWindow"]] == [(0, 0), (63, 47)]
    assert header["maxSamplesPerPixel"] == max(len(samples) for samples in pixels.flat)
    assert header["gonio:samples"] == "1"


def test_the_tolerance_bounds_the_samples(tmp_path):
    """A steep floor spreads over depths within each pixel."""
    def most(tolerance):
        folder = tmp_path / str(tolerance)
        folder.mkdir()
        scene = floor_scene(passes=PASSES, samples=64, deep_tolerance=tolerance)
        return max(len(samples) for samples in deep(finished(tilted(scene)), folder)[1].flat)

    def tilted(scene):
        slope = np.array([(x, y, 2.0 * y) for x, y in [(-5, -5), (5, -5), (5, 5), (-5, 5)]], "f4")
        scene.add_instance(scene.add_mesh(slope, QUAD), [scene.add_material("slope")], name="slope")
        return scene

    fine, coarse = most(1e-4), most(0.1)
    assert coarse <= 3 < fine <= 64


def test_parts_and_checkpoints_give_the_same_bytes(tmp_path):
    def written(film, name):
        film.write_deep_exr(tmp_path / name)
        return (tmp_path / name).read_bytes()

    scene = lit_room(samples=48)
    whole = written(finished(scene), "whole.exr")
    for threads in (1, 3):
        scene.set(threads=threads)
        assert written(finished(scene), "again.exr") == whole
    files = []
    for number, part in enumerate(scene.parts(3)):
        own = lit_room(samples=48)
        own.set(**part)
        with gonio.Render(own) as render:
            assert render.wait()
            files.append(tmp_path / f"part{number}")
            render.checkpoint(files[-1])
    assert written(gonio.merge(files), "merged.exr") == whole
    assert finished(lit_room(samples=48, passes=["color", "depth"]))["color"].tobytes() == finished(lit_room(samples=48))["color"].tobytes()


def test_what_has_no_depth_is_refused(tmp_path):
    with pytest.raises(gonio.SettingError, match="without the pass 'deep'"):
        finished(floor_scene()).write_deep_exr(tmp_path / "none.exr")
    for settings, problem in (({"integrator": "whitted", "antialiasing": "adaptive"}, "antialiasing"),):
        scene = floor_scene(passes=PASSES)
        scene.set(**settings)
        with pytest.raises(gonio.SettingError, match=problem):
            gonio.Render(scene)
    caught = floor_scene(passes=PASSES)
    mesh = caught.add_mesh(FLOOR, QUAD)
    caught.put_instances(mesh, [], np.array([at(0, 0.1, 0)], "f4"), visibility={"shadow_catcher": True})
    with pytest.raises(gonio.SettingError, match="shadow catchers"):
        gonio.Render(caught)
    with pytest.raises(gonio.SettingError, match="deep_tolerance"):
        floor_scene(deep_tolerance=0.0)
    assert list(tmp_path.iterdir()) == []
