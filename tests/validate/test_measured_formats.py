"""Measured materials against readings of their files that share no code with ours, at 100,000 pairs of directions."""

import math
import xml.etree.ElementTree as ET

import gonio
import numpy
import pytest
from measured_files import ggx, merl_bytes, merl_centres, merl_directions, random_directions

pytestmark = [pytest.mark.validate, pytest.mark.timeout(1800)]

PAIRS = 100_000
MERL_BINS = (90, 90, 180)
KLEMS_FULL = [(0, 5, 1), (5, 15, 8), (15, 25, 16), (25, 35, 20), (35, 45, 24), (45, 55, 24), (55, 65, 24), (65, 75, 16), (75, 90, 12)]


@pytest.fixture(scope="module")
def merl():
    """A file as large as the database's, its cells, and our reading of it."""
    data, cells = merl_bytes(MERL_BINS, lambda wi, wo: ggx(wi, wo, alpha=0.2, diffuse=0.1))
    assert len(data) == 34_992_012
    return gonio.MeasuredBsdf.from_bytes(data, "made.binary"), cells


def test_merl_is_exact_at_centres_of_cells(merl):
    bsdf, cells = merl
    valid = numpy.argwhere(~numpy.isnan(cells[..., 0]))
    chosen = valid[numpy.random.default_rng(1).integers(0, len(valid), PAIRS)]
    centres = merl_centres(MERL_BINS)
    wi, wo = merl_directions(*(centres[axis][chosen[:, axis]] for axis in range(3)))
    # Nearer to the horizon angles of directions have too few digits left to say which cell it is.
    clear = (wi[:, 2] > 0.01) & (wo[:, 2] > 0.01)
    found = numpy.asarray(bsdf.eval(wi, wo))[clear] / wi[clear, 2:]
    difference = numpy.abs(found / cells[tuple(chosen[clear].T)] - 1.0)
    print(f"{clear.sum()} cells, largest difference {difference.max():.1e}")
    assert difference.max() < 1e-5


def half_difference(wi, wo):
    """θh, θd and φd of directions, by turning the half vector to the pole."""
    half = wi + wo
    half /= numpy.linalg.norm(half, axis=1, keepdims=True)
    theta, phi = numpy.arccos(numpy.clip(half[:, 2], -1, 1)), numpy.arctan2(half[:, 1], half[:, 0])
    x = numpy.cos(phi) * wi[:, 0] + numpy.sin(phi) * wi[:, 1]
    y = -numpy.sin(phi) * wi[:, 0] + numpy.cos(phi) * wi[:, 1]
    turned = numpy.stack(
        [numpy.cos(theta) * x - numpy.sin(theta) * wi[:, 2], y, numpy.sin(theta) * x + numpy.cos(theta) * wi[:, 2]], axis=1
    )
    return theta, numpy.arccos(numpy.clip(turned[:, 2], -1, 1)), numpy.arctan2(turned[:, 1], turned[:, 0]) % numpy.pi


def trilinear(cells, place, centres):
    """Cells without a value left out, the other weights scaled up; the last axis goes round."""
    below, share = [], []
    for axis in range(3):
        knots = centres[axis]
        if axis == 2:
            step = knots[1] - knots[0]
            position = (place[axis] - knots[0]) / step
            low = numpy.floor(position).astype(int)
            below.append((low % len(knots), (low + 1) % len(knots)))
            share.append(position - low)
        else:
            low = numpy.clip(numpy.searchsorted(knots, place[axis], side="right") - 1, 0, len(knots) - 2)
            below.append((low, low + 1))
            share.append(numpy.clip((place[axis] - knots[low]) / (knots[low + 1] - knots[low]), 0.0, 1.0))
    total, weights = 0.0, 0.0
    for corner in range(8):
        sides = [corner >> axis & 1 for axis in range(3)]
        weight = numpy.prod([share[axis] if sides[axis] else 1.0 - share[axis] for axis in range(3)], axis=0)
        value = cells[tuple(below[axis][sides[axis]] for axis in range(3))]
        valid = ~numpy.isnan(value[:, 0])
        total = total + numpy.where(valid[:, None], weight[:, None] * numpy.nan_to_num(value), 0.0)
        weights = weights + numpy.where(valid, weight, 0.0)
    return total / numpy.maximum(weights, 1e-12)[:, None], weights


