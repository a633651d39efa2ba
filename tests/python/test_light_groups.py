"""Light groups: what each brings sums up to the colour, and relighting is rendering with other lights."""

import subprocess
import sys

import gonio
import numpy as np
import pytest
from gonio.medium import medium, volume_material
from small_scenes import block, closure

GROUPS = ["key", "panel", "sky", "other"]


def scene(key: float = 1.0, sky: float = 1.0, groups=GROUPS) -> gonio.Scene:
    """A box on a floor under a lamp, an emissive panel, a dome and a sun."""
    made = gonio.Scene()
    quad = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
    mesh = made.add_mesh(quad, np.array([[0, 1, 2], [0, 2, 3]], np.int32))
    floor = made.add_material(base_color=(0.6, 0.5, 0.4), specular_roughness=0.2)
    mirror = made.add_material(metalness=1.0, base_color=0.9, specular_roughness=0.0)
    made.add_instance(mesh, [floor], transform=np.diag([4, 4, 1, 1]).tolist())
    made.add_instance(mesh, [mirror], transform=[[0.5, 0, 0, -1], [0, 0, 1, 1.5], [0, 0.5, 0, 0.5], [0, 0, 0, 1]])
    panel = made.add_material(base_color=0.1, emission_color=(40.0, 20.0, 10.0))
    place = np.array([[[0.2, 0, 0, 1.2], [0, -0.2, 0, 0], [0, 0, -1, 0.8], [0, 0, 0, 1]]], np.float32)
    made.put_instances(mesh, [panel], place, light_group="panel")
    above = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]]
    made.add_light("sphere", (30.0 * key,) * 3, radius=0.2, transform=above, group="key", name="key")
    made.add_light("dome", (0.2 * sky, 0.3 * sky, 0.5 * sky), group="sky", name="sky")
    made.add_light("distant", (1.0, 0.9, 0.8), transform=[[1, 0, 0, 0], [0, 0.8, -0.6, 0], [0, 0.6, 0.8, 0], [0, 0, 0, 1]])
    made.add_camera([[1, 0, 0, 0], [0, 0.6, -0.8, -4], [0, 0.8, 0.6, 3], [0, 0, 0, 1]], fov=40)
    made.set(width=48, height=48, samples=16, passes=["color", "luminance", *(f"lightgroup:{name}" for name in groups)])
    return made


def film(made: gonio.Scene) -> gonio.Film:
    with gonio.Render(made) as rendering:
        rendering.wait()
        return rendering.film()


def channels(found: gonio.Film, name: str) -> np.ndarray:
    return np.asarray(found[name])[:, :, :3].astype(np.float64)


def test_groups_sum_up_to_the_colour():
    made = scene()
    assert made.light_groups == ["key", "sky", "panel", "other"]
    found = film(made)
    parts = [channels(found, f"lightgroup:{name}") for name in GROUPS]
    assert all(part.max() > 0 for part in parts)
    colour = channels(found, "color")
    # Sums of some hundred single-precision terms.
    assert np.abs(sum(parts) - colour).max() <= 1e-5 * colour.max()


def test_a_group_is_what_its_lights_bring():
    both, brighter = film(scene()), film(scene(key=3.0))
    assert channels(both, "lightgroup:key").mean() * 3 == pytest.approx(channels(brighter, "lightgroup:key").mean(), rel=0.05)
    assert channels(both, "lightgroup:sky").mean() == pytest.approx(channels(brighter, "lightgroup:sky").mean(), rel=0.05)


def test_groups_that_no_pass_shows_are_left_out():
    found = film(scene(groups=["sky", "nobody"]))
    assert channels(found, "lightgroup:nobody").max() == 0
    assert channels(found, "lightgroup:sky").max() > 0


def test_relight(tmp_path):
    found = film(scene())
    found.write_exr(str(tmp_path / "in.exr"))
    out = tmp_path / "out.exr"
    command = [sys.executable, "-m", "gonio.cli", "relight", str(tmp_path / "in.exr"), "--group", "key=0.25,2700", "--group", "sky=0"]
    subprocess.run([*command, "-o", str(out)], check=True, capture_output=True)
    openexr = pytest.importorskip("OpenEXR")
    written = {name: channel.pixels for name, channel in openexr.File(str(out), separate_channels=True).channels().items()}
    warm = np.array([1.9353238, 0.80356574, 0.19168955])
    expected = 0.25 * warm * channels(found, "lightgroup:key") + channels(found, "lightgroup:panel") + channels(found, "lightgroup:other")
    for k, name in enumerate("RGB"):
        assert np.allclose(written[name], expected[:, :, k], rtol=1e-3, atol=1e-5)
    assert np.allclose(written["Luminance"], expected @ [0.2126, 0.7152, 0.0722], rtol=1e-3, atol=1e-5)
    wrong = subprocess.run([*command[:5], "--group", "nobody=1", "-o", str(out)], capture_output=True, text=True)
    assert wrong.returncode == 1 and "nobody" in wrong.stderr and "key" in wrong.stderr


def smoke_and_lamps(group, passes=()):
    """Fire of a grid, an even body that shines, and haze, each alone or together; the first two in groups of their own."""
    made = gonio.Scene()
    made.add_camera(gonio.look_at((0, 0, 6), (0, 0, 0), (0, 1, 0)), fov=40)
    made.set(width=16, height=16, samples=256, filter="box", caustics="off", max_bounces=4, passes=["color", *passes])
    clear = closure("Transparent", base_color=1.0)
    body = medium(absorption=0.4, scattering=0.3, emission=1.0 if group in ("body", None) else 0.0)
    glow = made.put_material({"origin": "body", "closures": [clear], "medium": body})
    made.put_instances(made.add_mesh(*block((-2, -1, -1), (0, 1, 1))), [glow], np.eye(4, dtype="f4")[None], light_group="body")
    heat = 2.0 if group in ("fire", None) else 0.0
    voxels = {"columns": [[0.5, 0, 0], [0, 0.5, 0], [0, 0, 0.5], [-0.5, -0.75, -0.75]]}
    fire = made.put_field({"origin": "fire", "to_world": voxels}, density=np.ones((4, 4, 4), "f4"))
    mesh, place = made.put_field_box(fire)
    inside = {**medium(absorption=0.5, scattering=0.5, emission=heat), "field": fire}
    made.put_instances(mesh, [made.put_material(volume_material("fire", inside))], np.array([place], "f4"), light_group="fire")
    made.put_atmosphere(medium(absorption=0.02, scattering=0.02, emission=0.05 if group in ("other", None) else 0.0))
    return film(made)


def test_what_media_send_is_in_their_objects_groups():
    """Bodies that overlap: each group is what a render has in which the others are dark, and all of them are the colour."""
    names = ["body", "fire", "other"]
    whole = smoke_and_lamps(None, [f"lightgroup:{name}" for name in names])
    parts = {name: channels(whole, f"lightgroup:{name}") for name in names}
    assert sum(parts.values()) == pytest.approx(channels(whole, "color")[..., :3], rel=1e-4, abs=1e-5)
    for name in names:
        alone = channels(smoke_and_lamps(name), "color")[..., :3]
        assert parts[name].mean() == pytest.approx(alone.mean(), rel=0.02) and parts[name].mean() > 0.01, name
