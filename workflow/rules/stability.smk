rule stability:
    """Digits of the lumped model by decades of each parameter; always succeeds."""
    input:
        modules=modules("write_stability"),
        curves="results/curves/stability.csv",
    output:
        report(
            "results/stability.csv",
            caption="../report/stability.rst",
            category="Stability",
            labels={"table": "digits by decades of each parameter"},
        ),
    log:
        "results/logs/stability.log",
    benchmark:
        "results/benchmarks/stability.tsv"
    message:
        "Tabulating digits by decades"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/write_stability.py"