def test_merl_is_linear_between_centres(merl):
    bsdf, cells = merl
    wi, wo = random_directions(PAIRS, 2), random_directions(PAIRS, 3)
    expected, weights = trilinear(cells, half_difference(wi, wo), merl_centres(MERL_BINS))
    found = numpy.asarray(bsdf.eval(wi, wo)) / wi[:, 2:]
    # Where hardly a neighbour has a value rounding decides which.
    sure = weights > 1e-3
    difference = numpy.abs(found[sure] / expected[sure] - 1.0)
    print(f"{sure.mean():.2%} compared, largest difference {difference.max():.1e}")
    assert sure.mean() > 0.99 and difference.max() < 1e-4


def klems():
    """Middles of the patches of Klems' full basis, (145, 3), and their projected solid angles."""
    middles, areas = [], []
    for low, high, count in KLEMS_FULL:
        theta = math.radians(0.5 * (low + high)) if low else 0.0
        for i in range(count):
            phi = 2.0 * math.pi * i / count
            middles.append((math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta)))
            areas.append(math.pi * (math.sin(math.radians(high)) ** 2 - math.sin(math.radians(low)) ** 2) / count)
    return numpy.array(middles), numpy.array(areas)


def test_klems_matrices_have_their_files_values_and_totals(shared):
    path = shared("bsdf", "klems_aniso_high.xml")
    bsdf, (middles, areas) = gonio.MeasuredBsdf.from_file(path), klems()
    assert areas.sum() == pytest.approx(math.pi)
    blocks, compared = ET.parse(path).getroot().findall(".//{*}WavelengthData"), 0
    # WINDOW's front is our back; incident patches are numbered by where light goes to, outgoing ones too.
    sides = {"Transmission Front": (-1, 1), "Transmission Back": (1, -1), "Reflection Front": (-1, -1), "Reflection Back": (1, 1)}
    for block in blocks:
        band, data = block.findtext("{*}Wavelength"), block.find("{*}WavelengthDataBlock")
        direction = data.findtext("{*}WavelengthDataDirection")
        if band != "Visible" or direction not in sides:
            continue
        matrix = numpy.array(data.findtext("{*}ScatteringData").replace(",", " ").split(), float).reshape(145, 145)
        light, view = ([1, 1, side] * middles for side in sides[direction])
        light = [-1, -1, 1] * light
        # Columns are light.
        wi, wo = numpy.tile(light, (145, 1)), numpy.repeat(view, 145, axis=0)
        found = numpy.asarray(bsdf.eval(wi, wo)).reshape(145, 145, -1)[..., 0] / numpy.abs(light[:, 2])
        assert found == pytest.approx(matrix, rel=1e-5, abs=1e-9), direction
        totals = areas @ found
        assert totals == pytest.approx(areas @ matrix, rel=1e-5)
        print(f"{direction}: totals {totals.min():.4f} to {totals.max():.4f}")
        compared += 1
    assert compared >= 3


def concentric(s):
    """Shirley and Chiu's square to the disk, (N, 2)."""
    a, b = (2.0 * s - 1.0).T
    with numpy.errstate(all="ignore"):
        wide = numpy.abs(a) > numpy.abs(b)
        radius = numpy.where(wide, a, b)
        phi = numpy.where(wide, numpy.pi / 4 * b / a, numpy.pi / 2 - numpy.pi / 4 * a / b)
    phi = numpy.nan_to_num(phi)
    return numpy.stack([radius * numpy.cos(phi), radius * numpy.sin(phi)], axis=1)


