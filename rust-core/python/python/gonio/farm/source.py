"""Where workers get a frame's scene from: the stage, which they read themselves, or a bundle that is sent."""

from __future__ import annotations

import os
import tempfile
import uuid
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .._gonio import Error, _files_of_stage, _scene
from ..scene import Scene

# What to do where a machine does not see a file.
REMEDY = "put the stage and its files where all machines see them under one path, or send them (--dask-send)"


def _name() -> str:
    return uuid.uuid4().hex


@dataclass(frozen=True)
class Stage:
    """What `gonio render` with these arguments would trace at a frame; relative paths start at `folder`."""

    arguments: Sequence[str]
    folder: str | os.PathLike[str]
    # Absolute paths of all files that the stage is made of.
    files: Sequence[str]
    frame: float | None
    name: str = field(default_factory=_name)

    def scene(self) -> Scene:
        """Reads the stage; `gonio.Error` names the first file that cannot be seen from here."""
        for path in unseen(self.files):
            raise Error(f"cannot read {path}; {REMEDY}")
        return _scene(self.arguments, self.folder, self.frame)


@dataclass(frozen=True)
class Bundle:
    """A scene as bytes, with its images."""

    data: bytes
    name: str = field(default_factory=_name)

    @staticmethod
    def of(scene: Scene) -> Bundle:
        """The bundle of a scene; `gonio.Error` where an image cannot be sent."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "scene.gonio")
            scene.save(path, images=True)
            return Bundle(path.read_bytes())

    @staticmethod
    def of_stage(arguments: Sequence[str], folder: str | os.PathLike[str], frame: float | None) -> Bundle:
        """The bundle of what `gonio render` with these arguments would trace at a frame."""
        return Bundle.of(_scene(arguments, folder, frame))

    def scene(self) -> Scene:
        """The scene again."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "scene.gonio")
            path.write_bytes(self.data)
            return Scene.load(path)


@dataclass(frozen=True)
class Year:
    """What of a year of daylight is traced, as bytes: scenes as bundles, the one with open blinds first, and the keywords of `gonio.annual` that tracing knows."""

    scenes: Sequence[Bundle]
    weather: bytes
    # With `closed` scenes by their places in `scenes`: one of all groups, or of each by name.
    tracing: Mapping[str, Any]

    @staticmethod
    def of(scene: Scene, weather: bytes, asked: Mapping[str, Any]) -> Year:
        """The year that `gonio.annual` makes of a scene with some keywords; `gonio.Error` where an image cannot be sent."""
        closed = asked.get("closed")
        by_name = closed if isinstance(closed, Mapping) else {"": closed}
        others = {id(other): other for other in by_name.values() if other is not None}
        places = {key: place for place, key in enumerate(others, 1)}
        tracing = {name: asked[name] for name in ("samples", "division", "groups", "up", "north", "sun_position") if name in asked}
        if others:
            numbers = {name: places[id(other)] for name, other in by_name.items()}
            tracing["closed"] = numbers if closed is by_name else numbers[""]
        return Year([Bundle.of(each) for each in (scene, *others.values())], weather, tracing)

    def unpacked(self) -> tuple[Scene, dict[str, Any]]:
        """The scene with open blinds, and keywords for `gonio.annual`."""
        scenes = [bundle.scene() for bundle in self.scenes]
        tracing = dict(self.tracing)
        if isinstance(closed := tracing.get("closed"), Mapping):
            tracing["closed"] = {name: scenes[place] for name, place in closed.items()}
        elif closed:
            tracing["closed"] = scenes[closed]
        return scenes[0], tracing


def unseen(paths: Iterable[str]) -> list[str]:
    """Those of the files that cannot be read from here."""
    return [path for path in paths if not os.access(path, os.R_OK)]


def files_of(inputs: Sequence[str | os.PathLike[str]]) -> list[str]:
    """The files with all that the stages among them are made of: layers, textures, goniograms, measurements."""
    found: dict[str, None] = {}
    for path in [os.fspath(path) for path in inputs]:
        found[path] = None
        if Path(path).suffix in {".usd", ".usda", ".usdc", ".usdz"}:
            found.update(dict.fromkeys(_files_of_stage(path)))
    return list(found)
