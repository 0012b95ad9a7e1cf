"""What may stand in data/: YAML, tables and exports are read as they are meant, or refused."""

import collections
import itertools
import random
from pathlib import Path

import pytest
import yaml

from stronge1994 import reference_data
from stronge1994.reference_data import digitiser_export

ROOT = Path(__file__).parents[2]
SCHEMA = reference_data.load_yaml(ROOT / "workflow/schemas/source.schema.yaml")
AXES = {
    "x": {"column": "incidence", "unit": "1", "sigma": 0.02, "range": [0, 20]},
    "y": {"column": "velocity", "unit": "1", "sigma": 0.01, "range": [-5, 20]},
}
X, Y = "incidence [1]", "velocity [1]"
HEADER = f"{X},{Y}\n"


def read(folder, text, kind="awaited"):
    """x and y of a series that holds this text."""
    path = folder / "mine.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    found = reference_data.read_series("mine", {"kind": kind, "path": str(path), **AXES})
    return list(zip(found[X], found[Y], strict=True))


EXPORTS = {
    "one dataset": "0.5, -0.05\n1, 2.5e-1\n",
    "decimal commas": "0,5; -0,05\n1; 2,5e-1\n",
    "semicolons and points": "0.5;-0.05\n1;0.25\n",
    "BOM, CRLF and a blank line": "\ufeff0.5,-.05\r\n\r\n1.,+0.25\r\n",
    "several datasets": "a,,mine,\nX,Y,X,Y\n7,7,0.5,-0.05\n,,1,0.25\n8,8,,\n",
    "names with commas": "e = 1, dry,,mine,,b,\nX,Y,X,Y,X,Y\n0,0,0.5,-0.05,9,9\n,,1,.25,,\n",
    "one dataset under headers": "Default Dataset,\nX,Y\n0.5,-0.05\n1,0.25\n",
}


@pytest.mark.parametrize("text", EXPORTS.values(), ids=EXPORTS)
def test_every_form_of_an_export_gives_its_points(text, tmp_path):
    assert read(tmp_path, text) == [(0.5, -0.05), (1.0, 0.25)]


NAMES = "has words; export this dataset alone, and delete its line of names"
ALONE = "export this dataset alone, without groups"
BAD_EXPORTS = [
    ("steel disc,\nX,Y\n1,2\n", "datasets 'steel disc'; call one 'mine', or export it alone"),
    ("a,,b,\nX,Y,X,Y\n1,1,2,2\n", "datasets 'a', 'b'; call one 'mine'"),
    ("mine,,mine,\nX,Y,X,Y\n1,1,2,2\n", "datasets 'mine', 'mine'; call one 'mine'"),
    ("a,,,mine,\nX,Y,X,Y\n1,1,2,2\n", "not certain how 'a,,,mine,' names the columns X,Y,X,Y; exp"),
    ("Fig. 5\nX,Y\n1,2\n", "not certain how 'Fig. 5' names the columns X,Y; export 'mine' alone"),
    ("mine;;b;\nX;Y;X;Y\n0,5;-0,05;7;7\n", f"line 1: 'mine;;b;' {NAMES}"),  # a spreadsheet's
    ("0.5, -0.05\n0,5, -0,05\n", f"line 2: '0,5, -0,05' has 4 columns; {ALONE}; .* semicolons"),
    ("mine,,b,\nX,Y,X,Y\n0,5,1,2,0,5,1,2\n", "line 3: 8 cells below 2 times X,Y; export 'mine'"),
    ("0.5,1,\n", f"line 1: '0.5,1,' has 3 columns; {ALONE}; if these are decimal commas"),
    ("0.5, -0.05, 0, Group 1\n", f"has 4 columns; {ALONE}"),
    ("0,5; -0,05; 0; Group 1\n", f"has 4 columns; {ALONE}$"),
    ("0.5 1.5\n", "line 1: '0.5 1.5' has one column; put a comma between x and y"),  # plotdigitizer
    ("x,Curve1\n0.5,1.5\n", f"line 1: 'x,Curve1' {NAMES}"),  # Engauge Digitizer
    ("# x, Curve1, Curve2\n0.5, 1.5, 1.6\n", f"line 1: '# x, Curve1, Curve2' {NAMES}"),
    ("X,Y\n1,2\n", f"line 1: 'X,Y' {NAMES}"),
    ('"0,5","-0,05"\n', "line 1: .* has quotation marks; delete them, or export again"),
    ('0.5, "1.5"\n', "line 1: .* has quotation marks"),
    ("0.5,1\n2;1\n", "line 1: '0.5,1' has one column; put a semicolon between x and y"),
    ("0,5;1\n0.6;1\n", r"line 2, column 'incidence \[1\]': '0.6' is not a decimal number such as"),
    ("1.000,5;1\n", r"line 1, column 'incidence \[1\]': '1.000,5' is not a decimal number"),
    ("1,1\n0,5\t1,5\n", "line 2: a tab; cells are separated by commas or semicolons"),
    ("1,2\n,3\n", r"line 2, column 'incidence \[1\]': '' is not a decimal number"),
    ("a,,mine,\nX,Y,X,Y\n1,1\n", "line 3: 2 cells below 2 times X,Y"),
    ('a,,mine,\nX,Y,X,Y\n"0,5","1,5"\n', "'.1' is not a decimal number"),
    ('1,"2\n3,4\n', "line 1: .* has quotation marks"),
    ("1_000,1\n", "'1_000' is not a decimal number"),
    ("nan,1\n", "line 1: 'nan,1' has words"),
    ("1,inf\n", "'inf' is not a decimal number"),
    ("1,\u22120.5\n", r"'\u22120.5' \(minus sign\) is not a decimal number"),
    ("1e999,1\n", "1e999 is outside 0 to 20"),
    ("", "no points"),
    ("1,2\n\n".encode("utf-16"), "line 1: the file is UTF-16; save the file as UTF-8"),
    ("1,2\n".encode("utf-16-le"), "line 1: a NUL byte; save the file as UTF-8"),
    (b"1,2\n\xff,3\n", "line 2: byte 0xff is no UTF-8"),
]


