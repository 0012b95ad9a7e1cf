"""Readings of made-up prints: how often a right print fails, and how often a wrong one is found.

The map, the line and the file are those of the page's own JavaScript, run by node; the verdict is
that of the judge. A print is seen by a camera at an angle; each mark and each point is clicked with
an error of its own. A line is found by the page in a scan that is drawn here, and a draughtsman has
set it off by a quarter of its width (one sigma). After a run, which makes the page:

    python -m tests.simulated_readings

prints the table of data/README.md, of each mark and click the worst of three tilts; on two cores
this takes half an hour.
"""

import concurrent.futures
import functools
import itertools
import json
import re
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

import numpy as np

from stronge1994 import tables
from stronge1994.judging import compare
from stronge1994.judging.comparisons import Comparison
from stronge1994.judging.metrics import measure
from stronge1994.judging.verdicts import judge
from stronge1994.reference_data import Series, reading
from stronge1994.verdict_table import Verdict
from tests.workflow import node
from tests.workflow.project import ROOT, checked, config, sources

RUN = ROOT  # where a run was made
FOLDER = ROOT / "workflow/your_copy"
WIDTH = 700.0  # of a panel, in pixels; half of it is its height
SIZE = int(WIDTH + 120), int(WIDTH / 2 + 120)  # of the picture
STEP = 4.0  # px, of the drawn line
BEND = 0.6  # rad in a step: there a reader clicks
# A trial as the page goes through it: the file, or why the page makes none.
READ = """
const random = (seed) => () => (seed = (1103515245 * seed + 12345) % 2147483648) / 2147483648;
function colours({ chain, ink, size: [width, height], seed }) {
  const { min, max, floor, hypot } = Math; // a global of node's vm is slow
  const [next, reach] = [random(seed), ink / 2 + 1];
  const far = new Float32Array(width * height).fill(reach);
  for (let i = 0; i + 1 < chain.length; i++) {
    const [a, b, c, d] = [...chain[i], ...chain[i + 1]];
    const squared = (c - a) ** 2 + (d - b) ** 2;
    for (let y = floor(min(b, d) - reach); y <= max(b, d) + reach; y++) {
      for (let x = floor(min(a, c) - reach); x <= max(a, c) + reach; x++) {
        const at = y * width + x;
        const along = ((x + 0.5 - a) * (c - a) + (y + 0.5 - b) * (d - b)) / squared;
        const share = min(1, max(0, along));
        const gap = hypot(x + 0.5 - a - share * (c - a), y + 0.5 - b - share * (d - b));
        if (gap < far[at]) far[at] = gap;
      }
    }
  }
  const grey = far.map((one) => 235 - 200 * min(1, max(0, ink / 2 - one + 0.5))
    + 16 * (next() + next() + next() - 1.5));
  return ([u, v]) => {
    const [x, y] = [floor(u - 0.5), floor(v - 0.5)];
    const [p, q, at] = [u - 0.5 - x, v - 0.5 - y, y * width + x];
    const value = (1 - q) * ((1 - p) * grey[at] + p * grey[at + 1])
      + q * ((1 - p) * grey[at + width] + p * grey[at + width + 1]);
    return [value, value, value];
  };
}
function read({ marks, range, clicks, scan, series, incidence }) {
  const map = maps.fit(marks, range, false);
  if (map.refused) return map;
  let given = { readings: clicks, width: 0, by: "" };
  if (scan) {
    const { points, width, lost } = trace.follow(colours(scan), clicks[0]);
    if (lost) return { refused: "the line is lost" };
    given = { readings: [points, []], width, by: "followed along the line" };
  }
  const found = readings.judged(map, given, Boolean(scan), 1000);
  if (found.refused) return found;
  const said = { series, incidence, who: "a simulation", when: "2020-02-29", from: "a print" };
  return { text: readings.csv(said, range, map, marks, found, "simulated") };
}
"""
# Places of marks in a panel, from -1 to 1: on its lower and left edges, and the corner opposite.
BOTTOM, LEFT = [(x, -1.0) for x in (-1, -0.5, 0, 0.5)], [(-1.0, y) for y in (-0.5, 0, 1)]
MARKS = {
    "4, the corners": [(-1, -1), (1, -1), (-1, 1), (1, 1)],
    "5, an L": [BOTTOM[0], BOTTOM[2], (1.0, -1.0), LEFT[1], LEFT[2]],
    "8, an L": [*BOTTOM, (1.0, -1.0), *LEFT],
    "9, with the corner": [*BOTTOM, (1.0, -1.0), *LEFT, (1.0, 1.0)],
}
CLICKS = 0.3, 0.5, 1.0  # px, one sigma
TILTS = 0.0, 3e-5, 1e-4  # per pixel
POINTS = 1, 3, 9, 30, 57
LINES = 1.2, 2.4, 5.0  # px
TRIALS = {"markers": (600, 100), "line": (200, 30)}  # of right and of wrong curves
RUNS = 150
WRONG_BY = 1.05


