"""A cloud of an array of densities in the morning sun: `python cloud.py cloud.png`."""

import sys
from typing import Any

import gonio
import numpy as np
from shapes import finished, quad

# Voxels along the cloud, and their edge in metres.
SHAPE, VOXEL = (160, 80, 120), 5.0
Array = np.ndarray[Any, np.dtype[np.float64]]


def smooth_noise(place: Array, cells: float, seed: int) -> Array:
    """Values from 0 to 1 that change over a cell, smoothly, for places in a box of 1."""
    table = np.random.default_rng(seed).random((16, 16, 16))
    scaled = place * cells
    low = np.floor(scaled).astype(int)
    part = scaled - low
    part = part * part * (3.0 - 2.0 * part)
    total = np.zeros(place.shape[:-1])
    for corner in np.ndindex(2, 2, 2):
        weight = np.prod(np.where(corner, part, 1.0 - part), axis=-1)
        total += weight * table[tuple(((low + corner) % 16).T)].T
    return total


def densities() -> Array:
    """A heap of balls, ragged by noise of five octaves, flat below."""
    axes = [(np.arange(n) + 0.5) / max(SHAPE) for n in SHAPE]
    place = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    balls = [(0.25, 0.12, 0.37, 0.13), (0.45, 0.17, 0.36, 0.19), (0.66, 0.14, 0.4, 0.15), (0.52, 0.26, 0.33, 0.11), (0.8, 0.1, 0.36, 0.09)]
    heap = np.max([radius - np.linalg.norm(place - (x, y, z), axis=-1) for x, y, z, radius in balls], axis=0)
    noise = sum(0.5**octave * smooth_noise(place, 6.0 * 2.0**octave, octave) for octave in range(5))
    shape = heap + 0.16 * (noise - 1.1)
    found: Array = np.clip(shape / 0.03, 0.0, 1.0) * np.clip((place[..., 1] - 0.04) / 0.05, 0.0, 1.0)
    return found


def main() -> None:
    """Writes the picture."""
    scene = gonio.Scene()
    meadow = scene.add_material(base_color=(0.06, 0.1, 0.03), specular_weight=0.0)
    quad(scene, [(-6e4, 0, 6e4), (6e4, 0, 6e4), (6e4, 0, -6e4), (-6e4, 0, -6e4)], meadow)
    place = [[1.0, 0.0, 0.0, -400.0], [0.0, 1.0, 0.0, 250.0], [0.0, 0.0, 1.0, -300.0], [0.0, 0.0, 0.0, 1.0]]
    # Droplets scatter nearly all that they meet, forwards.
    scene.add_volume(densities(), scattering=0.09, anisotropy=0.8, voxel=VOXEL, transform=place, name="cloud")
    scene.add_daylight(gonio.daylight(47.0, 8.0, "2026-06-21T10:30+02:00", ground=0.1), up="Y")
    scene.set(width=960, height=600, samples=16, max_bounces=64, max_volume_bounces=64)
    scene.add_camera(gonio.look_at((0.0, 120.0, 1150.0), (0.0, 345.0, 0.0)), fov=36)
    finished(scene, sys.argv[1] if len(sys.argv) > 1 else "cloud.png", exposure=1.5)


if __name__ == "__main__":
    main()
