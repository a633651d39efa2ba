# SPDX-License-Identifier: GPL-3.0-or-later
"""A world's nodes evaluated for every direction, where no simpler dome says the same."""

import numpy as np

from .material.operations import compute
from .sky_texture import Picture

# Rows of a baked world without images; one with an image has the image's rows up to the limit.
ROWS, MOST_ROWS = 512, 2048


def bake(t, total, images, report):
    """(rows, 2 rows, 4) linear pixels, the top row (+Z) first, the middle column at +X."""
    pictures = {node: image for node, (image, *_) in t.environments.items()}
    rows = min(MOST_ROWS, max([ROWS, *(image.size[1] for image in pictures.values())]))
    report.add("World", t.owner.name, f"its nodes were baked to {2 * rows} × {rows} directions", severity="INFO")
    values = []
    loaded = {image.name: _pixels(image, images, report) for image in pictures.values()}
    for top in range(0, rows, 64):
        directions = _directions(rows, range(top, min(top + 64, rows)))
        values.append(_evaluate(t, total, directions, loaded))
    pixels = np.concatenate(values, axis=0).astype(np.float32)
    pixels[..., :3] = np.nan_to_num(np.maximum(pixels[..., :3], 0.0), posinf=0.0)
    pixels[..., 3] = 1.0
    return pixels


def _directions(rows, numbers):
    latitude = (0.5 - (np.array(numbers) + 0.5) / rows) * np.pi
    longitude = (0.5 - (np.arange(2 * rows) + 0.5) / (2 * rows)) * 2.0 * np.pi
    latitude, longitude = np.meshgrid(latitude, longitude, indexing="ij")
    flat = np.cos(latitude)
    return np.stack([flat * np.cos(longitude), flat * np.sin(longitude), np.sin(latitude), np.zeros_like(flat)], axis=-1)


def _evaluate(t, total, directions, loaded):
    shape, results = directions.shape, []

    def read(source):
        if "Constant" in source:
            return np.broadcast_to(np.array(source["Constant"]), shape)
        value, channel = results[source["Node"][0]], source["Node"][1]
        return value if channel == "Rgb" else np.repeat(value[..., "RGBA".index(channel), None], 4, axis=-1)

    with np.errstate(all="ignore"):
        for node in t.graph.nodes:
            operation, inputs = node["operation"], [read(source) for source in node["inputs"]]
            if operation == "Direction":
                value = directions
            elif isinstance(operation, dict) and ("Lookup" in operation or "Image" in operation):
                value = _look_up(operation, inputs[0], loaded)
            else:
                value = compute(operation, inputs)
            results.append(np.zeros(shape) if value is None else np.broadcast_to(value, shape))
        return np.array(read(total.input()))


def _pixels(image, images, report):
    if isinstance(image, Picture):
        return image.pixels[::-1]
    pixels = images.linear(image, report)
    return np.zeros((1, 1, 4), dtype=np.float32) if pixels is None else pixels


def _look_up(operation, uv, loaded):
    """Bilinear, u repeating, v held at the poles."""
    fields = operation.get("Lookup")
    pixels = loaded.get(fields["image"]) if fields else None
    if pixels is None:
        return np.zeros(uv.shape)
    height, width = pixels.shape[:2]
    x, y = uv[..., 0] * width - 0.5, uv[..., 1] * height - 0.5
    if fields["closest"]:
        x, y = np.floor(x + 0.5), np.floor(y + 0.5)
    left, low = np.floor(x).astype(int), np.floor(y).astype(int)
    right, high = (x - left)[..., None], (y - low)[..., None]

    def texel(column, row):
        column = column % width if fields["repeat"] else np.clip(column, 0, width - 1)
        return pixels[np.clip(row, 0, height - 1), column]

    lower = texel(left, low) * (1.0 - right) + texel(left + 1, low) * right
    upper = texel(left, low + 1) * (1.0 - right) + texel(left + 1, low + 1) * right
    return lower * (1.0 - high) + upper * high
