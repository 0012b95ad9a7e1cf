"""Bad config, data and modules are refused before any work, in one line.

A start of Snakemake checks what the functions here check, and test_verdict.py more; a few whole
starts show that it does.
"""

import gzip
import shutil
from pathlib import Path

import numpy as np
import pytest

from stronge1994 import reference_data
from stronge1994.ledger import entries
from stronge1994.plan import config as configuration

ROOT = Path(__file__).parents[2]
SCHEMAS = ROOT / "workflow/schemas"
SOURCE_SCHEMA = reference_data.load_yaml(SCHEMAS / "source.schema.yaml")


@pytest.fixture(scope="module")
def ledger():
    schema = reference_data.load_yaml(SCHEMAS / "ledger.schema.yaml")
    return entries.load(ROOT / "data/stronge1994/ledger.yaml", schema)


@pytest.fixture
def check(inventory, ledger, monkeypatch):
    """Check a config as a start of Snakemake does, with other data if need be."""
    monkeypatch.chdir(ROOT)

    def checked(change, data=inventory):
        config = configuration.load()
        config = configuration.with_values(configuration.overridden(config, change))
        configuration.check_config(config, data, ledger)

    return checked


def figure(name, **settings):
    return {"figures": {name: settings}}


def comparison(name, **settings):
    return {"comparisons": {name: settings}}


# Inside braces Snakemake makes texts of numbers and truths; with_values turns them back.
BAD_CONFIG = [
    (figure("fig6", as_printed="perhaps"), "as_printed: 'perhaps' is not of type 'boolean'"),
    ({"stifness_ratio": 1.5}, "'stifness_ratio' was unexpected"),
    ({"figures": {"nothing": {}}}, "figures: .*'nothing' was unexpected"),
    ({"figures": 3}, "figures: 3 is not of type 'object'"),
    (figure("fig5", experiment="maw1976"), "'maw1976' states no .*; needed are mass_ratio"),
    (figure("fig5", sample="3"), "figures.fig5: .*'sample' was unexpected"),
    (figure("fig8", ball={"colour": "1"}), "figures.fig8.ball: .*'colour' was unexpected"),
    ({"stiffness_ratio": -1}, "stiffness_ratio: -1 is less than"),
    ({"stiffness_ratio": "nan"}, "stiffness_ratio: nan is not a finite number"),
    ({"stiffness_ratio": "stiff"}, "stiffness_ratio: 'stiff' is not of type 'number'"),
    ({"mass_ratio": 0.5}, "mass_ratio: 0.5 is less than the minimum of 1"),
    (figure("fig6", restitution=["1.5"]), "figures.fig6.restitution.0: 1.5 is greater"),
    (figure("fig5", incidence=["8", "0"]), r"figures.fig5.incidence: \[8, 0\]: each number"),
    (figure("fig5", experiment="nobody"), "'nobody' is not in data/; allowed are"),
    (figure("fig5", tolerance="0"), "figures.fig5.tolerance: 0 is less than the minimum"),
    (figure("fig6", continua={"restitution": ["0.2"]}), "restitution.0: 0.2 is less than the min"),
    (figure("fig9", continua={"models": ["lumped"]}), "continua.models.0: 'lumped' is not one of"),
    (comparison("fig5-continuum-maw", reference="maw1976/no"), "'maw1976/no' is neither"),
    (figure("inelastic", points="maw1976/slip_throughout_limit"), "limit' is no series"),
    (figure("inelastic", solved="3"), "inelastic.solved: 3 is less than the minimum of 16"),
    (figure("stability", points="maw1976/slip_throughout_limit"), "limit' is no series"),
    (comparison("fig5-continuum-maw", tolerance="3"), "'tolerance' was unexpected"),
    ({"significance": "1e-4"}, "significance: 0.0001 is less than the minimum of 0.001"),
    (
        comparison("fig5-continuum-maw", figure="nothing"),
        "'nothing' is not judged; allowed are fig2",
    ),
    (comparison("fig5-continuum-maw", regime="sticking"), "regime: 'sticking' is not one of"),
    (
        comparison("fig5-continuum-maw", points={"reader": "me"}),
        "points.reader: no label of maw1976",
    ),
    (comparison("fig5-continuum-maw", limit="2"), "fig5-continuum-maw.metric: 'vertices' is not"),
    (
        comparison("fig5-continuum-maw", documented={"as": "explained", "note": "known for long"}),
        "'regression' is a dependency of 'documented'",
    ),
    (
        comparison("fig5-lumped-maw-initial-stick", regression={"rms": ["3", "2"]}),
        r"regression.rms: \[3, 2\]: each number must be larger",
    ),
    (comparison("trade-errors", range=["1", "0"]), r"errors.range: \[1, 0\]"),
    ({"scenes": {"nothing": {"tolerance": "1"}}}, "scenes.nothing: there is no data/scenes/noth"),
    ({"scenes": {"superball": {"tolerance": "0"}}}, "superball.tolerance: 0 is less than"),
    ({"scenes": {"superball": {"steps": "4"}}}, "scenes.superball: .*'steps' was unexpected"),
    (figure("superball", throw={"bounces": "0"}), "bounces: 0 is less than"),
    (figure("superball", throw={"velocity": ["1", "2"]}), "velocity.1: 2 is greater"),
    (figure("trade", batches=["1"]), r"trade.batches: \[1\] is too short"),
]


