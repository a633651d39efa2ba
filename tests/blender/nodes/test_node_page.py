"""The page of shader nodes: it is the one that was measured, and no node is left out."""

import re

import pytest
from nodes import catalogue, page, results


def test_the_page_is_written_from_what_was_measured():
    assert page.PAGE.read_text(encoding="utf-8") == page.page(), "python tests/blender/nodes/page.py writes it"


def test_the_page_has_each_node_of_the_catalogue_once():
    named = re.findall(r"^\| [^|]+ \(`(\w+)`\) \|", page.PAGE.read_text(encoding="utf-8"), re.MULTILINE)
    assert sorted(named) == sorted(catalogue.NODES)


def test_modes_have_names_of_their_own():
    for name, node in catalogue.NODES.items():
        modes = [(case.mode, case.since) for case in node.cases]
        assert len(set(modes)) == len(modes), name
        assert node.cases or node.remark, f"{name} is neither tested nor explained"


def test_what_is_measured_is_in_the_catalogue():
    for path in results.FOLDER.glob("*.txt"):
        _, found = results.read(path)
        for name, modes in found.items():
            assert set(modes) <= {case.mode for case in catalogue.NODES[name].cases}, name


@pytest.mark.blender
def test_the_catalogue_has_each_node_of_blender():
    import bpy

    version = bpy.app.version[:2]
    material = bpy.data.materials.new("Any")
    if version < (5, 0):
        material.use_nodes = True
    missing = []
    for name in dir(bpy.types):
        kind = getattr(bpy.types, name)
        if not (isinstance(kind, type) and issubclass(kind, bpy.types.Node)) or name in OWN:
            continue
        try:
            material.node_tree.nodes.new(name)
        except RuntimeError:
            continue
        node = catalogue.NODES.get(name)
        if node is None or not node.since <= version <= node.until:
            missing.append(name)
    assert not missing, missing


# The add-on's own, and what is a base of others.
OWN = {"GONIO_NODE_Measured", "ShaderNodeCustomGroup"}
