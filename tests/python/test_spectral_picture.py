"""Pictures by wavelength: radiance of lamps and walls by closed forms, the colour beside that of other pictures, and the files."""

import math

import gonio
import numpy as np
import OpenEXR
import pytest

SQUARE = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
CORNERS = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
EFFICACY = 683.002


def lit(colour, spectrum, size=8, samples=16, **lamp):
    """A matt square under an even dome of 100 cd/m², from above."""
    made = gonio.Scene()
    square = made.add_mesh(SQUARE, CORNERS)
    made.add_instance(square, [made.add_material(base_color=colour, specular_weight=0.0)])
    made.add_camera([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]], fov=1.0)
    made.add_light("dome", (100.0,) * 3, spectrum=spectrum, **lamp)
    made.set(width=size, height=size, samples=samples, spectral=True)
    return made


def per_lumen(name, band):
    """Power of a lamp in bands, W/nm for each lm."""
    lamp = gonio.illuminant(name)
    nm = np.arange(380.0, 780.01, 0.1)
    power = np.interp(nm, lamp["wavelengths_nm"], lamp["power"])
    figures = gonio.spectrum_figures(nm, power)
    means = [np.trapezoid(part, dx=0.1) / band for part in np.lib.stride_tricks.sliding_window_view(power, round(band * 10) + 1)[:: round(band * 10)]]
    return np.array(means) / (figures["ler"] * np.trapezoid(power, dx=0.1))


@pytest.mark.parametrize(("name", "band"), [("FL11", 5.0), ("LED-B3", 10.0), ("A", 20.0)])
def test_a_wall_under_a_lamp(name, band):
    """L = R(nm) L of the sky, band by band."""
    colour = (0.7, 0.3, 0.15)
    picture = gonio.spectral_picture(lit(colour, name), band=band)
    nm = np.asarray(picture.wavelengths_nm)
    assert len(nm) == round(400 / band) and nm[0] == 380 + band / 2
    radiance = np.asarray(picture.radiance)
    assert radiance.shape == (8, 8, len(nm))
    expected = 100.0 * np.asarray(gonio.colour_reflectance(colour, nm)) * per_lumen(name, band)
    found = radiance.mean(axis=(0, 1))
    np.testing.assert_allclose(found, expected, atol=2e-3 * expected.max())


def test_the_colour_is_that_of_a_spectral_picture():
    made = lit((0.2, 0.5, 0.7), "LED-B1", samples=64)
    picture = np.asarray(gonio.spectral_picture(made).color)[..., :3].mean(axis=(0, 1))
    made.set(samples=2048)
    with gonio.Render(made) as rendering:
        rendering.wait()
        other = np.asarray(rendering.film()["color"])[..., :3].mean(axis=(0, 1))
    np.testing.assert_allclose(picture, other, rtol=0.01)


def test_noise_is_of_brightness_and_not_of_colour():
    """All bands share their random numbers: pixels of a grey wall have one chromaticity."""
    made = lit((0.5,) * 3, "LED-B3", samples=2)
    made.add_light("sphere", (1e5,) * 3, radius=0.05, spectrum="LED-B3", transform=[[1, 0, 0, 0.3], [0, 1, 0, 0], [0, 0, 1, 1], [0, 0, 0, 1]])
    radiance = np.asarray(gonio.spectral_picture(made, band=20.0).radiance).reshape(-1, 20)
    shape = radiance / radiance.sum(axis=1, keepdims=True)
    assert radiance.sum(axis=1).std() > 0
    assert (shape.std(axis=0) < 1e-5 * shape.max()).all()


def test_openexr(tmp_path):
    made = lit((0.5, 0.4, 0.3), "A")
    picture = gonio.spectral_picture(made, band=10.0)
    path = tmp_path / "wall.exr"
    picture.write(path)
    with OpenEXR.File(str(path), separate_channels=True) as file:
        header, channels = file.header(), file.channels()
        assert header["spectralLayoutVersion"] == "1.0" and header["emissiveUnits"] == "W.m^-2.sr^-1"
        spectral = sorted(name for name in channels if name.startswith("S0."))
        assert len(spectral) == 40 and spectral[0] == "S0.385,000000nm" and spectral[-1] == "S0.775,000000nm"
        stored = np.stack([channels[name].pixels for name in spectral], -1)
        np.testing.assert_array_equal(stored, np.asarray(picture.radiance))
        np.testing.assert_array_equal(channels["G"].pixels, np.asarray(picture.color)[..., 1])


def test_radiance(tmp_path):
    """Radiance's spectral picture: the longest wavelength first, one exponent a pixel, an even spectrum of the value of its luminance over 179 lm/W."""
    made = lit((0.6,) * 3, "E")
    picture = gonio.spectral_picture(made, band=20.0)
    path = tmp_path / "wall.hsr"
    picture.write(path)
    head, rest = path.read_bytes().split(b"\n\n", 1)
    assert head.startswith(b"#?RADIANCE\n") and b"NCOMP=20" in head and b"FORMAT=Radiance_spectra" in head and b"WAVELENGTH_SPLITS= 780" in head
    size, data = rest.split(b"\n", 1)
    assert size == b"-Y 8 +X 8"
    pixels = np.frombuffer(data, np.uint8).reshape(64, 21)
    values = (pixels[:, :20] + 0.5) * 2.0 ** (pixels[:, 20:].astype(float) - 136)
    np.testing.assert_allclose(values.mean(axis=0), 60.0 / 179.0, rtol=0.02)
    with pytest.raises(gonio.Error, match="24 at most"):
        gonio.spectral_picture(made, band=5.0).write(tmp_path / "fine.hsr")
    with pytest.raises(gonio.Error, match="expected exr or hsr"):
        picture.write(tmp_path / "wall.png")


