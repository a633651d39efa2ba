"""A scene that only remembers what the exporter told it, and the exporter that talks to it."""

import importlib
import sys
from pathlib import Path

import numpy as np

EXTENSION = "gonio_extension"


class WrongCall(BaseException):
    """A call that the scene would not have taken; no guard of the exporter catches it."""


def check(holds, *what):
    """Raises `WrongCall` unless something holds."""
    if not holds:
        raise WrongCall(*what)


class Recorder:
    """Has the methods of `gonio.Scene` that the exporter calls, and its checks of shapes and numbers."""

    def __init__(self):
        self.meshes, self.instances, self.materials, self.textures, self.lights, self.cameras, self.measured = ([] for _ in range(7))
        self.curves, self.points, self.fields = [], [], []
        self.settings, self.calls, self.atmosphere = {}, [], {}

    def _put(self, what, thing, index):
        things = getattr(self, what)
        self.calls.append(what)
        if index is None:
            things.append(thing)
            return len(things) - 1
        check(0 <= index < len(things), what, index, len(things))
        things[index] = thing
        return index

    def put_atmosphere(self, description):
        self.atmosphere = description

    def put_mesh(self, points, triangles, *, corners=None, faces=None, normals=None, primvars=None, slots=None, name="mesh", index=None, ahead=False):
        arrays = {"points": points, "triangles": triangles, "corners": corners, "faces": faces, "normals": normals, "slots": slots}
        for key, array in {**arrays, **(primvars or {})}.items():
            check(array is None or (array.flags.c_contiguous and array.dtype in (np.float32, np.int32)), key)
        return self._put("meshes", {**arrays, "primvars": primvars or {}, "name": name}, index)

    def set_dicing(self, mesh, **fields):
        check(0 <= mesh < len(self.meshes), mesh)
        self.meshes[mesh]["dicing"] = fields

    def put_curves(self, points, counts, widths, *, index=None, **fields):
        check(counts.sum() == len(points), fields["name"])
        return self._put_fibres("curves", points, widths, {**fields, "counts": counts}, index)

    def put_points(self, points, widths, *, index=None, **fields):
        return self._put_fibres("points", points, widths, fields, index)

    def _put_fibres(self, what, points, widths, fields, index):
        check(points.shape[1:] == (3,) and np.size(widths) in (1, len(points)), fields["name"])
        return self._put(what, {**fields, "points": points, "widths": widths}, index)

    def put_instances(
        self,
        mesh,
        materials,
        transforms,
        *,
        name,
        visibility=None,
        primvars=None,
        pass_index=0,
        light_group="",
        linking=None,
        asset="",
        shadow_terminator=0.0,
        motion=None,
        index=None,
        **fibres,
    ):
        check(transforms.shape[1:] == (4, 4) and transforms.flags.c_contiguous and np.isfinite(transforms).all(), name)
        check(motion is None or (motion.shape[1:] == transforms.shape and motion.flags.c_contiguous), name)
        check(
            (0 <= mesh < len(self.meshes) if mesh is not None else self._has(**fibres))
            and all(0 <= m < len(self.materials) for m in materials),
            name,
        )
        fields = {"mesh": mesh, "materials": materials, "transforms": transforms, "name": name, "visibility": visibility}
        given = {"primvars": primvars or {}, "pass_index": pass_index, "light_group": light_group, "linking": linking, "asset": asset}
        given["shadow_terminator"] = shadow_terminator
        return self._put("instances", {**fields, **given, "motion": motion, **fibres}, index)

    def _has(self, **fibres):
        """Whether curves or points of one number are there."""
        return len(fibres) == 1 and all(0 <= number < len(getattr(self, kind)) for kind, number in fibres.items())

    def put_material(self, description, index=None):
        return self._put("materials", description, index)

    def put_texture(self, description, index=None, *, data=None, pixels=None):
        return self._put("textures", {**description, "data": data, "pixels": pixels}, index)

    def put_measured(self, measured, *, name, index=None):
        return self._put("measured", {"measured": measured, "name": name}, index)

    def put_field(self, description, index=None, *, density, heat=None, **colours):
        for source in (density, heat):
            check(isinstance(source, tuple) or source is None or (source.ndim == 3 and source.dtype == np.float32), description)
            check(not isinstance(source, tuple) or Path(source[0]).is_file(), source)
        for name, array in colours.items():
            check(array.shape == (*density.shape, {"taken": 6, "sent": 3}[name]) and array.dtype == np.float32, description)
        return self._put("fields", {**description, "density": density, "heat": heat, **colours}, index)

    def put_field_box(self, field, index=None):
        """The box of nothing, at the place of the field's array."""
        check(0 <= field < len(self.fields), field)
        place = np.eye(4)
        place[:3] = np.array(self.fields[field]["to_world"]["columns"]).T
        return self._put("meshes", {"field": field, "name": "box"}, index), place.tolist()

    def put_light(self, description, index=None):
        return self._put("lights", description, index)

    def put_camera(self, description, index=None):
        return self._put("cameras", description, index)

    def truncate(self, kind, n):
        del getattr(self, kind)[n:]

    def set(self, **settings):
        self.settings.update(settings)


