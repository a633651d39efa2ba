"""Light in IFC building models: luminaires, panes and rooms, against closed forms."""

import math

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")
pytest.importorskip("ifcopenshell", reason="IFC models need ifcopenshell")

from gonio.ifc.stage import build  # noqa: E402
from ifc_models import Building, moved  # noqa: E402

# Angles of tables in degrees, and Lambert's law by them.
ANGLES = list(range(0, 91, 5))
COSINE = [math.cos(math.radians(angle)) if angle < 90 else 0.0 for angle in ANGLES]


def cosine_flux():
    """2 π ∫ I sin γ dγ of that table, straight between its angles; some 0.1 % below π."""
    gamma = (np.arange(90_000) + 0.5) / 1000
    return float(2 * math.pi * (np.interp(gamma, ANGLES, COSINE) * np.sin(np.radians(gamma))).sum() * math.radians(1e-3))


FLUX = cosine_flux()
UP = (0, 0, 1)


def written(building, folder):
    """The scene of a building, and the notes."""
    building.save(folder / "model.ifc")
    notes = build(folder / "model.ifc", folder / "model.usda")
    return gonio.load_usd(folder / "model.usda", camera_light=False), "\n".join(notes)


def lux(scene, *places, samples=1024):
    """Illuminances at places with normals."""
    for place, normal in places:
        scene.add_meter(place, normal=normal)
    return [float(meter) for meter in gonio.measure(scene, samples=samples).meters]


def dark_box(building):
    """Something to be seen, far below."""
    building.block("IfcSlab", "Ground", (-1, -1, -9.2), (1, 1, -9), building.style("Black", (0, 0, 0)))


@pytest.mark.parametrize("unit", ["metre", "millimetre", "foot"])
@pytest.mark.parametrize(
    "intensity, lumens, flux",
    [
        # Candela of 1000 lm; per lumen; per 1000 lumens with a light output ratio of 80 %; relative.
        (1000 / FLUX, 1000.0, 1000.0),
        (1 / FLUX, 1000.0, 1000.0),
        (800 / FLUX, 2500.0, 2000.0),
        (7.0, 3000.0, 3000.0),
        (500 / FLUX, 0.0, 500.0),
    ],
)
def test_tables_of_intensities(tmp_path, unit, intensity, lumens, flux):
    building = Building(unit=unit)
    dark_box(building)
    table = building.table([0], ANGLES, [[intensity * x for x in COSINE]], unit=math.radians(1))
    building.fixture("Lamp", (1, 2, 3), building.goniometric(table, lumens))
    scene, notes = written(building, tmp_path)
    # E = I / h² straight below, I cos γ · cos γ / r² aside by the height.
    assert lux(scene, ((1, 2, 1), UP), ((3, 2, 1), UP)) == pytest.approx([flux / FLUX / 4, flux / FLUX / 2 / 8], rel=2e-3)
    assert f"{flux:.4g} lm" in notes


def test_turned_sources_in_placed_fixtures_with_degrees(tmp_path):
    building = Building()
    dark_box(building)
    # C0 has 100 cd, C90 200 cd, C180 300 cd; degrees, though the unit is the radian.
    planes = [[100.0] * 19, [200.0] * 19, [300.0] * 19, [200.0] * 19]
    table = building.table([0, 90, 180, 270], ANGLES, planes)
    axes = building.axes((0, 0, -0.5), z=(0, 1, 0), x=(0, 0, 1))
    building.fixture("Spot", None, building.goniometric(table, axes=axes), matrix=moved((1, 1, 3)))
    scene, _ = written(building, tmp_path)
    # At (1, 1, 2.5); nadir is -y, C0 is +z, C90 is +x.
    places = [((1, 0, 2.5 + x), (0, 1, 0)) for x in (0.5, -0.5)] + [((1.5, 0, 2.5), (0, 1, 0))]
    cube = (1 + 0.25) ** -1.5
    assert lux(scene, *places) == pytest.approx([100 * cube, 300 * cube, 200 * cube], rel=2e-3)


