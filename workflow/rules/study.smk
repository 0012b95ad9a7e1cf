# A grid of impacts, scattered into chunks, solved, gathered and drawn:
#   snakemake --cores 2 study                       here
#   snakemake --profile profiles/slurm study    on a cluster


rule solve_chunk:
    """Solve one chunk of the study's grid; the chunks are independent."""
    input:
        plan=planned("study_{scatteritem}", "solve_chunk", "figures/study/files.py", settings=lambda _: grid.settings(config)),
    output:
        chunk="results/study/{scatteritem}.npz",
        record="results/records/study_{scatteritem}.json",
    log:
        "results/logs/study_{scatteritem}.log",
    message:
        "Solving the chunk {wildcards.scatteritem} of the study"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/solve_chunk.py"


rule gather_chunks:
    """Put the chunks together in the shape of the grid."""
    input:
        plan=planned("gather_chunks", "gather_chunks", "figures/study/files.py", settings=lambda _: grid.settings(config)),
        chunks=gather.study(rules.solve_chunk.output.chunk),
    output:
        table="results/study.npz",
        record="results/records/gather_chunks.json",
    log:
        "results/logs/gather_chunks.log",
    message:
        "Gathering the study"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/gather_chunks.py"


rule draw_study:
    """Draw maps of the rebound over the grid; never solves."""
    input:
        plan=planned("draw_study", "draw_study", "figures/study", "figures/shared/drawing", "reference_data"),
        study="results/study.npz",
    output:
        svg=report(
            "figures/study.svg",
            caption="../report/figures.rst",
            category="Study",
            labels={"figure": "rebound over the grid"},
        ),
        png="figures/study.png",
        record="results/records/draw_study.json",
    params:
        caption=CAPTIONS["study"],
    log:
        "results/logs/draw_study.log",
    message:
        "Drawing the study"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/draw_study.py"
