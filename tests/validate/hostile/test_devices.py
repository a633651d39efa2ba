"""Outputs and inputs that are no ordinary files, or have no ordinary names: written, read, or refused in one line, never waited for."""

import os
import stat
import subprocess

import pictures
import pytest
from bounds import judged, limited, refused
from writers import IES, WRITERS, copied, ending, kitchen, words_of

pytestmark = [pytest.mark.validate, pytest.mark.timeout(1500)]

# Of the clock, for machines that do other things too; who waits for a pipe waits longer.
SECONDS = 240


@pytest.fixture(scope="module")
def filled(command, tmp_path_factory):
    return kitchen(command, tmp_path_factory.mktemp("kitchen"))


@pytest.fixture
def folder(filled, tmp_path):
    return copied(filled, tmp_path)


@pytest.fixture
def write(run, folder):
    """Runs the command of WRITERS for this target, in the test's folder."""

    def call(name, target, **options):
        return run(*words_of(name, target), cwd=folder, timeout=SECONDS, preexec_fn=limited, **options)

    return call


@pytest.fixture
def mounted(tmp_path):
    """Mounts a file system of memory with these options; skips where that is not allowed."""
    places = []

    def mount(options):
        place = tmp_path / f"mounted{len(places)}"
        place.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", place], capture_output=True).returncode != 0:
            pytest.skip("no file system can be mounted here")
        places.append(place)
        return place

    yield mount
    for place in places:
        subprocess.run(["umount", place], check=True)


# Outputs.


@pytest.mark.parametrize("name", WRITERS)
def test_a_device_that_is_full(write, folder, name):
    target = folder / f"full.{ending(name)}"
    target.symlink_to("/dev/full")
    before = set(folder.iterdir())
    refused(write(name, target), target.name)
    assert target.is_symlink() and stat.S_ISCHR(os.stat("/dev/full").st_mode)
    left = {path.name for path in folder.iterdir()} - {path.name for path in before}
    # What was computed is kept elsewhere, and the line says where.
    assert all(each == "beside.exr" or each.startswith("gonio-") for each in left), left


@pytest.mark.parametrize("name", WRITERS)
def test_a_pipe_that_nobody_reads(write, folder, name):
    target = folder / f"pipe.{ending(name)}"
    os.mkfifo(target)
    refused(write(name, target), target.name)
    assert stat.S_ISFIFO(target.stat().st_mode)


@pytest.mark.parametrize("name", WRITERS)
def test_a_folder_that_takes_no_files(write, mounted, name):
    place = mounted("size=1m,ro")
    refused(write(name, place / f"a.{ending(name)}"), "a." + ending(name))


@pytest.mark.parametrize("name", WRITERS)
def test_a_file_system_that_is_full(write, folder, mounted, name):
    place = mounted("size=64k")
    (place / "filling").write_bytes(bytes(64 << 10))
    target = place / f"a.{ending(name)}"
    judged(write(name, target))
    # An empty file may be had where no byte may.
    assert not target.exists() and [path.name for path in place.iterdir()] == ["filling"]


@pytest.mark.parametrize("name", WRITERS)
def test_links(write, folder, name):
    (folder / "kept").mkdir()
    for link, leads_to, works in (("dangling", "kept/new", True), ("lost", "nowhere/new", False), ("circle", "circle", False)):
        target = folder / f"{link}.{ending(name)}"
        target.symlink_to(f"{leads_to}.{ending(name)}")
        done = judged(write(name, target))
        assert (done.returncode == 0) == works, (link, done.stderr)
        assert target.is_symlink(), link
    if name == "sums":
        # A checkpoint that is there is gone on with, or refused.
        return
    there = folder / "kept" / f"there.{ending(name)}"
    there.write_text("old")
    link = folder / f"link.{ending(name)}"
    link.symlink_to(there)
    assert judged(write(name, link)).returncode == 0
    assert link.is_symlink() and there.read_bytes() != b"old"
    assert {path.name for path in (folder / "kept").iterdir()} == {there.name, f"new.{ending(name)}"}


