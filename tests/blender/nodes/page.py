"""Writes docs/nodes.md: `python tests/blender/nodes/page.py` from what was measured last, with `--measure` after measuring again.

`GONIO_BPY` names the Pythons with `bpy` that measure, separated by colons; each takes two minutes.
"""

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests" / "blender"))

from nodes import catalogue, results  # noqa: E402
from nodes.case import STRUCTURE, VALUE, Node  # noqa: E402

PAGE = ROOT / "docs" / "nodes.md"
# The first Blender of which only what it has beyond those before it is measured.
LATER = (5, 1)
# Where the part on Blender ends.
OTHERS = "\n## MaterialX"
FAMILIES = ["Input", "Texture", "Color", "Vector", "Converter", "Shader", "Volume", "Structure", "Not for materials"]

HEAD = """# Shader nodes

Each shader node of Blender 4.5 and 5.0, held to Cycles of the same Blender: both engines render one scene, and what they show is compared.
The one node that only Blender 5.2 has stands by itself.
The page is written by `python tests/blender/nodes/page.py` from `tests/blender/nodes/measured`.

{counts}

How it is tested:

- **texels**: a plane whose texels hold a node's inputs: coordinates, numbers of both signs, zeros, large ones. Both engines reckon with
  the same bits. A node's output is read as it is from a shader AOV, and as emission.
- **ball**: a turned ball seen in perspective. Both engines sample within a hundredth of a pixel of its middle, and values are carried
  along their slopes to the same place. Up to 1 % of the pixels may differ, where samples meet other faces. Bumps are slopes between heights
  a tenth of a pixel apart, which single precision rounds by some 1e-4 in either engine, more the farther a pixel is from the origin; that
  noise goes both ways. So middles of blocks of 8 by 8 pixels are held to the tolerance, and pixels alone only where heights lie a whole
  pixel apart. Skies of atmospheres are held so too.
- **particles**: the same with balls that particles instance.
- **light**: a ball under a soft sky; means of 16 blocks, which hold noise, within 4 % but for one.
- **found light**: the same, but Cycles does not sample the sky as a light. Where it does, it leaves out what fibres on meshes send to the
  other side of smooth normals, and its picture darkens by up to 16 % (Hair BSDF) or 4 % (Principled Hair BSDF, 5.0 alone): it then
  differs that much from the same Cycles without, and from Gonio, which counts all light.
- **rays**: the same for outputs that rays find out, or that depend on the kind of ray: blocks beside a floor, or a mirror.
- **tree**: a tree built with the node, by texels.

A node is *exact* where every output of every mode is within 1e-4 of Cycles' (1e-6 for hashes, whole numbers and plain sums), relative to
the value or to the usual value of the case. Steps such as the borders of cells may fall to the other side in a few texels of a thousand;
*at steps* counts them. *Approximated* says that some outputs differ, *not* that something stands in for the node.
"""
WAYS = {"balls": "ball", "near": "ball", "particles": "particles", "lit": "light", "floor": "rays", "mirror": "rays"}
WAYS |= {"found": "found light", "filled": "light"}


def how(node: Node) -> str:
    """How a node is tested."""
    if not node.cases:
        return "–"
    ways = {**WAYS, "tiles": "tree" if node.kind == STRUCTURE else "texels"}
    return ", ".join(dict.fromkeys(ways[case.shown_on] for case in node.cases))


def counts(verdicts: dict) -> str:
    """How many nodes are exact, by Blender."""
    lines = []
    for version, found in verdicts.items():
        there = [name for name, node in catalogue.NODES.items() if node.counts and node.since <= version <= node.until]
        exact = sum(found[name].state == results.EXACT for name in there)
        name, share = ".".join(str(part) for part in version), 100.0 * exact / len(there)
        lines.append(f"- Blender {name}: **{exact} of {len(there)}** nodes that a material can hold are exact ({share:.0f} %).")
    return "\n".join(lines)


def _figure(value: float) -> str:
    return "0" if value == 0.0 else f"{value:.1e}"


