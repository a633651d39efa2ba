"""What a scene is, for every renderer alike: flat triangles, surfaces that all share, lights by radiance, one camera.

Metres, y up, linear Rec.709; radiance in cd/m² (its luminance), intensity in cd. Matrices are 4 by 4 for column vectors. Lights shine and
the camera looks along the -z of their frames.
"""

import dataclasses
import importlib
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy
from cornell import Colour, Diffuse, Glass, Mirror, Principled

# What the whole project takes for a watt, lm/W: Cycles is given radiance divided by it.
LUMENS_PER_WATT = 177.83


@dataclass(frozen=True)
class Textured:
    """A Lambertian surface whose reflectance is an image (height, width, 3), float32, the top row first, v = 0 at the bottom."""

    image: numpy.ndarray


# Wavelengths of the lines d, F and C in µm, by which indices and Abbe numbers are stated.
D_LINE, F_LINE, C_LINE = 0.58756, 0.48613, 0.65627


@dataclass(frozen=True)
class Dispersing:
    """Clear glass by its index at the line d and its Abbe number."""

    ior: float
    abbe: float

    def cauchy(self) -> tuple[float, float]:
        """A and B in µm² of the index A + B / λ² that both figures leave."""
        b = (self.ior - 1.0) / self.abbe / (F_LINE**-2 - C_LINE**-2)
        return self.ior - b * D_LINE**-2, b


Surface = Diffuse | Mirror | Glass | Dispersing | Principled | Textured


@dataclass(frozen=True)
class Mesh:
    """Points (N, 3) float32, triangles (M, 3) int32, counter-clockwise seen from outside, uvs (N, 2) float32 where an image lies on it."""

    name: str
    points: numpy.ndarray
    triangles: numpy.ndarray
    surface: Surface
    uvs: numpy.ndarray | None = None
    # (K, 4, 4) float64: one for each copy.
    places: numpy.ndarray = field(default_factory=lambda: numpy.eye(4)[None])
    # (N, 3) float32 where faces are not flat.
    normals: numpy.ndarray | None = None


@dataclass(frozen=True)
class Rectangle:
    """`width` along x, `height` along y. Where lights are surfaces, `behind` is its reflectance; elsewhere rays pass through it."""

    matrix: numpy.ndarray
    width: float
    height: float
    radiance: Colour
    behind: Colour = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Disk:
    """About the z axis; `behind` as of `Rectangle`."""

    matrix: numpy.ndarray
    radius: float
    radiance: Colour
    behind: Colour = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Sphere:
    """Emits outward."""

    matrix: numpy.ndarray
    radius: float
    radiance: Colour


@dataclass(frozen=True)
class Point:
    """Without size; the intensity is in cd."""

    matrix: numpy.ndarray
    intensity: Colour


@dataclass(frozen=True)
class Spot:
    """A point with a cone of a full angle, blended by Blender's law; the intensity on the axis is in cd."""

    matrix: numpy.ndarray
    angle_deg: float
    blend: float
    intensity: Colour


@dataclass(frozen=True)
class Sun:
    """Infinitely far, seen under a full angle."""

    matrix: numpy.ndarray
    angle_deg: float
    radiance: Colour


Light = Rectangle | Disk | Sphere | Point | Spot | Sun


@dataclass(frozen=True)
class Camera:
    """A pinhole; `fov` is the vertical field of view in degrees."""

    matrix: numpy.ndarray
    fov: float


@dataclass(frozen=True)
class Scene:
    """A scene and how it is rendered."""

    meshes: Sequence[Mesh]
    lights: Sequence[Light]
    camera: Camera
    # (height, width, 3) float32 in cd/m², latitude-longitude by the OpenEXR convention: top row +y, centre column +z, left of it +x.
    environment: numpy.ndarray | None = None
    # Multiples of the compared blocks'.
    width: int = 256
    height: int = 256
    # After the first hit, of all kinds together.
    bounces: int = 12


def described(name: str) -> Scene:
    """The scene `theme` or `theme.variant`: what the function `scene`, or that of the variant's name, of `scenes/<theme>.py` returns; `theme.bare` is
    the scene without what casts caustics, seen by direct light alone.
    """
    theme, _, variant = name.partition(".")
    is_bare = variant == "bare"
    made: Scene = getattr(importlib.import_module(f"scenes.{theme}"), "scene" if is_bare else variant or "scene")()
    return without_casters(made) if is_bare else made


def without_casters(scene: Scene) -> Scene:
    """The same without glass and mirrors and without further bounces."""
    meshes = [mesh for mesh in scene.meshes if not isinstance(mesh.surface, Glass | Dispersing | Mirror)]
    return dataclasses.replace(scene, meshes=meshes, bounces=0)
