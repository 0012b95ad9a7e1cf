"""Bad config, data and modules are refused before any work, in one line.

What a start of Snakemake checks is checked in tests/refusals; a few whole starts show that it does.
"""

import re

from tests.workflow.project import ROOT

PAGE = ROOT / "workflow/README.md"
TROUBLE = PAGE.read_text(encoding="utf-8").split("## Troubleshooting")[1].split("\n## ")[0]


def explained(result):
    """The row of the page, under Troubleshooting, whose words a failed run has printed."""
    assert result.returncode != 0, result.stdout
    rows = re.findall(r"^\| `(.*?)`.*? \| (.*) \|$", TROUBLE, flags=re.M)
    assert len(rows) >= 5
    said = [advice for words, advice in rows if words in result.stdout]
    assert len(said) == 1, result.stdout
    return said[0]


# Whole starts, one for each place where it is refused.
STARTS = [
    (["--config", "stiffness_ratio=-1"], r"\nconfig: stiffness_ratio: -1 is less than .*\n"),
    (["--config", "samples=0400"], r"\n--config 'samples=0400': '0400' is no decimal number .*\n"),
    (["fgi6"], r"\nNo rule to produce fgi6 "),
]


def test_a_refused_start_does_nothing(fresh):
    for arguments, words in STARTS:
        result = fresh.run(*arguments)
        assert result.returncode != 0 and re.search(words, result.stdout), result.stdout
        assert "Traceback" not in result.stdout and not (fresh / "results").exists()
    entries = fresh / "src/stronge1994/paper/dynamics.py"
    entries.write_text(entries.read_text("utf-8").replace('"p. 437, Eq. 1"', '"Eq. 1"'), "utf-8")
    result = fresh.run()
    assert "\neq-01: where is 'Eq. 1': it begins with a page" in result.stdout, result.stdout
    assert "Traceback" not in result.stdout and not (fresh / "results").exists()


def test_errors_of_snakemake_itself_are_explained(fresh):
    unquoted = ["figures={fig6:", "{restitution:", "[0,", "0.9]}}"]
    assert "quotes" in explained(fresh.run("--config", *unquoted))
    (fresh / "Snakefile").unlink()
    assert "another folder" in explained(fresh.run())
