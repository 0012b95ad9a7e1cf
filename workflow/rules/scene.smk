import re

from stronge1994.plan import parts


rule scene:
    """Solve a table of impacts, each by the cheapest model that is good enough."""
    input:
        modules=modules("solve_scene"),
        table="data/scenes/{scene}.csv",
    output:
        "results/scenes/{scene}.csv",
    params:
        tolerance=scene_tolerance,
    log:
        "results/logs/scene_{scene}.log",
    benchmark:
        "results/benchmarks/scene_{scene}.tsv"
    message:
        "Solving the scene {wildcards.scene}"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/solve_scene.py"


# A scene in many tables, a job for each: `snakemake --cores 2 scene_parts`, not part of `all`.
PARTS = parts.tables(config)
VALUES["part"] = list(PARTS)


wildcard_constraints:
    part="|".join(map(re.escape, PARTS)) or "none",


localrules:
    gather_parts,
    scene_parts,


rule solve_part:
    """Solve one table of a scene in many tables; the tables know nothing of each other."""
    input:
        modules=modules("solve_part"),
        # Its content decides, not its date.
        table=lambda wildcards: ancient(PARTS[wildcards.part]),
    output:
        table=f"{parts.RESULTS}/tables/{{part}}",
        account=f"{parts.RESULTS}/accounts/{{part}}.json",
    params:
        settings=parts.settings(config),
        table_content=lambda wildcards: parts.content(PARTS[wildcards.part]),
    log:
        "results/logs/scene_part_{part}.log",
    benchmark:
        "results/benchmarks/scene_part_{part}.tsv"
    resources:
        mem_mb=2000,
    message:
        "Solving the table {wildcards.part}"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/solve_part.py"


rule gather_parts:
    """Count all tables together, and list the bad rows."""
    input:
        modules=modules("gather_parts"),
        tables=expand(rules.solve_part.output.table, part=PARTS),
        accounts=expand(rules.solve_part.output.account, part=PARTS),
    output:
        summary=f"{parts.RESULTS}/summary.csv",
        bad_rows=f"{parts.RESULTS}/bad_rows.csv",
    log:
        "results/logs/gather_parts.log",
    benchmark:
        "results/benchmarks/gather_parts.tsv"
    message:
        "Counting the tables of the scene"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/gather_parts.py"


rule scene_parts:
    """A scene too large for one machine: every table of a folder solved, and all of them counted."""
    input:
        modules=modules("show_parts"),
        tables=expand(rules.solve_part.output.table, part=PARTS),
        accounts=expand(rules.solve_part.output.account, part=PARTS),
        summary=rules.gather_parts.output.summary,
        bad_rows=rules.gather_parts.output.bad_rows,
    log:
        "results/logs/scene_parts.log",
    benchmark:
        "results/benchmarks/scene_parts.tsv"
    message:
        "Showing what was solved"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/show_parts.py"


try:
    if workflow.is_main_process:
        parts.check(config, PARTS)
    if {"scene_parts", "gather_parts"} & set(sys.argv):
        parts.refuse_unusable(PARTS)
        made = [*rules.solve_part.output, *rules.gather_parts.output]
        gate.refuse_unknown_results(expand(made, part=PARTS))
except (ConfigError, RuntimeError) as error:
    raise refused(error)
