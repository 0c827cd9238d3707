"""Jobs without a service: computed on this machine's cores, their results in a folder.

The folder holds ``job.json`` (the filled-in job: running it repeats the result),
``results.zarr.zip`` (the store, in one file) and ``outcome.json`` (how it ended); while it can go
on also ``running``, with what it goes on from.  What computes is loaded when something is computed:
importing this loads no compiler.
"""

from jointplay.local.folder_job import load
from jointplay.local.running import resume, run

__all__ = ["load", "resume", "run"]
