"""Commands that are killed: a target is the old file or a whole one, and the next run gives the bits of an undisturbed one and leaves nothing else."""

import os
import re
import shutil
import signal
import subprocess
import time

import killing
import pictures
import pytest

pytestmark = [pytest.mark.validate, pytest.mark.timeout(3600)]

LAMP = """
def Xform "Luminaire"
{
    def DiskLight "Face"
    {
        float inputs:radius = 0.1
        double gonio:photometry:quantity = 1000
        token gonio:photometry:unit = "lm"
    }
}
"""
PICTURE = "render stage.usda --res 160 120 --aov color,normal,sample_count -q"
KEPT = "--checkpoint c.sums --checkpoint-every 0 --resume"
# The command line of each, run in a folder that holds stage.usda; what it writes; and what it makes beside that.
COMMANDS = {
    "render": (f"{PICTURE} --spp 96 -o a.exr -o a.png -o a.jpg {KEPT}", "a.exr a.png a.jpg", "c.sums"),
    "render light": (f"{PICTURE} --spp 96 --integrator light -o a.exr -o a.png {KEPT}", "a.exr a.png", "c.sums"),
    "sequence": (
        f"{PICTURE} --spp 32 -f 1:3 -o a.#.exr -o a.#.png {KEPT.replace('c.sums', 'c.#.sums')}",
        "a.1.exr a.1.png a.2.exr a.2.png a.3.exr a.3.png",
        "c.1.sums c.2.sums c.3.sums",
    ),
    "part": (f"{PICTURE} --spp 192 --part 2/3 {KEPT}", "", "c.sums"),
    "merge": ("merge 1.sums 2.sums 3.sums -q -o a.exr -o a.png", "a.exr a.png", "1.sums 2.sums 3.sums"),
    "measure": ("measure stage.usda --grid /Floor --spacing 0.25 --spp 2048 --json --csv a.csv -o a.png -q", "a.csv a.png", ""),
    "map": ("map stage.usda --prim /Floor --texel 0.03 --paths 8M --error 0% -q -o a.usda -o a.png -w 640", "a.usda a.png", ""),
    "goniometer": (
        "goniometer stage.usda --luminaire /Luminaire --rays 10M --error 0 --json -o a.ldt -o a.ies --csv a.csv --polar a.svg",
        "a.ldt a.ies a.csv a.svg",
        "",
    ),
}
# What no two runs say alike: the seconds of `map`, and those of the goniometer's JSON.
TIMES = re.compile(r' in [\d.]+ s;|"seconds":[\d.]+,')
# Where what was computed before a kill is kept.
RESUMED = ("render", "render light", "sequence", "part")


class Case:
    """A command, and what it gives undisturbed."""

    def __init__(self, name, command, folder):
        words, targets, others = COMMANDS[name]
        self.line, self.targets = [*command, *words.split()], targets.split()
        self.names = {"stage.usda", *self.targets, *others.split()}
        self.folder, self._template = folder / "whole", folder / "template"
        self._template.mkdir()
        pictures.stage(self._template / "stage.usda", pictures.ROOM, pictures.MOVING, pictures.camera(), LAMP if name == "goniometer" else "")
        if name == "merge":
            for number in (1, 2, 3):
                part = f"{PICTURE} --res 1024 768 --spp 4 --part {number}/3 --checkpoint {number}.sums"
                subprocess.run([*command, *part.split()], cwd=self._template, check=True, timeout=900)
        self.begin(folder / "first")
        self.run(folder / "first")
        self.begin(self.folder)
        start = time.monotonic()
        self.told = self.run(self.folder)
        self.seconds = time.monotonic() - start
        for target in self.names - {"stage.usda"}:
            assert killing.is_whole(self.folder / target) and killing.same(self.folder / target, folder / "first" / target), target

    def begin(self, folder):
        """Makes a folder with what the command wants, and old files where it writes."""
        shutil.copytree(self._template, folder)
        for target in self.targets:
            (folder / target).write_bytes(killing.OLD)

    def run(self, folder):
        """Runs the command to its end; gives its standard output without the time that it took."""
        done = subprocess.run(self.line, cwd=folder, capture_output=True, text=True, timeout=900)
        assert done.returncode == 0 and not done.stderr, done.stderr
        assert {path.name for path in folder.iterdir()} == self.names
        return TIMES.sub("", done.stdout)

    def check_targets(self, folder, name):
        """Each is the old file or a whole one; what cannot write at its end has the undisturbed run's."""
        for target in self.targets:
            path = folder / target
            if path.read_bytes() != killing.OLD:
                assert killing.is_whole(path), target
                assert name != "SIGKILL" or killing.same(path, self.folder / target), target

    def check_next_run(self, folder):
        """The next run gives the same bits and nothing else."""
        told = self.run(folder)
        assert told == self.told
        for target in self.targets:
            assert killing.same(folder / target, self.folder / target), target


