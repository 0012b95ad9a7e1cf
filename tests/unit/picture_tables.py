"""Tables for pictures: solved coarsely where that is quick, made up where it is not."""

import functools
import importlib
from pathlib import Path

import numpy as np

from stronge1994 import plan, reference_data
from stronge1994.curve_names import name, shifted
from stronge1994.figures.fig5.drawing import LOSSY_RUBBER, MEASURED_ANGLES
from stronge1994.figures.inelastic import drawing as inelastic
from stronge1994.figures.rubber_sphere import drawing as rubber
from stronge1994.figures.stability import drawing as stability
from stronge1994.figures.trade import drawing as trade
from stronge1994.plan import config as configuration

ROOT = Path(__file__).parents[2]
CONFIG = configuration.load(ROOT)
INVENTORY = reference_data.load_all(
    ROOT / "data", reference_data.load_yaml(ROOT / "workflow/schemas/source.schema.yaml")
)
COARSE = {"samples": 41, "tolerance": 1e-2, "loss_tolerance": 1e-2, "uncertainty": {}}
PAPER = tuple(f"fig{number}" for number in range(2, 10))
SOLVED = (*PAPER, "micro_slip", "rod")
X, W = "incidence [mu v2(0)]", "velocity [mu v2(0)]"
RNG = np.random.default_rng(1994)


@functools.cache
def given(figure):
    """Curves, settings and reference series of a figure."""
    settings = plan.settings(CONFIG, INVENTORY, figure)
    settings |= {key: value for key, value in COARSE.items() if key in settings}
    if "continua" in settings:
        settings |= {"continua": settings["continua"] | {"tolerance": 1e-2}}
    if figure in SOLVED:
        curves = importlib.import_module(f"stronge1994.figures.{figure}.curves").curves(**settings)
    else:
        settings, curves = MADE_UP[figure](settings)
    return curves, settings, SERIES.get(figure, {})


def series(axes, x, y, sigma, **more):
    """A reference series as a drawing gets it."""
    values = {"x": np.array(x), "y": np.array(y), "sigma": sigma, "axes": axes, "line": False}
    return values | {"columns": {}, "parameters": {}} | more


def _superball(settings):
    """Two impacts and the flights before, between and after them."""
    path = {
        "place [m]": np.array([-0.4, 0.0, 0.5, 0.3]),
        "height [m]": np.array([0.35, 0.025, 0.675, 0.3]),
        "velocity_x [m/s]": np.array([6.0, 3.6, -0.5, -0.5]),
        "spin_y [rad/s]": np.array([0.0, 140.2, -90.4, -90.4]),
        "regime": np.array(["before", "STICK_SLIP", "STICK_SLIP", "after"]),
    }
    return settings, {"path": path}


def row(model, error, time, **more):
    first = {"model": np.array([model]), "loss": np.array([more.pop("loss", "")])}
    numbers = {"restitution [1]": 1.0, trade.ERROR: error, "time_1 [s]": time}
    numbers |= {"time_100 [s]": time / 5, "time_1000 [s]": time / 9} | more
    numbers |= {trade.SPREAD: 0.2, trade.SPREAD_STICK: 0.03, "scatter_100 [1]": 0.05}
    row = first | {key: np.array([value]) for key, value in numbers.items()}
    return {key: cells for key, cells in row.items() if cells[0] != ""}


def _trade(settings):
    """Models at e = 1."""
    rows = {
        "rigid, e = 1": row("rigid", 0.9, 1e-6),
        "lumped, e = 1": row("lumped", 0.08, 5e-6),
        "continuum, tolerance 1e-5, e = 1": row(
            "continuum", 1e-6, 4e-3, **{"tolerance [mu v2(0)]": 1e-5}
        ),
        "spline of continuum, e = 1": row("spline of continuum", 1e-6, 2e-7),
    }
    for steps in (16.0, 64.0):
        model = "timestep.mindlin"
        rows[f"{model}, {steps:g} steps, e = 1"] = row(
            model, 0.3 + 1 / steps, 1e-5 * steps, **{"steps [1]": steps}
        )
    return settings | {"restitution": [1.0], "batches": [1, 100, 1000]}, rows


