"""The console script: hands its arguments to the parser in Rust."""

import sys

from ._gonio import _main


def main() -> int:
    """Run the `gonio` command; return its exit status."""
    return _main(["gonio", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
