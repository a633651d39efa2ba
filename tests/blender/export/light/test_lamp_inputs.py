"""What input nodes tell in the trees of lamps and worlds: as in Cycles, or named in the report."""

import pytest

pytestmark = [pytest.mark.validate, pytest.mark.timeout(1800)]

# Outputs by the node's type.
OUTPUTS = {
    "NewGeometry": ("Position", "Normal", "Tangent", "True Normal", "Incoming", "Parametric", "Backfacing", "Pointiness", "Random Per Island"),
    "TexCoord": ("Generated", "Normal", "UV", "Object", "Camera", "Window", "Reflection"),
    "UVMap": ("UV",),
    "Attribute": ("Color", "Vector", "Fac", "Alpha"),
    "VertexColor": ("Color", "Alpha"),
    "ObjectInfo": ("Location", "Color", "Alpha", "Object Index", "Material Index", "Random"),
    "ParticleInfo": ("Index", "Random", "Age", "Lifetime", "Location", "Size", "Velocity", "Angular Velocity"),
    "HairInfo": ("Is Strand", "Intercept", "Length", "Thickness", "Tangent Normal", "Random"),
    "PointInfo": ("Position", "Radius", "Random"),
    "VolumeInfo": ("Color", "Density", "Flame", "Temperature"),
    "CameraData": ("View Vector", "View Z Depth", "View Distance"),
    "Fresnel": ("Fac",),
    "LayerWeight": ("Fresnel", "Facing"),
    "Tangent": ("Tangent",),
    "Wireframe": ("Fac",),
    "AmbientOcclusion": ("Color", "AO"),
    "Bevel": ("Normal",),
}
LAMPS = {
    "POINT": {"shadow_soft_size": 0.0},
    "ball": {"shadow_soft_size": 0.2},
    "SPOT": {"shadow_soft_size": 0.0, "spot_size": 2.2, "spot_blend": 0.0},
    "AREA": {"shape": "RECTANGLE", "size": 0.4, "size_y": 0.25},
    "SUN": {"angle": 0.0},
}
ATTRIBUTES = {
    "of the mesh": ("GEOMETRY", "UVMap"),
    "of the object": ("OBJECT", "tint"),
    "of the instancer": ("INSTANCER", "tint"),
    "of the layer": ("VIEW_LAYER", "tint"),
}
# Lamps of a picture, each with a square of its own; those that are linked are of no more kinds than Cycles tells apart.
TOGETHER, COLUMNS, PIXELS = 40, 20, 4
# Part that means of squares may differ by: samples choose among up to three parts of a pattern.
TOLERANCE = 0.03


def shining(tree, kind, output, target, prepare=None):
    """Links a share of an output's values, made positive, to a light's colour."""
    node, moved = tree.nodes.new(f"ShaderNode{kind}"), tree.nodes.new("ShaderNodeVectorMath")
    if prepare is not None:
        prepare(node)
    moved.operation = "MULTIPLY_ADD"
    moved.inputs[1].default_value, moved.inputs[2].default_value = (0.2, 0.3, 0.25), (0.6, 0.6, 0.6)
    tree.links.new(next(each for each in node.outputs if output in (each.name, each.identifier)), moved.inputs[0])
    tree.links.new(moved.outputs[0], target)


def cases():
    """Name, node type, output, and attribute if there is one, of all."""
    plain = [(f"{node} {output}", node, output, None) for node, outputs in OUTPUTS.items() for output in outputs]
    return plain + [(f"Attribute {name} {output}", "Attribute", output, of) for name, of in ATTRIBUTES.items() for output in OUTPUTS["Attribute"]]


def prepared(attribute):
    """What sets a node up for an attribute."""

    def prepare(node):
        if attribute is not None:
            node.attribute_type, node.attribute_name = attribute

    return prepare


