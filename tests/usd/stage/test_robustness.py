"""Bad input: one clear line, never a traceback of another library, never an end of the process."""

import os
import random

import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

HEADER = "#usda 1.0\n"
QUAD = """
    point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    uniform token subdivisionScheme = "none"
"""


def write(tmp_path, content, name="stage.usda"):
    path = tmp_path / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return str(path)


def read(tmp_path, body):
    return gonio.load_usd(write(tmp_path, HEADER + body))


def messages(scene):
    return [message for _, message in scene.diagnostics]


UNREADABLE = {
    "empty": ("a.usda", b"", "empty"),
    "garbage as text": ("a.usda", bytes(random.Random(1).randbytes(500)), ""),
    "garbage as crate": ("a.usdc", bytes(random.Random(2).randbytes(5000)), ""),
    "garbage as package": ("a.usdz", b"PK\3\4" + bytes(random.Random(3).randbytes(300)), ""),
    "raw bytes": ("a.usda", b"#usda 1.0\n\xff\xfe\x00\x80\n", "UTF-8"),
    "magic alone": ("a.usdc", b"PXR-USDC", ""),
    "other ending": ("a.obj", b"v 0 0 0", "expected usd, usda, usdc or usdz"),
    "text as crate": ("a.usdc", b"#usda 1.0\n", ""),
    "unclosed": ("a.usda", b'#usda 1.0\ndef Mesh "x"\n{\n', ""),
    "brackets": ("a.usda", b'#usda 1.0\ndef "a"\n{\nfloat[] x = ' + b"[" * 200_000 + b"\n}", "nested too deep"),
    "prims": ("a.usda", b"#usda 1.0\n" + b'def "a" {' * 20_000 + b"}" * 20_000, "nested too deep"),
}


@pytest.mark.parametrize("case", UNREADABLE)
def test_files_that_cannot_be_read(tmp_path, case):
    name, content, expected = UNREADABLE[case]
    with pytest.raises(gonio.FormatError) as caught:
        gonio.load_usd(write(tmp_path, content, name))
    message = str(caught.value)
    assert name in message
    assert expected in message
    assert "\n" not in message
    assert "pxrInternal" not in message
    assert ".cpp" not in message


def test_missing_file(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"nowhere\.usda"):
        gonio.load_usd(str(tmp_path / "nowhere.usda"))


def test_folder(tmp_path):
    with pytest.raises(gonio.FormatError, match="folder"):
        gonio.load_usd(str(tmp_path))


def test_syntax_errors_have_line_and_column(tmp_path):
    with pytest.raises(gonio.FormatError, match=r"stage\.usda:4: column \d+: ") as caught:
        read(tmp_path, 'def Mesh "x"\n{\n    int[] a = [1,2,,3]\n}\n')
    assert caught.value.line == 4


def test_frame_rate_of_zero(tmp_path):
    with pytest.raises(gonio.FormatError, match="framesPerSecond") as caught:
        read(tmp_path, "(\n    framesPerSecond = 0\n)\n")
    assert caught.value.line == 3


def test_stage_metadata_out_of_range(tmp_path):
    scene = read(tmp_path, '(\n    metersPerUnit = 0\n    timeCodesPerSecond = 0\n    upAxis = "X"\n    startTimeCode = 5\n    endTimeCode = 1\n)\ndef Cube "c" {}\n')
    text = "\n".join(messages(scene))
    assert "metersPerUnit is 0" in text
    assert "timeCodesPerSecond is 0" in text
    assert "upAxis is 'X'" in text
    assert "time range" in text
    assert scene.to_dict()["instances"][0]["transforms"][0]["columns"][0][0] == 0.01


COMPOSITION = {
    "reference": ('def Xform "a" (\n    references = @nope.usda@\n)\n{\n}\n', "nope.usda"),
    "payload": ('def Xform "a" (\n    payload = @nope.usda@\n)\n{\n}\n', "nope.usda"),
    "sublayer": ("(\n    subLayers = [@nope.usda@]\n)\n", "nope.usda"),
    "own sublayer": ("(\n    subLayers = [@stage.usda@]\n)\n", "cycle"),
    "target": ('def Xform "a" (\n    references = </nope>\n)\n{\n}\n', "/nope"),
    "cycle": ('def Xform "a" (\n    references = </b>\n)\n{\n}\ndef Xform "b" (\n    references = </a>\n)\n{\n}\n', "Cycle"),
}


@pytest.mark.parametrize("case", COMPOSITION)
def test_composition_errors_are_reported_and_the_rest_is_read(tmp_path, case, capfd):
    body, expected = COMPOSITION[case]
    scene = read(tmp_path, body + 'def Cube "rest" {}\n')
    assert any(expected in message for message in messages(scene))
    assert all("@anon:" not in message and "\n" not in message for message in messages(scene))
    assert len(scene.to_dict()["instances"]) == 1
    from pxr import Tf

    if hasattr(Tf, "DiagnosticTrap"):
        assert "Warning" not in capfd.readouterr().err


