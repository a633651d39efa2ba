"""`gonio info` of volume files: one grid written here after OpenVDB's format, with a single tile."""

import json
import struct

import pytest


def text(value):
    return struct.pack("<I", len(value)) + value.encode()


def volume(kind="float"):
    """A fog of one tile of 4096³ voxels at (4096, 0, -4096), whose voxels are a millimetre wide."""
    header = b" BDV\0\0\0\0" + struct.pack("<III?", 224, 12, 0, True) + b"0" * 36
    grid = struct.pack("<II", 2, 1) + text("class") + text("string") + text("fog volume")
    grid += text("UniformScaleMap") + struct.pack("<15d", *[0.001] * 15)
    grid += struct.pack("<ifII", 1, 0.0, 1, 0) + struct.pack("<iiif?", 4096, 0, -4096, 0.5, True)
    front = header + struct.pack("<II", 0, 1) + text("density") + text(f"Tree_{kind}_5_4_3") + text("")
    start = len(front) + 24
    return front + struct.pack("<qqq", start, start + len(grid), start + len(grid)) + grid


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "fog.vdb"
    path.write_bytes(volume())
    return path


def test_grids_are_listed(run, path):
    lines = run("info", path).stdout.splitlines()
    assert lines == [
        "OpenVDB 224 (library 12.0)",
        "1 grid, memory: 0.0 MB",
        "grid density: float, fog volume, compression active values",
        "  68719476736 active voxels, 0 bricks, 1 tiles, memory: 0.0 MB",
        "  voxels [4096, 0, -4096] to [8191, 4095, -1]",
        "  voxels of [0.0010, 0.0010, 0.0010], bounds: [4.0955, -0.0005, -4.0965] to [8.1915, 4.0955, -0.0005]",
    ]


def test_json_has_the_numbers(run, path):
    told = json.loads(run("info", path, "--json").stdout)
    grid = told["grids"][0]
    assert (grid["name"], grid["type"], grid["active_voxels"], grid["tiles"]) == ("density", "float", 4096**3, 1)
    assert grid["index_bounds"] == [[4096, 0, -4096], [8191, 4095, -1]]
    assert grid["voxel_size"] == [0.001] * 3 and grid["refused"] is None
    assert grid["metadata"] == {"class": "fog volume"}
    assert told["memory_bytes"] == grid["memory_bytes"] > 0


def test_what_is_not_read_is_named(run, path):
    path.write_bytes(volume("string"))
    assert "warning: grid density cannot be read: grids of string are not read" in run("info", path).stdout


def test_broken_files_are_told_with_the_byte(run, path):
    path.write_bytes(volume()[:-9])
    done = run("info", path)
    assert done.returncode == 1
    assert "fog.vdb" in done.stderr and "byte " in done.stderr and "truncated" in done.stderr
    path.write_bytes(b"#usda 1.0\n")
    assert "neither an OpenVDB nor a NanoVDB file" in run("info", path).stderr


def test_options_of_stages_are_refused(run, path):
    done = run("info", path, "--explain", "/World")
    assert done.returncode == 1 and "--explain" in done.stderr and "expected a USD stage" in done.stderr
