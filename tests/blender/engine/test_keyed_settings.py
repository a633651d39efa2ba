"""Settings with keyframes: each frame of an animation is the picture that a render of that frame alone is, with Persistent Data and without."""

import pytest

SIZE = 16


def stage():
    """A ball over a floor under a lamp and a sky, from above."""
    import bpy
    import scenes

    scene = scenes.lit_floor(samples=4, width=SIZE, height=SIZE)
    scene.camera.data.ortho_scale, scene.gonio.max_bounces = 4.0, 1
    scene.render.threads_mode, scene.render.threads = "FIXED", 2
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.3, 0.3, 0.3, 1.0)
    lamp = bpy.data.objects["Lamp"]
    lamp.location, lamp.data.shadow_soft_size = (1.5, 0.0, 3.0), 0.1
    ball("Ball")
    scene.frame_start, scene.frame_end = 1, 2
    return scene


def ball(name, location=(0.0, 0.0, 0.6)):
    """A ball of one grey."""
    import bpy
    import scenes

    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.6, segments=12, ring_count=6, location=location)
    bpy.context.object.name = name
    bpy.context.object.data.materials.append(scenes.diffuse(name, (0.6, 0.6, 0.6)))
    return bpy.context.object


def key(owner, path, values):
    """Keys a property, also one of a group in it or a custom one, at the frames 1 and 2."""
    import bpy

    group, _, name = path.rpartition(".")
    for frame, value in zip((1, 2), values, strict=True):
        if path.startswith("["):
            owner[path[2:-2]] = value
        else:
            setattr(owner.path_resolve(group) if group else owner, name, value)
        assert owner.keyframe_insert(path, frame=frame)
    bpy.context.scene.frame_set(1)


def read(path, name):
    """The last channel of a pass by name, red or the only one; names of channels have changed with the versions."""
    import scenes

    return next(pixels for channel, pixels in sorted(scenes.read(path).items(), reverse=True) if channel.startswith(f"ViewLayer.{name}."))


def frames_are_stills(tmp_path, build, name="Combined"):
    """Raises unless both frames of an animation are those rendered alone, and differ."""
    import numpy
    import scenes

    for persistent in (False, True):
        scene = build()
        scene.render.use_persistent_data = persistent
        scenes.render(tmp_path / "moving", animation=True)
        found = [read(tmp_path / f"moving{frame:04}.exr", name) for frame in (1, 2)]
        scene.render.use_persistent_data = False
        for frame, picture in zip((1, 2), found, strict=True):
            scene.frame_set(frame)
            scenes.render(tmp_path / "still.exr")
            assert numpy.array_equal(picture, read(tmp_path / "still.exr", name)), (persistent, frame)
        assert numpy.abs(found[0] - found[1]).max() > 0.01


@pytest.mark.blender
@pytest.mark.parametrize(
    ("name", "path", "values"),
    [
        ("Ball", "visible_camera", (True, False)),
        ("Ball", "visible_shadow", (True, False)),
        ("Floor", "visible_diffuse", (True, False)),
        ("Ball", "is_holdout", (False, True)),
        ("Floor", "is_shadow_catcher", (False, True)),
        ("Lamp", "visible_diffuse", (True, False)),
        ("Ball", "gonio.is_grid_only", (False, True)),
    ],
)
def test_switches_of_objects(tmp_path, name, path, values):
    import bpy

    def build():
        scene = stage()
        scene.render.film_transparent = True
        if path == "gonio.is_grid_only":
            bpy.data.objects[name].gonio.is_grid = True
        key(bpy.data.objects[name], path, values)
        return scene

    frames_are_stills(tmp_path, build)


@pytest.mark.blender
def test_holdouts_beside_a_collection_of_holdouts(tmp_path):
    import bpy

    def build():
        scene = stage()
        others = bpy.data.collections.new("Others")
        scene.collection.children.link(others)
        others.objects.link(ball("Other", (1.2, 1.2, 0.6)))
        scene.collection.objects.unlink(bpy.data.objects["Other"])
        bpy.context.view_layer.layer_collection.children["Others"].holdout = True
        key(bpy.data.objects["Ball"], "is_holdout", (True, False))
        return scene

    frames_are_stills(tmp_path, build)


