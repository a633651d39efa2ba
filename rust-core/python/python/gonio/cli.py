"""The console script: hands its arguments to the parser in Rust."""

import os
import sys

from . import _watch
from ._gonio import _main

# 128 + SIGINT, as shells have it.
INTERRUPTED = 130
# What the command line documents for words that cannot be understood.
MISUNDERSTOOD = 2
# Windows and clusters have ends of their own to come to.
CLOSED_IN_ORDER = ("view", "--dask")


def main() -> int:
    """Run the `gonio` command; return its exit status."""
    _open_standard_streams()
    if not _are_text(sys.argv[1:]):
        return MISUNDERSTOOD
    status = _watch.watched(sys.argv[1:])
    if status is not None:
        return status
    status = _main(["gonio", *sys.argv[1:]])
    if status == INTERRUPTED or not any(word.startswith(CLOSED_IN_ORDER) for word in sys.argv[1:]):
        # Somebody waits, all files are closed, and taking the modules of pxr apart takes longer than writing a picture.
        os._exit(status if _flushed() else max(status, 1))
    return status


def _are_text(words: list[str]) -> bool:
    """Whether all words are text, as the parser wants them; one that is not is told. Names of files may be any bytes."""
    for word in words:
        try:
            word.encode()
        except UnicodeEncodeError:
            shown = os.fsencode(word).decode(errors="backslashreplace")
            os.write(2, f"gonio: error: the word '{shown}' has bytes that are no text\n".encode())
            return False
    return True


def _open_standard_streams() -> None:
    """Give closed standard streams a device: the next file that is opened would take the place of one, and get its lines."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            # The lowest free number is this one.
            os.open(os.devnull, os.O_RDWR)


def _flushed() -> bool:
    """Whether all that Python holds of the streams went out."""
    try:
        for stream in (sys.stdout, sys.stderr):
            if stream is not None:
                stream.flush()
    except OSError:
        return False
    return True


if __name__ == "__main__":
    sys.exit(main())
