"""Luminances of an EXR file in steps, of its colour after the noise was taken out: `python luminance_steps.py office.exr steps.png`.

`gonio falsecolor` draws the luminance pass, which keeps its noise. Needs the package OpenEXR.
"""

import importlib
import sys

import gonio
import numpy

# cd/m² of red, green and blue of 1 in linear Rec.709.
WEIGHTS = numpy.array([0.2126, 0.7152, 0.0722], "f4")


def main() -> None:
    """Reads the first file and writes the second: three decades in nine steps, up to 5000 cd/m²."""
    # The package has no types.
    channels = importlib.import_module("OpenEXR").File(sys.argv[1]).channels()
    luminance = channels["RGBA"].pixels[..., :3].astype("f4") @ WEIGHTS
    gonio.false_colour(luminance, unit="cd/m²", max=5000, log=3, steps=9).write(sys.argv[2])


if __name__ == "__main__":
    main()
