"""Puts scenes together for gonio's Python module: meshes of one material, images by a function, point lights."""

from collections.abc import Callable

import gonio
import numpy

Vector = tuple[float, float, float]
# Sides of rods, and subdivisions of balls' octahedra.
SIDES, SUBDIVISIONS = 8, 5


class Builder:
    """A scene in the making; metres, y up."""

    def __init__(self, width: int, height: int, depth: int, margin: int = 0) -> None:
        """A picture of so many pixels, and `margin` more of the same size on the whole of each axis."""
        self.scene = gonio.Scene()
        self._wider = (width + margin) / width
        size = {"width": width + margin, "height": height + margin}
        self.scene.set(**size, max_bounces=depth, integrator="whitted", passes=["color", "sample_count"])

    def surface(self, colour: Vector, **parameters: float) -> int:
        """A layered surface; without more it is a Lambertian one."""
        return self.scene.add_material(base_color=colour, **{"specular_weight": 0.0, **parameters})

    def chequered(self, colours: tuple[Vector, Vector], squares: int = 16, texels: int = 64) -> int:
        """A Lambertian surface with an image of squares, filtered by footprint."""
        row = numpy.arange(squares * texels) // texels % 2
        odd = (row[:, None] ^ row[None, :]).astype(bool)
        image = numpy.ones((*odd.shape, 4), "f4")
        image[..., :3] = numpy.where(odd[..., None], *colours)
        texture = self.scene.put_texture({"origin": {"name": "squares", "file": ""}, "colour_space": "raw"}, pixels=image)
        lookup = {"texture": texture, "wrap": ["Repeat", "Repeat"], "filter": "Linear"}
        lookup |= {"scale": [1.0] * 4, "bias": [0.0] * 4, "fallback": [0.0] * 4}
        nodes = [
            {"operation": {"Primvar": {"name": "st", "fallback": [0.0] * 4}}, "inputs": []},
            {"operation": {"Image": lookup}, "inputs": [{"Node": [0, "Rgb"]}]},
        ]
        closure = {"model": "Diffuse", "parameters": [["base_color", {"Node": [1, "Rgb"]}]]}
        return self.scene.put_material({"origin": {"name": "squares", "file": ""}, "closures": [closure], "graph": {"nodes": nodes}})

    def add(self, points: numpy.ndarray, triangles: numpy.ndarray, material: int, uvs: numpy.ndarray | None = None) -> None:
        """Places a mesh."""
        mesh = self.scene.add_mesh(numpy.asarray(points, "f4"), numpy.asarray(triangles, "i4"), uvs=uvs)
        self.scene.add_instance(mesh, [material])

    def quad(self, corner: Vector, u: Vector, v: Vector, material: int, repeats: float = 1.0) -> None:
        """A parallelogram from a corner and two edges."""
        corner, u, v = (numpy.asarray(vector) for vector in (corner, u, v))
        uvs = numpy.array([(0, 0), (1, 0), (1, 1), (0, 1)], "f4") * repeats
        self.add(numpy.stack([corner, corner + u, corner + u + v, corner + v]), numpy.array([(0, 1, 2), (0, 2, 3)]), material, uvs)

    def box(self, centre: Vector, size: Vector, material: int, turn_deg: float = 0.0) -> None:
        """A box about its centre, turned about y."""
        corners = numpy.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]) * size
        cosine, sine = numpy.cos(numpy.radians(turn_deg)), numpy.sin(numpy.radians(turn_deg))
        corners = corners @ numpy.array([[cosine, 0, -sine], [0, 1, 0], [sine, 0, cosine]]) + centre
        faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        # Corners of their own for each face, so that no edge is smooth.
        points = numpy.concatenate([corners[list(face)] for face in faces])
        self.add(points, numpy.array([t for f in range(0, 24, 4) for t in ((f, f + 1, f + 2), (f, f + 2, f + 3))]), material)

    def rod(self, start: Vector, end: Vector, radius: float, material: int) -> None:
        """A prism between two points."""
        start, end = numpy.asarray(start), numpy.asarray(end)
        axis = (end - start) / numpy.linalg.norm(end - start)
        side = numpy.cross(axis, (1.0, 0.0, 0.0) if abs(axis[0]) < 0.9 else (0.0, 1.0, 0.0))
        side /= numpy.linalg.norm(side)
        angle = 2.0 * numpy.pi * numpy.arange(SIDES)[:, None] / SIDES
        ring = radius * (numpy.cos(angle) * side + numpy.sin(angle) * numpy.cross(axis, side))
        here, following = numpy.arange(SIDES), (numpy.arange(SIDES) + 1) % SIDES
        walls = [(here, following, following + SIDES), (here, following + SIDES, here + SIDES)]
        self.add(numpy.concatenate([start + ring, end + ring]), numpy.concatenate([numpy.stack(wall, 1) for wall in walls]), material)

    def ball(self, centre: Vector, radii: float | Vector, material: int, subdivisions: int = SUBDIVISIONS) -> None:
        """An octahedron refined towards an ellipsoid, with smooth normals."""
        points, triangles = refined(subdivisions)
        normals = points / numpy.asarray(radii)
        normals /= numpy.linalg.norm(normals, axis=1, keepdims=True)
        mesh = self.scene.add_mesh((points * radii + centre).astype("f4"), triangles, normals=normals.astype("f4"))
        self.scene.add_instance(mesh, [material])

    def lamp(self, position: Vector, candela: float) -> None:
        """A point light."""
        self.scene.put_light(point_light(position, candela))

    def look(self, position: Vector, target: Vector, fov: float) -> gonio.Scene:
        """Adds the camera and gives the scene."""
        backward = numpy.subtract(position, target)
        backward = backward / numpy.linalg.norm(backward)
        right = numpy.cross((0.0, 1.0, 0.0), backward)
        right /= numpy.linalg.norm(right)
        matrix = numpy.eye(4)
        matrix[:3, :] = numpy.stack([right, numpy.cross(backward, right), backward, position], axis=1)
        half = numpy.arctan(numpy.tan(numpy.radians(fov / 2)) * self._wider)
        self.scene.add_camera(matrix.tolist(), fov=float(numpy.degrees(2 * half)))
        return self.scene


