"""Measurements of the RGL kind by wavelength: values of the reader, colours by day, and two surfaces that look alike under daylight alone."""

import math
import struct

import gonio
import numpy as np
import pytest

SQUARE = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
CORNERS = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
#: What the file measured: uneven steps, more than what is seen.
NM = np.concatenate([np.arange(360.0, 500.0, 3.3), np.arange(500.0, 1000.0, 4.7)])


def tensor_file(fields: dict[str, np.ndarray]) -> bytes:
    """EPFL's container of named arrays."""
    head = b"tensor_file\0" + bytes([1, 0]) + struct.pack("<I", len(fields))
    length = len(head) + sum(2 + len(name) + 2 + 1 + 8 + 8 * array.ndim for name, array in fields.items())
    body = b""
    for name, array in fields.items():
        kind = {"uint8": 1, "float32": 10}[array.dtype.name]
        head += struct.pack("<H", len(name)) + name.encode() + struct.pack("<HBQ", array.ndim, kind, length + len(body))
        head += struct.pack(f"<{array.ndim}Q", *array.shape)
        body += array.tobytes()
    return head + body


def measured(near, far=None) -> gonio.MeasuredBsdf:
    """BSDF × cosine of a spectrum straight on and of another at 60 degrees, however the light comes; over a square of 5 × 5."""
    spectra = np.stack([near, near if far is None else far])
    ones = np.ones((1, 2, 5, 5), np.float32)
    values = np.broadcast_to(spectra[None, :, :, None, None], (1, 2, len(NM), 5, 5)).astype(np.float32)
    fields = {
        "description": np.frombuffer(b"made up", np.uint8),
        "jacobian": np.zeros(1, np.uint8),
        "phi_i": np.zeros(1, np.float32),
        "theta_i": np.array([0.0, math.pi / 3], np.float32),
        "ndf": ones[0, 0],
        "sigma": ones[0, 0],
        "vndf": ones,
        "luminance": ones,
        "wavelengths": NM.astype(np.float32),
        "spectra": np.ascontiguousarray(values),
    }
    return gonio.MeasuredBsdf.from_bytes(tensor_file(fields), "made.bsdf")


def square(bsdf, angle=0.0, samples=16, spectral=True, **light):
    """A square that shows a measurement, lit from straight above, seen at an angle in degrees."""
    made = gonio.Scene()
    mesh = made.add_mesh(SQUARE, CORNERS)
    made.add_instance(mesh, [made.put_material({"closures": [{"model": "Measured", "measured": made.put_measured(bsdf)}]})])
    sin, cos = math.sin(math.radians(angle)), math.cos(math.radians(angle))
    made.add_camera([[1, 0, 0, 0], [0, cos, -sin, -2 * sin], [0, sin, cos, 2 * cos], [0, 0, 0, 1]], fov=0.1)
    made.add_light("distant", angle=0.0, **light)
    made.set(width=8, height=8, samples=samples, spectral=spectral)
    return made


def seen(made) -> np.ndarray:
    with gonio.Render(made) as rendering:
        rendering.wait()
        return np.asarray(rendering.film()["color"], float)[..., :3].mean(axis=(0, 1))


def observer(nm: np.ndarray) -> np.ndarray:
    """x̄, ȳ and z̄ in any one unit, by the figures of triangles of 2 nm."""
    rows = []
    for at in nm:
        figures = gonio.spectrum_figures([at - 1, at - 0.5, at, at + 0.5, at + 1], [0, 0.5, 1, 0.5, 0])
        x, y, bright = figures["x"], figures["y"], figures["ler"]
        rows.append([x / y * bright, bright, (1 - x - y) / y * bright])
    return np.array(rows)


def smooth(nm):
    return 0.05 + 0.03 * np.exp(-(((nm - 600) / 70) ** 2)) + 0.01 * np.exp(-(((nm - 460) / 40) ** 2))


