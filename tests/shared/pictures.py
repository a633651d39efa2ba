"""EXR files as arrays, and small stages to render."""

import dataclasses
import struct
import zlib

import numpy as np
import OpenEXR

HEADER = '#usda 1.0\n(\n    metersPerUnit = {metres}\n    upAxis = "{up}"\n)\n'

# A box with a ball on a floor, a lamp, and a camera that looks down on them: shadows, colours, and points without a surface behind them.
ROOM = """
def Mesh "Floor" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-3, 0, 3), (3, 0, 3), (3, 0, -3), (-3, 0, -3)]
    uniform token subdivisionScheme = "none"
    rel material:binding = </Looks/Grey>
}
def Cube "Box" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    double size = 1
    rel material:binding = </Looks/Red>
    double3 xformOp:translate = (-0.8, 0.5, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Sphere "Ball" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    double radius = 0.6
    rel material:binding = </Looks/Grey>
    double3 xformOp:translate = (0.9, 0.6, 0.3)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Scope "Looks"
{
    def Material "Grey"
    {
        token outputs:surface.connect = </Looks/Grey/S.outputs:surface>
        def Shader "S"
        {
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor = (0.5, 0.5, 0.5)
            float inputs:roughness = 1
            token outputs:surface
        }
    }
    def Material "Red"
    {
        token outputs:surface.connect = </Looks/Red/S.outputs:surface>
        def Shader "S"
        {
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor = (0.7, 0.1, 0.1)
            float inputs:roughness = 1
            token outputs:surface
        }
    }
}
"""

LAMP = """
def SphereLight "Lamp"
{
    float inputs:intensity = 400
    float inputs:radius = 0.2
    double3 xformOp:translate = (1, 3, 1)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""

CAMERA = """
def Camera "{name}"
{{
    float focalLength = 30
    float horizontalAperture = 20
    float verticalAperture = 20
    double3 xformOp:translate = ({x}, 4, 6)
    double3 xformOp:rotateXYZ = (-32, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
}}
"""

# A lamp whose strength changes from frame to frame.
MOVING = """
def SphereLight "Lamp"
{
    float inputs:intensity.timeSamples = { 1: 100, 2: 200, 3: 400 }
    float inputs:radius = 0.2
    double3 xformOp:translate = (1, 3, 1)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""

# A mesh with a corner that there is not.
BROKEN = 'def Mesh "Broken"\n{\n    int[] faceVertexCounts = [3]\n    int[] faceVertexIndices = [0, 1, 9]\n    point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\n}\n'


# A ball of clear glass on the floor, between lamp and camera.
GLASS = """
def Sphere "Lens" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    double radius = 0.5
    rel material:binding = </Glass>
    double3 xformOp:translate = (0.2, 0.8, 1.4)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Material "Glass"
{
    token outputs:surface.connect = </Glass/S.outputs:surface>
    def Shader "S"
    {
        uniform token info:id = "ND_open_pbr_surface_surfaceshader"
        float inputs:transmission_weight = 1
        float inputs:specular_roughness = 0
        token outputs:surface
    }
}
"""


def camera(name="Cam", x=0):
    """A camera in front of the room."""
    return CAMERA.format(name=name, x=x)


def stage(path, *parts, metres=1, up="Y"):
    """Writes a stage made of these texts; gives its path."""
    path.write_text(HEADER.format(metres=metres, up=up) + "".join(parts))
    return path


def room(path, **options):
    """Writes the room with its lamp and one camera; gives its path."""
    return stage(path, ROOM, LAMP, camera(), **options)


def room_with_glass(path, **options):
    """The same with a ball of glass, which throws a caustic."""
    return stage(path, ROOM, GLASS, LAMP, camera(), **options)


@dataclasses.dataclass
class Picture:
    """Channels by name, rows from the top; and the header."""

    channels: dict
    header: dict

    def __getitem__(self, name):
        return self.channels[name]

    @property
    def shape(self):
        return next(iter(self.channels.values())).shape

    @property
    def rgb(self):
        return np.stack([self.channels[name] for name in "RGB"], axis=-1).astype(float)


def read(path):
    """An EXR file."""
    file = OpenEXR.File(str(path), separate_channels=True)
    channels = {name: np.array(channel.pixels) for name, channel in file.channels().items()}
    return Picture(channels, dict(file.header()))


def same(first, second):
    """Whether all channels are equal to the bit."""
    return first.channels.keys() == second.channels.keys() and all(
        np.array_equal(first[name], second[name], equal_nan=True) for name in first.channels
    )


def write_png(path, pixels):
    """Bytes (height, width, channels) as a PNG file: one channel is grey, three are colours, the fourth is alpha. Gives its path."""
    pixels = np.asarray(pixels, dtype="u1")
    height, width, channels = pixels.shape

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", width, height, 8, {1: 0, 3: 2, 4: 6}[channels], 0, 0, 0)
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
    return path


def png_size(path):
    """Width and height of a PNG file."""
    head = path.read_bytes()[:24]
    assert head[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", head[16:24])


def blocks(image, size):
    """Means of square blocks; what does not fill a block is left out."""
    height, width = (side // size * size for side in image.shape[:2])
    kept = image[:height, :width]
    return kept.reshape(height // size, size, width // size, size, -1).mean(axis=(1, 3))


def difference(first, second, size=8):
    """Mean difference of the blocks of two colour pictures, as a share of the mean."""
    a, b = blocks(first.rgb, size), blocks(second.rgb, size)
    return float(np.abs(a - b).mean() / max(np.abs(a).mean(), np.abs(b).mean(), 1e-30))
