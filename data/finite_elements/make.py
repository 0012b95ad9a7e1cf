"""Oblique impacts of an elastic-perfectly-plastic sphere by finite elements: every series.

    python data/finite_elements/make.py           runs what is missing, and writes every series
    python data/finite_elements/make.py --check   elastic head-on impacts against Hertz

impact.cpp is compiled on demand, by a C++ compiler named c++. `runs.csv` has a row for each run. A
run that failed leaves no row, so it is tried again next time. The pushed contacts run again if
`pushed.csv` is not there.
"""

import argparse
import functools
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

HERE = Path(__file__).resolve().parent
RUNS, SCALES, PUSHED = (HERE / name for name in ("runs.csv", "scales.csv", "pushed.csv"))

# In units R = E* = 1 and 1 for the approach that the impact would reach without yielding, the yield
# stress is the only group that sets e. So the yield parameter is sigma_y/E* sqrt(R/delta_elastic).
ELASTIC = 1e9
# Elements across the contact radius, and steps of time for each of them.
ACROSS, STEPS_PER_ELEMENT = 10, 400
FINE = 15
RESTITUTIONS = (0.97, 0.92, 0.87, 0.81, 0.72, 0.63, 0.55, 0.47, 0.40)
INCIDENCES = (0.3, 0.7, 1.2, 2, 3, 4, 5)
FEW = (0.7, 1.2, 2, 3)
BETA = 3.5
# Coarse head-on runs, from which the yield parameter for a wanted e is interpolated.
COARSE = dict(contact="mirror", element="one_point", across=6, steps=2400, mu=0.1, x=0.0)
COARSE_YIELDS = (0.4, 0.3, 0.24, 0.19, 0.15, 0.12, 0.095, 0.075, 0.06, 0.045, 0.035, 0.025)
# The far ends of the mesh, in largest radii of contact.
EXTENT = 10
# Yield parameters of the runs that fixed the constant of `continuum.rebound(loss="plastic")`, for
# e = 0.63, 0.55, 0.46. All other runs judge it.
CALIBRATION = (0.06992, 0.04988, 0.03441)
# Pushed contacts: restitutions that are wanted; speed over that of the impact, so small that the
# force is in proportion to it; places over the largest approach; half the width of the smoothing.
PUSHED_RESTITUTIONS = (1, 0.81, 0.66, 0.55, 0.46)
PUSH = 0.01
PLACES = np.arange(4, 20) / 20
NEAR = 0.06

KEY = ["contact", "element", "across", "steps", "nu", "hardening", "mu", "x", "yield"]
OUT = {
    "restitution": "restitution", "velocity": "velocity", "defect": "energy_defect",
    "contact_time": "contact_time", "radius": "largest_radius", "over_yield": "approach_over_yield",
    "plastic": "plastic_energy", "friction": "friction_energy", "damping": "damping_energy",
    "residual": "residual_energy", "seconds": "seconds",
}  # fmt: skip
# Columns of the series.
X, W, E = "incidence [mu v2(0)]", "velocity [mu v2(0)]", "restitution [1]"
MU, NU = "friction [1]", "poisson_ratio [1]"
APPROACH, SHARE = "approach [delta_max]", "share_of_elastic_force [1]"
# Same contact, body and friction: such runs differ by incidence, element and mesh alone.
CONTACT = ["nu", "hardening", "mu", "yield"]

Case = dict[str, Any]


@functools.cache
def executable() -> str:
    """Path of the compiled kernel; compiled anew where the source has changed."""
    source = HERE / "impact.cpp"
    folder = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "finite_elements"
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"impact-{source.stat().st_mtime_ns}"
    if not path.exists():
        unfinished = path.with_suffix(f".{os.getpid()}")
        flags = ["-O3", "-march=native", "-ffast-math", "-std=c++17"]
        subprocess.run(["c++", *flags, str(source), "-o", str(unfinished)], check=True)
        unfinished.replace(path)
    return str(path)


