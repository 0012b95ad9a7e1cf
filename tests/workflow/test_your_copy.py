"""The page that lays a copy of the paper under our curves, and a reader of made-up prints.

Each click misses its place by half a pixel. What is saved is judged as the jobs of a run do it.
"""

import re
import shutil

import numpy as np
import pandas as pd
import pytest
from PIL import Image

from planarimpact import continuum, lumped, rigid
from stronge1994 import reference_data, tables
from stronge1994 import settings as figure_settings
from stronge1994.judging import compare, distances
from tests.workflow import prints
from tests.workflow.project import ROOT, config, schema, sources

RUBBER, LOSSY = "johnson1983/rubber_sphere", "stronge1994/fig6_e_0.5"
LIMITS = {"fig5": ((0, 8), (-3, 1)), "fig6": ((0, 8), (-3, 3))}
# Those that the page proposes.
MARKS = [(x, 0) for x in (0, 2, 4, 6)] + [(0, y) for y in (1, -1, -2, -3)]
X = np.linspace(0.0, 8.0, 401)
# Where a pixel of the picture is in the window, once the stage shows it.
SHOW = """([u, v]) => {
  const scale = sheet.getBoundingClientRect().width / sheet.viewBox.baseVal.width;
  stage.scrollTo(u * scale - stage.clientWidth / 2, v * scale - stage.clientHeight / 2);
  const { left, top } = sheet.getBoundingClientRect();
  return [left + u * scale, top + v * scale]; }"""
GIVE = """([how, bytes]) => {
  const given = new DataTransfer(), more = { bubbles: true, cancelable: true };
  given.items.add(new File([new Uint8Array(bytes)], "a.jpg", { type: "image/jpeg" }));
  document.body.dispatchEvent(how === "drop" ? new DragEvent(how, { dataTransfer: given, ...more })
    : new ClipboardEvent(how, { clipboardData: given, ...more })); }"""


class Reader:
    """Who has opened a print, and uses the mouse."""

    def __init__(self, tab, pixel):
        self.page, self.pixel = tab.page, pixel
        self.rng = np.random.default_rng(1994)

    def place(self, x, y, miss=0.0):
        angle = self.rng.uniform(0.0, 2.0 * np.pi)
        u, v = self.pixel(x, y) + miss * np.array([np.cos(angle), np.sin(angle)])
        return self.page.evaluate(SHOW, [float(u), float(v)])

    def click(self, places):
        for place in places:
            self.page.mouse.click(*self.place(*place, miss=0.5))

    def read(self, series, places, follow=False):
        """Read places twice, the second time from the last to the first."""
        self.page.check("#mode-read")
        self.page.select_option("#series", series)
        self.page.set_checked("#follow", follow)
        for way in (1, -1):
            self.click(list(places)[::way])
            if follow:
                self.page.click("#trace")
            if way == 1:
                self.page.click("#second")

    def save(self, path, button="#save"):
        with self.page.expect_download(timeout=5000) as found:
            self.page.click(button)
        found.value.save_as(path / found.value.suggested_filename)
        return path / found.value.suggested_filename

    def text(self, query):
        return self.page.text_content(query).strip()


@pytest.fixture
def opened(tab, first_run, tmp_path):
    """Open the page with a print; it has no errors, and asks for nothing."""
    tab.problems.clear()

    def reader(panel, lines, circles=(), dpi=100, how="file", marks=(*MARKS, (8, 0))):
        path = tmp_path / "print.jpg"
        pixel = prints.scan(path, LIMITS[panel], lines, circles, dpi)
        tab.resize(1440, 900)
        tab.open("about:blank")
        tab.open((first_run[0] / "figures/your_copy.html").as_uri())
        tab.page.select_option("#panel", panel)
        if how == "file":
            tab.page.set_input_files("#file", path)
        else:
            tab.page.evaluate(GIVE, [how, list(path.read_bytes())])
        tab.page.wait_for_selector(".opened #sheet")
        tab.page.fill("#zoom", "3")
        found = Reader(tab, pixel)
        for mark in marks:
            if mark not in MARKS:
                tab.page.click("#mark-add")
                tab.page.click("#marks tr:last-child .mark-x")
                for key in (f"{mark[0]}", "Tab", f"{mark[1]}"):
                    tab.press(key)
            found.click([mark])
        return found

    yield reader
    assert tab.problems == []


