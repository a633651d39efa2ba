"""Illuminance of UsdLux lights by double-precision quadrature: the oracle of the rendered light tests.

Written from the UsdLux schema text alone. One light at a time, direct light, nothing in the way. Lengths are stage units; with them the
illuminance comes out in lux where the schema's intensity is in nits.

A light is a dict with ``kind`` ("rect", "disk", "sphere", "cylinder", "distant") and ``to_world`` (4x4, rows are axes, translation in the
last row, as pxr has it), and what differs from the schema's defaults of ``width height radius length angle intensity exposure color
enable_temperature temperature normalize cone_angle softness focus focus_tint`` (angles in degrees; ``cone_angle`` None or absent means that no cone applies).
"""

import math

import numpy as np

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])

DEFAULTS = {
    "width": 1.0,
    "height": 1.0,
    "radius": 0.5,
    "length": 1.0,
    "angle": 0.53,
    "exposure": 0.0,
    "color": (1.0, 1.0, 1.0),
    "enable_temperature": False,
    "temperature": 6500.0,
    "normalize": False,
    "cone_angle": None,
    "softness": 0.0,
    "focus": 0.0,
    "focus_tint": (0.0, 0.0, 0.0),
}

# UsdLux.BlackbodyTemperatureAsRgb at 1000 K, 1500 K ... 10000 K, scaled to a largest component of 1; between them it is a Catmull-Rom spline.
BLACKBODY = np.array([
    (1.0, 0.02749, 0.0), (1.0, 0.14966, 0.0), (1.0, 0.25664, 0.00809), (1.0, 0.37203, 0.06745), (1.0, 0.47673, 0.1536),
    (1.0, 0.57038, 0.2592), (1.0, 0.65348, 0.37716), (1.0, 0.72688, 0.50161), (1.0, 0.79154, 0.62805), (1.0, 0.84846, 0.75323),
    (1.0, 0.89858, 0.8749), (1.0, 0.94277, 0.99164), (0.90695, 0.89046, 1.0), (0.82825, 0.84184, 1.0), (0.76579, 0.8019, 1.0),
    (0.71526, 0.76858, 1.0), (0.67368, 0.74042, 1.0), (0.63899, 0.71636, 1.0), (0.60968, 0.69559, 1.0),
])  # fmt: skip


def blackbody(kelvin: float) -> np.ndarray:
    """Linear Rec.709 colour of luminance 1, held outside 1000 K to 10000 K."""
    place = (min(max(kelvin, 1000.0), 10000.0) - 1000.0) / 500.0
    i = min(int(place), len(BLACKBODY) - 2)
    t = place - i
    before, start, end, after = (BLACKBODY[min(max(j, 0), len(BLACKBODY) - 1)] for j in range(i - 1, i + 3))
    # Hermite form with the tangents of Catmull and Rom.
    tangents = (end - before) / 2, (after - start) / 2
    rgb = (
        (2 * t**3 - 3 * t**2 + 1) * start
        + (t**3 - 2 * t**2 + t) * tangents[0]
        + (3 * t**2 - 2 * t**3) * end
        + (t**3 - t**2) * tangents[1]
    )
    rgb = np.maximum(rgb, 0.0)
    return rgb / (rgb @ LUMINANCE)


def size_factor(light: dict) -> float:
    """What ``normalize`` divides by."""
    light = {**DEFAULTS, **light}
    m = np.asarray(light["to_world"], dtype=float)[:3, :3]
    kind = light["kind"]
    if kind == "rect":
        return float(np.linalg.norm(np.cross(m[0] * light["width"], m[1] * light["height"])))
    if kind == "disk":
        return float(math.pi * light["radius"] ** 2 * np.linalg.norm(np.cross(m[0], m[1])))
    if kind == "sphere":
        a, b, c = np.linalg.svd(m * light["radius"], compute_uv=False)
        p = 1.6
        return float(4 * math.pi * (((a * b) ** p + (a * c) ** p + (b * c) ** p) / 3) ** (1 / p))
    if kind == "cylinder":
        along = m[0] / np.linalg.norm(m[0])
        turn = np.linspace(0.0, 2 * math.pi, 4096, endpoint=False)[:, None]
        around = light["radius"] * (m[2] * np.cos(turn) - m[1] * np.sin(turn))
        # Area by the trapezoid rule, which converges exponentially on a period.
        width = np.linalg.norm(np.cross(around, along), axis=1).mean() * 2 * math.pi
        return float(width * light["length"] * np.linalg.norm(m[0]))
    if kind == "distant":
        half = min(max(math.radians(light["angle"]) / 2, 0.0), math.pi)
        if half == 0.0:
            return 1.0
        square = math.sin(half) ** 2
        return math.pi * (square if half <= math.pi / 2 else 2 - square)
    raise ValueError(f"unknown kind of light {kind!r}")