def impact(case: Case, *, pushed: float = 0.0, history: str = "none") -> dict[str, float]:
    """One run of the kernel; `case` has a guess of the largest radius and of the contact time."""
    given = {"extent": EXTENT} | case | {"pushed": pushed, "history": history}
    arguments = [f"{name}={value}" for name, value in given.items()]
    started = time.perf_counter()
    done = subprocess.run([executable(), *arguments], capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"{' '.join(arguments)}: {done.stderr.strip()}")
    results = dict(line.split(",") for line in done.stdout.split())
    seconds = round(time.perf_counter() - started, 2)
    return {name: float(value) for name, value in results.items()} | {"seconds": seconds}


def append(path: Path, row: Mapping[str, Any]) -> None:
    """Add a row at the end of a table, its header first where it is new."""
    header = not path.exists()
    pd.DataFrame([row]).to_csv(path, mode="a", header=header, index=False, lineterminator="\n")


def plastic_radius(yield_: float) -> float:
    """First guess of the largest radius: all energy into a pressure of 2.8 sigma_y."""
    return max(1.0, (4 * 8 / 15 / (np.pi * 2.8 * yield_)) ** 0.25)


@functools.cache
def scale(nu: float, hardening: float, yield_: float) -> dict[str, float]:
    """Restitution, largest radius and contact time of a coarse head-on impact, kept in a table."""
    key = {"nu": nu, "hardening": hardening, "yield": yield_}
    if SCALES.exists():
        known = pd.read_csv(SCALES)
        found = known[np.logical_and.reduce([known[n] == v for n, v in key.items()])]
        if len(found):
            return found.iloc[0].to_dict()
    run = impact(COARSE | key | {"radius": plastic_radius(yield_), "contact_time": 3.0})
    row = key | {name: run[name] for name in ("restitution", "radius", "contact_time")}
    append(SCALES, row)
    return row


@functools.cache
def yield_for(nu: float, hardening: float, restitution: float) -> float:
    """Yield parameter whose impact has about this restitution."""
    if restitution == 1:
        return ELASTIC
    coarse = [scale(nu, hardening, yield_) for yield_ in COARSE_YIELDS]
    at = np.interp(
        -restitution,
        [-row["restitution"] for row in coarse],
        np.log([row["yield"] for row in coarse]),
    )
    return float(f"{np.exp(at):.4g}")


def case(restitution: float, x: float, **changes: Any) -> Case:
    """Arguments of a run that shall come out with about this restitution."""
    settings: Case = {
        "contact": "mirror", "element": "one_point", "across": ACROSS, "nu": 0.3, "hardening": 0.0,
        "mu": 0.1,
    } | changes  # fmt: skip
    yield_ = yield_for(settings["nu"], settings["hardening"], restitution)
    coarse = scale(settings["nu"], settings["hardening"], yield_)
    # With a little room: the coarse radius jumps by whole elements, and friction widens it.
    return settings | {
        "steps": STEPS_PER_ELEMENT * settings["across"],
        "x": float(x),
        "yield": yield_,
        "radius": round(1.02 * coarse["radius"], 4),
        "contact_time": round(coarse["contact_time"], 4),
    }


def plan() -> Iterator[Case]:
    """All cases of runs.csv, the most wanted ones first."""
    for e in RESTITUTIONS:
        # The last one slides throughout, and must give x - (1 + e) beta, down to e = 0.55.
        for x in (*INCIDENCES, round((1 + e) * BETA + 0.3, 2)):
            yield case(e, x)
    for e in (0.92, 0.81, 0.66, 0.55, 0.40):
        for x in INCIDENCES:
            yield case(e, x, nu=0.45)
    for mu in (0.03, 0.2, 0.4):
        for e in (0.81, 0.55):
            for x in INCIDENCES:
                yield case(e, x, mu=mu)
    for e in (0.87, 0.66, 0.47):
        for changes in ({}, {"across": FINE}, {"element": "b_bar"}):
            for x in FEW:
                yield case(e, x, **changes)
    for x in INCIDENCES:
        yield case(0.66, x, hardening=0.02)
    for nu in (0.3, 0.35, 0.4):
        for mu in (0.1, 0.2, 0.4):
            for x in (*INCIDENCES, 6):
                yield case(1, x, contact="plane", nu=nu, mu=mu)
    for x in (1.2, 3):
        yield case(1, x, contact="plane", nu=0.45, mu=0.4)
    for mu in (0.1, 0.3):
        for e in (0.81, 0.55):
            for x in INCIDENCES:
                yield case(e, x, contact="plane", mu=mu)
    # What the choice of element does, over all e: the largest uncertainty of these tables.
    for e in RESTITUTIONS:
        for x in INCIDENCES:
            yield case(e, x, element="b_bar")
    for e in (0.87, 0.66, 0.47):
        for x in FEW:
            yield case(e, x, element="b_bar", across=FINE)
    for x in (*INCIDENCES, 6):
        yield case(1, x)
    for x in (*INCIDENCES, 6):
        yield case(1, x, contact="plane", mu=0.3)