# Sigmas of readings on a map of 2 and 3 units a pixel, whose marks are off by half a pixel.
SIGMAS = """readings.sigmas({{ scale: () => [2, 3], sigma: () => 0.5,
  to_axes: ([u, v]) => [2 * u, 3 * v] }},
  [[[0, 0], [40, 0]], [{second}]], [{width}], 800, {line})"""


@pytest.mark.parametrize(
    ("second", "width", "line", "variance"),
    [
        ("[1, 1], [41, 1]", 0, "false", 1 / 2 + 1 / 4),  # two readings, and the marks
        ("[1, 1], [39, 1]", 4, "true", 1 / 2 + 1 / 4 + 4),  # half the width of the line besides
    ],
)
def test_a_sigma_adds_up_what_its_origin_names(second, width, line, variance, tab, first_run):
    tab.open((first_run[0] / "figures/your_copy.html").as_uri())
    found = tab.evaluate(SIGMAS.format(second=second, width=width, line=line))
    assert found["x"] / 2 == pytest.approx(np.sqrt(variance)) == pytest.approx(found["y"] / 3)
    assert ("half the width of the line" in found["origin"]) == bool(width)
    assert found["origin"].endswith("; residual of the marks")


def rms(errors):
    return np.sqrt(np.mean(np.square(errors), axis=0))


def saved(reader, series, folder):
    """The file of a series, saved and dropped into a copy of its folder."""
    assert reader.text("#refused") == ""
    reader.page.click("#save")
    assert "Who" in reader.text("#refused")
    reader.page.fill("#who", "Ada Reader")
    reader.page.fill("#from", "a made-up print")
    source, name = series.split("/")
    shutil.copytree(ROOT / "data" / source, folder / source)
    path = reader.save(folder / source)
    assert path.name == f"{name}.csv" and reader.text("#refused") == ""
    return path


def verdict(path, first_run):
    """What a run says of a file that was dropped into a folder of data/."""
    source, series = path.parent.name, f"{path.parent.name}/{path.stem}"
    named = config()["comparisons"].items()
    ((name, entry),) = [one for one in named if one[1].get("reference") == series]
    figure = name.split("-")[0]
    found = sources() | {source: reference_data.load(path.parent, schema("source"))}
    references = figure_settings.references(config(), found, figure)
    curves = first_run[0] / f"results/curves/{figure}.csv"
    return compare(figure, curves, {name: entry}, references, config()["significance"], {})[0][
        "verdict"
    ]


@pytest.mark.parametrize(
    ("dpi", "how", "off", "wanted"),
    [(100, "drop", 0, "agrees"), (300, "file", 0, "agrees"), (100, "paste", 0.2, "FAILS")],
)
def test_circles_are_read_and_judged(dpi, how, off, wanted, opened, first_run, tmp_path):
    y = lumped.rebound(X, 3.5, 1.5, 1.0).velocity
    coarse = continuum.rebound(X[::8], 3.5, 1.5, tolerance=1e-3).velocity
    bare = rigid.rebound(X, 3.5, restitution=1.0).velocity
    circles = np.transpose([X[20:400:45], y[20:400:45] + off])
    lines = [(X, y, "-"), (X[::8], coarse, "--"), (X, bare, ":")]
    reader = opened("fig5", lines, circles, dpi, how)
    reader.read(RUBBER, circles)
    path = saved(reader, RUBBER, tmp_path)
    error = pd.read_csv(path, comment="#").to_numpy() - circles
    assert np.all(rms(error) <= np.multiply((8, 4), 0.3 / dpi))  # 0.3 % of the axes at 100 dpi
    sigma = np.array(re.findall(r"# sigma_[xy]: (.*)", path.read_text()), float)
    assert np.all((rms(error / sigma) > 0.4) & (rms(error / sigma) < 2))
    assert verdict(path, first_run) == wanted


