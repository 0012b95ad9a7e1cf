"""Error against time: tables of every model, and other codes on the same impacts."""
