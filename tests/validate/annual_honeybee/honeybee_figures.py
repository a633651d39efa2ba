"""Honeybee's figures of a year of illuminances: run by a Python that has `honeybee-radiance-postprocess`.

    python honeybee_figures.py TASK.json OUT.json

A task names the folder of `results` and what is asked for: `schedule` (0 or 1 for each hour; without it honeybee's own), `blinds` (honeybee operates
the light paths with two states), `daylight_hours` (EN 17037 for a weather file). Others stand alone: `calendar` (arrays of a year with 29 February)
and `suns` (of a weather file, by ladybug).
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy
from honeybee_radiance_postprocess.annual import schedule_to_hoys
from honeybee_radiance_postprocess.en17037 import en17037_compute
from honeybee_radiance_postprocess.ies.lm import dynamic_schedule_direct_illuminance
from honeybee_radiance_postprocess.leed.leed import leed_option_one
from honeybee_radiance_postprocess.metrics import ase_array2d, da_array2d
from honeybee_radiance_postprocess.results.annual_daylight import AnnualDaylight
from honeybee_radiance_postprocess.util import filter_array2d
from ladybug.analysisperiod import AnalysisPeriod
from ladybug.epw import EPW
from ladybug.sunpath import Sunpath
from ladybug.wea import Wea


def of_points(results: AnnualDaylight, states) -> dict:
    """Per cent of the used hours at each point of the first grid, and the share of points for sDA."""
    da, cda, udi, lower, upper, _ = results.annual_metrics(states=states)
    means, _ = results.average_values(hoys=schedule_to_hoys(results.schedule, as_list=True), states=states)
    named = {"da": da, "cda": cda, "udi": udi, "udi_lower": lower, "udi_upper": upper, "mean": means}
    sda, _ = results.spatial_daylight_autonomy(states=states)
    return {name: numpy.asarray(values[0]).tolist() for name, values in named.items()} | {"sda": float(sda[0])}


def exposure(results: AnnualDaylight) -> dict:
    """ASE in per cent and hours by honeybee's limits: more than 1000 lx, 250 hours or more; and by another number of hours."""
    (ase,), (hours,), _ = results.annual_sunlight_exposure()
    (beyond,), _, _ = results.annual_sunlight_exposure(occ_hours=251)
    return {"ase": float(ase), "ase_beyond_250": float(beyond), "hours": numpy.asarray(hours).tolist()}


def operated(results: AnnualDaylight) -> tuple[dict, dict]:
    """Hours with closed blinds by light path and LEED's summary of two decimals, and the figures with blinds."""
    states, failing, _ = dynamic_schedule_direct_illuminance(results, use_states=True)
    closed = {name: numpy.flatnonzero(path.schedule).tolist() for name, path in states.dynamic_schedule.items()}
    summary = leed_option_one(results, use_states=True)[0]
    leed = {name: float(summary[name]) for name in ("sda", "ase")}
    return {"closed": closed, "failing": failing, "leed": leed}, of_points(results, states)


def provision(results: AnnualDaylight, weather: str) -> dict:
    """Per cent of the points that have EN 17037's illuminances in half of the daylight hours, and whether that is enough."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "honeybee_radiance", "schedule", "epw-to-daylight-hours", weather, "--folder", folder, "--name", "half"]
        subprocess.run(command, check=True)
        results.schedule = [int(value) for value in (Path(folder) / "half.csv").read_text().split()]
    grid = results.grids_info[0]
    array = filter_array2d(results._array_from_states(grid, zero_array=True), results.occ_mask)
    found = en17037_compute(array, grid)["target_types"]
    return {name: {level: [values["sda"], bool(values["passes"])] for level, values in kind["levels"].items()} for name, kind in found.items()}


def calendar(total: str, direct: str, is_leap_year: bool) -> dict:
    """Used hours of 8 to 18 by ladybug's calendar, and what honeybee's functions of arrays make of a year that its classes do not take."""
    used = numpy.zeros(len(AnalysisPeriod(is_leap_year=is_leap_year).hoys), bool)
    used[numpy.array(AnalysisPeriod(st_hour=8, end_hour=17, is_leap_year=is_leap_year).hoys, int)] = True
    da = da_array2d(numpy.load(total)[:, used])
    ase, hours = ase_array2d(numpy.load(direct)[:, used], occ_hours=251)
    return {"used": int(used.sum()), "da": da.tolist(), "ase": float(ase), "hours": hours.tolist()}


def suns(weather: str) -> dict:
    """Altitudes and azimuths in degrees in the middle of each hour, azimuths clockwise from north, and the normal illuminance in lx."""
    epw = EPW(weather)
    path = Sunpath.from_location(epw.location)
    all_suns = [path.calculate_sun_from_hoy(hour + 0.5) for hour in range(8760)]
    _, normal, _, _ = Wea.from_epw_file(weather).estimate_illuminance_components(epw.dew_point_temperature)
    return {"altitude": [sun.altitude for sun in all_suns], "azimuth": [sun.azimuth for sun in all_suns], "normal": list(normal.values)}


def main(task: str, out: str) -> None:
    with open(task) as file:
        asked = json.load(file)
    if "calendar" in asked:
        found = calendar(*asked["calendar"])
    elif "suns" in asked:
        found = suns(asked["suns"])
    else:
        results = AnnualDaylight(asked["results"], schedule=asked.get("schedule"))
        found = {"used": int(results.total_occ), **of_points(results, None), **exposure(results)}
        if asked.get("blinds"):
            found["blinds"], found["with_blinds"] = operated(results)
        if asked.get("daylight_hours"):
            found["en17037"] = provision(results, asked["daylight_hours"])
    with open(out, "w") as file:
        json.dump(found, file)


if __name__ == "__main__":
    main(*sys.argv[1:3])
