"""What a graph of nodes adds to the time of a render, in Cycles and in Gonio: `python graph_cost.py [--scene tiles] [--rounds 5]`.

The same scene with its graph and with constants in the graph's place, both engines in one process by turns, the same samples and threads.
Seconds of the processor are printed beside those of the clock, because they hardly see what else the machine does.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ENGINES = ("CYCLES", "GONIO")
CHILD = Path(__file__).resolve().parents[1] / "child.py"
SUITE = Path(__file__).resolve().parents[2]
RESULT = "cost.json"
# The requirement: what the graph adds in Gonio as a share of what it adds in Cycles.
MOST = 0.5


def cost(theme: str, scene: str, rounds: int, samples: int, threads: int, tmp_path: Path) -> None:
    """For `child.py`: writes the seconds, of the clock and of the processor, of each engine with and without the graph; and the nodes."""
    import bpy
    import render

    found: dict[str, list] = {f"{engine} {form}": [] for engine in ENGINES for form in ("constant", "graph")}
    for _ in range(rounds):
        for form in ("constant", "graph"):
            render.build(theme, scene, samples)
            nodes = max(count(material.node_tree) for material in bpy.data.materials)
            if form == "constant":
                for material in bpy.data.materials:
                    make_constant(material.node_tree)
            bpy.context.scene.render.threads_mode, bpy.context.scene.render.threads = "FIXED", threads
            for engine in ENGINES:
                start = time.monotonic(), time.process_time()
                render.rendered(engine, tmp_path / "cost.exr")
                found[f"{engine} {form}"].append((time.monotonic() - start[0], time.process_time() - start[1]))
    (tmp_path / RESULT).write_text(json.dumps({"nodes": nodes, "seconds": found}))


def count(tree) -> int:
    """The nodes of a tree and of its groups, the ends of groups aside."""
    ends = ("NodeGroupInput", "NodeGroupOutput", "NodeReroute")
    return sum(count(node.node_tree) if node.type == "GROUP" else node.bl_idname not in ends for node in tree.nodes)


def make_constant(tree) -> None:
    """Cuts everything but shaders off a material, and gives its colours a grey."""
    for link in list(tree.links):
        if link.to_node.bl_idname == "ShaderNodeOutputMaterial" and link.to_socket.name != "Surface":
            tree.links.remove(link)
        elif link.to_socket.type != "SHADER" and any(output.type == "SHADER" for output in link.to_node.outputs):
            target = link.to_socket
            tree.links.remove(link)
            if target.type == "RGBA":
                target.default_value = (0.25, 0.25, 0.25, 1.0)


def main() -> int:
    """Prints the increments and their ratio; 1 if the ratio is above what is allowed."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--theme", default="building")
    parser.add_argument("--scene", default="tiles")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--threads", type=int, default=1)
    asked = parser.parse_args()
    python = os.environ.get("GONIO_BPY", str(SUITE.parent / ".venv-bpy50" / "bin" / "python")).split(":")[-1]
    with tempfile.TemporaryDirectory() as folder:
        request = json.dumps([__file__, "cost", {**vars(asked), "tmp_path": folder}])
        # The suite's own modules are beside this file and beside `child.py`.
        path = os.pathsep.join([str(CHILD.parent), os.environ.get("PYTHONPATH", "")])
        environment = {**os.environ, "PYTHONPATH": path}
        subprocess.run([python, str(CHILD)], input=request, text=True, check=True, stdout=subprocess.DEVNULL, env=environment)
        found = json.loads((Path(folder) / RESULT).read_text())
    print(f"{asked.scene}, {found['nodes']} nodes, {asked.samples} samples, {asked.threads} threads, load {os.getloadavg()[0]:.1f}")
    ratios = [told(kind, [[each[number] for each in found["seconds"][key]] for key in found["seconds"]]) for number, kind in KINDS]
    return 0 if max(ratios) <= MOST else 1


KINDS = ((0, "clock"), (1, "processor"))


def told(kind: str, columns: list[list[float]]) -> float:
    """Prints one kind of seconds: medians with a constant and with the graph, their difference, and the ratio, which it returns."""
    medians = [statistics.median(column) for column in columns]
    added = {}
    for number, engine in enumerate(ENGINES):
        constant, graph = medians[2 * number : 2 * number + 2]
        added[engine] = graph - constant
        print(f"{kind:>9} {engine:6} constant {constant:7.2f} s, graph {graph:7.2f} s, added {added[engine]:7.2f} s")
    ratio = added["GONIO"] / added["CYCLES"]
    print(f"{kind:>9} Gonio adds {ratio:.2f} of what Cycles adds; allowed {MOST:.2f}")
    return ratio


if __name__ == "__main__":
    sys.exit(main())