@pytest.mark.parametrize(("text", "words"), BAD_EXPORTS)
def test_a_bad_export_is_refused(text, words, tmp_path):
    with pytest.raises(reference_data.SourceError, match=words) as refusal:
        read(tmp_path, text)
    assert f"{tmp_path / 'mine.csv'}" in str(refusal.value) and "\n" not in str(refusal.value)


def all_datasets(named):
    """What WebPlotDigitizer writes of all datasets: `[(name, points), ...]`."""
    titles = [cell for name, _ in named for cell in (name, "")]
    rows = itertools.zip_longest(*(points for _, points in named), fillvalue=("", ""))
    cells = [titles, ["X", "Y"] * len(named), *(itertools.chain(*row) for row in rows)]
    return "".join(",".join(map(str, row)) + "\n" for row in cells)


PARTS_OF_NAMES = [
    *("mine", "Default Dataset", "X", "Y", "X,Y", "1", "-0.5", "nu = 0.5", "é", "中", "", "="),
    *(",", ",", ",,", ";", '"', '""', "'", " ", "\xa0", "\t", "\r", "\u2028", "\ufeff", "\n"),
]  # fmt: skip


def test_no_name_of_a_dataset_leads_to_the_points_of_another():
    """Of thousands of exports the points are right or refused; with harmless names, right."""
    rng = random.Random(1)
    outcomes = collections.Counter()
    for _ in range(20_000):
        names = ["".join(rng.choices(PARTS_OF_NAMES, k=rng.randint(1, 3))) for _ in range(4)]
        names = names[: rng.randint(0, 4)]
        place = rng.randint(0, len(names))
        names.insert(place, "mine")
        named = [
            (name, [(10 * i + j + 0.5, -j) for j in range(rng.randint(1, 3))])
            for i, name in enumerate(names)
        ]
        lines = [f"{line}\n" for line in all_datasets(named).split("\n")]
        wanted = [[str(x), str(y)] for x, y in named[place][1]]
        harmless = not any(name == "" or set(name) & set(",\n") for name in names)
        once = [name.strip() for name in names].count("mine") == 1
        try:
            mark, found = digitiser_export.points(lines, "mine")
        except ValueError as error:
            assert not (harmless and once), names
            assert "alone" in str(error) or "\n" in "".join(names), names
            outcomes["refused"] += 1
        else:
            assert (mark, [pair for _, pair in found]) == (".", wanted), names
            outcomes["with commas" if "," in "".join(names) else "read"] += 1
    assert min(outcomes.values()) > 2000 and len(outcomes) == 3, outcomes


