# SPDX-License-Identifier: GPL-3.0-or-later
"""Hair of particle systems and of hair curves, and point clouds, as arrays."""

from dataclasses import dataclass, field

import numpy as np

from .material.inputs import POSITION, STRAND, UV
from . import strand_normals
from .mesh_attributes import as_shader_value, part_of_attribute, read
from .random_number import of_word_arrays

# Radius where a data-block has none, as Cycles has it.
USUAL_RADIUS = {"CURVES": 0.005, "POINTCLOUD": 0.01}
# The attribute of hair curves that says where on the surface each is rooted.
ROOT_UV = "surface_uv_coordinate"


@dataclass
class Strands:
    """Curves through points (N, 3), so many points each, with radii (N,); values by name are of points or of curves."""

    points: np.ndarray
    counts: np.ndarray
    radii: np.ndarray
    values: dict = field(default_factory=dict)

    def without_short(self):
        """The curves of two points and more."""
        kept = self.counts > 1
        if kept.all():
            return self
        points = np.repeat(kept, self.counts)
        values = {name: each[kept if len(each) == len(kept) else points] for name, each in self.values.items()}
        return Strands(self.points[points], self.counts[kept], self.radii[points], values)


def systems(source, is_render):
    """The particle systems of an evaluated object whose hair is seen as strands, with their modifiers."""
    found = []
    for modifier in source.modifiers:
        if modifier.type == "PARTICLE_SYSTEM" and (modifier.show_render if is_render else modifier.show_viewport):
            settings = modifier.particle_system.settings
            if settings.type == "HAIR" and settings.render_type == "PATH":
                found.append((modifier, modifier.particle_system))
    return found


def of_system(source, modifier, system, is_render, wanted, first):
    """The hair of a particle system in the object's own space, None if there is none; `first` is how many strands were read before."""
    settings = system.settings
    own, children = len(system.particles), len(system.child_particles)
    if not is_render:
        children = int(children * settings.display_percentage / 100.0)
    begin = own if settings.child_type != "NONE" and children else 0
    steps = (1 << (settings.render_step if is_render else settings.display_step)) + 1
    if settings.kink == "SPIRAL":
        steps += settings.kink_extra_steps
    numbers = range(begin, own + children)
    if not numbers:
        return None
    place = system.co_hair
    flat = np.array([tuple(place(object=source, particle_no=n, step=k)) for n in numbers for k in range(steps)], dtype=np.float64)
    to_object = np.array(source.matrix_world.inverted_safe())
    keys = (flat @ to_object[:3, :3].T + to_object[:3, 3]).reshape(len(numbers), steps, 3)
    lengths = np.linalg.norm(np.diff(keys, axis=1), axis=2)
    # Keys that lie on the one before are none.
    kept = np.concatenate([np.ones((len(numbers), 1), dtype=bool), lengths > 0.0], axis=1)
    along = np.concatenate([np.zeros((len(numbers), 1)), np.cumsum(lengths, axis=1)], axis=1)
    shares = along / np.maximum(along[:, -1:], 1e-30)
    counts = kept.sum(axis=1).astype(np.int32)
    values = _of_emitter(source, modifier, system, numbers, own, wanted)
    radii = _radii(settings, shares, kept)
    strands = Strands(keys[kept].astype(np.float32), counts, radii[kept].astype(np.float32), values)
    return _with_facts(strands, wanted, first)


def _radii(settings, shares, kept):
    """Radii of keys by their share of the length; the last of each strand may be a point."""
    root, tip = (settings.radius_scale * 0.5 * end for end in (settings.root_radius, settings.tip_radius))
    shape, left = settings.shape, np.maximum(1.0 - shares, 0.0)
    if shape < 0.0:
        left = left ** (1.0 + shape)
    elif shape > 0.0:
        left = left ** (1.0 / max(1.0 - shape, 1e-6))
    radii = left * (root - tip) + tip
    if settings.use_close_tip:
        last = kept.shape[1] - 1 - np.argmax(kept[:, ::-1], axis=1)
        radii[np.arange(len(kept)), last] = 0.0
    return radii


def _of_emitter(source, modifier, system, numbers, own, wanted):
    """Texture coordinates and colours of the emitter's surface at each root; children ask by the first particle, as in Cycles."""
    mesh, particles, values = source.data, system.particles, {}
    layers = [(layer.name, number, layer.active_render) for number, layer in enumerate(getattr(mesh, "uv_layers", ()))]
    for name, number, is_active in layers:
        names = [each for each in ((UV,) if is_active else ()) + (name,) if each in wanted]
        if names:
            found = _at_roots(system.uv_on_emitter, modifier, particles, numbers, own, uv_no=number)
            values.update(dict.fromkeys(names, found[:, :2]))
    for number, layer in enumerate(getattr(mesh, "vertex_colors", ())):
        if layer.name in wanted:
            values[layer.name] = as_shader_value(_at_roots(system.mcol_on_emitter, modifier, particles, numbers, own, vcol_no=number))
    return values


