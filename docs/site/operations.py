"""Writes docs/operations.md of the table of shading nodes: `python docs/site/operations.py`. A test holds the page to the table."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NODES = ROOT / "rust-core" / "nodes" / "src"
PAGE = ROOT / "docs" / "operations.md"
INTRODUCTION = """# Node operations

What the graphs of materials compute with: the operations of `Scene.put_material`, `Scene.to_dict` and bundles. Blender's nodes and MaterialX's are made of
them ([Shader nodes](nodes.md)). This page is written by `python docs/site/operations.py` from the table that the kernels come from.

All values have four components. A node's inputs are constants or outputs of nodes that stand before it:

```python
graph = {
    "nodes": [
        {"operation": "Position", "inputs": []},
        {"operation": "Multiply", "inputs": [{"Node": [0, "Rgb"]}, {"Constant": [4.0, 4.0, 4.0, 4.0]}]},
        {"operation": "Floor", "inputs": [{"Node": [1, "R"]}]},
    ]
}
```

A node is named by its place and the channel that is taken of it: `Rgb`, `R`, `G`, `B` or `A`; an input of one component reads the first.
`gonio.Texture` and `add_material` make such graphs for images.

*Inputs* have their number of components where that is not four. *Outputs* tells how many components the kernel gives, and what the others are.
"""
SECTIONS = {
    "each": ("Component by component", "All four components are computed alike."),
    "whole": ("Vectors, colours and patterns", "Outputs come from the components of all inputs."),
    "hit": ("What the surface, the ray and images tell", "These ask the point that was hit, the ray, or a table of the scene."),
}
REST = {"Splat": "1, in all four", "Zero": "{}, the others 0", "Keep": "{}, the others those of the first input"}
ROW = re.compile(
    r"(?P<words>(?:^ {8}///[^\n]*\n)+) {8}(?P<name>[A-Z]\w*)\s*"
    r"(?:\{(?P<fields>.*?)^ {8}\})?(?:<\s*(?P<inner>\w+): (?P<inner_type>\w+)\s*>)?\(\s*(?P<inputs>[^()]*?)\s*\)"
    r"(?:\s*->\s*(?P<count>\d), (?P<rest>\w+))?",
    re.DOTALL | re.MULTILINE,
)
FIELD = re.compile(r"(?P<words>(?:^ +///[^\n]*\n)+)(?:^ +#\[[^\n]*\n)*^ +(?:pub )?(?P<name>\w+): (?P<type>[^\n]+?),?$", re.MULTILINE)
VARIANT = re.compile(r"(?P<words>(?:^ +///[^\n]*\n)+)(?:^ +#\[[^\n]*\n)*^ +(?P<name>[A-Z]\w*)\s*[,({]", re.MULTILINE)


@dataclass(frozen=True)
class Operation:
    """A row of the table."""

    name: str
    section: str
    inputs: list[str]
    outputs: str
    words: str
    # Settings of the operation: name, type and meaning.
    fields: list[tuple[str, str, str]]


def prose(comment: str) -> str:
    """The words of doc comments, links to code as code."""
    text = " ".join(line.strip().removeprefix("///").strip() for line in comment.strip().splitlines())
    return re.sub(r"\[(`[^`]+`)\](?:\([^)]*\))?", r"\1", text)


def operations() -> list[Operation]:
    """All rows, in the table's order."""
    source = (NODES / "table.rs").read_text()
    table = source[source.index("\noperations! {") :]
    starts = [table.index(f"\n    {section} {{") for section in SECTIONS] + [len(table)]
    found = []
    for section, start, end in zip(SECTIONS, starts, starts[1:], strict=False):
        found += [row(section, match) for match in ROW.finditer(table[start:end])]
    return found


def row(section: str, match: re.Match[str]) -> Operation:
    """A row as it matched."""
    given = [part.strip() for part in match["inputs"].split(",") if part.strip()]
    if section != "hit":
        # The lanes come first.
        given = given[1:]
    inputs = [name if width in ("", "4") else f"{name} ({width})" for name, _, width in (part.replace(" ", "").partition(":") for part in given)]
    outputs = "4" if section == "each" or match["count"] == "4" else REST[match["rest"]].format(match["count"])
    fields = [(field["name"], field["type"], prose(field["words"])) for field in FIELD.finditer(match["fields"] or "")]
    if match["inner_type"]:
        fields = settings(match["inner_type"])
    return Operation(match["name"], section, inputs, outputs, prose(match["words"]), fields)


def settings(name: str) -> list[tuple[str, str, str]]:
    """What a type of the crate holds: fields of a structure, or names of an enumeration."""
    for path in sorted(NODES.glob("**/*.rs")):
        source = path.read_text()
        if block := re.search(rf"^pub struct {name} \{{\n(.*?)^\}}", source, re.DOTALL | re.MULTILINE):
            return [(field["name"], field["type"], prose(field["words"])) for field in FIELD.finditer(block[1])]
        if block := re.search(rf"^pub enum {name} \{{\n(.*?)^\}}", source, re.DOTALL | re.MULTILINE):
            return [(variant["name"], "", prose(variant["words"])) for variant in VARIANT.finditer(block[1])]
    return []


def table(found: list[Operation]) -> list[str]:
    """A section's operations as a table."""
    lines = ["| operation | inputs | outputs | meaning |", "| --- | --- | --- | --- |"]
    for operation in found:
        lines.append(f"| `{operation.name}` | {', '.join(operation.inputs) or '–'} | {operation.outputs} | {escaped(operation.words)} |")
    return lines


def escaped(words: str) -> str:
    """Words as a cell holds them."""
    return words.replace("|", "\\|")


def page() -> str:
    """The whole page."""
    lines, found = [INTRODUCTION], operations()
    for section, (title, words) in SECTIONS.items():
        lines += [f"## {title}", "", words, "", *table([each for each in found if each.section == section]), ""]
    lines += ["## Settings of operations", "", "Operations with settings are written `{\"Name\": {\"setting\": value}}`, those of one word `{\"Name\": \"Word\"}`.", ""]
    for operation in sorted((each for each in found if each.fields), key=lambda each: each.name):
        lines += [f"### {operation.name}", "", "| setting | type | meaning |", "| --- | --- | --- |"]
        lines += [f"| `{name}` | {f'`{kind}`' if kind else 'word'} | {escaped(words)} |" for name, kind, words in operation.fields] + [""]
    words = sorted({word for each in found for _, kind, _ in each.fields for word in re.findall(r"[A-Z]\w+", kind)})
    lines += ["## Words of settings", ""]
    for word in words:
        if chosen := settings(word):
            lines += [f"### {word}", "", "| word | meaning |", "| --- | --- |"]
            lines += [f"| `{name}` | {escaped(meaning)} |" for name, _, meaning in chosen] + [""]
    return "\n".join(lines)


if __name__ == "__main__":
    PAGE.write_text(page())