def refined(subdivisions: int) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Points of the unit sphere and triangles, an octahedron's split by their edges' middles."""
    points = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    triangles = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(subdivisions):
        known: dict[tuple[int, int], int] = {}

        def middle(a: int, b: int, known: dict[tuple[int, int], int] = known) -> int:
            key = (min(a, b), max(a, b))
            if key not in known:
                known[key] = len(points)
                points.append(tuple((numpy.add(points[a], points[b]) * 0.5).tolist()))
            return known[key]

        split = [(a, b, c, middle(a, b), middle(b, c), middle(c, a)) for a, b, c in triangles]
        triangles = [t for a, b, c, ab, bc, ca in split for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]
    found = numpy.asarray(points, "f8")
    return found / numpy.linalg.norm(found, axis=1, keepdims=True), numpy.asarray(triangles, "i4")


def point_light(position: Vector, candela: float) -> dict[str, object]:
    """A point light in the form of the scene description."""
    visible = dict.fromkeys(("camera", "shadow", "diffuse", "glossy", "transmission"), True)
    columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], list(position)]
    return {
        "origin": {"name": "lamp", "file": ""},
        "emission": {"radiance": [candela] * 3, "normalized": False, "metres_per_unit": 1.0},
        "shaping": {"cone_angle_deg": None, "cone_softness": 0.0, "focus": 0.0, "focus_tint": [0.0, 0.0, 0.0]},
        "texture": None,
        "transform": {"columns": columns},
        "visibility": visible,
        "casts_shadow": True,
        "shape": "Point",
    }


Make = Callable[..., gonio.Scene]
"""Makes a scene for a picture of so many pixels in width and height, and so many more at the margin."""
