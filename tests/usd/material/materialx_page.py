"""Writes the MaterialX part of docs/nodes.md: `python tests/usd/material/materialx_page.py`, with gonio, usd-core and materialx installed."""

import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
PAGE = ROOT / "docs" / "nodes.md"
sys.path[:0] = [str(Path(__file__).parent), str(ROOT / "tests" / "shared")]

import materialx_reference as reference  # noqa: E402
import test_materialx_nodes as nodes  # noqa: E402

KERNELS = "kernel within 6e-7 of the library's own (`rust-core/nodes/tests/noise`)"
PLACES = "closed forms (`tests/usd/material/test_materialx_places.py`)"
FLATTENED = "a graph of other nodes; its values are not measured"
IMAGES = "pictures (`tests/usd/material/test_images.py`, `tests/usd/material/test_materials.py`)"
# How nodes are tested that cannot stand in a picture of values, or why they are not there.
ELSEWHERE = {
    **dict.fromkeys(["noise2d", "noise3d", "fractal2d", "fractal3d", "cellnoise2d", "cellnoise3d", "worleynoise2d", "worleynoise3d"], KERNELS),
    **dict.fromkeys(["unifiednoise2d", "unifiednoise3d", "randomfloat", "randomcolor"], FLATTENED),
    **dict.fromkeys(["position", "normal", "tangent", "bitangent", "texcoord", "geompropvalue", "geompropvalueuniform", "geomcolor"], PLACES),
    **dict.fromkeys(["transformpoint", "transformvector", "transformnormal", "normalmap", "bump", "heighttonormal", "viewdirection"], PLACES),
    **dict.fromkeys(["image", "tiledimage", "latlongimage", "triplanarprojection", "hextiledimage"], IMAGES),
    **dict.fromkeys(["time", "frame"], "constants of the frame (`tests/usd/material/test_materials.py`)"),
    **dict.fromkeys(["tiledcircles", "tiledcloverleafs", "tiledhexagons", "gooch_shade"], FLATTENED),
}
ABSENT = {
    "flake2d": "no kernel",
    "flake3d": "no kernel",
    "hextilednormalmap": "no kernel",
    "blur": "the input as it is",
}


def rows():
    """Category, number of definitions, state and how it is known, of each pattern node of the library."""
    library = reference.Library(nodes.LIBRARIES)
    with tempfile.TemporaryDirectory() as folder:
        found, _ = nodes.measured(Path(folder))
    largest, counts = {}, {}
    for category, _, _, part, expected, seen in found:
        largest[category] = max(largest.get(category, 0.0), nodes.difference(expected, seen, part))
    for definition in library.definitions.values():
        counts[definition.get("node")] = counts.get(definition.get("node"), 0) + 1
    for category in sorted(set(largest) | (set(ELSEWHERE) | set(ABSENT)) & set(counts)):
        count = counts.get(category, 0)
        if category in ABSENT:
            yield category, count, "not", ABSENT[category]
        elif category in largest:
            state = "exact" if largest[category] <= nodes.TOLERANCE else "approximated"
            yield category, count, state, f"definition in double precision, {largest[category]:.0e}"
        else:
            how = ELSEWHERE[category]
            yield category, count, "flattened" if how == FLATTENED else "tested", how


def main():
    found = list(rows())
    exact = sum(state == "exact" for _, _, state, _ in found)
    lines = [
        "## MaterialX",
        "",
        f"Pattern nodes of MaterialX's standard library, by category: **{exact} of {len(found)}** are exact. Values are held to the library's own",
        f"definitions, evaluated in double precision, at {nodes.PLACES} places a definition; the largest difference is a share of one and the value.",
        "What is *tested* has tests of another kind, what is *flattened* is put together from nodes of this table as the library says.",
        "This part is written by `python tests/usd/material/materialx_page.py`.",
        "",
        "| node | definitions | state | how tested, largest difference |",
        "| --- | --- | --- | --- |",
        *(f"| `{category}` | {count} | {state} | {how} |" for category, count, state, how in found),
        "",
    ]
    text = PAGE.read_text(encoding="utf-8").partition("\n## MaterialX")[0].rstrip("\n")
    PAGE.write_text(text + "\n\n" + "\n".join(lines), encoding="utf-8")


if __name__ == "__main__":
    main()
