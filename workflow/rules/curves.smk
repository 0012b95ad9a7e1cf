rule curves:
    """Solve every curve of one figure."""
    input:
        modules=solver_modules,
        tables=node_tables,
    output:
        "results/curves/{figure}.csv",
    params:
        settings=settings,
        nodes=nodes,
    log:
        "results/logs/curves_{figure}.log",
    benchmark:
        "results/benchmarks/curves_{figure}.tsv"
    threads: cores_reserved
    message:
        "Solving {wildcards.figure}"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/solve.py"
