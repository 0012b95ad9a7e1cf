"""What a student writes into a lecture: all cells use it, or one sentence refuses it."""

import ast
import re

import matplotlib
import matplotlib.pyplot as plt
import nbformat
import pytest

from stronge1994.pages import stated_numbers
from tests.workflow.project import ROOT

FOLDER = ROOT / "workflow/notebooks"
OTHERS = "choosing_a_model", "where_friction_turns_round"
NAMES = "why_a_superball_comes_back", *OTHERS
WRONG = "0,5", "'0.5'", "None", "float('nan')", "-1e9", "1e9"
ROW = "[0, 100, 300, 40]"
ROWS = f"[{ROW}, [2, 120, 250, 40]]"
LATER = "[[12, 140, 50, 40], [14, 150, 90, 50]]"


def readings(steep, after=LATER, flat=ROWS):
    """An entry that fills the lists of readings."""
    halves = [(name, half) for name in ("steep", "flat") for half in ("before", "after")]
    filled = zip(halves, (steep, after, flat, LATER), strict=True)
    return "READINGS = {" + ", ".join(f"{half}: {rows}" for half, rows in filled) + "}"


def code_of(name):
    """The cells of code of a lecture by their ids, without its checks."""
    cells = nbformat.read(FOLDER / f"{name}.ipynb", as_version=4).cells
    return {
        cell.id: cell.source
        for cell in cells
        if cell.cell_type == "code" and not stated_numbers.is_check(cell)
    }


def numbers_of(name):
    """The names of the numbers that a student may change."""
    return re.findall(r"^([A-Z_]+) = ", code_of(name)["numbers"], flags=re.M)


@pytest.fixture
def executed(monkeypatch):
    """Function: the names after all cells, or some, with `entry` below the cell `place`."""
    matplotlib.use("Agg")
    monkeypatch.chdir(FOLDER)
    code = code_of("why_a_superball_comes_back")

    def run(entry, place="numbers", only=()):
        names = {}
        with matplotlib.rc_context():
            for cell, source in code.items():
                if not only or cell in only:
                    source = f"{source}\n{entry}" if cell == place else source
                    exec(compile(source, cell, "exec"), names)
                plt.close("all")
        return names

    return run


@pytest.mark.parametrize("name", NAMES)
def test_each_wrong_number_is_one_sentence_with_its_name_and_what_is_allowed(name, monkeypatch):
    """Also one that is just beyond the range that the sentence names."""
    monkeypatch.chdir(FOLDER)
    matplotlib.use("Agg")
    code, names = code_of(name), {}
    # Where the numbers stand, and what refuses them: there or in the next cell.
    cell = "\n".join(code[place] for place in ("numbers", "bounce") if place in code)
    with matplotlib.rc_context():
        exec(code["style"], names)
    for number in numbers_of(name):
        wrong = list(WRONG)
        for entry in wrong:  # which grows
            changed, count = re.subn(rf"(?m)^{number} = \S+", f"{number} = {entry}", cell)
            assert count == 1
            with pytest.raises(ValueError, match=rf"^{number} = ") as said:
                exec(changed, names)  # `allow` looks there
            allowed = r".*: allowed is one number from (\S+) to (\d+(?:\.\d+)?)\b.*with a point"
            ends = re.match(allowed, str(said.value))
            assert ends and "\n" not in str(said.value)
            wrong += [f"{float(ends[1]) - 0.01}", f"{1.01 * float(ends[2])}"] * (entry == "None")


def test_a_throw_whose_contact_point_is_at_rest_is_refused(executed):
    words = r"ALONG = 5\.0 with SPIN = 200: the lowest point of the ball is at rest, .*\.$"
    with pytest.raises(ValueError, match=words):
        executed("SPIN = 200", only=("style", "numbers", "bounce"))


