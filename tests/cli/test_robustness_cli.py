"""Bad files, absurd values and interruptions: one clear line or a picture with a warning, never a traceback, a hang or a broken file."""

import random
import resource
import signal
import struct
import subprocess
import time
import zlib

import numpy as np
import OpenEXR
import pictures
import pytest

BOX = """
def Mesh "{name}"
{{
    int[] faceVertexCounts = {counts}
    int[] faceVertexIndices = {indices}
    point3f[] points = {points}
    uniform token subdivisionScheme = "none"
{more}
}}
"""
SQUARE = {"counts": "[4]", "indices": "[0, 1, 2, 3]", "points": "[(-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)]", "more": ""}
BAD_WORDS = ("Traceback", "panicked", "thread '", "RUST_BACKTRACE", "pxr/", "/usr/src", "Boost", "Segmentation")


def mesh(name="Odd", **changes):
    return BOX.format(name=name, **{**SQUARE, **changes})


def render(run, stage, folder, *options):
    return run("render", stage, "-o", folder / "out.exr", "--res", 16, 16, "--spp", 1, "--time-limit", 20, *options, timeout=60)


def judge(done, folder):
    """Asserts what every run must fulfil; gives whether there is a picture."""
    assert not any(word in done.stderr for word in BAD_WORDS), done.stderr
    if done.returncode == 0:
        image = pictures.read(folder / "out.exr")
        for name, values in image.channels.items():
            assert np.isfinite(values).all() or name == "depth.Z", f"{name} has values that are no numbers"
        return True
    assert done.returncode == 1, (done.returncode, done.stderr)
    errors = [line for line in done.stderr.splitlines() if line.startswith("gonio: error: ")]
    # The USD library itself writes of a failed madvise, past all its own handlers.
    others = [line for line in done.stderr.splitlines() if not line.startswith("gonio: ") and "posix_madvise" not in line]
    assert len(errors) == 1 and not others, done.stderr
    assert len(errors[0]) < 600, "an error is one line that can be read"
    assert not (folder / "out.exr").exists()
    return False


# Files that cannot be opened.

TEXT = pictures.HEADER.format(metres=1, up="Y") + pictures.ROOM + pictures.LAMP + pictures.camera()


def as_crate(text, path):
    from pxr import Sdf

    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString(text)
    layer.Export(str(path))
    return path.read_bytes()


def as_package(text, path):
    from pxr import UsdUtils

    inner = path.with_name("inner.usdc")
    as_crate(text, inner)
    assert UsdUtils.CreateNewUsdzPackage(str(inner), str(path))
    return path.read_bytes()


UNOPENABLE = {
    "empty.usda": b"",
    "empty.usdc": b"",
    "empty.usdz": b"",
    "garbage.usda": bytes(range(256)) * 8,
    "garbage_after_header.usda": b"#usda 1.0\n" + bytes(range(128, 256)) * 8,
    "garbage.usdc": b"PXR-USDC" + bytes(range(256)) * 8,
    "garbage.usdz": b"PK\x03\x04" + bytes(range(256)) * 8,
    "header_only.usdc": b"PXR-USDC\x00\x08\x00\x00\x00\x00\x00\x00",
    "picture.usd": b"\x89PNG\r\n\x1a\n" + bytes(64),
    "old.usda": b"#usda 9.0\n",
    "brackets.usda": b'#usda 1.0\ndef Mesh "M"\n{\n    custom int[] a = ' + b"[" * 200_000 + b"]" * 200_000 + b"\n}\n",
    "braces.usda": b"#usda 1.0\n" + b'def "A" {\n' * 20_000,
    "rate.usda": b"#usda 1.0\n(\n    framesPerSecond = 0\n)\n",
    "nul.usda": b"#usda 1.0\n\x00\x00\x00",
    "strange_ending.abc": b"#usda 1.0\n",
}


