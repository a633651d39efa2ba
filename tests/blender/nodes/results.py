"""What was measured, one file for each Blender, and what it comes to for a node. No Blender needed."""

import json
from dataclasses import dataclass, field
from pathlib import Path

from . import catalogue
from .case import NOT_APPLICABLE, Node

FOLDER = Path(__file__).with_name("measured")
EXACT, APPROXIMATED, NOT, NONE = "exact", "approximated", "not", "–"


def written(blender: str, found: dict) -> str:
    """The text of a file: a line for each output, so that changes can be read."""
    lines = [
        f"{json.dumps([name, mode, output])}: {json.dumps(entry)}"
        for name, modes in sorted(found.items())
        for mode, outputs in modes.items()
        for output, entry in outputs.items()
    ]
    return "\n".join([blender, *lines, ""])


def read(path: Path) -> tuple[str, dict]:
    """The Blender that was measured, and what was found: node -> mode -> output -> entry."""
    blender, *lines = path.read_text(encoding="utf-8").splitlines()
    found: dict = {}
    for line in lines:
        (name, mode, output), entry = json.loads("[" + line.replace("]: {", "], {", 1) + "]")
        found.setdefault(name, {}).setdefault(mode, {})[output] = entry
    return blender, found


@dataclass
class Verdict:
    """What a Blender's measurements say of a node."""

    state: str
    # What is not exact, with its largest difference, and how many outputs of modes are.
    differing: dict[str, float] = field(default_factory=dict)
    agreeing: int = 0
    total: int = 0
    largest: float = 0.0
    # Of what is exact: texels at steps that fell to the other side, and texels compared.
    beyond: int = 0
    compared: int = 0
    told: tuple[str, ...] = ()


def is_exact(entry: dict) -> bool:
    """Whether an output is Cycles', and nothing stood in for it."""
    return entry["exact"] and "told" not in entry


def verdict(name: str, node: Node, version: tuple, found: dict) -> Verdict:
    """What is known of a node in one Blender."""
    if not node.since <= version <= node.until or node.kind == NOT_APPLICABLE:
        return Verdict(NONE)
    entries = [entry for outputs in found.get(name, {}).values() for entry in outputs.values()]
    good = [entry for entry in entries if is_exact(entry)]
    if len(good) == len(entries) > 0:
        state = EXACT
    else:
        state = APPROXIMATED if any("told" not in entry for entry in entries) else NOT
    return Verdict(
        state,
        _differing(found.get(name, {})),
        len(good),
        len(entries),
        max((entry["largest"] for entry in entries), default=0.0),
        sum(entry["beyond"] for entry in good),
        sum(entry["compared"] for entry in good),
        tuple(dict.fromkeys(entry["told"] for entry in entries if "told" in entry)),
    )


def _differing(modes: dict) -> dict[str, float]:
    """Modes of which no output is exact, and outputs that are not where others are."""
    made = {}
    for mode, outputs in modes.items():
        bad = {output: entry["largest"] for output, entry in outputs.items() if not is_exact(entry)}
        if bad and len(bad) == len(outputs):
            made[mode] = max(bad.values())
        else:
            made.update({f"{mode}: {output}": value for output, value in bad.items()})
    return made


def all_verdicts() -> dict[tuple, dict[str, Verdict]]:
    """Of each Blender that was measured."""
    made = {}
    for path in sorted(FOLDER.glob("*.txt")):
        version = tuple(int(part) for part in path.stem.split("."))
        _, found = read(path)
        made[version] = {name: verdict(name, node, version, found) for name, node in catalogue.NODES.items()}
    return made