def run_missing() -> None:
    """All rows that runs.csv lacks."""
    known = pd.read_csv(RUNS)[KEY].itertuples(index=False, name=None) if RUNS.exists() else ()
    done = set(known)
    for settings in plan():
        key = tuple(settings[name] for name in KEY)
        if key in done:
            continue
        try:
            run = impact(settings)
        except RuntimeError as error:
            print("failed:", error, file=sys.stderr)
            continue
        append(RUNS, {n: settings[n] for n in KEY} | {new: run[old] for old, new in OUT.items()})
        done.add(key)
        print(*(f"{name}={settings[name]}" for name in KEY), flush=True)


def push() -> pd.DataFrame:
    """Series `pushed`: head-on impacts while the body moves sideways steadily, the contact stuck.

    The tangential force in loading, over that of an elastic contact at the same approach and
    displacement, integral of 2 a E*/zeta^2 dU with a^2 = R delta; the mean of both element types.
    """
    tables = []
    for wanted in PUSHED_RESTITUTIONS:
        shares, restitutions = [], []
        for element in ("one_point", "b_bar"):
            with tempfile.TemporaryDirectory() as folder:
                path = str(Path(folder) / "history.csv")
                settings = case(wanted, 0.0, element=element)
                restitutions.append(impact(settings, pushed=PUSH, history=path)["restitution"])
                shares.append(share_of_elastic(pd.read_csv(path), settings["nu"]))
        e = np.mean(restitutions)
        columns = {"e": float(f"{e:.2g}"), APPROACH: PLACES, E: round(e, 4)}
        tables.append(pd.DataFrame(columns | {SHARE: np.mean(shares, axis=0).round(4)}))
    return pd.concat(tables, ignore_index=True)


def share_of_elastic(history: pd.DataFrame, nu: float) -> np.ndarray:
    """Tangential force over that of an elastic contact, at `PLACES`.

    Straight lines are fitted to what is near, because nodes that come into contact one ring after
    the other make ripples.
    """
    loading = history.iloc[: int(history["approach"].argmax()) + 1]
    approach, sideways = (np.append(0.0, loading[name]) for name in ("approach", "sideways"))
    stiffness = 2 * np.sqrt(approach) * 2 * (1 - nu) / (2 - nu)
    steps = (stiffness[1:] + stiffness[:-1]) / 2 * np.diff(sideways)
    share = loading["tangential_force"].to_numpy() / np.cumsum(steps)
    at = approach[1:] / approach[-1]
    found = []
    for place in PLACES:
        near = np.abs(at - place) < NEAR
        found.append(np.polyfit(at[near] - place, share[near], 1)[1])
    return np.array(found)


def series(runs: pd.DataFrame) -> dict[str, pd.DataFrame]:
    """The series that follow from runs.csv alone."""
    elastic, mirror = runs["yield"] == ELASTIC, runs["contact"] == "mirror"
    usual = runs["across"] == ACROSS
    return {
        "spheres": _spheres(runs[mirror & ~elastic & usual]),
        "elastic": _elastic(runs[mirror & elastic & usual]),
        "dissimilar": _elastic(runs[~mirror & elastic & usual]),
    }