class Camera(NamedTuple):
    """Pixels of places in a panel, whose axes go from -1 to 1."""

    matrix: np.ndarray

    @classmethod
    def any(cls, rng, tilt):
        """Turned by a degree, sheared a little, and with this tilt in any direction."""
        turn, way = rng.normal(0.0, np.radians(1.0)), rng.uniform(0.0, 2 * np.pi)
        turned = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        flat = (
            turned @ [[1.0, rng.normal(0.0, 0.003)], [0.0, 1.0]] @ np.diag([WIDTH / 2, -WIDTH / 4])
        )
        seen = tilt * np.array([np.cos(way), np.sin(way)]) @ flat
        return cls(np.block([[flat, np.zeros((2, 1))], [seen, np.ones((1, 1))]]))

    def pixels(self, places):
        u, v, w = self.matrix @ [*np.transpose(places), np.ones(len(places))]
        return np.transpose([u / w, v / w]) + np.divide(SIZE, 2)


@functools.cache
def page():
    """What the page knows: panels with their curves, and series that can be read there."""
    text = (RUN / "figures/your_copy.html").read_text(encoding="utf-8")
    return json.loads(re.search(r"const DATA = (\{.*\});\n", text)[1].replace("<\\/", "</"))


def scripts():
    """The page's scripts in node, without its controls."""
    data = {"refused": page()["refused"], "noncentrality": page()["noncentrality"]}
    names = ("map", "trace", "readings")
    texts = [(FOLDER / f"{name}.js").read_text(encoding="utf-8") for name in names]
    return node.scripts([f"const DATA = {json.dumps(data)};", *texts, READ])


def scaled(panel, places):
    """Places on axes from -1 to 1, of values on the axes of a panel; and back."""
    low, high = np.transpose(panel["range"])
    return 2 * (np.asarray(places) - low) / (high - low) - 1


def values(panel, places):
    low, high = np.transpose(panel["range"])
    return low + (np.asarray(places) + 1) / 2 * (high - low)


class Reader(NamedTuple):
    """Who reads series of one panel in one picture."""

    rng: np.random.Generator
    panel: dict
    camera: Camera
    marks: list  # as the page has them
    click: float  # px

    @classmethod
    def of(cls, rng, panel, tilt, marks, click):
        camera = Camera.any(rng, tilt)
        clicked = camera.pixels(marks) + rng.normal(0.0, click, (len(marks), 2))
        both = np.hstack([values(panel, marks), clicked]).tolist()
        named = [dict(zip("xyuv", mark, strict=True)) for mark in both]
        return cls(rng, panel, camera, named, click)

    def trial(self, series, **read):
        own = {"marks": self.marks, "range": self.panel["range"], "series": {**series, "name": ""}}
        return own | {"incidence": "1"} | read

    def markers(self, series, places):
        """Two readings of points at these values."""
        pixels = self.camera.pixels(scaled(self.panel, places))
        twice = pixels + self.rng.normal(0.0, self.click, (2, *pixels.shape))
        return self.trial(series, clicks=twice.tolist())

    def line(self, series, curve, width, count=9):
        """A line that the page follows between clicks on the curve, whose places are values."""
        pixels = self.camera.pixels(scaled(self.panel, curve))
        along = np.append(0.0, np.cumsum(np.hypot(*np.diff(pixels, axis=0).T)))
        kept = np.append(True, np.diff(along) > 0)
        even = np.linspace(0.0, along[-1], int(along[-1] / STEP))
        chain = np.transpose([np.interp(even, along[kept], axis) for axis in pixels[kept].T])
        ways = np.gradient(chain, axis=0)
        across = np.transpose([-ways[:, 1], ways[:, 0]]) / np.hypot(*ways.T)[:, None]
        drawn = chain + self.rng.normal(0.0, width / 4) * across
        turned = np.abs(np.diff(np.unwrap(np.arctan2(*np.diff(drawn, axis=0).T)))) > BEND
        even = np.linspace(0.02 * len(drawn), 0.98 * len(drawn), count).astype(int)
        clicked = drawn[np.union1d(even, np.flatnonzero(turned) + 1)]
        clicks = clicked + self.rng.normal(0.0, self.click, clicked.shape)
        scan = {"chain": drawn.tolist(), "ink": width, "size": SIZE}
        scan |= {"seed": int(self.rng.integers(1, 2**31))}
        return self.trial(series, clicks=[clicks.tolist(), []], scan=scan)


