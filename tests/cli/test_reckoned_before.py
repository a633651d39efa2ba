"""What is too large is reckoned before memory is asked for, and only files that end are opened: one line within seconds, never a broken process."""

import os
import pathlib
import resource
import shutil
import struct
import subprocess
import tempfile
import zlib

import pictures
import pytest
from failures import error_of
from test_robustness_cli import BAD_WORDS

SMALL = ("--res", 16, 16, "--spp", 1)
GIGABYTE = 10**9
TEXTURED = """
def Mesh "Wall" (prepend apiSchemas = ["MaterialBindingAPI"])
{{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-1, 0, 0), (1, 0, 0), (1, 2, 0), (-1, 2, 0)]
    texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex")
    rel material:binding = </M>
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
        asset inputs:file = @{file}@
        float3 outputs:rgb
    }}
}}
"""
DOME = 'def DomeLight "Dome"\n{{\n    asset inputs:texture:file = @{file}@\n}}\n'


def within(gigabytes):
    """Options of a process that may have so many gigabytes of addresses."""
    most = int(gigabytes * GIGABYTE)
    return {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_AS, (most, most))}


def fails(run, *words, **options):
    """The one line that a run of these words says."""
    return error_of(run(*words, **options))


def told(done, *words):
    """Asserts that a picture was made, and a warning with these words."""
    assert done.returncode == 0 and not any(word in done.stderr for word in BAD_WORDS), (done.returncode, done.stderr)
    assert any(all(word in line for word in words) for line in done.stderr.splitlines()), done.stderr


def zeros(path, side):
    """A grey PNG of zeros."""
    packer, row = zlib.compressobj(9), bytes(side + 1)
    body = b"".join(packer.compress(row) for _ in range(side)) + packer.flush()
    header = struct.pack(">IIBBBBB", side, side, 8, 0, 0, 0, 0)
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))  # noqa: E731
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", body) + chunk(b"IEND", b""))