def scattered():
    """The ball on two points by geometry nodes: what places it."""
    import bpy
    from recorder import link

    points = bpy.data.meshes.new("Points")
    points.from_pydata([(-1.0, 0.0, 0.5), (1.0, 0.0, 0.5)], [], [])
    holder, tree = link(bpy.data.objects.new("Holder", points)), bpy.data.node_groups.new("Scatter", "GeometryNodeTree")
    for side in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=side, socket_type="NodeSocketGeometry")
    names = ("NodeGroupInput", "GeometryNodeInstanceOnPoints", "NodeGroupOutput", "GeometryNodeObjectInfo")
    begin, scatter, end, info = (tree.nodes.new(name) for name in names)
    info.inputs["Object"].default_value, info.inputs["As Instance"].default_value = bpy.data.objects["Ball"], True
    tree.links.new(begin.outputs[0], scatter.inputs["Points"])
    tree.links.new(info.outputs["Geometry"], scatter.inputs["Instance"])
    tree.links.new(scatter.outputs[0], end.inputs[0])
    holder.modifiers.new("Scatter", "NODES").node_group = tree
    bpy.data.objects["Ball"].location.z = -5.0
    return holder


def sprinkled():
    """The ball on particles of a small plane: the particles' settings."""
    import bpy

    bpy.ops.mesh.primitive_plane_add(size=1.0, location=(0.0, 0.0, 0.8))
    emitter = bpy.context.object
    emitter.modifiers.new("Particles", "PARTICLE_SYSTEM")
    settings = emitter.particle_systems[0].settings
    settings.count, settings.frame_start, settings.frame_end, settings.lifetime = 3, 0.0, 0.0, 100.0
    settings.physics_type, settings.render_type, settings.instance_object = "NO", "OBJECT", bpy.data.objects["Ball"]
    settings.particle_size = 0.5
    bpy.data.objects["Ball"].location.z = -5.0
    return settings


def tint(name, kind):
    """Gives a material the colour that an attribute says."""
    import bpy

    tree = bpy.data.materials[name].node_tree
    node = tree.nodes.new("ShaderNodeAttribute")
    node.attribute_type, node.attribute_name = kind, "tint"
    tree.links.new(node.outputs["Fac"], tree.nodes["Diffuse BSDF"].inputs["Color"])


@pytest.mark.blender
@pytest.mark.parametrize("placed", ["scattered", "sprinkled"])
def test_properties_of_instancers(tmp_path, placed):
    def build():
        scene = stage()
        tint("Ball", "INSTANCER")
        key({"scattered": scattered, "sprinkled": sprinkled}[placed](), '["tint"]', (1.0, 0.1))
        return scene

    frames_are_stills(tmp_path, build)


@pytest.mark.blender
def test_switches_of_instancers(tmp_path):
    def build():
        scene = stage()
        key(scattered(), "visible_camera", (True, False))
        return scene

    frames_are_stills(tmp_path, build)


@pytest.mark.blender
def test_mist(tmp_path):
    import bpy

    def build():
        scene = stage()
        bpy.context.view_layer.use_pass_mist = True
        scene.world.mist_settings.depth = 6.0
        key(scene.world, "mist_settings.start", (0.0, 3.0))
        return scene

    frames_are_stills(tmp_path, build, "Mist")


@pytest.mark.blender
def test_properties_of_the_world(tmp_path):
    def build():
        scene = stage()
        tint("White", "VIEW_LAYER")
        key(scene.world, '["tint"]', (1.0, 0.1))
        return scene

    frames_are_stills(tmp_path, build)


@pytest.mark.blender
@pytest.mark.parametrize("values", [(True, False), (False, True)])
@pytest.mark.parametrize(("name", "switch"), [("Ball", "use_motion_blur"), ("Bender", "use_deform_motion"), ("Camera", "use_motion_blur")])
def test_switches_of_blur(tmp_path, name, switch, values):
    import bpy
    from keys import curves_of

    def build():
        scene = stage()
        scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1.0
        thing = bpy.data.objects[name] if name != "Bender" else ball("Bender", (0.0, 1.0, 0.6))
        if name == "Bender":
            thing.shape_key_add(name="Basis")
            bent = thing.shape_key_add(name="Bent")
            for point in bent.data:
                point.co.x += 1.0
            moving = (bent, "value", (0.0, 1.0))
        else:
            moving = (thing, "location", (thing.location.copy(), thing.location + thing.location.__class__((1.0, 0.0, 0.0))))
        key(*moving)
        for curve in curves_of(moving[0].id_data.animation_data.action):
            curve.extrapolation = "LINEAR"
            for point in curve.keyframe_points:
                point.interpolation = "LINEAR"
        key(thing, f"cycles.{switch}", values)
        return scene

    frames_are_stills(tmp_path, build)