def test_strict_makes_warnings_fatal(tmp_path):
    body = 'def Xform "a" (\n    references = @nope.usda@\n)\n{\n}\n'
    with pytest.raises(gonio.SceneError, match="warnings are errors"):
        gonio.load_usd(write(tmp_path, HEADER + body), strict=True)
    gonio.load_usd(write(tmp_path, HEADER + 'def Cube "c" {}\n'), strict=True)


MESHES = {
    "negative index": (QUAD.replace("2, 3]", "2, -1]"), "vertex -1"),
    "index out of range": (QUAD.replace("2, 3]", "2, 9]"), "vertex 9, but there are 4 points"),
    "counts": (QUAD.replace("[4]", "[3, 3]"), "4 face corners, but the face counts add up to 6"),
    "negative count": (QUAD.replace("[4]", "[-4]"), "-4 corners"),
    "short faces": (QUAD.replace("[4]", "[2, 2]"), "no face has a surface"),
    "not finite": (QUAD.replace("(1, 1, 0)", "(nan, inf, 0)"), "not finite"),
    "type of points": (QUAD.replace("point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]", "float points = 3"), "value of type float"),
    "type of indices": (QUAD.replace("int[] faceVertexIndices = [0, 1, 2, 3]", "string faceVertexIndices = 'x'"), "expected int[]"),
    "no points": (QUAD.replace("[(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]", "[]"), "no points"),
    "blocked points": (QUAD.replace("[(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]", "None"), "no usable points"),
    "nothing": ("", "no usable points"),
}


@pytest.mark.parametrize("case", MESHES)
@pytest.mark.parametrize("subdivided", [False, True])
def test_a_broken_mesh_is_left_out_with_its_path(tmp_path, case, subdivided):
    body, expected = MESHES[case]
    if subdivided:
        body = body.replace('"none"', '"catmullClark"')
    scene = read(tmp_path, f'def Mesh "bad"\n{{\n{body}\n}}\ndef Mesh "good"\n{{\n{QUAD}\n}}\n')
    assert [m["origin"]["name"] for m in scene.to_dict()["meshes"]] == ["/good"]
    assert [s["mesh"] for s in scene.to_dict()["instances"]] == [0]
    assert any("/bad" in origin and expected in message for origin, message in scene.diagnostics)


HARMLESS = [
    "int[] creaseIndices = [0, 9, -1]\nint[] creaseLengths = [3, 5]\nfloat[] creaseSharpnesses = [1]",
    "int[] cornerIndices = [44]\nfloat[] cornerSharpnesses = [nan]",
    "int[] holeIndices = [5, -2]",
    "float subdivisionScheme = 3",
    'uniform token orientation = "sideways"',
    "float visibility = 1\nint purpose = 2",
    'normal3f[] normals = [(0, 0, 1)] ( interpolation = "faceVarying" )',
    "string normals = 'x'",
    'float[] primvars:a = [1] ( interpolation = "banana" )',
    'float[] primvars:a = [1, 2] ( interpolation = "vertex" )\nint[] primvars:a:indices = [0, 7, -1, 0]',
    "float[] primvars:a = [nan]",
    "matrix4d[] primvars:a = [((1,0,0,0),(0,1,0,0),(0,0,1,0),(0,0,0,1))]",
    "point3f[] points.timeSamples = { 3: None }",
]


@pytest.mark.parametrize("body", HARMLESS)
@pytest.mark.parametrize("scheme", ["none", "catmullClark", "loop", "bilinear"])
def test_odd_attributes_cost_themselves_alone(tmp_path, body, scheme):
    quad = QUAD if "points" not in body else QUAD.split("\n", 2)[2]
    lines = quad.replace('"none"', f'"{scheme}"') if "subdivisionScheme" not in body else quad.rsplit("uniform", 1)[0]
    scene = read(tmp_path, f'def Mesh "M"\n{{\n{lines}\n{body}\n}}\n')
    assert len(scene.to_dict()["meshes"]) == (0 if "points" in body else 1)


INSTANCERS = {
    "index": ("[(0,0,0), (1,0,0)]", "[0, 9]", "</s>", "", 1, "name no prototype"),
    "negative index": ("[(0,0,0), (1,0,0)]", "[0, -1]", "</s>", "", 1, "name no prototype"),
    "target": ("[(0,0,0)]", "[0]", "</nope>", "", 0, "does not exist"),
    "orientations": ("[(0,0,0), (1,0,0)]", "[0, 0]", "</s>", "quath[] orientations = [(1, 0, 0, 0)]", 0, "1 orientations for 2"),
    "positions": ("[(0,0,0)]", "[0, 0]", "</s>", "", 0, "1 positions for 2"),
    "not finite": ("[(0,0,0), (1,0,0)]", "[0, 0]", "</s>", "float3[] scales = [(nan, 1, 1), (1, 1, 1)]", 1, "not finite"),
    "itself": ("[(0,0,0)]", "[0]", "</p>", "", 0, "holds itself"),
}