def row(name: str, node: Node, verdicts: dict) -> str:
    """A node's row of the table."""
    states = [found[name].state for found in verdicts.values()]
    shown = [found[name] for found in verdicts.values() if found[name].state != results.NONE]
    newest = shown[-1] if shown else results.Verdict(results.NONE)
    agree = f"{newest.agreeing} of {newest.total}" if newest.total else "–"
    largest = _figure(max(each.largest for each in shown)) if newest.total else "–"
    at_steps = newest.beyond and node.kind == VALUE
    steps = f"{newest.beyond} of {newest.compared}" if at_steps else ""
    cells = [f"{node.name} (`{name}`)", *states, agree, how(node), largest, steps, remark(node, newest)]
    return "| " + " | ".join(cells) + " |"


def remark(node: Node, found: results.Verdict) -> str:
    """Why a node is not exact, in the add-on's words, or what the catalogue says of it."""
    said = [node.remark] if node.remark else []
    if found.state == results.APPROXIMATED and node.reason and not found.told:
        said.append(node.reason)
    said += [re.sub("(^|: )not supported; ", "\\1", each) for each in found.told[:3]]
    return "; ".join(dict.fromkeys(said))


def differing(verdicts: dict, family: str) -> list[str]:
    """A line for each node of a family of which some modes agree and some do not."""
    lines = []
    for name, node in catalogue.NODES.items():
        if node.family != family:
            continue
        for version, found in reversed(verdicts.items()):
            made = found[name]
            if made.state == results.APPROXIMATED:
                modes = "; ".join(f"{mode.removeprefix('all: ')} {_figure(value)}" for mode, value in made.differing.items())
                lines.append(f"- {node.name}, {'.'.join(map(str, version))}: {modes}")
                break
    return lines


def page() -> str:
    """The page."""
    every = results.all_verdicts()
    verdicts = {version: found for version, found in every.items() if version < LATER}
    parts = [HEAD.format(counts=counts(verdicts))]
    versions = " | ".join(".".join(str(part) for part in version) for version in verdicts)
    for family in FAMILIES:
        rows = [row(name, node, verdicts) for name, node in catalogue.NODES.items() if node.family == family and node.since < LATER]
        head = f"| node | {versions} | outputs exact | tested by | largest difference | at steps | remark |"
        rule = "| --- " * (6 + len(verdicts)) + "|"
        parts.append("\n".join([f"## {family}", "", head, rule, *rows, ""]))
        lines = differing(verdicts, family)
        if lines:
            parts.append("\n".join(["What differs, with the largest relative difference:", "", *lines, ""]))
    return "\n".join(parts + later(every)) + rest()


def later(every: dict) -> list[str]:
    """Nodes that only later Blenders have, of which no others are measured."""
    parts = []
    for version, found in every.items():
        names = [name for name, node in catalogue.NODES.items() if LATER <= node.since <= version]
        if version >= LATER and names:
            title = f"Only in Blender {'.'.join(map(str, version))}"
            rows = [row(name, catalogue.NODES[name], {version: found}) for name in names]
            head = f"| node | {'.'.join(map(str, version))} | outputs exact | tested by | largest difference | at steps | remark |"
            parts.append("\n".join([f"## {title}", "", head, "| --- " * 7 + "|", *rows, ""]))
    return parts


def rest() -> str:
    """What others wrote below Blender's part."""
    written = PAGE.read_text(encoding="utf-8") if PAGE.exists() else ""
    at = written.find(OTHERS)
    return written[at:] if at >= 0 else ""


def measure() -> None:
    """Measures with each Python that has bpy."""
    from conftest import CHILD, pythons

    with tempfile.TemporaryDirectory() as folder:
        for python in pythons():
            request = json.dumps([str(Path(__file__).with_name("measure.py")), "measure", {"tmp_path": folder}])
            subprocess.run([str(python), str(CHILD)], input=request, text=True, check=True, cwd=ROOT, stdout=subprocess.DEVNULL)
        results.FOLDER.mkdir(exist_ok=True)
        for made in Path(folder).glob("*.txt"):
            (results.FOLDER / made.name).write_bytes(made.read_bytes())


if __name__ == "__main__":
    if "--measure" in sys.argv[1:]:
        measure()
    PAGE.write_text(page(), encoding="utf-8")
