# The tables of spheres, which are part of the package: `snakemake --cores 2 sphere_tables`, not part
# of `all`. After a change of the continuum, make them again and copy them to src/planarimpact/spheres.

rule make_spheres:
    """Solve the continuum at nodes and fit a table of spheres to it; takes some minutes."""
    input:
        plan=planned("make_spheres_{table}", "make_spheres"),
    output:
        table="results/spheres/{table}.npz",
        record="results/records/make_spheres_{table}.json",
    wildcard_constraints:
        table="fine|coarse",
    log:
        "results/logs/make_spheres_{table}.log",
    message:
        "Making the {wildcards.table} table of spheres"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/make_spheres.py"