@pytest.fixture(scope="module")
def cases(command, tmp_path_factory):
    known = {}

    def find(name):
        if name not in known:
            known[name] = Case(name, command, tmp_path_factory.mktemp(name.replace(" ", "_")))
        return known[name]

    return find


@pytest.mark.parametrize("sent", killing.SIGNALS)
@pytest.mark.parametrize("name", COMMANDS)
def test_kills_at_fixed_moments(cases, tmp_path, name, sent):
    case, statuses = cases(name), []
    for number, moment in enumerate(killing.MOMENTS):
        folder = tmp_path / str(number)
        case.begin(folder)
        statuses.append(killing.killed(case.line, folder, moment * case.seconds, sent))
        case.check_targets(folder, sent)
        case.check_next_run(folder)
        shutil.rmtree(folder)
    # The moments lie within the run.
    assert sum(status != 0 for status in statuses) >= len(killing.MOMENTS) // 2, statuses


@pytest.mark.parametrize("name", RESUMED)
def test_one_render_that_is_killed_at_every_moment(cases, tmp_path, name):
    case, folder = cases(name), tmp_path / "all"
    case.begin(folder)
    for number, moment in enumerate(reversed(killing.MOMENTS)):
        killing.killed(case.line, folder, moment * case.seconds, killing.SIGNALS[number % len(killing.SIGNALS)])
        for target in case.targets:
            assert (folder / target).read_bytes() == killing.OLD or killing.is_whole(folder / target), target
    case.check_next_run(folder)


def has_bytes(path):
    """Whether a file is there and not empty; it may be gone between two looks."""
    try:
        return path.stat().st_size > 0
    except FileNotFoundError:
        return False


def killed_while_writing(command, folder, name, sent):
    """Kills a render as soon as the bytes of a file grow beside its target; gives whether it was writing."""
    large = "--res 2400 2400 --spp 1 --aov color,normal,P,albedo,depth,illuminance -q"
    process = killing.start([*command, "render", "stage.usda", "-o", name, *large.split()], folder)
    while process.poll() is None:
        if any(has_bytes(path) for path in folder.glob("*.part")):
            killing.send(process, sent)
            killing.ended(process, sent)
            return True
        time.sleep(0.0005)
    killing.ended(process, sent)
    return False


@pytest.mark.parametrize("sent", killing.SIGNALS)
@pytest.mark.parametrize("name", ["a.exr", "a.png"])
def test_kills_while_a_picture_is_written(command, run, tmp_path, name, sent):
    pictures.room(tmp_path / "stage.usda")
    (tmp_path / name).write_bytes(killing.OLD)
    assert killed_while_writing(command, tmp_path, name, sent), "it was never seen writing"
    assert (tmp_path / name).read_bytes() == killing.OLD or killing.is_whole(tmp_path / name)
    done = run("render", "stage.usda", "-o", name, "--res", 16, 16, "--spp", 1, cwd=tmp_path)
    assert done.returncode == 0 and killing.is_whole(tmp_path / name), done.stderr
    assert {path.name for path in tmp_path.iterdir()} == {"stage.usda", name}, "what was being written is left over"


def test_a_child_that_the_system_ends(command, tmp_path):
    """As where memory runs out: the parent tells it in one line, and old files stay."""
    pictures.room(tmp_path / "stage.usda")
    (tmp_path / "a.exr").write_bytes(killing.OLD)
    process = killing.start([*command, *"render stage.usda -o a.exr --res 256 256 --spp 65536 -q".split()], tmp_path)
    os.kill(killing.child_of(process), signal.SIGKILL)
    said = killing.ended(process, "SIGKILL")
    assert process.returncode == 137 and said.count("\n") == 1 and "SIGKILL" in said
    assert (tmp_path / "a.exr").read_bytes() == killing.OLD
    assert {path.name for path in tmp_path.iterdir()} == {"stage.usda", "a.exr"}