def test_the_config_itself_is_admitted(check):
    check({})
    check(figure("fig6", as_printed="True"))
    check(figure("fig9", continua={"models": []}))


@pytest.mark.parametrize(("change", "words"), BAD_CONFIG)
def test_bad_config_is_refused(change, words, check):
    with pytest.raises(configuration.ConfigError, match=f"^config: .*{words}") as refusal:
        check(change)
    assert "\n" not in str(refusal.value)


def test_a_bound_is_refused_before_it_says_nothing(inventory, ledger, monkeypatch):
    """Each is widened until it is refused. What a `range` may be depends on what it holds: see
    tests/unit/test_comparison.py.
    """
    monkeypatch.chdir(ROOT)
    config = configuration.load()

    def refused(name, key, new):
        alone = {name: config["comparisons"][name] | {key: new}}
        changed = config | {"comparisons": alone}
        try:
            configuration.check_config(changed, inventory, ledger)
        except configuration.ConfigError as error:
            assert f"{name}.{key}" in str(error) and "\n" not in str(error)
            return True
        return False

    for name, entry in config["comparisons"].items():
        for part, (low, high) in entry.get("regression", {}).items():
            ends, far = np.array([low, high]), int(abs(high) > abs(low))
            while not refused(name, "regression", {part: ends.tolist()}):
                # A difference that doubles, from wherever it was within them, leaves them.
                assert np.abs(ends).max() < 2 * np.abs(ends).min()
                ends[far] *= 1.3
            for wide in ([low, 1e9], [-1e9, high], [0.0, abs(high)]):
                assert refused(name, "regression", {part: wide}), wide
        for part, size in entry.get("allowance", {}).items():
            for factor in (4, 1e9) if size else ():
                assert refused(name, "allowance", entry["allowance"] | {part: factor * size})
        for limit in (0.02, 3.0, 1e9):
            if "limit" in entry:
                assert refused(name, "limit", limit) == (entry["metric"] != "small" or limit > 2)


NO_TEXT = [
    gzip.compress,
    lambda table: table.decode().encode("utf-16"),
    lambda table: b"\x89PNG\r\n\x1a\n",
    lambda table: np.random.default_rng(1).bytes(len(table)),
    lambda table: b"\xff" + table,
    lambda table: table[:100] + b"\xe9" + table[100:],
]


def test_a_scene_that_is_no_text_is_refused(data, check, monkeypatch):
    monkeypatch.chdir(data[0].parent)
    Path("workflow").symlink_to(ROOT / "workflow")
    table = Path("data/scenes/superball.csv")
    whole = table.read_bytes()
    for change in NO_TEXT:
        table.write_bytes(change(whole))
        words = r"data/scenes/superball\.csv, line \d+: .*; save the file as UTF-8"
        with pytest.raises(reference_data.SourceError, match=words):
            check({})


@pytest.fixture
def data(tmp_path):
    """A copy of data/, and how to edit a file in it."""
    folder = tmp_path / "data"
    shutil.copytree(ROOT / "data", folder)

    def edit(path, old, new):
        text = (folder / path).read_text()
        assert old in text
        (folder / path).write_text(text.replace(old, new))

    return folder, edit


