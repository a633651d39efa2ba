"""Commands that are killed at fixed moments, and what they leave."""

import os
import signal
import subprocess
import time
import xml.etree.ElementTree
import zlib
from pathlib import Path

import numpy as np
import pictures

OLD = b"what stood here before"
# Shares of the time that a whole run takes.
MOMENTS = (0.08, 0.2, 0.32, 0.44, 0.56, 0.66, 0.76, 0.86, 0.93, 0.98)
# As the operating system, a scheduler and a terminal do it.
SIGNALS = ("SIGKILL", "SIGTERM", "SIGINT")
INTERRUPTED = 130
# Longest that one takes to end, seconds; what is being written is written.
LONGEST_END = 300


def heard():
    """Has a child hear what those who started the tests may ignore."""
    for name in ("SIGINT", "SIGTERM", "SIGHUP"):
        signal.signal(getattr(signal, name), signal.SIG_DFL)


def start(line, folder, **options):
    """Starts a command in a folder, in a session of its own."""
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    return subprocess.Popen([str(word) for word in line], cwd=folder, start_new_session=True, preexec_fn=heard, **pipes, **options)


def send(process, name):
    """Sends a signal to a command; Ctrl-C goes to all of its processes at once."""
    try:
        if name == "SIGINT":
            os.killpg(process.pid, signal.SIGINT)
        else:
            process.send_signal(getattr(signal, name))
    except ProcessLookupError:
        # It has just ended.
        pass


def ended(process, name):
    """Waits for a command that got a signal and for its children; gives what it said."""
    _, said = process.communicate(timeout=LONGEST_END)
    wait_for_session(process.pid)
    said = said.decode(errors="replace")
    assert "panicked" not in said and "broke down" not in said, said
    if "Traceback" in said:
        # Before the module is loaded the interruption is Python's own.
        assert "KeyboardInterrupt" in said and "_main(" not in said, said
    number = getattr(signal, name)
    assert process.returncode in (0, 1, INTERRUPTED, -number, 128 + number), (process.returncode, said)
    return said


def wait_for_session(session):
    """Waits until no process of a session is alive."""
    end = time.monotonic() + LONGEST_END
    while any(is_alive(path, session) for path in Path("/proc").glob("[0-9]*/stat")):
        assert time.monotonic() < end, "a child goes on"
        time.sleep(0.005)


def child_of(process):
    """Waits until a command has a child that renders; gives its number. How long that takes depends on what else runs."""
    end, children = time.monotonic() + LONGEST_END, Path(f"/proc/{process.pid}/task/{process.pid}/children")
    while not (numbers := children.read_text().split()):
        assert process.poll() is None and time.monotonic() < end, "it has no child"
        time.sleep(0.05)
    (child,) = map(int, numbers)
    while is_starting(child):
        assert process.poll() is None and time.monotonic() < end, "its child does not begin"
        time.sleep(0.05)
    return child


def is_starting(child):
    """Whether a process has not yet a thread beside its first: renders have."""
    return len(list(Path(f"/proc/{child}/task").glob("[0-9]*"))) < 2


def is_alive(path, session):
    try:
        state, _, _, of_session = path.read_text().rpartition(")")[2].split()[:4]
    except OSError:
        return False
    return int(of_session) == session and state not in "ZX"


def killed(line, folder, seconds, name):
    """Starts a command, sends it a signal after so many seconds, and gives how it ended."""
    process = start(line, folder)
    time.sleep(seconds)
    send(process, name)
    ended(process, name)
    return process.returncode


def is_whole(path):
    """Whether a file is one that its reader takes."""
    return READERS[path.suffix](path)


def whole_exr(path):
    return all(np.isfinite(values).any() for values in pictures.read(path).channels.values())


def whole_png(path):
    data, at, kind = path.read_bytes(), 8, b""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    while at < len(data):
        length, kind = int.from_bytes(data[at : at + 4], "big"), data[at + 4 : at + 8]
        end = at + 8 + length
        assert zlib.crc32(data[at + 4 : end]) == int.from_bytes(data[end : end + 4], "big"), "a chunk is damaged"
        at = end + 4
    return at == len(data) and kind == b"IEND"


def whole_jpeg(path):
    data = path.read_bytes()
    return data[:2] == b"\xff\xd8" and data[-2:] == b"\xff\xd9"


def whole_layer(path):
    from pxr import Sdf

    layer = Sdf.Layer.CreateAnonymous(".usda")
    return layer.ImportFromString(path.read_text()) and bool(layer.rootPrims)


def whole_table(path):
    lines = path.read_text().split("\n")
    return len(lines) > 2 and not lines[-1] and len({line.count(",") for line in lines[:-1]}) == 1


def whole_goniogram(path):
    import gonio

    return gonio.goniogram_figures(path.read_bytes(), path.name)["peak_cd"] > 0


def whole_drawing(path):
    return xml.etree.ElementTree.parse(path).getroot().tag.endswith("svg")


def whole_sums(path):
    return path.stat().st_size > 1000


READERS = {
    ".exr": whole_exr,
    ".png": whole_png,
    ".jpg": whole_jpeg,
    ".usda": whole_layer,
    ".csv": whole_table,
    ".ldt": whole_goniogram,
    ".ies": whole_goniogram,
    ".svg": whole_drawing,
    ".sums": whole_sums,
}


def same(first, second):
    """Whether two files hold the same: pictures by their channels, others by their bytes."""
    if first.suffix == ".exr":
        return pictures.same(pictures.read(first), pictures.read(second))
    return first.read_bytes() == second.read_bytes()
