"""Scenes whose pictures are priced in colour and by wavelength: those of the examples, taken where they would be rendered, and a grey box under lamps."""

import importlib
import sys
from collections.abc import Callable
from pathlib import Path

import gonio
import numpy

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "examples" / "python"))

GREY = (0.5, 0.5, 0.5)


def of_example(name: str) -> gonio.Scene:
    """The scene that an example's `main` hands over to be finished."""
    shapes, example = importlib.import_module("shapes"), importlib.import_module(name)
    taken: list[gonio.Scene] = []
    for module in (shapes, example):
        vars(module)["finished"] = lambda scene, *_, **__: taken.append(scene)
    # Daylight factors are no part of the picture.
    if hasattr(example, "daylight_factors"):
        vars(example)["daylight_factors"] = list
    arguments, sys.argv = sys.argv, [name]
    try:
        example.main()
    finally:
        sys.argv = arguments
    return taken[0]


def office(spectrum: str | None = None) -> gonio.Scene:
    """The office, all of its lamps and its window of a spectrum where one is named."""
    scene = gonio.load_usd(ROOT / "examples" / "usd" / "office.usda")
    if spectrum is not None:
        table = gonio.illuminant(spectrum)
        lamp = {key: table[key] for key in ("name", "wavelengths_nm", "power")}
        for number, light in enumerate(scene.to_dict()["lights"]):
            scene.put_light({**light, "spectrum": lamp}, number)
    return scene


def grey_box(spectrum: str | None) -> gonio.Scene:
    """A box of grey walls with a block, under a lamp of white light."""
    scene = gonio.Scene()
    grey = scene.add_material(base_color=GREY, specular_weight=0.0)
    gloss = scene.add_material(base_color=GREY, specular_roughness=0.3)
    corners = [
        [(-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)],
        [(-1, 2, -1), (1, 2, -1), (1, 2, 1), (-1, 2, 1)],
        [(-1, 0, -1), (1, 0, -1), (1, 2, -1), (-1, 2, -1)],
        [(-1, 0, 1), (-1, 0, -1), (-1, 2, -1), (-1, 2, 1)],
        [(1, 0, -1), (1, 0, 1), (1, 2, 1), (1, 2, -1)],
    ]
    shapes = importlib.import_module("shapes")
    for quad in corners:
        shapes.quad(scene, quad, grey)
    shapes.put_box(scene, (-0.3, 0.0, -0.3), (0.4, 0.9, 0.3), gloss, shapes.at(0.1, 0, -0.1, 20))
    lamp = {} if spectrum is None else {"spectrum": spectrum}
    scene.add_light("rectangle", (1000.0,) * 3, width=0.6, height=0.6, transform=gonio.look_at((0, 1.99, 0), (0, 0, 0), (0, 0, -1)), **lamp)
    scene.add_camera(gonio.look_at((0, 1, 4.2), (0, 1, 0)), fov=35.0)
    return scene


SCENES: dict[str, Callable[[], gonio.Scene]] = {
    "office": office,
    "office, LED-B3": lambda: office("LED-B3"),
    "office, FL11": lambda: office("FL11"),
    "cornell box": lambda: of_example("cornell_box"),
    "glass": lambda: of_example("caustics"),
    "car paint": lambda: of_example("car_paint"),
    "hair": lambda: of_example("hair"),
    "daylit room": lambda: of_example("daylight_room"),
    "grey box": lambda: grey_box(None),
    "grey box, LED-B3": lambda: grey_box("LED-B3"),
    "grey box, FL11": lambda: grey_box("FL11"),
    "grey box, HP1": lambda: grey_box("HP1"),
}


def rendered(scene: gonio.Scene, previous: gonio.Render | None) -> gonio.Render:
    rendering = gonio.Render(scene, previous)
    rendering.wait()
    return rendering


def rgb(rendering: gonio.Render) -> numpy.ndarray:
    found: numpy.ndarray = numpy.asarray(rendering.film()["color"], "f8")[..., :3]
    return found