def test_files_beside_the_model_and_a_body_about_the_lamp(tmp_path):
    (tmp_path / "even.ies").write_text("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 10\n0 90 180\n0\n100 100 100\n")
    even = 100 * 4 * math.pi
    for unit, name in (("metre", "even.ies"), ("foot", "C:\\Leuchten\\even.ies")):
        building = Building(unit=unit)
        building.fixture("Own", (0, 0, 3), building.goniometric(building.file(name), even), body=((-0.3, -0.3, -0.1), (0.3, 0.3, 0.1)))
        building.fixture("More", (50, 0, 3), building.goniometric(building.file(name), 2 * even, 2700.0), body=((-0.3, -0.3, -0.1), (0.3, 0.3, 0.1)))
        scene, notes = written(building, tmp_path)
        assert lux(scene, ((0, 0, 1), UP), ((50, 0, 1), UP)) == pytest.approx([25, 50], rel=1e-2)
        told = [line for line in notes.split("\n") if "the flux of" in line]
        assert len(told) == 1 and f"{2 * even:g} lm" in told[0] and "'More'" in told[0]


def test_lamps_with_a_flux_alone(tmp_path):
    building = Building()
    dark_box(building)
    white = building.colour((1, 1, 1))
    point = building.model.create_entity("IfcLightSourcePositional", None, white, None, None, building.point((0, 0, 0)), 1.0, 1.0, 0.0, 0.0)
    spot = building.model.create_entity(
        "IfcLightSourceSpot", None, white, None, None, building.point((0, 0, 0)), 1.0, 1.0, 0.0, 0.0,
        building.direction((0, 0, -1)), None, math.radians(30), math.radians(30),
    )  # fmt: skip
    for name, x, source in (("Bulb", 0, point), ("Spot", 100, spot)):
        lamp = building.fixture(name, (x, 0, 2), source)
        building.properties(lamp, "Pset_LampTypeCommon", ContributedLuminousFlux=600.0)
        building.properties(lamp, "Pset_LightFixtureTypeCommon", NumberOfSources=2, MaintenanceFactor=0.8)
    scene, notes = written(building, tmp_path)
    cone = 2 * math.pi * (1 - math.cos(math.radians(30)))
    expected = [960 / (4 * math.pi) / 4, 960 / cone / 4, 0.0]
    assert lux(scene, ((0, 0, 0), UP), ((100, 0, 0), UP), ((102, 0, 0), UP)) == pytest.approx(expected, rel=1e-2, abs=0.05)
    assert "maintenance factor 0.8" in notes


def test_lamps_in_fixtures(tmp_path):
    building = Building()
    housing = building.fixture("Housing", (0, 0, 3), body=((-0.3, -0.3, -0.1), (0.3, 0.3, 0.1)))
    building.properties(housing, "Pset_LightFixtureTypeCommon", MaintenanceFactor=0.5)
    even = building.table([0], [0, 90, 180], [[100, 100, 100]])
    lamp = building.new("IfcLamp", "Lamp")
    building.place(lamp, moved((0, 0, 3)))
    building.show(lamp, [building.goniometric(even)], "LightSource", "Lighting")
    building.model.create_entity("IfcRelAggregates", lamp.GlobalId[::-1], None, None, None, housing, [lamp])
    # Panes, by which meters ask for light paths.
    building.block("IfcWindow", "Window", (2, -1, 0), (2.01, 1, 2))
    scene, notes = written(building, tmp_path)
    assert lux(scene, ((0, 0, 1), UP)) == pytest.approx([12.5], rel=2e-2)
    assert "no photometry" not in notes and "maintenance factor 0.5" in notes


