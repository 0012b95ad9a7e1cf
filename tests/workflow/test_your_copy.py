"""The page that lays a copy of the paper under our curves, and a reader of made-up prints.

Each click misses its place by half a pixel. What is saved is judged as the jobs of a run do it.
"""

import json
import re
import shutil

import numpy as np
import pandas as pd
import pytest
from PIL import Image

from planarimpact import continuum, lumped, rigid
from stronge1994 import reference_data, tables
from stronge1994.judging import distances
from tests.workflow import prints, project
from tests.workflow.project import ROOT, config, sources

RUBBER, LOSSY = "johnson1983/rubber_sphere", "stronge1994/fig6_e_0.5"
LIMITS = {"fig5": ((0, 8), (-3, 1)), "fig6": ((0, 8), (-3, 3)), "fig8a": ((0, 90), (0, 80))}
# Those that the page proposes.
MARKS = [(x, 0) for x in (0, 2, 4, 6)] + [(0, y) for y in (1, -1, -2, -3)]
X = np.linspace(0.0, 8.0, 401)
FORCES = "angle [deg]", "peak_force [N]"
# Where a pixel of the picture is in the window, once the stage shows it.
SHOW = """([u, v]) => {
  const scale = sheet.getBoundingClientRect().width / sheet.viewBox.baseVal.width;
  stage.scrollTo(u * scale - stage.clientWidth / 2, v * scale - stage.clientHeight / 2);
  const { left, top } = sheet.getBoundingClientRect();
  return [left + u * scale, top + v * scale]; }"""
