"""What can be done in the window: one table for the menus, the shortcuts and the list of them."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Deed:
    """An entry of a menu: the method of the window that it calls, its words, its keys, and whether it is switched on and off."""

    menu: str
    call: str
    words: str
    keys: str = ""
    # None for what simply happens; else whether it is on at first.
    is_on: bool | None = None


DEEDS = (
    Deed("&File", "reload", "&Reload", "F5"),
    Deed("&File", "save_picture", "&Save Picture …", "Ctrl+S"),
    Deed("&File", "close", "&Quit", "Ctrl+Q"),
    Deed("&View", "show_picture", "&Picture", "1"),
    Deed("&View", "show_luminance", "&Luminance (cd/m²)", "2"),
    Deed("&View", "show_illuminance", "&Illuminance (lx)", "3"),
    Deed("&View", "brighter", "&Brighter by ⅓ stop", "+"),
    Deed("&View", "darker", "&Darker by ⅓ stop", "-"),
    Deed("&View", "reset_exposure", "&Exposure as it comes", "0"),
    Deed("&View", "toggle_automatic", "&Automatic exposure on or off", "A"),
    Deed("&View", "measure_lux", "Lu&x under the cursor", "L", is_on=True),
    Deed("&View", "toggle_messages", "&Messages", "M"),
    Deed("&Camera", "frame_all", "&Frame everything", "F"),
    Deed("&Camera", "home", "Back to the stage's &camera", "Home"),
    Deed("&Camera", "next_camera", "&Next camera", "C"),
    Deed("&Frame", "previous_frame", "&Previous frame", "Left"),
    Deed("&Frame", "next_frame", "&Next frame", "Right"),
    Deed("&Help", "show_keys", "&Keys", "F1"),
)

MOUSE = (
    ("Left button", "turn about the middle, with and without Alt"),
    ("Middle button, or Shift and left", "move"),
    ("Right button, Ctrl and left, or the wheel", "nearer and further"),
)


def list_of_keys() -> str:
    """All of them, as a table in HTML."""
    arrows = {"Left": "Left arrow", "Right": "Right arrow"}
    deeds = [(arrows.get(deed.keys, deed.keys), deed.words.replace("&", "").removesuffix(" …")) for deed in DEEDS]
    cells = "".join(f"<tr><td><b>{keys}</b>&nbsp;&nbsp;</td><td>{words}</td></tr>" for keys, words in [*MOUSE, *deeds])
    return f"<table cellpadding=2>{cells}</table>"
