"""Scenes in LuxCore; lights are surfaces there, the sun is a distant light that no ray finds, and images and copies are not for it.

Pictures are asked for by milliseconds, since its photon caches cost the same for any number of samples.
"""

import contextlib
import math
import time
from collections.abc import Iterator

import numpy
import pyluxcore
from cornell import Diffuse, Glass, Mirror
from description import Disk, Dispersing, Light, Mesh, Point, Rectangle, Scene, Sphere, Spot, Sun, Surface
from shapes import ball

# Of a ball that stands for a spherical lamp: beyond 256 triangles LuxCore no longer samples it.
LAMP_SUBDIVISIONS = 2
# Metres within which photons are looked up at first: a fiftieth of what one sees, at most.
PHOTON_RADIUS = 0.02
# Of that radius: to which part it shrinks, and within how many a photon must be near what the camera sees to be kept; by itself LuxCore looks for
# seconds for a good one.
SHRUNK, VISIBILITY = 0.1, 5.0
# Light paths of a cache, which is made anew every eight samples.
PHOTONS = 500_000
# Seconds between looks at the clock.
PAUSE = 0.01


class Engine:
    """A scene laid out; pictures are radiance in cd/m², (height, width, 3), the top row first."""

    is_timed = True

    def __init__(self, scene: Scene, threads: int, variant: str) -> None:
        """`variant` is LuxCore's engine, after a plus `photons` or `hybrid` (caustics from a cache, from light paths), or `metropolis` (its sampler);
        `photons@0.002` has another radius in metres.
        """
        pyluxcore.Init()
        self.version = f"LuxCore {pyluxcore.Version()}"
        self._settings = settings(scene, threads, variant)
        self._shape = scene.height, scene.width, 3
        self._scene = pyluxcore.Scene()
        self._scene.Parse(properties(camera(scene)))
        for number, mesh in enumerate(scene.meshes):
            self._place(f"mesh{number}", mesh, material(mesh.surface))
        for number, light in enumerate(scene.lights):
            self._light(f"light{number}", light)

    def render(self, samples: int, seed: int) -> tuple[numpy.ndarray, float, int]:
        """A picture, the seconds that it took with its caches, and `samples`, which are milliseconds here."""
        config = pyluxcore.RenderConfig(properties(self._settings | {"renderengine.seed": seed + 1}), self._scene)
        session = pyluxcore.RenderSession(config)
        start = time.perf_counter()
        with running(session):
            # The caches are ready only when the session has started.
            while time.perf_counter() < start + samples / 1000.0:
                time.sleep(PAUSE)
        seconds = time.perf_counter() - start
        picture = numpy.empty(math.prod(self._shape), "f4")
        session.GetFilm().GetOutputFloat(pyluxcore.FilmOutputType.RGB, picture, 0)
        return picture.reshape(self._shape)[::-1].astype("f8"), seconds, samples

    def _place(self, name: str, mesh: Mesh, surface: dict[str, object]) -> None:
        if len(mesh.places) != 1 or not numpy.array_equal(mesh.places[0], numpy.eye(4)):
            raise NotImplementedError(mesh.name)
        points, triangles = mesh.points.tolist(), mesh.triangles.tolist()
        normals = None if mesh.normals is None else [tuple(normal) for normal in mesh.normals.tolist()]
        self._scene.DefineMesh(name, [tuple(point) for point in points], [tuple(corner) for corner in triangles], normals, None, None, None)
        parts = {f"scene.materials.{name}.{key}": value for key, value in surface.items()}
        parts |= {f"scene.objects.{name}.shape": name, f"scene.objects.{name}.material": name}
        self._scene.Parse(properties(parts))

    def _light(self, name: str, light: Light) -> None:
        match light:
            case Rectangle(matrix, width, height, radiance, behind):
                corners = numpy.array([(-1, -1), (-1, 1), (1, 1), (1, -1)]) * (0.5 * width, 0.5 * height)
                self._place(name, flat(matrix, corners), shining(radiance, behind))
            case Disk(matrix, radius, radiance, behind):
                angle = -2.0 * numpy.pi * numpy.arange(128) / 128
                # As large as the disk.
                fair = radius * math.sqrt(numpy.pi / (64.0 * math.sin(numpy.pi / 64.0)))
                corners = fair * numpy.stack([numpy.cos(angle), numpy.sin(angle)], axis=1)
                self._place(name, flat(matrix, corners), shining(radiance, behind))
            case Sphere(matrix, radius, radiance):
                made = ball(name, (0.0, 0.0, 0.0), radius, Diffuse((0.0, 0.0, 0.0)), LAMP_SUBDIVISIONS)
                fair = 2.0 * radius * math.sqrt(numpy.pi / area(made))
                points = (made.points * fair + matrix[:3, 3]).astype("f4")
                self._place(name, Mesh(name, points, made.triangles, made.surface), shining(radiance, (0.0, 0.0, 0.0)))
            case Point(matrix, intensity):
                gain = [4.0 * math.pi * value for value in intensity]
                parts = {"type": "point", "position": matrix[:3, 3].tolist(), "gain": gain}
                self._scene.Parse(properties({f"scene.lights.{name}.{key}": value for key, value in parts.items()}))
            case Spot(matrix, angle, 0.0, intensity):
                parts = {"type": "spot", "position": matrix[:3, 3].tolist(), "target": (matrix[:3, 3] - matrix[:3, 2]).tolist()}
                parts |= {"coneangle": 0.5 * angle, "conedeltaangle": 0.0, "gain": list(intensity)}
                self._scene.Parse(properties({f"scene.lights.{name}.{key}": value for key, value in parts.items()}))
            case Sun(matrix, angle, radiance):
                parts = {"type": "distant", "direction": (-matrix[:3, 2]).tolist(), "theta": 0.5 * angle, "gain": list(radiance)}
                self._scene.Parse(properties({f"scene.lights.{name}.{key}": value for key, value in parts.items()}))
            case _:
                raise NotImplementedError(light)


