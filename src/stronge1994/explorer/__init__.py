"""The page to play with one impact, and answers of the package, which it must give too."""