def test_what_gives_no_light_is_told(tmp_path):
    building = Building()
    dark_box(building)
    white = building.colour((1, 1, 1))
    address = building.goniometric(building.file("https://example.org/lamp.ies"))
    lost = building.goniometric(building.file("lost.ldt"))
    broken = building.goniometric(building.table([0], [0, 90], [[-1, 1]]))
    sources = {
        "Address": [address],
        "Lost": [lost],
        "Broken": [broken],
        "Ambient": [building.model.create_entity("IfcLightSourceAmbient", None, white)],
        "Sun": [building.model.create_entity("IfcLightSourceDirectional", None, white, None, None, building.direction((0, 0, -1)))],
        "Bulb": [building.model.create_entity("IfcLightSourcePositional", None, white, None, None, building.point((0, 0, 0)), 1.0, 1.0, 0.0, 0.0)],
        "Bare": [],
    }
    lamps = {name: building.fixture(name, (0, 0, 2), *found) for name, found in sources.items()}
    building.properties(lamps["Bare"], "Pset_LightFixtureTypeCommon", TotalWattage=36.0)
    scene, notes = written(building, tmp_path)
    assert lux(scene, ((0, 0, 0), UP), samples=16) == [0.0]
    lines = notes.split("\n")
    words = {
        "Address": "not fetched", "Lost": "not beside the model", "Broken": "intensities are no numbers", "Ambient": "IfcLightSourceAmbient",
        "Sun": "IfcLightSourceDirectional", "Bulb": "does not say its luminous flux", "Bare": "36 W",
    }  # fmt: skip
    for name, word in words.items():
        assert any(word in line and lamps[name].GlobalId in line for line in lines), (name, notes)


def test_fixtures_of_ifc2x3_and_files_among_properties(tmp_path):
    (tmp_path / "even.ies").write_text("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 10\n0 90 180\n0\n100 100 100\n")
    building = Building("IFC2X3", "foot")
    dark_box(building)
    kind = building.new("IfcLightFixtureType", "Downlight", PredefinedType="POINTSOURCE")
    lamp = building.fixture("Downlight 1", (0, 0, 2), kind="IfcFlowTerminal")
    building.model.create_entity("IfcRelDefinesByType", lamp.GlobalId[::-1], lamp.OwnerHistory, None, None, [lamp], kind)
    building.properties(lamp, "Photometrics", **{"Photometric Web File": "even.ies"})
    scene, notes = written(building, tmp_path)
    assert lux(scene, ((0, 0, 0), UP)) == pytest.approx([25], rel=1e-2)
    assert "photometry by a property" in notes


def glazed_roof(pane=None, **attributes):
    """A black floor and roof of 1 km by 1 km, a hole of 1 m by 1 m in this, and a window in the hole."""
    building = Building()
    building.block("IfcSlab", "Floor", (-500, -500, -0.2), (500, 500, -0.1), building.style("Black", (0, 0, 0)))
    roof = building.block("IfcSlab", "Roof", (-500, -500, 3), (500, 500, 3.001), building.style("Black", (0, 0, 0)))
    opening = building.hole(roof, (-0.5, -0.5, 2.9), (0.5, 0.5, 3.2))
    window = None
    if pane:
        window = pane(building)
        building.model.create_entity("IfcRelFillsElement", roof.GlobalId[::-1], None, None, None, opening, window)
    return building, window


def window(style=None, bars=0.0):
    """A pane of 12 mm, or with bars of this width on two sides."""

    def made(building):
        painted = building.style(*style) if style else None
        found = building.block("IfcWindow", "Window", (-0.5, -0.5, 3.002), (0.5, 0.5, 3.014), painted)
        if bars:
            sides = [building.solid((bars, 1, 0.06), (x, 0, 0)) for x in (-0.05 - bars, 1.05)]
            solids = [*found.Representation.Representations[0].Items, *sides]
            found.Representation.Representations[0].Items = solids
        return found

    return made


def through(building, folder):
    """Illuminance 3 m below an even sky through the hole."""
    scene, notes = written(building, folder)
    scene.add_light("dome", (1000.0, 1000.0, 1000.0))
    return lux(scene, ((0, 0, 0), UP), samples=1 << 17)[0], notes