@contextlib.contextmanager
def running(session: pyluxcore.RenderSession) -> Iterator[None]:
    """A session at work."""
    session.Start()
    try:
        yield
        session.UpdateStats()
    finally:
        session.Stop()


def properties(values: dict[str, object]) -> pyluxcore.Properties:
    """LuxCore's properties."""
    made = pyluxcore.Properties()
    for name, value in values.items():
        made.Set(pyluxcore.Property(name, list(value) if isinstance(value, tuple) else value))
    return made


def settings(scene: Scene, threads: int, variant: str) -> dict[str, object]:
    """How it renders: nothing clamped, a box filter one pixel wide."""
    engine, _, extra = variant.partition("+")
    extra, _, radius = extra.partition("@")
    depth = scene.bounces + 1
    made: dict[str, object] = {"renderengine.type": engine, "native.threads.count": threads}
    made |= {"sampler.type": "SOBOL", "sampler.sobol.adaptive.strength": 0.0, "film.width": scene.width, "film.height": scene.height}
    made |= {"film.filter.type": "BOX", "film.filter.width": 0.5, "film.outputs.0.type": "RGB", "film.outputs.0.filename": "unused.exr"}
    made |= {f"path.pathdepth.{kind}": depth for kind in ("total", "diffuse", "glossy", "specular")}
    made |= {"path.maxdepth": depth, "light.maxdepth": depth, "path.clamping.variance.maxvalue": 0.0}
    match extra:
        case "photons":
            around = float(radius or PHOTON_RADIUS)
            made |= {"path.photongi.caustic.enabled": True, "path.photongi.photon.maxdepth": depth}
            made |= {"path.photongi.caustic.lookup.radius": around, "path.photongi.caustic.updatespp.minradius": SHRUNK * around}
            # Less than its own choice, which takes longer than a whole picture here.
            made |= {"path.photongi.photon.maxcount": PHOTONS, "path.photongi.visibility.maxsamplecount": PHOTONS // 8}
            made |= {"path.photongi.visibility.lookup.radius": VISIBILITY * around}
        case "metropolis":
            made |= {"sampler.type": "METROPOLIS"}
        case "hybrid":
            made |= {"path.hybridbackforward.enable": True}
    return made


def camera(scene: Scene) -> dict[str, object]:
    """A pinhole; LuxCore's angle is that of the longer side, and its picture stands a row lower than others'."""
    matrix, tall, row = scene.camera.matrix, scene.height / scene.width, 2.0 / scene.width
    assert tall <= 1.0
    tangent = math.tan(math.radians(scene.camera.fov) / 2.0) / tall
    values = {"type": "perspective", "lookat.orig": matrix[:3, 3], "lookat.target": matrix[:3, 3] - matrix[:3, 2], "up": matrix[:3, 1]}
    made: dict[str, object] = {f"scene.camera.{key}": value if isinstance(value, str) else value.tolist() for key, value in values.items()}
    made |= {"scene.camera.fieldofview": 2.0 * math.degrees(math.atan(tangent)), "scene.camera.autofocus.enable": False}
    return made | {"scene.camera.screenwindow": [-1.0, 1.0, -tall - row, tall - row]}


def material(surface: Surface) -> dict[str, object]:
    """A surface."""
    match surface:
        case Diffuse(reflectance):
            return {"type": "matte", "kd": list(reflectance)}
        case Mirror(reflectance, 0.0):
            return {"type": "mirror", "kr": [reflectance] * 3}
        case Glass(ior):
            return {"type": "glass", "kr": [1.0] * 3, "kt": [1.0] * 3, "interiorior": ior, "exteriorior": 1.0}
        case Dispersing():
            # Its stated index is the A of Cauchy's formula, whatever the wavelength; B is in µm².
            a, b = surface.cauchy()
            return {"type": "glass", "kr": [1.0] * 3, "kt": [1.0] * 3, "interiorior": a, "cauchyb": b, "exteriorior": 1.0}
    raise NotImplementedError(surface)


def shining(radiance: tuple[float, ...], behind: tuple[float, ...]) -> dict[str, object]:
    """The surface of a light."""
    return {"type": "matte", "kd": list(behind), "emission": list(radiance)}


def flat(matrix: numpy.ndarray, corners: numpy.ndarray) -> Mesh:
    """A convex polygon in the plane of a light's frame, facing along its -z."""
    points = corners @ matrix[:3, :2].T + matrix[:3, 3]
    fan = [(0, k, k + 1) for k in range(1, len(corners) - 1)]
    return Mesh("light", points.astype("f4"), numpy.array(fan, "i4"), Diffuse((0.0, 0.0, 0.0)))


def area(mesh: Mesh) -> float:
    """Of all triangles."""
    a, b, c = (mesh.points[mesh.triangles[:, k]].astype("f8") for k in range(3))
    return float(0.5 * numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum())
