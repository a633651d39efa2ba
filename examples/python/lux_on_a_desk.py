"""How many lux fall on a desk under two luminous panels: `python lux_on_a_desk.py lux_on_a_desk.png`."""

import sys

import gonio
import numpy
from numpy.typing import NDArray

WIDTH, DEPTH, HEIGHT = 4.0, 3.0, 2.8
DESK_WIDTH, DESK_DEPTH, DESK_HEIGHT = 1.6, 0.8, 0.74


def add_quad(scene: gonio.Scene, corners: list[tuple[float, float, float]], reflectance: float) -> None:
    """A flat, matt quadrilateral."""
    material = scene.add_material(base_color=(reflectance,) * 3, specular_weight=0.0)
    mesh = scene.add_mesh(numpy.array(corners, "f4"), numpy.array([[0, 1, 2], [0, 2, 3]], "i4"))
    scene.add_instance(mesh, [material])


def office() -> gonio.Scene:
    """A room with reflectances of 0.7, 0.5 and 0.2, a desk, two panels of 3000 cd/m², and a camera under the ceiling."""
    scene = gonio.Scene()
    scene.set(width=640, height=640, samples=64, passes=["color", "illuminance", "P", "denoising_albedo", "denoising_normal"])
    w, d, h = WIDTH / 2, DEPTH / 2, HEIGHT
    add_quad(scene, [(-w, 0, d), (w, 0, d), (w, 0, -d), (-w, 0, -d)], 0.2)
    add_quad(scene, [(-w, h, -d), (w, h, -d), (w, h, d), (-w, h, d)], 0.7)
    add_quad(scene, [(-w, 0, -d), (w, 0, -d), (w, h, -d), (-w, h, -d)], 0.5)
    add_quad(scene, [(w, 0, d), (-w, 0, d), (-w, h, d), (w, h, d)], 0.5)
    add_quad(scene, [(-w, 0, d), (-w, 0, -d), (-w, h, -d), (-w, h, d)], 0.5)
    add_quad(scene, [(w, 0, -d), (w, 0, d), (w, h, d), (w, h, -d)], 0.5)
    x, y, z = DESK_WIDTH / 2, DESK_HEIGHT, DESK_DEPTH / 2
    add_quad(scene, [(-x, y, z), (x, y, z), (x, y, -z), (-x, y, -z)], 0.4)
    # Cameras look and flat lights shine along their -z, here turned downwards.
    for place in (-1.0, 1.0):
        down = gonio.look_at((place, h - 0.01, -0.7), (place, 0, -0.7), (0, 0, -1))
        scene.add_light("rectangle", (3000.0,) * 3, width=0.6, height=0.6, transform=down)
    scene.add_camera(gonio.look_at((0, h - 0.05, 0), (0, 0, 0), (0, 0, -1)), fov=56.0)
    return scene


def clean(film: gonio.Film) -> NDArray[numpy.float32]:
    """The illuminance without its noise, where pyoidn is there: the steps of false colour are to follow the light."""
    # The denoiser takes colours.
    shown = film.with_pass("color", numpy.repeat(numpy.asarray(film["illuminance"]), 4, axis=2))
    try:
        shown = gonio.denoise(shown)
    except gonio.UnsupportedError as error:
        print(error)
    return numpy.ascontiguousarray(numpy.asarray(shown["color"])[..., 0])


def main() -> None:
    """Renders the illuminance pass and prints the desk's figures."""
    scene = office()
    with gonio.Render(scene) as render:
        render.wait()
        film = render.film()
    lux = numpy.asarray(film["illuminance"])[..., 0]
    points = numpy.asarray(film["P"])
    # Pixels whose every sample fell on the desk; their noise is averaged over blocks of 16 x 16.
    desk = numpy.abs(points[..., 1] - DESK_HEIGHT) < 1e-3
    blocks = numpy.where(desk, lux, numpy.nan).reshape(40, 16, 40, 16).mean(axis=(1, 3))
    print(f"E_avg {numpy.nanmean(blocks):.0f} lx, E_min {numpy.nanmin(blocks):.0f} lx, E_max {numpy.nanmax(blocks):.0f} lx")
    shown = gonio.false_colour(clean(film), unit="lx", max=500, contours=True)
    shown.write(sys.argv[1] if len(sys.argv) > 1 else "lux_on_a_desk.png")


if __name__ == "__main__":
    main()