def luminance_colour(light: dict) -> np.ndarray:
    """Emitted radiance before shaping, in nits by Rec.709 component."""
    light = {"intensity": 50000.0 if light["kind"] == "distant" else 1.0, **DEFAULTS, **light}
    rgb = np.asarray(light["color"], dtype=float) * light["intensity"] * 2.0 ** light["exposure"]
    if light["enable_temperature"]:
        rgb = rgb * blackbody(light["temperature"])
    if light["normalize"]:
        size = size_factor(light)
        # A light without extent sends nothing either way.
        rgb = rgb / size if size > 0 else rgb * 0
    return rgb


def shaping(light: dict, cosine: np.ndarray) -> np.ndarray:
    """Factor by component for emission directions at these cosines to the light's axis; shape (..., 3)."""
    factor = np.ones((*cosine.shape, 3))
    if light["focus"] > 0:
        power = (np.abs(cosine) ** light["focus"])[..., None]
        factor = np.asarray(light["focus_tint"], dtype=float) * (1 - power) + power
    if light["cone_angle"] is not None:
        off_axis = np.arccos(np.clip(cosine, -1.0, 1.0))
        cutoff = math.radians(light["cone_angle"])
        softness = min(max(light["softness"], 0.0), 1.0)
        start = cutoff * (1 - softness)
        if cutoff > start:
            x = np.clip((off_axis - start) / (cutoff - start), 0.0, 1.0)
            kept = 1 - x * x * (3 - 2 * x)
        else:
            kept = np.ones_like(off_axis)
        factor = factor * np.where(off_axis > cutoff, 0.0, kept)[..., None]
    return factor


def adaptive(function, breaks, relative: float = 2e-6, budget: int = 400_000) -> np.ndarray:
    """Integral of a function of an array with values (n, 3) from the first to the last of the breaks, by bisection of Gauss intervals.

    Neighbours never differ in size by more than four, so that nothing hides in a large interval beside a busy one.
    """
    nodes, weights = np.polynomial.legendre.leggauss(8)
    nodes, weights = (nodes + 1) / 2, weights / 2

    def integrate(low, size):
        values = function((low[:, None] + size[:, None] * nodes).ravel()).reshape(len(low), len(nodes), 3)
        return np.einsum("cnk,n,c->ck", values, weights, size)

    breaks = np.unique(np.asarray(breaks, dtype=float))
    edges = np.unique(np.concatenate([np.linspace(p, q, 17) for p, q in zip(breaks[:-1], breaks[1:])] or [breaks]))
    if len(edges) < 2:
        return np.zeros(3)
    low, size = edges[:-1], np.diff(edges)
    sums = integrate(low, size)
    errors = np.abs(sums).sum(axis=1)
    used = 8 * len(low)
    while True:
        allowed = relative * np.abs(sums.sum(axis=0)).sum()
        if errors.sum() <= allowed or used > budget:
            return sums.sum(axis=0)
        split = errors > 0.25 * allowed / len(errors)
        beside = np.minimum(np.append(size[1:], np.inf), np.append(np.inf, size[:-1]))
        split |= size > 4.1 * beside
        split &= size > 1e-12 * (edges[-1] - edges[0])
        if not split.any():
            return sums.sum(axis=0)
        half = size[split] / 2
        parts = [integrate(low[split], half), integrate(low[split] + half, half)]
        change = np.abs(parts[0] + parts[1] - sums[split]).sum(axis=1) / 2
        used += 16 * len(half)
        low = np.concatenate([low[~split], low[split], low[split] + half])
        size = np.concatenate([size[~split], half, half])
        sums = np.concatenate([sums[~split], *parts])
        errors = np.concatenate([errors[~split], change, change])
        order = np.argsort(low)
        low, size, sums, errors = low[order], size[order], sums[order], errors[order]


