import re

from stronge1994.plan import parts


rule scene:
    """Solve a table of impacts, each by the cheapest model that is good enough."""
    input:
        plan=planned("scene_{scene}", "solve_scene",
            settings=lambda scene: config["scenes"][scene]["tolerance"],
            reads=lambda scene: [f"data/scenes/{scene}.csv"]),
        table="data/scenes/{scene}.csv",
    output:
        table="results/scenes/{scene}.csv",
        record="results/records/scene_{scene}.json",
    log:
        "results/logs/scene_{scene}.log",
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
    """Solve one table of a scene in many tables; the tables are independent."""
    input:
        plan=planned("scene_part_{part}", "solve_part", settings=lambda part: parts.settings(config)),
        table=lambda wildcards: PARTS[wildcards.part],
    output:
        table=f"{parts.RESULTS}/tables/{{part}}",
        account=f"{parts.RESULTS}/accounts/{{part}}.json",
        record="results/records/scene_part_{part}.json",
    log:
        "results/logs/scene_part_{part}.log",
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
        plan=planned("gather_parts", "gather_parts"),
        tables=expand(rules.solve_part.output.table, part=PARTS),
        accounts=expand(rules.solve_part.output.account, part=PARTS),
    output:
        summary=f"{parts.RESULTS}/summary.csv",
        bad_rows=f"{parts.RESULTS}/bad_rows.csv",
        record="results/records/gather_parts.json",
    log:
        "results/logs/gather_parts.log",
    message:
        "Counting the tables of the scene"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/gather_parts.py"


rule scene_parts:
    """A scene too large for one machine: every table of a folder solved, and all of them counted."""
    input:
        tables=expand(rules.solve_part.output.table, part=PARTS),
        accounts=expand(rules.solve_part.output.account, part=PARTS),
        summary=rules.gather_parts.output.summary,
        bad_rows=rules.gather_parts.output.bad_rows,
    log:
        "results/logs/scene_parts.log",
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
except ConfigError as error:
    raise WorkflowError(str(error))