@pytest.mark.parametrize(
    ("entry", "words"),
    [
        (readings(f"[{ROW}, [2, 120, 250,5, 40]]"), "READINGS, steep, before, row 2 is 5 numbers"),
        (readings(ROW), "READINGS, steep, before, row 1 is 0: a row is 4 numbers in brackets"),
        (readings("[]"), r"READINGS: 1 of 4 lists are empty \(steep, before\)"),
        (readings("[]", "[]", "[]"), "READINGS: 3 of 4 lists are empty"),
        (readings(f"[{ROW}]"), "READINGS, steep, before has 1 row: .* needs 2 or more"),
        (readings(f"[{ROW}, [2, 120, -250, 40]]"), ".*row 2: up = -250 px is below the floor"),
        (readings(f"[{ROW}, [0, 120, 250, 40]]"), ".*row 2: frame 0 does not come after frame 0"),
        (readings(f"[{ROW}, [2, 'far', 250, 40]]"), ".*row 2: along = 'far' is not a number"),
        (readings(ROWS, after=ROWS), "READINGS, steep: the first frame after the bounce, 0, must"),
        (readings("[[0, 100, 50, 40], [2, 120, 300, 40]]"), "READINGS, steep: by `up` the ball do"),
        (readings("[[0, 120, 300, 40], [2, 100, 250, 40]]"), "READINGS, steep: .*to the right"),
        ("READINGS = {}", "READINGS needs four lists"),
        ("FRAME_RATE = 0", "FRAME_RATE = 0: allowed is one number from 10 to 100000"),
        ("DIAMETER = 5.0", r"DIAMETER = 5\.0: allowed is one number from 0\.005 to 0\.5"),
        ("DIAMETER = 4,5", r"DIAMETER = \(4, 5\): allowed"),
        ("ERRORS['angle'] = -1", "ERRORS, angle = -1: allowed is one number from 0 on"),
    ],
)
def test_a_reading_that_is_not_allowed_is_refused_in_one_sentence(entry, words, executed):
    only = "style", "numbers", "bounce", "readings", "readings-refused", "example", "analysis"
    with pytest.raises(ValueError, match=rf"^{words}") as refusal:
        executed(entry, "readings", only)
    assert "\n" not in str(refusal.value)


def test_readings_take_the_place_of_the_example(executed, capsys):
    only = "style", "numbers", "bounce", "readings", "readings-refused", "example", "analysis"
    names = executed(readings(ROWS), "readings", only)
    assert capsys.readouterr().out.startswith("MEASURED")
    assert names["readings"] is names["READINGS"]


@pytest.mark.parametrize(
    "entry",
    [
        "MU, RESTITUTION = 0.02, 1",
        *(
            pytest.param(entry, marks=pytest.mark.long)
            for entry in (
                "ALONG, DOWN = 50, 0.1",
                "SPIN = -300",
                "POISSON_RATIO, SPIN = 0, 300",
                "RESTITUTION, TABLE = 0.1, 0.1",
            )
        ),
    ],
)
def test_all_cells_use_a_number_that_is_allowed_and_say_so(entry, executed, capsys):
    names = executed(entry)
    used = [line for line in capsys.readouterr().out.splitlines() if line.startswith("Used: ")]
    assert len(used) == 3  # each of the cells to change
    for line, given in zip(
        used,
        [
            ("ALONG", "DOWN", "SPIN", "MU", "RESTITUTION"),
            ("RESTITUTION", "POISSON_RATIO"),
            ("MU", "RESTITUTION", "POISSON_RATIO"),
        ],
        strict=True,
    ):
        assert all(f" = {names[name]:g}" in line for name in given), line


def test_the_spin_that_a_student_writes_is_clockwise(executed):
    """A ball that spins as it rolls has its lowest point at rest; backspin moves it forward."""
    names = executed("SPIN = -100", only=("style", "numbers", "bounce"))
    assert names["contact_point"](names["THROWN"]) == pytest.approx(5 + 0.025 * 100)
    after = names["throw"]()[1]
    assert after.spin > names["THROWN"].spin and after.tangential < 5, "friction pushes back"


@pytest.mark.parametrize("entry", ["", "ALONG, DOWN = 50, 0.1", "ALONG, SPIN = 15, -300"])
def test_a_changed_throw_stays_in_its_picture(entry, executed):
    names = executed(entry, only=("style", "numbers", "bounce", "path-stopped"))
    names["draw_throw"](names["rigid"], names["lumped"])
    axes = plt.gca()
    left, right = sorted(axes.get_xlim())
    paths = [line.get_xdata() for line in axes.lines if len(line.get_xdata()) == 5]
    assert len(paths) == 2
    assert all(left < place < right for path in paths for place in path)
    plt.close("all")


# ---- the other lectures


@pytest.mark.parametrize("name", OTHERS)
def test_each_number_is_used_and_each_cell_to_play_with_starts_from_them(name):
    code = code_of(name)
    cells = list(code)
    below = {place: code[place] for place in cells[cells.index("numbers") + 1 :]}
    for number in numbers_of(name):
        assert re.search(rf"\b{number}\b", "\n".join(below.values())), number
    games = [source for source in below.values() if re.search(r"^play\(", source, flags=re.M)]
    assert len(games) == 3
    for game in games:
        shown = next(one for one in ast.parse(game).body if isinstance(one, ast.FunctionDef))
        starts = {getattr(value, "id", ast.unparse(value)) for value in shown.args.defaults}
        assert starts and starts <= {*numbers_of(name)}
        assert "print(f" in ast.unparse(shown), "says what it used"
