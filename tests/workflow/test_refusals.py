"""Bad config, data and modules are refused before any work, in one line.

What a start of Snakemake checks is checked here in the process, and in tests/refusals; two whole
starts show that it does.
"""

import re

from tests.workflow.project import ROOT

README = (ROOT / "workflow/README.md").read_text(encoding="utf-8")
TROUBLE = README.split("## Troubleshooting")[1].split("\n## ")[0]


def explained(result):
    """The row of the README, under Troubleshooting, whose words a failed run has printed."""
    assert result.returncode != 0, result.stdout
    rows = re.findall(r"^\| `(.*?)`.*? \| (.*) \|$", TROUBLE, flags=re.M)
    assert len(rows) >= 5
    said = [advice for words, advice in rows if words in result.stdout]
    assert len(said) == 1, result.stdout
    return said[0]


# Whole starts, one for each place where it is refused.
STARTS = [
    (["--config", "stiffness_ratio=-1"], "stiffness_ratio: -1 is less than"),
    (["--config", "samples=0400"], "--config samples=0400: '0400' is no decimal number"),
    (["fgi6"], r"No rule to produce fgi6(.|\n)*Targets are\n  all, fig2, fig3, .*fig9,"),
]


def test_a_refused_start_does_nothing_and_has_not_passed(fresh):
    for arguments, words in STARTS:
        (fresh / "results").mkdir(exist_ok=True)
        (fresh / "results/PASSED").write_text("passed")
        result = fresh.run(*arguments)
        assert result.returncode != 0 and re.search(words, result.stdout), result.stdout
        assert "Traceback" not in result.stdout
        assert not (fresh / "results/logs").exists() and not (fresh / "results/PASSED").exists()


def test_errors_of_snakemake_itself_are_explained(fresh):
    unquoted = ["figures={fig6:", "{restitution:", "[0,", "0.9]}}"]
    assert "quotes" in explained(fresh.run("--config", *unquoted))
    (fresh / "Snakefile").unlink()
    assert "another folder" in explained(fresh.run())
