rule versions:
    """Versions of Python, of this package and of the libraries: with another one all is made anew."""
    output:
        "results/versions.json",
    log:
        "results/logs/versions.log",
    conda:
        "../envs/planarimpact.yaml"
    params:
        versions=lambda _: json.dumps(versions.installed(planarimpact.__version__)),
    shell:
        "echo {params.versions:q} > {output} 2> {log}"


rule curves:
    """Solve every curve of one figure."""
    input:
        versions="results/versions.json",
        tables=of_figure("tables"),
    output:
        "results/curves/{figure}.csv",
    log:
        "results/logs/curves_{figure}.log",
    priority: priority
    conda:
        "../envs/planarimpact.yaml"
    resources:  # the profile allows one timed job at once
        timed=lambda wildcards: int(wildcards.figure in TIMED),
    params:
        settings=of_figure("curves"),
        content=digest("workflow/scripts/solve.py", code_of("curves"), of_figure("tables")),
    script:
        "../scripts/solve.py"


rule scene:
    """Solve a table of impacts, each by the cheapest model that is good enough."""
    input:
        versions="results/versions.json",
        table="data/scenes/{scene}.csv",
    output:
        "results/scenes/{scene}.csv",
    log:
        "results/logs/scene_{scene}.log",
    conda:
        "../envs/planarimpact.yaml"
    params:
        tolerance=lambda wildcards: config["scenes"][wildcards.scene]["tolerance"],
        content=digest("workflow/scripts/solve_scene.py", "data/scenes/{scene}.csv"),
    script:
        "../scripts/solve_scene.py"


rule ledger:
    """Check every entry of the paper's ledger against the paper's model, solved to rounding."""
    input:
        versions="results/versions.json",
        entries=LEDGER,
        facts="data/stronge1994/source.yaml",  # to which entries refer
        schema="workflow/schemas/ledger.schema.yaml",
    output:
        table="results/ledger.csv",
        measures="results/in_nature.csv",
    log:
        "results/logs/ledger.log",
    priority: 1  # as it is long
    conda:
        "../envs/planarimpact.yaml"
    params:
        content=digest(
            "workflow/scripts/check_ledger.py",
            "src/stronge1994/ledger",
            LEDGER,
            "data/stronge1994/source.yaml",
        ),
    script:
        "../scripts/check_ledger.py"
