# A grid of impacts, scattered into chunks, solved, gathered and drawn:
#   snakemake --cores 2 study                       here
#   snakemake --profile profiles/slurm study    on a cluster


rule solve_chunk:
    """Solve some points of the study's grid; the chunks know nothing of each other."""
    input:
        modules=modules("solve_chunk"),
    output:
        "results/study/{scatteritem}.npz",
    params:
        settings=grid.settings(config),
    log:
        "results/logs/study_{scatteritem}.log",
    benchmark:
        "results/benchmarks/study_{scatteritem}.tsv"
    message:
        "Solving the chunk {wildcards.scatteritem} of the study"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/solve_chunk.py"


rule gather_chunks:
    """Put the chunks together in the shape of the grid."""
    input:
        modules=modules("gather_chunks"),
        chunks=gather.study(rules.solve_chunk.output),
    output:
        "results/study.npz",
    params:
        settings=grid.settings(config),
    log:
        "results/logs/gather_chunks.log",
    benchmark:
        "results/benchmarks/gather_chunks.tsv"
    message:
        "Gathering the study"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/gather_chunks.py"


rule draw_study:
    """Draw maps of the rebound over the grid; never solves."""
    input:
        modules=modules("draw_study"),
        study="results/study.npz",
    output:
        svg=report(
            "figures/study.svg",
            caption="../report/study.rst",
            category="Study",
            labels={"figure": "rebound over the grid"},
        ),
        png="figures/study.png",
    log:
        "results/logs/draw_study.log",
    benchmark:
        "results/benchmarks/draw_study.tsv"
    message:
        "Drawing the study"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/draw_study.py"
