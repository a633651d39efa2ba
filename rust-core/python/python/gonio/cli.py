"""The console script: hands its arguments to the parser in Rust."""

import os
import sys

from . import _watch
from ._gonio import _main

# 128 + SIGINT, as shells have it.
INTERRUPTED = 130
# Windows and clusters have ends of their own to come to.
CLOSED_IN_ORDER = ("view", "--dask")


def main() -> int:
    """Run the `gonio` command; return its exit status."""
    status = _watch.watched(sys.argv[1:])
    if status is not None:
        return status
    status = _main(["gonio", *sys.argv[1:]])
    if status == INTERRUPTED or not any(word.startswith(CLOSED_IN_ORDER) for word in sys.argv[1:]):
        # Somebody waits, all files are closed, and taking the modules of pxr apart takes longer than writing a picture.
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)
    return status


if __name__ == "__main__":
    sys.exit(main())
