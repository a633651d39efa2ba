"""The catalogue in Cycles and in Gonio. Functions for `child.py`."""

import sys
import time
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

import bpy  # noqa: E402
import numpy  # noqa: E402
import scenes  # noqa: E402

from nodes import catalogue, compare, results, stage, stage_rays, tree  # noqa: E402

SCENES = {
    **{"tiles": stage.tiles, "balls": stage.balls, "near": stage.balls, "lit": stage.lit},
    **{"found": stage.found, "filled": stage.filled},
    **{"floor": stage_rays.floor, "mirror": stage_rays.mirror, "particles": stage_rays.particles},
}


def measure(tmp_path: Path, only: list[str] | None = None) -> None:
    """Writes VERSION.txt: what was found of each case of the nodes named, or of all."""
    version = bpy.app.version[:2]
    found = {}
    for shown_on in compare.WAYS:
        cases = list(chosen(version, only, shown_on))
        if cases:
            for bl_idname, measured in _measured(cases, shown_on, tmp_path).items():
                found.setdefault(bl_idname, {}).update(measured)
    name = ".".join(str(part) for part in version)
    (tmp_path / f"{name}.txt").write_text(results.written(bpy.app.version_string, found), encoding="utf-8")


def chosen(version: tuple, only: list[str] | None, shown_on: str):
    """Each node's cases of one of the scenes that this Blender has."""
    for bl_idname, node in catalogue.NODES.items():
        if not node.since <= version <= node.until or (only is not None and bl_idname not in only):
            continue
        for case in node.cases:
            if case.shown_on == shown_on and case.since <= version <= case.until:
                yield bl_idname, case


def _measured(cases: list, shown_on: str, folder: Path) -> dict:
    """Renders the cases of one scene in both engines, and compares."""
    stage.empty(8, 8)
    shown = [(bl_idname, case, output) for bl_idname, case in cases for output in tree.outputs(bl_idname, case)]
    makers = [lambda number=number, each=each: tree.material(f"case {number}", *each) for number, each in enumerate(shown)]
    grid = SCENES[shown_on](makers)
    pictures = {engine: _rendered(engine, folder / f"{shown_on}-{engine}.exr") for engine in ("CYCLES", "GONIO")}
    told = _told()
    found = {}
    for number, (bl_idname, case, output) in enumerate(shown):
        part = grid.part(number)
        theirs, mine = ({name: picture[part] for name, picture in pictures[engine].items()} for engine in ("CYCLES", "GONIO"))
        entry = compare.WAYS[shown_on](mine, theirs, case, stage.pixels)
        if f"case {number}" in told:
            entry["told"] = told[f"case {number}"]
        found.setdefault(bl_idname, {}).setdefault(case.mode, {})[str(output)] = entry
    return found


def _rendered(engine: str, path: Path) -> dict[str, numpy.ndarray]:
    """The shader AOVs of the open scene, and what it emits or reflects as "emitted"."""
    scene = bpy.context.scene
    scene.render.engine = engine
    passes = [entry.name for entry in scene.view_layers[0].aovs]
    if engine == "GONIO":
        bpy.ops.gonio.settings_from_cycles()
        scene.gonio.use_adaptive_sampling = False
    start = time.monotonic()
    scenes.render(path)
    channels = scenes.read(path)
    print(f"{engine}: {time.monotonic() - start:.1f} s")

    def of(name: str) -> numpy.ndarray:
        return numpy.stack([channels[f"ViewLayer.{name}.{channel}"] for channel in "RGB"], axis=-1).astype("f8")

    return {"emitted": of("Combined"), **{name: of(name) for name in passes}}


def _told() -> dict[str, str]:
    """What Gonio's report says, by material."""
    import importlib

    lines = importlib.import_module("gonio_extension.report").latest().diagnostics
    return {line.material: line.words for line in lines if line.material}
