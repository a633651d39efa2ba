"""More texture than memory: 64 pictures as photographs, the same picture with and without a limit.

`GONIO_TEXTURES=64x8192 GONIO_TEXTURE_LIMIT=1G` sets how many of which side, and the limit; by default 64 of 1024 within 16 MB. Times are
printed, with `pytest -s`.
"""

import argparse
import os
import shutil

import pytest
import texture_memory

pytestmark = pytest.mark.validate

# What a render without a limit takes beside its textures.
BESIDE_TEXTURES = 2 << 30


def test_many_textures_within_a_limit_give_the_same_picture(tmp_path):
    count, side = (int(number) for number in os.environ.get("GONIO_TEXTURES", "64x1024").split("x"))
    limit = os.environ.get("GONIO_TEXTURE_LIMIT", "16M")
    wanted, free = texture_memory.disk_wanted(count, side), shutil.disk_usage(tmp_path).free
    if free < wanted:
        pictures = f"{count} pictures of {side} × {side} and their tiles"
        pytest.skip(f"{pictures} take {wanted / 1e9:.1f} GB of disk, {free / 1e9:.1f} are free in {tmp_path}")
    memory = os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    no_whole = memory < count * side * side * 4 * 4 // 3 + BESIDE_TEXTURES
    if no_whole:
        print("there is too little free memory for the render without a limit")
    options = argparse.Namespace(count=count, side=side, limit=limit, samples=16, resolution=(640, 360), filter="Linear")
    options = argparse.Namespace(**vars(options), content="photograph", turns=2, no_whole=no_whole)
    options.pictures, options.cache = tmp_path / "pictures", tmp_path / "tiles"
    texture_memory.measure(options, tmp_path)
