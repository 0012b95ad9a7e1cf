"""The reproduction of W. J. Stronge, Planar impact of rough compliant bodies (1994)."""
