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
