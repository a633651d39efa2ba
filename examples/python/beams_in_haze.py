"""Beams of five spots in the haze of a small stage, and a lux plan: `python beams_in_haze.py beams_in_haze.png beams_in_haze_plan.png`."""

import sys

import gonio
import numpy
from gonio.medium import haze
from shapes import Point, at, finished, lathe, put_box, quad, round_profile

# Where spots hang and what they point at, metres, and their colours.
SPOTS: list[tuple[Point, Point, tuple[float, float, float]]] = [
    ((-3.2, 4.6, 0.6), (-0.5, 0.6, -0.2), (1.0, 0.62, 0.35)),
    ((-1.6, 4.6, -1.6), (-1.5, 0.0, -0.6), (0.45, 0.6, 1.0)),
    ((0.0, 4.6, 1.2), (0.0, 1.0, -0.2), (1.0, 0.95, 0.88)),
    ((1.6, 4.6, -1.6), (1.5, 0.0, -0.6), (0.45, 0.6, 1.0)),
    ((3.2, 4.6, 0.6), (0.5, 0.6, -0.2), (1.0, 0.62, 0.35)),
]


def stage(scene: gonio.Scene) -> None:
    """Floor and walls, dark as theatres are, and steps with a vase on them."""
    floor = scene.add_material(base_color=(0.12, 0.1, 0.09), specular_roughness=0.35)
    dark = scene.add_material(base_color=(0.08, 0.08, 0.09), specular_weight=0.0)
    quad(scene, [(-5, 0, 5), (5, 0, 5), (5, 0, -3), (-5, 0, -3)], floor)
    quad(scene, [(-5, 0, -3), (5, 0, -3), (5, 5, -3), (-5, 5, -3)], dark)
    quad(scene, [(-5, 0, 5), (-5, 0, -3), (-5, 5, -3), (-5, 5, 5)], dark)
    quad(scene, [(5, 0, -3), (5, 0, 5), (5, 5, 5), (5, 5, -3)], dark)
    quad(scene, [(-5, 5, -3), (5, 5, -3), (5, 5, 5), (-5, 5, 5)], dark)
    pale = scene.add_material(base_color=(0.6, 0.58, 0.55), specular_weight=0.0)
    for step in range(3):
        half = 1.1 - 0.25 * step
        put_box(scene, (-half, 0.16 * step, -0.2 - half), (half, 0.16 * (step + 1), -0.2 + half), pale)
    glaze = scene.add_material(base_color=(0.75, 0.7, 0.62), specular_roughness=0.15, coat_weight=1.0)
    vase = round_profile([(0.0, 0.0), (0.14, 0.0), (0.25, 0.25), (0.3, 0.5), (0.16, 0.85), (0.1, 1.0), (0.15, 1.12)])
    scene.add_instance(lathe(scene, [*vase, (0.13, 1.115), (0.08, 1.0), (0.0, 0.95)]), [glaze], transform=at(0, 0.48, -0.2))


def lit_stage() -> gonio.Scene:
    """The stage, its spots, and haze."""
    scene = gonio.Scene()
    stage(scene)
    for place, target, colour in SPOTS:
        towards = gonio.look_at(place, target)
        scene.add_light("sphere", colour, radius=0.02, candela=9000.0, spot=(18.0, 0.25), transform=towards, visible=False)
    # Contrast falls to 5 % within 30 m: haze that machines make for shows.
    scene.put_atmosphere(haze(30.0, anisotropy=0.6))
    return scene


def write_plan(path: str) -> None:
    """Illuminance of a level plane 0.5 m above the floor, just above the steps, seen from above with the back wall on top."""
    scene = lit_stage()
    scene.add_grid(corner=(-4.0, 0.5, 3.0), edges=[(8.0, 0.0, 0.0), (0.0, 0.0, -5.0)], spacing=0.1, name="plan")
    plan = gonio.measure(scene, samples=512).grids[0]
    # Rows go from the front to the back; each point becomes 8 x 8 pixels.
    lux = numpy.asarray(plan.values)[::-1]
    shown = gonio.false_colour(numpy.kron(lux, numpy.ones((8, 8))), unit="lx", max=800.0, steps=8, contours=True)
    shown.write(path)
    print(f"plan 0.5 m above the floor: {plan.average.value:.0f} lx in the mean, {plan.max.value:.0f} lx at most")


def main() -> None:
    """Writes the picture and the plan."""
    picture, plan = sys.argv[1:] if len(sys.argv) == 3 else ("beams_in_haze.png", "beams_in_haze_plan.png")
    scene = lit_stage()
    scene.set(width=960, height=600, samples=40, max_bounces=6)
    scene.add_camera(gonio.look_at((0.0, 1.7, 4.8), (0.0, 1.95, -0.6)), fov=50)
    film = finished(scene, picture, exposure=-0.7)
    lux = numpy.asarray(film["illuminance"])
    print(f"illuminance of what is seen, through the haze: {lux.mean():.0f} lx in the mean")
    write_plan(plan)


if __name__ == "__main__":
    main()
