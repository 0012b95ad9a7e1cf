"""Scenes in the workflow: what reruns, and what is refused."""

import re

from stronge1994 import csv_tables
from stronge1994.figures.superball import curves as superball
from stronge1994.figures.superball import drawing as draw_superball
from tests.package_tables import scene_tables


def test_every_scene_is_solved_and_explained(first_run):
    project, _ = first_run
    for scene, count in (("shot_peening", 200), ("billiard_cushion", 21), ("superball", 3)):
        assert len(csv_tables.read_rows(project / f"results/scenes/{scene}.csv")) == count
        assert f"{count} impacts" in (project / f"results/logs/scene_{scene}.log").read_text()


def test_the_superball_spins_in_its_figure_as_in_its_table():
    """Also where it is thrown with a spin, whose sign is that of a plane state on the floor."""
    throw = scene_tables.THROW | {"spin": 40.0}
    before, after = superball.impacts(throw)
    figure = draw_superball.draw(superball.curves(throw), {"throw": throw}, {})
    shown = " ".join(text.get_text() for text in figure.legends[0].get_texts())
    spins = [before["spin_y [rad/s]"][0], *after["spin_y_after [rad/s]"]]
    assert spins[0] == -40 and spins[1] > 0
    for number, spin in enumerate(spins, start=1):
        words = f"{spin:.0f}".replace("-", "\N{MINUS SIGN}")
        assert re.search(rf"\({number}\) \S+ m/s, spin_y {words} rad/s", shown)
