"""The pairs measured below e = 1: how beta_0 is found, how uncertain it is, how it is judged."""

import csv
from pathlib import Path

import numpy as np
import pytest

from planarimpact import bodies, lumped, models
from planarimpact.bodies import Material
from stronge1994 import csv_tables, curve_names, plan, reference_data
from stronge1994.figures.inelastic import curves as inelastic
from stronge1994.figures.inelastic import trials as pair_trials
from stronge1994.figures.shared.curves import solving
from stronge1994.judging import compare
from stronge1994.plan import config as configuration

ROOT = Path(__file__).parents[2]
SCHEMA = reference_data.load_yaml(ROOT / "workflow/schemas/source.schema.yaml")
BETA_0 = "tangential_restitution [1]"


@pytest.fixture(scope="module")
def inventory():
    return reference_data.load_all(ROOT / "data", SCHEMA)


@pytest.fixture(scope="module")
def settings(inventory):
    config = configuration.load(ROOT)
    nodes = plan.nodes_of(config, inventory, "inelastic")
    return plan.settings(config, inventory, "inelastic") | solving.read_nodes(nodes)


@pytest.fixture(scope="module")
def measured(inventory):
    return reference_data.arrays(inventory["cornell1999"]["series"]["pairs"])


@pytest.fixture
def lumped_alone(monkeypatch):
    """Only both models of springs, which take no time."""
    monkeypatch.setattr(inelastic, "MODELS", ("lumped.hysteretic", "lumped.unloading-stiffness"))


@pytest.fixture
def one_spread(monkeypatch):
    """Only the spread of impacts by which the pairs are judged."""
    monkeypatch.setattr(inelastic, "SPREADS", {inelastic.WHOLE: inelastic.Spread()})


def beta_0(settings, model="lumped.hysteretic"):
    return inelastic.curves(**settings)[f"{model}, pairs"][BETA_0]


def sigma(settings, model="lumped.hysteretic"):
    name = f"{model}, pairs"
    found = inelastic.curves(**settings)
    up = found[curve_names.shifted(name, pair_trials.PARAMETERS, 1)][BETA_0]
    down = found[curve_names.shifted(name, pair_trials.PARAMETERS, -1)][BETA_0]
    np.testing.assert_allclose((up + down) / 2, found[name][BETA_0], atol=1e-15)
    return up - found[name][BETA_0]


def stiffness_ratios(settings):
    known = (settings[key] for key in ("points", "materials", "uncertainty"))
    return inelastic._stiffness_ratios(*known)


def test_the_fit_has_the_least_squares_of_all():
    rng = np.random.default_rng(1999)
    for _ in range(50):
        beta, e = rng.uniform(1, 6), rng.uniform(0.3, 1)
        x = np.sort(rng.uniform(0.01, 2, 60)) * (1 + e) * beta
        slip = x - (1 + e) * beta
        # Friction never pushes: no rebound lies below the line of slip.
        w = np.maximum(-rng.uniform(-0.5, 0.9) * x + 0.3 * rng.standard_normal(60), slip)
        found = inelastic.tangential_restitution(x, w, beta, e)
        tried = np.append(np.linspace(-2, 2, 4001), found)
        squares = ((w - np.maximum(-tried[:, None] * x, slip)) ** 2).sum(axis=1)
        # Where two minima are equally deep but for the scan, either will do.
        assert squares[-1] <= squares.min() * (1 + 1e-4)


def test_each_material_of_the_pairs_has_moduli(inventory, settings):
    end = "_young_modulus"
    known = [key.removesuffix(end) for key in settings["materials"] if key.endswith(end)]
    used = {inelastic._key(body) for key in ("body", "other") for body in settings["points"][key]}
    assert used == set(known)
    stated = inventory["cornell1999"]["parameters"]
    glass, aluminium = (
        Material(*(stated[f"{name}_{key}"]["value"] for key in ("young_modulus", "poisson_ratio")))
        for name in ("soda_lime_glass", "aluminium")
    )
    row = settings["points"]["pair"].index("glass on aluminium")
    ratios, _ = stiffness_ratios(settings)
    assert ratios[row] == bodies.stiffness_ratio(glass, aluminium)


def test_uncertainty_is_that_of_each_parameter_in_quadrature(lumped_alone, one_spread, settings):
    whole = sigma(settings)
    points, none = settings["points"], [0.0] * len(settings["points"]["pair"])
    stated = settings["uncertainty"]
    exact = dict.fromkeys(stated, 0.0)
    moduli = sigma(
        settings
        | {"points": points | {"restitution_uncertainty": none, "friction_uncertainty": none}}
    )
    e = sigma(settings | {"uncertainty": exact})
    np.testing.assert_allclose(whole**2, moduli**2 + e**2, rtol=1e-9, atol=1e-12)
    lower = np.array(points["restitution"]) - points["restitution_uncertainty"]
    off = beta_0(settings | {"points": points | {"restitution": lower.tolist()}})
    np.testing.assert_allclose(e, np.abs(off - beta_0(settings)), atol=1e-12)
    # Young's moduli have no influence where both bodies have one Poisson's ratio.
    young = sigma(
        settings
        | {
            "uncertainty": {key: value * ("young" in key) for key, value in stated.items()},
            "points": points | {"restitution_uncertainty": none},
        }
    )
    differ = ["glass on aluminium", "acetate on aluminium", "steel on Zerodur"]
    assert [points["pair"][row] for row in np.flatnonzero(young > 1e-6)] == differ


