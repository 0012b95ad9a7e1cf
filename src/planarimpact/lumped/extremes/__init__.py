"""Groups of any size (`scaling`) and contacts of thousands of phases (`many_phases`).

The physics of the lumped model is understood without this package.
"""
