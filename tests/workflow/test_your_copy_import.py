"""Exports of other programs are read by the page `your_copy.html`, or refused with the reason."""

import json

import pytest

from tests.workflow import node
from tests.workflow.project import ROOT

FOLDER = ROOT / "workflow/your_copy"
SCRIPTS = ["vendor/papaparse.min.js", "numbers.js", "exports.js"]
COLUMNS = ["incidence [mu v2(0)]", "velocity [mu v2(0)]"]  # of the panel


@pytest.fixture(scope="module")
def scripts():
    texts = [(FOLDER / name).read_text(encoding="utf-8") for name in SCRIPTS]
    with node.scripts(texts) as found:
        yield found


def taken(text, scripts):
    """What is read, and the points of the two columns that the page chooses."""
    found = scripts.evaluate(f"exports_of_others.read({json.dumps(text)}, {json.dumps(COLUMNS)})")
    if "refused" in found:
        return found["refused"], None
    x, y = (json.dumps(found["columns"][place]) for place in found["chosen"])
    return found, scripts.evaluate(f"exports_of_others.points({x}, {y})")


# Each has the points (0.5, 0.1) and (1, -0.2).
EXPORTS = {
    "WebPlotDigitizer": "0.5, 0.1\n1.0, -0.2\n",
    "with a header": "x, y\n0.5, 0.1\n1.0, -0.2\n",
    "all data sets": "rubber,,lumped,\nX,Y,X,Y\n0.5,0.1,0,3\n1.0,-0.2,,\n",
    "a shorter first data set": "a,,b,\nX,Y,X,Y\n0.5,0.1,0,3\n1.0,-0.2,1,4\n,,2,5\n",
    "Engauge": "x,Curve1\n0.5,0.1\n1,-0.2\n",
    "Engauge with decimal commas": 'x,Curve1\n"0,5","0,1"\n1,"-0,2"\n',
    "no empty cells at the end": "x\ty\tx\ty\n0.5\t0.1\t2\t3\n1\t-0.2\n",
    "tabs": "X\tY\r\n0,5\t0,1\r\n1\t-0,2\r\n",
    "semicolons": "x;y\n0,5;0,1\n1,0;\u22120,2\n",
    "three decimals": "x;y\n0,5;0,1\n1,000;-0,2\n",
    "blanks": " x   y\n0.5   0.1\n 1   -0.2 \n",
    "names with blanks between blanks": "time ago  speed\n0,5 0,1\n1 -0,2\n",
    "quotes": '\ufeff"x","y"\n"0.5","0.1"\n"1","-2e-1"\n',
    "quotes behind blanks": '"x", "y, e = 1"\n"0.5", "0.1"\n"1", "-0.2"\n',
    "comments": '# who: A, "B"\nx,y\n0.5,0.1\n # between\n1,-0.2\n',
    "a title": "Fig. 5\nx,y\n0.5,0.1\n1,-0.2\n",
    "y first": "y,x\n0.1,0.5\n-0.2,1\n",
    "y first, x not named": "Y,Curve1\n0.1,0.5\n-0.2,1\n",
    "x last": "Curve1,Curve2,x\n0.1,9,0.5\n-0.2,9,1\n",
    "columns of the panel": "sigma,velocity [mu v2(0)],Incidence\n9,0.1,0.5\n9,-0.2,1\n",
}


@pytest.mark.parametrize("name", EXPORTS)
def test_an_export_is_read(name, scripts):
    assert taken(EXPORTS[name], scripts)[1] == [[0.5, 0.1], [1, -0.2]]


