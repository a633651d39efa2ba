"""The catalogue in Cycles and in Gonio. Functions for `child.py`."""

import json
import sys
import time
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

import bpy  # noqa: E402
import catalogue  # noqa: E402
import compare  # noqa: E402
import data  # noqa: E402
import numpy  # noqa: E402
import scenes  # noqa: E402
import stage  # noqa: E402
import tree  # noqa: E402


def measure(tmp_path: Path, only: list[str] | None = None) -> None:
    """Writes VERSION.json: what was found of each case of the nodes named, or of all."""
    version = bpy.app.version[:2]
    found = {}
    for on_sphere in (False, True):
        cases = list(chosen(version, only, on_sphere))
        if cases:
            for bl_idname, measured in _measured(cases, on_sphere, tmp_path).items():
                found.setdefault(bl_idname, {}).update(measured)
    name = ".".join(str(part) for part in version)
    rows = {"blender": bpy.app.version_string, "nodes": found}
    (tmp_path / f"{name}.json").write_text(json.dumps(rows, indent=1, sort_keys=True), encoding="utf-8")


def chosen(version: tuple, only: list[str] | None, on_sphere: bool):
    """Each node's cases of one of the two scenes that this Blender has."""
    for bl_idname, node in catalogue.NODES.items():
        if not node.since <= version <= node.until or (only is not None and bl_idname not in only):
            continue
        for case in node.cases:
            if case.on_sphere == on_sphere and case.since <= version:
                yield bl_idname, case


def _measured(cases: list, on_sphere: bool, folder: Path) -> dict:
    """Renders the cases of one scene in both engines, and compares."""
    stage.empty(8, 8)
    shown = [(bl_idname, case, output) for bl_idname, case in cases for output in tree.outputs(bl_idname, case)]
    makers = [lambda number=number, each=each: tree.material(f"case {number}", *each) for number, each in enumerate(shown)]
    columns, _ = (stage.balls if on_sphere else stage.tiles)(makers)
    pictures = {engine: _rendered(engine, folder / f"{'balls' if on_sphere else 'tiles'}-{engine}.exr") for engine in ("CYCLES", "GONIO")}
    told = _told()
    side = stage.BALL if on_sphere else data.SIDE
    found = {}
    for number, (bl_idname, case, output) in enumerate(shown):
        row, column = divmod(number, columns)
        part = numpy.s_[row * side : (row + 1) * side, column * side : (column + 1) * side]
        theirs, mine = ({name: picture[part] for name, picture in pictures[engine].items()} for engine in ("CYCLES", "GONIO"))
        entry = compare.ball(mine, theirs, case, stage.pixels) if on_sphere else compare.tile(mine, theirs, case)
        said = told.get(f"case {number}")
        if said:
            entry["told"] = said
        found.setdefault(bl_idname, {}).setdefault(case.mode, {})[output] = entry
    return found


def _rendered(engine: str, path: Path) -> dict[str, numpy.ndarray]:
    """The passes of the open scene: "node", "place" and "emitted"."""
    scene = bpy.context.scene
    scene.render.engine = engine
    if engine == "GONIO":
        bpy.ops.gonio.settings_from_cycles()
        scene.gonio.use_adaptive_sampling = False
    start = time.monotonic()
    scenes.render(path)
    channels = scenes.read(path)
    print(f"{engine}: {time.monotonic() - start:.1f} s")

    def of(name: str) -> numpy.ndarray:
        return numpy.stack([channels[f"ViewLayer.{name}.{channel}"] for channel in "RGB"], axis=-1).astype("f8")

    return {tree.OUTPUT: of(tree.OUTPUT), tree.PLACE: of(tree.PLACE), "emitted": of("Combined")}


def _told() -> dict[str, str]:
    """What Gonio's report says, by material."""
    import importlib

    lines = importlib.import_module("gonio_extension.report").latest().diagnostics
    return {line.material: line.words for line in lines if line.material}
