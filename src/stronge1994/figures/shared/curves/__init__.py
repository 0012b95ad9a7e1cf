"""The curves of the paper's figures: a module for each figure, settings in, named curves out.

Each module has one function `curves`, whose keywords are the settings of that figure in
`workflow/config.yaml` with the physics shared by all. It returns `{name: {column: array}}`; a
column's name carries its unit in brackets, S = (v1(0)^2 + v2(0)^2)^(1/2).
"""
