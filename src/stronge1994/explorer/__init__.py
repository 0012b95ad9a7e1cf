"""The page to explore one impact, and rebounds of the package that it must reproduce."""
