"""What input nodes tell in the trees of lamps and worlds: as in Cycles, or named in the report."""

import pytest

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
    "ball": {"shadow_soft_size": 0.4},
    "SPOT": {"shadow_soft_size": 0.0, "spot_size": 1.6, "spot_blend": 0.0},
    "AREA": {"shape": "RECTANGLE", "size": 0.8, "size_y": 0.5},
    "SUN": {"angle": 0.0},
}
ATTRIBUTES = {"of the mesh": ("GEOMETRY", "UVMap"), "of the object": ("OBJECT", "tint"), "of the instancer": ("INSTANCER", "tint"), "of the layer": ("VIEW_LAYER", "tint")}
# Largest part of the brightest pixel that two pictures may differ by, at 256 samples.
TOLERANCE = 0.04


def shining(tree, kind, output, target, prepare=None):
    """Links a share of an output's values, made positive, to a light's colour."""
    node, moved = tree.nodes.new(f"ShaderNode{kind}"), tree.nodes.new("ShaderNodeVectorMath")
    if prepare is not None:
        prepare(node)
    moved.operation = "MULTIPLY_ADD"
    moved.inputs[1].default_value, moved.inputs[2].default_value = (0.2, 0.3, 0.25), (0.6, 0.6, 0.6)
    tree.links.new(next(each for each in node.outputs if output in (each.name, each.identifier)), moved.inputs[0])
    tree.links.new(moved.outputs[0], target)


def lit_by(kind):
    """A plane under a lamp that is turned: the lamp's object."""
    import bpy
    from beside_cycles import scene
    from recorder import link

    made = scene(16, 16, scale=6.0, samples=256)
    made.cycles.max_bounces = 0
    bpy.ops.mesh.primitive_plane_add(size=20.0)
    lamp = bpy.data.lights.new("Lamp", "POINT" if kind == "ball" else kind)
    lamp.energy = 5.0 if kind == "SUN" else 150.0
    for name, value in LAMPS[kind].items():
        setattr(lamp, name, value)
    thing = link(bpy.data.objects.new("Lamp", lamp))
    thing.location, thing.rotation_euler = (0.4, -0.3, 2.5), (0.3, -0.2, 0.7)
    thing.color, thing.pass_index = (0.2, 0.9, 0.5, 0.4), 3
    for owner in (thing, bpy.context.view_layer):
        owner["tint"] = (0.9, 0.2, 0.5)
    return lamp


def silent_differences(path, name):
    """What differs though no line of the report names its node."""
    import bpy
    import numpy as np
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
    cycles, gonio = shown
    told = [line.text for line in module("report").latest().diagnostics if line.severity == "WARNING"]
    apart = float(np.abs(cycles - gonio).max() / cycles.max())
    means = cycles.mean(axis=(0, 1)), gonio.mean(axis=(0, 1))
    print(f"{name}: {apart:.3f} apart, {np.round(means[0], 4)} {np.round(means[1], 4)} {told}")
    return [] if apart < TOLERANCE or told else [f"{name}: {apart:.3f} apart, means {means}"]


@pytest.mark.blender(seconds=600)
@pytest.mark.parametrize("kind", list(LAMPS))
def test_inputs_of_lamps(tmp_path, kind):
    from test_lamp_nodes import lit

    wrong = []
    for node, outputs in OUTPUTS.items():
        for output in outputs:
            lit(lit_by(kind), lambda tree, light, node=node, output=output: shining(tree, node, output, light.inputs["Color"]))
            wrong += silent_differences(tmp_path, f"{node} {output}")
    for name, (where, attribute) in ATTRIBUTES.items():
        for output in OUTPUTS["Attribute"]:

            def prepare(node, where=where, attribute=attribute):
                node.attribute_type, node.attribute_name = where, attribute

            lit(lit_by(kind), lambda tree, light, output=output, prepare=prepare: shining(tree, "Attribute", output, light.inputs["Color"], prepare))
            wrong += silent_differences(tmp_path, f"Attribute {name} {output}")
    assert not wrong, "\n".join(wrong)


@pytest.mark.blender(seconds=600)
def test_inputs_of_worlds(tmp_path):
    import bpy
    from beside_cycles import scene

    wrong = []
    for node, outputs in OUTPUTS.items():
        for output in outputs:
            made = scene(16, 16, samples=64)
            made.camera.rotation_euler, made.camera.data.type, made.camera.data.lens = (1.2, 0.1, 0.6), "PERSP", 30.0
            tree = made.world.node_tree
            shining(tree, node, output, tree.nodes["Background"].inputs["Color"])
            wrong += silent_differences(tmp_path, f"{node} {output}")
    assert not wrong and bpy.context.scene, "\n".join(wrong)