def test_names_in_quotation_marks_stay_above_their_numbers(scripts):
    text = 'x,"friction, e = 1","friction, e = 0.5"\n0,0.1,0.2\n'
    columns = taken(text, scripts)[0]["columns"]
    assert [one["name"] for one in columns] == ["x", "friction, e = 1", "friction, e = 0.5"]
    assert [one["values"] for one in columns] == [[0], [0.1], [0.2]]
    text = 'a,,"b, c",\nX,Y,X,Y\n0,1,2,3\n1.5,2,,\n'
    columns = taken(text, scripts)[0]["columns"]
    assert [one["name"] for one in columns] == ["a X", "a Y", "b, c X", "b, c Y"]
    assert columns[2]["values"] == [2, None]


REFUSED = {
    "": "No two columns",
    "# a comment\n": "No two columns",
    "nothing": "No two columns of numbers in “nothing”",
    "1\n2\n": "No two columns",
    "x,y\n0,5,0,1\n1,5,-0,2\n": "Line 2, “0 | 5 | 0 | 1”: not 2 cells",
    "0,5,0,1\n1,5,-0,2\n": "Line 1, “0 | 5 | 0 | 1”: are commas decimal",
    "x,Curve1\n1,0,15\n": "Line 2, “1 | 0 | 15”: not 2 cells. If commas are decimal",
    "1,0.15\n2,0,15\n": "Line 1, “1 | 0.15”: not 3 cells",
    "1,2\n3,b\n": "Line 2, “3 | b”: not all cells are numbers",
    "1,2\n3,0x10\n": "Line 2, “3 | 0x10”",
    "1,2\n3,1e\n": "Line 2, “3 | 1e”",
    "1,2\n3,1e999\n": "Line 2, “3 | 1e999”",
    "1,2\n\n3,Infinity\n": "Line 3, “3 | Infinity”",
    "x,3\n1,2\n": "Line 1, “x | 3”",
    "x;y\n1,000;2\n": "Line 2, “1,000 | 2”: are commas decimal",
    'x,y\n0.5,"1,000"\n': "Line 2, “0.5 | 1,000”: are commas decimal",
    '1,2\n3,"4\n5,6\n': "Line 2, “3 | 4\n5,6”",
    '1,"2\n3,4\n5,6\n': "No two columns of numbers in",
    "x,friction, e = 1\n0,0.1\n": "Line 1, “x | friction | e = 1”: more than 2 names. Put one",
    "a, b,,c,\nX,Y,X,Y\n0,1,2,3.5\n": "Line 1, “a | b |  | c | ”: more than 4",
    '{"version":[4,2],"axesColl":[],"datasetColl":[]}': "CSV: “View Data”, “Download .CSV”",
    '{"wpd":{"version":[3,8]}}': "WebPlotDigitizer",
    "wpd.json".ljust(257, "\0") + "ustar\0" + "{": "WebPlotDigitizer",
    '<?xml version="1.0"?>\n<!DOCTYPE engauge>\n<Document>': "CSV: “File”, “Export”",
    '<Document VersionNumber="12.1">': "Engauge",
}


@pytest.mark.parametrize("text", REFUSED)
def test_what_cannot_be_read_is_refused_with_the_reason(text, scripts):
    said, points = taken(text, scripts)
    assert points is None and REFUSED[text] in said and said.endswith("."), said


NUMBERS = {
    "1.5": 1.5,
    "1,5": 1.5,
    " \u22120,25 ": -0.25,
    "\u20132": -2,
    ".5": 0.5,
    "5.": 5,
    "1e-3": 0.001,
}
NUMBERS |= {"0,125": 0.125, "1234,567": 1234.567, "+3": 3}
NO_NUMBERS = ["", " ", "-", ",", "1,000", "-12,500", "1,000,000", "1.000,5", "0x10", "1e", "1e999"]
NO_NUMBERS += ["Infinity", "NaN", "1 2", "2a"]


def test_a_number_is_read_as_it_is_typed_or_not_at_all(scripts):
    assert scripts.map("(one) => numbers.read(one)", list(NUMBERS)) == list(NUMBERS.values())
    assert scripts.map("(one) => numbers.read(one)", NO_NUMBERS) == [None] * len(NO_NUMBERS)
