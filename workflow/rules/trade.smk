rule trade_tables:
    """Error and time of every model as tables."""
    input:
        plan=planned("trade", "write_trade", "figures/trade/answers.py"),
        curves="results/curves/trade.csv",
    output:
        table="results/trade.csv",
        answers="results/which_model.csv",
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
