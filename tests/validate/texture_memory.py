"""Many large textures within a memory limit against the same scene without one: the same picture, the time and the memory it takes.

`python tests/validate/texture_memory.py` renders 64 textures of 2048 × 2048 within 64 MB; `--full` 64 of 8192 × 8192 within 1 GB, which
without a limit takes 24 GB of memory (`--no-whole` leaves that render out). Pictures are as photographs: structure of all sizes, brightness
stronger than hue, and the grain of a sensor; `--content waves` has smooth waves with a grain that repeats, which is quicker to make.
Each render is a process of its own, so that its memory can be told; with and without a limit they take turns.
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

import numpy as np

SIDE_BY_SIDE = 8
RESOLUTION = (640, 360)


def waves(side, seed):
    """Rows of a wave with a grain that repeats: soft colours with fine detail."""
    rng = np.random.default_rng(seed)
    x = np.arange(side) / side
    waves = rng.integers(1, 9, 3)
    grain = rng.integers(0, 40, (64, 64, 3), dtype=np.uint8)
    for y in range(side):
        row = 105 + 80 * np.sin(2 * np.pi * (waves[None, :] * x[:, None] + np.arange(3) * 0.2 + 3.0 * y / side))
        yield row.astype(np.uint8) + np.tile(grain[y % 64], (side // 64, 1))


def stretched(grid, places):
    """Rows of a grid at places between them, linearly."""
    low = places.astype(int)
    return grid[low] + (places - low).astype("f4")[:, None] * (grid[low + 1] - grid[low])


def photograph(side, seed, grain=1.2):
    """Structure of all sizes, the more the larger (as photographs: 1/f), in brightness twenty times that in hue; grain of so many codes."""
    rng = np.random.default_rng(seed)
    cells = [2**k for k in range(1, 11) if 2**k <= side]
    # Brightness, then two of hue, which have no fine detail.
    layers = [(cell, channel) for channel in range(3) for cell in cells if channel == 0 or cell >= 8]
    grids = [rng.standard_normal((side // cell + 2, side // cell + 2), dtype="f4") for cell, _ in layers]
    mix = np.array([[1, 1, 1], [0.22, 0, -0.22], [0.1, -0.1, 0.1]], "f4")
    base = rng.uniform(80, 170, 3).astype("f4")
    for top in range(0, side, 64):
        rows = np.arange(top, min(top + 64, side))
        sums = np.zeros((3, len(rows), side), "f4")
        for (cell, channel), grid in zip(layers, grids, strict=True):
            sums[channel] += 0.7 * cell**0.6 * stretched(stretched(grid, rows / cell).T, np.arange(side) / cell).T
        band = np.einsum("cyx,ck->yxk", sums, mix) + base + grain * rng.standard_normal((len(rows), side, 3), dtype="f4")
        yield from np.clip(band, 0, 255).astype(np.uint8)


CONTENTS = {"photograph": photograph, "waves": waves}


def write_png(path, side, seed, content="waves"):
    """A picture of 8 bits, each row told from the one above."""
    compress = zlib.compressobj(1)
    parts, above = [], np.zeros((side, 3), np.uint8)
    for row in CONTENTS[content](side, seed):
        parts.append(compress.compress(b"\2" + (row - above).tobytes()))
        above = row
    parts.append(compress.flush())

    def chunk(name, data):
        return len(data).to_bytes(4, "big") + name + data + zlib.crc32(name + data).to_bytes(4, "big")

    header = side.to_bytes(4, "big") * 2 + bytes([8, 2, 0, 0, 0])
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", b"".join(parts)) + chunk(b"IEND", b""))


def make_pictures(folder, count, side, content="waves"):
    folder.mkdir(parents=True, exist_ok=True)
    for number in range(count):
        path = folder / f"{number:02}.png"
        if not path.exists():
            write_png(path, side, number, content)


def tail(header):
    """Bytes behind the tiles of a file: lengths and checksums, 8 bytes a tile, a note, and a checksum of it all."""
    kind, _, width, height, note = np.frombuffer(header[24:44], "u4").tolist()
    side, tiles = 32 if kind == 3 else 64, 0
    while True:
        tiles += -(-width // side) * -(-height // side)
        if width == height == 1:
            return 8 * tiles + note + 4
        width, height = max(width // 2, 1), max(height // 2, 1)


def spoil_tiles(folder):
    """Overwrites the tiles of all files of a cache, whose heads stay sound."""
    for path in folder.glob("*.gtiles"):
        size = path.stat().st_size
        with path.open("r+b") as file:
            header = file.read(64)
            file.write(b"\x5a" * (size - 64 - tail(header)))


def textured(scene, path, filter):
    """A matt material of a picture."""
    number = scene.put_texture({"origin": {"name": path.name}, "source": {"File": str(path)}, "colour_space": "auto"})
    lookup = {"texture": number, "wrap": ["Repeat"] * 2, "filter": filter}
    lookup |= {"scale": [1.0] * 4, "bias": [0.0] * 4, "fallback": [1.0] * 4}
    nodes = [
        {"operation": {"Primvar": {"name": "st", "fallback": [0.0] * 4}}, "inputs": []},
        {"operation": {"Image": lookup}, "inputs": [{"Node": [0, "Rgb"]}]},
    ]
    grey = {"Constant": [0.0, 0.0, 0.0, 1.0]}
    parameters = [["base_color", {"Node": [1, "Rgb"]}], ["specular_weight", grey]]
    closure = {"weight": {"Constant": [1.0] * 4}, "model": "OpenPbr", "parameters": parameters}
    return scene.put_material({"closures": [closure], "graph": {"nodes": nodes}, "shader_outputs": []})


def tiled_floor(folder, count, samples, *, resolution=RESOLUTION, filter="Linear"):
    """A field of textured squares seen at a slant, each picture once, and a wall of them behind; light from all around and one lamp."""
    import gonio

    scene = gonio.Scene()
    width, height = resolution
    scene.set(width=width, height=height, samples=samples, max_bounces=4)
    corners = np.array([[0, 0, 0], [1, 0, 0], [1, 0, -1], [0, 0, -1]], "f4")
    uvs = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], "f4")
    square = scene.add_mesh(corners, np.array([[0, 1, 2], [0, 2, 3]], "i4"), uvs=uvs)
    for number in range(count):
        x, z = number % SIDE_BY_SIDE - SIDE_BY_SIDE / 2, -(number // SIDE_BY_SIDE)
        flat = [[1, 0, 0, x], [0, 1, 0, 0], [0, 0, 1, z], [0, 0, 0, 1]]
        upright = [[1, 0, 0, x], [0, 0, -1, -z / 2], [0, 1, 0, -SIDE_BY_SIDE], [0, 0, 0, 1]]
        material = textured(scene, folder / f"{number:02}.png", filter)
        scene.add_instance(square, [material], transform=flat)
        scene.add_instance(square, [material], transform=upright)
    scene.add_light("sphere", (2000.0, 2000.0, 2000.0), radius=0.3, transform=[[1, 0, 0, 0], [0, 1, 0, 4], [0, 0, 1, -3], [0, 0, 0, 1]])
    # Near the floor, so that footprints are of every size.
    tilt = np.deg2rad(-14)
    c, s = np.cos(tilt), np.sin(tilt)
    scene.add_camera([[1, 0, 0, 0.1], [0, c, -s, 0.8], [0, s, c, 0.4], [0, 0, 0, 1]], fov=70)
    return scene


def render(options):
    """One render; what it took as JSON."""
    import gonio

    scene = tiled_floor(options.pictures, options.count, options.samples, resolution=options.resolution, filter=options.filter)
    if options.limit != "0":
        scene.set(texture_memory=options.limit, texture_cache=options.cache)
    start = time.perf_counter()
    with gonio.Render(scene) as running:
        compiled, before = time.perf_counter(), time.process_time()
        assert running.wait()
        end, processor = time.perf_counter(), time.process_time() - before
        np.save(options.picture, np.asarray(running.film()["color"]))
        statistics = running.texture_statistics
        problems = running.diagnostics
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    found = {"load": compiled - start, "render": end - compiled, "processor": processor, "all": time.process_time(), "peak_mb": peak}
    found |= {"statistics": statistics, "problems": problems}
    print(json.dumps(found))


def run(options, folder, name, limit):
    """A render in a process of its own."""
    picture = folder / f"{name}.npy"
    arguments = [str(Path(__file__).resolve()), "--child", "--limit", limit, "--picture", str(picture), "--pictures", str(options.pictures)]
    arguments += ["--cache", str(options.cache), "--count", str(options.count), "--samples", str(options.samples)]
    arguments += ["--resolution", *map(str, options.resolution), "--filter", options.filter]
    done = subprocess.run([sys.executable, *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout.splitlines()[-1])
    times = f"loaded in {found['load']:.2f} s, rendered in {found['render']:.2f} s ({found['processor']:.2f} s of processors)"
    print(f"{name}: {times}, {found['peak_mb']:.0f} MB at most", flush=True)
    if found["statistics"]:
        of = found["statistics"]
        print(
            f"    tiles: {of['lookups']} looked up, {100 * of['hit_rate']:.4f} % in memory, {of['tiles_read']} read "
            f"({of['bytes_read'] / 2**20:.0f} MB), {of['evicted']} given up; {of['most'] / 2**20:.1f} MB at most within "
            f"{of['limit'] / 2**20:.0f} MB of {of['total'] / 2**20:.0f} MB",
            flush=True,
        )
    assert not found["problems"], found["problems"]
    return found, np.load(picture)


def disk_wanted(count, side):
    """Bytes of pictures and tiles at the most that photographs take, a little more."""
    return int(count * side * side * (2.2 + 4 / 3 * 2.4))


def measure(options, folder):
    """Renders with and without a limit by turns, and says how they compare."""
    start = time.perf_counter()
    make_pictures(options.pictures, options.count, options.side, options.content)
    pictures = sum(path.stat().st_size for path in options.pictures.iterdir())
    made = f"{options.count} pictures of {options.side} × {options.side} ({options.content}), {pictures / 2**20:.0f} MB of PNG"
    print(f"{made}, made in {time.perf_counter() - start:.1f} s", flush=True)
    _, expected = run(options, folder, "first with limit", options.limit)
    disk = sum(path.stat().st_size for path in options.cache.rglob("*") if path.is_file())
    texels = options.count * sum((options.side >> level) ** 2 for level in range(options.side.bit_length()))
    share, bits = disk / (4 * texels), 8 * disk / texels
    print(f"{disk / 2**20:.0f} MB of tiles on disk, {share:.2f} of what they are in memory; {bits:.1f} bits a texel")
    limited, whole = [], []
    for turn in range(options.turns):
        found, picture = run(options, folder, f"again with limit, {turn}", options.limit)
        assert np.array_equal(picture, expected), "the pictures differ"
        limited.append(found)
        if not options.no_whole:
            found, picture = run(options, folder, f"without limit, {turn}", "0")
            assert np.array_equal(picture, expected), "the pictures differ"
            whole.append(found)
    if not whole:
        return
    least = {what: [min(found[what] for found in runs) for runs in (limited, whole)] for what in ("render", "processor", "all")}
    ratios = {what: with_limit / without for what, (with_limit, without) in least.items()}
    print(
        f"the same picture; rendering alone takes {ratios['render']:.2f} × the time ({ratios['processor']:.2f} × that of processors), "
        f"loading and all {ratios['all']:.2f} × that of processors"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--full", action="store_true", help="64 of 8192 within 1 GB")
    parser.add_argument("--count", type=int, default=SIDE_BY_SIDE**2)
    parser.add_argument("--side", type=int, default=2048)
    parser.add_argument("--limit", default="64M")
    parser.add_argument("--samples", type=int, default=16)
    parser.add_argument("--resolution", type=int, nargs=2, default=RESOLUTION)
    parser.add_argument("--filter", choices=["Linear", "Closest", "Cubic"], default="Linear")
    parser.add_argument("--folder", type=Path, help="where pictures and tiles are kept; by default a temporary folder")
    parser.add_argument("--content", choices=CONTENTS, default="photograph")
    parser.add_argument("--turns", type=int, default=3, help="renders with and without the limit, by turns")
    parser.add_argument("--no-whole", action="store_true", help="leave the render without a limit out")
    for name in ("--pictures", "--cache", "--picture"):
        parser.add_argument(name, type=Path, help=argparse.SUPPRESS)
    parser.add_argument("--child", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.child:
        return render(options)
    if options.full:
        options.side, options.limit = 8192, "1G"
    with tempfile.TemporaryDirectory(dir=os.environ.get("TMPDIR")) as temporary:
        folder = options.folder or Path(temporary)
        options.pictures, options.cache = folder / f"pictures{options.side}", folder / f"tiles{options.side}"
        measure(options, Path(temporary))
    return None


if __name__ == "__main__":
    main()