def test_spreads_of_impacts(lumped_alone, settings):
    """Angles become incidences by each pair's own friction, and reach no farther than needed."""
    found = inelastic.curves(**settings)
    points, (ratios, _) = settings["points"], stiffness_ratios(settings)
    soft = points["pair"].index("polyurethane")
    e, mu = points["restitution"][soft], points["friction"][soft]
    end = (1 + e) * 3.5
    ends = {"to 45 deg": 1 / mu, "to 60 deg": np.sqrt(3) / mu}
    ends |= {f"to {share} (1 + e) m2/m1": share * end for share in (0.5, 1.5)}
    assert ends["to 60 deg"] < end
    for words, reach in ends.items():
        share = (np.arange(4000) + 0.5) / 4000
        spread = {words: share * reach}
        spread[f"{words}, by angle"] = np.tan(share * np.arctan(mu * reach)) / mu
        for name, x in spread.items():
            w = lumped.rebound(x, 3.5, ratios[soft], e).velocity
            slope = inelastic.tangential_restitution(x, w, 3.5, e)
            assert found[f"lumped.hysteretic, pairs, {name}"][BETA_0][soft] == pytest.approx(
                slope, abs=2e-3
            )
    farther = found["lumped.hysteretic, pairs, to 1.5 (1 + e) m2/m1"][BETA_0]
    np.testing.assert_allclose(farther, found["lumped.hysteretic, pairs"][BETA_0], atol=0.002)


def test_friction_matters_where_impacts_are_spread_over_the_angle(lumped_alone, settings):
    points = settings["points"]
    more = points | {"friction": [2 * mu for mu in points["friction"]]}
    before, after = (inelastic.curves(**settings | {"points": chosen}) for chosen in (points, more))
    for spread, moved in (("", False), (", to (1 + e) m2/m1, by angle", True)):
        name = f"lumped.hysteretic, pairs{spread}"
        change = np.abs(after[name][BETA_0] - before[name][BETA_0])
        assert (change.max() > 1e-3) == moved


def test_trials_of_the_pairs(measured, lumped_alone, settings):
    """Each makes one choice otherwise; the numbers are those of a plain sum of squares."""
    found = inelastic.curves(**settings)
    trials = pair_trials.trials(found)
    assert len(trials) == 15
    assert configuration.load(ROOT)["significance"] == pair_trials.SIGNIFICANCE

    def fit(words):
        return pair_trials.goodness(found, "lumped.hysteretic", measured, trials[words])

    whole = fit("as judged")
    assert fit("the stated sigmas are two sigmas").value == pytest.approx(4 * whole.value)
    assert fit("without both").degrees == whole.degrees - 2
    assert whole.p < pair_trials.SIGNIFICANCE < fit("without both").p
    soft = measured["pair"] == "polyurethane"
    distance = measured[BETA_0] - found["lumped.hysteretic, pairs"][BETA_0]
    pull = distance / np.hypot(measured[pair_trials.SIGMA], sigma(settings))
    gone = whole.value - fit("without polyurethane").value
    assert gone == pytest.approx(float(pull[soft][0] ** 2))


@pytest.fixture
def judge(inventory, settings, tmp_path):
    """Verdicts on the pairs, of some models."""
    config = configuration.load(ROOT)
    references = plan.references(config, inventory, "inelastic")

    def judged(*titles):
        path = str(tmp_path / "inelastic.csv")
        csv_tables.write(path, inelastic.curves(**settings))
        entries = {title: config["comparisons"][title] for title in titles}
        rows = compare("inelastic", entries, references, path, config["significance"])
        return {row["comparison"]: row for row in rows[1:]}

    return judged


def test_a_repair_of_the_model_as_in_the_paper_is_no_silent_change(
    lumped_alone, one_spread, judge, monkeypatch
):
    """Its difference is known: if it goes away, the entry must go too."""
    title = "inelastic-lumped.hysteretic-pairs"
    assert judge(title)[title]["verdict"] == "unexplained difference"
    original = models.rebound
    monkeypatch.setattr(
        models,
        "rebound",
        lambda model, x, beta, zeta2, e, **_: original(
            "lumped.hysteretic", x, beta, e * e * zeta2, e
        ),
    )
    assert judge(title)[title]["verdict"] == "diverges"


def test_the_trials_have_the_numbers_of_the_gate(
    lumped_alone, one_spread, judge, settings, measured
):
    rows = judge("inelastic-lumped.hysteretic-pairs", "inelastic-lumped.unloading-stiffness-pairs")
    found = inelastic.curves(**settings)
    for row in rows.values():
        model = row["comparison"].removeprefix("inelastic-").removesuffix("-pairs")
        fit = pair_trials.goodness(found, model, measured)
        assert (f"{fit.value:.3g}", f"{fit.p:.2g}") == (row["chi^2"], row["p"])


def test_the_table_is_that_of_the_sources():
    """As the chart and the article print it, down to the digits."""
    with open(ROOT / "data/cornell1999/pairs.csv", newline="", encoding="utf-8") as file:
        rows = {row.pop("pair"): row for row in csv.DictReader(file)}
    assert len(rows) == 11
    assert list(rows["polyurethane"].values())[2:] == [
        "0.60",
        "0.05",
        "0.30",
        "0.02",
        "0.80",
        "0.19",
    ]
    assert list(rows["chrome steel"].values())[2:] == [
        "1.00",
        "0.01",
        "0.54",
        "0.05",
        "0.12",
        "0.00",
    ]
