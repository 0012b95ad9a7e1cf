"""What every room stands on: types, checks, results, and files written whole or not at all."""