def _inelastic(settings):
    """Bands, one contact and three pairs of materials."""
    e, x = np.array([0.5, 0.8, 1.0]), np.linspace(0, 8, 9)
    named = {}
    for i, model in enumerate(inelastic.MODELS):
        pairs = {"pair": np.array(["a", "b", "c"]), inelastic.E: np.array([0.6, 0.9, 0.9])}
        pairs |= {"body": np.array(["a", "b", "c"]), "other": np.array(["a", "c", "c"])}
        beta_0 = np.array([0.3, 0.5, 0.6]) + i / 50
        named[f"{model}, pairs"] = pairs | {inelastic.BETA_0: beta_0}
        for sign in (1, -1):
            off = pairs | {inelastic.BETA_0: beta_0 + 0.01 * sign}
            named[shifted(f"{model}, pairs", inelastic.PARAMETERS, sign)] = off
        for nu in settings["poisson_ratio"]:
            named[f"{model}, {name('nu', nu)}"] = {inelastic.E: e, inelastic.BETA_0: e * nu + i / 9}
        contact = f"{model}, {name('e', settings['contact']['restitution'])}"
        named[contact] = {X: x, W: np.sin(x) + i}
    return settings, named


def _rubber_sphere(settings):
    """Lines and distances of every model, and both halves of two impacts."""
    x = np.linspace(*settings["incidence"], 9)
    named = {
        half: {rubber.X: np.array([0.5, 2.0]), rubber.E_T: np.array([0.6, 0.7]) + sign * 0.1}
        for half, sign in zip(rubber.ALONE, (1, -1), strict=True)
    }
    for i, model in enumerate(rubber.MODELS):
        e = 1.0 if model == rubber.ELASTIC else settings["restitution"]
        named[f"{model}, {name('e', e)}"] = {rubber.X: x, rubber.E_T: np.cos(x) / (2 + i)}
        rms = {rubber.LIMIT: np.array([2.5, 8.5]), rubber.RMS: np.array([0.3, 0.2]) + i / 30}
        named[f"{model}, rms"] = rms
    return settings | {"uncertainty": {"friction_2010": 0.144}}, named


def _stability(settings):
    """Impacts with some digits each."""
    impacts = {
        "omega [Omega]": 10 ** RNG.uniform(-6, 7, 60),
        "restitution [1]": RNG.uniform(0, 1, 60),
        X: 10 ** RNG.uniform(-17, 9, 60),
    }
    digits = {
        f"{kind}_{output} [1]": RNG.uniform(0, 16, 60)
        for kind in stability.KINDS
        for output in stability.OUTPUTS
    }
    return settings, {"impacts": impacts | digits}


MADE_UP = {
    "superball": _superball,
    "trade": _trade,
    "inelastic": _inelastic,
    "rubber_sphere": _rubber_sphere,
    "stability": _stability,
}
RUBBER_COLUMNS = {
    "tangential_before [1]": np.array([0.2, 0.8]),
    "tangential_before_uncertainty [1]": np.array([0.01, 0.02]),
}
SERIES = {
    "fig5": {
        "chung_ooi2011/rebound": series((X, W), [0.5, 2.0], [0.1, -0.5], (0.03, 0.05)),
        MEASURED_ANGLES: series(
            ("angle [deg]", "centre_restitution [1]"),
            [10.0, 25.0],
            [0.7, 0.8],
            (np.full(2, 0.5), np.full(2, 0.02)),
            parameters={"mass_ratio": 3.5, "friction": 0.092},
        ),
        LOSSY_RUBBER: series(
            ("angle [deg]", "tangential_restitution [1]"),
            [11.0, 39.0],
            [0.6, 0.7],
            (0.7, 0.02),
            columns=RUBBER_COLUMNS,
            parameters={"friction": 0.4},
        ),
    },
    "fig8": {
        "lewis_rogers1988/normal_force": series(
            ("angle [deg]", "peak_force [N]"), [10.0, 40.0], [70.0, 50.0], (0.5, 1.0)
        ),
        "stronge1994/peak_angle_mu_0.18": {"value": 44.0},
    },
    "inelastic": {
        "cornell1999/pairs": series(
            (inelastic.E, inelastic.BETA_0),
            [0.6, 0.9, 0.9],
            [0.35, 0.45, 0.6],
            (np.full(3, 0.01), np.full(3, 0.05)),
            columns={"pair": np.array(["a", "b", "c"])},
        )
    },
    "rubber_sphere": {
        rubber.IMPACTS: series(
            ("angle [deg]", rubber.E_T),
            [11.0, 39.0],
            [0.6, 0.7],
            (0.7, 0.02),
            columns=RUBBER_COLUMNS,
            parameters={"friction": 0.4},
        ),
        rubber.STATED: series(
            ("angle [deg]", rubber.E_T),
            [25.0],
            [0.49],
            (np.array([1.0]), np.array([0.01])),
            columns={"ball": np.array(["Cross 2010"])},
            parameters={"friction_2010": 0.65},
        ),
    },
}
