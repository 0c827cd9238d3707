"""The files of a local run's folder."""

JOB_FILE = "job.json"
STORE = "results.zarr.zip"
"""The sealed store, in one file."""
RUNNING = "running"
"""Folder of a store that is not sealed yet, or never was."""
OUTCOME_FILE = "outcome.json"
"""End of the run: its state, times, and error."""