def _at_roots(ask, modifier, particles, numbers, own, **layer):
    count = len(particles)
    if not count:
        return np.zeros((len(numbers), 3), dtype=np.float32)
    found = [tuple(ask(modifier, particle=particles[n if n < own else 0], particle_no=n, **layer)) for n in numbers]
    return np.array(found, dtype=np.float32)


def of_curves(curves, wanted):
    """What a hair curves data-block holds; None if it is empty."""
    count = len(curves.curves)
    offsets = np.zeros(count + 1, dtype=np.int32)
    if count:
        curves.curve_offset_data.foreach_get("value", offsets)
    points = np.empty((int(offsets[-1]), 3), dtype=np.float32)
    if not len(points):
        return None
    curves.position_data.foreach_get("vector", points.reshape(-1))
    values = _attributes(curves, wanted)
    if UV in wanted and (root := curves.attributes.get(ROOT_UV)) is not None:
        values[UV] = read(root)[:, :2].astype(np.float32)
    if POSITION in wanted:
        values[POSITION] = points
    if STRAND["Normal"] in wanted:
        begins, ends = offsets[:-1], offsets[1:]
        values[STRAND["Normal"]] = strand_normals.of_curves(curves, _tangents(points, begins, ends), begins, ends)
    strands = Strands(points, np.diff(offsets).astype(np.int32), _radius(curves, len(points), "CURVES"), values)
    return _with_facts(strands, wanted, 0)


def of_points(cloud, wanted):
    """Positions (N, 3), radii (N,) and values by name of a point cloud; None if it is empty."""
    points = np.empty((len(cloud.points), 3), dtype=np.float32)
    position = cloud.attributes.get("position")
    if not len(points) or position is None:
        return None
    position.data.foreach_get("vector", points.reshape(-1))
    values = _attributes(cloud, wanted)
    if POSITION in wanted:
        values[POSITION] = points
    return points, _radius(cloud, len(points), "POINTCLOUD"), values


def _radius(data, count, kind):
    attribute = data.attributes.get("radius")
    if attribute is None or attribute.domain != "POINT":
        return np.full(count, USUAL_RADIUS[kind], dtype=np.float32)
    return np.ascontiguousarray(read(attribute)[:, 0], dtype=np.float32)


def _attributes(data, wanted):
    """The attributes that materials ask for, one value a point or a curve."""
    found = {}
    for name in wanted:
        values = part_of_attribute(data.attributes, name)
        if values is not None:
            found[name] = as_shader_value(values)
    return found


def _with_facts(strands, wanted, first):
    """What the Curves Info node knows of each strand, as far as materials ask for it."""
    strands = strands.without_short()
    if not len(strands.counts):
        return None
    ends = np.cumsum(strands.counts)
    begins = ends - strands.counts
    # As long as the points, in double precision: only where somebody asks.
    asked = STRAND["Intercept"] in wanted or STRAND["Length"] in wanted
    along, lengths = _along(strands, begins, ends) if asked else (None, None)
    facts = {
        "Is Strand": lambda: np.ones(len(ends)),
        "Intercept": lambda: along / np.maximum(np.repeat(lengths, strands.counts), 1e-30),
        "Length": lambda: lengths,
        "Thickness": lambda: strands.radii * 2.0,
        "Random": lambda: of_word_arrays(first + np.arange(len(ends), dtype=np.uint32)) / 0xFFFFFFFF,
    }
    for name, fact in facts.items():
        if STRAND[name] in wanted:
            strands.values[STRAND[name]] = fact().astype(np.float32)[:, None]
    if STRAND["Tangent"] in wanted:
        strands.values[STRAND["Tangent"]] = _tangents(strands.points, begins, ends)
    return strands


def _along(strands, begins, ends):
    """How far along its strand each point lies, and the length of each strand."""
    steps = np.linalg.norm(np.diff(strands.points.astype(np.float64), axis=0, prepend=strands.points[:1]), axis=1)
    steps[begins] = 0.0
    along = np.cumsum(steps)
    along -= np.repeat(along[begins], strands.counts)
    return along, along[ends - 1]


def _tangents(points, begins, ends):
    """Differences of the points about each, those of the ends to one side."""
    before, after = np.arange(len(points)) - 1, np.arange(len(points)) + 1
    before[begins], after[ends - 1] = begins, ends - 1
    return np.ascontiguousarray(points[after] - points[before], dtype=np.float32)