def piecewise(integrand, low, high, breaks):
    """Integral from ``low`` to ``high`` (n) for n functions at once, each smooth between its breaks (n, k; NaN counts as none); values (n, m, 3)."""
    nodes, weights = np.polynomial.legendre.leggauss(10)
    inside = np.clip(np.where(np.isnan(breaks), low[:, None], breaks), low[:, None], high[:, None])
    edges = np.sort(np.concatenate([low[:, None], inside, high[:, None]], axis=1), axis=1)
    middle, half = (edges[:, 1:] + edges[:, :-1]) / 2, (edges[:, 1:] - edges[:, :-1]) / 2
    at = (middle[:, :, None] + half[:, :, None] * nodes).reshape(len(low), -1)
    weight = (half[:, :, None] * weights).reshape(len(low), -1)
    return np.einsum("nmk,nm->nk", integrand(at), weight)


def _levels(light) -> list:
    """Cosines to the axis where the shaping bends, or at which it has fallen by some decades."""
    levels = [0.0]
    if light["cone_angle"] is not None:
        cutoff = math.radians(light["cone_angle"])
        levels += [math.cos(cutoff), math.cos(cutoff * (1 - min(max(light["softness"], 0.0), 1.0)))]
    if light["focus"] > 0:
        levels += [share ** (1 / light["focus"]) for share in (0.9, 0.5, 0.1, 0.01, 1e-4)]
    return levels


def _lines(light, point, normal, start, step, low, high, area):
    """What straight lines of a surface send to the point.

    The lines are ``start + s step``, s from ``low`` to ``high``; ``area`` is the outward surface per unit of s and of the outer
    coordinate, which is the same all along a line.
    """
    axis = _axis(light)
    out = point - start
    step = np.broadcast_to(step, out.shape)
    dot = lambda a, b: np.einsum("...k,...k", a, b)  # noqa: E731
    square = dot(step, step)
    foot = dot(out, step) / square
    height = np.linalg.norm(out - foot[:, None] * step, axis=1) / np.sqrt(square)
    with np.errstate(all="ignore"):
        breaks = [foot + height * k for k in (0.0, *(sign * k for sign in (-1, 1) for k in (0.5, 1.2, 3.0, 8.0, 20.0, 60.0, 300.0)))]
        breaks.append(out @ normal / (step @ normal))
        along, ahead, mixed, far = step @ axis, out @ axis, dot(out, step), dot(out, out)
        for level in _levels(light):
            c2 = level * level
            a, b, c = along**2 - c2 * square, ahead * along - c2 * mixed, ahead**2 - c2 * far
            root = np.sqrt(np.maximum(b * b - a * c, 0.0))
            breaks += [(b - root) / a, (b + root) / a, c / (2 * b)]

    def integrand(s):
        v = out[:, None, :] - s[..., None] * step[:, None, :]
        distance2 = dot(v, v)
        distance = np.sqrt(distance2)
        received = np.maximum(-(v @ normal), 0.0)
        emitted = np.maximum(np.einsum("nk,nmk->nm", area, v), 0.0)
        return shaping(light, v @ axis / distance) * (emitted * received / distance2**2)[..., None]

    breaks = np.array(breaks).T
    breaks[~np.isfinite(breaks)] = np.nan
    return piecewise(integrand, low, high, breaks)


def _axis(light):
    axis = -np.asarray(light["to_world"], dtype=float)[2, :3]
    return axis / np.linalg.norm(axis)


def _frame(light, kind_scale):
    m = np.asarray(light["to_world"], dtype=float)
    return m[0, :3] * kind_scale[0], m[1, :3] * kind_scale[1], m[2, :3] * kind_scale[2], m[3, :3]


