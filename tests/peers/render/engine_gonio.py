"""Scenes in gonio, by its Python module."""

import json
import time
from typing import Any

import cornell_gonio
import gonio
import numpy
from cornell import Diffuse, Glass, Mirror, Principled
from description import Disk, Dispersing, Light, Mesh, Point, Rectangle, Scene, Sphere, Spot, Sun, Surface, Textured


class Engine:
    """A scene laid out; pictures are radiance in cd/m², (height, width, 3), the top row first."""

    def __init__(self, scene: Scene, threads: int, variant: str = "") -> None:
        """`variant` has further settings of `gonio.Scene.set`: `name=value`, values in JSON or else words, with commas between them."""
        self.version = f"gonio {gonio.__version__}, {gonio.simd_level}"
        self._scene = gonio.Scene()
        self._scene.set(width=scene.width, height=scene.height, max_bounces=scene.bounces, passes=["color"], threads=threads)
        self._scene.set(filter="box", filter_width=1.0, samples=1, **settings(variant))
        for mesh in scene.meshes:
            self._place(mesh)
        for light in scene.lights:
            self._scene.put_light(described(light))
        if scene.environment is not None:
            self._surround(scene.environment)
        self._scene.add_camera(scene.camera.matrix.tolist(), fov=scene.camera.fov)
        # Trees and tables are kept from one render to the next.
        self._previous = gonio.Render(self._scene)
        self._previous.wait()

    def render(self, samples: int, seed: int) -> tuple[numpy.ndarray, float, int]:
        """A picture, the seconds that its samples took, and how many they were."""
        film, seconds = self.film(samples, seed)
        return colour(film), seconds, samples

    def film(self, samples: int, seed: int, **settings: Any) -> tuple[gonio.Film, float]:
        """A film with other settings of `gonio.Scene.set`, which stay, and the seconds that its samples took."""
        self._scene.set(samples=samples, seed=seed, **settings)
        render = gonio.Render(self._scene, self._previous)
        start = time.perf_counter()
        render.wait()
        seconds = time.perf_counter() - start
        # That light paths run by themselves is no fault, nor what they do not see where they are all that is asked for.
        faults = [line for line in render.diagnostics if not line[1].endswith("(caustics)") and line[0] != "integrator light"]
        assert not faults, faults
        self._previous = render
        return render.film(), seconds

    def _place(self, mesh: Mesh) -> None:
        uvs = mesh.uvs if isinstance(mesh.surface, Textured) else None
        number = self._scene.add_mesh(mesh.points, mesh.triangles, normals=mesh.normals, uvs=uvs, name=mesh.name)
        self._scene.put_instances(number, [self._material(mesh)], mesh.places, name=mesh.name)

    def _material(self, mesh: Mesh) -> int:
        graph: dict[str, Any] = {"nodes": []}
        if isinstance(mesh.surface, Textured):
            closure = {"model": "Diffuse", "parameters": [["base_color", {"Node": [1, "Rgb"]}]]}
            graph["nodes"] = texture_nodes(self._texture(mesh.name, mesh.surface.image))
        else:
            model, values = parameters(mesh.surface)
            constants = {name: value if isinstance(value, tuple) else (value,) * 3 for name, value in values.items()}
            closure = {"model": model, "parameters": [[name, {"Constant": [*value, value[0]]}] for name, value in constants.items()]}
        return self._scene.put_material({"origin": {"name": mesh.name, "file": ""}, "closures": [closure], "graph": graph})

    def _texture(self, name: str, image: numpy.ndarray) -> int:
        whole = numpy.ones((*image.shape[:2], 4), "f4")
        whole[..., :3] = image
        return self._scene.put_texture({"origin": {"name": name, "file": ""}, "colour_space": "raw"}, pixels=whole)

    def _surround(self, image: numpy.ndarray) -> None:
        dome = {"shape": {"Dome": {"format": "LatLong"}}, "texture": self._texture("sky", image)}
        self._scene.put_light(light_fields("sky", numpy.eye(4), (1.0, 1.0, 1.0), **dome))


def settings(variant: str) -> dict[str, Any]:
    """What a variant sets."""
    made: dict[str, Any] = {}
    for part in filter(None, variant.split(",")):
        name, _, value = part.partition("=")
        try:
            made[name] = json.loads(value)
        except json.JSONDecodeError:
            made[name] = value
    return made


def colour(film: gonio.Film) -> numpy.ndarray:
    """Radiance in cd/m², (height, width, 3) float64, the top row first."""
    return numpy.asarray(film["color"])[:, :, :3].astype("f8")


def texture_nodes(texture: int) -> list[dict[str, Any]]:
    """The image at the surface's coordinates: node 1."""
    image = {"texture": texture, "wrap": ["Repeat", "Repeat"], "filter": "Linear"}
    image |= {"scale": [1.0] * 4, "bias": [0.0] * 4, "fallback": [0.0] * 4}
    coordinates = {"operation": {"Primvar": {"name": "st", "fallback": [0.0] * 4}}, "inputs": []}
    return [coordinates, {"operation": {"Image": image}, "inputs": [{"Node": [0, "Rgb"]}]}]


def parameters(surface: Surface) -> tuple[str, dict[str, Any]]:
    """The model and its parameters, those that Blender's nodes of these names become."""
    match surface:
        case Diffuse(reflectance):
            return "Diffuse", {"base_color": reflectance}
        case Mirror(reflectance, roughness):
            return "Glossy", {"base_color": (reflectance,) * 3, "specular_roughness": roughness}
        case Glass(ior):
            return "Glass", {"base_color": (1.0, 1.0, 1.0), "specular_roughness": 0.0, "specular_ior": ior}
        case Dispersing(ior, abbe):
            clear = {"base_color": (1.0, 1.0, 1.0), "specular_roughness": 0.0}
            return "Glass", clear | {"specular_ior": ior, "transmission_dispersion": 1.0 / abbe}
        case Principled():
            return "Principled", cornell_gonio.parameters(surface)
    raise NotImplementedError(surface)


def described(light: Light) -> dict[str, Any]:
    """A light in the form of the scene description."""
    match light:
        case Rectangle(matrix, width, height, radiance):
            return light_fields("rectangle", matrix, radiance, shape={"Rectangle": {"width": width, "height": height}})
        case Disk(matrix, radius, radiance):
            return light_fields("disk", matrix, radiance, shape={"Disk": {"radius": radius}})
        case Sphere(matrix, radius, radiance):
            return light_fields("sphere", matrix, radiance, shape={"Sphere": {"radius": radius}})
        case Point(matrix, intensity):
            return light_fields("point", matrix, intensity, shape="Point")
        case Spot(matrix, angle, blend, intensity):
            return light_fields("spot", matrix, intensity, shape="Point", spot={"angle_deg": angle, "blend": blend})
        case Sun(matrix, angle, radiance):
            return light_fields("sun", matrix, radiance, shape={"Distant": {"angle_deg": angle}})


def light_fields(name: str, matrix: numpy.ndarray, radiance: tuple[float, ...], **fields: Any) -> dict[str, Any]:
    """All fields of a light."""
    return {
        "origin": {"name": name, "file": ""},
        "emission": {"radiance": list(radiance), "normalized": False, "metres_per_unit": 1.0},
        "shaping": {"cone_angle_deg": None, "cone_softness": 0.0, "focus": 0.0, "focus_tint": [0.0, 0.0, 0.0]},
        "texture": None,
        "transform": {"columns": matrix.T[:, :3].tolist()},
        "visibility": dict.fromkeys(("camera", "shadow", "diffuse", "glossy", "transmission"), True),
        "casts_shadow": True,
        **fields,
    }
