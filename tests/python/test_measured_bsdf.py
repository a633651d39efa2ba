"""`gonio.MeasuredBsdf`: values, densities and samples of files and tables with known answers."""

import threading

import gonio
import numpy
import pytest
from measured_files import ggx, isotropic_axes, isotropic_values, merl_bytes, merl_directions, random_directions, unit

UP = numpy.array([[0.0, 0.0, 1.0]])


def lambertian(reflectance=0.5):
    values = numpy.full((2, 2, 1, 3), reflectance / numpy.pi)
    return gonio.MeasuredBsdf.from_table({"theta_i": [0, 90], "theta_o": [0, 90], "delta_phi": [0]}, values)


@pytest.fixture(scope="module")
def metal():
    axes = isotropic_axes()
    return gonio.MeasuredBsdf.from_table(axes, isotropic_values(axes, ggx).astype("f4"), periods={"delta_phi": 360})


def test_a_constant_table_is_times_the_cosine():
    bsdf, wi, wo = lambertian(), random_directions(500, 1), random_directions(500, 2)
    found = numpy.asarray(bsdf.eval(wi, wo))
    assert found.shape == (500, 3) and found.dtype == numpy.float64
    assert found == pytest.approx(numpy.repeat(0.5 / numpy.pi * wi[:, 2:], 3, axis=1), rel=1e-6)
    assert not numpy.asarray(bsdf.eval(wi, -wo)).any()
    assert (bsdf.channels, bsdf.isotropic, bsdf.sides) == (["R", "G", "B"], True, ["reflection-front"])


def test_buffers_of_any_float_and_single_rows():
    bsdf, wi = lambertian(), random_directions(20, 3)
    expected = numpy.asarray(bsdf.eval(wi, numpy.repeat(UP, 20, axis=0)))
    assert numpy.asarray(bsdf.eval(wi.astype("f4"), UP)) == pytest.approx(expected, rel=1e-6)
    assert numpy.asarray(bsdf.eval(3.0 * wi, UP)) == pytest.approx(expected, rel=1e-12)
    assert numpy.asarray(bsdf.eval(UP, wi)).shape == (20, 3)
    assert memoryview(bsdf.pdf(wi, UP)).shape == (20,)
    assert numpy.asarray(bsdf.eval(wi[:0], wi[:0])).shape == (0, 3)


def test_merl_is_exact_at_centres_and_linear_between():
    bins = (12, 10, 24)
    data, cells = merl_bytes(bins, ggx)
    bsdf = gonio.MeasuredBsdf.from_bytes(data, "made.binary")
    centre = [numpy.pi / 2 * ((numpy.arange(12) + 0.5) / 12) ** 2, numpy.pi / 2 * (numpy.arange(10) + 0.5) / 10]
    about = numpy.pi * (numpy.arange(24) + 0.5) / 24
    at = [(h, d, p) for h in range(3) for d in range(4) for p in range(24)]
    place = numpy.array([(centre[0][h], centre[1][d], about[p]) for h, d, p in at])
    wi, wo = merl_directions(*place.T)
    value = numpy.asarray(bsdf.eval(wi, wo)) / wi[:, 2:]
    assert value == pytest.approx(numpy.array([cells[i] for i in at]), rel=1e-6)
    # Halfway along the difference angle: the mean of both.
    wi, wo = merl_directions(centre[0][1], 0.5 * (centre[1][1] + centre[1][2]), about[5])
    value = numpy.asarray(bsdf.eval(wi[None], wo[None]))[0] / wi[2]
    assert value == pytest.approx(0.5 * (cells[1, 1, 5] + cells[1, 2, 5]), rel=1e-5)


