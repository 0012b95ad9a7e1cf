"""Names in words, for readers, of what tables and addresses call by an identifier."""

import re

# Models and references in the names of comparisons; longer ones come before those that begin them.
WORDS = {
    "lumped.unloading-stiffness": r"the paper's model with $e^2 \zeta^2$",
    "lumped.viscous": "two Kelvin-Voigt elements",
    "lumped.hysteretic": "the paper's model",
    "lumped": "the paper's model",
    "continuum.plastic-elastic-shear": "plastic continuum, elastic in shear",
    "continuum.plastic": "plastic continuum",
    "continuum.viscous": "viscous continuum",
    "continuum": "elastic continuum",
    "flows-in-shear": "plastic continuum",
    "contraction": "two impacts come nearer to each other",
    "maw": "Maw et al.",
    "fem": "finite elements",
    "exact": "second solution",
    "solved": "solved without error",
    "slip-throughout": "slip throughout",
    "initial-stick-limit": "limit of initial stick",
    "initial-stick": "initial stick",
    "slip-and-stick": "slip and stick",
    "experiment": "experiment",
    "order": "observed order",
    "peak-angle": "angle of the largest friction",
    "tangential-restitution": "tangential restitution",
    "rubber-sphere": "rubber sphere",
    "rubber": "rubber",
    "pushed": "pushed contact",
    "dissimilar": "unlike bodies",
    "pairs": "pairs of materials",
}
PARTS = re.compile(rf"(?:^|(?<=-))({'|'.join(map(re.escape, WORDS))}|(?:nu|mu|e)-\d[\d.]*)(?=-|$)")
SYMBOL = re.compile(r"(?:^|[-_])(nu|mu|e)[-_](\d[\d.]*)")
YEAR = re.compile(r"(?<=[a-z])(?=(?:19|20)\d\d$)")


def _equation(found: re.Match[str]) -> str:
    return f"${found[1] if found[1] == 'e' else chr(92) + found[1]} = {found[2]}$"


def comparison(name: str) -> str:
    r"""Name of a comparison, without the figure that its identifier begins with.

    >>> comparison("fig5-continuum.viscous-experiment-initial-stick")
    'viscous continuum, experiment, initial stick'
    >>> comparison("yielding-dissimilar-nu-0.45"), comparison("scene-shot-peening")
    ('unlike bodies, $\\nu = 0.45$', 'shot peening')
    """
    parts = [part.strip("-") for part in PARTS.split(name.partition("-")[2])]
    words = [WORDS.get(part) or SYMBOL.sub(_equation, part).replace("-", " ") for part in parts]
    return ", ".join(filter(None, words))


def source(name: str) -> str:
    """Name of a folder of data.

    >>> source("chung_ooi2011"), source("closed_forms")
    ('Chung & Ooi 2011', 'Closed forms')
    """
    authors, *year = YEAR.split(name)
    if year:
        return f"{' & '.join(map(str.capitalize, authors.split('_')))} {year[0]}"
    return name.replace("_", " ").capitalize()


def series(name: str) -> str:
    r"""Name of a series or a fact of a source.

    >>> series("maw1976/rebound_nu_0.3"), series("closed_forms/fig7_peak_force")
    ('Maw 1976: rebound, $\\nu = 0.3$', 'Closed forms: Fig. 7, peak force')
    """
    folder, _, part = name.partition("/")
    part = re.sub(
        r"^fig(\d)_", r"Fig. \1, ", SYMBOL.sub(lambda found: f", {_equation(found)}", part)
    )
    return f"{source(folder)}: {part.replace('_', ' ')}"


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
