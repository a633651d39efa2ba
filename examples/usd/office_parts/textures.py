"""The office's pictures: woods, fabrics, ceiling tiles, a painting, two screens, and the view from the window."""

from pathlib import Path

import numpy

from .images import indices, noise, normals, octaves, ramp, write_hdr, write_png

# The view's left lower corner, its sides, and the eye for which it is painted (the camera's place).
VIEW_CORNER, VIEW_WIDTH, VIEW_HEIGHT = (-2.585, 0.70, -1.30), 4.2, 1.9
EYE = (1.62, 1.38, -0.16)
# The share of the sky's luminance that the tinted glazing lets in.
GLAZING = 0.5


def grain(random: numpy.random.Generator, shape: tuple[int, int], rings: float) -> numpy.ndarray:
    """Wood cut along the stem, from 0 to 1: bent year rings and fine pores along u."""
    height, width = shape
    bend = octaves(random, shape, (3, 1), 3)
    rows = numpy.arange(height)[:, None] / height
    years = 0.5 + 0.5 * numpy.sin(2 * numpy.pi * (rows * rings + bend * rings * 0.6))
    pores = noise(random, shape, (height // 2, 10)) * noise(random, shape, (height, 24))
    return numpy.clip(0.5 * years**2 + 0.35 * octaves(random, shape, (12, 2), 3) + 0.35 * pores - 0.05, 0, 1)


def planks(folder: Path) -> None:
    """The floor: eight rows of oak planks, a tile of 1.2 m x 1.2 m, and the joints as a normal map."""
    random = numpy.random.default_rng(7)
    size, rows = 768, 8
    tall = size // rows
    value, height = numpy.zeros((size, size)), numpy.ones((size, size))
    for row in range(rows):
        band = slice(row * tall, (row + 1) * tall)
        cuts = sorted((row * 0.382 + n * 0.5 + random.random() * 0.1) % 1 * size for n in range(2))
        edges = [int(cut) for cut in cuts]
        for start, end in ((edges[0], edges[1]), (edges[1], edges[0] + size)):
            columns = numpy.arange(start, end) % size
            board = 0.17 + 0.5 * grain(random, (tall, size), 2 + 3 * random.random())[:, : end - start] + 0.27 * random.random()
            value[band, columns] = board
            height[band, columns[0]] = height[band, columns[-1]] = 0
        height[row * tall] = height[(row + 1) * tall - 1] = 0
    value = numpy.where(height == 0, value * 0.45, value)
    palette = ramp([(92, 74, 56), (152, 126, 98), (186, 160, 130), (204, 182, 152)])
    write_png(folder / "planks.png", indices(value), palette)
    soft = (height + numpy.roll(height, 1, 0) + numpy.roll(height, 1, 1)) / 3
    write_png(folder / "planks_normal.png", normals(soft, 1.2))


def woods(folder: Path) -> None:
    """Walnut and light oak, tiles of 1 m x 0.5 m."""
    walnut = grain(numpy.random.default_rng(3), (256, 512), 9)
    write_png(folder / "walnut.png", indices(walnut), ramp([(52, 32, 22), (98, 64, 42), (128, 88, 58)]))
    oak = grain(numpy.random.default_rng(4), (256, 512), 12)
    write_png(folder / "oak.png", indices(oak), ramp([(158, 122, 84), (196, 162, 120), (212, 182, 142)]))


def weave(folder: Path) -> None:
    """A cloth of 16 x 16 threads, a tile of 5 cm, and its normal map."""
    size, threads = 128, 16
    place = numpy.arange(size) * threads / size
    over = numpy.abs(numpy.sin(numpy.pi * place))
    checker = (place.astype(int)[:, None] + place.astype(int)[None]) % 2
    height = numpy.where(checker == 0, over[:, None] * (0.6 + 0.4 * over[None]), over[None] * (0.6 + 0.4 * over[:, None]))
    random = numpy.random.default_rng(5)
    value = 0.25 + 0.45 * height + 0.3 * random.random((threads, threads)).repeat(8, 0).repeat(8, 1)
    write_png(folder / "cloth.png", indices(value), ramp([(22, 32, 40), (52, 74, 88), (84, 108, 120)]))
    write_png(folder / "cloth_normal.png", normals(height, 3.0))


def ceiling(folder: Path) -> None:
    """Mineral fibre, a tile of 0.6 m."""
    random = numpy.random.default_rng(6)
    value = 0.75 + 0.2 * octaves(random, (256, 256), (8, 8), 3)
    for row, column, reach in zip(random.integers(2, 254, 900), random.integers(2, 254, 900), random.integers(1, 4, 900)):
        value[row, column : column + reach] = 0.15
    write_png(folder / "ceiling.png", indices(value, 16), ramp([(150, 149, 146), (226, 225, 221), (236, 235, 231)], 16))


def painting(folder: Path) -> None:
    """An abstract landscape: a low sun over layered hills."""
    height, width = 640, 480
    y, x = numpy.mgrid[0:height, 0:width] / width
    sky = numpy.array([238, 206, 160.0]) + (y / 1.33)[..., None] * numpy.array([-10, -60, -70.0])
    disc = numpy.clip((0.17 - numpy.hypot(x - 0.62, y - 0.46)) * width / 2, 0, 1)[..., None]
    picture = sky * (1 - disc) + numpy.array([226, 92, 52.0]) * disc
    layers = [
        (0.58, 0.10, 2.1, (206, 140, 104)),
        (0.72, 0.08, 3.0, (150, 96, 96)),
        (0.86, 0.09, 1.6, (84, 78, 98)),
        (1.04, 0.07, 2.6, (38, 56, 78)),
    ]
    for n, (level, swing, waves, colour) in enumerate(layers):
        line = level + swing * numpy.sin(x * waves * 2.6 + n * 1.7) + 0.35 * swing * numpy.sin(x * waves * 6.1 + n)
        cover = numpy.clip((y - line) * width, 0, 1)[..., None]
        picture = picture * (1 - cover) + numpy.array(colour) * cover
    border = (x < 0.07) | (x > 0.93) | (y < 0.07) | (y > height / width - 0.07)
    picture[border] = (240, 237, 228)
    write_png(folder / "painting.png", numpy.round(picture / 2).astype(numpy.uint8) * 2)


def screens(folder: Path) -> None:
    """A luminaire's polar diagram beside false colours of a floor, and a page of source text."""
    height, width = 360, 640
    y, x = numpy.mgrid[0:height, 0:width].astype(float)
    diagram = numpy.empty((height, width, 3))
    diagram[:] = (24, 27, 34)
    diagram[:26] = (44, 50, 62)
    dx, dy = x - 180, y - 120
    radius, angle = numpy.hypot(dx, dy), numpy.arctan2(dx, dy)
    for ring in range(40, 201, 40):
        diagram[(abs(radius - ring) < 0.8) & (y > 60)] = (78, 86, 100)
    for spoke in range(-4, 5):
        diagram[(abs(numpy.sin(angle - spoke * numpy.pi / 6)) * radius < 0.7) & (radius < 200) & (dy > 0)] = (64, 71, 84)
    for colour, curve in (
        ((255, 176, 64), 190 * numpy.abs(numpy.cos(angle)) ** 1.6),
        ((92, 196, 255), 130 * (0.55 + 0.6 * abs(numpy.sin(1.6 * angle)))),
    ):
        diagram[(abs(radius - numpy.where(dy > 0, numpy.abs(curve), 1e3)) < 1.9) & (dy > 0)] = colour
    u, v = (x - 380) / 230, (y - 70) / 250
    lux = sum(numpy.exp(-((u - a) ** 2 + (v - b) ** 2) * 14) for a in (0.27, 0.73) for b in (0.25, 0.75))
    shown = (u > 0) & (u < 1) & (v > 0) & (v < 1)
    levels = numpy.floor(numpy.clip(lux / 1.12, 0, 0.999) * 8).astype(int)
    colours = numpy.array(
        [(38, 30, 96), (40, 76, 170), (30, 140, 190), (40, 180, 140), (110, 200, 80), (210, 210, 60), (246, 160, 50), (236, 84, 50)]
    )
    diagram[shown] = colours[levels][shown]
    write_png(folder / "screen_diagram.png", diagram.astype(numpy.uint8))
    random = numpy.random.default_rng(11)
    text = numpy.empty((height, width, 3))
    text[:] = (30, 32, 38)
    text[:, :110] = (40, 43, 51)
    for row in range(16, height - 12, 12):
        indent = 140 + 18 * int(random.integers(0, 4))
        for _ in range(int(random.integers(0, 6))):
            length = int(random.integers(14, 70))
            text[row : row + 5, indent : min(indent + length, 600)] = colours_of_text(random)
            indent += length + 8
        text[row : row + 4, 16 : 30 + int(random.integers(10, 60))] = (92, 98, 112)
    write_png(folder / "screen_text.png", text.astype(numpy.uint8))


def colours_of_text(random: numpy.random.Generator) -> tuple[int, int, int]:
    """One of an editor's colours."""
    return [(198, 204, 216), (198, 204, 216), (120, 180, 250), (240, 170, 110), (150, 210, 140), (200, 150, 230)][
        int(random.integers(0, 6))
    ]


def view(folder: Path) -> None:
    """What stands in the window, in cd/m²: clouds, hills and a park, as they are seen from the eye through the glazing."""
    height, width = 256, 560
    row, column = numpy.mgrid[0:height, 0:width] + 0.5
    place = numpy.stack([numpy.zeros_like(row), (1 - row / height) * VIEW_HEIGHT, -column / width * VIEW_WIDTH], axis=2) + VIEW_CORNER - EYE
    azimuth = numpy.degrees(numpy.arctan2(place[..., 2], -place[..., 0]))
    elevation = numpy.degrees(numpy.arctan2(place[..., 1], numpy.hypot(place[..., 0], place[..., 2])))
    haze = numpy.exp(-numpy.clip(elevation, 0, 90) / 7)[..., None]
    radiance = 1750 * numpy.array([0.62, 0.94, 1.62]) * (1 - haze) + 3300 * numpy.array([1.0, 0.98, 0.96]) * haze
    random = numpy.random.default_rng(12)
    cloud = 0.6 * octaves(random, (height, width), (7, 4), 6) + 0.4 * octaves(random, (height, width), (14, 5), 5)
    cover = numpy.clip((cloud - 0.47) * 6, 0, 1) * numpy.clip((elevation - 3) / 5, 0, 1)
    radiance += cover[..., None] * ((2300 + 2600 * cloud)[..., None] * numpy.array([1.0, 0.99, 0.98]) - radiance) * 0.9
    random = numpy.random.default_rng(13)
    hills = ((2.6, 2.4, 8, (0.62, 0.78, 0.95), 2100), (1.2, 2.0, 10, (0.42, 0.58, 0.50), 1500), (-0.4, 2.2, 26, (0.25, 0.36, 0.17), 1200))
    for level, rough, cells, colour, nits in hills:
        profile = octaves(random, (2, 2048), (1, cells), 6)[0]
        line = level + rough * (numpy.interp(azimuth, numpy.linspace(-180, 180, 2048) / 2, profile) - 0.5)
        blend = numpy.clip((line - elevation) / 0.12 + 0.5, 0, 1)[..., None]
        shade = 0.6 + 0.8 * octaves(random, (height, width), (64, 128), 2)[..., None]
        radiance += blend * (shade * nits * numpy.array(colour) - radiance)
    lawn = numpy.clip((-elevation - 1.6) / 0.15, 0, 1)[..., None]
    mown = 1 + 0.10 * numpy.sign(numpy.sin(1 / numpy.tan(numpy.radians(numpy.clip(-elevation, 0.5, 90))) * 0.7))[..., None]
    radiance += lawn * (mown * 1050 * numpy.array([0.50, 0.80, 0.27]) - radiance)
    write_hdr(folder / "view.hdr", radiance * GLAZING)


def write_all(folder: Path) -> None:
    """Writes every picture."""
    folder.mkdir(parents=True, exist_ok=True)
    for make in (planks, woods, weave, ceiling, painting, screens, view):
        make(folder)
