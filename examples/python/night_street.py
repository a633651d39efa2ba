"""A street after rain, lit by its lamps and by what people left on: `python night_street.py night_street.png`."""

import sys

import gonio
import numpy
from shapes import at, box, finished, noise, put_box, quad

LENGTH = 70.0
ROAD, WALK = 3.4, 2.2
POLE, REACH = 6.0, 1.3


def luminaire() -> dict[str, object]:
    """A street lamp's goniogram: two wings along the road, more to the road than to the houses; 4200 lm."""
    gammas, planes = numpy.arange(0, 91, 5.0), numpy.arange(0, 360, 15.0)
    g, c = numpy.radians(gammas)[None, :], numpy.radians(planes)[:, None]
    along = numpy.abs(numpy.sin(c))
    wings = 0.9 * along**2 * numpy.exp(-(((g - numpy.radians(58)) / 0.26) ** 2)) + 0.5 * numpy.exp(-((g / 0.7) ** 2))
    candela = wings * (0.5 + 0.5 * numpy.cos(c)) * (g < numpy.radians(80))
    rows = "\n".join(" ".join(f"{value:.4f}" for value in row) for row in [*candela, candela[0]])
    angles = [" ".join(f"{angle:g}" for angle in values) for values in (gammas, [*planes, 360.0])]
    ies = f"IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 {len(gammas)} {len(planes) + 1} 1 2 0.3 0.5 0\n1 1 60\n{angles[0]}\n{angles[1]}\n{rows}\n"
    goniogram, _ = gonio.read_goniogram(ies.encode(), "street.ies")
    return goniogram


def ground(scene: gonio.Scene) -> None:
    """Wet asphalt with puddles, kerbs and pavements."""
    wet = noise(512, 512, 6, 3)
    rough = numpy.clip((wet - 0.42) * 3.0, 0.0, 1.0)
    asphalt = scene.add_material(
        base_color=scene.add_texture((0.022 + 0.03 * noise(512, 512, 64, 5, 2)).astype("f4"), colour_space="raw", tiles=(1, 8)),
        specular_roughness=scene.add_texture((0.06 + 0.42 * rough).astype("f4"), colour_space="raw", tiles=(1, 9)),
    )
    quad(scene, [(-ROAD, 0, 8), (ROAD, 0, 8), (ROAD, 0, -LENGTH), (-ROAD, 0, -LENGTH)], asphalt)
    slabs = numpy.full((128, 128), 0.13)
    slabs[:3], slabs[:, :3] = 0.05, 0.05
    stone = scene.add_material(
        base_color=scene.add_texture((slabs * (0.75 + 0.5 * noise(128, 128, 8, 9))).astype("f4"), colour_space="raw", tiles=(4, 120)),
        specular_roughness=0.42,
    )
    kerb = scene.add_material(base_color=(0.2, 0.19, 0.18), specular_roughness=0.3)
    for side in (-1, 1):
        inner, outer = sorted((side * (ROAD + 0.15), side * (ROAD + WALK + 0.2)))
        quad(scene, [(inner, 0.14, 8), (outer, 0.14, 8), (outer, 0.14, -LENGTH), (inner, 0.14, -LENGTH)], stone)
        edge = sorted((side * ROAD, side * (ROAD + 0.16)))
        put_box(scene, (edge[0], -0.1, -LENGTH), (edge[1], 0.145, 8), kerb)