@pytest.mark.parametrize("name", UNOPENABLE)
def test_unopenable_files(run, tmp_path, name):
    path = tmp_path / name
    path.write_bytes(UNOPENABLE[name])
    done = render(run, path, tmp_path)
    assert not judge(done, tmp_path)
    assert name in done.stderr


def test_a_folder_and_a_file_that_may_not_be_read(run, tmp_path):
    (tmp_path / "folder.usda").mkdir()
    assert not judge(render(run, tmp_path / "folder.usda", tmp_path), tmp_path)


@pytest.mark.parametrize("share", [0.02, 0.3, 0.7, 0.98])
@pytest.mark.parametrize("ending", ["usda", "usdc", "usdz"])
def test_truncated_files(run, tmp_path, ending, share):
    whole = {"usda": lambda p: TEXT.encode(), "usdc": lambda p: as_crate(TEXT, p), "usdz": lambda p: as_package(TEXT, p)}[ending](
        tmp_path / f"whole.{ending}"
    )
    path = tmp_path / f"short.{ending}"
    path.write_bytes(whole[: int(len(whole) * share)])
    judge(render(run, path, tmp_path), tmp_path)


def corrupted(data, seed):
    """The file with one to three bytes changed."""
    chance = random.Random(seed)
    out = bytearray(data)
    for _ in range(chance.randint(1, 3)):
        out[chance.randrange(len(out))] = chance.randrange(256)
    return bytes(out)


def corrupt_and_render(run, tmp_path, ending, seeds):
    data = TEXT.encode() if ending == "usda" else as_crate(TEXT, tmp_path / "whole.usdc")
    for seed in seeds:
        path = tmp_path / f"corrupt.{ending}"
        path.write_bytes(corrupted(data, seed))
        (tmp_path / "out.exr").unlink(missing_ok=True)
        try:
            judge(render(run, path, tmp_path), tmp_path)
        except (AssertionError, subprocess.TimeoutExpired) as error:
            raise AssertionError(f"seed {seed}: {error}") from error


@pytest.mark.parametrize("ending", ["usda", "usdc"])
def test_corrupted_bytes(run, tmp_path, ending):
    corrupt_and_render(run, tmp_path, ending, range(8))


@pytest.mark.validate
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("ending", ["usda", "usdc"])
def test_many_corrupted_bytes(run, tmp_path, ending):
    corrupt_and_render(run, tmp_path, ending, range(1000, 1300))


# Composition.

COMPOSITION = {
    "missing_reference": 'def "A" (prepend references = @absent.usda@) {}\n',
    "missing_payload": 'def "A" (prepend payload = @absent.usda@) {}\n',
    "cyclic_reference": 'def "A" (prepend references = </B>) {}\ndef "B" (prepend references = </A>) {}\n',
    "reference_to_itself": 'def "A" (prepend references = @stage.usda@</A>) {}\n',
    "bad_target": 'def "A" (prepend references = @stage.usda@</Nowhere>) {}\n',
    "missing_inherit": 'def "A" (prepend inherits = </Nowhere>) {}\n',
    "broken_reference": 'def "A" (prepend references = @broken.usda@) {}\n',
}
WITH_WARNING = ("missing_reference", "missing_payload", "cyclic_reference", "reference_to_itself", "bad_target", "broken_reference")


