"""Cryptomattes, read by a reader of their own and held against masks that are rendered alone."""

import cryptomatte_reader as reader
import gonio
import numpy as np
import pytest
from matte_sheets import SHEETS, sheets
from small_scenes import finished


def mask(chosen, **settings):
    """The share of each pixel that the chosen sheets cover."""
    return np.asarray(finished(sheets(chosen, **{"passes": ["color"], **settings}))["color"])[..., 0]


@pytest.mark.parametrize("settings", [{}, {"filter": "gaussian", "filter_width": 3.0}, {"integrator": "whitted", "samples": 8}])
def test_mattes_are_the_masks_that_are_rendered_alone(tmp_path, settings):
    film = finished(sheets(**settings))
    film.write_exr(tmp_path / "mattes.exr", half=True)
    manifests, layers = reader.read(tmp_path / "mattes.exr")
    assert set(manifests) == {"CryptoObject", "CryptoMaterial", "CryptoAsset"}
    assert set(manifests["CryptoObject"]) == {sheet[0] for sheet in SHEETS}
    assert set(manifests["CryptoMaterial"]) == {"stone", "paint", "gauze"}
    assert set(manifests["CryptoAsset"]) == {"room", "things"}
    assert all(len(of_kind) == 3 for of_kind in layers.values())
    for place, layer in ((0, "CryptoObject"), (1, "CryptoMaterial"), (2, "CryptoAsset")):
        total = np.zeros((48, 64), np.float32)
        for thing, wanted in manifests[layer].items():
            alone = mask(lambda *names, place=place, thing=thing: names[place] == thing, **settings)
            found = reader.coverage(layers[layer], wanted)
            assert abs(found - alone).max() <= 1 / 255, (layer, thing)
            assert found.max() > 0.3, thing
            total += found
        assert abs(total - np.asarray(film["color"])[..., 3]).max() < 1e-5


def test_ranks_fall_and_the_depth_tells_how_many_there_are():
    film = finished(sheets(passes=["cryptomatte_object", "color"], cryptomatte_depth=8))
    assert film.passes == ["CryptoObject00", "CryptoObject01", "CryptoObject02", "CryptoObject03", "color"]
    ranks = np.concatenate([np.asarray(film[f"CryptoObject{number:02}"])[..., 1::2] for number in range(4)], axis=-1)
    assert (np.diff(ranks, axis=-1) <= 0.0).all() and (ranks[..., 4:] == 0.0).all()
    assert film["CryptoObject00"].channels == ["r", "g", "b", "a"]
    one = finished(sheets(passes=["CryptoAsset00"]))
    assert one.passes == ["CryptoAsset00"] and np.asarray(one["CryptoAsset00"])[..., 1].max() == 1.0
    for wrong in (0, 3, 18):
        with pytest.raises(gonio.SettingError, match="even number"):
            sheets(cryptomatte_depth=wrong)


def test_pixels_of_many_names_keep_those_that_cover_most():
    edges = [(number, -2.0 + number * 0.1, -1.9 + number * 0.1) for number in range(40)]
    strips = [(f"strip {number}", "strips", "paint", 1.0, 0.0, [(a, -2), (b, -2), (b, 2), (a, 2)]) for number, a, b in edges]
    film = finished(sheets(sheet=strips, width=3, height=3, samples=256, filter="box", filter_width=1.0))
    layers = [np.asarray(film[f"CryptoObject{number:02}"]) for number in range(3)]
    middle = np.concatenate([layer[1, 1] for layer in layers])
    ids, shares = middle[::2].view(np.uint32), middle[1::2]
    known = {reader.identifier(strip[0]) for strip in strips}
    assert len(set(ids)) == 6 and set(ids) <= known
    # A pixel sees 19 strips or so.
    assert (abs(shares - 0.1 / 1.94) < 0.01).all() and (np.diff(shares) <= 0.0).all()


def test_threads_parts_and_adaptive_sampling_give_the_same_bits(tmp_path):
    def bits(film):
        return b"".join(film[name].tobytes() for name in film.passes)

    wide = {"width": 150, "height": 90, "samples": 300}
    whole = bits(finished(sheets(threads=1, **wide)))
    assert bits(finished(sheets(threads=2, **wide))) == whole
    paths = []
    for number, part in enumerate(sheets(**wide).parts(3)):
        scene = sheets(**wide)
        scene.set(**part)
        paths.append(tmp_path / f"{number}.part")
        with gonio.Render(scene) as render:
            assert render.wait()
            render.checkpoint(paths[-1])
    assert bits(gonio.merge(paths)) == whole
    noisy = {**wide, "noise_threshold": 0.05, "min_samples": 4, "samples": 64}
    lit = {"lit": lambda name, *_: name != "floor"}
    one, two = (finished(sheets(threads=threads, **lit, **noisy)) for threads in (1, 2))
    assert bits(one) == bits(two) and one.mean_samples < 64
    total = sum(np.asarray(one[f"CryptoObject{number:02}"])[..., 1::2].sum(axis=-1) for number in range(3))
    assert abs(total - np.asarray(one["color"])[..., 3]).max() < 1e-5


def test_what_is_not_asked_for_is_absent(tmp_path):
    film = finished(sheets(passes=["color"]))
    film.write_exr(tmp_path / "none.exr")
    assert film.matte_notes() == {} and reader.read(tmp_path / "none.exr") == ({}, {})
    prefixed = finished(sheets(passes=["CryptoObject00"])).matte_notes("View Layer.")
    assert set(reader.checked_manifests(prefixed)) == {"View Layer.CryptoObject"}
