"""A luminaire from its parts to its file to a room: `python cad_to_room.py cad_to_room.png downlight.ldt`.

The downlight of examples/usd is measured by the virtual goniophotometer; the file that comes out of it lights a small gallery.
"""

import sys
from pathlib import Path

import gonio
import numpy
from numpy.typing import NDArray
from shapes import at, finished, lathe, noise, put_box, quad, round_profile

STAGE = Path(__file__).resolve().parents[1] / "usd" / "downlight.usda"
WIDTH, DEPTH, HEIGHT = 6.4, 7.0, 3.2


def measured(path: Path) -> None:
    """Writes the downlight's EULUMDAT file."""
    reading = gonio.goniometer(str(STAGE), "/World/Downlight", error=0.01)
    ratio = reading.light_output_ratio
    print(f"{reading.flux.value:.0f} lm leave it" + (f", {100 * ratio.value:.0f} % of its LED's" if ratio else ""))
    reading.write(path, name="downlight")


def painting(seed: int) -> NDArray[numpy.float32]:
    """Fields of colour with soft borders."""
    random = numpy.random.default_rng(seed)
    rows, columns = 192, 160
    colours = random.uniform(0.02, 0.6, (5, 3)) * numpy.array([1.0, 0.75, 0.6])
    level = noise(rows, columns, 3, seed, 3) * 0.35 + numpy.linspace(0, 0.75, rows)[:, None]
    fields = colours[numpy.clip((level * 5).astype(int), 0, 4)]
    shaded: NDArray[numpy.float32] = (fields * (0.8 + 0.4 * noise(rows, columns, 40, seed + 1, 2))[..., None]).astype("f4")
    return shaded


def room(scene: gonio.Scene) -> None:
    """White walls, a dark floor, three paintings and a pedestal."""
    w, d, h = WIDTH / 2, DEPTH, HEIGHT
    white = scene.add_material(base_color=(0.8, 0.79, 0.77), specular_weight=0.0)
    ceiling = scene.add_material(base_color=(0.7, 0.7, 0.69), specular_weight=0.0)
    floor = scene.add_material(
        base_color=scene.add_texture((0.09 + 0.06 * noise(256, 256, 24, 51)).astype("f4"), colour_space="raw", tiles=(3, 3)), specular_roughness=0.3
    )
    quad(scene, [(-w, 0, d), (w, 0, d), (w, 0, 0), (-w, 0, 0)], floor)
    quad(scene, [(-w, h, 0), (w, h, 0), (w, h, d), (-w, h, d)], ceiling)
    quad(scene, [(-w, 0, 0), (w, 0, 0), (w, h, 0), (-w, h, 0)], white)
    quad(scene, [(-w, 0, d), (-w, 0, 0), (-w, h, 0), (-w, h, d)], white)
    quad(scene, [(w, 0, 0), (w, 0, d), (w, h, d), (w, h, 0)], white)
    quad(scene, [(w, 0, d), (-w, 0, d), (-w, h, d), (w, h, d)], white)
    frame = scene.add_material(base_color=(0.03, 0.025, 0.02), specular_roughness=0.4)
    for number, x in enumerate((-2.0, 0.0, 2.0)):
        put_box(scene, (x - 0.57, 0.93, 0.0), (x + 0.57, 2.27, 0.04), frame)
        canvas = scene.add_material(base_color=scene.add_texture(painting(60 + 7 * number), colour_space="lin_rec709"), specular_roughness=0.6)
        quad(scene, [(x - 0.54, 0.96, 0.041), (x + 0.54, 0.96, 0.041), (x + 0.54, 2.24, 0.041), (x - 0.54, 2.24, 0.041)], canvas)
    put_box(scene, (1.35, 0, 2.35), (1.75, 1.0, 2.75), white)
    bronze = scene.add_material(metalness=1.0, base_color=(0.5, 0.32, 0.18), specular_roughness=0.28)
    figure = round_profile([(0.0, 0.0), (0.1, 0.0), (0.05, 0.06), (0.12, 0.2), (0.09, 0.36), (0.03, 0.46), (0.06, 0.55), (0.0, 0.6)], 16)
    scene.add_instance(lathe(scene, figure), [bronze], transform=at(1.55, 1.0, 2.55))
    oak = scene.add_material(base_color=(0.32, 0.2, 0.11), specular_roughness=0.4)
    put_box(scene, (-1.2, 0.38, 2.6), (0.3, 0.44, 3.05), oak)
    for x in (-1.1, 0.16):
        put_box(scene, (x, 0, 2.65), (x + 0.04, 0.38, 3.0), frame)


def main() -> None:
    """Writes the luminaire's file, then the picture."""
    picture, file = (sys.argv[1], sys.argv[2]) if len(sys.argv) > 2 else ("cad_to_room.png", "downlight.ldt")
    measured(Path(file))
    goniogram, notes = gonio.read_goniogram(Path(file).read_bytes(), file)
    for note in notes:
        print(note)
    scene = gonio.Scene()
    room(scene)
    glow = scene.add_material(base_color=(0, 0, 0), emission_color=(2600.0, 2500.0, 2350.0))
    rim = scene.add_material(base_color=(0.75, 0.75, 0.75), specular_roughness=0.3)
    disc, ring = lathe(scene, [(0.0, 0.0), (0.045, 0.0)], 48), lathe(scene, [(0.045, 0.0), (0.056, 0.004), (0.056, 0.008)], 48)
    for x, z in [(x, 0.95) for x in (-2.0, 0.0, 2.0)] + [(x, 3.1) for x in (-2.0, 0.0, 1.55)] + [(x, 5.4) for x in (-2.0, 0.0, 2.0)]:
        # The file looks down its -z: that is the room's -y.
        scene.add_light("luminaire", goniogram=goniogram, transform=[[1, 0, 0, x], [0, 0, 1, HEIGHT - 0.012], [0, -1, 0, z], [0, 0, 0, 1]], visible=False)
        for mesh, material in ((disc, glow), (ring, rim)):
            scene.add_instance(mesh, [material], transform=at(x, HEIGHT - 0.009, z))
    scene.set(width=960, height=600, samples=32)
    scene.add_camera(gonio.look_at((-1.5, 1.55, 6.6), (0.1, 1.42, 0.0)), fov=40)
    finished(scene, picture, exposure=0.9)


if __name__ == "__main__":
    main()