@pytest.mark.parametrize(
    "pane, properties, transmittance, words",
    [
        (window(("Clear", (0.5, 0.7, 0.9), 0.8)), {}, 0.8, "transmit 0.8"),
        (window(("Clearest", (1, 1, 1), 0.97)), {}, 0.97, "transmit 0.97"),
        (window(("Glas", (0.2, 0.9, 0.3))), {}, 0.64, "does not say how transparent"),
        (window(), {}, 0.64, "glass 0.64"),
        (window(bars=0.05), {}, 0.64, "element 0.5, glass 0.64"),
        (window(("Clear", (1, 1, 1), 0.8)), {"VisibleLightTransmittance": 0.55}, 0.55, ""),
    ],
)
def test_panes_pass_what_they_should(tmp_path, pane, properties, transmittance, words):
    open_sky, _ = through(glazed_roof()[0], tmp_path)
    # The hole is seen within 14° of its normal, where a pane's transmittance is that of normal incidence to 0.3 %.
    assert open_sky == pytest.approx(1000.0 * hole_factor(0.5, 3.0), rel=5e-3)
    building, found = glazed_roof(pane)
    if properties:
        building.properties(found, "Pset_DoorWindowGlazingType", **properties)
    glazed, notes = through(building, tmp_path)
    assert glazed / open_sky == pytest.approx(transmittance, rel=1e-2)
    assert words in notes


def hole_factor(half, height):
    """∫ cos θ dω of a square hole straight above."""
    steps = (np.arange(400) + 0.5) / 400 * 2 * half - half
    x, y = np.meshgrid(steps, steps)
    return float((height**2 / (x**2 + y**2 + height**2) ** 2).sum() * (2 * half / 400) ** 2)


def test_rooms_are_grids(tmp_path):
    building = Building(unit="millimetre")
    dark_box(building)
    building.block("IfcSpace", "101", (0, 0, 0), (6, 4, 3), LongName="Office")
    building.block("IfcSpace", "102", (0, 10, 0), (20, 10.8, 3), LongName="Duct")
    ell = building.new("IfcSpace", "103", LongName="Hall")
    building.show(ell, [building.prism([(0, 0), (8, 0), (8, 3), (3, 3), (3, 8), (0, 8)], 3.0)])
    turned = np.array([[0.6, -0.8, 0, 20], [0.8, 0.6, 0, 20], [0, 0, 1, 1], [0, 0, 0, 1]])
    building.place(ell, turned)
    building.model.by_type("IfcRelAggregates")[-1].RelatedObjects = [*building.model.by_type("IfcRelAggregates")[-1].RelatedObjects, ell]
    scene, _ = written(building, tmp_path)
    grids = {grid.name.split("/")[-1]: grid for grid in gonio.measure(scene, samples=16).grids}
    assert set(grids) == {"Office_101", "Duct_102", "Hall_103"}
    assert [grids[name].area for name in sorted(grids)] == pytest.approx([16.0, 39.0, 24.0], rel=1e-4)
    # EN 12464-1 leaves out half a metre, or 15 % of the narrower side.
    office = np.asarray(grids["Office_101"].positions)
    assert office[:, 2] == pytest.approx(0.75) and (office[:, 0].min() >= 0.5, office[:, 1].max() <= 3.5) == (True, True)
    duct = np.asarray(grids["Duct_102"].positions)
    assert len(duct) > 4 and (duct[:, 1] >= 10.12 - 1e-6).all() and (duct[:, 1] <= 10.68 + 1e-6).all()
    hall = np.asarray(grids["Hall_103"].positions)
    local = (hall[np.isfinite(hall).all(axis=1)] - turned[:3, 3]) @ turned[:3, :3]
    margin = 0.45 - 1e-6
    within = ((local[:, :2] >= margin) & (local[:, :2] <= 8 - margin)).all(axis=1)
    arms = (local[:, :2] <= 3 - margin).any(axis=1)
    assert len(local) > 20 and (within & arms).all() and local[:, 2] == pytest.approx(0.75)