@pytest.mark.parametrize("angle", [0.0, 40.0])
def test_pictures_by_wavelength_have_the_readers_values(angle):
    """At each band's middle the spectrum of the file, linear between its wavelengths and between its angles."""
    near, far = smooth(NM), 0.06 + 0.02 * np.sin(NM / 35.0)
    grey = measured(np.full_like(NM, 0.05))
    bsdf = measured(near, far)
    pictures = [gonio.spectral_picture(square(shown, angle), band=10.0) for shown in (bsdf, grey)]
    found, white = (np.asarray(picture.radiance, float).mean(axis=(0, 1)) for picture in pictures)
    view = np.array([[0.0, math.sin(math.radians(angle)), math.cos(math.radians(angle))]])
    own = np.asarray(bsdf.eval(np.array([[0.0, 0.0, 1.0]]), view))[0]
    expected = np.interp(np.asarray(pictures[0].wavelengths_nm), NM, own)
    np.testing.assert_allclose(0.05 * found / white, expected, rtol=2e-3)


@pytest.mark.parametrize("spectrum", [smooth(NM), 0.02 + 0.05 / (1 + np.exp((560 - NM) / 25))])
def test_by_day_the_colour_is_that_without_wavelengths(spectrum):
    """In red, green and blue a measurement is seen in light of equal energy, adapted to daylight: a hundredth apart for colours such as these."""
    colour = seen(square(measured(spectrum), spectral=False))
    np.testing.assert_allclose(seen(square(measured(spectrum), samples=1024)), colour, rtol=0.01, atol=0.01 * colour.max())


def test_metamers_part_under_a_fluorescent_lamp():
    """Two surfaces of one colour under D65 have the colours of their spectra under FL11."""
    nm = np.arange(380.0, 780.5, 1.0)
    response = observer(nm)
    power = {name: np.interp(nm, lamp["wavelengths_nm"], lamp["power"]) for name in ("D65", "FL11") for lamp in [gonio.illuminant(name)]}
    one = np.interp(nm, NM, smooth(NM))
    # What bumps at the lamp's lines add, less what three wide bumps take back of it under daylight.
    bumps = np.exp(-(((nm - 545) / 8) ** 2)) - 0.8 * np.exp(-(((nm - 612) / 8) ** 2))
    wide = np.stack([np.exp(-(((nm - at) / 45) ** 2)) for at in (450, 545, 610)])
    by_day = response * power["D65"][:, None]
    back = np.linalg.solve((wide @ by_day).T, bumps @ by_day)
    other = one + 0.03 * (bumps - back @ wide)
    assert other.min() > 0
    pair = []
    for spectrum in (one, other):
        beyond = np.interp(NM, nm, spectrum)
        pair.append(measured(beyond))
    daylight = [seen(square(shown, samples=1024)) for shown in pair]
    np.testing.assert_allclose(daylight[0], daylight[1], rtol=0.01)
    lamps = [seen(square(shown, samples=8192, spectrum="FL11")) for shown in pair]
    to_rgb = np.linalg.inv([[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]])
    of_lamp = power["FL11"] @ response
    expected = [to_rgb @ ((np.interp(nm, NM, np.interp(NM, nm, spectrum)) * power["FL11"]) @ response) / of_lamp[1] for spectrum in (one, other)]
    assert np.abs(expected[0] / expected[1] - 1).max() > 0.1
    for found, wanted in zip(lamps, expected, strict=True):
        np.testing.assert_allclose(found, wanted, rtol=0.02)


def test_turning_wavelengths_on_and_off_lays_it_out_anew():
    """One scene rendered in colour, by wavelength and in colour again."""
    made = square(measured(smooth(NM)))
    colours = []
    for spectral in (False, True, False):
        made.set(spectral=spectral)
        colours.append(seen(made))
    np.testing.assert_array_equal(colours[0], colours[2])
    assert np.abs(colours[1] - colours[0]).max() > 0
