"""Write the results of one attempt, from empty store to sealed store."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Self

from numpy.typing import NDArray

from jointplay.records.impact import IMPACT
from jointplay.records.peak import Peak
from jointplay.records.run import CertificateRecord
from jointplay.records.run_rows import RunRows
from jointplay.storage.errors import InvalidAppend, StoreExists, StoreSealed
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.packed import Running, pack
from jointplay.storage.packed.running import DOCUMENTS, digest_in
from jointplay.storage.results import certificate_group, manifest, metadata
from jointplay.storage.results.growing_table import GrowingTable
from jointplay.storage.results.intervals import intervals_table
from jointplay.storage.results.journal import Journal
from jointplay.storage.results.layout import ResultLayout
from jointplay.storage.results.pyramid import Pyramid
from jointplay.storage.results.sealing import check_sealable, peak_columns
from jointplay.storage.results.steps import steps_table
from jointplay.storage.results.tables import documents, tables
from jointplay.storage.results.waiting import Checkpoint
from jointplay.storage.results.wide_table import WideTable


class ResultWriter:
    """One store being written by one process; make it with `create` or `resume`.

    The bytes of a sealed store depend on the layout, the rows and the summary alone: not on how
    the rows were sliced into `append` calls, nor on whether and where the run was interrupted
    and resumed.
    """

    def __init__(self, path: Path, layout: ResultLayout) -> None:
        self._layout = layout
        self._files = Running(path, digest=digest_in(layout.attributes))
        self._journal = Journal(self._files, layout.digest)
        self._tables = [GrowingTable(table, self._files) for table in tables(layout)]
        self._history, self._sections, self._impacts, self._peaks = self._tables
        self._steps = steps_table(layout, self._files) if layout.steps else None
        self._intervals = intervals_table(layout, self._files) if layout.intervals else None
        self._pyramid = Pyramid(layout, self._history, self._files)
        self._sealed = False

    @classmethod
    def create(cls, path: Path, layout: ResultLayout) -> Self:
        """Begin an empty store in a folder, which is made if it does not exist.

        Raises
        ------
        StoreExists
            There is a store in it already.
        """
        if (path / DOCUMENTS).exists():
            raise StoreExists(f"{path} holds results already; choose another folder")
        writer = cls(path, layout)
        writer._show()
        return writer

    @classmethod
    def resume(
        cls,
        path: Path,
        layout: ResultLayout,
        checkpoint: bytes,
        *,
        taken_over_from: Path,
    ) -> Self:
        """Begin a store that continues another one from its checkpoint.

        Shards below the checkpoint's watermark get a second name in the new folder (or are
        copied where the file system cannot link). The old folder is only read: whoever still
        writes there disturbs nothing, and it may be deleted once this returns and the new
        writer's next checkpoint is stored.

        Parameters
        ----------
        path
            Folder of the new store, as for `create`.
        layout
            That of the old store; attributes other than the digest may differ.
        checkpoint
            What `checkpoint` of the old store's writer returned.
        taken_over_from
            Folder of the old store, the one whose writer made the checkpoint.

        Raises
        ------
        StoreExists
            There is a store in `path` already.
        CheckpointMismatch
            The checkpoint is of another layout, or the old folder lacks shards or journal.
        CorruptStore
            Shards or journal have other bytes than were written.
        """
        path = Path(path)
        taken_over_from = Path(taken_over_from)
        state = Checkpoint(checkpoint, layout.digest)
        writer = cls.create(path, layout)
        lost = Running(taken_over_from, digest=digest_in(layout.attributes))
        for table, durable in zip(writer._growing, state.durable, strict=True):
            table.take_over(lost, durable)
        state.replay(lost, writer._growing)
        if writer._impacts.durable:
            writer._show()
        return writer

    @property
    def samples(self) -> int:
        """Samples appended so far, durable or waiting."""
        return self._history.rows

    @property
    def sections(self) -> int:
        """Poincare sections appended so far."""
        return self._sections.rows

    @property
    def impacts(self) -> int:
        """Impacts appended so far."""
        return self._impacts.rows

    def append(self, rows: RunRows) -> None:
        """Add rows; whole shards go to the disk, the rest waits in memory.

        Raises
        ------
        StoreSealed
            After `seal`.
        InvalidAppend
            Rows out of turn, more of them than the layout has, or of another shape. Nothing has
            been taken then.
        """
        self._refuse_when_sealed()
        self._check(rows)
        if rows.sample_time.size:
            self._pyramid.append([*rows.samples.T, rows.sample_time])
            self._history.append([*rows.samples.T, rows.sample_time])
        if rows.section_time.size:
            self._sections.append([*rows.sections.T, rows.section_time])
        for table, wide in ((self._steps, rows.steps), (self._intervals, rows.intervals)):
            if table is not None and wide.shape[1]:
                table.append(list(wide.T))
        if rows.impacts.size:
            durable = self._impacts.durable
            self._impacts.append([rows.impacts[str(name)] for name in IMPACT.names or ()])
            if self._impacts.durable != durable:
                self._show()

    def checkpoint(self) -> bytes:
        """Bring everything appended so far to the disk and return a restart point.

        A few hundred bytes; the waiting rows themselves go to a journal in the folder. Valid
        for `resume` as long as the folder is there and no more than two later checkpoints have
        been made, so store one before asking for the next.
        """
        self._refuse_when_sealed()
        return self._journal.checkpoint(self._growing)

    def seal(
        self,
        target: StoredObject,
        *,
        peaks: Mapping[str, Peak],
        summary: Mapping[str, Any],
        complete: bool = True,
        certificate: CertificateRecord | None = None,
    ) -> None:
        """Finish the store: packed, durable and never to change when this returns.

        The folder stays, for those who read it: remove it when everybody knows of the sealed one.

        Parameters
        ----------
        target
            Where the packed store goes.
        peaks
            Signed extremes by channel; a channel without them gets NaN.
        summary
            JSON document for the root attribute `summary`; numbers must be finite.
        complete
            False for a run that failed or was cancelled; what was appended is kept.
        certificate
            What is known of the rows' errors, for a group of that name.

        Raises
        ------
        StoreSealed
            When called twice.
        StoreExists
            There is a store at the target.
        InvalidAppend
            `complete` although samples or sections are missing, a peak of an unknown channel,
            or a summary that JSON cannot carry; the store may still be sealed then.
        OSError
            The disk is full, for example. The store stays unsealed; its last checkpoint can
            still be resumed.
        """
        self._refuse_when_sealed()
        attributes = {
            "complete": complete,
            "samples": self.samples,
            "sections": self.sections,
            "impacts": self.impacts,
            "summary": dict(summary),
        }
        more = {} if certificate is None else certificate_group.nodes(certificate)
        check_sealable(self._layout, attributes, more, peaks)
        self._sealed = True
        self._peaks.append(peak_columns(self._layout, peaks))
        self._pyramid.close()
        shown = [table.rows for table in self._tables]
        nodes = documents(self._layout, shown, attributes, more)
        try:
            target.put(pack(manifest.listed(self._entries(nodes, certificate))))
        except FileExistsError as error:
            raise StoreExists(f"{target} holds results already") from error

    def _entries(
        self, nodes: dict[str, metadata.Document], certificate: CertificateRecord | None
    ) -> Iterator[tuple[str, bytes]]:
        """Give every file of the packed store, by its name."""
        for table in self._growing:
            yield from table.files()
        if certificate is not None:
            yield from certificate_group.chunks(certificate)
        yield from metadata.serialised(self._internal() | nodes)

    @property
    def _growing(self) -> list[GrowingTable]:
        """Everything that is written shard by shard, in the order of the journal."""
        wide = [table for table in (self._steps, self._intervals) if table is not None]
        return [*self._tables[:-1], *wide, self._peaks, *self._pyramid.levels]

    def _internal(self) -> dict[str, metadata.Document]:
        """Give the documents, by key, of arrays that clients are not shown."""
        wide = [table for table in self._growing if isinstance(table, WideTable)]
        return self._pyramid.documents() | dict(table.document() for table in wide)

    def _show(self) -> None:
        """Let readers of the growing store see all samples to come and the impacts so far.

        The groups' documents hold those of the arrays; each array's own is written by `seal`.
        """
        layout = self._layout
        shown = [layout.samples, layout.sections, self._impacts.durable, len(layout.channels)]
        groups = metadata.groups_among(documents(layout, shown, {}))
        self._files.write_documents(metadata.serialised(self._internal() | groups))

    def _check(self, rows: RunRows) -> None:
        """Refuse rows that do not go on where those before ended, or do not fit the layout."""
        if rows.first_sample != self.samples or rows.first_section != self.sections:
            raise InvalidAppend(
                f"the next rows are sample {self.samples} and section {self.sections}, "
                f"not sample {rows.first_sample} and section {rows.first_section}"
            )
        self._check_shape("samples", rows.sample_time, rows.samples)
        self._check_shape("sections", rows.section_time, rows.sections)
        if rows.impacts.size and set(rows.impacts.dtype.names or ()) != set(IMPACT.names or ()):
            raise InvalidAppend(f"impacts need the fields {IMPACT.names}")
        if rows.steps.shape[1] not in (0, len(self._layout.steps)):
            raise InvalidAppend(f"steps must have {len(self._layout.steps)} columns")
        self._history.check_capacity(len(rows.sample_time))
        self._sections.check_capacity(len(rows.section_time))

    def _check_shape(self, what: str, time: NDArray[Any], rows: NDArray[Any]) -> None:
        expected = (len(time), len(self._layout.channels))
        if time.ndim != 1 or (rows.shape != expected and (time.size or rows.size)):
            raise InvalidAppend(f"{what} must have shape {expected}, not {rows.shape}")

    def _refuse_when_sealed(self) -> None:
        if self._sealed:
            raise StoreSealed(f"{self._files.folder} is sealed and takes no more rows")
