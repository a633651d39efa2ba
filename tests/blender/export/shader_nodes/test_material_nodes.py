"""The formulas of single nodes against Cycles: one emitting square for each node, each set of inputs one pixel."""

import pytest

# Differences that are known: values at jumps and poles, hues outside 0..1.
ALLOWED = {"LOGARITHM", "WRAP", "HSV", "HSL", "STEPPED"}
COLUMNS = 40


def choices(node, name):
    import bpy

    return [item.identifier for item in getattr(bpy.types, node).bl_rna.properties[name].enum_items]


def cases():
    """(node type, properties, output) of everything that is compared."""
    plain = ("Invert", "Gamma", "BrightContrast", "HueSaturation", "RGBToBW", "CombineXYZ", "ValToRGB", "RGBCurve", "FloatCurve")
    found = [(f"ShaderNode{name}", {}, 0) for name in plain]
    found += [("ShaderNodeMath", {"operation": name}, 0) for name in choices("ShaderNodeMath", "operation")]
    found += [("ShaderNodeVectorMath", {"operation": name}, n) for name in choices("ShaderNodeVectorMath", "operation") for n in (0, 1)]
    for name in choices("ShaderNodeMixRGB", "blend_type"):
        found.append(("ShaderNodeMix", {"data_type": "RGBA", "blend_type": name}, 2))
        found.append(("ShaderNodeMix", {"data_type": "RGBA", "blend_type": name, "clamp_factor": False, "clamp_result": True}, 2))
    found += [("ShaderNodeMix", {"data_type": "FLOAT"}, 0), ("ShaderNodeMix", {"data_type": "VECTOR", "factor_mode": "NON_UNIFORM"}, 1)]
    for mode in ("RGB", "HSV", "HSL"):
        found += [("ShaderNodeSeparateColor", {"mode": mode}, n) for n in range(3)] + [("ShaderNodeCombineColor", {"mode": mode}, 0)]
    found += [("ShaderNodeSeparateXYZ", {}, n) for n in range(3)]
    found += [("ShaderNodeMapping", {"vector_type": name}, 0) for name in choices("ShaderNodeMapping", "vector_type")]
    for name in ("LINEAR", "STEPPED", "SMOOTHSTEP", "SMOOTHERSTEP"):
        for clamped in (True, False):
            found.append(("ShaderNodeMapRange", {"interpolation_type": name, "clamp": clamped}, 0))
            found.append(("ShaderNodeMapRange", {"interpolation_type": name, "clamp": clamped, "data_type": "FLOAT_VECTOR"}, 1))
    found += [("ShaderNodeClamp", {"clamp_type": name}, 0) for name in ("MINMAX", "RANGE")]
    for name in choices("ShaderNodeVectorRotate", "rotation_type"):
        found += [("ShaderNodeVectorRotate", {"rotation_type": name, "invert": inverse}, 0) for inverse in (False, True)]
    found += [("ShaderNodeTexGradient", {"gradient_type": name}, 1) for name in choices("ShaderNodeTexGradient", "gradient_type")]
    return [*found, ("ShaderNodeTexChecker", {}, 0), ("ShaderNodeTexChecker", {}, 1)]


def inputs():
    """Triples of colours."""
    import numpy as np

    random = np.random.default_rng(1)
    fixed = [
        [(0.2, 0.5, 0.8), (0.7, 0.3, 0.4), (0.5, 0.25, 0.9)],
        [(1.4, -0.6, 0.0), (-0.9, 2.2, 0.5), (0.3, 0.1, -0.4)],
        [(0.0, 1.0, 0.5), (1.0, 0.0, 0.0), (0.0, 2.0, 1.0)],
        [(3.7, 2.5, -1.5), (1.0, -2.0, 0.75), (0.2, 0.3, 0.4)],
    ]
    return fixed + [
        [tuple(random.uniform(-0.2, 1.2, 3)), tuple(random.uniform(0.05, 1.5, 3)), tuple(random.uniform(0, 1, 3))] for _ in range(2)
    ]