def test_densities_integrate_to_one_and_samples_follow_them(metal):
    wo = unit(numpy.radians([50.0]), numpy.array([0.7]))
    wi, density = (numpy.asarray(part) for part in metal.sample(wo, numpy.random.default_rng(5).random((20_000, 3))))
    assert density.shape == (20_000,) and (density > 0).all()
    assert numpy.linalg.norm(wi, axis=1) == pytest.approx(numpy.ones(20_000), rel=1e-9)
    assert numpy.asarray(metal.pdf(wi, wo)) == pytest.approx(density, rel=1e-9)
    uniform = random_directions(200_000, 7, least_cosine=0.0)
    integral = numpy.asarray(metal.pdf(uniform, wo)) * 2.0 * numpy.pi
    assert integral.mean() == pytest.approx(1.0, abs=5 * integral.std() / 200_000**0.5)
    # Both estimate the albedo of the view.
    weight = numpy.asarray(metal.eval(wi, wo)) / density[:, None]
    reference = numpy.asarray(metal.eval(uniform, wo)) * 2.0 * numpy.pi
    error = (weight.var(axis=0) / len(weight) + reference.var(axis=0) / len(reference)) ** 0.5
    assert (numpy.abs(weight.mean(axis=0) - reference.mean(axis=0)) < 5 * error).all()
    assert weight[:, 0].std() < 0.2 * reference[:, 0].std()


def test_files_come_back(metal, tmp_path):
    wi, wo = random_directions(300, 11), random_directions(300, 12)
    for text in (False, True):
        path = tmp_path / "metal.gbsdf"
        metal.write(path, title="a metal", text=text)
        again = gonio.MeasuredBsdf.from_file(path)
        assert numpy.asarray(again.eval(wi, wo)) == pytest.approx(numpy.asarray(metal.eval(wi, wo)), rel=1e-6)


def test_spectra_have_their_bands_and_a_colour():
    axes = {"theta_i": [0, 90], "theta_o": [0, 90], "delta_phi": [0]}
    values = numpy.tile([0.1, 0.2, 0.3, 0.4], 4) / numpy.pi
    bsdf = gonio.MeasuredBsdf.from_table(axes, values, wavelengths=[450, 500, 550, 600])
    assert bsdf.channels == ["450 nm", "500 nm", "550 nm", "600 nm"]
    assert numpy.asarray(bsdf.eval(UP, UP)) == pytest.approx(numpy.array([[0.1, 0.2, 0.3, 0.4]]) / numpy.pi, rel=1e-6)
    red, _, blue = numpy.asarray(bsdf.eval(UP, UP, rgb=True))[0]
    assert red > blue > 0


def test_a_metal_and_a_plastic_are_fitted(metal):
    found = metal.fit()
    assert found["base_metalness"] == 1.0 and found["specular_roughness"] == pytest.approx(0.3**0.5, abs=0.02)
    axes = isotropic_axes()
    found = gonio.MeasuredBsdf.from_table(axes, isotropic_values(axes, plastic), periods={"delta_phi": 360}).fit()
    assert found["base_metalness"] == 0.0
    assert found["base_color"] == pytest.approx([0.5, 0.1, 0.1], abs=0.02)
    assert found["specular_roughness"] == pytest.approx(0.2**0.5, abs=0.02)
    assert found["specular_ior"] == pytest.approx(1.5, abs=0.03)
    assert found["residual"] < 0.03


def shine(wi, wo, alpha=0.2, ior=1.5):
    """GGX with Fresnel's reflectance, (…, 1)."""
    half = (wi + wo) / numpy.linalg.norm(wi + wo, axis=-1, keepdims=True)
    c = (wi * half).sum(axis=-1)
    g = numpy.sqrt(ior**2 - 1.0 + c**2)
    reflectance = 0.5 * ((g - c) / (g + c)) ** 2 * (1.0 + ((c * (g + c) - 1.0) / (c * (g - c) + 1.0)) ** 2)
    return ggx(wi, wo, alpha=alpha, colour=(1.0,)) * reflectance[..., None]


