"""A year of daylight in an office: the error of hourly illuminances against processor time, in gonio and in Radiance; and the product with a year's skies.

`annual_bench.py [--weather FILE.epw] [--rounds 3]`; one thread. `GONIO_PEER_RADIANCE` names a Python that has pyradiance, else `.venv-radiance` is taken. Each
engine's errors are against many paths of its own, so that what differs between the two programs does not count.
"""

import argparse
import json
import os
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from statistics import median

TESTS = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(TESTS / "validate"), str(TESTS / "shared")]

import environments  # noqa: E402
import measured_by  # noqa: E402
import numpy  # noqa: E402
import radiance_office  # noqa: E402

GRID = ("--grid", "/Floor", "--height", "0.8", "--spacing", "0.45", "--sun-position", "radiance")
# Hours in which a point has less are left out: their relative errors say nothing.
LEAST_LUX = 50.0
DIVISION = 2
PATHS, PATHS_OF_REFERENCE, FEWEST_PATHS = (512, 2048, 8192, 32768), 524288, 16
# Ambient divisions and the limit of weights that goes with them, as the facts of Radiance's users have it: 0.1 over the divisions.
DIVISIONS, DIVISIONS_OF_REFERENCE = (1250, 5000, 20000), 320000
# The product is taken at this division of the sky as well.
FINE_DIVISION = 4


@dataclass(frozen=True)
class Row:
    """One setting: processor seconds, their median over rounds, and its error."""

    engine: str
    setting: str
    seconds: float
    error: float


class Bench:
    """The office on disk, and the programs."""

    def __init__(self, folder: Path, weather: Path | None):
        self.folder = folder
        python = Path(os.environ.get("GONIO_PEER_RADIANCE") or environments.python_of("radiance"))
        self.environment = measured_by.environment(measured_by.packaged(python))
        self.year = weather.resolve() if weather else folder / "year.wea"
        if not weather:
            self.year.write_text(radiance_office.weather())
        (folder / "office.usda").write_text(radiance_office.stage())
        (folder / "room.rad").write_text(radiance_office.room())
        (folder / "sky.rad").write_text(radiance_office.SKY)
        (folder / "sky4.rad").write_text(radiance_office.SKY.replace("h=r2", f"h=r{FINE_DIVISION}"))
        self.points = ""
        self.count = 0

    def spent(self, command: list[str] | str, given: str = "") -> tuple[float, bytes]:
        """Processor seconds of a command, or of a line of a shell, and of all that it starts, and what it printed."""
        words = ["sh", "-c", command] if isinstance(command, str) else command
        said, seconds = measured_by.run(words, self.folder, self.environment, given)
        return seconds, said

    def gonio(self, paths: int, seed: int) -> tuple[float, numpy.ndarray]:
        """The whole command, and lux by points and hours."""
        command = [sys.executable, "-m", "gonio", "annual", "office.usda", "--weather", str(self.year), *GRID, "-m", str(DIVISION)]
        seconds, said = self.spent([*command, "-p", str(paths), "--seed", str(seed), "-j", "1", "-q", "--json", "-o", "out"])
        places = [point["position_m"] for point in json.loads(said)["grids"][0]["points"]]
        self.points = "".join("{} {} {} 0 0 1\n".format(*place) for place in places)
        self.count = len(places)
        (series,) = (self.folder / "out").glob("*_total.npy")
        return seconds, numpy.load(series)

    def radiance(self, divisions: int) -> tuple[float, numpy.ndarray]:
        """`rfluxmtx` and its product, and lux by points and hours; the seconds are of the first alone."""
        weight = 0.1 / divisions
        flux = f"rfluxmtx -I+ -ab 5 -ad {divisions} -lw {weight:.2g} -faf -y {self.count} - sky.rad room.rad > sky.mtx"
        seconds, _ = self.spent(flux, self.points)
        self.spent(f"gendaymtx -m {DIVISION} {self.weather_of_radiance()} > days.mtx 2> /dev/null")
        self.spent("dctimestep -of sky.mtx days.mtx > year.dat")
        data = (self.folder / "year.dat").read_bytes()
        values = numpy.frombuffer(data[data.index(b"\n\n") + 2 :], numpy.float32).reshape(self.count, -1, 3)
        return seconds, values @ numpy.array([47.4, 119.9, 11.6], numpy.float32)

    def weather_of_radiance(self) -> str:
        """The year as Radiance reads it."""
        if self.year.suffix != ".epw":
            return str(self.year)
        if not (self.folder / "radiance.wea").is_file():
            self.spent(f"epw2wea {self.year} radiance.wea")
        return "radiance.wea"

    def products(self) -> dict[str, float]:
        """Seconds of a year of skies times ready coefficients, `gendaymtx` and reading with it."""
        self.spent(f"rfluxmtx -I+ -ab 1 -ad 500 -lw 2e-4 -faf -y {self.count} - sky4.rad room.rad > fine.mtx", self.points)
        ours = [sys.executable, "-m", "gonio", "annual-metrics", "--weather", str(self.year), "--coefficients", "fine.mtx", "--json"]
        version = [sys.executable, "-m", "gonio", "--version"]
        days = f"gendaymtx -of -m {FINE_DIVISION} {self.weather_of_radiance()} > fine_days.mtx 2> /dev/null"
        return {
            "gonio annual-metrics": self.spent(ours)[0],
            "of it starting Python": self.spent(version)[0],
            "gendaymtx": self.spent(days)[0],
            "dctimestep": self.spent("dctimestep -of fine.mtx fine_days.mtx > fine_year.dat")[0],
        }


