# SPDX-License-Identifier: GPL-3.0-or-later
"""What Gonio's panels have in common."""

ENGINE = "GONIO"


class GonioPanel:
    """A panel of the properties editor that shows when Gonio is the engine."""

    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    COMPAT_ENGINES = {ENGINE}

    @classmethod
    def poll(cls, context):
        return context.engine in cls.COMPAT_ENGINES


class RenderPanel(GonioPanel):
    """A panel of the render tab: two columns, names left of values."""

    bl_context = "render"

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        self.draw_settings(self.layout, context.scene)

    def draw_settings(self, layout, scene):
        """The panel's own rows; a panel that only holds others has none."""


def draw_shader(layout, owner, output_type: str, socket: str) -> bool:
    """The tree of nodes behind a socket of a material's, world's or light's output, as rows; False without nodes."""
    tree = owner.node_tree
    if tree is None:
        return False
    # Gonio reads the outputs that are for Cycles or for all engines.
    output = tree.get_output_node("CYCLES") or next((node for node in tree.nodes if node.type == output_type), None)
    if output is None:
        layout.label(text="No output node")
    elif socket in output.inputs:
        layout.template_node_view(tree, output, output.inputs[socket])
    else:
        layout.label(text="Incompatible output node")
    return True
