"""A year of daylight in an office, beside Radiance's coefficients for the same points: `rfluxmtx` for the sky, `rcontrib` for the suns."""

import json
import os
import subprocess
from pathlib import Path

import environments
import measured_by
import numpy as np
import pytest
import radiance_office

pytestmark = [pytest.mark.validate, pytest.mark.timeout(1800)]


@pytest.fixture(scope="module")
def radiance() -> dict[str, str]:
    """The environment in which Radiance's programs run."""
    try:
        python = os.environ.get("GONIO_PEER_RADIANCE") or environments.python_of("radiance")
    except environments.Unavailable as reason:
        pytest.skip(f"no pyradiance: {reason}")
    try:
        package = measured_by.packaged(Path(python))
    except measured_by.Unavailable:
        pytest.skip("no pyradiance in the Python that was named")
    return measured_by.environment(package)


def test_an_office_has_radiances_year(run, radiance, tmp_path):
    (tmp_path / "year.wea").write_text(radiance_office.weather())
    (tmp_path / "office.usda").write_text(radiance_office.stage())
    (tmp_path / "room.rad").write_text(radiance_office.room())
    (tmp_path / "sky.rad").write_text(radiance_office.SKY)
    grid = ("--grid", "/Floor", "--height", 0.8, "--spacing", 0.45, "-m", 2, "--sun-position", "radiance")
    done = run("annual", tmp_path / "office.usda", "--weather", tmp_path / "year.wea", *grid, "-p", 16384, "-q", "--json", timeout=600)
    assert done.returncode == 0, done.stderr
    ours = json.loads(done.stdout)["grids"][0]
    places = "".join("{} {} {} 0 0 1\n".format(*point["position_m"]) for point in ours["points"])
    count = len(ours["points"])

    def shell(line, **options):
        found = subprocess.run(line, shell=True, cwd=tmp_path, env=radiance, capture_output=True, check=False, **options)
        assert found.returncode == 0, found.stderr.decode()[-500:]
        return found.stdout

    flux = f"rfluxmtx -I+ -ab 6 -ad 40000 -lw 5e-6 -faf -y {count} - sky.rad room.rad"
    (tmp_path / "sky.mtx").write_bytes(shell(flux, input=places.encode()))
    shell("gendaymtx -n -D suns.rad -M suns.mod year.wea; oconv room.rad suns.rad > suns.oct")
    (tmp_path / "suns.mtx").write_bytes(shell(f"rcontrib -I+ -ab 0 -y {count} -M suns.mod -faf suns.oct", input=places.encode()))
    files = ("--coefficients", tmp_path / "sky.mtx", "--sun-coefficients", tmp_path / "suns.mtx")
    theirs = json.loads(run("annual-metrics", "--weather", tmp_path / "year.wea", *files, "--json").stdout)["grids"][0]
    print({name: (ours[name], theirs[name]) for name in ("mean_lx", "sda_300_50", "ase_1000_250", "udi_100_3000", "median_daylight_factor")})
    assert ours["mean_lx"] == pytest.approx(theirs["mean_lx"], rel=0.02)
    assert ours["median_daylight_factor"] == pytest.approx(theirs["median_daylight_factor"], rel=0.05)
    assert ours["udi_100_3000"] == pytest.approx(theirs["udi_100_3000"], abs=0.015)
    assert ours["sda_300_50"] == pytest.approx(theirs["sda_300_50"], abs=0.05)
    assert ours["ase_1000_250"] == pytest.approx(theirs["ase_1000_250"], abs=0.03)
    factors = np.array([[point["daylight_factor"] for point in grid["points"]] for grid in (ours, theirs)])
    assert np.sqrt(np.mean((factors[0] / factors[1] - 1) ** 2)) < 0.06