@pytest.mark.parametrize("name", COMPOSITION)
def test_composition_errors_are_warnings(run, tmp_path, name):
    (tmp_path / "broken.usda").write_text("#usda 1.0\ndef {{{")
    stage = pictures.stage(tmp_path / "stage.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), COMPOSITION[name])
    done = render(run, stage, tmp_path)
    assert judge(done, tmp_path)
    if name in WITH_WARNING:
        assert "gonio: warning: " in done.stderr
        (tmp_path / "out.exr").unlink()
        assert not judge(render(run, stage, tmp_path, "--strict"), tmp_path)


def test_a_missing_sublayer_is_a_warning(run, tmp_path):
    stage = tmp_path / "stage.usda"
    stage.write_text(TEXT.replace("(\n", "(\n    subLayers = [@absent.usda@]\n", 1))
    done = render(run, stage, tmp_path)
    assert judge(done, tmp_path) and "absent.usda" in done.stderr


@pytest.mark.parametrize("metadata", ["timeCodesPerSecond = 0", "timeCodesPerSecond = -1", 'upAxis = "X"', "metersPerUnit = 0", "metersPerUnit = -1"])
def test_odd_stage_metadata(run, tmp_path, metadata):
    stage = tmp_path / "stage.usda"
    key = metadata.split()[0]
    kept = [line for line in pictures.HEADER.format(metres=1, up="Y").splitlines() if key not in line]
    kept.insert(2, f"    {metadata}")
    stage.write_text("\n".join(kept) + "\n" + pictures.ROOM + pictures.LAMP + pictures.camera())
    judge(render(run, stage, tmp_path), tmp_path)


# Values.

MESHES = {
    "index_too_large": mesh(indices="[0, 1, 2, 9]"),
    "negative_index": mesh(indices="[0, 1, -1, 3]"),
    "counts_beyond_indices": mesh(counts="[4, 4]"),
    "counts_too_few": mesh(counts="[3]"),
    "negative_count": mesh(counts="[-4]"),
    "absurd_count": mesh(counts="[2147483647]"),
    "absurd_counts_that_wrap": mesh(counts="[2147483647, 2147483647, 6]"),
    "faces_of_two": mesh(counts="[2, 2]"),
    "no_faces": mesh(counts="[]", indices="[]"),
    "no_points": mesh(points="[]"),
    "nothing": 'def Mesh "Odd" {}\n',
    "nan_points": mesh(points="[(nan, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)]"),
    "infinite_points": mesh(points="[(-inf, 0, 1), (1, inf, 1), (1, 0, -1), (-1, 0, -1)]"),
    "huge_points": mesh(points="[(-1e38, 0, 1e38), (1e38, 0, 1e38), (1e38, 0, -1e38), (-1e38, 0, -1e38)]"),
    "tiny_points": mesh(points="[(-1e-38, 0, 1e-38), (1e-38, 0, 1e-38), (1e-38, 0, -1e-38), (-1e-38, 0, -1e-38)]"),
    "one_point_four_times": mesh(points="[(0, 0, 0), (0, 0, 0), (0, 0, 0), (0, 0, 0)]"),
    "short_normals": mesh(more='    normal3f[] normals = [(0, 1, 0)] (interpolation = "vertex")'),
    "nan_normals": mesh(more='    normal3f[] normals = [(nan, 1, 0), (0, 0, 0), (0, inf, 0), (0, 1, 0)] (interpolation = "vertex")'),
    "short_st": mesh(more='    texCoord2f[] primvars:st = [(0, 0)] (interpolation = "faceVarying")'),
    "st_index_out_of_range": mesh(
        more='    texCoord2f[] primvars:st = [(0, 0)] (interpolation = "vertex")\n    int[] primvars:st:indices = [0, 5, -7, 0]'
    ),
    "points_of_another_type": 'def Mesh "Odd"\n{\n    int[] faceVertexCounts = [3]\n    int[] faceVertexIndices = [0, 1, 2]\n    float[] points = [1, 2, 3]\n}\n',
    "counts_of_another_type": 'def Mesh "Odd"\n{\n    float[] faceVertexCounts = [3]\n    string faceVertexIndices = "x"\n    point3f[] points = [(0, 0, 0)]\n}\n',
    "hole_out_of_range": mesh(more="    int[] holeIndices = [7, -1]"),
    "crease_out_of_range": mesh(more="    int[] creaseIndices = [0, 99]\n    int[] creaseLengths = [2, 5]\n    float[] creaseSharpnesses = [nan]").replace(
        '"none"', '"catmullClark"'
    ),
    "unknown_scheme": mesh().replace('"none"', '"strange"'),
    "subset_out_of_range": mesh(
        more='    def GeomSubset "S"\n    {\n        uniform token elementType = "face"\n        int[] indices = [55, -3]\n        uniform token familyName = "materialBind"\n    }'
    ),
    "radius_nan": 'def Sphere "Odd"\n{\n    double radius = nan\n}\n',
    "radius_zero": 'def Sphere "Odd"\n{\n    double radius = 0\n}\n',
    "radius_negative": 'def Sphere "Odd"\n{\n    double radius = -1\n}\n',
    "zero_scale": 'def Cube "Odd"\n{\n    double3 xformOp:scale = (0, 0, 0)\n    uniform token[] xformOpOrder = ["xformOp:scale"]\n}\n',
    "flat_scale": 'def Cube "Odd"\n{\n    double3 xformOp:scale = (1, 0, 1)\n    uniform token[] xformOpOrder = ["xformOp:scale"]\n}\n',
    "nan_transform": 'def Cube "Odd"\n{\n    double3 xformOp:translate = (nan, 0, 0)\n    uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n',
    "infinite_transform": 'def Cube "Odd"\n{\n    double3 xformOp:scale = (inf, 1, 1)\n    uniform token[] xformOpOrder = ["xformOp:scale"]\n}\n',
    "huge_transform": 'def Cube "Odd"\n{\n    double3 xformOp:scale = (1e300, 1e300, 1e300)\n    uniform token[] xformOpOrder = ["xformOp:scale"]\n}\n',
    "unknown_xform_op": 'def Cube "Odd"\n{\n    uniform token[] xformOpOrder = ["xformOp:strange", "xformOp:translate"]\n}\n',
    "instancer_without_prototypes": 'def PointInstancer "Odd"\n{\n    int[] protoIndices = [0, 1]\n    point3f[] positions = [(0, 0, 0), (1, 0, 0)]\n}\n',
    "instancer_out_of_range": 'def PointInstancer "Odd"\n{\n    int[] protoIndices = [0, 5, -1]\n    point3f[] positions = [(0, 0, 0), (1, 0, 0), (2, 0, 0)]\n    rel prototypes = </Odd/C>\n    def Cube "C" {}\n}\n',
    "instancer_short_positions": 'def PointInstancer "Odd"\n{\n    int[] protoIndices = [0, 0, 0]\n    point3f[] positions = [(0, 0, 0)]\n    rel prototypes = </Odd/C>\n    def Cube "C" {}\n}\n',
    "instancer_of_itself": 'def PointInstancer "Odd"\n{\n    int[] protoIndices = [0]\n    point3f[] positions = [(0, 0, 0)]\n    rel prototypes = </Odd>\n}\n',
    "light_nan": 'def SphereLight "Odd"\n{\n    float inputs:intensity = nan\n}\n',
    "light_infinite": 'def SphereLight "Odd"\n{\n    float inputs:intensity = inf\n    float inputs:radius = inf\n}\n',
    "light_negative": 'def RectLight "Odd"\n{\n    float inputs:intensity = -5\n    float inputs:width = -2\n}\n',
    "light_of_no_size": 'def RectLight "Odd"\n{\n    float inputs:width = 0\n    bool inputs:normalize = 1\n}\n',
    "light_of_huge_exposure": 'def DistantLight "Odd"\n{\n    float inputs:exposure = 1000\n}\n',
    "light_zero_scale": 'def DiskLight "Odd"\n{\n    double3 xformOp:scale = (0, 0, 0)\n    uniform token[] xformOpOrder = ["xformOp:scale"]\n}\n',
    "dome_without_its_file": 'def DomeLight "Odd"\n{\n    asset inputs:texture:file = @absent.exr@\n}\n',
    "binding_to_nothing": mesh(more="    rel material:binding = </Nowhere>"),
    "material_in_a_circle": """
def Mesh "Odd" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    int[] faceVertexCounts = [3]
    int[] faceVertexIndices = [0, 1, 2]
    point3f[] points = [(-1, 1, 1), (1, 1, 1), (0, 1, -1)]
    rel material:binding = </M>
}
def Material "M"
{
    token outputs:surface.connect = </M/S.outputs:surface>
    def Shader "S"
    {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor.connect = </M/T.outputs:rgb>
        token outputs:surface
    }
    def Shader "T"
    {
        uniform token info:id = "UsdUVTexture"
        asset inputs:file = @absent.png@
        float2 inputs:st.connect = </M/U.outputs:result>
        float3 outputs:rgb
    }
    def Shader "U"
    {
        uniform token info:id = "UsdTransform2d"
        float2 inputs:in.connect = </M/U.outputs:result>
        float2 outputs:result
    }
}
""",
}
# What the schema allows, or what has nothing to show.
SILENT = {"binding_to_nothing", "flat_scale", "zero_scale", "light_zero_scale", "one_point_four_times", "tiny_points", "radius_negative"}


@pytest.mark.parametrize("name", MESHES)
def test_odd_values_cost_no_more_than_their_prim(run, tmp_path, name):
    stage = pictures.stage(tmp_path / "stage.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), MESHES[name])
    done = render(run, stage, tmp_path, "--aov", "color,normal,P,albedo,luminance,illuminance")
    assert judge(done, tmp_path), done.stderr
    assert pictures.read(tmp_path / "out.exr")["A"].mean() > 0.6, "the rest of the room is gone"
    if name not in SILENT:
        assert any(line.startswith("gonio: warning: ") and ("/Odd" in line or "/M" in line) for line in done.stderr.splitlines()), done.stderr


CAMERAS = {
    "focal_length_zero": ("focalLength = 30", "focalLength = 0"),
    "focal_length_nan": ("focalLength = 30", "focalLength = nan"),
    "aperture_zero": ("horizontalAperture = 20", "horizontalAperture = 0"),
    "aperture_infinite": ("verticalAperture = 20", "verticalAperture = inf"),
    "placed_nowhere": ("(0, 4, 6)", "(nan, 4, 6)"),
    "far_away": ("(0, 4, 6)", "(1e30, 4, 6)"),
    "exposure_huge": ("focalLength = 30", "focalLength = 30\n    float exposure = 5000"),
    "stop_tiny": ("focalLength = 30", "focalLength = 30\n    float fStop = 1e-30\n    float focusDistance = 3"),
    "clipping_reversed": ("focalLength = 30", "focalLength = 30\n    float2 clippingRange = (10, 1)"),
}


@pytest.mark.parametrize("name", CAMERAS)
def test_odd_cameras(run, tmp_path, name):
    stage = pictures.stage(tmp_path / "stage.usda", pictures.ROOM, pictures.LAMP, pictures.camera().replace(*CAMERAS[name]))
    judge(render(run, stage, tmp_path), tmp_path)


def test_deep_hierarchies(run, tmp_path):
    deep = "".join(f'def Xform "A{k}" {{\n' for k in range(1500)) + "def Cube \"C\"\n{\n}\n" + "}\n" * 1500
    stage = pictures.stage(tmp_path / "stage.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), deep)
    judge(render(run, stage, tmp_path), tmp_path)


# Images.

TEXTURED = """
def Mesh "Odd" (prepend apiSchemas = ["MaterialBindingAPI"])
{{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-1, 1, 1), (1, 1, 1), (1, 1, -1), (-1, 1, -1)]
    texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex")
    uniform token subdivisionScheme = "none"
    rel material:binding = </M>
}}
def DomeLight "Dome"
{{
    asset inputs:texture:file = @{name}@
}}
def Material "M"
{{
    token outputs:surface.connect = </M/S.outputs:surface>
    def Shader "S"
    {{
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor.connect = </M/T.outputs:rgb>
        token outputs:surface
    }}
    def Shader "T"
    {{
        uniform token info:id = "UsdUVTexture"
        asset inputs:file = @{name}@
        float4 inputs:fallback = (0, 1, 0, 1)
        float3 outputs:rgb
    }}
}}
"""


def png(width, height, body):
    """A PNG file with this header and these compressed rows."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(body)) + chunk(b"IEND", b"")


GOOD_PNG = png(2, 2, b"\0\xff\0\0\0\xff\0" * 2)
HDR = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n"
IMAGES = {
    "empty.png": b"",
    "garbage.png": bytes(range(256)) * 4,
    "cut.png": GOOD_PNG[:40],
    "short_rows.png": png(4, 4, b"\0\xff"),
    "huge_header.png": png(2**31 - 1, 2**31 - 1, b"\0"),
    "wide.png": png(60000, 60000, b"\0"),
    "no_size.png": png(0, 0, b""),
    "jpeg_that_is_png.jpg": GOOD_PNG,
    "cut.jpg": b"\xff\xd8\xff\xe0\x00\x10JFIF\x00\x01",
    "text.exr": b"no picture at all",
    "head.exr": b"\x76\x2f\x31\x01\x02\x00\x00\x00channels\x00chlist\x00\xff\xff\xff\x7f",
    "cut.hdr": HDR % (4, 4) + b"\x02\x02\x00\x04",
    "huge.hdr": HDR % (2**30, 2**30) + b"\x02\x02",
    "folder.png": None,
    "unknown.xyz": b"?",
}


@pytest.mark.parametrize("name", IMAGES)
def test_bad_images_are_warnings(run, tmp_path, name):
    data = IMAGES[name]
    if data is None:
        (tmp_path / name).mkdir()
    else:
        (tmp_path / name).write_bytes(data)
    stage = pictures.stage(tmp_path / "stage.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), TEXTURED.format(name=name))
    done = render(run, stage, tmp_path)
    assert judge(done, tmp_path), done.stderr
    assert name == "jpeg_that_is_png.jpg" or name in done.stderr, done.stderr


def test_an_image_with_values_that_are_no_numbers(run, tmp_path):
    pixels = np.full((4, 8, 3), np.nan, "f4")
    pixels[::2] = np.inf
    OpenEXR.File({"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}, {"RGB": pixels}).write(str(tmp_path / "nan.exr"))
    stage = pictures.stage(tmp_path / "stage.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), TEXTURED.format(name="nan.exr"))
    judge(render(run, stage, tmp_path), tmp_path)


# The machine's limits.


def test_a_full_disk_is_an_error_that_leaves_nothing(command, room, tmp_path):
    def small_files():
        resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))

    for name in ("a.exr", "a.png"):
        line = [*command, "render", str(room), "-o", str(tmp_path / name), "--res", "64", "64", "--spp", "1"]
        done = subprocess.run(line, capture_output=True, text=True, preexec_fn=small_files, timeout=60)
        assert done.returncode == 1 and done.stderr.count("gonio: error: ") == 1 and name in done.stderr, done.stderr
        assert "Traceback" not in done.stderr and "panicked" not in done.stderr
        assert list(tmp_path.iterdir()) == []


def test_a_closed_standard_output_is_nobody_s_loss(command, room, tmp_path):
    line = [*command, "render", str(room), "-o", str(tmp_path / "a.exr"), "--res", "8", "8", "--spp", "1"]
    process = subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    process.stdout.close()
    said = process.stderr.read()
    assert process.wait(60) == 0 and "panicked" not in said and "Traceback" not in said
    process.stderr.close()
    assert pictures.read(tmp_path / "a.exr").shape == (8, 8)


# Everything at hand.


def all_stages(folder):
    endings = (".usd", ".usda", ".usdc", ".usdz")
    return sorted(path for path in folder.rglob("*") if path.suffix in endings and path.is_file())


def render_all(run, tmp_path, stages):
    wrong = []
    for stage in stages:
        (tmp_path / "out.exr").unlink(missing_ok=True)
        try:
            judge(run("render", stage, "-o", tmp_path / "out.exr", "--res", 8, 8, "--spp", 1, "--complexity", "low", timeout=60), tmp_path)
        except subprocess.TimeoutExpired:
            wrong.append(f"{stage}: no end")
        except AssertionError as error:
            wrong.append(f"{stage}: {error}")
    assert not wrong, "\n".join(wrong)


@pytest.mark.timeout(600)
def test_stages_at_hand_render_or_fail_with_one_line(run, shared, tmp_path):
    # Every third here, all of them below.
    render_all(run, tmp_path, all_stages(shared("usd"))[::3])


@pytest.mark.validate
@pytest.mark.timeout(1800)
def test_every_stage_renders_or_fails_with_one_line(run, shared, tmp_path):
    render_all(run, tmp_path, all_stages(shared("usd")))


# Interruptions.


def start_slow(command, stage, path, *options):
    line = [*command, "render", str(stage), "-o", str(path), "--res", "512", "512", "--spp", "65536", *map(str, options)]
    return subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def interrupt_while_rendering(command, room, path, wait, *options):
    """Seconds from Ctrl-C to the end of the process, `wait` seconds after its workers started."""
    with start_slow(command, room, path, "--verbose", *options) as process:
        while "compiled in" not in process.stderr.readline():
            assert process.poll() is None
        time.sleep(wait)
        start = time.monotonic()
        process.send_signal(signal.SIGINT)
        said = process.stderr.read()
        code = process.wait(30)
        took = time.monotonic() - start
    assert code == 130 and "interrupted" in said and "Traceback" not in said, said
    image = pictures.read(path)
    assert np.isfinite(image.rgb).all() and image.rgb.max() > 0
    assert [each.name for each in path.parent.iterdir()] == [path.name]
    return took


@pytest.mark.parametrize("wait", [1.0, 3.0])
def test_ctrl_c_ends_and_leaves_the_picture_so_far(command, room, tmp_path, wait):
    interrupt_while_rendering(command, room, tmp_path / "a.exr", wait)


@pytest.mark.validate
@pytest.mark.parametrize("side", [512, 1024, 2048])
def test_ctrl_c_ends_within_a_fifth_of_a_second(command, room, tmp_path, side):
    times = [interrupt_while_rendering(command, room, tmp_path / "a.exr", 2.0, "--res", side, side) for _ in range(5)]
    assert sorted(times)[2] < 0.2, times


def test_ctrl_c_while_reading_ends_with_a_line(command, tmp_path):
    many = "".join(f'def Sphere "S{k}" {{}}\n' for k in range(4000))
    stage = pictures.stage(tmp_path / "many.usda", many, pictures.LAMP, pictures.camera())
    for wait in (0.15, 0.4, 0.8):
        process = start_slow(command, stage, tmp_path / "a.exr")
        time.sleep(wait)
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=30)
        assert process.returncode != 0
        # Before the module is loaded the interruption is Python's own.
        assert "Traceback" not in said or wait < 0.3, said


def test_sigterm_leaves_no_broken_file(command, room, tmp_path):
    process = start_slow(command, room, tmp_path / "a.exr")
    time.sleep(1.5)
    process.terminate()
    process.communicate(timeout=30)
    assert not (tmp_path / "a.exr").exists() or pictures.read(tmp_path / "a.exr")


def kill_at_random(command, room, tmp_path, times):
    chance = random.Random(5)
    for attempt in range(times):
        path = tmp_path / "a.exr"
        line = [*command, "render", str(room), "-f", "1:500", "-o", str(tmp_path / "a.####.exr"), "--res", "400", "300", "--spp", "1", "-q"]
        process = subprocess.Popen(line, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(chance.uniform(0.5, 2.5))
        process.kill()
        process.wait()
        for path in tmp_path.glob("a.*.exr"):
            image = pictures.read(path)
            assert image.shape == (300, 400), f"attempt {attempt}"
            path.unlink()


def test_kill_leaves_no_broken_file(command, room, tmp_path):
    kill_at_random(command, room, tmp_path, 5)


@pytest.mark.validate
@pytest.mark.timeout(1200)
def test_many_kills_leave_no_broken_file(command, room, tmp_path):
    kill_at_random(command, room, tmp_path, 60)
