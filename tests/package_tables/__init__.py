"""Codes that make tables with the package's own solvers: the splines of `planarimpact.spheres`, the
example scenes, and the elastic continuum by annuli, which the package's continuum checks."""
