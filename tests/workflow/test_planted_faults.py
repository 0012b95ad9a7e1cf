"""Faults that somebody might make: each ends a run with status 1, and the run names the row.

A wrong entry of the ledger, and a wrong curve, are planted in test_run.py.
"""

import pytest

from stronge1994 import tables
from tests.workflow.project import LEFT, PARTS, copy_of, head

# By the figure that is run: file, what stands there and what is planted, and what the run says.
PLANTED = {
    "fig6": [
        (
            "src/planarimpact/lumped/stick_slip.py",
            ("    # Rounding must not create energy.", "    outcome.velocity[:] *= 1 + 1e-9"),
            "FAILS: fig6-rebound: largest for velocity",
        )
    ],
    "fig7": [
        (
            "src/stronge1994/printed/equations.py",
            ("return stiffness_ratio * np", "return 1.01 * stiffness_ratio * np"),
            "FAILS: fig7-printed: largest for peak_force",
        )
    ],
    "fig5": [
        (
            "data/kharaz2001/spin.csv",
            ("573.7", "513.7"),
            "changed: fig5-lumped.hysteretic-experiment-spin: size 20.9244 rad/s -> ",
        ),
        (
            "data/chung_ooi2011/source.yaml",
            ("sigma: 0.008,", "sigma: 0.08,"),
            "changed: fig5-continuum-fem-spin-slip-and-stick: cannot be judged -> ",
        ),
    ],
}


@pytest.fixture(scope="module")
def tree(first_run, tmp_path_factory):
    """A copy of the project after a full run, in which a fault is planted and taken out again."""
    return copy_of(first_run[0].folder, tmp_path_factory.mktemp("tree"), PARTS + LEFT)


def told(project, target):
    """What a run says that must end with status 1, in one line."""
    result = project.run(target)
    said = " ".join(result.stdout.split())
    assert result.returncode == 1 and "PASSED" not in said, said
    return said


@pytest.mark.parametrize("figure", PLANTED)
def test_a_fault_ends_the_run_and_its_row_is_named(figure, tree):
    right = {path: (tree / path).read_text(encoding="utf-8") for path, *_ in PLANTED[figure]}
    for path, (old, new), _ in PLANTED[figure]:
        assert old in right[path]
        (tree / path).write_text(right[path].replace(old, new, 1), encoding="utf-8")
    said = told(tree, figure)
    assert [row for *_, row in PLANTED[figure] if row not in said] == [], said
    for path, text in right.items():
        (tree / path).write_text(text, encoding="utf-8")


def test_a_scale_that_two_curves_do_not_share_ends_the_run(tree):
    """Forces as our own curves have them, but friction is 15 % too high for its normal force."""
    table = tables.read(tree / "results/curves/fig8.csv")
    for force, factor, high in (("normal", 1.0, 80), ("friction", 1.15, 40)):
        own = tables.select(table, variant=force).iloc[50:850:50]
        points = own[["angle [deg]", "peak_force [N]"]] * [1.0, factor]
        axes = {"axes": f"0 to 90; 0 to {high}", "sigma_x": 0.1, "sigma_y": 0.1}
        marks = {"marks": f"0 0; 30 0; 60 0; 90 0; 0 {high}; 90 {high}"}
        said = head(**axes, **marks, mark_sigma_x=0.1, mark_sigma_y=0.1)
        path = tree / f"data/stronge1994/fig8_{force}.csv"
        path.write_text(said + points.to_csv(index=False))
    assert "differs, and nobody has accepted it: fig8-printed-curve-ratio: " in told(tree, "fig8")
