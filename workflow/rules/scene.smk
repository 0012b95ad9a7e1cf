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