def test_fog_and_fire_are_by_wavelength():
    """What absorption leaves of a sky's light is by the colour's spectrum."""
    from gonio.medium import medium

    absorption = (0.1, 0.3, 0.7)
    made = gonio.Scene()
    square = made.add_mesh(SQUARE * np.float32(4), CORNERS)
    made.add_instance(square, [made.add_material(base_color=(0, 0, 0), specular_weight=0.0, emission_color=(50.0,) * 3)])
    made.add_camera([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]], fov=1.0)
    made.put_atmosphere(medium(absorption=absorption))
    made.set(width=4, height=4, samples=4)
    picture = gonio.spectral_picture(made, band=20.0)
    nm = np.asarray(picture.wavelengths_nm)
    greatest = 2 * max(absorption)
    coefficient = greatest * np.asarray(gonio.colour_reflectance([part / greatest for part in absorption], nm))
    expected = 50.0 * per_lumen("D65", 20.0) * np.exp(-2.0 * coefficient)
    np.testing.assert_allclose(np.asarray(picture.radiance).mean(axis=(0, 1)), expected, atol=5e-3 * expected.max())


@pytest.mark.parametrize(("band", "what"), [(7.0, "5, 10 or 20"), (math.nan, "5, 10 or 20")])
def test_other_bands_are_refused(band, what):
    with pytest.raises(gonio.Error, match=what):
        gonio.spectral_picture(lit((0.5,) * 3, "A"), band=band)


def test_what_knows_no_wavelengths_is_refused():
    made = lit((0.5,) * 3, "A")
    made.set(integrator="whitted")
    with pytest.raises(gonio.Error, match="whitted.*no wavelengths"):
        gonio.spectral_picture(made)


def test_it_can_be_cancelled():
    with pytest.raises(gonio.Cancelled):
        gonio.spectral_picture(lit((0.5,) * 3, "A", size=256, samples=4096), cancelled=lambda: True)


def test_compiling_can_be_cancelled():
    """Of a mesh of two million triangles nothing is told before its tree stands."""
    import time

    side = 1000
    x, y = np.meshgrid(np.linspace(-1, 1, side, dtype=np.float32), np.linspace(-1, 1, side, dtype=np.float32))
    points = np.stack([x.ravel(), y.ravel(), np.sin(9 * x * y).ravel()], axis=1)
    first = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    faces = np.concatenate([np.stack([first, first + 1, first + side], 1), np.stack([first + 1, first + side + 1, first + side], 1)]).astype(np.int32)
    made = lit((0.5,) * 3, "A")
    made.add_instance(made.add_mesh(points, faces), [made.add_material()])
    asked = []

    def cancelled():
        asked.append(time.process_time())
        return True

    with pytest.raises(gonio.Cancelled):
        gonio.spectral_picture(made, cancelled=cancelled)
    # The whole of it takes seconds.
    assert time.process_time() - asked[0] < 1.0


def test_an_exception_of_the_question_is_raised():
    def cancelled():
        raise ValueError("not now")

    with pytest.raises(ValueError, match="not now"):
        gonio.spectral_picture(lit((0.5,) * 3, "A", size=256, samples=4096), cancelled=cancelled)


def test_glass_bends_every_wavelength_of_a_band():
    """A thin bright strip through a prism: a band of 20 nm shows what its four bands of 5 nm do, no single line."""
    index, apex = 1.6, math.radians(60)
    lean = math.asin(index * math.sin(apex / 2)) - apex / 2
    made = gonio.Scene()
    side, top = 0.1 * math.tan(apex / 2), 0.1
    section = [(-side, 0.0), (side, 0.0), (0.0, top)]
    points = np.array([(x, y, z) for y in (-0.2, 0.2) for x, z in section], np.float32)
    faces = np.array([(0, 1, 2), (3, 5, 4), (0, 3, 4), (0, 4, 1), (1, 4, 5), (1, 5, 2), (2, 5, 3), (2, 3, 0)], np.int32)
    glass = made.add_material(transmission_weight=1.0, specular_roughness=0.0, specular_ior=index, transmission_dispersion=1 / 20)
    made.add_instance(made.add_mesh(points, faces), [glass])
    shine = made.add_material(emission_color=(1.0, 1.0, 1.0), base_color=(0.0, 0.0, 0.0), specular_weight=0.0)
    far, middle = 3.0, 0.05
    strip = np.array([(far * math.cos(lean), y, middle - far * math.sin(lean) + z) for y, z in ((-1, 0), (1, 0), (1, 0.004), (-1, 0.004))], np.float32)
    made.add_instance(made.add_mesh(strip, CORNERS), [shine])
    eye = np.array((-0.5 * math.cos(lean), 0.0, middle - 0.5 * math.sin(lean)))
    made.add_camera(gonio.look_at(eye, (0.0, 0.0, middle), up=(0.0, 0.0, 1.0)), fov=12.0)
    made.set(width=8, height=96, samples=256, spectral=True, caustics="off")
    rows = {band: np.asarray(gonio.spectral_picture(made, band=band).radiance).mean(axis=1) for band in (5.0, 20.0)}
    fine = rows[5.0].reshape(96, -1, 4).mean(axis=2)
    lit = rows[20.0].sum(axis=0) > 0
    assert lit.sum() >= 15
    # Single lines would differ by nearly twice their light.
    assert np.abs(rows[20.0] - fine).sum() < 0.3 * fine.sum()
