"""What every package uses: types, checks, results, and files written whole or not at all."""