@pytest.mark.parametrize(("use", "side"), [(DOME, 10000), (TEXTURED, 16000)])
def test_images_are_reckoned(run, tmp_path, use, side):
    zeros(tmp_path / "large.png", side)
    stage = pictures.stage(tmp_path / "stage.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), use.format(file="large.png"))
    done = run("render", stage, "-o", tmp_path / "a.exr", *SMALL, "-j", 1, **within(1.6))
    told(done, "large.png", f"{side} × {side}", "GB are free")


def test_pictures_are_reckoned(run, room, tmp_path):
    line = fails(run, "render", room, "-o", tmp_path / "a.exr", "--res", 30000, 30000, "--spp", 1, "-j", 1, **within(4))
    assert "30000 x 30000" in line and "GB are free" in line
    many = ("--res", 8000, 8000, "--spp", 1, "--aov", "color,normal,depth,P,albedo,luminance,illuminance")
    assert "GB are free" in fails(run, "render", room, "-o", tmp_path / "a.exr", *many, **within(4))


def test_threads_are_as_many_as_there_is_memory_for(run, room, tmp_path):
    for threads, gigabytes in ((1000, 2), (200, 1.6)):
        done = run("render", room, "-o", tmp_path / "a.exr", *SMALL, "-j", threads, **within(gigabytes))
        assert done.returncode == 0, done.stderr


def test_threads_are_as_many_as_the_system_gives(run, room):
    """The limit holds for others than root alone, who stands in for one."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        folder.chmod(0o777)
        stage = folder / "room.usda"
        shutil.copy(room, stage)

        def few(processes):
            def limited():
                resource.setrlimit(resource.RLIMIT_NPROC, (processes, processes))
                if os.geteuid() == 0:
                    os.setgroups([])
                    os.setgid(23456)
                    os.setuid(23456)

            return {"preexec_fn": limited, "cwd": folder, "env": {**os.environ, "HOME": str(folder), "OPENBLAS_NUM_THREADS": "1"}}

        for processes in (1, 4, 6):
            try:
                done = run("render", stage, "-o", folder / "a.exr", *SMALL, "-j", 8, **few(processes))
            except PermissionError:
                pytest.skip("another user may not run these programs")
            assert done.returncode in (0, 1) and not any(word in done.stderr for word in BAD_WORDS), done.stderr
        assert done.returncode == 0, done.stderr


def levels(count):
    """Ten instances of ten instances, and so on."""
    inner = 'class "L0" {\n def Cube "C" {}\n}\n'
    for level in range(1, count + 1):
        ten = "".join(f'def "x{k}" (\n instanceable = true\n inherits = </L{level - 1}>\n) {{}}\n' for k in range(10))
        inner += f'class "L{level}" {{\n{ten}}}\n'
    return inner + f'def "All" (\n instanceable = true\n inherits = </L{count}>\n) {{}}\n'


def test_nested_instances_are_counted_before_they_are_placed(run, tmp_path):
    stage = pictures.stage(tmp_path / "nested.usda", levels(9), pictures.LAMP, pictures.camera())
    line = fails(run, "render", stage, "-o", tmp_path / "a.exr", *SMALL, timeout=20)
    assert "/All" in line and "instances" in line
    stage = pictures.stage(tmp_path / "fits.usda", levels(3), pictures.LAMP, pictures.camera())
    assert run("render", stage, "-o", tmp_path / "a.exr", *SMALL, timeout=20).returncode == 0


def test_point_instances_without_memory_are_told(run, tmp_path):
    twenty = f'[{", ".join(["(0,0,0)"] * 200)}]', f'[{", ".join(["0"] * 200)}]'
    one = 'def PointInstancer "p{}"\n{{\npoint3f[] positions = {}\nint[] protoIndices = {}\nrel prototypes = </p{}>\n}}\n'
    body = "".join(one.format(i, *twenty, i + 1) for i in range(3)) + 'def Sphere "p3" {}\n'
    stage = pictures.stage(tmp_path / "points.usda", body, pictures.LAMP, pictures.camera())
    assert "GB are free" in fails(run, "render", stage, "-o", tmp_path / "a.exr", *SMALL, **within(2))


@pytest.mark.parametrize("file", ["pipe.png", "zero.png", "/proc/kmsg", "/dev/zero"])
def test_textures_and_domes_are_files(run, tmp_path, file):
    os.mkfifo(tmp_path / "pipe.png")
    (tmp_path / "zero.png").symlink_to("/dev/zero")
    for use in (TEXTURED, DOME):
        stage = pictures.stage(tmp_path / "stage.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), use.format(file=file))
        told(run("render", stage, "-o", tmp_path / "a.exr", *SMALL, timeout=20), file.lstrip("/"))


@pytest.mark.parametrize(
    "words",
    [
        ("photometry", "{}.ies"),
        ("bsdf", "{}.xml"),
        ("render", "{}.usda", "-o", "a.exr"),
        ("info", "{}.usdc"),
        ("falsecolor", "{}.exr", "-o", "f.png"),
        ("glare", "{}.hdr"),
        ("compare", "{}.exr", "{}.exr"),
        ("relight", "{}.exr", "-o", "r.exr"),
        ("merge", "{}.part", "-o", "m.exr"),
    ],
)
def test_commands_read_files_alone(run, tmp_path, words):
    name = next(word for word in words if "{}" in word)
    for source in ("pipe", "zero"):
        path = tmp_path / name.format(source)
        os.mkfifo(path) if source == "pipe" else path.symlink_to("/dev/zero")
        assert path.name in fails(run, *(word.format(source) for word in words), cwd=tmp_path, timeout=20)


def test_photometric_files_of_stages_are_files(run, tmp_path):
    os.mkfifo(tmp_path / "pipe.ies")
    lamp = 'def SphereLight "P" (prepend apiSchemas = ["ShapingAPI"])\n{\n    asset inputs:shaping:ies:file = @pipe.ies@\n}\n'
    stage = pictures.stage(tmp_path / "stage.usda", pictures.ROOM, lamp, pictures.camera())
    assert "pipe.ies" in fails(run, "render", stage, "-o", tmp_path / "a.exr", *SMALL, timeout=20)


def test_references_are_files(run, tmp_path):
    for name, what in {"ref.usda": "references = @ref.usda@", "sub.usda": "payload = @./sub.usda@"}.items():
        os.mkfifo(tmp_path / name)
        stage = pictures.stage(tmp_path / "stage.usda", f'def "X" (prepend {what}) {{}}\n', pictures.LAMP, pictures.camera())
        assert name in fails(run, "render", stage, "-o", tmp_path / "a.exr", *SMALL, timeout=20)


def test_what_the_shell_hands_over_is_read(command, tmp_path):
    text = "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 2 0.1 0.1 0.1\n1 1 100\n0 45 90\n0\n100 50 0\n"
    (tmp_path / "a.ies").write_text(text)
    line = " ".join(command) + f" photometry <(cat {tmp_path / 'a.ies'})"
    done = subprocess.run(["bash", "-c", line], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and done.stdout, done.stderr
