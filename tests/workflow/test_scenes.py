"""The ball of the figure `superball` spins as in its table."""

import re

from stronge1994.figures.superball import curves as superball
from stronge1994.figures.superball import drawing as draw_superball
from tests.package_tables import scene_tables


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
