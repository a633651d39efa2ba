"""Colours of light by sums over wavelengths in double precision, and what spectral pictures show in the same XYZ."""

import gonio
import numpy as np

NM = np.arange(380.0, 781.0)
# Linear Rec.709 to XYZ of its luminance.
XYZ = np.array([[0.4123908, 0.3575843, 0.1804808], [0.2126390, 0.7151687, 0.0721923], [0.0193308, 0.1191948, 0.9505322]])


def observer() -> np.ndarray:
    """The CIE's curves of 1931 at `NM`, from the chromaticity and the lumens of single lines."""
    lines = [gonio.spectrum_figures([nm - 0.02, nm - 0.01, nm, nm + 0.01, nm + 0.02], [0, 0.5, 1, 0.5, 0]) for nm in NM]
    x, y, lumens = (np.array([line[key] for line in lines]) for key in ("x", "y", "ler"))
    return np.stack([x / y, np.ones_like(x), (1 - x - y) / y], axis=1) * (lumens / 683.002)[:, None]


OBSERVER = observer()


def lamp(name: str) -> np.ndarray:
    """The power of an illuminant at `NM`, of luminance 1."""
    table = gonio.illuminant(name)
    power = np.interp(NM, table["wavelengths_nm"], table["power"], left=0.0, right=0.0)
    return power / (power @ OBSERVER[:, 1])


def colour(power: np.ndarray) -> np.ndarray:
    """X, Y and Z of power at `NM`."""
    return power @ OBSERVER


# In pictures D65's table is (1, 1, 1), though Rec.709's white is rounded.
WHITE = np.linalg.solve(XYZ, colour(lamp("D65")))


def seen(made: gonio.Scene, samples: int = 256, **settings) -> tuple[np.ndarray, np.ndarray]:
    """XYZ of a picture's mean and the standard errors, by how its 16 × 16 pixels differ."""
    made.set(**{"width": 16, "height": 16, "samples": samples, "spectral": True, "filter": "box", "filter_width": 1.0, "max_bounces": 200, **settings})
    with gonio.Render(made) as rendering:
        rendering.wait()
        assert not rendering.diagnostics, [str(told) for told in rendering.diagnostics]
        pixels = (np.asarray(rendering.film()["color"], float)[..., :3] * WHITE @ XYZ.T).reshape(-1, 3)
    return pixels.mean(axis=0), pixels.std(axis=0, ddof=1) / np.sqrt(len(pixels))


def by_band(made: gonio.Scene, band: float = 5.0, samples: int = 16) -> tuple[np.ndarray, np.ndarray]:
    """Middles of bands, nm, and the mean radiance of a picture by wavelength, over that of the even spectrum E of luminance 1."""
    made.set(width=4, height=4, samples=samples, spectral=True, caustics="off")
    picture = gonio.spectral_picture(made, band=band)
    even = 683.002 * np.trapezoid(OBSERVER[:, 1], NM)
    return np.asarray(picture.wavelengths_nm), np.asarray(picture.radiance).mean(axis=(0, 1)) * even
