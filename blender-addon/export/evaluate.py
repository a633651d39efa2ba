# SPDX-License-Identifier: GPL-3.0-or-later
"""Node graphs evaluated for many directions or points at once, with the pictures they look up."""

import numpy as np
from gonio.graph import compute

from .material.textures import MISSING


# The pixels of a missing image.
LOST = np.full((1, 1, 4), MISSING, dtype=np.float32)


class Pictures:
    """The images of a node tree as `Images` has them, and which of them has which number."""

    def __init__(self, images, report):
        self._images, self._report, self._by_number = images, report, {}

    def __getattr__(self, name):
        return getattr(self._images, name)

    def texture(self, image, *arguments):
        """As `Images.texture`."""
        number = self._images.texture(image, *arguments)
        self._by_number[number] = image
        return number

    def look_up(self, fields, uv):
        """The values of an Image operation; black for images that were never asked for."""
        image = self._by_number.get(fields["texture"])
        if image is None:
            return np.zeros(uv.shape)
        return look_up(self.pixels(image), uv, fields["wrap"], fields["filter"] == "Closest") * fields["scale"] + fields["bias"]

    def pixels(self, image):
        """An image's pixels as (height, width, 4), linear, the bottom row first; the colour of missing images where it has none."""
        pixels = self._images.linear(image, self._report)
        return LOST if pixels is None else pixels


def evaluate(graph, sources, shape, leaf):
    """Sources of a graph as arrays that end in four components; `leaf(operation, inputs)` gives what is no arithmetic, or None."""
    results = []

    def read(source):
        if "Constant" in source:
            return np.broadcast_to(np.array(source["Constant"]), shape)
        value, channel = results[source["Node"][0]], source["Node"][1]
        return value if channel == "Rgb" else np.repeat(value[..., "RGBA".index(channel), None], 4, axis=-1)

    with np.errstate(all="ignore"):
        for node in graph.nodes:
            operation, inputs = node["operation"], [read(source) for source in node["inputs"]]
            value = leaf(operation, inputs)
            if value is None:
                value = _computed(operation, inputs)
            results.append(np.zeros(shape) if value is None else np.broadcast_to(value, shape))
        return [np.array(read(source)) for source in sources]


def _computed(operation, inputs):
    """What the renderer's kernels give; None for operations that ask for a surface point."""
    if not inputs:
        return None
    rows = [np.ascontiguousarray(each, dtype=np.float32).reshape(-1, 4) for each in inputs]
    found = compute(operation, rows)
    return None if found is None else np.asarray(found).reshape(inputs[0].shape)


def look_up(pixels, uv, wrap, closest):
    """Pixels, the bottom row first, at coordinates of 0 to 1 from the lower left corner, bilinear unless `closest`."""
    height, width = pixels.shape[:2]
    x, y = uv[..., 0] * width - 0.5, uv[..., 1] * height - 0.5
    if closest:
        x, y = np.floor(x + 0.5), np.floor(y + 0.5)
    left, low = np.floor(x).astype(int), np.floor(y).astype(int)
    right, high = (x - left)[..., None], (y - low)[..., None]

    def texel(column, row):
        column, is_in = _wrapped(column, width, wrap[0])
        row, is_in_too = _wrapped(row, height, wrap[1])
        return pixels[row, column] * (is_in & is_in_too)[..., None]

    lower = texel(left, low) * (1.0 - right) + texel(left + 1, low) * right
    upper = texel(left, low + 1) * (1.0 - right) + texel(left + 1, low + 1) * right
    return lower * (1.0 - high) + upper * high


def _wrapped(place, count, wrap):
    """Places within 0 .. count − 1, and whether there is a picture."""
    inside = np.ones(place.shape, dtype=bool)
    if wrap == "Repeat":
        return place % count, inside
    if wrap == "Mirror":
        place = place % (2 * count)
        return np.minimum(place, 2 * count - 1 - place), inside
    if wrap == "Black":
        inside = (place >= 0) & (place < count)
    return np.clip(place, 0, count - 1), inside