# What else a table of data/ may hold is tried in tests/unit/test_reference_data.py.
BAD_DATA = [
    (
        "0.586,-0.027",
        "0.586,-O.027",
        "rebound.csv, line 4, column 'velocity .*': '-O.027' is not a",
    ),
    ("0.586,-0.027\n", "", r"series.rebound.points = 17: .*rebound.csv has 16 points"),
]


@pytest.mark.parametrize(("old", "new", "words"), BAD_DATA, ids=[c[1] for c in BAD_DATA])
def test_bad_data_is_refused(data, old, new, words):
    folder, edit = data
    edit("chung_ooi2011/rebound.csv", old, new)
    with pytest.raises(reference_data.SourceError, match=words):
        reference_data.load_all(folder, SOURCE_SCHEMA)


@pytest.mark.parametrize("name", ["rubber_sphere.CSV", "rubber_sphere.csv.txt", "a.json"])
def test_a_file_that_would_be_ignored_is_refused(data, name):
    folder, _ = data
    (folder / "johnson1983" / name).write_text("0.5, -0.1\n")
    with pytest.raises(reference_data.SourceError, match=f"{name}: no series of that name"):
        reference_data.load_all(folder, SOURCE_SCHEMA)


@pytest.mark.parametrize("name", ["points.csv", "mine/source.yml"])
def test_what_is_no_source_is_refused(data, name):
    path = data[0] / name
    path.parent.mkdir(exist_ok=True)
    path.write_text("x: 1\n")
    with pytest.raises(reference_data.SourceError, match="no source: allowed are folders"):
        reference_data.load_all(data[0], SOURCE_SCHEMA)


MISREAD = [
    ["samples=0400"], ["stiffness_ratio=1_5"], ["a=6:40"], ["a=0x10"], ["a=1", "a=2"],
    ["figures={fig3: {samples: 50, samples: 90}}"], ["figures={fig3: {samples: 010}}"],
]  # fmt: skip


@pytest.mark.parametrize("arguments", MISREAD, ids=[" ".join(words) for words in MISREAD])
def test_values_that_would_be_misread_are_refused(arguments):
    with pytest.raises(configuration.ConfigError, match="^--config "):
        configuration.refuse_misread_values(arguments)


def test_values_that_mean_what_they_say_are_not_refused():
    configuration.refuse_misread_values(
        ["a=1.5", "b=-2e-3", "c={d: [0, 0.6, 1], e: true}", "f=nan", "g="]
    )


def test_a_missing_series_is_refused(data, check):
    folder, edit = data
    (folder / "chung_ooi2011/rebound.csv").rename(folder / "chung_ooi2011/rebounds.csv")
    with pytest.raises(reference_data.SourceError, match="rebound.csv: No such file"):
        reference_data.load_all(folder, SOURCE_SCHEMA)
    edit("chung_ooi2011/source.yaml", "  rebound:", "  rebounds:")
    with pytest.raises(configuration.ConfigError, match="'chung_ooi2011/rebound' is neither"):
        check({}, reference_data.load_all(folder, SOURCE_SCHEMA))


def test_source_without_provenance_is_refused(data):
    folder, edit = data
    edit("chung_ooi2011/source.yaml", "citation:", "quotation:")
    with pytest.raises(reference_data.SourceError, match="source.yaml: top level: .*quotation"):
        reference_data.load_all(folder, SOURCE_SCHEMA)


# Whole starts of Snakemake, one for each place where it is refused; the rest is tried above.
STARTS = [
    ("stiffness_ratio: -1 is less than", ["--config", "stiffness_ratio=-1"]),
    (r"Missing input files for rule (.|\n)*page\.css", []),
]


@pytest.mark.parametrize(("words", "arguments"), STARTS)
def test_a_refused_start_does_nothing_and_has_not_passed(words, arguments, fresh):
    (fresh / "results").mkdir()
    (fresh / "results/PASSED").write_text("passed")
    if not arguments:
        (fresh / "workflow/report/page.css").unlink()
    fresh.refuses(words, *arguments)
    assert not (fresh / "results/PASSED").exists()
