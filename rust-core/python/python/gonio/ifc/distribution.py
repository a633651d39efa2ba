"""IfcLightIntensityDistribution as a file of LM-63."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

# LM-63's numbers of photometric types.
TYPES = {"TYPE_A": 3, "TYPE_B": 2, "TYPE_C": 1}
# Fluxes that differ by less are the same.
SAME = 0.02
# Shares of the lamps' flux that a distribution per lumen or per 1000 lumens can have.
LEAST_SHARE, MOST_SHARE = 0.2, 1.02


def table(distribution: Any, radian: float) -> tuple[Any, Any, Any]:
    """Angles of planes, angles within them, both in degrees, and intensities [plane, angle]; `radian` is the project's unit of angles.

    ValueError for what is no table.
    """
    planes = sorted(distribution.DistributionData, key=lambda data: float(data.MainPlaneAngle))
    rows = [(np.array(plane.SecondaryPlaneAngle, "f8"), np.array(plane.LuminousIntensity, "f8")) for plane in planes]
    main = np.array([plane.MainPlaneAngle for plane in planes], "f8")
    if not rows or any(len(angles) != len(values) or not len(angles) for angles, values in rows):
        raise ValueError("it has not as many intensities as angles")
    if not all(np.isfinite(values).all() and (values >= 0.0).all() for row in [(main, main * 0.0), *rows] for values in row[1:]):
        raise ValueError("its intensities are no numbers of 0 or more")
    # Whatever the project's unit, more than a full turn of radians are degrees.
    greatest = max(np.abs(main).max(), *(np.abs(angles).max() for angles, _ in rows))
    scale = 1.0 if greatest > 2.0 * math.pi + 1e-3 else math.degrees(radian)
    angles = np.unique(np.round(np.concatenate([row[0] for row in rows]) * scale, 6))
    values = np.array([np.interp(angles, *_sorted(row[0] * scale, row[1]), left=0.0, right=0.0) for row in rows])
    main, first = np.unique(np.round(main * scale, 6), return_index=True)
    return main, angles, values[first]


def _sorted(angles: Any, values: Any) -> tuple[Any, Any]:
    order = np.argsort(angles, kind="stable")
    return np.round(angles[order], 6), values[order]


def lm63(name: str, curve: str, main: Any, angles: Any, values: Any) -> str:
    """The text of a point luminaire with these intensities in cd."""
    if curve == "TYPE_B":
        # LM-63's planes of type B are about the other axis.
        main, angles, values = angles, main, values.T
    if curve not in ("TYPE_A", "TYPE_B"):
        main, values = _whole_circle(main, values)
        angles, values = _whole_half_circle(angles, values)
    rows = [_numbers(angles), _numbers(main), *(_numbers(row) for row in values)]
    words = " ".join(name.split()) or "IFC"
    count = f"{len(angles)} {len(main)} {TYPES.get(curve, 1)}"
    head = f"IESNA:LM-63-2002\n[TEST]\n[TESTLAB]\n[ISSUEDATE]\n[MANUFAC]\n[LUMINAIRE] {words[:200]}\nTILT=NONE"
    return f"{head}\n1 -1 1 {count} 2 0 0 0\n1 1 0\n" + "\n".join(rows) + "\n"


def _whole_circle(main: Any, values: Any) -> tuple[Any, Any]:
    """Planes up to 360° where some lie beyond 180°."""
    if len(main) > 1 and 180.0 < main[-1] < 360.0 and main[0] == 0.0:
        return np.append(main, 360.0), np.vstack([values, values[:1]])
    return main, values


def _whole_half_circle(angles: Any, values: Any) -> tuple[Any, Any]:
    """Angles from 0 or 90 to 90 or 180, without light where the table has none."""
    angles, values = list(angles), list(values.T)
    dark = np.zeros_like(values[0])
    if angles[0] not in (0.0, 90.0):
        edge = 90.0 if angles[0] > 90.0 else 0.0
        angles, values = [edge, angles[0] - min(0.01, 0.5 * (angles[0] - edge)), *angles], [dark, dark, *values]
    if angles[-1] not in (90.0, 180.0):
        edge = 90.0 if angles[-1] < 90.0 else 180.0
        angles, values = [*angles, angles[-1] + min(0.01, 0.5 * (edge - angles[-1])), edge], [*values, dark, dark]
    return np.array(angles), np.array(values).T


def _numbers(values: Sequence[float]) -> str:
    """Numbers in lines of at most ten."""
    words = [f"{value:.6g}" for value in values]
    return "\n".join(" ".join(words[i : i + 10]) for i in range(0, len(words), 10))


def scale(flux: float, stated: float) -> tuple[float, str]:
    """Factor that makes candela of a table whose integral is `flux`, for lamps with `stated` lm; and what the table was taken for."""
    if stated <= 0.0 or flux <= 0.0 or abs(flux / stated - 1.0) < SAME:
        return 1.0, "candela"
    if LEAST_SHARE < flux < MOST_SHARE:
        return stated, "candela per lumen"
    if LEAST_SHARE < flux / 1000.0 < MOST_SHARE:
        return stated / 1000.0, "candela per 1000 lumens"
    return stated / flux, f"relative, as their flux of {flux:.4g} lm is not the light source's {stated:g} lm"
