# SPDX-License-Identifier: GPL-3.0-or-later
"""What particles and instancing faces give the instances that they show, as Cycles has it."""

import numpy as np

from .instancer import NO_LEVEL
from .material.inputs import GIVEN, GIVEN_GENERATED, GIVEN_UV, PARTICLE
from .random_number import of_words

# What each output of Particle Info is of a particle, the frame, and the particle's number.
OUTPUTS = {
    "Index": lambda particle, frame, number: number,
    "Random": lambda particle, frame, number: random(number),
    "Age": lambda particle, frame, number: frame - particle.birth_time,
    "Lifetime": lambda particle, frame, number: particle.lifetime,
    "Location": lambda particle, frame, number: particle.location,
    "Size": lambda particle, frame, number: particle.size,
    "Velocity": lambda particle, frame, number: particle.velocity,
    "Angular Velocity": lambda particle, frame, number: particle.angular_velocity,
}


def random(number):
    """A particle's random number, 0 to 1."""
    return of_words(number, 0) / 0xFFFFFFFF


def is_given(name):
    """Whether a value is one that instances are given."""
    return name.startswith(GIVEN)


def fill_given(depsgraph, groups, wanted):
    """Adds to groups the values that materials want of what made the instances: `wanted` are sets of names, one for each group."""
    if not groups:
        return
    frame, rows = depsgraph.scene_eval.frame_current_final, {row for group in groups for row in group.rows}
    names = {name for each in wanted for name in each if is_given(name)}
    by_row = {}
    for row, item in enumerate(depsgraph.object_instances):
        if row in rows and item.is_instance:
            by_row[row] = {name: _vector(_value(item, name, frame)) for name in names}
    nothing = {name: _vector(_nothing(name)) for name in names}
    for group, each in zip(groups, wanted, strict=True):
        for name in names & each:
            group.instancer[name] = np.array([by_row.get(row, nothing)[name] for row in group.rows], dtype=np.float32)


def _value(item, name, frame):
    if name == GIVEN_GENERATED:
        return [0.5 * x - 0.5 for x in item.orco]
    if name == GIVEN_UV:
        return [*item.uv, 0.0]
    system, number = item.particle_system, item.persistent_id[0]
    # Children have no place of their own.
    if system is None or number == NO_LEVEL or number >= len(system.particles):
        return _nothing(name)
    return OUTPUTS[name.removeprefix(PARTICLE)](system.particles[number], frame, number)


def _nothing(name):
    return random(0) if name == f"{PARTICLE}Random" else 0.0


def _vector(value):
    return [*value] if hasattr(value, "__len__") else [float(value)] * 3
