"""What calls take as numbers, for type checkers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol, SupportsFloat

if TYPE_CHECKING:
    from typing import TypeAlias

    from typing_extensions import Buffer

    from ._gonio import Array, Pass

    # Buffers; numpy's arrays and gonio's own, which type checkers know as buffers from Python 3.12 on alone.
    Numbers: TypeAlias = "Buffer | HasArray | Array | Pass"
    # Rows of a 4×4 matrix for column vectors: the translation is in the last column.
    Matrix: TypeAlias = "Sequence[Sequence[SupportsFloat]] | HasArray"


class HasArray(Protocol):
    """What numpy's arrays have in every version of Python."""

    @property
    def __array_interface__(self) -> Mapping[str, Any]:
        """Address, shape and type of the numbers."""
