"""Names in words, for readers, of what tables, folders and addresses call by an identifier."""

import re

from stronge1994.curve_names import SCENE, is_of_paper, words

YEAR = re.compile(r"(?<=[a-z])(?=(?:19|20)\d\d$)")


def figure(name: str) -> str:
    """Name of a figure.

    >>> figure("fig5"), figure("micro_slip")
    ('Fig. 5', 'Micro slip')
    """
    if is_of_paper(name):
        return f"Fig. {name.removeprefix('fig')}"
    if name.startswith(SCENE):
        return f"Scene: {words(name.removeprefix(SCENE))}"
    return words(name).capitalize()


def comparison(name: str) -> str:
    """Name of a comparison, without the figure that its identifier begins with.

    >>> comparison("fig5-continuum.viscous-experiment-initial-stick")
    'continuum.viscous experiment initial stick'
    """
    return words(name.partition("-")[2])


def source(name: str) -> str:
    """Name of a folder of data.

    >>> source("chung_ooi2011"), source("closed_forms")
    ('Chung & Ooi 2011', 'Closed forms')
    """
    authors, *year = YEAR.split(name)
    if year:
        return f"{' & '.join(map(str.capitalize, authors.split('_')))} {year[0]}"
    return words(name).capitalize()


def series(name: str) -> str:
    """Name of a series or a fact of a source.

    >>> series("maw1976/rebound_nu_0.3")
    'Maw 1976: rebound ν 0.3'
    """
    folder, _, part = name.partition("/")
    return f"{source(folder)}: {words(part)}"


def entry(name: str) -> str:
    """Name of an entry of the ledger.

    >>> entry("eq-32-late"), entry("slip-throughout-limit")
    ('Eq. 32 late', 'slip throughout limit')
    """
    return re.sub(r"^eq-0?", "Eq. ", name).replace("-", " ")


def sentence(text: str) -> str:
    """A text with a capital letter at its head, unless it begins with a formula.

    >>> sentence("it must run"), sentence("$e^2$ is small")
    ('It must run', '$e^2$ is small')
    """
    return text[:1].upper() + text[1:]
