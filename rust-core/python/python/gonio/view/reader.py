"""The process that reads stages for a window: the USD library ends its process over some broken files, and holds Python's lock meanwhile.

It takes a line of JSON on its standard input for each stage, and answers with lines of JSON. The scene goes through a file.
"""

from __future__ import annotations

import contextlib
import json
import os
import signal
import sys
from collections.abc import Iterator
from typing import Any, TextIO

from .._gonio import Error, _files_of_stage, _view_scene


def main() -> None:
    """Reads what is asked for until the window closes the line."""
    # Ctrl-C is the window's, which then closes the line.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    # Libraries that print must not answer.
    os.dup2(2, 1)
    try:
        import pxr.Usd  # noqa: F401  (it takes half a second, which passes before the first stage is asked for)
    except ImportError:
        # The answer to the first stage tells what is missing.
        pass
    for line in sys.stdin:
        answer(json.loads(line), answers)


def answer(asked: dict[str, Any], answers: TextIO) -> None:
    """Reads a stage, tells of it, and then tells its files, which takes longer."""
    try:
        scene, about = _view_scene(asked["words"], asked["folder"], asked["frame"])
        scene.save(asked["scene"])
    except (Error, OSError, UnicodeError) as error:
        _say(answers, {"error": str(error)})
        return
    told = json.loads(about)
    _say(answers, told)
    if asked["files"]:
        _say(answers, {"files": files(told["inputs"])})


def files(inputs: list[str]) -> list[str]:
    """Absolute paths of all files that the inputs are made of."""
    found = dict.fromkeys(os.path.abspath(path) for path in inputs)
    with _silence():
        for path in inputs:
            try:
                found.update(dict.fromkeys(os.path.abspath(name) for name in _files_of_stage(path)))
            except (Error, OSError):
                # A table of the weather is no stage, and a broken one tells nothing.
                continue
    return [path for path in found if os.path.exists(path)]


@contextlib.contextmanager
def _silence() -> Iterator[None]:
    """Lets the library not say once more what it misses: the scene's messages have told."""
    errors, nowhere = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 2)
    try:
        yield
    finally:
        os.dup2(errors, 2)
        os.close(errors)
        os.close(nowhere)


def _say(answers: TextIO, words: dict[str, Any]) -> None:
    answers.write(json.dumps(words) + "\n")
    answers.flush()


if __name__ == "__main__":
    main()