def module(name):
    """A module of the extension."""
    return importlib.import_module(f"{EXTENSION}.{name}")


def exporter():
    """An exporter whose scene is a recorder, and its report."""
    export, report = module("export"), module("report").Report()
    real = sys.modules["gonio"].Scene
    sys.modules["gonio"].Scene = Recorder
    try:
        return export.Exporter(report), report
    finally:
        sys.modules["gonio"].Scene = real


def depsgraph():
    """The evaluated depsgraph of the open file."""
    import bpy

    bpy.context.view_layer.update()
    return bpy.context.evaluated_depsgraph_get()


def empty():
    """An empty file."""
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)


def link(thing):
    """Puts an object into the open scene."""
    import bpy

    bpy.context.scene.collection.objects.link(thing)
    return thing


def quad(name="Quad"):
    """A unit square with one UV map."""
    import bpy

    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [], [(0, 1, 2, 3)])
    mesh.uv_layers.new(name="Map").uv.foreach_set("vector", [0, 0, 1, 0, 1, 1, 0, 1])
    return mesh


def scattered(mesh):
    """Puts a mesh on each of 142 × 142 points by geometry nodes."""
    import bpy

    points = bpy.data.meshes.new("Points")
    points.from_pydata([(x - 71, y - 71, 0) for x in range(142) for y in range(142)], [], [])
    field, thing = link(bpy.data.objects.new("Field", points)), link(bpy.data.objects.new("Thing", mesh))
    tree = bpy.data.node_groups.new("Scatter", "GeometryNodeTree")
    tree.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
    tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    start, stop = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    scatter, chosen = tree.nodes.new("GeometryNodeInstanceOnPoints"), tree.nodes.new("GeometryNodeObjectInfo")
    chosen.inputs["Object"].default_value, chosen.inputs["As Instance"].default_value = thing, True
    tree.links.new(start.outputs[0], scatter.inputs["Points"])
    tree.links.new(chosen.outputs["Geometry"], scatter.inputs["Instance"])
    tree.links.new(scatter.outputs[0], stop.inputs[0])
    field.modifiers.new("Scatter", "NODES").node_group = tree


def material(name="Material"):
    """A material whose tree holds an output alone: the material, its tree and the output node."""
    import bpy

    made = bpy.data.materials.new(name)
    if bpy.app.version < (5, 0, 0):
        made.use_nodes = True
    made.node_tree.nodes.clear()
    return made, made.node_tree, made.node_tree.nodes.new("ShaderNodeOutputMaterial")


def translated(made):
    """A material's description and the lines of the report."""
    report = module("report").Report()
    scene, slots = Recorder(), module("export.slots").Slots
    images, measurements = module("export.images").Images(scene, slots()), module("export.measured").Measurements(scene, slots())
    return module("export.material").translate(made, images, measurements, report).description, [line.text for line in report.diagnostics]


def evaluated(description, source, primvars):
    """The value of a description's input, by the renderer's kernels; primvars by name."""
    from gonio.graph import compute

    results = []

    def read(entry):
        if "Constant" in entry:
            return np.array(entry["Constant"])
        value, channel = results[entry["Node"][0]], entry["Node"][1]
        return value if channel == "Rgb" else np.full(4, value["RGBA".index(channel)])

    for node in description["graph"]["nodes"]:
        operation = node["operation"]
        if isinstance(operation, dict) and "Primvar" in operation:
            results.append(np.array(primvars[operation["Primvar"]["name"]]))
        else:
            inputs = [np.asarray(read(entry), dtype=np.float32) for entry in node["inputs"]]
            results.append(np.asarray(compute(operation, inputs))[0])
    return read(source)


def constant(closure, name):
    """A closure's constant parameter."""
    return dict(closure["parameters"])[name]["Constant"]
