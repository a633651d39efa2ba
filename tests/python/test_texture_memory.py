"""Textures within a memory limit: the same pictures, settings and what is told."""

import os
import shutil

import gonio
import numpy as np
import pytest
import texture_memory as made

COUNT = 4


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    """Four small pictures, five tiles a picture and more."""
    folder = tmp_path_factory.mktemp("pictures")
    made.make_pictures(folder, COUNT, 192)
    return folder


def rendered(pictures, **settings):
    """The picture, what was told of textures, and what went wrong."""
    scene = made.tiled_floor(pictures, COUNT, 4)
    scene.set(width=160, height=90, **settings)
    with gonio.Render(scene) as render:
        assert render.wait()
        return np.asarray(render.film()["color"]), render.texture_statistics, render.diagnostics


def test_the_picture_is_the_same_within_any_limit_and_by_any_number_of_threads(pictures, tmp_path):
    whole, nothing, _ = rendered(pictures)
    assert nothing is None and whole.any()
    # The first makes the tiles, the others find them.
    for limit, threads in [(1, 1), (1, 3), ("300K", 2)]:
        picture, statistics, problems = rendered(pictures, texture_memory=limit, texture_cache=tmp_path, threads=threads)
        assert np.array_equal(picture, whole)
        assert statistics["tiles_read"] > 0 and 0.0 < statistics["hit_rate"] < 1.0
        assert statistics["total"] > 4 * 192 * 192 * 4 and not statistics["notes"]
        # That workers need more than that is all that is told.
        assert {origin for origin, _ in problems} <= {"texture memory"}
    assert len(list(tmp_path.iterdir())) == COUNT


def test_what_fits_is_held_whole(pictures, tmp_path):
    whole, _, _ = rendered(pictures)
    picture, statistics, _ = rendered(pictures, texture_memory="1 GiB", texture_cache=tmp_path)
    assert statistics is None and np.array_equal(picture, whole)


def test_a_cache_that_cannot_be_written_is_told_once(pictures, tmp_path):
    (tmp_path / "file").write_text("")
    whole, _, _ = rendered(pictures)
    picture, _, problems = rendered(pictures, texture_memory=1, texture_cache=tmp_path / "file" / "cache")
    assert np.array_equal(picture, whole)
    assert sum("temporary folder" in message for _, message in problems) == 1


def test_damaged_files_are_made_anew(pictures, tmp_path):
    whole, _, _ = rendered(pictures, texture_memory=1, texture_cache=tmp_path)
    sound = {path: path.read_bytes() for path in tmp_path.iterdir()}
    for number, (path, data) in enumerate(sorted(sound.items())):
        middle = len(data) // 2
        path.write_bytes([data[:100], b"", data[:middle] + b"\0" * 999 + data[middle + 999 :], b"x" * 200][number])
    picture, statistics, problems = rendered(pictures, texture_memory=1, texture_cache=tmp_path)
    assert np.array_equal(picture, whole) and not statistics["notes"]
    assert {origin for origin, _ in problems} <= {"texture memory"}
    assert len(list(tmp_path.iterdir())) == COUNT


def test_tiles_that_cannot_be_made_anew_are_told(pictures, tmp_path):
    own = shutil.copytree(pictures, tmp_path / "pictures")
    scene = made.tiled_floor(own, COUNT, 4)
    # Straight up, where there is nothing.
    away = scene.add_camera([[1, 0, 0, 0], [0, 0, -1, 1], [0, 1, 0, 0], [0, 0, 0, 1]], fov=20)
    scene.set(width=80, height=45, texture_memory=1, texture_cache=tmp_path / "tiles", camera=away)
    with gonio.Render(scene) as first:
        assert first.wait() and first.texture_statistics["tiles_read"] == 0
        made.spoil_tiles(tmp_path / "tiles")
        for picture in own.iterdir():
            about = picture.stat()
            picture.write_bytes(bytes(about.st_size))
            os.utime(picture, ns=(about.st_atime_ns, about.st_mtime_ns))
        scene.set(camera=0)
        with gonio.Render(scene, first) as second:
            assert second.wait() and np.isfinite(np.asarray(second.film()["color"])).all()
            told = second.texture_statistics["notes"]
    assert len(told) == COUNT and all("damaged" in message for message in told)


def test_a_render_takes_over_what_its_forerunner_loaded(pictures, tmp_path):
    scene = made.tiled_floor(pictures, COUNT, 4)
    scene.set(width=80, height=45, texture_memory="200K", texture_cache=tmp_path)
    with gonio.Render(scene) as first:
        assert first.wait()
        before = first.texture_statistics["lookups"]
        with gonio.Render(scene, first) as second:
            assert second.wait()
            # The memory and its counts are the same.
            assert second.texture_statistics["lookups"] > before > 0
            assert np.array_equal(np.asarray(first.film()["color"]), np.asarray(second.film()["color"]))
        scene.set(texture_memory=0)
        with gonio.Render(scene, first) as third:
            assert third.wait() and third.texture_statistics is None
            assert np.array_equal(np.asarray(first.film()["color"]), np.asarray(third.film()["color"]))


@pytest.mark.parametrize("wrong", ["much", "12Q", "", "-3"])
def test_sizes_that_are_none_are_refused(wrong):
    with pytest.raises(gonio.SettingError, match="texture_memory"):
        gonio.Scene().set(texture_memory=wrong)
