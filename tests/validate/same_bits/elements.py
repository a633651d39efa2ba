"""Elements of the scenes: shapes, places, materials, lights and cameras. y is up."""

import numpy as np

DATA_PASSES = ["color", "alpha", "depth", "normal", "P", "albedo", "primId", "luminance", "illuminance", "uv", "mist"]
DATA_PASSES += ["emission", "environment", "object_index", "material_index", "sample_count"]
LIGHT_PASSES = [f"{kind}_{part}" for kind in ("diffuse", "glossy", "transmission") for part in ("direct", "indirect", "color")]
GUIDES = ["denoising_normal", "denoising_albedo", "denoising_light"]
# Four tiles.
SIZE = {"width": 128, "height": 96}
GLASS = {"transmission_weight": 1.0, "specular_roughness": 0.0}
MIRROR = {"metalness": 1.0, "base_color": [0.9, 0.8, 0.7], "specular_roughness": 0.0}

SEEN = {"camera": True, "shadow": True, "diffuse": True, "glossy": True, "transmission": True}
# Axes that turn lights, which shine along −z, to the floor, and rectangles, which face up, to the camera, to the floor and to the left.
DOWN = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])
UPRIGHT = DOWN.T
OVER = np.diag([1.0, -1, -1])
LEFTWARD = np.array([[0, -1.0, 0], [1, 0, 0], [0, 0, 1]])


def at(x, y, z, size=1.0, axes=None):
    """A matrix for column vectors that scales, turns and moves."""
    matrix = np.eye(4)
    matrix[:3, :3] = np.eye(3) if axes is None else axes
    matrix[:3, :3] *= size
    matrix[:3, 3] = x, y, z
    return matrix


def looking(eye, target):
    """A matrix whose −z points from the eye to the target."""
    back = np.subtract(eye, target) / np.linalg.norm(np.subtract(eye, target))
    right = np.cross([0.0, 1.0, 0.0], back)
    right /= np.linalg.norm(right)
    return at(*eye, axes=np.stack([right, np.cross(back, right), back], axis=1))


def described(matrix):
    """A matrix as descriptions have it."""
    return {"columns": np.asarray(matrix, float)[:3].T.tolist()}


# Shapes: what `add_mesh` takes.


def quad(width=1.0, depth=1.0, texture_repeats=1.0):
    """A level rectangle about the origin, its front above."""
    corners = np.array([[-1, 0, 1], [1, 0, 1], [1, 0, -1], [-1, 0, -1]]) * [width / 2, 1, depth / 2]
    uvs = np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) * texture_repeats
    return {"points": corners.astype("f4"), "triangles": np.array([[0, 1, 2], [0, 2, 3]], "i4"), "uvs": uvs.astype("f4")}


def box():
    """A closed cube of side 1 that stands on the origin, flat triangles."""
    corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (0, 1) for z in (-0.5, 0.5)], "f4")
    sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    triangles = np.array([t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))], "i4")
    return {"points": corners, "triangles": triangles}


def ball(rings=16):
    """A sphere of radius 1 about the origin with smooth normals and texture coordinates."""
    v, u = np.meshgrid(np.linspace(0, 1, rings + 1), np.linspace(0, 1, 2 * rings + 1), indexing="ij")
    polar, about = np.pi * v.ravel(), 2 * np.pi * u.ravel()
    points = np.stack([np.sin(polar) * np.cos(about), -np.cos(polar), -np.sin(polar) * np.sin(about)], axis=1).astype("f4")
    row = 2 * rings + 1
    first = (np.arange(rings)[:, None] * row + np.arange(row - 1)).ravel()
    triangles = np.concatenate([np.stack([first, first + 1, first + row + 1], 1), np.stack([first, first + row + 1, first + row], 1)])
    uvs = np.stack([u.ravel(), v.ravel()], axis=1).astype("f4")
    return {"points": points, "triangles": triangles.astype("i4"), "normals": points, "uvs": uvs}


def mesh(scene, shape, **more):
    """Adds a shape; gives the mesh's number."""
    shape = {**shape, **more}
    return scene.add_mesh(shape.pop("points"), shape.pop("triangles"), **shape)


def place(scene, number, materials, *matrices, **keywords):
    """Places a mesh at matrices, with one material or one a slot."""
    materials = materials if isinstance(materials, list) else [materials]
    return scene.put_instances(number, materials, np.array(matrices, "f8"), **keywords)


# Materials and images.


