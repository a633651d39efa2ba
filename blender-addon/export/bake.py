# SPDX-License-Identifier: GPL-3.0-or-later
"""A world's nodes evaluated for every direction, where no simpler dome says the same."""

import numpy as np

from .evaluate import LOST, evaluate, look_up
from .sky_texture import Picture

# Rows of a baked world without images; one with an image has the image's rows up to the limit.
ROWS, MOST_ROWS = 512, 2048


def bake(t, total, report):
    """(rows, 2 rows, 4) linear pixels, the top row (+Z) first, the middle column at +X."""
    # An image that could not be had is without a number.
    pictures = [(image, number is not None) for image, number, *_ in t.environments.values()]
    rows = min(MOST_ROWS, max([ROWS, *(image.size[1] for image, _ in pictures)]))
    report.add("World", t.owner.name, f"its nodes were baked to {2 * rows} × {rows} directions", severity="INFO")
    values = []
    loaded = {image.name: _pixels(image, t.images) if is_there else LOST for image, is_there in pictures}
    for top in range(0, rows, 64):
        directions = _directions(rows, range(top, min(top + 64, rows)))
        values += evaluate(t.graph, [total.input()], directions.shape, _leaves(t, directions, loaded))
    pixels = np.concatenate(values, axis=0).astype(np.float32)
    pixels[..., :3] = np.nan_to_num(pixels[..., :3], posinf=0.0, neginf=0.0)
    pixels[..., 3] = 1.0
    return pixels


def _directions(rows, numbers):
    latitude = (0.5 - (np.array(numbers) + 0.5) / rows) * np.pi
    longitude = (0.5 - (np.arange(2 * rows) + 0.5) / (2 * rows)) * 2.0 * np.pi
    latitude, longitude = np.meshgrid(latitude, longitude, indexing="ij")
    flat = np.cos(latitude)
    return np.stack([flat * np.cos(longitude), flat * np.sin(longitude), np.sin(latitude), np.zeros_like(flat)], axis=-1)


def _leaves(t, directions, loaded):
    """What a world's nodes know beside arithmetic: the direction, and pictures."""

    def leaf(operation, inputs):
        if operation == "Direction":
            return directions
        if not isinstance(operation, dict):
            return None
        if "Image" in operation:
            return t.images.look_up(operation["Image"], inputs[0])
        if "Lookup" not in operation:
            return None
        fields = operation["Lookup"]
        wrap = ("Repeat" if fields["repeat"] else "Clamp", "Clamp")
        return look_up(loaded[fields["image"]], inputs[0], wrap, fields["closest"])

    return leaf


def _pixels(image, images):
    return image.pixels[::-1] if isinstance(image, Picture) else images.pixels(image)
