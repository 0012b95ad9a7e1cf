rule stability_table:
    """Digits of the lumped model by decades of each parameter."""
    input:
        plan=planned("stability", "write_stability", "pages"),
        curves="results/curves/stability.csv",
    output:
        table=report(
            "results/stability.csv",
            caption="../report/stability.rst",
            category="Stability",
            labels={"table": "digits by decades of each parameter"},
        ),
        record="results/records/stability.json",
    log:
        "results/logs/stability.log",
    message:
        "Tabulating digits by decades"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/write_stability.py"