def test_no_separator_leads_to_other_points():
    """Of one dataset: either decimal mark, any separator that a user may type, and groups."""
    rng = random.Random(1)
    numbers = [0.5, -0.05, 3, 0, 12, 1e-7, 2.5e-7, -1e-3, 1.25]
    outcomes = collections.Counter()
    for separator in (", ", ",", ";", "; ", " ; ", " ", "  ", ":", "|", ",,", " ,", ";;"):
        for mark, more in itertools.product(".,", ((), (0,), (0, "Group 1"), ("", ""))):
            for _ in range(50):
                rows = [rng.choices(numbers, k=2) for _ in range(rng.randint(1, 3))]
                lines = [
                    separator.join(str(n).replace(".", mark, 1) for n in (*row, *more)) + "\n"
                    for row in rows
                ]
                try:
                    found = digitiser_export.points(lines, "mine")
                    forms, pairs = digitiser_export.NUMBERS[found[0]], [row for _, row in found[1]]
                    sure = all(forms.fullmatch(cell) for pair in pairs for cell in pair)
                except ValueError:
                    sure = False
                if sure:
                    read_ = [[float(cell.replace(",", ".")) for cell in pair] for pair in pairs]
                    assert read_ == rows, lines
                outcomes[separator.strip(" "), mark, more, sure] += 1
    for separator, mark in ((",", "."), (";", "."), (";", ",")):
        assert not outcomes[separator, mark, (), False]


BAD_TABLES = [
    ("1_0,2\n", "line 2, column 'incidence .*': '1_0' is not a decimal number"),
    ("1,2\n1,5,2\n", "line 3: 3 cells where 2 belong"),
    ("1;2\n", "line 2: 1 cells where 2 belong"),
    ('"1,5",2\n', "line 2, .*'1,5' is not a decimal number"),
]


@pytest.mark.parametrize(("text", "words"), BAD_TABLES)
def test_tables_of_this_project_have_commas_and_decimal_points(text, words, tmp_path):
    assert read(tmp_path, f"{HEADER}1,2\n", "digitised") == [(1.0, 2.0)]
    with pytest.raises(reference_data.SourceError, match=words):
        read(tmp_path, HEADER + text, "digitised")
    with pytest.raises(reference_data.SourceError, match="'velocity .*' stands twice"):
        read(tmp_path, f"{X},{Y},{Y}\n1,2,3\n", "digitised")


@pytest.mark.parametrize("kind", ["awaited", "digitised", "computed"])
def test_a_point_may_lie_three_sigmas_outside_the_range(kind, tmp_path):
    header = "" if kind == "awaited" else HEADER
    assert read(tmp_path, f"{header}-0.06,-5.03\n20.06,20.03\n", kind)[0] == (-0.06, -5.03)
    for row in ("-0.061,1", "20.061,1", "1,-5.031"):
        words = "is outside .* by more than 3 sigmas, 0.0"
        with pytest.raises(reference_data.SourceError, match=words):
            read(tmp_path, f"{header}{row}\n", kind)


def test_of_a_long_file_no_more_is_read_than_is_allowed(tmp_path):
    """What follows the last line allowed is not even looked at."""
    most = reference_data.MOST_LINES
    assert len(read(tmp_path, "1,2\n" * most)) == most
    with pytest.raises(reference_data.SourceError, match=f"more than {most} lines"):
        read(tmp_path, b"1,2\n" * (most + 1) + b"\xff\0\n")


def source(folder, text):
    """Load data/johnson1983 after an edit of its source.yaml."""
    old = (ROOT / "data/johnson1983/source.yaml").read_text()
    new = text(old)
    assert new != old
    (folder / "source.yaml").write_text(new)
    return reference_data.load(folder, SCHEMA)