def verdict_of(answer, stated, curve, folder):
    """Verdict on a file that the page has made, beside this curve; or why it has made none."""
    if "refused" in answer:
        return answer["refused"]
    file = Path(folder, "reading.csv")
    file.write_text(answer["text"].partition("\n")[2], encoding="utf-8")  # without `series`
    series = Series(**reading.filled(stated, file) | {"name": "a/b"})
    own = Comparison("a", "distance", "so", reference=series, curve={"model": "a"})
    return judge(own, measure(own, curve), config()["significance"]).verdict


def cell(setting, trials, factor, seed):
    """How many of some readings differ, and agree; of the curve of Fig. 5 times a factor."""
    (marks, click, tilt), (kind, size) = setting
    panel = page()["panels"]["fig5"]
    series = next(one for one in panel["series"] if one["line"] == (kind == "line"))
    source, name = series["id"].split("/")
    stated = sources()[source]["series"][name]
    curve = np.transpose([panel["curves"][0][axis] for axis in "xy"])
    table = tables.curve(dict(zip(series["columns"], curve.T, strict=True)), "a")
    rng = np.random.default_rng([seed, len(marks)])
    given = []
    for _ in range(trials):
        reader = Reader.of(rng, panel, tilt, MARKS[marks], click)
        if kind == "line":
            inside = curve[curve[:, 0] <= 8.0]
            given.append(reader.line(series, inside * [1, factor], size))
        else:
            x = np.linspace(0.3, 7.7, size) if size > 1 else rng.uniform(0.3, 7.7, 1)
            y = factor * np.interp(x, *curve.T)
            given.append(reader.markers(series, np.transpose([x, y])))
    with scripts() as page_of, tempfile.TemporaryDirectory() as folder:
        answers = page_of.map("read", given)
        return [verdict_of(one, stated, table, folder) for one in answers]


def readable():
    """Each series that the page offers, with its panel and its comparison in the config."""
    distances = {
        one["reference"]: name
        for name, one in config()["comparisons"].items()
        if one["metric"] == "distance"
    }
    return [
        (panel, series, distances[series["id"]])
        for panel in page()["panels"].values()
        for series in panel["series"]
    ]


def whole_run(seed, factors=()):
    """Verdicts of a run in which every series was read once, by comparison: nine points, or a line.

    `factors` are those by which the curves of some series, by name, are too large.
    """
    rng = np.random.default_rng([1994, seed])
    tilt, click = rng.choice(TILTS), rng.choice(CLICKS)
    given, readers = [], {}
    for panel, series, name in readable():
        key = panel["title"]
        if key not in readers:
            marks = scaled(panel, panel["marks"])
            readers[key] = Reader.of(rng, panel, tilt, marks, click)
        curve = true_curve(name, series["columns"]) * [1.0, dict(factors).get(series["id"], 1.0)]
        (low, high), reader = panel["range"][0], readers[key]
        if series["line"]:
            shown = np.all(np.abs(scaled(panel, curve)) <= 1.0, axis=1)
            curve = curve[shown]
            given.append(reader.line(series, curve, rng.choice(LINES), 15))
        else:
            x = low + (high - low) * np.linspace(0.05, 0.9, 9)
            given.append(reader.markers(series, np.transpose([x, np.interp(x, *curve.T)])))
    with scripts() as page_of, tempfile.TemporaryDirectory() as folder:
        return judged(page_of.map("read", given), folder)


