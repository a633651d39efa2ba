"""A parent for commands that read stages: where the USD library breaks down, it says so in a line and with a status of its own.

The library ends the process on some broken files: its parser runs out of stack, and its views of a file that has changed on disk go nowhere.
No handler inside the process can do anything about that. A fork before anything was loaded costs about a millisecond.
"""

import mmap
import os
import signal
import sys

# What the command line documents for this.
BROKE_DOWN = 3

COMMANDS = ("render", "info", "measure", "report", "goniometer", "map", "bsdf")
CRASHES = ("SIGSEGV", "SIGBUS", "SIGABRT", "SIGILL", "SIGFPE")
FORWARDED = ("SIGINT", "SIGTERM", "SIGHUP", "SIGUSR1", "SIGUSR2")

# A byte that both processes see: whether a stage is being read.
_reading: mmap.mmap | None = None


def reading(is_reading: bool) -> None:
    """Note that a stage is being read, or no more."""
    if _reading is not None:
        _reading[0] = int(is_reading)


def watched(arguments: list[str]) -> int | None:
    """Go on in a child and wait for it: None there, its status in the parent. None at once where there is nothing to watch."""
    global _reading
    if not arguments or arguments[0] not in COMMANDS or not sys.platform.startswith("linux"):
        return None
    _reading = mmap.mmap(-1, 1)
    # Until the render takes it as a wish for a snapshot it must not end the process.
    signal.signal(signal.SIGUSR1, signal.SIG_IGN)
    parent = os.getpid()
    try:
        child = os.fork()
    except OSError:
        # No process can be had: then without.
        return None
    if child == 0:
        _die_with(parent)
        return None
    _forward(child)
    return _status(child, arguments)


def _die_with(parent: int) -> None:
    """Have the system end this process when its parent ends."""
    import ctypes

    set_death_signal = 1
    ctypes.CDLL(None).prctl(set_death_signal, signal.SIGKILL)
    if os.getppid() != parent:
        os._exit(1)


def _forward(child: int) -> None:
    def pass_on(number: int, _frame: object) -> None:
        try:
            os.kill(child, number)
        except ProcessLookupError:
            # It has just ended.
            pass

    for name in FORWARDED:
        signal.signal(getattr(signal, name), pass_on)


def _status(child: int, arguments: list[str]) -> int:
    """Wait for the child; take over its status, or die as it did."""
    _, ended = os.waitpid(child, 0)
    if not os.WIFSIGNALED(ended):
        # Whatever is open belongs to the child, and nothing of Python's own is to be taken apart.
        os._exit(os.WEXITSTATUS(ended))
    number = os.WTERMSIG(ended)
    name = signal.Signals(number).name
    if name in CRASHES and _reading is not None and _reading[0]:
        _say(f"the USD library broke down ({name}) while it read {_stage(arguments)}: the stage is damaged, or was changed while it was read")
        os._exit(BROKE_DOWN)
    if name in CRASHES:
        _say(f"gonio broke down ({name}) over {_stage(arguments)}; this is a defect of gonio")
    elif name == "SIGKILL":
        _say("the system ended the process (SIGKILL), most likely for want of memory")
    os._exit(128 + number)


def _stage(arguments: list[str]) -> str:
    names = [word for word in arguments[1:] if word.lower().endswith((".usd", ".usda", ".usdc", ".usdz"))]
    return names[0] if names else "the stage"


def _say(line: str) -> None:
    try:
        os.write(2, f"gonio: error: {line}\n".encode(errors="backslashreplace"))
    except OSError:
        # Nobody listens.
        pass
