# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials that shine with what is to be baked of others, while they are baked."""

from collections.abc import Iterator
from contextlib import contextmanager

from gonio.graph import Graph

from ..export.material.closures import closure

# Parameters that say how rough a closure is, the first of those that it has.
ROUGHNESS = ("specular_roughness", "diffuse_roughness", "fuzz_roughness")
OCCLUSION_SAMPLES = 16
WHITE = {"Constant": [1.0] * 4}


def roughness(description: dict) -> dict:
    """Every closure shines with its roughness."""
    return {**description, "closures": [_rough(made) for made in description["closures"]]}


def _rough(made: dict) -> dict:
    parameters = dict(made["parameters"])
    found = next((parameters[name] for name in ROUGHNESS if name in parameters), {"Constant": [0.0] * 4})
    return {**closure(Graph(), "Emission"), "weight": made["weight"], "parameters": [["emission_color", found]]}


def occlusion(description: dict, distance: float) -> dict:
    """Shines where nothing is near."""
    # Nodes that displace stay.
    graph = Graph()
    graph.nodes += description["graph"]["nodes"] if description.get("displacement") else []
    fields = {"samples": OCCLUSION_SAMPLES, "inside": False, "only_local": False}
    share = graph.add({"Occlusion": fields}, graph.add("Normal", kind="VECTOR"), graph.scalar(distance), kind="VALUE")
    made = {"weight": WHITE, **closure(graph, "Emission", emission_color=share)}
    return {**description, "graph": {"nodes": graph.nodes}, "normal": None, "closures": [made], "shader_outputs": []}


@contextmanager
def standing_in(exporter, numbers, made) -> Iterator[None]:
    """Writes `made` of the materials of these numbers into the scene, and afterwards the materials themselves."""
    before = {number: exporter.material(number) for number in set(numbers)}
    try:
        for number, description in before.items():
            exporter.scene.put_material(made(description), index=number)
        yield
    finally:
        for number, description in before.items():
            exporter.scene.put_material(description, index=number)
