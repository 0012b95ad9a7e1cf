"""Codes that make tables with the package's own solvers, so that none of them is a second solution:
the elastic continuum by annuli, the example scenes."""
