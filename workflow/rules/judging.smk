rule judge:
    """Compare a figure's curves or a scene with reference data. A row that fails is no error here."""
    input:
        code=["workflow/scripts/judge.py", *JUDGING],
        table=lambda wildcards: JUDGED[wildcards.judged]["table"],
        series=lambda wildcards: JUDGED[wildcards.judged]["series"],
    output:
        verdicts="results/verdicts/{judged}.csv",
        residuals="results/residuals/{judged}.csv",
    log:
        "results/logs/judge_{judged}.log",
    priority: priority
    conda:
        "../envs/planarimpact.yaml"
    params:
        settings=lambda wildcards: JUDGED[wildcards.judged]["settings"],
    script:
        "../scripts/judge.py"


rule verdicts:
    """All rows of the comparisons as one table, and for readers by figure. Never fails."""
    input:
        code=["workflow/scripts/gather.py", *JUDGING],
        tables=expand(rules.judge.output.verdicts, judged=JUDGED),
    output:
        table=report("results/verdicts.csv", category="Tables", caption="../report/verdicts.rst"),
        by_figure="results/verdicts.txt",
    log:
        "results/logs/verdicts.log",
    conda:
        "../envs/planarimpact.yaml"
    params:
        shows=lambda _: SHOWS,
        grades=GRADES,
    script:
        "../scripts/gather.py"


rule check_ledger:
    """Check every entry of the paper's ledger against the paper's model, solved to rounding. Never fails."""
    input:
        code=["workflow/scripts/check_ledger.py", *SOLVING, *JUDGING, *PAPER_LEDGER],
        facts="data/stronge1994/source.yaml",  # to which entries refer
    output:
        report("results/ledger.csv", category="Tables", caption="../report/ledger.rst"),
    log:
        "results/logs/ledger.log",
    priority: 1  # as it is long
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/check_ledger.py"


rule accept:
    """Write what a run has found to data/accepted/verdicts.csv: look at git diff, and then run again.

    It is no output, as the gate reads it. What FAILS, or is of other settings, is refused.
    """
    input:
        code=["workflow/scripts/accept.py", *JUDGING],
        verdicts=[rules.verdicts.output.table],
        ledger=rules.check_ledger.output[0],
    log:
        "results/logs/accept.log",
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/accept.py"


rule gate:
    """Pass, or fail and say which rows are not as accepted. It waits for all that a run makes."""
    input:
        code=["workflow/scripts/gate.py", *JUDGING],
        verdicts=[rules.verdicts.output.table],
        ledger=rules.check_ledger.output[0],
        accepted=ACCEPTED,
        made=EVERYTHING,
    output:
        "results/gate.txt",
    log:
        "results/logs/gate.log",
    conda:
        "../envs/planarimpact.yaml"
    params:
        rows=rows_of(JUDGED),
        entries=list(GRADES),
        shows=lambda _: SHOWS,
        grades=GRADES,
    script:
        "../scripts/gate.py"


use rule gate as gate_of_target with:
    # The same for a part of the run, by its own rows. Inputs are replaced, other params are kept.
    input:
        code=["workflow/scripts/gate.py", *JUDGING],
        verdicts=lambda wildcards: expand(rules.judge.output.verdicts, judged=TARGETS[wildcards.target]),
        ledger=lambda wildcards: rules.check_ledger.output[0] if wildcards.target == "ledger" else [],
        accepted=ACCEPTED,
        made=lambda wildcards: made(TARGETS[wildcards.target]),
    output:
        "results/gates/{target}.txt",
    log:
        "results/logs/gate_{target}.log",
    params:
        rows=lambda wildcards: rows_of(TARGETS[wildcards.target]),
        entries=lambda wildcards: list(GRADES) if wildcards.target == "ledger" else [],
