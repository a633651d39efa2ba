"""Scenes of light, of what is seen, and of sampling."""

import gonio
import numpy as np
from elements import (
    DATA_PASSES, DOWN, GLASS, LEFTWARD, LIGHT_PASSES, MIRROR, OVER, SIZE, UPRIGHT, at, ball, box, camera, checks, closure, dome, grey,
    ground, light, looking, material, mesh, place, primvar, quad, sun, texture,
)  # fmt: skip


def luminaire():
    """The goniogram of a file: a cosine-like beam, wider across than along, of an opening of a box's shape."""
    rows = "\n".join(" ".join(f"{1000 * np.cos(np.radians(v)) ** power:.3f}" for v in range(0, 91, 15)) for power in (1, 2, 3))
    head = "IESNA:LM-63-2002\nTILT=NONE\n1 3000 1 7 3 1 2 0.3 1.2 0.1\n1 1 30\n0 15 30 45 60 75 90\n0 45 90\n"
    return gonio.read_goniogram((head + rows + "\n").encode(), "made.ies")[0]


def room(scene):
    """Data and light passes, shader outputs, mist, a thin lens, limits of bounces by kind, and lights of every shape."""
    passes = [*DATA_PASSES, *LIGHT_PASSES, "aov:paint", "aov_value:paint"]
    scene.set(**SIZE, samples=16, filter="gaussian", filter_width=2.0, mist=(2.0, 8.0, 1.5), passes=passes)
    scene.set(max_bounces=6, max_diffuse_bounces=2, max_glossy_bounces=3, max_transmission_bounces=4, max_transparent_bounces=2)
    ground(scene)
    rng = np.random.default_rng(1)
    paints = {"paint": rng.uniform(size=(12, 4)).astype("f4")}
    sphere, cube = mesh(scene, ball()), mesh(scene, box(), primvars=paints, slots=np.arange(12, dtype="i4") // 6)
    shown, output = closure(base_color=(0, "Rgb"), specular_roughness=0.4), ("paint", (0, "Rgb"), (0, "A"))
    paint = material(scene, shown, nodes=[primvar("paint")], outputs=[output], index=7)
    place(scene, cube, [paint, grey(scene)], at(-1.2, 0, 0), at(1.3, 0, -1.2, 1.4), pass_index=3)
    place(scene, sphere, material(scene, closure(**GLASS), index=8), at(0.2, 0.5, 0.4, 0.5), pass_index=4)
    coated = {"coat_weight": 0.8, "coat_roughness": 0.1, "fuzz_weight": 0.3, "thin_film_weight": 0.5, "specular_anisotropy": 0.6}
    place(scene, sphere, material(scene, closure(metalness=0.5, specular_roughness=0.35, **coated)), at(1.1, 0.4, 0.6, 0.4))
    spot = {"angle_deg": 50.0, "blend": 0.3, "stretch": [1.0, 0.7]}
    light(scene, "Point", 60.0, looking((-2, 3, 2), (0, 0, 0)), spot=spot)
    light(scene, {"Disk": {"radius": 0.3}}, 12.0, looking((2, 2.5, 1), (0, 0, 0)), spread_deg=70.0)
    cone = {"cone_angle_deg": 60.0, "cone_softness": 0.5}
    light(scene, {"Ellipse": {"width": 0.5, "height": 0.2}}, 9.0, at(0, 2.6, -1, axes=DOWN), shaping=cone)
    light(scene, {"Cylinder": {"radius": 0.05, "length": 1.0}}, [4.0, 6.0, 9.0], at(-1, 1.8, -1.5), casts_shadow=False)
    light(scene, {"FacingDisk": {"radius": 0.2}}, 6.0, at(1.8, 1.2, 1.4), visibility={"camera": False, "glossy": False})
    light(scene, {"Sphere": {"radius": 0.15}}, [9.0, 6.0, 3.0], at(0.4, 1.6, 0.2), quantity={"Lumens": 300.0}, dimming=0.8)
    camera(scene, (0.5, 1.6, 4.2), (0, 0.6, 0), lens_radius=0.06, focus_distance=3.9, blades=6, lens_ratio=1.3)


def groups(scene):
    """Light groups whose sum is clamped, an emissive mesh among them."""
    names = ["lightgroup:key", "lightgroup:panel", "lightgroup:sky", "lightgroup:other"]
    scene.set(**SIZE, samples=16, clamp_direct=2.0, clamp_indirect=0.6, passes=["color", "luminance", "illuminance", *names])
    ground(scene)
    flat, cube = mesh(scene, quad()), mesh(scene, box())
    place(scene, cube, material(scene, closure(base_color=[0.7, 0.3, 0.2], specular_roughness=0.2)), at(-0.8, 0, 0))
    place(scene, cube, material(scene, closure(**MIRROR)), at(0.9, 0, -0.6, 1.2))
    glow = material(scene, closure(base_color=0.1, emission_color=[30.0, 20.0, 10.0]))
    place(scene, flat, glow, at(1.2, 1.8, 0.8, 0.5, axes=OVER), light_group="panel")
    light(scene, {"Sphere": {"radius": 0.2}}, 40.0, at(-1.5, 2.2, 1), group="key")
    dome(scene, [0.2, 0.3, 0.5], group="sky")
    sun(scene, [2.0, 1.8, 1.5], (0.5, 1.0, 0.4))
    camera(scene, (0.2, 1.8, 3.0), (0, 0.5, 0), projection={"FisheyeEquidistant": {"fov_deg": 120.0}})


def catcher(scene):
    """A catcher of shadows under objects before nothing, a hole cut by another object, parallel rays."""
    scene.set(**SIZE, samples=16, film_transparent=True, passes=["color", "alpha", "luminance", "depth", "normal"])
    place(scene, mesh(scene, quad(6, 6)), grey(scene), np.eye(4), visibility={"shadow_catcher": True})
    sphere, cube = mesh(scene, ball()), mesh(scene, box())
    place(scene, sphere, material(scene, closure(base_color=[0.2, 0.5, 0.8])), at(-0.6, 0.5, 0, 0.5))
    place(scene, sphere, material(scene, closure(**GLASS)), at(0.5, 0.4, 0.7, 0.4))
    place(scene, cube, grey(scene), at(0.9, 0, -0.5, 0.7), visibility={"holdout": True})
    place(scene, cube, material(scene, closure("Holdout")), at(-1.6, 0, 0.6, 0.5))
    dome(scene, [0.6, 0.8, 1.0])
    sun(scene, 3.0, (0.7, 1.0, 0.5), visibility={"camera": False})
    camera(scene, (0.3, 2.5, 4), (0, 0.3, 0), width=4.0, projection="Orthographic")


def lamps(scene):
    """More lights than are weighed one by one, on both sides of a wall: the tree and what is learned; a grid and an observer."""
    scene.set(**SIZE, samples=32, max_bounces=3, passes=["color", "illuminance", "luminance"])
    place(scene, mesh(scene, quad(24, 24)), grey(scene, 0.5), np.eye(4), at(0.4, 0, 0, axes=LEFTWARD))
    place(scene, mesh(scene, ball(4)), material(scene, closure(emission_color=20.0)), *(at(x, 0.3, -2.5, 0.1) for x in range(-3, 4)))
    made = luminaire()
    for number in range(90):
        where = at(number % 10 * 2 - 9.0, 1 + number % 3 * 0.2, number // 10 * 2 - 8.0, axes=DOWN)
        match number % 4:
            case 0:
                light(scene, {"Sphere": {"radius": 0.05}}, [90.0, 80.0, 60.0], where)
            case 1:
                light(scene, {"Rectangle": {"width": 0.3, "height": 0.2}}, 12.0, where)
            case 2:
                light(scene, "Point", 1.0, where, goniogram=made, quantity="Measured", dimming=0.01)
            case 3:
                light(scene, {"Disk": {"radius": 0.1}}, 20.0, where, shaping={"focus": 4.0, "cone_angle_deg": 80.0})
    scene.add_meter((6, 0.7, 3), normal=(0, 1, 0), facing=(-1, 0, -0.5), quantity="ugr")
    scene.add_grid(corner=(-2, 0.8, 2), edges=((4, 0, 0), (0, 0, -4)), spacing=0.5)
    camera(scene, (4.5, 2.2, 4.5), (2, 0.3, 0))


def daylight(scene):
    """A room with a portal under sun, sky and a dome's image, luminaires with openings; a panorama, meters and grids."""
    scene.set(**SIZE, samples=16, max_bounces=5, passes=["color", "illuminance", "luminance", "environment", "P"])
    side = mesh(scene, quad(4, 4))
    place(scene, side, grey(scene), at(0, 0, 0), at(0, 2.5, 0, axes=OVER), at(0, 1.5, -2, axes=UPRIGHT), at(-2, 1.5, 0, axes=LEFTWARD.T))
    pane = closure(fields={"thin_walled": True}, **GLASS)
    place(scene, mesh(scene, quad(2, 2)), material(scene, pane), at(2, 1.3, 0, axes=LEFTWARD))
    place(scene, mesh(scene, box()), grey(scene, 0.3), at(-0.7, 0, -0.9, 0.7))
    scene.add_daylight(gonio.daylight(48.21, 16.37, "2025-06-21T17:30+02:00", sky="perez"), up="Y", north=60.0, rows=64)
    dome(scene, 0.5, texture=texture(scene, np.tile(checks(64, [900.0], [3000.0]), (1, 2, 1))))
    light(scene, {"Rectangle": {"width": 2.0, "height": 2.0}}, 1.0, looking((2.05, 1.3, 0), (0, 1.3, 0.0)), portal=True)
    made = luminaire()
    for matrix, quantity in ((at(-0.5, 2.3, 0, axes=DOWN), "Measured"), (at(1, 2.2, -1), {"LampLumens": 2500.0})):
        light(scene, {"Opening": made["opening"]}, 1.0, matrix, goniogram=made, quantity=quantity)
    for number, quantity in enumerate(["illuminance", "cylindrical", "semicylindrical", "daylight-factor", "luminance"]):
        scene.add_meter((0.5, 1.2, 0.2 * number), normal=(0, 1, 0), facing=(-1, 0, -0.2), quantity=quantity)
    for quantity in ("illuminance", "daylight-factor", "cylindrical"):
        scene.add_grid(corner=(-1.5, 0.8, 1.5), edges=((3, 0, 0), (0, 0, -3)), spacing=0.75, quantity=quantity)
    scene.add_grid(mesh=side, transform=at(0, 1.2, 0).tolist(), spacing=1.0, margin=0.3, quantity="illuminance")
    around = {"Equirectangular": {"longitude": [-np.pi, np.pi], "latitude": [-np.pi / 2, np.pi / 2]}}
    camera(scene, (0.3, 1.4, 0.8), (0, 1.3, -1), projection=around)


def crowd(scene):
    """Meshes taken apart, shared ones and a large one, under a noise threshold that ends quiet parts early."""
    scene.set(**SIZE, samples=128, noise_threshold=0.06, min_samples=16, max_bounces=3)
    scene.set(passes=["color", "primId", "sample_count", "normal"])
    ground(scene)
    rng = np.random.default_rng(11)
    spots = [at(*rng.uniform([-3, 0, -2.5], [3, 0, 1.5]), rng.uniform(0.1, 0.3)) for _ in range(90)]
    paint = material(scene, closure(base_color=(0, "Rgb"), specular_roughness=0.25), nodes=[primvar("tint")])
    tints = {"tint": rng.uniform(size=(45, 3)).astype("f4")}
    place(scene, mesh(scene, box()), paint, *spots[:45], primvars=tints)
    place(scene, mesh(scene, ball()), paint, *spots[45:], primvars=tints)
    # More triangles than one part of a tree has.
    place(scene, mesh(scene, ball(96)), grey(scene), at(-2.2, 0.7, -1.5, 0.7))
    light(scene, {"Rectangle": {"width": 4.0, "height": 3.0}}, 4.0, at(0, 5, 0, axes=DOWN))
    light(scene, {"Sphere": {"radius": 0.05}}, 300.0, at(1, 1, 1))
    camera(scene, (0, 2.2, 4.6), (0, 0.2, 0))
