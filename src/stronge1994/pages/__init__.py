"""Pages to read: the report, the ledger, the lectures, the explorer."""