@pytest.mark.parametrize("case", INSTANCERS)
def test_broken_instancers(tmp_path, case):
    positions, indices, prototype, more, count, expected = INSTANCERS[case]
    body = f'def PointInstancer "p"\n{{\npoint3f[] positions = {positions}\nint[] protoIndices = {indices}\nrel prototypes = {prototype}\n{more}\n}}\n'
    scene = read(tmp_path, body + 'class "c"\n{\n}\ndef Sphere "s" {}\n')
    placed = sum(len(s["transforms"]) for s in scene.to_dict()["instances"])
    assert placed == count + 1
    assert any(expected in message for message in messages(scene))


def test_too_many_instances(tmp_path):
    hundred = f'[{", ".join(["(0,0,0)"] * 100)}]', f'[{", ".join(["0"] * 100)}]'
    one = 'def PointInstancer "p{}"\n{{\npoint3f[] positions = {}\nint[] protoIndices = {}\nrel prototypes = </p{}>\n}}\n'
    body = "".join(one.format(i, *hundred, i + 1) for i in range(6))
    with pytest.raises(gonio.SceneError, match="instances"):
        read(tmp_path, body + 'def Sphere "p6" {}\n')


def test_odd_transforms_and_sizes(tmp_path):
    body = """
def Xform "a"
{
    double3 xformOp:translate = (nan, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    def Sphere "s" {}
}
def Xform "b"
{
    uniform token[] xformOpOrder = ["xformOp:nope"]
    def Sphere "s" {}
}
def Sphere "c"
{
    double radius = nan
}
def Cube "d"
{
    string size = "big"
}
"""
    scene = read(tmp_path, body)
    origins = {origin for origin, _ in scene.diagnostics}
    assert {"/a", "/c", "/d.size"} <= origins


def test_deep_stages_are_no_problem(tmp_path):
    depth = 1500
    scene = read(tmp_path, 'def Xform "a"\n{\n' * depth + 'def Sphere "s" {}\n' + "}\n" * depth)
    assert len(scene.to_dict()["instances"]) == 1


def test_corrupt_crates_never_end_the_process(tmp_path):
    from pxr import Sdf

    text = HEADER + f'def Mesh "M"\n{{\n{QUAD}\nfloat[] primvars:a = [1, 2, 3, 4] ( interpolation = "vertex" )\n}}\n'
    Sdf.Layer.FindOrOpen(write(tmp_path, text)).Export(str(tmp_path / "good.usdc"))
    good = (tmp_path / "good.usdc").read_bytes()
    generator = random.Random(5)
    for number in range(60):
        content = bytearray(good)
        for _ in range(generator.randint(1, 3)):
            content[generator.randrange(len(content))] = generator.randrange(256)
        path = write(tmp_path, bytes(content), f"bad{number}.usdc")
        try:
            gonio.load_usd(path).to_dict()
        except gonio.Error as error:
            assert "\n" not in str(error)
    for length in range(0, len(good), max(1, len(good) // 20)):
        with pytest.raises(gonio.Error):
            gonio.load_usd(write(tmp_path, good[:length], f"short{length}.usdc"))


def test_a_file_that_many_prims_miss_is_told_once(tmp_path):
    path = tmp_path / "stage.usda"
    missing = ["chair.usd"] * 3 + ["table.usd"]
    path.write_text("#usda 1.0\n" + "".join(f'def "p{i}" ( references = @{file}@ ) {{}}\n' for i, file in enumerate(missing)))
    told = [message for _, message in gonio.load_usd(str(path)).diagnostics if "Could not open" in message]
    assert len(told) == 2
    assert told[0].startswith("Could not open asset @chair.usd@") and told[0].endswith("(3 places, this is the first)")
    assert told[1].startswith("Could not open asset @table.usd@") and "places" not in told[1]


CLIPS = """
def Cube "X" (
    clips = {
        dictionary default = {
            asset[] assetPaths = [@CLIP@]
            string primPath = "/X"
            double2[] active = [(0, 0)]
            double2[] times = [(0, 0)]
        }
    }
)
{
}
"""


@pytest.mark.parametrize("kind", ["missing", "folder", "circle"])
def test_value_clips_that_cannot_be_opened_are_told(tmp_path, kind):
    if kind == "folder":
        (tmp_path / "folder.usda").mkdir()
    elif kind == "circle":
        (tmp_path / "circle.usda").symlink_to("circle.usda")
    scene = read(tmp_path, CLIPS.replace("CLIP", f"{kind}.usda"))
    (told,) = [(origin, said) for origin, said in scene.diagnostics if f"value clip {kind}.usda" in said]
    assert told[0].startswith("/X") and "left out" in told[1]
    assert len(scene.to_dict()["meshes"]) == 1


def test_a_value_clip_that_is_a_pipe_is_refused(tmp_path):
    os.mkfifo(tmp_path / "pipe.usda")
    with pytest.raises(gonio.FormatError, match=r"value clip pipe\.usda is a pipe or device"):
        read(tmp_path, CLIPS.replace("CLIP", "pipe.usda"))