def shaped(node):
    """Gives ramps and curves a shape."""
    if node.bl_idname == "ShaderNodeValToRGB":
        node.color_ramp.elements.new(0.3).color = (1.0, 0.2, 0.1, 0.5)
    elif node.bl_idname in ("ShaderNodeRGBCurve", "ShaderNodeFloatCurve"):
        node.mapping.curves[0].points.new(0.3, 0.6)
        node.mapping.update()


def wired(node_type, properties, number):
    """A material that shows one output of a node whose inputs are three colour attributes; None if the output is not in use."""
    from recorder import material

    made, tree, end = material(node_type)
    node, light = tree.nodes.new(node_type), tree.nodes.new("ShaderNodeEmission")
    for name, value in properties.items():
        setattr(node, name, value)
    shaped(node)
    tree.links.new(light.outputs[0], end.inputs["Surface"])
    sources = [tree.nodes.new("ShaderNodeVertexColor") for _ in "abc"]
    for source, name in zip(sources, "abc", strict=True):
        source.layer_name = name
    for place, socket in enumerate(s for s in node.inputs if s.enabled):
        tree.links.new(sources[place % 3].outputs[0], socket)
    if not node.outputs[number].enabled:
        return None
    tree.links.new(node.outputs[number], light.inputs["Color"])
    return made


def rendered(count, height, path):
    """Cycles' picture of the squares, one pixel each, bottom row first."""
    import bpy
    import numpy as np
    from recorder import link

    scene = bpy.context.scene
    lens = bpy.data.cameras.new("Camera")
    lens.type, lens.ortho_scale, lens.sensor_fit = "ORTHO", COLUMNS, "HORIZONTAL"
    scene.camera = link(bpy.data.objects.new("Camera", lens))
    scene.camera.location = (COLUMNS / 2, height / 2, 5.0)
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.use_adaptive_sampling = 1, False, False
    scene.cycles.pixel_filter_type = "BOX"
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = COLUMNS, height, 100
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    picture = bpy.data.images.load(str(path))
    pixels = np.empty(COLUMNS * height * 4, dtype=np.float32)
    picture.pixels.foreach_get(pixels)
    return pixels.reshape(-1, 4)[:count, :3]


@pytest.mark.blender(seconds=300)
def test_nodes_compute_what_cycles_computes(tmp_path):
    import bpy
    import numpy as np
    from recorder import empty, evaluated, link, translated

    empty()
    mesh, sets = bpy.data.meshes.new("Squares"), inputs()
    corners, faces, slots, colours, expected, names = [], [], [], [[], [], []], [], []
    for node_type, properties, number in cases():
        made = wired(node_type, properties, number)
        if made is None:
            continue
        mesh.materials.append(made)
        description, lines = translated(made)
        assert not lines, lines
        emission = dict(description["closures"][0]["parameters"])["emission_color"]
        for values in sets:
            x, y = len(faces) % COLUMNS, len(faces) // COLUMNS
            faces.append(tuple(len(corners) + i for i in range(4)))
            corners += [(x, y, 0), (x + 1, y, 0), (x + 1, y + 1, 0), (x, y + 1, 0)]
            slots.append(len(mesh.materials) - 1)
            for column, value in zip(colours, values, strict=True):
                column += [(*value, 1.0)] * 4
            expected.append(
                evaluated(description, emission, {key: (*value, 1.0) for key, value in zip("abc", values, strict=True)})[:3] / 177.83
            )
            names.append((node_type, properties, number))
    mesh.from_pydata(corners, [], faces)
    mesh.polygons.foreach_set("material_index", slots)
    for name, column in zip("abc", colours, strict=True):
        mesh.attributes.new(name, "FLOAT_COLOR", "CORNER").data.foreach_set("color", np.array(column, dtype=np.float32).ravel())
    link(bpy.data.objects.new("Squares", mesh))
    found = rendered(len(faces), -(-len(faces) // COLUMNS), tmp_path / "nodes.exr")
    wrong = {}
    for name, value, reference in zip(names, expected, found, strict=True):
        if not np.abs(value - reference).max() <= 2e-3 * max(1.0, np.abs(reference).max()):
            wrong.setdefault(str(name), []).append((value, reference))
    assert len(expected) > 900
    unexpected = {name: pairs for name, pairs in wrong.items() if not any(f"'{known}'" in name for known in ALLOWED) or len(pairs) > 2}
    assert not unexpected, unexpected
