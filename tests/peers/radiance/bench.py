"""Illuminances of two rooms in Radiance and in gonio, error against processor time: `bench.py [--rounds 3] [--write-docs]`.

`GONIO_PEER_RADIANCE` names a Python that has pyradiance; without it `.venv-radiance` is taken, and made where it is missing.
"""

import argparse
import os
import sys
import tempfile
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[2] / "validate")]

import environments  # noqa: E402
import equal_error  # noqa: E402
import measured_by  # noqa: E402
import pictured  # noqa: E402
import reference  # noqa: E402
import settings  # noqa: E402
import usd_stage  # noqa: E402

OUT = Path(__file__).resolve().parents[3] / "out" / "peers"


def parsed() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(description="Illuminances of two rooms in Radiance and in gonio: error against processor time.")
    parser.add_argument("--rounds", type=int, default=3, help="runs of each setting, the settings taking turns")
    parser.add_argument("--most-samples", type=int, default=settings.SAMPLES[-1], help="gonio's settings go up to so many samples a point")
    most = len(settings.WITHOUT_CACHE)
    parser.add_argument("--most-settings", type=int, default=most, help="of each of Radiance's curves, from the quick end")
    parser.add_argument("--reference-samples", type=int, default=262144, help="samples a point of a run of gonio for the reference")
    parser.add_argument("--reference-seeds", type=int, default=8, help="such runs, 4 or more")
    parser.add_argument("--tracer-paths", type=int, default=65536, help="paths a point of the independent tracer")
    parser.add_argument("--write-docs", action="store_true", help="put the figures into docs/radiance.md and draw docs/radiance.svg")
    asked = parser.parse_args()
    if asked.reference_seeds < 4 or asked.rounds < 1 or asked.most_settings < 1:
        parser.error("--reference-seeds must be 4 or more, --rounds and --most-settings 1 or more")
    return asked


def rows_of(asked: argparse.Namespace, stage: Path, peer: measured_by.Radiance, known: reference.Reference) -> list[equal_error.Row]:
    """Every setting's figures."""
    chosen = settings.settings(asked.most_samples, asked.most_settings)
    taken: list[list[measured_by.Measured]] = [[] for _ in chosen]
    for turn in range(asked.rounds):
        for setting, made in zip(chosen, taken, strict=True):
            made.append(settings.measured(setting, stage, peer, turn + 1))
            say(f"round {turn + 1}: {setting.curve} {setting.options}: {made[-1].seconds:.2f} s")
    return [equal_error.row(setting, made, known.lux) for setting, made in zip(chosen, taken, strict=True)]


def conditions(asked: argparse.Namespace, peer: measured_by.Radiance) -> str:
    """What to know of the figures."""
    return (
        f"{peer.version}; one thread, user and system time; rounds: {asked.rounds}; load of the machine at the end: {os.getloadavg()[0]:.1f} on"
        f" {os.cpu_count()} processors. `ies2rad` and `oconv` took {peer.preparation:.2f} s, which no figure has in it."
    )


def say(line: str) -> None:
    """A word on how far it is."""
    print(line, file=sys.stderr, flush=True)


def main() -> int:
    """Runs it all; 1 where the reference is none because gonio and the tracer do not agree."""
    asked = parsed()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        try:
            python = os.environ.get("GONIO_PEER_RADIANCE") or environments.python_of("radiance")
            peer = measured_by.radiance(Path(python), folder)
        except (environments.Unavailable, measured_by.Unavailable) as reason:
            say(f"Radiance is left out: {reason}")
            return 0
        stage = usd_stage.write(folder)
        say("reference")
        known = reference.made(stage, asked.reference_samples, asked.reference_seeds, asked.tracer_paths)
        rows = rows_of(asked, stage, peer, known)
    found = pictured.text(known, rows, equal_error.equals(rows), conditions(asked, peer))
    print(found)
    OUT.mkdir(parents=True, exist_ok=True)
    (OUT / "radiance.svg").write_text(pictured.drawn(rows), encoding="utf-8")
    if asked.write_docs:
        pictured.write_docs(found, rows)
    return 0 if all(each.holds for each in known.agreements.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