@pytest.mark.parametrize(("wrong", "wanted"), [("", "agrees"), ("5 %", "FAILS"), ("25", "differs")])
def test_a_line_is_followed_and_judged(wrong, wanted, opened, first_run, tmp_path):
    """Curves of Fig. 6; that for e = 0.5 is right, too large, or has the error of Eq. 25."""
    curves = {e: lumped.rebound(X, 3.5, 1.21, e).velocity for e in (0.0, 0.5, 1.0)}
    line = np.transpose([X, curves[0.5] * (1.05 if wrong == "5 %" else 1.0)])
    if wrong == "25":
        table = tables.read(first_run[0] / "results/curves/fig6.csv")
        own = tables.select(table, model="printed", e=0.5)
        own = own[["incidence [mu v2(0)]", "velocity [mu v2(0)]"]].to_numpy()
        line = np.concatenate([line[: np.searchsorted(X, own[0, 0])], own])
    others = [(X, curves[e], "-") for e in (0.0, 1.0)]
    reader = opened("fig6", [*others, (*line.T, "-")], dpi=300)
    clicks = line[25:350:25]
    reader.read(LOSSY, clicks, follow=True)
    path = saved(reader, LOSSY, tmp_path)
    read = pd.read_csv(path, comment="#").to_numpy()
    assert np.abs(distances.curve_residuals(read.T, tuple(line.T), (8.0, 6.0))[0]).max() < 0.003
    # Sigma is half the width of the line, and what marks and a second reading add to its square.
    half = prints.INK["linewidth"] / 2 / 72 * 300  # pixels
    unit = [np.linalg.norm(reader.pixel(*end) - reader.pixel(0, 0)) for end in ((1, 0), (0, 1))]
    sigma = np.array(re.findall(r"# sigma_[xy]: (.*)", path.read_text()), float) * unit
    assert np.all((sigma > 0.8 * half) & (sigma < 1.6 * half))
    assert verdict(path, first_run) == wanted


def test_undo_takes_back_a_followed_line_and_a_lost_line_names_the_click(opened):
    y = lumped.rebound(X, 3.5, 1.21, 0.5).velocity
    reader = opened("fig6", [(X[:200], y[:200], "-")])
    page, circles, clicks = reader.page, "#signs circle", "#signs .click"
    page.check("#mode-read")
    page.select_option("#series", LOSSY)
    page.set_checked("#follow", True)
    reader.click([(X[i], y[i]) for i in (25, 75, 125, 175)])
    page.click("#trace")
    assert 10 <= page.locator(circles).count() <= 15 and page.locator(clicks).count() == 0
    assert "pixels" in reader.text("#task") and "left out" in reader.text("#task")
    page.click("#undo")
    assert page.locator(circles).count() == 0 and page.locator(clicks).count() == 4
    reader.click([(X[260], y[260])])  # the line has ended before
    page.click("#trace")
    assert "between clicks 4 and 5: move click 5" in reader.text("#refused")


def test_marks_on_a_line_are_refused(opened):
    reader = opened("fig5", [], marks=MARKS[:3])
    assert "one line" in reader.text("#fit") and reader.page.locator("#lines > *").count() == 0
    reader.page.click("#marks tr:nth-child(5) .mark-pick")
    reader.click([MARKS[4]])
    assert "4 marks" in reader.text("#fit") and reader.page.locator("#lines > *").count() == 4


def test_an_export_of_another_program_is_taken_or_refused(opened):
    """More of them are in test_your_copy_import.py."""
    reader = opened("fig5", [])
    page = reader.page
    page.click("#others summary")
    place = "(one) => [+one.getAttribute('cx'), +one.getAttribute('cy')]"
    wanted = [reader.pixel(0.5, 0.1), reader.pixel(1.0, -0.2)]
    exports = {"y,x\n0.1,0.5\n-0.2,1\n": False, "a;b\n0,1;0,5\n-0,2;1\n": True}
    for export, exchanged in exports.items():
        page.fill("#export", export)
        if exchanged:
            page.click("#exchange")
        page.click("#export-take")
        taken = page.evaluate(f"[...document.querySelectorAll('#signs circle')].map({place})")
        assert np.shape(taken) == (2, 2) and np.abs(np.subtract(taken, wanted)).max() < 1, export
    page.fill("#export", "1,2\n3,b\n")
    assert reader.text("#export-said").endswith("not all cells are numbers.")
    assert not page.is_visible("#export-take")
    for wrong in ("0x10", "1,000"):
        page.fill(".mark-x >> nth=0", wrong)
        page.press(".mark-x >> nth=0", "Tab")
        assert f"“{wrong}” is no number" in reader.text("#refused")
        assert page.input_value(".mark-x >> nth=0") == "0"


