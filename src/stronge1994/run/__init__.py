"""The proof of a run: what every job read and wrote, the gate that checks it, the final summary.

Before a run, `plans` writes the settings of each job and the hashes of the files of this repository
that it reads. The job leaves a `record` of what it read and wrote. The `gate` comes last. It
compares all records with the files that are there, and decides whether the run passed.
"""
