"""Materials that look otherwise to rays of some kinds, against Cycles: a sheet over a floor, its shadow beside it."""

import pytest


def mixed(kind, usual, other):
    """A mix of two shaders, the second of which rays of one kind see; each is a node's type and its inputs."""

    def build(tree):
        path, mix = tree.nodes.new("ShaderNodeLightPath"), tree.nodes.new("ShaderNodeMixShader")
        tree.links.new(path.outputs[kind], mix.inputs[0])
        for number, (name, values) in enumerate((usual, other), 1):
            shader = tree.nodes.new(f"ShaderNode{name}")
            for key, value in values.items():
                shader.inputs[key].default_value = value
            tree.links.new(shader.outputs[0], mix.inputs[number])
        return mix.outputs[0]

    return build


def through_alpha(tree):
    """A Principled BSDF that is as clear to shadow rays as it is not to others."""
    path, part, shader = (tree.nodes.new(f"ShaderNode{name}") for name in ("LightPath", "Math", "BsdfPrincipled"))
    part.operation = "MULTIPLY_ADD"
    part.inputs[1].default_value, part.inputs[2].default_value = -0.7, 1.0
    shader.inputs["Base Color"].default_value = (0.7, 0.2, 0.1, 1.0)
    shader.inputs["Roughness"].default_value = 1.0
    tree.links.new(path.outputs["Is Shadow Ray"], part.inputs[0])
    tree.links.new(part.outputs[0], shader.inputs["Alpha"])
    return shader.outputs[0]


def half_clear(tree):
    """A Principled BSDF that lets half of all rays through."""
    shader = tree.nodes.new("ShaderNodeBsdfPrincipled")
    shader.inputs["Base Color"].default_value, shader.inputs["Alpha"].default_value = (0.7, 0.2, 0.1, 1.0), 0.5
    return shader.outputs[0]


def doubled(tree):
    """More light than there is: a surface that is added to what is behind it."""
    both, surface, clear = (tree.nodes.new(f"ShaderNode{name}") for name in ("AddShader", "BsdfDiffuse", "BsdfTransparent"))
    clear.inputs["Color"].default_value = (1.0, 1.2, 1.4, 1.0)
    surface.inputs["Color"].default_value = (0.2, 0.1, 0.1, 1.0)
    for number, shader in enumerate((surface, clear)):
        tree.links.new(shader.outputs[0], both.inputs[number])
    return both.outputs[0]


def by_depth(tree):
    """A diffuse colour that is red to the camera and blue to light that has been elsewhere."""
    path, mix, shader = (tree.nodes.new(f"ShaderNode{name}") for name in ("LightPath", "Mix", "BsdfDiffuse"))
    mix.data_type = "RGBA"
    colours = [socket for socket in mix.inputs if socket.type == "RGBA"]
    colours[0].default_value, colours[1].default_value = (0.8, 0.1, 0.1, 1.0), (0.1, 0.1, 0.8, 1.0)
    tree.links.new(path.outputs["Ray Depth"], mix.inputs[0])
    tree.links.new(next(socket for socket in mix.outputs if socket.type == "RGBA"), shader.inputs["Color"])
    return shader.outputs[0]


BLUE, GREEN, ORANGE = (0.1, 0.1, 1.0, 1.0), (0.1, 0.6, 0.1, 1.0), (1.0, 0.5, 0.1, 1.0)
SHEETS = {
    "clear shadow of glass": mixed("Is Shadow Ray", ("BsdfGlass", {"Roughness": 0.0}), ("BsdfTransparent", {})),
    "coloured shadow": mixed("Is Shadow Ray", ("BsdfDiffuse", {"Color": GREEN}), ("BsdfTransparent", {"Color": BLUE})),
    "light for the camera": mixed("Is Camera Ray", ("BsdfDiffuse", {"Color": GREEN}), ("Emission", {"Color": ORANGE, "Strength": 3.0})),
    "alpha": through_alpha,
    "depth": by_depth,
}


@pytest.mark.blender
@pytest.mark.parametrize("kind", list(SHEETS))
def test_rays_see_what_cycles_shows_them(tmp_path, kind):
    under_sheets(tmp_path, SHEETS[kind])


@pytest.mark.blender
def test_transparent_shadows_may_be_off(tmp_path):
    shown = under_sheets(tmp_path, half_clear, transparent_shadows=False)
    # The sheet's shadow, and the sheet before the lit floor.
    assert shown[4, 5].max() < 0.01 < shown[4, 1].max()


@pytest.mark.blender
@pytest.mark.parametrize(("sheets", "is_dark"), [(3, False), (4, True)])
def test_light_goes_through_as_many_surfaces_as_paths_do(tmp_path, sheets, is_dark):
    # Camera rays beyond the limit are another matter.
    shown = under_sheets(tmp_path, doubled, count=sheets, through=3, seen=False)
    assert (shown[4, 5].max() < 0.01) == is_dark


def under_sheets(tmp_path, surface, *, count=1, transparent_shadows=True, through=8, seen=True):
    """Compares the picture of sheets one above the other, of a surface that is built in a tree, and of their shadow; gives Gonio's blocks. So many
    surfaces light goes straight through."""
    import bpy
    import numpy as np
    from beside_cycles import both, scene
    from recorder import link, material

    made = scene(32, 32, scale=4.0, samples=256)
    made.cycles.transparent_max_bounces = through
    floor, tree, end = material("Floor")
    tree.links.new(tree.nodes.new("ShaderNodeBsdfDiffuse").outputs[0], end.inputs["Surface"])
    bpy.ops.mesh.primitive_plane_add(size=20.0)
    bpy.context.object.data.materials.append(floor)
    sheet, tree, end = material("Sheet")
    tree.links.new(surface(tree), end.inputs["Surface"])
    sheet.use_transparent_shadow = transparent_shadows
    for number in range(count):
        bpy.ops.mesh.primitive_plane_add(size=1.2, location=(-0.75, 0.0, 1.5 + 0.02 * number))
        bpy.context.object.data.materials.append(sheet)
        bpy.context.object.visible_camera = seen
    sun = link(bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN")))
    sun.data.energy, sun.data.angle, sun.rotation_euler = 3.0, 0.0, (0.0, -0.7854, 0.0)
    # Otherwise Cycles roughens glass that light meets after a diffuse surface.
    made.cycles.max_bounces, made.cycles.blur_glossy = 8, 0.0
    cycles, gonio = (picture.reshape(8, 4, 8, 4, 3).mean(axis=(1, 3)) for picture in both(tmp_path))
    apart = np.abs(cycles - gonio).max(axis=-1) / cycles.max()
    assert apart.max() < 0.04 and apart.mean() < 0.01, (apart.max(), apart.mean())
    return gonio