def test_curves_are_hidden_marks_moved_and_the_picture_saved_on_a_phone_too(opened, tab, tmp_path):
    reader = opened("fig5", [])
    page, mark = reader.page, "#signs .chosen"
    before = page.get_attribute(mark, "d")
    page.keyboard.press("ArrowRight")
    moved = [float(d[1:].split(",")[0]) for d in (before, page.get_attribute(mark, "d"))]
    assert moved[1] - moved[0] == pytest.approx(0.1)
    page.keyboard.press("Control+z")
    assert page.get_attribute(mark, "d") == before
    page.mouse.move(*reader.place(7, -1))
    found = re.findall(r"(?:incidence|velocity) (\S+)", reader.text("#pointer"))
    assert np.allclose([float(one.replace("\u2212", "-")) for one in found], (7, -1), atol=0.03)
    page.hover("#hold")
    for press, hidden in ((page.mouse.down, True), (page.mouse.up, False)):
        press()
        assert page.is_hidden("#lines > * >> nth=0") == hidden
    with Image.open(reader.save(tmp_path, "#picture")) as picture:
        assert picture.format == "PNG" and picture.width > 500
    tab.resize(390, 900, mobile=True)
    assert page.evaluate("document.scrollingElement.scrollWidth") <= 390
    page.set_input_files("#file", {"name": "a.pdf", "mimeType": "application/pdf", "buffer": b"%"})
    assert "PDF" in reader.text("#refused")


def test_a_new_picture_begins_empty_in_every_panel(opened, tmp_path):
    reader = opened("fig5", [], marks=MARKS[:3])
    reader.page.select_option("#panel", "fig6")
    reader.click(MARKS[:1])
    assert "Set 2 more" in reader.text("#fit")
    prints.scan(tmp_path / "other.jpg", LIMITS["fig6"], [])
    reader.page.set_input_files("#file", tmp_path / "other.jpg")
    reader.page.locator("#fit", has_text="Set 3 more").wait_for()
    reader.page.select_option("#panel", "fig5")
    assert "Set 3 more" in reader.text("#fit")


def test_a_page_whose_distances_are_wrong_says_so(tab, first_run, tmp_path):
    text = (first_run[0] / "figures/your_copy.html").read_text(encoding="utf-8")
    for changed, wrong in ((text, 0), (re.sub(r'"near": \d', '"near": 7', text, count=1), 1)):
        (tmp_path / "page.html").write_text(changed, encoding="utf-8")
        tab.open((tmp_path / "page.html").as_uri())
        said = tab.page.text_content("#refused")
        assert ("Do not trust" in said and f" {wrong} of " in said) if wrong else said == ""


def test_a_curve_is_the_one_that_its_name_says_and_with_which_its_series_is_compared():
    """Of all panels: the parameters in the words, and the curve and column of the comparison."""
    stated = config()["comparisons"].values()
    compared = {one.get("reference"): one.get("curve") for one in stated}
    panels = reference_data.load_yaml(ROOT / "workflow/your_copy/panels.yaml")["panels"].values()
    for panel, curve in [(one, curve) for one in panels for curve in one["curves"]]:
        ((key, values),) = curve.get("each", {"": [""]}).items()
        for value in values:
            chosen = curve["select"] | ({key: value} if key else {})
            name = curve["name"].replace("{}", f"{value}")
            said = re.findall(r"(e|µ) = ([\d.]+)", name)
            assert {(at.replace("µ", "mu"), float(one)) for at, one in said} <= chosen.items(), name
            if full := curve.get("series", "").replace("{}", f"{value}"):
                source, series = full.split("/")
                awaited = reference_data.Series(**sources()[source]["series"][series])
                assert chosen.items() <= compared[full].items(), name
                assert curve.get("y", panel["y"]) == awaited.ordinates[0].name, name
