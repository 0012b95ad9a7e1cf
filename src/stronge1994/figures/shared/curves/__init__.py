"""What several figures need to make their curves.

The curves.py of a figure has one function `curves`. Its keywords are the settings in the
figure.yaml beside it, and the shared physics of workflow/config.yaml that figure.yaml asks for:
`mass_ratio` is beta and `stiffness_ratio` zeta^2. Some get more: `nodes`, points of reference
tables through which the curves must pass, by the axis on which they lie; and `uncertainty`, one
sigma of each uncertain parameter. An incidence is x = v1(0)/(mu v2(0)).

What it returns is a table of curves, see `stronge1994.tables`. S is (v1(0)^2 + v2(0)^2)^(1/2).
"""