def houses(scene: gonio.Scene) -> None:
    """Two rows of houses with windows, a third of them lit, and shops below."""
    random = numpy.random.default_rng(11)
    glass = scene.add_material(base_color=(0.01, 0.012, 0.015), specular_roughness=0.03)
    frame = scene.add_material(base_color=(0.35, 0.33, 0.3), specular_roughness=0.5)
    lit = [
        scene.add_material(base_color=(0, 0, 0), emission_color=tuple(luminance * part for part in colour))
        for luminance, colour in ((55.0, (1, 0.72, 0.42)), (30.0, (1, 0.62, 0.3)), (70.0, (1, 0.86, 0.68)), (16.0, (0.55, 0.7, 1)))
    ]
    shop = scene.add_material(base_color=(0, 0, 0), emission_color=(64, 44, 25))
    pane = box(scene, (-0.55, 0, -0.02), (0.55, 1.5, 0.02))
    sill = box(scene, (-0.7, -0.1, -0.02), (0.7, 0.0, 0.14))
    front = ROAD + WALK + 0.2
    for side in (-1, 1):
        z = 7.0
        while z > -LENGTH:
            width, floors = random.uniform(7.5, 11.0), int(random.integers(3, 6))
            tint = numpy.array([0.3, 0.26, 0.22]) * random.uniform(0.65, 1.15) + random.uniform(-0.05, 0.05, 3)
            wall = scene.add_material(base_color=tuple(tint), specular_weight=0.3, specular_roughness=0.8)
            low, high = sorted((side * front, side * (front + 8.0)))
            put_box(scene, (low, 0, z - width), (high, 3.9 + 3.05 * (floors - 1), z), wall)
            put_box(scene, (low - 0.25, 3.85 + 3.05 * (floors - 1), z - width), (high + 0.25, 4.1 + 3.05 * (floors - 1), z), frame)
            count = int(width // 2.1)
            for column in range(count):
                place = z - width * (column + 0.5) / count
                for floor in range(1, floors):
                    chosen = lit[int(random.integers(len(lit)))] if random.random() < 0.34 else glass
                    turned = at(side * (front - 0.01), 1.35 + 3.05 * floor, place, -90.0 * side)
                    scene.add_instance(pane, [chosen], transform=turned)
                    scene.add_instance(sill, [frame], transform=turned)
            if random.random() < 0.62:
                inner = side * (front - 0.03)
                quad(scene, [(inner, 0.75, z - 1.0), (inner, 0.75, z - width + 1.0), (inner, 2.7, z - width + 1.0), (inner, 2.7, z - 1.0)], shop)
                for part in numpy.linspace(z - 1.0, z - width + 1.0, 5):
                    put_box(scene, (inner - 0.05, 0.7, part - 0.04), (inner + 0.05, 2.75, part + 0.04), frame)
            z -= width


def lamps(scene: gonio.Scene) -> None:
    """Poles on both sides in turn, each with a lamp of 3000 K that leans over the road."""
    iron = scene.add_material(base_color=(0.05, 0.055, 0.06), specular_roughness=0.45)
    head = scene.add_material(base_color=(0, 0, 0), emission_color=(5000, 4100, 3000))
    goniogram = luminaire()
    for number, z in enumerate(numpy.arange(-3.0, -LENGTH, -11.0)):
        side = 1.0 if number % 2 else -1.0
        foot, reach = side * (ROAD + 0.5), side * (ROAD + 0.5 - REACH)
        put_box(scene, (foot - 0.05, 0, z - 0.05), (foot + 0.05, POLE + 0.1, z + 0.05), iron)
        low, high = sorted((foot, reach))
        put_box(scene, (low, POLE + 0.04, z - 0.03), (high, POLE + 0.1, z + 0.03), iron)
        put_box(scene, (reach - 0.3, POLE, z - 0.15), (reach + 0.3, POLE + 0.09, z + 0.15), iron)
        quad(scene, [(reach - 0.24, POLE - 0.003, z - 0.1), (reach + 0.24, POLE - 0.003, z - 0.1), (reach + 0.24, POLE - 0.003, z + 0.1), (reach - 0.24, POLE - 0.003, z + 0.1)], head)
        # C0 to the road: the lamp's +x goes across it.
        down = gonio.look_at((reach, POLE - 0.02, z), (reach, 0, z), (0, 0, side))
        scene.add_light("point", goniogram=goniogram, lumens=6500.0, temperature=3000.0, transform=down)


def main() -> None:
    """Writes the picture."""
    scene = gonio.Scene()
    ground(scene)
    houses(scene)
    lamps(scene)
    # What a city's sky has left of the dusk.
    scene.add_light("dome", (0.035, 0.06, 0.13))
    scene.set(width=960, height=600, samples=48, light_samples=1)
    scene.add_camera(gonio.look_at((-1.5, 1.55, 7.2), (0.35, 2.35, -14.0)), fov=46)
    finished(scene, sys.argv[1] if len(sys.argv) > 1 else "night_street.png", exposure=-1.2)


if __name__ == "__main__":
    main()
