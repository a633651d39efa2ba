# SPDX-License-Identifier: GPL-3.0-or-later
"""The views of a stereoscopic render: Blender's own, one picture each."""

from dataclasses import dataclass

import numpy

from .frame import begun_with


@dataclass(frozen=True, eq=False)
class Eye:
    """A view by name: the camera object that sees it, where that stands, and its shift. Without stereoscopy there is one without a name."""

    name: str = ""
    camera: object = None
    matrix: numpy.ndarray | None = None
    shift_x: float | None = None


def eyes(engine, depsgraph) -> list[Eye]:
    """The views that Blender expects of a final render."""
    scene = depsgraph.scene
    if not begun_with(engine).use_multiview or scene.camera is None or engine.is_preview:
        return [Eye()]
    result = engine.begin_result(0, 0, 1, 1, layer=depsgraph.view_layer.name)
    names = [view.name for view in result.views]
    engine.end_result(result, cancel=True)
    return [_eye(engine, scene, name) for name in names] or [Eye()]


def _eye(engine, scene, name: str) -> Eye:
    if scene.render.views_format == "MULTIVIEW":
        return Eye(name, _camera_of(scene, name))
    engine.active_view_set(name)
    matrix = numpy.array(engine.camera_model_matrix(scene.camera), dtype=float).reshape(4, 4)
    return Eye(name, scene.camera, matrix, float(engine.camera_shift_x(scene.camera)))


def _camera_of(scene, name: str):
    """The camera whose name has the view's suffix in place of the active camera's own; the active camera where there is none."""
    suffixes = [view.camera_suffix for view in scene.render.views]
    active, own = scene.camera, next((view.camera_suffix for view in scene.render.views if view.name == name), "")
    stem = next((active.name.removesuffix(suffix) for suffix in suffixes if suffix and active.name.endswith(suffix)), active.name)
    found = scene.objects.get(stem + own)
    return found if found is not None and found.type == "CAMERA" else active