def plastic(wi, wo):
    """A red base under a reflection of index 1.5: what the reflection takes at the view is missing below."""
    cosines = numpy.linspace(0.01, 1.0, 40)
    light = random_directions(40_000, 31, least_cosine=0.0)
    views = numpy.stack([numpy.sqrt(1.0 - cosines**2), 0.0 * cosines, cosines], axis=-1)
    taken = [2.0 * numpy.pi * (shine(light, view[None])[:, 0] * light[:, 2]).mean() for view in views]
    base = 1.0 - numpy.interp(wo[..., 2], cosines, taken)
    return shine(wi, wo) + base[..., None] * numpy.array([0.5, 0.1, 0.1]) / numpy.pi


def test_wrong_arguments_are_told(tmp_path):
    axes = {"theta_i": [0, 90], "theta_o": [0, 90], "delta_phi": [0]}
    table = gonio.MeasuredBsdf.from_table
    for call, kind, expected in [
        (lambda: table({"theta": [0]}, numpy.zeros(1)), gonio.SettingError, "theta were found, expected theta_i"),
        (lambda: table(axes, numpy.zeros(8)), gonio.SettingError, "8 for 4 cells"),
        (lambda: table(axes, -numpy.ones(4)), gonio.SettingError, "expected zero or more"),
        (lambda: table({**axes, "theta_o": [90, 0]}, numpy.zeros(4)), gonio.SettingError, "theta_o: axis value 0"),
        (lambda: table(axes, numpy.zeros(4), periods={"phi": 360}), gonio.SettingError, "'phi' was found"),
        (lambda: table(axes, numpy.zeros(4), side="left"), gonio.SettingError, "'left' was found"),
        (lambda: table(axes, [0.0] * 4), TypeError, "expected a buffer"),
        (lambda: lambertian().eval(numpy.zeros((1, 3)), UP), ValueError, "expected a direction"),
        (lambda: lambertian().eval(numpy.full((1, 3), numpy.nan), UP), ValueError, "expected a direction"),
        (lambda: lambertian().eval(numpy.ones((2, 3)), numpy.ones((3, 3))), ValueError, "wi has 2 rows and wo has 3"),
        (lambda: lambertian().eval(numpy.ones(4), UP), ValueError, "expected rows of 3"),
        (lambda: gonio.MeasuredBsdf.from_bytes(b"\x00" * 40, "x.bin"), gonio.FormatError, "x.bin: not a measured material"),
        (lambda: gonio.MeasuredBsdf.from_bytes(b"gbsdf 1\ntable up", "a.gbsdf"), gonio.FormatError, "a.gbsdf:2: "),
        (lambda: gonio.MeasuredBsdf.from_bytes(b"tensor_file\0\1\0\xff\xff\xff\xff", "t.bsdf"), gonio.FormatError, "t.bsdf: byte "),
        (lambda: gonio.MeasuredBsdf.from_file(tmp_path / "none.bsdf"), FileNotFoundError, "none.bsdf"),
    ]:
        with pytest.raises(kind, match=expected):
            call()


def test_other_threads_run_meanwhile(metal):
    """While one thread evaluates, another one counts."""
    wi, wo = random_directions(400_000, 21), random_directions(400_000, 22)
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    metal.eval(wi, wo)
    during = counted[0] - before
    done.set()
    thread.join()
    assert during > 1000


def test_a_scene_shares_it(tmp_path):
    scene = gonio.Scene()
    number = scene.put_measured(lambertian(), name="grey")
    scene.put_material({"closures": [{"model": "Measured", "measured": number}]})
    assert scene.put_measured(lambertian(0.2), index=number) == number
    description = scene.to_dict()
    assert len(description["measured"]) == 1 and description["materials"][0]["closures"][0]["measured"] == 0
    scene.save(tmp_path / "scene.gonio")
    assert len(gonio.Scene.load(tmp_path / "scene.gonio").to_dict()["measured"]) == 1
    scene.truncate("measured", 0)
    assert scene.to_dict()["measured"] == []
