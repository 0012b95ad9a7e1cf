"""What may stand in data/ is read as it is meant; tests/refusals has what is refused."""

import contextlib
import shutil

import numpy as np
import pytest

from stronge1994 import reference_data
from stronge1994.judging import comparisons
from stronge1994.reference_data.calibration import Calibration
from stronge1994.settings import config as configuration
from tests.workflow.project import ROOT, config, head, sources

AXES = {
    "x": {"column": "incidence", "unit": "1", "sigma": 0.02, "range": [0, 20]},
    "y": {"column": "velocity", "unit": "1", "sigma": 0.01, "range": [-5, 20]},
}
X, Y = "incidence [1]", "velocity [1]"
HEADER = f"{X},{Y}\n"


def read(folder, text):
    """x and y of a digitised series that holds this text."""
    path = folder / "mine.csv"
    path.write_text(text, encoding="utf-8")
    found = reference_data.Series(kind="digitised", path=str(path), **AXES).points()
    return list(zip(found[X], found[Y], strict=True))


@pytest.mark.parametrize(
    "text",
    [
        f"{HEADER}0.5,-0.05\n1,2.5e-1\n",
        f"\ufeff{HEADER}0.5, -.05\r\n1.,+0.25\r\n",  # BOM, CRLF and blanks
        f"who,{Y},{X}\nme,-0.05,0.5\nme,0.25,1\n",  # columns are known by their names
        f"{X}, {Y}\r0.5, -.05\r1,0.25\r",  # CR, a blank in the header
        "incidence , velocity\n0.5, -0.05 \n 1,0.25\n",  # names that need no unit
        "incidence[1],velocity [ 1 ]\n0.5,-0.05\n1,0.25\n\r\n\r\n",
        f'\n"incidence\n[1]",{Y}\n0.5,-0.05\n\n \n1,0.25\n\n',  # broken by Excel; blank lines
    ],
)
def test_a_table_gives_its_points(text, tmp_path):
    assert read(tmp_path, text) == [(0.5, -0.05), (1.0, 0.25)]


