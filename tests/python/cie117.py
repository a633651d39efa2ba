"""UGR of luminaires in a closed box of a room by CIE 117 in double precision, from a EULUMDAT file's text: nothing of gonio is used.

The background's luminance is the eye's illuminance by reflected light over pi: light between diffuse patches, by form factors of points.
The position index is Guth's formula, which the standard's table is near to.
"""

import math

import numpy as np


class Luminaire:
    """A flat EULUMDAT luminaire of quadrants; C0 is along +x."""

    def __init__(self, path):
        lines = [line.strip() for line in path.read_text(encoding="latin-1").splitlines()]
        planes, angles, sets = int(lines[3]), int(lines[5]), int(lines[25])
        assert lines[2] == "4" and sets == 1 and all(float(lines[k]) == 0 for k in range(17, 21))
        # The length runs along C90.
        self.sides = (float(lines[16]) / 1000, float(lines[15]) / 1000)
        numbers = [float(line) for line in lines[26 + 6 + 10 :] if line]
        stored, start = planes // 4 + 1, planes + angles
        self.c, self.gamma = np.array(numbers[:stored]), np.array(numbers[planes:start])
        self.table = np.array(numbers[start : start + stored * angles]).reshape(stored, angles) * float(lines[28]) / 1000

    def intensity(self, towards):
        """In cd, for vectors in rows."""
        x, y, z = np.moveaxis(towards, -1, 0)
        c, gamma = np.degrees(np.arctan2(abs(y), abs(x))), np.degrees(np.arctan2(np.hypot(x, y), -z))
        i = np.clip(np.searchsorted(self.c, c, "right") - 1, 0, len(self.c) - 2)
        j = np.clip(np.searchsorted(self.gamma, gamma, "right") - 1, 0, len(self.gamma) - 2)
        s = (c - self.c[i]) / (self.c[i + 1] - self.c[i])
        t = (gamma - self.gamma[j]) / (self.gamma[j + 1] - self.gamma[j])
        first = self.table[i, j] * (1 - t) + self.table[i, j + 1] * t
        return first * (1 - s) + s * (self.table[i + 1, j] * (1 - t) + self.table[i + 1, j + 1] * t)


def patches(room, step):
    """Middles, inward normals and areas of the box's faces, and the face of each: floor, ceiling, four walls."""
    found = []
    for axis in (2, 0, 1):
        others = [k for k in range(3) if k != axis]
        counts = [round(room[k] / step) for k in others]
        grids = np.meshgrid(*[(np.arange(n) + 0.5) * room[k] / n for n, k in zip(counts, others)], indexing="ij")
        for side in (0, 1):
            middles = np.zeros((counts[0] * counts[1], 3))
            middles[:, others[0]], middles[:, others[1]], middles[:, axis] = grids[0].ravel(), grids[1].ravel(), side * room[axis]
            normal = np.zeros(3)
            normal[axis] = 1 - 2 * side
            area = room[others[0]] * room[others[1]] / len(middles)
            found.append((middles, np.tile(normal, (len(middles), 1)), np.full(len(middles), area)))
    faces = np.concatenate([np.full(len(part[0]), k) for k, part in enumerate(found)])
    return [np.concatenate([part[k] for part in found]) for k in range(3)] + [faces]


def irradiation(places, normals, middles, others, areas):
    """Illuminance at places per radiance of patches: cos cos / r² times the area."""
    way = middles[None] - places[:, None]
    square = (way**2).sum(-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        here, there = (way * normals[:, None]).sum(-1), -(way * others[None]).sum(-1)
        shares = np.clip(here, 0, None) * np.clip(there, 0, None) / square**2 * areas[None]
    return np.where(square > 1e-12, shares, 0.0)


class Room:
    """A closed room with luminaires that look down, all turned alike."""

    def __init__(self, room, reflectances, luminaire, places, step=0.2):
        self.luminaire, self.places = luminaire, np.array(places, float)
        self.middles, self.normals, self.areas, faces = patches(room, step)
        reflectance = np.array([reflectances[name] for name in ("floor", "ceiling", "wall", "wall", "wall", "wall")])[faces]
        direct = np.zeros(len(self.middles))
        for place in self.places:
            way = self.middles - place
            square = (way**2).sum(-1)
            direct += luminaire.intensity(way) * np.clip(-(way * self.normals).sum(-1), 0, None) / square**1.5
        exchange = irradiation(self.middles, self.normals, self.middles, self.normals, self.areas) / math.pi
        # Near edges points are no good stand-ins for patches: each row is what a closed room must have.
        exchange /= exchange.sum(1, keepdims=True)
        exitance = np.linalg.solve(np.eye(len(direct)) - reflectance[:, None] * exchange, reflectance * direct)
        self.radiance = exitance / math.pi

    def glare(self, way, ahead, parts=32):
        """L² ω / p² of a luminaire this way from the eye, summed over parts of its length: near it each has a place of its own."""
        total, area = 0.0, self.luminaire.sides[0] * self.luminaire.sides[1] / parts
        for k in range(parts):
            part = way + np.array([0.0, ((k + 0.5) / parts - 0.5) * self.luminaire.sides[1], 0.0])
            r, h = part @ ahead, part[2]
            t = np.linalg.norm(part - r * ahead - h * np.array([0, 0, 1]))
            tau, sigma = math.degrees(math.atan2(t, h)), math.degrees(math.atan(math.hypot(h, t) / r))
            first = (35.2 - 0.31889 * tau - 1.22 * math.exp(-2 * tau / 9)) * 1e-3 * sigma
            index = math.exp(first + (21 + 0.26667 * tau - 0.002963 * tau**2) * 1e-5 * sigma**2)
            square = part @ part
            intensity = float(self.luminaire.intensity(-part[None])[0]) / parts
            total += intensity**2 / (area * h / math.sqrt(square)) / square / index**2
        return total

    def ugr(self, eye, ahead):
        """The rating, and how many luminaires ahead are left out: H/R above 1.9 or T/R above 3."""
        eye, ahead = np.array(eye, float), np.array(ahead, float)
        indirect = irradiation(eye[None], ahead[None], self.middles, self.normals, self.areas) @ self.radiance
        background = indirect[0] / math.pi
        total, left_out = 0.0, 0
        for place in self.places:
            way = place - eye
            r = way @ ahead
            h, t = way[2], np.linalg.norm(way - r * ahead - way[2] * np.array([0, 0, 1]))
            if r <= 0:
                continue
            if h / r > 1.9 or t / r > 3:
                left_out += 1
                continue
            total += self.glare(way, ahead)
        return 8 * math.log10(0.25 / background * total), left_out