def test_a_sigma_so_large_that_it_says_nothing_is_refused(tmp_path):
    where = "series.rubber_sphere.{}.sigma = {}: allowed is up to {}, a hundredth of the range"
    for axis, range_, most in (("x", "[0, 10]", 0.1), ("y", "[-3, 3]", 0.06)):
        stated = f"sigma: 0.03, range: {range_}"
        for sigma in (most, 2 * most):
            change = (stated, f"sigma: {sigma}, range: {range_}")
            if sigma == most:
                source(tmp_path, lambda text, change=change: text.replace(*change))
                continue
            with pytest.raises(reference_data.SourceError) as refusal:
                source(tmp_path, lambda text, change=change: text.replace(*change))
            assert where.format(axis, sigma, most) in str(refusal.value)
    with pytest.raises(reference_data.SourceError, match=r"x.range = \[10, 0\]: the first number"):
        source(tmp_path, lambda text: text.replace("range: [0, 10]", "range: [10, 0]"))


def test_an_export_of_another_name_is_told_its_own(tmp_path):
    (tmp_path / "rubber_sphere.csv").write_text("1,2\n")
    with pytest.raises(reference_data.SourceError, match="allowed are rubber_sphere.wpd.csv"):
        source(tmp_path, lambda text: text + "\n")


BAD_YAML = {
    "a date": ("a: 1\nb: 2020-12-31", "line 2: '2020-12-31' is a timestamp; a text has quotes"),
    "octal": ("a: 0400", "line 1: '0400' is no decimal number"),
    "minutes": ("a: 6:40", "line 1: '6:40' is no decimal number"),
    "an integer": ("a: !!int abc", "line 1: 'abc' is no decimal number"),
    "a number too long": ("a: " + "9" * 5000, "line 1: '9+' is no decimal number"),
    "deep": ("a: " + "[" * 5000 + "]" * 5000, "line 1: too deep"),
    "a NUL": ("a: 1\nb: \0", "line 2: a NUL byte"),
    "a control character": ("a: 1\nb: \a", r"control characters are not allowed"),
    "Latin-1": ("a: 1\nb: é".encode("latin-1"), "line 2: byte 0xe9 is no UTF-8"),
    "UTF-16": ("a: 1".encode("utf-16"), "line 1: the file is UTF-16"),
    "a list as key": ("a: 1\n[1, 2]: 3", "line 2: the key .* is no text"),
    "a number as key": ("1: a", "line 1: the key '1' is no text"),
    "a key twice": ("a: 1\nb: 2\na: 3", "line 3: the key 'a' stands twice"),
    "a tag": (
        "a: !!python/object/apply:os.getcwd []",
        "line 1: .* is a os.getcwd; a text has quotes",
    ),
    "a list": ("- 1", "line 1: keys with values belong here"),
    "a word": ("word", "line 1: keys with values belong here"),
    "empty": ("", "line 1: keys with values belong here"),
    "a bracket": ("a: [1", ": while parsing a flow sequence"),
    "two documents": ("a: 1\n---\nb: 1", "line 2: expected a single document"),
}


@pytest.mark.parametrize(("text", "words"), BAD_YAML.values(), ids=BAD_YAML)
def test_bad_yaml_is_refused_in_one_line(text, words, tmp_path):
    path = tmp_path / "a.yaml"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(reference_data.SourceError, match=words) as refusal:
        reference_data.load_yaml(path)
    assert str(refusal.value).startswith(f"{path}, line") and "\n" not in str(refusal.value)
    with pytest.raises(reference_data.SourceError, match="^.*no.yaml: No such file or directory$"):
        reference_data.load_yaml(tmp_path / "no.yaml")


def test_a_merge_may_be_overridden_and_merged_again(tmp_path):
    path = tmp_path / "a.yaml"
    path.write_text("top:\n  c: {<<: &b {<<: &a {k: 1}, k: 2}, k: 3}\nb: *b\na: *a\n")
    assert reference_data.load_yaml(path) == {
        "top": {"c": {"k": 3}}, "b": {"k": 2}, "a": {"k": 1},
    }  # fmt: skip


PRINTED = {
    "kind": "stated",
    "x": {"column": "e", "unit": "1", "sigma": "e_uncertainty", "range": [0, 1]},
    "y": {"column": "b", "unit": "1", "sigma": "b_uncertainty", "range": [-1, 1]},
    "given": [{"column": "mu", "unit": "1", "sigma": "mu_uncertainty", "range": [0, 2]}],
    "labels": ["pair"],
}
PRINTED_HEADER = "pair,e [1],e_uncertainty [1],b [1],b_uncertainty [1],mu [1],mu_uncertainty [1]\n"