def _spheres(runs: pd.DataFrame) -> pd.DataFrame:
    """Yielding spheres: the mean of both element types, where both were run."""
    both = runs.groupby([*CONTACT, "x"], as_index=False)[["restitution", "velocity"]].mean()
    tables = []
    for (nu, hardening, mu, yield_), own in both.groupby(CONTACT):
        # The first row: where friction does much work, e falls.
        e = own["restitution"].iloc[0]
        contact = f"nu {nu:g}, mu {mu:g}, e {e:.2f}" + (", hardening" if hardening else "")
        table = pd.DataFrame(
            {
                "set": _set_of(nu, hardening, mu, yield_),
                "contact": contact,
                "run": [f"{contact}, x {x:g}" for x in own["x"]],
                X: own["x"],
                W: own["velocity"].round(5),
                E: own["restitution"].round(5),
                MU: mu,
                NU: nu,
            }
        )
        table.loc[own["x"] > max(INCIDENCES), "set"] = "slip throughout"
        tables.append(table)
    order = ["set", "contact", X]
    return pd.concat(tables).sort_values(order, ignore_index=True)


def _set_of(nu: float, hardening: float, mu: float, yield_: float) -> str:
    """What a contact differs by from those with nu = 0.3, mu = 0.1 and without hardening."""
    if hardening:
        return "hardening"
    if nu != 0.3:
        return f"nu {nu:g}"
    if mu != 0.1:
        return f"mu {mu:g}"
    return "calibration" if yield_ in CALIBRATION else "other restitutions"


def _elastic(runs: pd.DataFrame) -> pd.DataFrame:
    """Elastic spheres."""
    runs = runs.sort_values(["nu", "mu", "x"], ignore_index=True)
    body = "nu " + runs["nu"].map("{:g}".format)
    contact = body + ", mu " + runs["mu"].map("{:g}".format)
    return pd.DataFrame(
        {
            "nu": runs["nu"],
            "contact": contact,
            "run": contact + ", x " + runs["x"].map("{:g}".format),
            X: runs["x"],
            W: runs["velocity"].round(5),
            MU: runs["mu"],
            NU: runs["nu"],
        }
    )


def write(name: str, table: pd.DataFrame) -> None:
    """One series, beside this file."""
    table.to_csv(HERE / f"{name}.csv", index=False, lineterminator="\n")


def make() -> None:
    """Run what is missing, and write every series."""
    run_missing()
    if not PUSHED.exists():
        write("pushed", push())
    for name, table in series(pd.read_csv(RUNS)).items():
        write(name, table)
    for name, number in uncertainty(pd.read_csv(RUNS)).items():
        print(f"{name}: {number:.4f}")


def uncertainty(runs: pd.DataFrame) -> dict[str, float]:
    """What sigma of the velocities rests on: both kinds of element, and finer meshes."""
    runs = runs[(runs["contact"] == "mirror") & (runs["yield"] != ELASTIC)]
    runs = runs[runs["x"] <= max(INCIDENCES)].set_index([*CONTACT, "x"])
    usual, element = runs["across"] == ACROSS, runs["element"]
    one, other = (runs[usual & (element == name)]["velocity"] for name in ("one_point", "b_bar"))
    apart = ((one - other) / 2).dropna()
    finer = []
    for name, coarse in (("one_point", one), ("b_bar", other)):
        fine = runs[(runs["across"] == FINE) & (element == name)]["velocity"]
        finer.append((fine - coarse).dropna())
    change = pd.concat(finer)
    return {
        "half differences of both elements": len(apart),
        "their root mean square": float(np.sqrt(np.mean(apart**2))),
        "the largest": float(apart.abs().max()),
        "finer meshes": len(change),
        "root mean square of their changes": float(np.sqrt(np.mean(change**2))),
        "the largest change": float(change.abs().max()),
        "their mean": float(change.mean()),
    }


def check() -> None:
    """Elastic head-on impacts against Hertz."""
    for changes in ({}, {"across": FINE}, {"element": "b_bar"}):
        run = impact(case(1, 0, **changes))
        print(
            f"{changes}: contact time {run['contact_time'] / 2.9432:.4f}, "
            f"force {run['force'] / (4 / 3):.4f}, approach {run['approach']:.4f} of Hertz; "
            f"e {run['restitution']:.4f}, energy defect {run['defect']:.1e}, {run['seconds']} s"
        )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "--check", action="store_true", help="elastic head-on impacts against Hertz"
    )
    check() if parser.parse_args().check else make()
