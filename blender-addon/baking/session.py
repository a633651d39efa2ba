# SPDX-License-Identifier: GPL-3.0-or-later
"""One bake: from Blender's pixels to the renderer's, and back."""

from contextlib import nullcontext

import gonio
import numpy as np

from ..export.colour_management import to_working
from ..session.result import POLL, open_result
from ..session.status import text
from ..units import LUMENS_PER_WATT
from . import stand_ins, wanted
from .denoised import denoised
from .environment import seen_of_world
from .kinds import FEW_SAMPLES, Kind, colour_of, kind_of
from .places import Places, read_places, texture_coordinates, within_faces


def bake(engine, depsgraph, layer, thing, name: str, pass_filter: int, size: tuple[int, int]) -> None:
    """Bakes a kind of an evaluated object's light into the pixels that Blender gives; `layer` has the exporter, and the last render, which lends
    what did not change. Raises ValueError with what cannot be baked."""
    kind = kind_of(wanted.kind or name, pass_filter)
    entry = layer.exporter.own_entry(thing.original)
    if entry is None:
        raise ValueError(f"'{thing.name}' is not in the scene as a mesh that can be baked")
    # Blender tells images apart by the name of the layer, and takes none without one.
    with open_result(engine, size, f"bake {wanted.number()}") as result:
        places = read_places(result, *size)
        if not places.known.any():
            return
        if kind.meaning == "uv":
            pixels = texture_coordinates(thing.data, places)
        else:
            if places.are_points and kind.passes != ("P",):
                places = within_faces(thing, places)
            pixels = _rendered(engine, depsgraph, layer, entry, kind, places)
            if pixels is not None and kind.meaning == "light" and depsgraph.scene.gonio.use_denoising:
                pixels = denoised(pixels, places.known, depsgraph.scene, layer.report)
        if pixels is not None:
            _write(result, pixels, is_colour=kind.meaning in ("light", "world"))


def _rendered(engine, depsgraph, layer, entry, kind: Kind, places: Places) -> np.ndarray | None:
    """The pixels of a kind; None where the user has ended it before there were any."""
    exporter, (number, materials) = layer.exporter, entry
    scene, render = depsgraph.scene, depsgraph.scene.render
    height, width = places.triangles.shape
    samples = min(scene.gonio.samples, FEW_SAMPLES) if kind.few else scene.gonio.samples
    exporter.settings(depsgraph, width=render.resolution_x, height=render.resolution_y, passes=kind.passes)
    exporter.scene.set(samples=samples, film_transparent=False)
    if kind.stand_in:
        exporter.scene.set(max_bounces=0)
    from_camera = kind.seen and render.bake.view_from == "ACTIVE_CAMERA" and scene.camera is not None
    arguments = {
        "instance": number,
        "triangles": places.triangles,
        "places": places.at,
        # Places are those of the texels' middles.
        "steps": None if kind.passes == ("P",) else places.steps,
        "view": "camera" if from_camera else "above",
    }
    with _stand_in(exporter, kind, materials, scene):
        baking = gonio.Render.bake(exporter.scene, previous=layer.render, cancelled=engine.test_break, **arguments)
        try:
            if not _waited(engine, baking, samples):
                return None
            film = baking.film()
        finally:
            baking.cancel()
        layer.render = baking
    if kind.meaning == "world":
        seen = seen_of_world(depsgraph, np.asarray(film["P"]), engine.test_break)
        return seen * (scene.gonio.film_exposure / LUMENS_PER_WATT)
    return colour_of(kind, lambda name: np.asarray(film[name]), scene.gonio.film_exposure)


def _waited(engine, baking, samples: int) -> bool:
    """Waits for the end; whether there is anything to show."""
    while not baking.wait(POLL):
        if engine.test_break():
            baking.cancel()
            return baking.progress.samples > 0
        engine.update_progress(baking.progress.fraction)
        engine.update_stats("", text(baking.progress, samples))
    return True


def _stand_in(exporter, kind: Kind, materials, scene):
    if kind.stand_in == "roughness":
        return stand_ins.standing_in(exporter, materials, stand_ins.roughness)
    if kind.stand_in == "occlusion":
        # As far as Blender's own setting of ambient occlusion says.
        distance = float(scene.world.light_settings.distance) if scene.world is not None else 10.0
        return stand_ins.standing_in(exporter, materials, lambda description: stand_ins.occlusion(description, distance))
    return nullcontext()


def _write(result, pixels: np.ndarray, *, is_colour: bool) -> None:
    """Pixels (height, width, 3), rows from the top, into a result's Combined pass."""
    target = next(each for each in result.layers[0].passes if each.name == "Combined")
    height, width, _ = pixels.shape
    whole = np.ones((height, width, 4), dtype=np.float32)
    whole[..., :3] = pixels[::-1]
    flat = whole.reshape(-1)
    flat = to_working(flat, 4) if is_colour else flat
    target.rect.foreach_set(np.ascontiguousarray(flat.reshape(-1, 4)[:, : target.channels]).reshape(-1))
