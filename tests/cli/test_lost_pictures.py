"""What was computed is not lost: targets are tried before, devices and links stay, and who is asked to end writes what there is."""

import functools
import os
import resource
import signal
import stat
import subprocess
import threading
import time

import pictures
import pytest
from failures import error_of, fails

SMALL = ("--res", 8, 8, "--spp", 1)
# Longer than any test may take: an error that comes is one that came before.
LONG = ("--res", 64, 64, "--spp", 65536)


@pytest.fixture
def taken(tmp_path):
    """Targets that cannot be written, by what is wrong with them, for a file of an ending."""
    (tmp_path / "file").write_text("")

    def targets(ending):
        folder = tmp_path / f"folder.{ending}"
        folder.mkdir(exist_ok=True)
        return [folder, tmp_path / "file" / f"a.{ending}", tmp_path / ("n" * 252 + f".{ending}"), f"/proc/a.{ending}"]

    return targets


@pytest.mark.parametrize("number", range(4))
def test_a_picture_that_cannot_be_written_is_known_before_the_first_sample(run, room, taken, tmp_path, number):
    path, other = taken("exr")[number], tmp_path / "other.exr"
    for options in (("-o", path), ("-o", other, "--deep", path), ("-o", other, "-o", path), ("-o", other, "--checkpoint", path)):
        assert str(path)[-30:] in fails(run, "render", room, *options, *LONG)
    assert not other.exists()


# Inputs that are missing are looked for later.
COMMANDS = {
    "measure --csv": ("csv", "measure", "{room}", "--at", "0,1,0", "--spp", "1048576", "--csv", "{path}"),
    "measure -o": ("png", "measure", "{room}", "--at", "0,1,0", "--spp", "1048576", "-o", "{path}"),
    "map": ("usda", "map", "{room}", "-o", "{path}", "--paths", "1000000000000"),
    "report": ("html", "report", "{room}", "-o", "{path}", "--spp", "65536"),
    "goniometer": ("ldt", "goniometer", "{room}", "--luminaire", "/Lamp", "-o", "{path}"),
    "goniometer --csv": ("csv", "goniometer", "{room}", "--luminaire", "/Lamp", "--csv", "{path}"),
    "bsdf": ("gbsdf", "bsdf", "absent.xml", "-o", "{path}"),
    "bsdf --lobes": ("svg", "bsdf", "absent.xml", "--lobes", "{path}"),
    "photometry": ("ies", "photometry", "absent.ldt", "--convert", "{path}"),
    "photometry --polar": ("svg", "photometry", "absent.ldt", "--polar", "{path}"),
    "road": ("svg", "road", "absent.toml", "-o", "{path}"),
    "relight": ("exr", "relight", "absent.exr", "-o", "{path}"),
    "compare": ("png", "compare", "absent.exr", "other.exr", "--difference", "{path}"),
    "falsecolor": ("png", "falsecolor", "absent.exr", "-o", "{path}"),
    "glare": ("png", "glare", "absent.exr", "-o", "{path}"),
    "merge": ("exr", "merge", "absent.part", "-o", "{path}"),
}


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_tries_its_files_first(run, room, taken, name):
    ending, *words = COMMANDS[name]
    path = taken(ending)[0]
    assert f"folder.{ending}" in fails(run, *(word.format(room=room, path=path) for word in words))


@pytest.mark.parametrize("length", [244, 251, 255])
def test_the_longest_names(run, room, tmp_path, length):
    path = tmp_path / ("n" * (length - 4) + ".exr")
    done = run("render", room, "-o", path, *SMALL, "--checkpoint", tmp_path / ("c" * length))
    assert done.returncode == 0, done.stderr
    assert pictures.read(path).shape == (8, 8)
    assert len(list(tmp_path.iterdir())) == 2


@pytest.mark.parametrize("ending", ["png", "exr", "csv"])
def test_pipes_are_written_into(run, room, tmp_path, ending):
    path, read = tmp_path / f"pipe.{ending}", []
    os.mkfifo(path)
    reader = threading.Thread(target=lambda: read.append(path.read_bytes()), daemon=True)
    reader.start()
    words = ("measure", room, "--at", "0,1,0", "--spp", 16, "--csv", path) if ending == "csv" else ("render", room, "-o", path, *SMALL)
    done = run(*words)
    assert done.returncode == 0, done.stderr
    reader.join(10)
    starts = {"png": b"\x89PNG", "exr": b"\x76\x2f\x31\x01", "csv": b""}
    assert read[0].startswith(starts[ending]) and len(read[0]) > 20
    assert stat.S_ISFIFO(path.stat().st_mode) and [each.name for each in tmp_path.iterdir()] == [path.name]


def test_standard_output_takes_tables(run, room):
    words = ("measure", room, "--at", "0,1,0", "--spp", 16, "-q")
    table = run(*words).stdout
    both = run(*words, "--csv", "/dev/stdout")
    assert both.returncode == 0, both.stderr
    assert both.stdout.endswith(table) and len(both.stdout) > len(table) + 20


