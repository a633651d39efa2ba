"""100 lm from USD stages: 7.96 lx at 1 m from an isotropic source, 31.83 lx straight on before a Lambertian one."""

import math

import confidence
import gonio
import numpy
import pytest

pytestmark = pytest.mark.validate

SECTION = "100 lm at 1 m"
ISOTROPIC, LAMBERTIAN = 100 / (4 * math.pi), 100 / math.pi
STAGE = """#usda 1.0
(
    metersPerUnit = {metres}
    upAxis = "Z"
)
def Mesh "Floor"
{{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-{side}, -{side}, 0), ({side}, -{side}, 0), ({side}, {side}, 0), (-{side}, {side}, 0)]
    uniform token subdivisionScheme = "none"
}}
def Camera "Camera"
{{
    token projection = "orthographic"
    float horizontalAperture = 0.01
    float verticalAperture = 0.01
    float2 clippingRange = (0.01, 1000)
    double3 xformOp:translate = (0, 0, {near})
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
def {light} "Lamp"
{{
    {inputs}
    double3 xformOp:translate = (0, 0, {height})
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
"""
# Prim type, its attributes in metres, and its area and lux: intensity is 1 nit on a surface of this area sends π A lm.
LIGHTS = {
    "SphereLight of 5 cm": ("SphereLight", {"radius": 0.05}, 4 * math.pi * 0.05**2, ISOTROPIC),
    "DiskLight of 5 mm": ("DiskLight", {"radius": 0.005}, math.pi * 0.005**2, LAMBERTIAN),
    "RectLight of 1 cm × 1 cm": ("RectLight", {"width": 0.01, "height": 0.01}, 0.01**2, LAMBERTIAN),
}


def strength(area, metres, stated):
    """Attributes of 100 lm on a surface of an area in m²."""
    nits = 100 / (math.pi * area)
    if stated == "in lm":
        return ["double gonio:photometry:quantity = 100", 'token gonio:photometry:unit = "lm"']
    if stated == "normalized":
        # The intensity is divided by the area in the stage's unit.
        return [f"float inputs:intensity = {nits * area / metres**2!r}", "bool inputs:normalize = 1"]
    return [f"float inputs:intensity = {nits!r}"]


def stage(tmp_path, light, sizes, area, metres, stated):
    """A lamp of 100 lm, 1 m over a floor, in a stage's own unit."""
    inputs = [f"float inputs:{name} = {value / metres!r}" for name, value in sizes.items()] + strength(area, metres, stated)
    path = tmp_path / "stage.usda"
    text = STAGE.format(metres=metres, side=5 / metres, near=0.5 / metres, height=1 / metres, light=light, inputs="\n    ".join(inputs))
    path.write_text(text)
    return path


@pytest.mark.parametrize("stated", ["in nits", "normalized", "in lm"])
@pytest.mark.parametrize("metres", [1.0, 0.01])
@pytest.mark.parametrize("name", LIGHTS)
def test_a_stage(tmp_path, name, metres, stated):
    kind, sizes, area, expected = LIGHTS[name]
    scene = gonio.load_usd(str(stage(tmp_path, kind, sizes, area, metres, stated)))
    scene.set(width=4, height=4, samples=64, filter="box", filter_width=1.0, passes=["illuminance"], max_bounces=0)
    with gonio.Render(scene) as render:
        assert render.wait()
        found = numpy.asarray(render.film()["illuminance"])[..., 0].astype(float)
    case = f"USD, {name}, {metres:g} m a unit, {stated}: {expected:.2f} lx"
    confidence.hold_exact(SECTION, case, "Φ / 4π or Φ / π", found, numpy.full(found.shape, expected), 1e-3)