# Commands that read what they are to write: the file, and whether it may be replaced by its own successor.
OWN_INPUTS = {
    "stage by its map": ("map stage.usda --paths 4096 -o stage.usda -q", "stage.usda"),
    "stage by another path": ("map stage.usda --paths 4096 -o ./again/../stage.usda -q", "stage.usda"),
    "stage by a link": ("map stage.usda --paths 4096 -o linked.usda -q", "stage.usda"),
    "stage by a hard link": ("map stage.usda --paths 4096 -o hard.usda -q", "stage.usda"),
    "stage by a checkpoint": ("render stage.usda --checkpoint stage.usda --res 8 8 --spp 1 -q", "stage.usda"),
    "layer by its map": ("map over.usda --paths 4096 -o stage.usda -q", "stage.usda"),
    "texture by its picture": ("render textured.usda -o wall.png --res 8 8 --spp 1 -q", "wall.png"),
    "lamp's file by its measurement": ("goniometer measured.usda --luminaire /Lit --rays 100k -o lamp.ies", "lamp.ies"),
    "lamp's file by its conversion": ("photometry lamp.ies --convert lamp.ies", "lamp.ies"),
    "part by its sum": ("merge part.sums -o part.exr -q", "part.sums"),
    "picture relit": ("relight picture.exr -o picture.exr", "picture.exr"),
}
# What is replaced by a picture or a file of its own kind, whole.
REPLACED = {"texture by its picture", "lamp's file by its measurement", "lamp's file by its conversion", "picture relit"}


@pytest.mark.parametrize("name", OWN_INPUTS)
def test_an_input_as_output(run, folder, name):
    line, kept = OWN_INPUTS[name]
    (folder / "again").mkdir()
    (folder / "linked.usda").symlink_to("stage.usda")
    os.link(folder / "stage.usda", folder / "hard.usda")
    (folder / "over.usda").write_text('#usda 1.0\n(\n    subLayers = [@stage.usda@]\n    upAxis = "Y"\n    metersPerUnit = 1\n)\n')
    prepare_files(folder)
    before = (folder / kept).read_bytes()
    done = judged(run(*line.split(), cwd=folder, timeout=SECONDS, preexec_fn=limited))
    after = (folder / kept).read_bytes()
    if name in REPLACED:
        assert done.returncode == 0 or after == before, done.stderr
        assert after[:3] == before[:3] and len(after) > 50
    else:
        assert after == before, "the input was written over"


def prepare_files(folder):
    """A stage with a texture, and one whose lamp has a measured distribution."""
    pictures.write_png(folder / "wall.png", [[[200, 100, 50]] * 4] * 4)
    dome = 'def DomeLight "Dome"\n{\n    asset inputs:texture:file = @wall.png@\n}\n'
    pictures.stage(folder / "textured.usda", pictures.ROOM, pictures.camera(), dome)
    light = 'def Xform "Lit"\n{\n    def SphereLight "Own" (prepend apiSchemas = ["ShapingAPI"])\n    {\n'
    pictures.stage(folder / "measured.usda", light + "        asset inputs:shaping:ies:file = @lamp.ies@\n    }\n}\n")


NAMES = {
    "a newline": "two\nlines",
    "bytes that are no text": os.fsdecode(b"\xff\xfe\x80name"),
    "a dash": "-o",
    "spaces": " a  b ",
    "an escape": "\x1b[31mred",
    "placeholders of others": "%s%n{}",
    "quotes": "'\"`$(touch oops)",
    "another writing": "наша картина 図 😀",
    "dots": "...",
}


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("writer", ["exr", "png", "sums", "csv", "usda", "ldt", "ies"])
def test_names_of_outputs(write, folder, writer, name):
    file = f"{NAMES[name]}.{ending(writer)}"
    before = {path.name for path in folder.iterdir()}
    done = judged(write(writer, f"./{file}"), statuses=(0, 1, 2))
    if name == "bytes that are no text":
        assert done.returncode == 2 and "no text" in done.stderr, done.stderr
        return
    assert done.returncode == 0, done.stderr
    assert {path.name for path in folder.iterdir()} - before == {file}