def printed(folder, text):
    """The columns of a stated series that holds this text."""
    path = folder / "pairs.csv"
    path.write_text(text)
    return reference_data.read_series("pairs", {"path": str(path), **PRINTED})


def test_stated_values_have_uncertainties_of_their_own(tmp_path):
    found = printed(tmp_path, f"{PRINTED_HEADER}glass,0.9,0.01,0.4,0.3,0.1,0.00\n")
    assert found["b_uncertainty [1]"] == [0.3] and found["mu [1]"] == [0.1]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (f"{PRINTED_HEADER}glass,1.01,0.01,0.4,0.1,0.1,0\n", "'e .1.': 1.01 is outside 0 to 1"),
        (f"{PRINTED_HEADER}glass,0.9,-0.01,0.4,0.1,0.1,0\n", "'e_uncertainty .*-0.01 is outside"),
        (f"{PRINTED_HEADER}glass,0.9,0.01,0.4,,0.1,0\n", "'b_uncertainty .*'' is not a decimal"),
        (f"{PRINTED_HEADER}glass,0.9,0.01,0.4,0.1,9,0\n", "'mu .1.': 9 is outside 0 to 2"),
        ("pair,e [1]\nglass,0.9\n", "column 'b .1.' is missing"),
    ],
)
def test_bad_stated_values_are_refused(text, words, tmp_path):
    with pytest.raises(reference_data.SourceError, match=words):
        printed(tmp_path, text)


@pytest.mark.parametrize(
    ("source", "old", "new"),
    [
        ("cornell1999", "sigma: restitution_uncertainty", "sigma: 0.01"),
        ("kharaz2001", "sigma: 0.0016", "sigma: printed"),
    ],
)
def test_uncertainties_are_columns_of_stated_series_alone(source, old, new):
    text = (ROOT / f"data/{source}/source.yaml").read_text(encoding="utf-8")
    assert old in text
    with pytest.raises(reference_data.SourceError, match=r"sigma: .* is not of type"):
        reference_data.refuse_invalid(yaml.safe_load(text.replace(old, new, 1)), SCHEMA, source)


MEASURED = """
holds: a marble on a plate
made: measured by hand
citation: measured by a test
doi: null
rights: free to use
sign_convention: negative where the contact point has turned round
parameters: {}
series:
  rebound:
    kind: measured
    measured_by: a test, today, by eye
    points: 2
    figure: marble
    x: {column: angle, symbol: theta, unit: deg, sigma: 5, range: [0, 90]}
    y: {column: share, symbol: s, unit: "1", sigma: share_uncertainty, range: [-1, 1]}
    sigma_origin: spread of three throws
"""


def measured(folder, old="", new=""):
    """The series of a measured source, after an edit of its source.yaml."""
    folder = folder / "marble"
    folder.mkdir()
    (folder / "source.yaml").write_text(MEASURED.replace(old, new))
    (folder / "rebound.csv").write_text(
        "angle [deg],share [1],share_uncertainty [1]\n9,0,1\n20,-0.1,0.2\n"
    )
    return reference_data.load(folder, SCHEMA)["series"]["rebound"]


def test_a_measured_series_has_sigmas_by_column_or_one_however_large(tmp_path):
    series = measured(tmp_path)
    assert series["x"]["sigma"] == 5
    assert reference_data.read_series("rebound", series)["share_uncertainty [1]"] == [1.0, 0.2]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("    measured_by: a test, today, by eye\n", "", "'measured_by' is a required property"),
        ("points: 2", "points: 3", "points = 3: .*rebound.csv has 2 points"),
        ("share_uncertainty", "spread", r"column 'spread \[1\]' is missing; found angle"),
        ("sigma: 5", "sigma: 0", "x.sigma: 0 is less than or equal to the minimum of 0"),
        ("    points: 2\n", "    points: 2\n    line: true\n", "line: False was expected"),
        ("spread of three throws", "invented", "'invented' is too short; .* of 10 characters or"),
    ],
)
def test_a_measured_series_without_what_it_needs_is_refused(old, new, words, tmp_path):
    with pytest.raises(reference_data.SourceError, match=words):
        measured(tmp_path, old, new)
