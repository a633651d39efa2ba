"""Images as parameters of materials and lights."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from ._gonio import _setting_error

WRAPS = {"repeat": "Repeat", "clamp": "Clamp", "mirror": "Mirror", "black": "Black"}


@dataclass(frozen=True)
class Texture:
    """An image of a scene, which `add_material` and `add_light` take in the place of numbers; `Scene.add_texture` makes it."""

    # Its number in the scene.
    number: int
    # The primvar that it is looked up with: `st` is what meshes' `uvs` are called.
    uv: str = "st"
    # What lies beyond it: repeat, clamp, mirror or black.
    wrap: str = "repeat"
    # How often it is repeated along u and v.
    tiles: tuple[float, float] = (1.0, 1.0)
    # What parameters that are one number take: R, G, B or A.
    component: str = "R"

    def channel(self, name: str) -> Texture:
        """The same image, of which parameters that are one number take another channel: R, G, B or A."""
        if name not in ("R", "G", "B", "A"):
            raise _setting_error("channel", f"'{name}' was found, expected R, G, B or A")
        return replace(self, component=name)

    def nodes(self, first: int, *, is_normal: bool = False) -> list[dict[str, Any]]:
        """The nodes that look it up, the last one with the result; they stand at number `first` of a graph. Normals are turned from [0, 1]."""
        if self.wrap not in WRAPS:
            raise _setting_error("wrap", f"'{self.wrap}' was found, expected {', '.join(WRAPS)}")
        scale, bias, middle = ([2.0] * 4, [-1.0] * 4, [0.0, 0.0, 1.0, 1.0]) if is_normal else ([1.0] * 4, [0.0] * 4, [0.5, 0.5, 0.5, 1.0])
        image = {
            "texture": self.number,
            "wrap": [WRAPS[self.wrap]] * 2,
            "filter": "Linear",
            "scale": scale,
            "bias": bias,
            "fallback": middle,
        }
        tiles = {"scale": [*self.tiles], "rotation_deg": 0.0, "translation": [0.0, 0.0]}
        made = [
            {"operation": {"Primvar": {"name": self.uv, "fallback": [0.0] * 4}}, "inputs": []},
            {"operation": {"Transform2d": tiles}, "inputs": [{"Node": [first, "Rgb"]}]},
            {"operation": {"Image": image}, "inputs": [{"Node": [first + 1, "Rgb"]}]},
        ]
        if is_normal:
            made.append({"operation": {"NormalMap": {"scale": 1.0, "uv": self.uv}}, "inputs": [{"Node": [first + 2, "Rgb"]}]})
        return made


def described(name: str, colour_space: str) -> Mapping[str, Any]:
    """A texture's description without its source."""
    return {"origin": name, "colour_space": colour_space}