@pytest.mark.parametrize("name", NAMES)
def test_names_of_stages(run, folder, name):
    stage = folder / f"{NAMES[name]}.usda"
    (folder / "stage.usda").rename(stage)
    done = judged(run("render", stage, "-o", "a.png", "--res", 8, 8, "--spp", 1, cwd=folder, timeout=SECONDS), statuses=(0, 1, 2))
    # The USD library takes names that are text alone.
    assert done.returncode == (2 if name == "bytes that are no text" else 0), done.stderr
    if done.returncode:
        return
    stage.unlink()
    assert refused(run("render", stage, "-o", "a.png", cwd=folder, timeout=SECONDS))


@pytest.mark.parametrize("name", WRITERS)
def test_paths_that_are_too_long(write, folder, name):
    refused(write(name, folder / ("n" * 300 + f".{ending(name)}")))
    deep = "/".join(["d" * 200] * 25)
    assert judged(write(name, f"{deep}/a.{ending(name)}"), longest=len(deep) + 800).returncode == 1
    within = folder / "/".join(["d" * 60] * 5)
    within.mkdir(parents=True)
    assert len(str(within)) > 300
    done = judged(write(name, within / f"a.{ending(name)}"))
    assert done.returncode == 0 and [path.name for path in within.iterdir()] == [f"a.{ending(name)}"], done.stderr


# Inputs.

ODD = ("zero", "urandom", "pipe", "folder", "empty", "circle")


def odd(folder, kind, suffix):
    """Makes something that is no file of its ending."""
    path = folder / f"{kind}.{suffix}"
    if kind == "pipe":
        os.mkfifo(path)
    elif kind == "folder":
        path.mkdir()
    elif kind == "empty":
        path.write_bytes(b"")
    else:
        path.symlink_to(path.name if kind == "circle" else f"/dev/{kind}")
    return path.name


SQUARE = """
def Mesh "Wall" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-1, 0, 0), (1, 0, 0), (1, 2, 0), (-1, 2, 0)]
    texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex")
    rel material:binding = </M>
}
"""
TEXTURE = """
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
        asset inputs:file = @FILE@
        float3 outputs:rgb
    }
}
"""
LIGHT = 'def SphereLight "Odd" (prepend apiSchemas = ["ShapingAPI"])\n{\n    asset inputs:shaping:ies:file = @FILE@\n}\n'
# Where a file is named in a stage, by its use: the ending, what stands in the stage, and what in its head.
IN_STAGES = {
    "texture png": ("png", SQUARE + TEXTURE, ""),
    "texture exr": ("exr", SQUARE + TEXTURE, ""),
    "texture jpg": ("jpg", SQUARE + TEXTURE, ""),
    "dome": ("hdr", 'def DomeLight "Odd"\n{\n    asset inputs:texture:file = @FILE@\n}\n', ""),
    "ies": ("ies", LIGHT, ""),
    "ldt": ("ldt", LIGHT, ""),
    "reference": ("usda", 'def "X" (prepend references = @FILE@) {}\n', ""),
    "payload": ("usdc", 'def "X" (prepend payload = @FILE@) {}\n', ""),
    "package": ("usdz", 'def "X" (prepend references = @FILE@) {}\n', ""),
    "materialx": ("mtlx", 'def "X" (prepend references = @FILE@</MaterialX>) {}\n', ""),
    "sublayer": ("usda", "", "subLayers = [@FILE@]"),
    "clips": (
        "usda",
        'def Cube "X" (\nclips = {\ndictionary default = {\nasset[] assetPaths = [@FILE@]\nstring primPath = "/X"\n'
        "double2[] active = [(0, 0)]\ndouble2[] times = [(0, 0)]\n}\n}\n) {}\n",
        "",
    ),
}


