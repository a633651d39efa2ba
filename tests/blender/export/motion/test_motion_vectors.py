"""The Vector pass beside Cycles': what moves, turns, changes its form, and the camera."""

import numpy as np
import pytest

KINDS = ("fan", "field", "pan", "shape", "skinned")


def vectors(path, engine):
    """The Vector pass of an engine (height, width, 4), the top row first."""
    import bpy
    import scenes

    scene = bpy.context.scene
    scene.render.engine = engine
    settings = scene.cycles
    settings.samples, settings.use_denoising, settings.use_adaptive_sampling = 64, False, False
    settings.pixel_filter_type = "BOX"
    if engine == "GONIO":
        bpy.ops.gonio.settings_from_cycles()
        scene.gonio.use_adaptive_sampling = False
    scene.view_layers[0].use_pass_vector = True
    scenes.render(path / f"{engine}.exr")
    channels = scenes.read(path / f"{engine}.exr")
    found = [next(values for name, values in channels.items() if name.endswith(f"Vector.{axis}")) for axis in "XYZW"]
    return np.stack([np.asarray(values, dtype=float) for values in found], axis=-1)


@pytest.mark.blender
@pytest.mark.parametrize("kind", KINDS)
def test_vectors_are_those_of_cycles(kind, tmp_path):
    from test_motion_beside_cycles import prepared

    scene = prepared(kind, "CENTER")
    scene.render.use_motion_blur = False
    cycles, gonio = (vectors(tmp_path, engine) for engine in ("CYCLES", "GONIO"))
    assert cycles.shape == gonio.shape and np.abs(cycles).max() > 2.0
    off = np.abs(cycles - gonio).max(axis=-1)
    # Pixels on edges are means over other samples.
    assert np.median(off) < 0.01, np.median(off)
    assert np.quantile(off, 0.8) < 0.02, np.quantile(off, 0.8)
    assert np.abs(cycles - gonio).mean() < 0.05 * np.abs(cycles).mean() + 0.05


@pytest.mark.blender
def test_there_are_none_where_things_are_blurred(tmp_path):
    from test_motion_beside_cycles import prepared

    prepared("pan", "CENTER")
    assert not vectors(tmp_path, "CYCLES").any() and not vectors(tmp_path, "GONIO").any()