def true_curve(name, columns):
    """The curve with which a comparison is made, as a print shows it that is right."""
    entry = config()["comparisons"][name]
    return tables.select(solved(entry["figure"]), **entry["curve"])[columns].dropna().to_numpy()


@functools.cache
def solved(figure):
    return tables.read(RUN / f"results/curves/{figure}.csv")


def judged(answers, folder):
    """Verdicts of all comparisons that a run makes with these answers of the page."""
    known = {
        source: {**own, "series": dict(own.get("series", {}))} for source, own in sources().items()
    }
    read, found = set(), {}
    for (_, series, name), answer in zip(readable(), answers, strict=True):
        if "refused" in answer:
            found[name] = answer["refused"]
            continue
        source, own = series["id"].split("/")
        file = Path(folder, source, f"{own}.csv")
        file.parent.mkdir(exist_ok=True)
        file.write_text(answer["text"], encoding="utf-8")
        known[source]["series"][own] = reading.filled(known[source]["series"][own], file)
        read.add(name)
    comparisons = checked({}, known)
    for figure in sorted({comparisons[name].figure for name in read}):
        own = [
            one
            for name, one in comparisons.items()
            if one.figure == figure and (name in read or one.metric == "ratio")
        ]
        path = str(RUN / f"results/curves/{figure}.csv")
        rows = compare(figure, path, own, config()["significance"], {})
        found |= {row["comparison"]: row["verdict"] for row in rows}
    return found


# --- the tables ---

COLUMNS = [("markers", number) for number in POINTS] + [("line", width) for width in LINES]
ROWS = list(itertools.product(MARKS, CLICKS, TILTS))


def share(verdicts, *wanted):
    """How many of the readings of which there is a file have such a verdict, in per cent."""
    made = [one for one in verdicts if one in set(Verdict)]
    return 100 * sum(one in wanted for one in made) / len(made) if made else np.nan


def row(place):
    """False alarms, power and lost lines in per cent, in each column."""
    found = []
    for number, column in enumerate(COLUMNS):
        seed = place * len(COLUMNS) + number
        setting, trials = (ROWS[place], column), TRIALS[column[0]]
        right = cell(setting, trials[0], 1.0, 2 * seed)
        wrong = cell(setting, trials[1], WRONG_BY, 2 * seed + 1)
        lost = 100 * sum(one not in set(Verdict) for one in right) / len(right)
        found.append((share(right, Verdict.DIFFERS), share(wrong, Verdict.DIFFERS), lost))
    return found


def main():
    if not (RUN / "figures/your_copy.html").is_file():
        sys.exit("figures/your_copy.html is missing: run snakemake first")
    kinds = {"markers": "points: {}", "line": "line: {} px"}
    names = [kinds[kind].format(size) for kind, size in COLUMNS]
    print(f"False alarms / power against {WRONG_BY:g} times the curve, in %; {TRIALS}")
    print("| marks | click, px |", " | ".join(names), "| refused |")
    with concurrent.futures.ProcessPoolExecutor(2) as both:
        every = both.map(row, range(len(ROWS)))
        for (marks, click), of_tilts in itertools.groupby(ROWS, lambda place: place[:2]):
            false, power, refused = np.transpose([next(every) for _ in of_tilts], (2, 0, 1))
            worst = zip(false.max(axis=0), power.min(axis=0), strict=True)
            cells = [f"{most:.1f} / {least:.0f}" for most, least in worst]
            print(
                f"| {marks} | {click:g} |",
                " | ".join(cells),
                f"| {refused.max():.1f} |",
                flush=True,
            )
        runs = list(both.map(whole_run, range(RUNS)))
    failed = sum(Verdict.DIFFERS in found.values() for found in runs)
    print(f"Runs with all {len(readable())} series right with one that differs: {failed} of {RUNS}")


if __name__ == "__main__":
    main()
