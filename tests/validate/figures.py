"""Measured figures of the validation suites: each test records its rows, and `lighting/page.py` makes `docs/validation.md` of them."""

import dataclasses
import json
import re
from dataclasses import dataclass
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[2] / "out" / "validation"


@dataclass(frozen=True)
class Row:
    """One case: what was compared with what at how many points, and how far apart both were, relative unless `unit` says otherwise.

    `largest` is the largest deviation of a point and `limit` what it may be; `mean` is the mean deviation of all points and `uncertainty` half
    the width of its confidence interval (None where nothing is random).
    """

    section: str
    case: str
    reference: str
    points: int
    largest: float
    limit: float
    mean: float | None = None
    uncertainty: float | None = None
    unit: str = "relative"

    @property
    def holds(self) -> bool:
        """Whether the figures are within their limits; with a mean, whether it is no further from zero than noise explains."""
        return self.largest <= self.limit and (self.mean is None or self.uncertainty is None or abs(self.mean) <= self.uncertainty)


def record(row: Row) -> None:
    """Keeps a row for the page, in the place of an older one of the same case."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    name = re.sub(r"[^a-z0-9]+", "-", f"{row.section} {row.case}".lower()).strip("-")
    (FOLDER / f"{name}.json").write_text(json.dumps(dataclasses.asdict(row)))


def recorded() -> list[Row]:
    """All rows."""
    return [Row(**json.loads(path.read_text())) for path in FOLDER.glob("*.json")]


def check(row: Row) -> None:
    """Records the row and fails where it does not hold."""
    record(row)
    print(row)
    assert row.holds, row
