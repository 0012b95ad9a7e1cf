"""A package, so that tests import helpers by their full names and find them from the top folder."""