@pytest.mark.parametrize("kind", ODD)
@pytest.mark.parametrize("use", IN_STAGES)
def test_what_a_stage_names(run, tmp_path, use, kind):
    suffix, body, head = IN_STAGES[use]
    name = odd(tmp_path, kind, suffix)
    stage = pictures.stage(tmp_path / "stage.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), body.replace("FILE", name))
    stage.write_text(stage.read_text().replace("(\n", f"(\n    {head.replace('FILE', name)}\n", 1))
    done = judged(run("render", stage, "-o", tmp_path / "a.exr", *SIZE, timeout=SECONDS, preexec_fn=limited))
    assert done.returncode == 1 or pictures.read(tmp_path / "a.exr")["A"].mean() > 0.6
    # What is left out is told, whatever was found in its place; a layer without a line says nothing.
    assert name in done.stderr, done.stderr


SIZE = ("--res", 16, 16, "--spp", 1)
SUN = "--sun 48.21,16.37,2025-03-21T12:00+01:00"
# Commands that read a file by an option or by their first word; of each the ending, and the line with {} for the file.
READ = {
    "stage": ("usda", "render {} -o a.exr"),
    "crate": ("usdc", "render {} -o a.exr"),
    "package": ("usdz", "info {}"),
    "session layer": ("usda", "render stage.usda --session-layer {} -o a.exr --res 8 8 --spp 1"),
    "weather epw": ("epw", f"render stage.usda {SUN} --weather {{}} -o a.exr --res 8 8 --spp 1"),
    "weather wea": ("wea", f"measure stage.usda --at 0,1,0 --spp 16 {SUN} --weather {{}}"),
    "photometry ies": ("ies", "photometry {}"),
    "photometry ldt": ("ldt", "photometry {}"),
    "photometry xml": ("xml", "photometry {}"),
    "rays": ("tm25ray", "goniometer stage.usda --luminaire /Lit --rays 100k --rays-file {} --csv a.csv"),
    "bsdf": ("bsdf", "bsdf {}"),
    "merl": ("binary", "bsdf {}"),
    "checkpoint": ("sums", "render stage.usda --checkpoint {} --resume --res 8 8 --spp 1 -o a.exr"),
    "part": ("sums", "merge {} -o a.exr"),
    "picture": ("exr", "falsecolor {} -o a.png"),
    "radiance": ("hdr", "glare {}"),
    "compared": ("exr", "compare picture.exr {}"),
    "relit": ("exr", "relight {} -o a.exr"),
    "shared": ("exr", "share {} -o a.html"),
    "spectrum csv": ("csv", "spectrum {}"),
    "spectrum spdx": ("spdx", "spectrum {}"),
    "road": ("toml", "road {}"),
    "escape routes": ("toml", "emergency stage.usda --plan {}"),
    "requirements": ("toml", "verdict {} lamp.ies"),
    "year of weather": ("epw", "annual stage.usda --grid /Floor --weather {} --spp 16 -o year"),
    "honeybee": ("hbjson", "render {} -o a.exr"),
    "ifc": ("ifc", "info {}"),
    "gldf": ("gldf", "photometry {}"),
}


@pytest.mark.parametrize("kind", ODD)
@pytest.mark.parametrize("use", READ)
def test_what_a_command_reads(run, folder, use, kind):
    suffix, line = READ[use]
    name = odd(folder, kind, suffix)
    done = run(*line.replace("{}", name).split(), cwd=folder, timeout=SECONDS, preexec_fn=limited)
    refused(done, name)
    assert not any((folder / target).exists() for target in ("a.exr", "a.png", "a.csv", "a.html", "year"))


@pytest.mark.parametrize("device", ["/dev/zero", "/dev/urandom", "/dev/full", "/dev/null", "/proc/self/mem", "/"])
def test_devices_by_their_own_names(run, folder, device):
    for words in (["render", device, "-o", "a.exr"], ["photometry", device], ["bsdf", device], ["merge", device, "-o", "a.exr"], ["compare", device, device]):
        refused(run(*words, cwd=folder, timeout=SECONDS, preexec_fn=limited), device)


def test_a_good_file_of_photometry_is_read(run, tmp_path):
    """What the hostile ones stand in the place of."""
    (tmp_path / "lamp.ies").write_text(IES)
    assert judged(run("photometry", tmp_path / "lamp.ies")).returncode == 0