def _rect(light, point, normal):
    x, y, z, origin = _frame(light, (light["width"], light["height"], 1.0))
    area = np.cross(x, y)
    area = area * -np.sign(area @ z)
    if (point - origin) @ area <= 0:
        return np.zeros(3)

    def line(a):
        whole = np.ones_like(a)
        return _lines(light, point, normal, origin + a[:, None] * x, y, -0.5 * whole, 0.5 * whole, np.outer(whole, area))

    return adaptive(line, (-0.5, *_foot(point - origin, x, y), 0.5))


def _foot(v, x, y):
    """Place along x of the plane's point nearest to v, where it lies between -1/2 and 1/2: integrands peak there."""
    a = np.linalg.lstsq(np.array([x, y]).T, v, rcond=None)[0][0]
    return (a,) if abs(a) < 0.5 else ()


def _disk(light, point, normal):
    x, y, z, origin = _frame(light, (light["radius"], light["radius"], 1.0))
    area = np.cross(x, y)
    area = area * -np.sign(area @ z)
    if (point - origin) @ area <= 0:
        return np.zeros(3)

    def chord(angle):
        # The chord at x = sin(angle) is 2 cos(angle) long, and x grows by cos(angle).
        cosine = np.cos(angle)
        return _lines(light, point, normal, origin + np.sin(angle)[:, None] * x, y, -cosine, cosine, np.outer(cosine, area))

    return adaptive(chord, (-math.pi / 2, 0.0, math.pi / 2))


def _cylinder(light, point, normal):
    x, y, z, origin = _frame(light, (light["length"], light["radius"], light["radius"]))
    frame = np.array([x, y, z])
    if np.linalg.det(frame) == 0:
        return np.zeros(3)
    local = (point - origin) @ np.linalg.inv(frame)
    distance = math.hypot(local[1], local[2])
    if distance <= 1.0:
        return np.zeros(3)
    facing, reach = math.atan2(local[2], local[1]), math.acos(1.0 / distance)

    def line(turn):
        cosine, sine = np.cos(turn)[:, None], np.sin(turn)[:, None]
        out = cosine * y + sine * z
        area = np.cross(cosine * z - sine * y, x)
        area = area * np.sign(np.einsum("nk,nk->n", area, out))[:, None]
        whole = np.ones_like(turn)
        return _lines(light, point, normal, origin + out, x, -0.5 * whole, 0.5 * whole, area)

    return adaptive(line, (facing - reach, facing, facing + reach))


def _rings(light, normal, pole, towards, reach, limit):
    """Light from the directions of emission within ``reach`` of ``towards`` and within ``limit`` of ``pole``, the axis of the shaping.

    Integrates over rings around the pole. The receiver's normal faces against the directions.
    """
    tilt = math.acos(min(max(pole @ towards, -1.0), 1.0))
    side = towards - (towards @ pole) * pole
    if np.linalg.norm(side) < 1e-12:
        side = np.cross(pole, np.eye(3)[np.argmin(np.abs(pole))])
    side = side / np.linalg.norm(side)
    other = np.cross(pole, side)
    first, second = max(tilt - reach, 0.0), min(tilt + reach, 2 * math.pi - tilt - reach, math.pi)
    # The ring at the antipole closes again where the cap reaches over it.
    last = math.pi if tilt + reach > math.pi else second
    across, along = -(normal @ other), -(normal @ side)
    phase, size = math.atan2(across, along), math.hypot(across, along)

    def ring(angle):
        sine, cosine = np.sin(angle), np.cos(angle)
        with np.errstate(all="ignore"):
            edge = (math.cos(reach) - cosine * math.cos(tilt)) / (sine * math.sin(tilt))
        whole = np.where(cosine * math.cos(tilt) >= math.cos(reach), -1.0, 1.0)
        edge = np.where(np.isfinite(edge), np.clip(edge, -1.0, 1.0), whole)
        half = np.arccos(edge)
        base = -(normal @ pole) * cosine
        with np.errstate(all="ignore"):
            horizon = np.arccos(-base / (sine * size))
        turns = [phase + sign * horizon + 2 * math.pi * k for sign in (-1, 1) for k in (-1, 0, 1)]
        breaks = np.array([*turns, *(np.full_like(angle, q * math.pi / 2) for q in (-1, 0, 1))]).T

        def integrand(turn):
            received = base[:, None] + (sine * size)[:, None] * np.cos(turn - phase)
            return np.broadcast_to(np.maximum(received, 0.0)[..., None], (*turn.shape, 3))

        return piecewise(integrand, -half, half, breaks) * shaping(light, cosine) * sine[:, None]

    inner = {first, second, last, min(max(reach - tilt, 0.0), math.pi), *(math.acos(level) for level in _levels(light) if -1 <= level <= 1)}
    return adaptive(ring, sorted(b for b in {*inner, min(limit, last)} if first <= b <= min(limit, last)))