def error(series: numpy.ndarray, reference: numpy.ndarray) -> float:
    """Root mean square of the relative deviations of all hours of all points that have light."""
    bright = reference > LEAST_LUX
    return float(numpy.sqrt(numpy.mean((series[bright] / reference[bright] - 1.0) ** 2)))


def rows(bench: Bench, rounds: int) -> list[Row]:
    """All settings; engines take turns."""
    _, ours = bench.gonio(PATHS_OF_REFERENCE, 1000)
    _, theirs = bench.radiance(DIVISIONS_OF_REFERENCE)
    print(f"means of all hours: gonio {ours.mean():.2f} lx, Radiance (suns in patches) {theirs.mean():.2f} lx", flush=True)
    plain = median(bench.gonio(FEWEST_PATHS, turn)[0] for turn in range(rounds))
    found = [Row("gonio", f"-p {FEWEST_PATHS}", plain, float("nan"))]
    taken: dict[tuple[str, int], list[tuple[float, float]]] = {}
    for turn in range(rounds):
        for paths in PATHS:
            seconds, series = bench.gonio(paths, turn)
            taken.setdefault(("gonio", paths), []).append((seconds, error(series, ours)))
        for divisions in DIVISIONS:
            seconds, series = bench.radiance(divisions)
            taken.setdefault(("Radiance", divisions), []).append((seconds, error(series, theirs)))
    for (engine, setting), made in taken.items():
        found.append(Row(engine, f"{'-p' if engine == 'gonio' else '-ad'} {setting}", *(median(part) for part in zip(*made, strict=True))))
    return found


def main() -> int:
    """Prints the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--weather", type=Path, help="an EPW or WEA file; a made year without it")
    parser.add_argument("--rounds", type=int, default=3, help="runs of each setting, in turns")
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        bench = Bench(Path(name), asked.weather)
        made = rows(bench, asked.rounds)
        plain = made[0].seconds
        for row in made:
            beyond = f", {row.seconds - plain:6.2f} s beyond the fewest paths" if row.engine == "gonio" else ""
            print(f"{row.engine:9} {row.setting:12} {row.seconds:7.2f} s{beyond}, error {100 * row.error:.2f} %")
        for what, seconds in bench.products().items():
            print(f"{what:24} {seconds:6.2f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
