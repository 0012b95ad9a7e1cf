rule trade_tables:
    """Error and time of every model as tables."""
    input:
        plan=planned("trade", "write_trade", "figures/trade/answers.py"),
        curves="results/curves/trade.csv",
    output:
        table=report(
            "results/trade.csv",
            caption="../report/trade.rst",
            category="Trade",
            labels={"table": "error and time of every model"},
        ),
        answers=report(
            "results/which_model.csv",
            caption="../report/which_model.rst",
            category="Trade",
            labels={"table": "which model for which tolerance"},
        ),
        record="results/records/trade.json",
    log:
        "results/logs/trade.log",
    priority: 1  # the lectures wait for it
    message:
        "Tabulating error against time"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/write_trade.py"
