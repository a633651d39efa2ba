"""Mitsuba 3's `measured` BSDF at pairs of directions: run by a Python that has `mitsuba`.

    python rgl_mitsuba.py FILE.bsdf PAIRS.npy OUT.npy

Pairs are rows of wi and wo in gonio's sense; the result is BSDF × cosine of wi, (N, 3).
"""

import sys

import mitsuba
import numpy


def main(file: str, pairs: str, out: str) -> None:
    """Its cosine is the second direction's, so what it calls wi is our wo."""
    mitsuba.set_variant("scalar_rgb")
    bsdf = mitsuba.load_dict({"type": "measured", "filename": file})
    context, interaction = mitsuba.BSDFContext(), mitsuba.SurfaceInteraction3f()

    def value(row: list[float]) -> list[float]:
        interaction.wi = row[3:]
        return list(bsdf.eval(context, interaction, row[:3]))

    numpy.save(out, numpy.array([value(row) for row in numpy.load(pairs).tolist()]))


if __name__ == "__main__":
    main(*sys.argv[1:4])
