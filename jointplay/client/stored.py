"""A job's stored arrays as xarray datasets, through stock Zarr clients."""

from typing import TYPE_CHECKING

from jointplay.client.errors import MissingExtra, NotFound, ResultsNotReady
from jointplay.client.job_record import JobRecord
from jointplay.client.results import Store

if TYPE_CHECKING:
    import xarray as xr


def open_group(job: JobRecord, store: Store, group: str) -> "xr.Dataset":
    """Open a group of a job's store; values are read when they are used.

    Raises
    ------
    MissingExtra
        xarray, or what it needs to read over HTTP, is not installed.
    ResultsNotReady
        The job has committed nothing yet.
    NotFound
        It has no such group, or ended before it committed anything.
    """
    try:
        import xarray as xr
        from zarr.storage import ZipStore

        local = store.options is None
        found: xr.Dataset = xr.open_zarr(
            ZipStore(store.address, mode="r") if local else store.address,
            group=group or None,
            chunks=None,  # lazy by itself, without dask
            storage_options=store.options,
        )
    except ImportError as error:
        raise missing_extra("stored arrays", error) from error
    except (FileNotFoundError, KeyError) as error:  # of a group: no such key in the metadata
        if not job.is_finished:
            sentence = f"Job {job.id} is {job.state} and has committed nothing yet."
            raise ResultsNotReady(sentence) from error
        what = f"no group {group!r}" if group else "no results"
        sentence = f"Job {job.id} is {job.state} and has {what}."
        raise NotFound(sentence) from error
    return found


def missing_extra(what: str, error: ImportError) -> MissingExtra:
    """Say what to install."""
    return MissingExtra(f"{what} need an extra: pip install 'jointplay[xarray]' ({error}).")
