# SPDX-License-Identifier: GPL-3.0-or-later
"""Buttons of the report panel."""

import bpy
from bpy.props import IntProperty

from .. import report


class GONIO_OT_report_jump(bpy.types.Operator):
    """Show where this comes from: the node in the shader editor, or the object"""

    bl_idname = "gonio.report_jump"
    bl_label = "Show"
    bl_options = {"REGISTER", "UNDO"}

    index: IntProperty(name="Line", description="Number of the line in the report", min=0, options={"HIDDEN"})

    def execute(self, context):
        lines = report.latest().counted
        if self.index >= len(lines):
            self.report({"WARNING"}, "The report has changed")
            return {"CANCELLED"}
        line = lines[self.index].first
        if line.material is not None:
            return self._show_material(context, line)
        if line.kind in ("World", "Light") and line.node is not None:
            return self._show_tree(context, line)
        found = _object_of(context, line)
        if found is None:
            self.report({"INFO"}, f"'{line.name}' is not in this view layer")
            return {"CANCELLED"}
        _activate(context, found)
        return {"FINISHED"}

    def _show_material(self, context, line):
        material = bpy.data.materials.get(line.material)
        if material is None:
            self.report({"INFO"}, f"There is no material '{line.material}' any more")
            return {"CANCELLED"}
        for each in context.view_layer.objects:
            slots = [slot.material for slot in each.material_slots]
            if material in slots:
                _activate(context, each)
                each.active_material_index = slots.index(material)
                break
        _show_node(context, material.node_tree, line.node, "OBJECT")
        return {"FINISHED"}

    def _show_tree(self, context, line):
        data = (bpy.data.worlds if line.kind == "World" else bpy.data.lights).get(line.name)
        if data is None or data.node_tree is None:
            self.report({"INFO"}, f"There is no '{line.name}' any more")
            return {"CANCELLED"}
        found = next((each for each in context.view_layer.objects if each.data == data), None)
        if found is not None:
            _activate(context, found)
        _show_node(context, data.node_tree, line.node, "WORLD" if line.kind == "World" else "OBJECT")
        return {"FINISHED"}


class GONIO_OT_report_copy(bpy.types.Operator):
    """Copy all lines of the report to the clipboard"""

    bl_idname = "gonio.report_copy"
    bl_label = "Copy Report"

    def execute(self, context):
        context.window_manager.clipboard = "\n".join(f"{line.severity}: {line.kind} {line.text}" for line in report.latest().diagnostics)
        return {"FINISHED"}


def _object_of(context, line):
    """The object that a line is about, by its own name or by its data's."""
    objects = context.view_layer.objects
    if line.kind == "Object":
        return objects.get(line.name)
    return next((each for each in objects if each.data is not None and each.data.name == line.name), objects.get(line.name))


def _activate(context, found) -> None:
    for each in context.selected_objects:
        each.select_set(False)
    found.select_set(True)
    context.view_layer.objects.active = found


def _show_node(context, tree, path: str | None, shader_type: str) -> None:
    """Makes a node the active one of its tree, groups on the way included, and shows it in a shader editor."""
    nodes = []
    inner = tree
    for name in path.split("/") if path else ():
        node = inner.nodes.get(name) if inner is not None else None
        if node is None:
            break
        for each in inner.nodes:
            each.select = each == node
        inner.nodes.active = node
        nodes.append(node)
        inner = getattr(node, "node_tree", None)
    area = _shader_editor(context)
    if area is None:
        return
    space = area.spaces.active
    space.shader_type = shader_type
    if tree is not None:
        space.path.start(tree)
        for node in nodes[:-1]:
            space.path.append(node.node_tree, node=node)
    region = next(region for region in area.regions if region.type == "WINDOW")
    with context.temp_override(window=context.window, area=area, region=region):
        if nodes and bpy.ops.node.view_selected.poll():
            bpy.ops.node.view_selected()


def _shader_editor(context):
    """A shader editor of this window; one is opened in a new window when there is none. None without windows."""
    if context.window is None:
        return None
    for area in context.window.screen.areas:
        if area.type == "NODE_EDITOR" and area.ui_type == "ShaderNodeTree":
            return area
    if not bpy.ops.wm.window_new.poll():
        return None
    bpy.ops.wm.window_new()
    area = context.window_manager.windows[-1].screen.areas[0]
    area.ui_type = "ShaderNodeTree"
    return area