def _sphere(light, point, normal):
    m = np.asarray(light["to_world"], dtype=float)
    linear, origin = m[:3, :3] * light["radius"], m[3, :3]
    gram = linear @ linear.T
    if np.linalg.det(linear) == 0:
        return np.zeros(3)
    if np.abs(gram - np.eye(3) * gram[0, 0]).max() > 1e-9 * gram[0, 0]:
        return _ellipsoid(light, point, normal, linear, origin)
    out = point - origin
    sine = math.sqrt(gram[0, 0]) / np.linalg.norm(out)
    if sine >= 1.0:
        return np.zeros(3)
    limit = math.pi if light["cone_angle"] is None else math.radians(light["cone_angle"])
    return _rings(light, normal, _axis(light), out / np.linalg.norm(out), math.asin(sine), min(limit, math.pi))


def _ellipsoid(light, point, normal, linear, origin):
    """Rings of the unit sphere that the ellipsoid is an image of; hard cones cost digits here."""
    pole = (point - origin) @ np.linalg.inv(linear)
    distance = np.linalg.norm(pole)
    if distance <= 1.0:
        return np.zeros(3)
    pole = pole / distance
    side = np.cross(pole, np.eye(3)[np.argmin(np.abs(pole))])
    side = side / np.linalg.norm(side)
    other = np.cross(pole, side)
    cofactor = np.linalg.inv(linear).T * abs(np.linalg.det(linear))
    axis = _axis(light)
    turn = (np.arange(2048) + 0.5) * (2 * math.pi / 2048)
    around = np.cos(turn)[:, None] * side + np.sin(turn)[:, None] * other

    def ring(angle):
        q = np.cos(angle)[:, None, None] * pole + np.sin(angle)[:, None, None] * around
        v = point - origin - q @ linear
        distance2 = np.einsum("...k,...k", v, v)
        emitted = np.maximum(np.einsum("...k,...k", q @ cofactor, v), 0.0)
        received = np.maximum(-(v @ normal), 0.0)
        sent = shaping(light, v @ axis / np.sqrt(distance2)) * (emitted * received / distance2**2)[..., None]
        return sent.mean(axis=1) * (2 * math.pi * np.sin(angle))[:, None]

    return adaptive(ring, (0.0, math.acos(1.0 / distance)), budget=8_000)


def _distant(light, normal):
    half = min(max(math.radians(light["angle"]) / 2, 0.0), math.pi)
    axis = _axis(light)
    if half == 0.0:
        return np.full(3, max(-(axis @ normal), 0.0))
    plain = {**light, "cone_angle": None, "focus": 0.0}
    return _rings(plain, normal, axis, axis, half, math.pi)


def illuminance_rgb(light: dict, point, normal) -> np.ndarray:
    """Irradiance by Rec.709 component at a point of a surface with this normal, in units whose luminance is lux."""
    rgb = luminance_colour(light)
    light = {**DEFAULTS, **light}
    point = np.asarray(point, dtype=float)
    normal = np.asarray(normal, dtype=float)
    normal = normal / np.linalg.norm(normal)
    if light["kind"] == "distant":
        return rgb * _distant(light, normal)
    shapes = {"rect": _rect, "disk": _disk, "sphere": _sphere, "cylinder": _cylinder}
    if light["kind"] not in shapes:
        raise ValueError(f"unknown kind of light {light['kind']!r}")
    return rgb * shapes[light["kind"]](light, point, normal)


def illuminance(light: dict, point, normal) -> float:
    """Illuminance in lux at a point of a surface with this normal, to 1e-4 of its value."""
    return float(illuminance_rgb(light, point, normal) @ LUMINANCE)
