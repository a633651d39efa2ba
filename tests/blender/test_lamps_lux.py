"""100 lm from Blender's lamps: 7.96 lx at 1 m from an isotropic source, 31.83 lx straight on before a Lambertian one."""

from pathlib import Path

import pytest

K = 177.83


@pytest.mark.blender
@pytest.mark.validate
def test_lux_of_100_lumens(tmp_path: Path):
    import math

    import bpy
    import figures
    import numpy
    import scenes

    scene = scenes.lit_floor(samples=64)
    # A centimetre straight below the lamp.
    scene.camera.data.ortho_scale = 0.01
    scene.view_layers[0].gonio.use_pass_illuminance = True
    lamp = next(thing for thing in scene.objects if thing.type == "LIGHT")

    def check(case, expected):
        scenes.render(tmp_path / "a.exr")
        found = scenes.read(tmp_path / "a.exr")["ViewLayer.Illuminance.X"].astype(float)
        off = float(numpy.abs(found / expected - 1).max())
        title = f"Blender {bpy.app.version_string[:3]}, {case}: {expected:.2f} lx"
        figures.check(figures.Row("100 lm at 1 m", title, "Φ / 4π or Φ / π", found.size, off, 1e-3))

    def cases(unit, state):
        lamp.data.type = "POINT"
        for radius in (0.0, 0.01):
            lamp.data.shadow_soft_size = radius
            state()
            check(f"point lamp with a radius of {radius:g} m, {unit}", 100 / (4 * math.pi))
        lamp.data.type = "AREA"
        for shape in ("SQUARE", "DISK"):
            lamp.data.shape, lamp.data.size = shape, 0.01
            state()
            check(f"area lamp of 1 cm, {shape.lower()}, {unit}", 100 / math.pi)

    def watts():
        lamp.data.energy = 100 / K

    def lumens():
        lamp.data.gonio.use_photometry = True
        lamp.data.gonio.unit, lamp.data.gonio.quantity = "LUMEN", 100.0

    cases("its power in W", watts)
    if hasattr(lamp.data.gonio, "use_photometry"):
        cases("its flux in lm", lumens)