def tensor_tree_xml(values, rank):
    """A file with one tree of one leaf: reflection at the inside, our front."""
    structure, text = f"TensorTree{rank}", " ".join(map(repr, values.ravel().tolist()))
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<WindowElement><Optical><Layer><DataDefinition><IncidentDataStructure>{structure}</IncidentDataStructure></DataDefinition>
<WavelengthData><Wavelength unit="Integral">Visible</Wavelength><WavelengthDataBlock>
<WavelengthDataDirection>Reflection Back</WavelengthDataDirection><AngleBasis>LBNL/Shirley-Chiu</AngleBasis>
<ScatteringDataType>BRDF</ScatteringDataType><ScatteringData>{{ {text} }}</ScatteringData>
</WavelengthDataBlock></WavelengthData></Layer></Optical></WindowElement>"""


def on_sphere(disk):
    """Directions above points of the disk."""
    return numpy.column_stack([disk, numpy.sqrt(numpy.maximum(1.0 - (disk**2).sum(axis=1), 1e-12))])


def test_tensor_trees_have_their_cells_and_totals():
    side, rng = 16, numpy.random.default_rng(4)
    values = rng.random((side,) * 4) * 0.3
    bsdf = gonio.MeasuredBsdf.from_bytes(tensor_tree_xml(values, 4).encode(), "tree.xml")
    assert not bsdf.isotropic
    cells = rng.integers(0, side, (PAIRS, 4))
    # Inside of cells, and not right at a diagonal, where the map's two halves meet.
    place = (cells + rng.uniform(0.05, 0.95, cells.shape)) / side
    wi, wo = on_sphere(-concentric(place[:, :2])), on_sphere(concentric(place[:, 2:]))
    found = numpy.asarray(bsdf.eval(wi, wo))[:, 0] / wi[:, 2]
    assert found == pytest.approx(values[tuple(cells.T)].astype("f4"), rel=1e-6)
    # Equal areas of the square are equal projected solid angles: a total is π times the mean of a row.
    middles = (numpy.stack(numpy.meshgrid(numpy.arange(side), numpy.arange(side), indexing="ij"), axis=-1).reshape(-1, 2) + 0.5) / side
    light, view = on_sphere(-concentric(middles)), on_sphere(concentric(middles))
    rows = numpy.asarray(bsdf.eval(numpy.repeat(light, side**2, axis=0), numpy.tile(view, (side**2, 1)))).reshape(side**2, -1)
    totals = math.pi * (rows / light[:, 2:]).mean(axis=1)
    assert totals == pytest.approx(math.pi * values.reshape(side**2, -1).mean(axis=1), rel=1e-5)


def test_isotropic_tensor_trees_turn_with_the_light():
    side, rng = 16, numpy.random.default_rng(5)
    values = rng.random((side,) * 3) * 0.3
    bsdf = gonio.MeasuredBsdf.from_bytes(tensor_tree_xml(values, 3).encode(), "tree.xml")
    assert bsdf.isotropic
    # Light at half of the first axis: its lower half is where the sine of light's angle is counted down.
    cells = numpy.column_stack([rng.integers(0, side // 2, PAIRS), rng.integers(0, side, (PAIRS, 2))])
    place = (cells + rng.uniform(0.05, 0.95, cells.shape)) / side
    sine = 1.0 - 2.0 * place[:, 0]
    out, turn = concentric(place[:, 1:]), rng.uniform(0.0, 2.0 * numpy.pi, PAIRS)
    cosine_turn, sine_turn = numpy.cos(turn), numpy.sin(turn)
    wi = on_sphere(-sine[:, None] * numpy.column_stack([cosine_turn, sine_turn]))
    wo = on_sphere(numpy.column_stack([cosine_turn * out[:, 0] - sine_turn * out[:, 1], sine_turn * out[:, 0] + cosine_turn * out[:, 1]]))
    found = numpy.asarray(bsdf.eval(wi, wo))[:, 0] / wi[:, 2]
    assert found == pytest.approx(values[tuple(cells.T)].astype("f4"), rel=1e-6)


def test_the_polarised_white_standard_is_read_whole(shared):
    bsdf = gonio.MeasuredBsdf.from_file(shared("bsdf", "spectralon_lowres.pbsdf"))
    assert bsdf.channels == [f"{wavelength} nm" for wavelength in (450, 500, 550, 600, 650)]
    wi, wo = random_directions(PAIRS, 6, least_cosine=0.3), random_directions(PAIRS, 7, least_cosine=0.3)
    values = numpy.asarray(bsdf.eval(wi, wo)) / wi[:, 2:]
    # Spectralon: between half and all of what an ideal white surface scatters, nearly everywhere.
    share = values * math.pi
    assert numpy.median(share) > 0.5 and (numpy.quantile(share, 0.95, axis=0) < 1.5).all()