GIVE = """([how, bytes, name = "a.jpg", type = "image/jpeg", text = ""]) => {
  const given = new DataTransfer(), more = { bubbles: true, cancelable: true };
  given.items.add(new File([new Uint8Array(bytes)], name, { type }));
  if (text) given.setData("text/plain", text);
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
        """Read a line, or markers twice, the second time from the last to the first."""
        self.page.check("#mode-read")
        self.page.select_option("#series", series)
        self.click(places)
        if follow:
            self.page.click("#trace")
        else:
            self.page.click("#second")
            self.click(list(places)[::-1])

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

    def reader(panel, lines, circles=(), dpi=100, how="file", marks=(*MARKS, (8, -3)), **more):
        path = tmp_path / "print.jpg"
        pixel = prints.scan(path, LIMITS[panel], lines, circles, dpi, **more)
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
            if mark not in MARKS and panel != "fig8a":  # which proposes all of its own
                tab.page.click("#mark-add")
                tab.page.click("#marks tr:last-child .mark-x")
                tab.page.keyboard.type(f"{mark[0]}")
                tab.press("Tab")
                tab.page.keyboard.type(f"{mark[1]}")
            found.click([mark])
        return found

    yield reader
    assert tab.problems == []


@pytest.fixture
def page(tab, first_run):
    """The page without a picture."""
    tab.open("about:blank")
    tab.open((first_run[0] / "figures/your_copy.html").as_uri())
    return tab


# A map of Fig. 5 with 100 and 80 pixels for a unit; the marks lie where they should, but for these.
MAP = """(marks, off = {}, flat = false, [cos, sin, tilt] = [1, 0, 0]) => {
  const clicked = marks.map(([x, y], i) => {
    const [u, v, w] = [100 * (x - 4), -80 * (y + 1), 1 + tilt * (x - 4) / 4];
    const [du, dv] = off[i] ?? [0, 0];
    return { x, y, u: (cos * u - sin * v) / w + 900 + du, v: (sin * u + cos * v) / w + 700 + dv };
  });
  return maps.fit(clicked, [[0, 8], [-3, 1]], flat); }"""
CORNER = [one for one in MARKS if one != (0, -2)] + [(8, -3)]
FOUR = [(0, 0), (6, 0), (0, -3), (8, -3)]


def arguments(*every):
    return ", ".join(map(json.dumps, every))


@pytest.mark.parametrize(
    ("marks", "wanted"), [(MARKS, (0.04192, 0.01778)), (CORNER, (0.00496, 0.0058))]
)
def test_a_map_knows_how_uncertain_it_is_in_the_corner(marks, wanted, page):
    found = page.evaluate(f"""(() => {{ const map = ({MAP})({arguments(marks)});
      const own = map.covariance([0.5 / 100, 0.5 / 80]);
      return map.shifts([8, -3])
        .map((row) => Math.sqrt(maps.dot(row, maps.times(own, row)))); }})()""")
    assert found == pytest.approx(wanted, abs=1e-5)


def test_a_map_is_found_however_a_picture_is_turned_and_tilted(page):
    rng = np.random.default_rng(1994)
    for marks in (CORNER, FOUR):
        for angle, tilt in rng.uniform((0, -0.2), (2 * np.pi, 0.2), (50, 2)):
            turned = [np.cos(angle), np.sin(angle), tilt]
            place = page.evaluate(
                f"({MAP})({arguments(marks, {}, False, turned)}).to_pixels([8, 1])"
            )
            u, v = 400 / (1 + tilt), -160 / (1 + tilt)
            wanted = [turned[0] * u - turned[1] * v + 900, turned[1] * u + turned[0] * v + 700]
            assert np.allclose(place, wanted, atol=0.3), (len(marks), angle, tilt)


def test_a_mark_that_is_off_by_a_pixel_does_not_move_the_corner_by_more_than_is_said(page):
    """Fig. 3, whose five marks two maps fit with and without tilt: then the corner was 2 px off."""
    found = page.evaluate("""(() => { const map = maps.fit([[0, 0], [1, 0], [2, 0], [0, 1], [0, -1]]
      .map(([x, y]) => ({ x, y, u: 300 * x + (x === 1), v: -300 * y })), [[0, 2], [-1, 1]], false);
      const own = map.covariance([map.sigma / 300, map.sigma / 300]);
      return [map.to_pixels([2, 1]), map.shifts([2, 1]).map((row) =>
        300 * Math.sqrt(maps.dot(row, maps.times(own, row))))]; })()""")
    off, sigma = np.abs(np.subtract(found[0], (600, -300))), np.array(found[1])
    assert np.all(off < 3 * sigma) and sigma.max() > 0.5


@pytest.mark.parametrize(
    ("marks", "off", "flat", "wanted"),
    [
        (MARKS[:4], {}, False, "on one line"),
        (MARKS[:5], {}, False, "Set the corner opposite the origin too"),
        (MARKS[:5], {}, True, None),
        (MARKS[:6], {}, False, None),
        (FOUR, {1: (100, 0)}, False, None),  # as tilts may be
        (FOUR, {1: (450, 0)}, False, "do not fit each other"),
        (FOUR[:3], {0: (600, 0), 1: (-600, 0)}, True, "mirrored"),
        (FOUR[:3], {1: (-600, 0)}, True, "mirrored|on one line"),
    ],
)
def test_marks_from_which_no_map_can_be_known_are_refused(marks, off, flat, wanted, page):
    found = page.evaluate(f"({MAP})({arguments(marks, off, flat)})")
    assert re.search(wanted, found["refused"]) if wanted else "refused" not in found, found


# Readings of a map of 2 and 3 units a pixel, whose marks have left this over.
JUDGED = """readings.judged({{ scale: () => [2, 3], sigma: {sigma}, freedom: {freedom} }},
  {{ readings: [{first}, {second}], width: {width}, by: "{by}" }}, {line}, 800)"""


def judged(page, first, second=(), sigma=0.4, width=0.0, by="", line=False, freedom=8):
    places = {"first": json.dumps(first), "second": json.dumps(second)}
    words = {"width": width, "by": by, "line": json.dumps(line), "sigma": sigma}
    words |= {"freedom": freedom}
    return page.evaluate(JUDGED.format(**places, **words))


def test_a_sigma_is_that_of_two_readings_or_of_the_marks_if_it_is_larger(page):
    first, second = [[0, 0], [40, 0]], [[41, 1], [1, 1]]
    for sigma, wanted in ((0.1, np.sqrt((1 + 4 / 2) / (4 + 4))), (0.9, 0.9)):
        found = judged(page, first, second, sigma)
        assert found["points"] == [[0.5, 0.5], [40.5, 0.5]]
        assert np.divide(found["marks"], (2, 3)) == pytest.approx(wanted)
        assert np.divide(found["sigmas"], (2, 3)) == pytest.approx(wanted / np.sqrt(2))
        assert found["values"] == 4 + 8 + 4 and found["origin"].startswith("mean of two readings")


@pytest.mark.parametrize(("freedom", "mark"), [(8, 0.5), (0, 1.0)])
@pytest.mark.parametrize("by", ["followed along the line", ""])
def test_a_line_has_the_uncertainty_of_its_width(by, freedom, mark, page):
    """And of the clicks, which without a spare mark nobody knows."""
    given = {"width": 2.4, "by": by, "line": True, "freedom": freedom}
    found = judged(page, [[u, 1] for u in range(29)], **given)
    assert np.divide(found["sigmas"], (2, 3)) == pytest.approx(0.6 if by else np.hypot(0.6, mark))
    assert np.divide(found["marks"], (2, 3)) == pytest.approx(mark) and "values" not in found
    assert [u for u, _ in found["points"]] == list(range(0, 29, 2))


@pytest.mark.parametrize(
    ("first", "second", "line", "wanted"),
    [
        ([[0, 0]], [], False, "twice"),
        ([[0, 0], [40, 0]], [[1, 0]], False, "2 and 1 points, of which 1"),
        ([[0, 0], [40, 0]], [[40, 0], [0, 0]], False, "Both readings are the same"),
        ([[0, 0], [0.03, 0]], [[0, 1], [1, 0]], False, "stands twice"),
        ([[0, 0], [40, 0]], [], True, "How wide is the line"),
        ([[0, 0]], [], True, "two points"),
    ],
)
def test_readings_that_say_nothing_are_refused(first, second, line, wanted, page):
    assert wanted in judged(page, first, second, line=line)["refused"]


def rms(errors):
    return np.sqrt(np.mean(np.square(errors), axis=0))


def saved(reader, series, folder):
    """The file of a series, saved and dropped into a copy of its folder."""
    assert reader.text("#refused") == ""
    if not reader.page.input_value("#who"):
        reader.page.click("#save")
        assert "Who" in reader.text("#refused")
        reader.page.fill("#who", "Ada Reader")
        reader.page.fill("#from", "a made-up print")
    source, name = series.split("/")
    shutil.copytree(ROOT / "data" / source, folder / source, dirs_exist_ok=True)
    path = reader.save(folder / source)
    assert path.name == f"{name}.csv" and reader.text("#refused") == ""
    return path


def judged_by_a_run(path, reader, first_run):
    """The row of a run for a file that was dropped into a folder of data/, as the page told it."""
    series, every = f"{path.parent.name}/{path.stem}", config()["comparisons"].items()
    ((name, _),) = [
        one for one in every if (one[1].get("reference"), one[1]["metric"]) == (series, "distance")
    ]
    row = project.rows_of_a_run(path.parent, name, first_run[0])[name]
    assert f"{row['would fail'].capitalize()} than ours" in reader.text("#sigmas")
    return row


@pytest.mark.parametrize(
    ("dpi", "how", "off", "wanted"),
    [(100, "drop", 0, "agrees"), (300, "file", 0, "agrees"), (100, "paste", 0.2, "differs")],
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
    assert judged_by_a_run(path, reader, first_run)["verdict"] == wanted


@pytest.mark.parametrize(
    ("wrong", "wanted", "dpi", "seen"),
    [
        ("", "agrees", 300, prints.SCAN),
        ("", "agrees", 100, prints.PHOTO),
        ("5 %", "differs", 150, prints.PHOTO),
        ("25", "differs", 300, prints.SCAN),
    ],
)
def test_a_line_is_followed_and_judged(wrong, wanted, dpi, seen, opened, first_run, tmp_path):
    """Curves of Fig. 6; that for e = 0.5 is right, too large, or has the error of Eq. 25."""
    curves = {e: lumped.rebound(X, 3.5, 1.21, e).velocity for e in (0.0, 0.5, 1.0)}
    line = np.transpose([X, curves[0.5] * (1.05 if wrong == "5 %" else 1.0)])
    clicked = np.arange(25, 350, 25)
    if wrong == "25":
        table = tables.read(first_run[0] / "results/curves/fig6.csv")
        own = tables.select(table, model="printed", e=0.5)
        own = own[["incidence [mu v2(0)]", "velocity [mu v2(0)]"]].to_numpy()
        jump = np.searchsorted(X, own[0, 0])
        line = np.concatenate([line[:jump], own])
        clicked = np.union1d(clicked[clicked < len(line)], jump + np.arange(0, 10, 3))  # it bends
    others = [(X, curves[e], "-") for e in (0.0, 1.0)]
    reader = opened("fig6", [*others, (*line.T, "-")], dpi=dpi, seen=seen)
    reader.read(LOSSY, line[clicked], follow=True)
    path = saved(reader, LOSSY, tmp_path)
    read = pd.read_csv(path, comment="#").to_numpy()
    assert np.abs(distances.curve_residuals(read.T, tuple(line.T), (8.0, 6.0))[0]).max() < 0.003
    # Sigma is a quarter of the width of the line.
    width = prints.INK["linewidth"] / 72 * dpi  # pixels
    unit = [np.linalg.norm(reader.pixel(*end) - reader.pixel(0, 0)) for end in ((1, 0), (0, 1))]
    sigma = np.array(re.findall(r"# sigma_[xy]: (.*)", path.read_text()), float) * unit
    assert len(read) <= 15 and np.all((sigma > 0.8 * width / 4) & (sigma < 1.6 * width / 4))
    assert judged_by_a_run(path, reader, first_run)["verdict"] == wanted


@pytest.mark.parametrize(
    ("scale", "friction", "wanted"), [(1.0, 1.0, "agrees"), (0.8, 1.15, "differs")]
)
def test_friction_that_is_too_high_fails_beside_its_normal_force(
    scale, friction, wanted, opened, first_run, tmp_path
):
    """Fig. 8, whose right axis has half the numbers of the left one."""
    table = tables.read(first_run[0] / "results/curves/fig8.csv")
    own = {name: tables.select(table, variant=name) for name in ("normal", "friction")}
    angle, force = ([one[key].to_numpy() for one in own.values()] for key in FORCES)
    shown = [scale * force[0], 2 * friction * scale * force[1]]
    lines = [(x, y, "-") for x, y in zip(angle, shown, strict=True)]
    left = [*((x, 0) for x in (0, 30, 60, 90)), *((0, y) for y in (20, 40, 60, 80)), (90, 80)]
    reader = opened("fig8a", lines, dpi=150, marks=left, steps=(10, 20))
    inside = [np.transpose(line[:2])[20:860][line[1][20:860] < 78] for line in lines]
    clicked = [line[np.linspace(0, len(line) - 1, 12).astype(int)] for line in inside]
    reader.read("stronge1994/fig8_normal", clicked[0], follow=True)
    saved(reader, "stronge1994/fig8_normal", tmp_path)
    reader.page.select_option("#panel", "fig8b")
    reader.page.check("#mode-marks")
    reader.click([(90, 20), (90, 40), (90, 80), (0, 80)])  # those at y = 0 are there
    reader.read("stronge1994/fig8_friction", clicked[1], follow=True)
    path = saved(reader, "stronge1994/fig8_friction", tmp_path)
    judged_by_a_run(path, reader, first_run)
    rows = project.rows_of_a_run(path.parent, "fig8-printed-curve-", first_run[0])
    found = {name.removeprefix("fig8-printed-curve-"): row["verdict"] for name, row in rows.items()}
    assert found == {"normal": "agrees", "friction": "agrees", "ratio": wanted}


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
    # It is chosen, and moved; a further one comes behind the one that was clicked on.
    before = page.locator(clicks).evaluate_all("(all) => all.map((one) => one.getAttribute('d'))")
    page.keyboard.press("Shift+ArrowUp")
    reader.click([(X[25], y[25]), (X[50], y[50])])
    after = page.locator(clicks).evaluate_all("(all) => all.map((one) => one.getAttribute('d'))")
    assert (*after[:1], *after[2:5]) == (*before[:4],) and after[5] != before[4]
    page.keyboard.press("Delete")
    assert page.locator(clicks).count() == 5


def test_marks_are_asked_for_and_a_wrong_one_is_named(opened):
    reader = opened("fig5", [], marks=MARKS[:3])
    page = reader.page
    assert "one line" in reader.text("#fit") and page.locator("#lines > *").count() == 0
    page.click("#marks tr:nth-child(5) .mark-pick")
    reader.click([MARKS[4]])
    assert "Set the corner opposite" in reader.text("#fit")
    page.check("#flat")
    assert "4 marks" in reader.text("#fit") and page.locator("#lines > *").count() == 4
    page.uncheck("#flat")
    reader.click([(7, 0), MARKS[5]])  # where the fourth, of incidence 6, does not stand
    assert re.search(r"^Mark 4 is .* Click where incidence 0, velocity -2", reader.text("#task"))
    reader.click(MARKS[6:])
    assert re.search(r"^Mark 4 is \d+ px off .*set it again", reader.text("#task"))
    page.check("#mode-marks")
    page.click("#marks tr:nth-child(4) .mark-pick")
    reader.click([(6, 0)])
    assert "residual 0." in reader.text("#fit") and "Mark" not in reader.text("#fit")


def test_a_reading_with_a_wrong_mark_is_not_saved_and_the_mark_is_named(opened):
    reader = opened("fig5", [], marks=[*MARKS[:3], (7, 0), *MARKS[4:], (8, -3)])
    page = reader.page
    page.click("#marks tr:nth-child(4) .mark-drop")  # a further mark was put at 7
    page.click("#marks tr:nth-child(8) .mark-x")
    page.keyboard.press("Control+a")
    page.keyboard.type("5")
    reader.read(RUBBER, [(1, 0), (5, -2)])
    page.fill("#who", "Ada Reader")
    page.fill("#from", "a made-up print")
    page.click("#save")
    assert re.search(r"^Mark \d is \d+ px off where the others put it", reader.text("#refused"))


def test_the_grid_has_the_numbers_of_the_print_and_goes_while_one_reads(opened):
    reader = opened("fig5", [])
    page, words = reader.page, [f"{one}" for one in (*range(9), *range(-3, 2))]
    for mode, wanted in (("marks", words), ("look", words), ("read", [])):
        page.check(f"#mode-{mode}")
        assert page.locator(".grid text").all_text_contents() == wanted
        assert page.is_visible("#lines > * >> nth=0") == bool(wanted)
    page.mouse.move(*reader.place(4, -1))
    assert "“" not in reader.text("#pointer")


def test_the_magnifier_goes_out_of_the_way_and_nothing_moves_the_picture(opened):
    reader = opened("fig5", [])
    page = reader.page

    def box(query):
        return page.evaluate(
            f"(({{ x, y, right, bottom }}) => [x, y, right, bottom])("
            f"document.querySelector('{query}').getBoundingClientRect())"
        )

    for _ in range(2):
        left, top, right, bottom = box("#loupe")
        page.mouse.move((left + right) / 2, (top + bottom) / 2)
        moved = box("#loupe")
        assert moved[2] < left or moved[0] > right
    page.mouse.move(*reader.place(4, -1))
    left, top, *size = map(float, page.get_attribute("#loupe", "viewBox").split())
    assert f"{size[0]:g} px across" in page.text_content("#with-width") and size[0] == size[1]
    middle = left + size[0] / 2, top + size[1] / 2
    assert middle == pytest.approx(reader.pixel(4, -1), abs=0.5)
    page.click("#close-loupe")
    page.mouse.move(*reader.place(4, -1))
    assert page.is_hidden("#close-up")
    page.check("#magnifier")
    page.mouse.move(*reader.place(4, -1))
    assert page.is_visible("#close-up")
    before = page.evaluate("frame.offsetTop")
    page.set_input_files("#file", {"name": "a.pdf", "mimeType": "application/pdf", "buffer": b"%"})
    assert page.is_visible("#refused") and page.evaluate("frame.offsetTop") == before
    for mode in ("marks", "look", "read"):
        page.check(f"#mode-{mode}")
        assert page.evaluate("frame.offsetTop") == before


def test_cells_of_a_table_are_pasted_as_numbers_and_a_new_picture_is_undone(opened, tmp_path):
    reader = opened("fig5", [])
    page = reader.page
    picture = list((tmp_path / "print.jpg").read_bytes())
    page.evaluate(GIVE, ["paste", picture, "a.png", "image/png", "0.5\t0.1\n1\t-0.2"])
    assert "2 rows" in reader.text("#export-said") and "9 marks" in reader.text("#fit")
    size = page.get_attribute("#sheet", "viewBox")
    prints.scan(tmp_path / "other.jpg", LIMITS["fig5"], [], dpi=60)
    page.set_input_files("#file", tmp_path / "other.jpg")
    page.locator("#fit", has_text="Set 3 more").wait_for()
    page.wait_for_selector(f"#sheet:not([viewBox='{size}'])")
    # With CapsLock, and on a keyboard without Latin letters.
    page.evaluate("""document.body.dispatchEvent(new KeyboardEvent("keydown",
      { key: "Z", code: "KeyY", ctrlKey: true, bubbles: true }))""")
    page.wait_for_selector(f"#sheet[viewBox='{size}']")
    assert "9 marks" in reader.text("#fit")
    page.evaluate("""document.body.dispatchEvent(new KeyboardEvent("keydown",
      { key: "я", code: "KeyZ", ctrlKey: true, bubbles: true }))""")
    assert "8 marks" in reader.text("#fit")


def test_panels_of_one_box_share_the_marks_of_their_x_axis(opened):
    reader = opened("fig5", [], marks=())
    for panel in ("fig8a", "fig8b", "fig5", "fig8b"):
        reader.page.select_option("#panel", panel)
        if panel == "fig8a":
            reader.click([(0, 0), (2, 0), (4, 0), (6, 0)])
        set_here = reader.page.locator("#marks td:nth-child(4)").all_text_contents()
        assert len([one for one in set_here if one != "not set"]) == 4 * (panel != "fig5")


def test_what_is_not_saved_is_asked_for_and_all_can_be_saved_and_opened_again(opened, tmp_path):
    leave = """(() => { const event = new Event("beforeunload", { cancelable: true });
      window.dispatchEvent(event); return event.defaultPrevented; })()"""
    reader = opened("fig5", [])
    page = reader.page
    assert not page.evaluate(leave)
    reader.read(RUBBER, [(2, -1), (5, -1)])
    page.fill("#who", "Li <b>")
    assert page.evaluate(leave)
    page.select_option("#panel", "fig8a")
    reader.click([(0, 0)])
    page.select_option("#panel", "fig5")
    path = reader.save(tmp_path, "#save-all")
    assert path.suffix == ".json" and not page.evaluate(leave)
    size, before = page.get_attribute("#sheet", "viewBox"), page.inner_html("#signs")
    for how in ("file", "drop"):
        page.reload()
        if how == "file":
            page.set_input_files("#file", path)
        else:
            page.evaluate(GIVE, [how, list(path.read_bytes()), "a.json", "application/json"])
        page.wait_for_selector(f"#sheet[viewBox='{size}']")
        page.fill("#zoom", "3")
        assert page.inner_html("#signs") == before and page.input_value("#who") == "Li b"
        assert "9 marks" in reader.text("#fit") and "could not tell" in reader.text("#sigmas")
        page.select_option("#panel", "fig8a")
        assert page.locator("#signs .mark").count() == 1  # of a panel that was not seen
        page.select_option("#panel", "fig5")
    for text in ("{", "[]", '{"state": {"panel": "fig99"}}'):
        file = {"name": "a.json", "mimeType": "application/json", "buffer": text.encode()}
        page.set_input_files("#file", file)
        page.locator("#refused", has_text="no readings").wait_for()
        assert page.inner_html("#signs") == before


def test_a_clicked_line_needs_its_width_and_the_picture_has_the_name_of_its_series(
    opened, tmp_path
):
    reader = opened("fig6", [])
    page = reader.page
    assert reader.save(tmp_path, "#picture").name == "fig6_overlay.png"
    page.check("#mode-read")
    page.select_option("#series", LOSSY)
    page.uncheck("#follow")
    assert page.is_hidden("#second")
    reader.click([(1, -0.3), (2, -1), (3, -1.5)])
    assert "How wide" in reader.text("#sigmas")
    page.fill("#width", "2,4")
    page.press("#width", "Tab")
    assert "larger than ours would fail" in reader.text("#sigmas")
    page.fill("#who", "Li")
    page.fill("#from", "a made-up print")
    head = reader.save(tmp_path).read_text()
    keys = re.findall("^# ([a-z_]+): ", head, re.M)
    assert keys == [
        "series",
        "who",
        "when",
        "from",
        "how",
        "axes",
        "marks",
        "mark_sigma_x",
        "mark_sigma_y",
        "tilt",
        "sigma_x",
        "sigma_y",
        "sigma_origin",
        "line_width",
    ]
    assert "# axes: 0 to 8; -3 to 3\n" in head and "# line_width: 2.4\n# " not in head
    assert "# marks: 0 0; 2 0; 4 0; 6 0; 0 1; 0 -1; 0 -2; 0 -3; 8 -3\n" in head
    assert "fig6_e_0.5.png" in reader.text("#saved")
    picture = reader.save(tmp_path, "#picture")
    assert picture.name == "fig6_e_0.5.png"
    with Image.open(picture) as one:  # our curves are in it, though they are hidden while one reads
        red = np.array(one.convert("RGB"), int)
        assert np.any((red[..., 0] - red[..., 1] > 100) & (red[..., 2] < 100))


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
        assert ("decimal or stand between" in reader.text("#refused")) == ("," in wrong)
        assert page.input_value(".mark-x >> nth=0") == "0"


def test_curves_are_hidden_marks_moved_and_the_picture_saved_on_a_phone_too(opened, tab, tmp_path):
    reader = opened("fig5", [])
    page, mark = reader.page, "#signs .chosen"
    before = page.get_attribute(mark, "d")
    for key, pixels in (("ArrowRight", 0.1), ("Shift+ArrowRight", 1.0)):
        page.keyboard.press(key)
        moved = [float(d[1:].split(",")[0]) for d in (before, page.get_attribute(mark, "d"))]
        assert moved[1] - moved[0] == pytest.approx(pixels)
        page.keyboard.press("Control+z")
        assert page.get_attribute(mark, "d") == before
    page.mouse.move(*reader.place(7, -1))
    assert re.search(r"; \d+\.\d px from “", reader.text("#pointer"))
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


def test_a_curve_is_the_one_that_its_name_says_and_with_which_its_series_is_compared():
    """Of all panels: the parameters in the words, and the curve and column of the comparison."""
    stated = config()["comparisons"].values()
    compared = {one.get("reference"): one["curve"] for one in stated if "curve" in one}
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
