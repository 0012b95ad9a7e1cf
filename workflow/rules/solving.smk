rule job:
    """Nothing by itself: it has what all jobs share. Each other rule has a function of its name in job.py."""
    log:
        "results/logs/job.log",
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/job.py"


use rule job as curves with:
    """Solve every curve of one figure."""
    input:
        code=SOLVING,
        own=of_folder(without="drawing.py"),
        tables=lambda wildcards: FIGURES[wildcards.figure]["tables"],
    output:
        "results/curves/{figure}.csv",
    log:
        "results/logs/curves_{figure}.log",
    priority: priority
    resources:
        mem_mb=2000,
        runtime=30,  # minutes
        timed=lambda wildcards: int(wildcards.figure in TIMED),  # the profile allows one such job at once
    params:
        settings=lambda wildcards: FIGURES[wildcards.figure]["curves"],


use rule job as scene with:
    """Solve a table of impacts, each by the cheapest model that is good enough."""
    input:
        code=SOLVING,
        table="data/scenes/{scene}.csv",
    output:
        "results/scenes/{scene}.csv",
    log:
        "results/logs/scene_{scene}.log",
    params:
        tolerance=lambda wildcards: config["scenes"][wildcards.scene]["tolerance"],
