"""Words for readers of what tables, folders and addresses call by an identifier."""

import re

from stronge1994.names import SCENE, is_of_paper

GREEK = {"mu": "μ", "nu": "ν"}
# Units whose names in tables a reader would not understand.
UNITS = {
    "1": "",
    "us": "µs",
    "deg": "°",
    "kg/m^3": "kg/m³",
    "t_c": "$t_c$",
    "1/Omega": r"$1/\Omega$",
    "v2(0)": "$v_2(0)$",
    "v2(0)/Omega": r"$v_2(0)/\Omega$",
    "mu v2(0)": r"$\mu v_2(0)$",
    "mu v2(0)/R": r"$\mu v_2(0)/R$",
    "F2max": r"$F_{2\mathrm{max}}$",
    "mu F2max": r"$\mu F_{2\mathrm{max}}$",
    "m2 Omega S": r"$m_2 \Omega S$",
    "m2 Omega v2(0)": r"$m_2 \Omega v_2(0)$",
    "mu m2 Omega v2(0)": r"$\mu m_2 \Omega v_2(0)$",
    "m2 S^2/2": "$m_2 S^2/2$",
    "mu^2 m2 v2(0)^2": r"$\mu^2 m_2 v_2(0)^2$",
    "K0": "$K_0$",
    "a_max": r"$a_{\mathrm{max}}$",
    "delta_max": r"$\delta_{\mathrm{max}}$",
}
YEAR = re.compile(r"(?<=[a-z])(?=(?:19|20)\d\d$)")


def of_identifier(identifier: str) -> str:
    """The words of an identifier, with Greek letters.

    >>> of_identifier("contact-nu-0.3"), of_identifier("peak_over_mu_normal")
    ('contact ν 0.3', 'peak over μ normal')
    """
    return " ".join(GREEK.get(word, word) for word in re.split("[-_]", identifier))


def column(name: str) -> str:
    r"""Name of a column of a table, with its unit after a comma.

    >>> column("largest_error [mu v2(0)]"), column("restitution [1]")
    ('largest error, $\\mu v_2(0)$', 'restitution')
    """
    quantity, _, unit_name = name.rstrip("]").partition(" [")
    written = UNITS.get(unit_name, unit_name)
    return of_identifier(quantity) + (f", {written}" if written else "")


def unit(name: str) -> str:
    r"""What stands behind a number: a space and a unit, or the sign of degrees.

    >>> unit("mu v2(0)"), unit("N"), unit("deg"), unit("1")
    (' $\\mu v_2(0)$', ' N', '°', '')
    """
    written = UNITS.get(name, name)
    return f" {written}" if written not in ("", "°") else written


def with_units(text: str) -> str:
    r"""A text in which units behind numbers are formulas.

    >>> with_units("13 points, rms 0.17 mu v2(0); ours 5 deg")
    '13 points, rms 0.17 $\\mu v_2(0)$; ours 5°'
    """
    names = "|".join(re.escape(name) for name in sorted(UNITS, key=len, reverse=True))
    return re.sub(rf"(?<=\d) ({names})(?=$|[ ;,:)])", lambda found: unit(found[1]), text)


def figure(name: str) -> str:
    """Name of a figure.

    >>> figure("fig5"), figure("micro_slip")
    ('Fig. 5', 'Micro slip')
    """
    if is_of_paper(name):
        return f"Fig. {name.removeprefix('fig')}"
    if name.startswith(SCENE):
        return f"Scene: {of_identifier(name.removeprefix(SCENE))}"
    return of_identifier(name).capitalize()


def comparison(name: str) -> str:
    """Name of a comparison, without the figure that its identifier begins with.

    >>> comparison("fig5-continuum.viscous-experiment-initial-stick")
    'continuum.viscous experiment initial stick'
    """
    return of_identifier(name.partition("-")[2])


def source(name: str) -> str:
    """Name of a folder of data.

    >>> source("chung_ooi2011"), source("closed_forms")
    ('Chung & Ooi 2011', 'Closed forms')
    """
    authors, *year = YEAR.split(name)
    if year:
        return f"{' & '.join(map(str.capitalize, authors.split('_')))} {year[0]}"
    return of_identifier(name).capitalize()


def series(name: str) -> str:
    """Name of a series or a fact of a source.

    >>> series("maw1976/rebound_nu_0.3")
    'Maw 1976: rebound ν 0.3'
    """
    folder, _, part = name.partition("/")
    return f"{source(folder)}: {of_identifier(part)}"


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