def squares(kind, chosen):
    """Opens a scene with a square for each case, which a lamp of its own lights."""
    import bpy
    from beside_cycles import scene
    from recorder import link
    from test_lamp_nodes import lit

    rows = -(-len(chosen) // COLUMNS)
    made = scene(PIXELS * COLUMNS, PIXELS * max(rows, 1), scale=COLUMNS, samples=64)
    made.camera.location, made.cycles.max_bounces = (0.5 * COLUMNS, 0.5 * rows, 5.0), 0
    bpy.context.view_layer["tint"] = (0.9, 0.2, 0.5)
    for number, (name, node, output, attribute) in enumerate(chosen):
        row, column = divmod(number, COLUMNS)
        bpy.ops.mesh.primitive_plane_add(size=1.0, location=(column + 0.5, row + 0.5, 0.0))
        alone = bpy.data.collections.new(name)
        alone.objects.link(bpy.context.object)
        lamp = bpy.data.lights.new(name, "POINT" if kind == "ball" else kind)
        lamp.energy = 5.0 if kind == "SUN" else 30.0
        for field, value in LAMPS[kind].items():
            setattr(lamp, field, value)
        thing = link(bpy.data.objects.new(name, lamp))
        thing.location, thing.rotation_euler = (column + 0.6, row + 0.4, 1.0), (0.2, -0.15, 0.7)
        thing.color, thing.pass_index, thing["tint"] = (0.2, 0.9, 0.5, 0.4), 3, (0.9, 0.2, 0.5)
        thing.light_linking.receiver_collection = alone
        lit(lamp, lambda tree, light, *case: shining(tree, node, output, light.inputs["Color"], prepared(attribute)))


def pair(path):
    """Pictures of Cycles and Gonio, and the names of what the report's warnings are about."""
    import bpy
    from beside_cycles import pixels
    from recorder import module

    shown = []
    for engine in ("CYCLES", "GONIO"):
        made = bpy.context.scene
        made.render.engine = engine
        if engine == "GONIO":
            bpy.ops.gonio.settings_from_cycles()
            made.gonio.use_adaptive_sampling = False
        made.render.filepath = str(path / f"{engine}.exr")
        bpy.ops.render.render(write_still=True)
        shown.append(pixels(path / f"{engine}.exr"))
    return *shown, {line.name for line in module("report").latest().diagnostics if line.severity == "WARNING"}


def judged(name, cycles, gonio, is_told):
    """A line for what differs though the report does not name it."""
    import numpy as np

    cycles, gonio = cycles.mean(axis=(0, 1)), gonio.mean(axis=(0, 1))
    apart = float(np.abs(cycles - gonio).max() / max(cycles.max(), gonio.max()))
    line = f"{name}: {apart:.3f} apart, Cycles {np.round(cycles, 3)}, Gonio {np.round(gonio, 3)}"
    print(line + (", told" if is_told else ""))
    return [] if apart < TOLERANCE or is_told else [line]


@pytest.mark.blender(seconds=900)
@pytest.mark.parametrize("kind", list(LAMPS))
def test_inputs_of_lamps(tmp_path, kind):
    wrong, every = [], cases()
    for first in range(0, len(every), TOGETHER):
        chosen = every[first : first + TOGETHER]
        squares(kind, chosen)
        cycles, gonio, told = pair(tmp_path)
        for number, (name, *_) in enumerate(chosen):
            row, column = divmod(number, COLUMNS)
            # Rows of pictures begin at the top.
            end = len(cycles) - PIXELS * row
            place = slice(end - PIXELS, end), slice(PIXELS * column, PIXELS * (column + 1))
            wrong += judged(name, cycles[place], gonio[place], name in told)
    assert not wrong, "\n".join(wrong)


@pytest.mark.blender(seconds=1800)
def test_inputs_of_worlds(tmp_path):
    from beside_cycles import scene

    wrong = []
    for name, node, output, attribute in cases():
        made = scene(16, 16, samples=16)
        made.camera.rotation_euler, made.camera.data.type, made.camera.data.lens = (1.2, 0.1, 0.6), "PERSP", 30.0
        made.world.name = name
        shining(made.world.node_tree, node, output, made.world.node_tree.nodes["Background"].inputs["Color"], prepared(attribute))
        cycles, gonio, told = pair(tmp_path)
        wrong += judged(name, cycles, gonio, name in told)
    assert not wrong, "\n".join(wrong)
