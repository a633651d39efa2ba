"""Small OpenVDB files, written here after the format (version 224, active masks, nothing packed)."""

import struct

import numpy as np

EDGE = 8


def text(value):
    return struct.pack("<I", len(value)) + value.encode()


def mask(bits):
    return np.packbits(np.asarray(bits, bool), bitorder="little").tobytes()


def tree(values, at):
    """Nodes and voxels of an array (nx, ny, nz) or (nx, ny, nz, 3) whose least voxel is at whole coordinates from 0; what is 0 is not active."""
    size = [-(-(first + n) // EDGE) for first, n in zip(at, values.shape)]
    assert max(size) <= 16, "one node of 128³ voxels"
    whole = np.zeros([EDGE * n for n in size] + list(values.shape[3:]), np.float32)
    whole[tuple(slice(first, first + n) for first, n in zip(at, values.shape))] = values
    below, bricks = np.zeros(16**3, bool), []
    for x, y, z in np.ndindex(*size):
        voxels = whole[EDGE * x :, EDGE * y :, EDGE * z :][:EDGE, :EDGE, :EDGE].reshape(512, -1)
        active = (voxels != 0).any(1)
        if active.any():
            below[256 * x + 16 * y + z] = True
            bricks.append((mask(active), voxels[active].tobytes()))
    root = np.zeros(32**3, bool)
    root[0] = bool(bricks)
    background = struct.pack("<f", 0) * (values.shape[3] if values.ndim == 4 else 1)
    if not bricks:
        return struct.pack("<I", 1) + background + struct.pack("<II", 0, 0), b""
    # A node: which places have children, which are active tiles, and that inactive values are not stored.
    upper = mask(root) + mask(np.zeros(32**3)) + b"\0"
    lower = mask(below) + mask(np.zeros(16**3)) + b"\0" + b"".join(active for active, _ in bricks)
    topology = struct.pack("<I", 1) + background + struct.pack("<II", 0, 1) + struct.pack("<iii", 0, 0, 0) + upper + lower
    return topology, b"".join(active + b"\0" + voxels for active, voxels in bricks)


def grid(name, values, at, voxel, shift, kind, unique):
    entries = {"name": name, "class": kind}
    metadata = struct.pack("<I", len(entries)) + b"".join(text(key) + text("string") + text(value) for key, value in entries.items())
    matrix = np.diag([voxel, voxel, voxel, 1.0])
    matrix[3, :3] = shift
    head = struct.pack("<I", 2) + metadata + text("AffineMap") + matrix.tobytes()
    topology, voxels = tree(np.asarray(values, np.float32), at)
    front = text(unique) + text(f"Tree_{'vec3s' if np.ndim(values) == 4 else 'float'}_5_4_3") + text("")
    return front, head + topology, voxels


def write(path, *grids, at=(0, 0, 0), voxel=1.0, shift=(0, 0, 0), kind="fog volume"):
    """Writes grids, each a name and its array; several of one name are told apart as OpenVDB does. `voxel` is their edge, `shift` the place of
    voxel 0, 0, 0."""
    data = b" BDV\0\0\0\0" + struct.pack("<III?", 224, 12, 0, True) + b"0" * 36 + struct.pack("<II", 0, len(grids))
    names = [name for name, _ in grids]
    for number, (name, values) in enumerate(grids):
        unique = name if names.count(name) == 1 else f"{name}\x1e{names[:number].count(name)}"
        front, head, voxels = grid(name, values, at, voxel, shift, kind, unique)
        start = len(data) + len(front) + 24
        places = struct.pack("<qqq", start, start + len(head), start + len(head) + len(voxels))
        data += front + places + head + voxels
    path.write_bytes(data)
    return path