def value(given):
    """A number, a colour or a node (number, channel) as an input."""
    if isinstance(given, tuple):
        return {"Node": list(given)}
    numbers = list(given) if isinstance(given, list) else [given] * 3
    return {"Constant": [*numbers, 1.0]}


def closure(model="OpenPbr", weight=1.0, fields=None, **parameters):
    """A closure; `fields` are those that are no parameters."""
    inputs = [[name, value(given)] for name, given in parameters.items()]
    return {"weight": value(weight), "model": model, "parameters": inputs, **(fields or {})}


def material(scene, *closures, nodes=(), outputs=(), index=0):
    """Adds a sum of closures over a graph of nodes (operation, inputs) with shader outputs (name, colour, number)."""
    graph = {"nodes": [{"operation": operation, "inputs": [value(given) for given in inputs]} for operation, inputs in nodes]}
    shown = [{"name": name, "color": value(color), "value": value(number)} for name, color, number in outputs]
    return scene.put_material({"closures": list(closures), "graph": graph, "shader_outputs": shown, "pass_index": index})


def grey(scene, reflectance=0.6):
    """A matt surface."""
    return material(scene, closure(base_color=reflectance, specular_weight=0.0))


def ground(scene):
    """A matt floor with a wall at the back."""
    place(scene, mesh(scene, quad(12, 12)), grey(scene), np.eye(4), at(0, 0, -3, axes=UPRIGHT))


def primvar(name):
    """A node of a mesh's values."""
    return {"Primvar": {"name": name, "fallback": [0.0] * 4}}, []


def image(texture, uv=0, wrap="Repeat"):
    """A node of a filtered image at the coordinates of node `uv`."""
    lookup = {"texture": texture, "wrap": [wrap, wrap], "filter": "Linear", "scale": [1.0] * 4, "bias": [0.0] * 4, "fallback": [1.0] * 4}
    return {"Image": lookup}, [(uv, "Rgb")]


def texture(scene, pixels):
    """Adds an image of linear RGBA."""
    return scene.put_texture({"origin": "pixels", "colour_space": "raw"}, pixels=np.ascontiguousarray(pixels, "f4"))


def checks(side, low, high, alpha=1.0):
    """A chequered image of so many pixels a side, noisy so that no two texels are alike; `alpha` is that of the dark ones."""
    rng = np.random.default_rng(side)
    dark = (np.add.outer(np.arange(side) // 8, np.arange(side) // 8) % 2).astype(bool)[..., None]
    color = np.where(dark, low, high) * rng.uniform(0.7, 1.0, (side, side, 3))
    return np.concatenate([color, np.where(dark, alpha, 1.0)], axis=2)


# Lights and cameras.


def light(scene, shape, radiance, matrix=None, emission=None, shaping=None, visibility=None, **fields):
    """Adds a light of a radiance or a colour, by default seen and shadowing."""
    color = radiance if isinstance(radiance, list) else [radiance] * 3
    description = {
        "origin": "light",
        "shape": shape,
        "emission": {"radiance": color, "normalized": False, "metres_per_unit": 1.0, **(emission or {})},
        "shaping": {"cone_angle_deg": None, "cone_softness": 0.0, "focus": 0.0, "focus_tint": [0.0] * 3, **(shaping or {})},
        "texture": None,
        "transform": described(np.eye(4) if matrix is None else matrix),
        "visibility": {**SEEN, **(visibility or {})},
        "casts_shadow": True,
    }
    return scene.put_light({**description, **fields})


def dome(scene, radiance, **fields):
    """Adds light from all around."""
    return light(scene, {"Dome": {"format": "LatLong"}}, radiance, **fields)


def sun(scene, illuminance, direction, **fields):
    """Adds a distant light of an illuminance from a direction."""
    shape, matrix = {"Distant": {"angle_deg": 0.53}}, looking(direction, (0, 0, 0))
    return light(scene, shape, illuminance, matrix, emission={"normalized": True}, **fields)


def camera(scene, eye, target, width=1.2, **fields):
    """Adds a camera whose picture is `width` wide at the distance 1."""
    description = {
        "origin": "camera",
        "projection": {"Perspective": {"focal_length": 1.0}},
        "aperture": [width, width * SIZE["height"] / SIZE["width"]],
        "aperture_offset": [0.0, 0.0],
        "lens_radius": 0.0,
        "focus_distance": 1.0,
        "clipping": [0.0, 1e6],
        "transform": described(looking(eye, target)),
        "exposure": 1.0,
    }
    return scene.put_camera({**description, **fields})
