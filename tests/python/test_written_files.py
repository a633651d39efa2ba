"""What Python writes: names of any length that may be, links that stay, pipes, and errors that leave the old file."""

import os
import stat
import threading

import pytest
from small_scenes import finished, floor_scene


@pytest.fixture(scope="module")
def writers():
    """Writes a file of an ending."""
    film = finished(floor_scene(passes=["color", "deep"]))
    return {"exr": film.write_exr, "png": film.write_picture, "jpg": film.write_picture, "deep.exr": film.write_deep_exr}


ENDINGS = ["exr", "png", "jpg", "deep.exr"]


@pytest.mark.parametrize("ending", ENDINGS)
def test_long_names_and_links(writers, tmp_path, ending):
    path = tmp_path / ("n" * (254 - len(ending)) + f".{ending}")
    writers[ending](path)
    link = tmp_path / f"link.{ending}"
    link.symlink_to(path)
    path.write_text("old")
    writers[ending](link)
    assert link.is_symlink() and path.stat().st_size > 100
    assert len(list(tmp_path.iterdir())) == 2


@pytest.mark.parametrize("ending", ENDINGS)
def test_pipes_and_what_cannot_be(writers, tmp_path, ending):
    pipe, read = tmp_path / f"pipe.{ending}", []
    os.mkfifo(pipe)
    reader = threading.Thread(target=lambda: read.append(pipe.read_bytes()), daemon=True)
    reader.start()
    writers[ending](pipe)
    reader.join(10)
    assert len(read[0]) > 100 and stat.S_ISFIFO(pipe.stat().st_mode)
    folder = tmp_path / f"folder.{ending}"
    folder.mkdir()
    for wrong in (folder, tmp_path / "missing" / f"a.{ending}", tmp_path / ("n" * 255 + f".{ending}")):
        with pytest.raises(OSError, match=ending):
            writers[ending](wrong)
    assert len(list(tmp_path.iterdir())) == 2
