rule curves:
    """Solve every curve of one figure."""
    input:
        code=["workflow/scripts/solve.py", *SOLVING],
        own=of_folder(without="drawing.py"),
        tables=lambda wildcards: FIGURES[wildcards.figure]["tables"],
    output:
        "results/curves/{figure}.csv",
    log:
        "results/logs/curves_{figure}.log",
    priority: priority
    conda:
        "../envs/planarimpact.yaml"
    resources:
        mem_mb=2000,
        runtime=30,  # minutes
        timed=lambda wildcards: int(wildcards.figure in TIMED),  # the profile allows one such job at once
    params:
        settings=lambda wildcards: FIGURES[wildcards.figure]["curves"],
    script:
        "../scripts/solve.py"


rule scene:
    """Solve a table of impacts, each by the cheapest model that is good enough."""
    input:
        code=["workflow/scripts/solve_scene.py", *SOLVING],
        table="data/scenes/{scene}.csv",
    output:
        "results/scenes/{scene}.csv",
    log:
        "results/logs/scene_{scene}.log",
    conda:
        "../envs/planarimpact.yaml"
    params:
        tolerance=lambda wildcards: config["scenes"][wildcards.scene]["tolerance"],
    script:
        "../scripts/solve_scene.py"
