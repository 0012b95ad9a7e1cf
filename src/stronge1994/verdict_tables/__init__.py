"""Tables of verdicts: a row for each comparison, and from these a row for each figure."""
