"""Volume files by OpenVDB's own library, which comes with Blender, against gonio's reader and writer, voxel by voxel."""

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]

LIBRARY = """
import glob, importlib.util, json, os, sys
import numpy as np
# Beside Blender's own files, where only Blender itself looks.
folder = os.path.dirname(importlib.util.find_spec("bpy").origin)
sys.path += glob.glob(folder + "/*/python/lib/python3*/site-packages")
try:
    import openvdb
except ImportError:
    sys.exit(3)
"""

MAKE = LIBRARY + """
folder = sys.argv[1]
random = np.random.default_rng(7)
x, y, z = np.meshgrid(*(np.arange(n, dtype=np.float32) for n in (70, 45, 91)), indexing="ij")
cloud = np.maximum(0, np.sin(x / 7) * np.cos(y / 5) + np.sin(z / 9) - 0.3 + 0.1 * random.random(x.shape, dtype=np.float32)).astype(np.float32)
# Some leaves of one value, which become tiles.
cloud[16:40, 8:32, 24:56] = 0.75

def filled(kind, values, name, ijk, half=False, fog=True):
    grid = kind()
    grid.copyFromArray(values, ijk=ijk)
    grid.name, grid.saveFloatAsHalf = name, half
    if fog:
        grid.gridClass = openvdb.GridClass.FOG_VOLUME
    grid.transform = openvdb.createLinearTransform([[0.5, 0, 0.1, 0], [0, 0.25, 0, 0], [-0.1, 0, 0.5, 0], [1, -2, 3, 1]])
    return grid

vector = np.stack([cloud, -cloud, 2 * cloud], axis=-1)
sphere = openvdb.createLevelSetSphere(radius=9.0, center=(1, 2, 3), voxelSize=0.5)
sphere.name = "sphere"
grids = [
    sphere,
    filled(openvdb.FloatGrid, cloud, "density", (-20, 5, -4100)),
    filled(openvdb.FloatGrid, cloud, "half", (3, 5, 7), half=True),
    filled(openvdb.Vec3SGrid, vector, "velocity", (-1, -2, -3), fog=False),
]
for name in ("DoubleGrid", "Int32Grid", "BoolGrid"):
    if hasattr(openvdb, name):
        values = {"DoubleGrid": cloud.astype(float), "Int32Grid": (cloud * 100).astype(np.int32), "BoolGrid": cloud > 0.5}[name]
        grids.append(filled(getattr(openvdb, name), values, name, (0, 0, 0)))
openvdb.write(folder + "/made.vdb", grids=grids, metadata={"creator": "a test"})
"""

COMPARE = LIBRARY + """
path, folder = sys.argv[1:]
result = []
for found in openvdb.readAllGridMetadata(path):
    grid = openvdb.read(path, found.name)
    low, high = grid.evalActiveVoxelBoundingBox()
    shape = [b - a + 1 for a, b in zip(low, high)]
    kind = type(grid).__name__
    vector = kind.startswith("Vec3")
    values = np.zeros((*shape, 3) if vector else shape, np.float32)
    grid.copyToArray(values, ijk=low)
    values.astype("<f4").tofile(f"{folder}/{found.name}.raw")
    corners = [list(grid.transform.indexToWorld(point)) for point in ((0, 0, 0), (1, 2, 3))]
    result.append([kind, found.name, [*low, *high], grid.activeVoxelCount(), corners])
print("RESULT" + json.dumps(result))
"""


@pytest.fixture(scope="module")
def voxels():
    """The program that reads and writes for the test."""
    if shutil.which("cargo") is None:
        pytest.skip("no cargo, which builds the program that is compared")
    command = ["cargo", "build", "--profile", "quick", "--quiet", "-p", "gonio-volume", "--example", "voxels"]
    subprocess.run(command, cwd=ROOT, check=True)
    return ROOT / "target/quick/examples/voxels"


def blender(python, script, *arguments):
    done = subprocess.run([python, "-c", script, *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode == 3:
        pytest.skip("this Blender brings no openvdb module")
    assert done.returncode == 0, done.stderr
    return done.stdout


def compare(voxels, blender_python, path, folder):
    """All grids of a file, by both readers."""
    folder.mkdir()
    told = json.loads(blender(blender_python, COMPARE, path, folder).partition("RESULT")[2])
    for kind, name, bounds, active, _ in told:
        out = folder / "ours.raw"
        done = subprocess.run([voxels, "dense", path, name, out], capture_output=True, text=True, check=True)
        *ours, components = map(int, done.stdout.split())
        assert ours == [*bounds, active], name
        assert components == (3 if kind.startswith("Vec3") else 1), name
        np.testing.assert_array_equal(np.fromfile(out, "<f4"), np.fromfile(folder / f"{name}.raw", "<f4"), err_msg=name)
    return told


def test_files_of_openvdb_are_read_voxel_by_voxel(voxels, blender_python, tmp_path):
    blender(blender_python, MAKE, tmp_path)
    kinds = [kind for kind, *_ in compare(voxels, blender_python, tmp_path / "made.vdb", tmp_path / "read")]
    assert {"FloatGrid", "Vec3SGrid"} <= set(kinds)


@pytest.mark.parametrize("packing", ["none", "zip"])
def test_files_of_gonio_are_read_by_openvdb(voxels, blender_python, tmp_path, packing):
    blender(blender_python, MAKE, tmp_path)
    subprocess.run([voxels, "copy", tmp_path / "made.vdb", packing, tmp_path / "copy.vdb"], check=True)
    made = compare(voxels, blender_python, tmp_path / "made.vdb", tmp_path / "first")
    copied = compare(voxels, blender_python, tmp_path / "copy.vdb", tmp_path / "second")
    # Voxels, bounds and transforms; wider types become single precision.
    assert [each[1:] for each in made] == [each[1:] for each in copied]