def test_links_stay_and_what_they_lead_to_is_replaced(run, room, tmp_path):
    (tmp_path / "kept").mkdir()
    for name in ("there.exr", "new.exr"):
        (tmp_path / name).symlink_to(tmp_path / "kept" / name)
    (tmp_path / "kept" / "there.exr").write_text("old")
    (tmp_path / "null.exr").symlink_to("/dev/null")
    for name in ("there.exr", "new.exr", "null.exr"):
        done = run("render", room, "-o", tmp_path / name, *SMALL)
        assert done.returncode == 0 and (tmp_path / name).is_symlink(), done.stderr
    assert all(pictures.read(tmp_path / "kept" / name).shape == (8, 8) for name in ("there.exr", "new.exr"))
    assert stat.S_ISCHR(os.stat("/dev/null").st_mode)


@pytest.mark.parametrize("closed", ["<&- >&- 2>&-", "2>&-", ">&-"])
def test_closed_standard_streams(command, room, tmp_path, closed):
    script = f'"$@" {closed}'
    words = [*command, "render", str(room), "-o", str(tmp_path / "a.exr"), *map(str, SMALL)]
    assert subprocess.run(["bash", "-c", script, "bash", *words], timeout=60).returncode == 0
    assert pictures.read(tmp_path / "a.exr").shape == (8, 8)


def test_what_standard_output_loses_is_told(command, room):
    with open("/dev/full", "w") as full:
        for words in (["info", str(room)], ["--help"], ["measure", "--help"], ["--version"]):
            done = subprocess.run([*command, *words], stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
            assert "standard output" in error_of(done), words


@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP"])
def test_who_is_asked_to_end_leaves_picture_and_checkpoint(command, room, tmp_path, name):
    line = [*command, "render", str(room), "-o", str(tmp_path / "a.exr"), "--checkpoint", str(tmp_path / "c"), "--verbose", *map(str, LONG)]
    # What started the tests may ignore SIGHUP, as nohup does.
    listens = functools.partial(signal.signal, getattr(signal, name), signal.SIG_DFL)
    with subprocess.Popen(line, stderr=subprocess.PIPE, text=True, preexec_fn=listens) as process:
        while "compiled in" not in process.stderr.readline():
            assert process.poll() is None
        time.sleep(0.5)
        process.send_signal(getattr(signal, name))
        said = process.stderr.read()
        assert process.wait(30) == 130 and "interrupted" in said
    assert pictures.read(tmp_path / "a.exr").shape == (64, 64)
    assert sorted(each.name for each in tmp_path.iterdir()) == ["a.exr", "c"]


def test_a_render_that_is_to_outlive_its_terminal_does(command, room, tmp_path):
    line = [*command, "render", str(room), "-o", str(tmp_path / "a.exr"), "--verbose", *map(str, LONG)]
    ignoring = {"preexec_fn": lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN)}
    with subprocess.Popen(line, stderr=subprocess.PIPE, text=True, **ignoring) as process:
        while "compiled in" not in process.stderr.readline():
            assert process.poll() is None
        process.send_signal(signal.SIGHUP)
        time.sleep(1.0)
        assert process.poll() is None
        process.terminate()
        process.stderr.read()
        assert process.wait(30) == 130


def test_a_checkpoint_without_room_costs_no_picture(command, room, tmp_path):
    small = {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (60000, 60000))}
    words = ["-o", tmp_path / "a.png", "--checkpoint", tmp_path / "c", "--res", 64, 64, "--spp", 1]
    done = subprocess.run([*command, "render", str(room), *map(str, words)], capture_output=True, text=True, timeout=60, **small)
    assert done.returncode == 1 and f"{tmp_path / 'c'}" in done.stderr
    assert [each.name for each in tmp_path.iterdir()] == ["a.png"] and pictures.png_size(tmp_path / "a.png") == (64, 64)


def test_a_full_disk_has_the_picture_kept_elsewhere(run, room, tmp_path):
    small, temporary = tmp_path / "small", tmp_path / "tmp"
    small.mkdir()
    temporary.mkdir()
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", small], capture_output=True)
    if mounted.returncode != 0:
        pytest.skip("no small disk can be had")
    try:
        words = ("-o", small / "a.exr", "-o", tmp_path / "b.png", "--res", 200, 100, "--spp", 1, "-q")
        line = error_of(run("render", room, *words, cwd=small, env={**os.environ, "TMPDIR": str(temporary)}))
        kept = line.rsplit("kept as ", 1)[1]
        assert pictures.read(kept).shape == (100, 200) and kept.startswith(str(temporary))
        assert list(small.iterdir()) == [] and pictures.png_size(tmp_path / "b.png") == (200, 100)
    finally:
        subprocess.run(["umount", small], check=True)
