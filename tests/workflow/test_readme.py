"""What the README says is so."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", README, flags=re.S)


def test_python_example_runs_as_printed():
    names = {}
    exec(compile(blocks("python")[0], "README.md", "exec"), names)
    assert [names["Regime"](code).name for code in names["result"].regime] == [
        "STICK_SLIP",
        "SLIP_STICK_SLIP",
        "SLIP_THROUGHOUT",
    ]


def test_continuum_example_runs_as_printed():
    names = {}
    exec(compile(blocks("python")[1], "README.md", "exec"), names)
    assert list(names["result"].reversals) == [1, 1, 0]


def test_rule_graph_is_that_of_the_workflow(fresh):
    shown = set()
    for line in blocks("mermaid")[0].splitlines()[1:]:
        chain = [word.strip() for word in line.split("-->")]
        shown |= set(zip(chain, chain[1:], strict=False))
    graph = fresh.run("--rulegraph", "mermaid-js").stdout
    names = dict(re.findall(r"(id\d+)\[(\w+)\]", graph))
    assert shown == {(names[a], names[b]) for a, b in re.findall(r"(id\d+) --> (id\d+)", graph)}


def test_paths_and_sources_named_exist():
    named = re.findall(r"`((?:data|workflow|src|tests|figures)/[\w./]+)`", README)
    named += re.findall(r"\]\(((?!http|#)[^)]+)\)", README)
    built = re.compile(r"figures/(?!README|preview)|[.]wpd[.]csv$")
    missing = [p for p in named if not built.search(p) and not (ROOT / p).exists()]
    assert named and not missing
    sources = {path.parent.name for path in (ROOT / "data").glob("*/source.yaml")}
    assert all(f"`{source}`" in README for source in sources)


def test_documented_differences_are_counted(first_run):
    words = {5: "Five", 8: "Eight", 9: "Nine", 10: "Ten", 11: "Eleven", 12: "Twelve"}
    count = (first_run[0] / "results/verdicts.csv").read_text().count("differs as documented")
    assert f"{words[count]} rows differ as documented" in README
