"""What may stand in data/: YAML and tables are read as they are meant, or refused."""

from pathlib import Path

import pytest
import yaml

from stronge1994 import reference_data

ROOT = Path(__file__).parents[2]
SCHEMA = reference_data.load_yaml(ROOT / "workflow/schemas/source.schema.yaml")
AXES = {
    "x": {"column": "incidence", "unit": "1", "sigma": 0.02, "range": [0, 20]},
    "y": {"column": "velocity", "unit": "1", "sigma": 0.01, "range": [-5, 20]},
}
X, Y = "incidence [1]", "velocity [1]"
HEADER = f"{X},{Y}\n"


def read(folder, text):
    """x and y of a digitised series that holds this text."""
    path = folder / "mine.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    found = reference_data.arrays({"kind": "digitised", "path": str(path), **AXES})
    return list(zip(found[X], found[Y], strict=True))


@pytest.mark.parametrize(
    "text",
    [
        f"{HEADER}0.5,-0.05\n1,2.5e-1\n",
        f"\ufeff{HEADER}0.5, -.05\r\n1.,+0.25\r\n",  # BOM, CRLF and blanks
        f"who,{Y},{X}\nme,-0.05,0.5\nme,0.25,1\n",  # columns are known by their names
    ],
)
def test_a_table_gives_its_points(text, tmp_path):
    assert read(tmp_path, text) == [(0.5, -0.05), (1.0, 0.25)]


BAD_TABLES = [
    ("0.5,-0.05\n", r"column 'incidence \[1\]' is missing; found 0.5, -0.05"),  # no header
    (f"{X};{Y}\n0,5;-0,05\n", r"column 'incidence \[1\]' is missing"),
    (f"{X},{Y},{Y}\n1,2,3\n", "'velocity .*' stands twice"),
    (f"{HEADER}1_0,2\n", "line 2, column 'incidence .*': '1_0' is not a decimal number"),
    (f"{HEADER}1,nan\n", "line 2, column 'velocity .*': 'nan' is not a decimal number"),
    (f"{HEADER}1,inf\n", "'inf' is not a decimal number"),
    (f"{HEADER}1,\n", "'' is not a decimal number"),
    (f"{HEADER}1,\u22120.5\n", r"'\\u22120.5' is not a decimal number"),
    (f"{HEADER}1e999,1\n", "1e999 is outside 0 to 20"),
    (f"{HEADER}1,2\n1,5,2\n", "line 3: 3 cells where 2 belong"),
    (f"{HEADER}1;2\n", "line 2: 1 cells where 2 belong"),
    (f'{HEADER}"1,5",2\n', "line 2, .*'1,5' is not a decimal number"),
    (f'{HEADER}1,"2\n3,4\n', "unexpected end of data"),
    (HEADER, "no points"),
    ("", "is missing"),
    (f"{HEADER}1,2\n".encode("utf-16"), "line 1: byte 0xff is no UTF-8; save the file as UTF-8"),
    (HEADER.encode() + b"1,2\n\xff,3\n", "line 3: byte 0xff is no UTF-8"),
]


@pytest.mark.parametrize(("text", "words"), BAD_TABLES)
def test_a_bad_table_is_refused_in_one_line(text, words, tmp_path):
    with pytest.raises(reference_data.SourceError, match=words) as refusal:
        read(tmp_path, text)
    assert f"{tmp_path / 'mine.csv'}" in str(refusal.value) and "\n" not in str(refusal.value)


def test_a_point_may_lie_three_sigmas_outside_the_range(tmp_path):
    assert read(tmp_path, f"{HEADER}-0.06,-5.03\n20.06,20.03\n")[0] == (-0.06, -5.03)
    for row in ("-0.061,1", "20.061,1", "1,-5.031"):
        words = "is outside .* by more than 3 sigmas, 0.0"
        with pytest.raises(reference_data.SourceError, match=words):
            read(tmp_path, f"{HEADER}{row}\n")


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


def test_a_table_of_an_awaited_series_is_told_what_to_change(tmp_path):
    (tmp_path / "rubber_sphere.csv").write_text("1,2\n")
    with pytest.raises(reference_data.SourceError, match="becomes `kind: digitised`"):
        source(tmp_path, lambda text: text + "\n")


BAD_YAML = {
    "a date": ("a: 1\nb: 2020-12-31", "line 2: '2020-12-31' is a timestamp; a text has quotes"),
    "octal": ("a: 0400", "line 1: '0400' is no decimal number"),
    "minutes": ("a: 6:40", "line 1: '6:40' is no decimal number"),
    "an integer": ("a: !!int abc", "line 1: 'abc' is no decimal number"),
    "a number too long": ("a: " + "9" * 5000, "line 1: '9+' is no decimal number"),
    "deep": ("a: " + "[" * 5000 + "]" * 5000, "line 1: too deep"),
    "a NUL": ("a: 1\nb: \0", "control characters are not allowed"),
    "a control character": ("a: 1\nb: \a", r"control characters are not allowed"),
    "Latin-1": ("a: 1\nb: é".encode("latin-1"), "line 2: byte 0xe9 is no UTF-8"),
    "UTF-16": ("a: 1".encode("utf-16"), "line 1: byte 0xff is no UTF-8"),
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
    return reference_data.arrays({"path": str(path), **PRINTED})


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
    assert reference_data.arrays(series)["share_uncertainty [1]"].tolist() == [1.0, 0.2]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("    measured_by: a test, today, by eye\n", "", "'measured_by' is a required property"),
        ("points: 2", "points: 3", "points = 3: .*rebound.csv has 2 points"),
        ("share_uncertainty", "spread", r"column 'spread \[1\]' is missing; found angle"),
        ("sigma: 5", "sigma: 0", "x.sigma: 0 is less than or equal to the minimum of 0"),
        ("spread of three throws", "invented", "'invented' is too short; .* of 10 characters or"),
    ],
)
def test_a_measured_series_without_what_it_needs_is_refused(old, new, words, tmp_path):
    with pytest.raises(reference_data.SourceError, match=words):
        measured(tmp_path, old, new)
