"""The sun through a ball of glass onto a floor."""

from cornell import Diffuse, Glass
from description import Camera, Light, Mesh, Scene, Sun
from lineup import BOUNCES
from shapes import ball, facing, quad, smoothed

# About 100,000 lx on a surface that faces the sun.
SUN = (1.55e9, 1.45e9, 1.3e9)


def scene() -> Scene:
    """The shadow of the ball and the light within it, and the wall behind."""
    meshes = [*stage(), smoothed(ball("glass", (0.0, 0.122, 0.0), 0.12, Glass(1.5), 6))]
    sun: list[Light] = [Sun(facing((-1.0, 1.3, 0.7), (0.0, 0.0, 0.0)), 0.53, SUN)]
    return Scene(meshes, sun, Camera(facing((0.35, 0.6, 0.9), (0.1, 0.07, -0.07)), 27.0), width=192, height=144, bounces=BOUNCES)


def stage() -> list[Mesh]:
    """A floor and a wall."""
    return [
        quad("floor", [(-1, 0, 1), (1, 0, 1), (1, 0, -0.6), (-1, 0, -0.6)], Diffuse((0.5, 0.48, 0.45))),
        quad("wall", [(-1, 0, -0.6), (1, 0, -0.6), (1, 0.8, -0.6), (-1, 0.8, -0.6)], Diffuse((0.6, 0.4, 0.3))),
        ball("marble", (0.3, 0.04, 0.12), 0.04, Diffuse((0.2, 0.5, 0.25))),
    ]
