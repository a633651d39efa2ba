"""Dask, which the extra `farm` brings."""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import Any

from .._gonio import Error, UnsupportedError

# Seconds until a scheduler that does not answer is given up.
PATIENCE = 10


def require() -> Any:
    """The package `distributed`; `gonio.UnsupportedError` with the remedy where it is absent."""
    try:
        return importlib.import_module("distributed")
    except ImportError as error:
        raise UnsupportedError(f"rendering on a Dask cluster needs Dask: pip install distributed ({error})") from error


def connect(address: str) -> Any:
    """A client of the scheduler with this address, or the one that a scheduler file tells of; `gonio.Error` where none answers."""
    distributed = require()
    where = {"scheduler_file": address} if Path(address).is_file() else {"address": address}
    try:
        return distributed.Client(**where, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError) as error:
        raise Error(f"no Dask scheduler answers at {address} within {PATIENCE} s ({error or type(error).__name__})") from error