@pytest.mark.parametrize("mu", ["mu", " \u00b5 ", "\u03bc"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_a_file_with_a_head_fills_an_awaited_series(mu, end, tmp_path):
    """Its `open` setting comes from the head, where Excel may have put quotes and commas."""
    folder, place = tmp_path / "johnson1983", "johnson1983/rubber_sphere"
    folder.mkdir()
    text = (ROOT / "data/johnson1983/source.yaml").read_text()
    awaited = "    kind: awaited\n"
    (folder / "source.yaml").write_text(text.replace(awaited, awaited + "    open: [incidence]\n"))
    said = head(series=place, sigma_values=9, incidence=0.83).replace("# how: ", '"#how :  ')
    table = f"incidence,velocity [{mu}v2(0)],\n1, 0.5,\n\n"
    file = folder / "rubber_sphere.csv"
    file.write_text((said.replace("marks\n", 'marks",,\n') + table).replace("\n", end), newline="")
    series = reference_data.load(folder)["series"]["rubber_sphere"]
    by = "a test, with made-up points, 2020-02-29, from Fig. 5, p. 444 of my copy: a scan, "
    assert series["digitised_by"] == f"{by}your_copy.html, 6 marks"
    assert (series["kind"], series["points"], series["sigma_values"]) == ("digitised", 1, 9)
    assert (series["x"]["sigma"], series["y"]["sigma"]) == (0.012, 0.01)
    assert series["sigma_origin"] == "two readings; marks"
    marks = ((0, 0), (4, 0), (8, 0), (0, 1), (0, -3), (8, -3))
    known = Calibration(((0, 8), (-3, 1)), marks, (0.01, 0.005), 0.1, is_line=False)
    assert series["calibration"] == known
    assert series["settings"] == {"rubber": {"stiffness_ratio": 1.5}, "incidence": 0.83}
    assert reference_data.Series(**series).points().to_numpy().tolist() == [[1.0, 0.5]]
    assert series.get("overlay") is None
    picture = folder / "rubber_sphere.png"
    picture.write_bytes(b"\x89PNG\r\n")
    found = reference_data.load(folder)["series"]["rubber_sphere"]
    assert found["overlay"] == str(picture)
    file.unlink()
    awaited = reference_data.load(folder)["series"]["rubber_sphere"]
    assert (awaited["kind"], awaited["path"]) == ("awaited", None)


@pytest.mark.parametrize(("y", "admitted"), [(3.17, True), (3.19, False)])
def test_a_point_of_a_reading_may_lie_as_far_outside_the_range_as_a_map_may_be_off(
    y, admitted, tmp_path
):
    """Its own sigma may be much smaller: here 0.01, of a range of 6."""
    folder = tmp_path / "johnson1983"
    folder.mkdir()
    text = (ROOT / "data/johnson1983/source.yaml").read_text()
    (folder / "source.yaml").write_text(text)
    (folder / "rubber_sphere.csv").write_text(f"{head()}incidence,velocity\n1,{y}\n")
    refused = contextlib.nullcontext() if admitted else pytest.raises(reference_data.SourceError)
    with refused:
        reference_data.load(folder)


def test_all_faults_of_all_sources_are_told_at_once(tmp_path):
    """Of source.yaml, a line for each field; of tables, a line for each file."""
    shutil.copytree(ROOT / "data/johnson1983", tmp_path / "a")
    stated = (tmp_path / "a/source.yaml").read_text()
    wrong = stated.replace("rights:", "right:").replace("range: [0, 10]", "range: [10, 0]")
    (tmp_path / "a/source.yaml").write_text(wrong)
    shutil.copytree(ROOT / "data/kharaz2001", tmp_path / "b")
    for name in ("spin", "tangential_restitution"):
        (tmp_path / f"b/{name}.csv").write_text("angle\n1\n")
    (tmp_path / "b/notes.txt").touch()
    with pytest.raises(reference_data.SourceError) as refusal:
        reference_data.load_all(tmp_path)
    x = "series.rubber_sphere.x"
    told = str(refusal.value).replace(f"{tmp_path}/", "").splitlines()
    assert [line.partition(";")[0] for line in told] == [
        "a/source.yaml: rights: missing",
        f"a/source.yaml: {x}.range = [10, 0]: the first number must be the smaller",
        "a/source.yaml: right: no such key",
        "b/tangential_restitution.csv, line 1: column 'digitiser' is missing",
        "b/spin.csv, line 1: column 'digitiser' is missing",
        "b/notes.txt: no series of that name",
    ]


def test_files_that_desktops_and_editors_leave_are_ignored(tmp_path):
    shutil.copytree(ROOT / "data/kharaz2001", tmp_path / "kharaz2001")
    for name in (
        "desktop.ini",
        "Thumbs.db",
        "spin.csv~",
        "~$spin.xlsx",
        ".DS_Store",
        "spin.csv.bak",
    ):
        (tmp_path / "kharaz2001" / name).touch()
        (tmp_path / name).touch()
    assert list(reference_data.load_all(tmp_path)) == ["kharaz2001"]


def test_a_point_may_lie_three_sigmas_outside_the_range(tmp_path):
    assert read(tmp_path, f"{HEADER}-0.06,-5.03\n20.06,20.03\n")[0] == (-0.06, -5.03)


@pytest.mark.parametrize("text", ["4e-1", "0.4", "4E-1", "+.4e0", "4.e-01", "40e-2"])
def test_a_number_of_yaml_may_have_any_notation(text, tmp_path):
    """In all files and in --config the same."""
    path = tmp_path / "a.yaml"
    path.write_text(f"sigma: {text}\ntext: [4e-1 m, '{text}']\n")
    assert reference_data.load_yaml(path) == {"sigma": 0.4, "text": ["4e-1 m", text]}
    assert configuration.load([], [f"sigma={text}"])["sigma"] == 0.4


def test_a_merge_may_be_overridden_and_merged_again(tmp_path):
    path = tmp_path / "a.yaml"
    path.write_text("top:\n  c: {<<: &b {<<: &a {k: 1}, k: 2}, k: 3}\nb: *b\na: *a\nd: {<<: *b}\n")
    assert reference_data.load_yaml(path) == {
        "top": {"c": {"k": 3}}, "b": {"k": 2}, "a": {"k": 1}, "d": {"k": 2},
    }  # fmt: skip


def test_a_sigma_may_be_a_hundredth_of_the_range():
    """A measured one may be larger: see the marble of tests/refusals."""
    axis = reference_data.Axis("x", "1", 0.1, (0, 10))
    assert not list(axis.refusals(0.1)) and list(axis.refusals(0.101))


SLIDING = "chung_ooi2011/rebound"


def judged(reference):
    """Comparisons of the config with a series."""
    entries = config()["comparisons"].values()
    return [entry for entry in entries if entry.get("reference") == reference]


def test_sigmas_do_not_come_from_the_points_they_judge():
    """The velocity of the finite elements: from points that nothing looks at."""
    limits = comparisons.limits_of_regimes(3.5, 1.2143, 1.0)
    sheet = sources()["chung_ooi2011"]["series"]["rebound"]
    series = reference_data.Series(**sheet)
    points = series.points()
    x, w = points[series.x.name], points[series.y.name]
    off = (w - (x - 7.0))[x > limits[1]]
    assert sheet["x"]["sigma"] == sheet["y"]["sigma"] == round(np.sqrt(np.mean(off**2) / 2), 3)
    assert {entry["regime"] for entry in judged(SLIDING)} == {"initial stick", "slip and stick"}


READ_AGAIN = [
    ("chung_ooi2011", "spin", 0.1),
    ("kharaz2001", "spin", 1.0),
    ("kharaz2001", "tangential_restitution", 1.0),
]


@pytest.mark.parametrize(("source", "name", "near"), READ_AGAIN)
def test_sigmas_are_the_spread_of_readings_of_which_one_is_judged(source, name, near):
    """Readings of one point are at most `near` apart; what only one person read tells nothing."""
    sheet = sources()[source]["series"][name]
    series = reference_data.Series(**sheet)
    points = series.points()
    reader = points["digitiser"]
    xy = points[[series.x.name, series.y.name]].to_numpy()
    squares, degrees = np.zeros(2), 0
    for point in xy[reader == "kratos"]:
        readings = xy[np.abs(xy[:, 0] - point[0]) < near]
        squares += np.sum((readings - readings.mean(axis=0)) ** 2, axis=0)
        degrees += len(readings) - 1
    sigma = [sheet[axis]["sigma"] for axis in "xy"]
    assert [float(f"{size:.2g}") for size in np.sqrt(squares / degrees)] == sigma
    assert sheet["sigma_values"] == degrees
    entries = judged(f"{source}/{name}")
    assert entries and all(len(entry["points"]) == 1 for entry in entries)
