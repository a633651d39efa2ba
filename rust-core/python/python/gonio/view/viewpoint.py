"""Which camera is looked through: one of the stage, or a free one that went on from where that stood."""

from __future__ import annotations

from collections.abc import Callable

from .camera import Description, FreeCamera, distance_to, through
from .stage import Seen


class Viewpoint:
    """The window's camera. Moving it frees it; the stage's own stay as they are."""

    def __init__(self) -> None:
        self._seen: Seen | None = None
        self._name = ""
        self._free: FreeCamera | None = None

    def take(self, seen: Seen) -> None:
        """Another stage, or the same once more: the camera of the same name stays the one, and so does a free one."""
        self._seen = seen
        if self._name not in seen.names_of_cameras:
            self._name = seen.names_of_cameras[seen.about["camera"]]

    @property
    def number(self) -> int:
        """Of the stage's camera that is looked through, −1 for the free one."""
        if self._seen is None or self._free is not None:
            return -1
        return self._seen.names_of_cameras.index(self._name)

    @property
    def free(self) -> FreeCamera | None:
        """The free camera, if that is looked through."""
        return self._free

    def choose(self, number: int) -> None:
        """Looks through a camera of the stage, or frees the one that is looked through (−1)."""
        if self._seen is None:
            return
        if number < 0:
            self.move(lambda camera: camera)
        else:
            self._name, self._free = self._seen.names_of_cameras[number], None

    def next(self) -> None:
        """Looks through the stage's next camera, or back through that which was left."""
        if self._seen is None:
            return
        self.choose(self._number_of_stage if self._free is not None else (self._number_of_stage + 1) % len(self._seen.cameras))

    def home(self) -> None:
        """Looks through the stage's own choice."""
        if self._seen is not None:
            self.choose(self._seen.about["camera"])

    def move(self, how: Callable[[FreeCamera], FreeCamera], distance: float | None = None) -> None:
        """Moves the free camera; the first move frees it, to turn about what lies at a distance, the middle of the stage without it."""
        if self._seen is None:
            return
        if self._free is None:
            description = self._seen.cameras[self._number_of_stage]
            away = distance if distance is not None and distance > 0.0 else distance_to(description, self._seen.bounds)
            self._free = FreeCamera.of(description, self._seen.up, away)
        self._free = how(self._free)

    def description(self, aspect: float) -> Description:
        """What renders, for a picture of that shape."""
        assert self._seen is not None
        if self._free is not None:
            return self._free.description(aspect)
        return through(self._seen.cameras[self._number_of_stage], aspect)

    def headlight(self, aspect: float) -> tuple[int, Description] | None:
        """The light at the camera, where there is one, as it stands now."""
        if self._seen is None or self._seen.headlight is None:
            return None
        number, description = self._seen.headlight
        return number, {**description, "transform": self.description(aspect)["transform"]}

    @property
    def gate(self) -> float | None:
        """Width over height of what `gonio render` shows through the stage's camera; None for the free one."""
        if self._seen is None or self._free is not None:
            return None
        width, height = self._seen.about["resolution"]
        return float(width * self._seen.about["pixel_aspect"] / height) if height else None

    @property
    def _number_of_stage(self) -> int:
        assert self._seen is not None
        return self._seen.names_of_cameras.index(self._name)
