"""Results of a job in a folder."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, get_args

from jointplay import figures
from jointplay.client.errors import FieldProblem, NotFound, Refused
from jointplay.client.results import Impacts, Names, Peak, Seconds, Shown, Store
from jointplay.client.window import Window
from jointplay.figures import Options, Pace
from jointplay.job_fields import KINDS
from jointplay.local.exact_windows import exact_peaks, exact_window, window_of
from jointplay.records.attractor_table import attractor_table
from jointplay.records.branch import branch_document
from jointplay.records.calibration_misfit import with_misfits
from jointplay.records.certificate import certificate_document
from jointplay.records.channel_choice import NoSuchChannel, choose
from jointplay.records.figure_form import Form
from jointplay.records.impact import IMPACT_UNITS
from jointplay.records.kinds_with import kinds_with
from jointplay.records.resolution import of_samples
from jointplay.records.sensitivity.analysis import NoSuchOutput, Question, Side, sensitivity
from jointplay.records.window_query import WindowQuery, wrong_end
from jointplay.solver.runs.work_precision.work_precision import WorkPrecision
from jointplay.storage.results.contact_peaks import with_contact_peaks
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.studies.reader import StudyReader
from jointplay.worker.windows.ends import NoSuchWindow

_MARKS = {"accuracy": "runs", "attractors": "states", "branch": "labels"}
"""Attributes of studies that have a result which several kinds may have."""


class FolderResults:
    """The `Results` of a job in a folder; refusals are those of a service."""

    def __init__(self, store: Path, reader: ResultReader | StudyReader) -> None:
        self._store = store
        self._reader = reader

    def store(self) -> Store:
        """Return the path of the store; none of a run that was cut short, never packed."""
        if self._store.is_dir():
            sentence = (
                f"{self._store} holds what a run computed that was cut short; other programs"
                " cannot open it. Read it here, or run the job again to its end."
            )
            raise NotFound(sentence)
        return Store(str(self._store), None)

    def content(self, key: str) -> bytes:
        """Return a file of the store, such as ``zarr.json``; FileNotFoundError if there is none."""
        return self._reader.files.read(key)

    def window(self, query: WindowQuery) -> Window:
        """Return channels in a window of time."""
        reader = self._reader_of("history")
        names = _chosen(query.channels, reader)
        start, stop, points = query.start, query.stop, query.points
        _check_ends(start, stop)
        if points is not None and points < 1:
            raise _refused("points", f"points is {points}; it is at least 1.")
        note = ""
        if not query.of_samples:
            with _refusals():
                found = exact_window(reader, names, query)
            if isinstance(found, Window):
                return found
            if query.step is not None:
                raise _refused("step", found)
            note = found
        made_of = of_samples(reader.attributes["job"])
        first, last = reader.between(start, stop)
        if points is None or last - first <= points:
            samples = reader.history(names, first, last)
            return window_of(reader, *samples, note=note, resolution=made_of)
        time, extremes = reader.extremes(names, first, last, points)
        pairs = {n: with_contact_peaks(reader, n, time, pair) for n, pair in extremes.items()}
        columns = {name: pair.ravel() for name, pair in pairs.items()}
        return window_of(reader, time.ravel(), columns, exact=False, note=note, resolution=made_of)

    def sections(self, channels: Names) -> Window:
        """Return channels at the Poincare sections."""
        reader = self._reader_of("sections in time")
        return window_of(
            reader,
            *reader.sections(_chosen(channels, reader)),
            note=str(reader.attributes.get("section_note", "")),
        )

    def peaks(self, start: Seconds = None, stop: Seconds = None) -> Mapping[str, Peak]:
        """Return the signed extremes of every channel."""
        reader = self._reader_of("peaks")
        found = reader.peaks()
        _check_ends(start, stop)
        if (start, stop) != (None, None):
            with _refusals():
                looked = exact_peaks(reader, start, stop)
            if isinstance(looked, str):
                raise _refused("start", looked)
            found = looked
        return {
            one.name: Peak(**vars(found[one.name]), unit=one.unit)
            for one in reader.channels
            if found
        }

    def impacts(self) -> Impacts:
        """Return the contacts of the clearance joints."""
        reader = self._reader_of("impacts")
        rows = reader.impacts()
        joints = [reader.joints[index] for index in rows["joint"]]
        return Impacts(joint=joints, **{name: rows[name].copy() for name in IMPACT_UNITS})

    def statistics(self) -> dict[str, Any]:
        """Return what the run cost, and its energy ledger."""
        reader = self._reader_of("statistics")
        notes = reader.attributes.get("notes", [])
        return {"complete": reader.complete, "notes": notes, **reader.attributes.get("summary", {})}

    def certificate(self) -> dict[str, Any]:
        """Return how far the run can be believed."""
        reader = self._reader_of("certificate")
        found = reader.certificate()
        if found is None:
            raise NotFound(f"{self._store} was computed without a certificate.")
        return certificate_document(reader, found)

    def accuracy(self) -> dict[str, Any]:
        """Return what every method and tolerance costs and buys."""
        study = self._study_with("accuracy")
        return WorkPrecision.of(study).document()

    def attractors(self) -> dict[str, Any]:
        """Return the attractors of a map of basins, or of starts that were drawn."""
        study = self._study_with("attractors")
        return attractor_table(study)

    def calibration(self) -> dict[str, Any]:
        """Return what a calibration found."""
        study = self._study_with("calibration")
        if 0 not in study.documents:
            raise NotFound(f"The search in {self._store} did not end.")
        return with_misfits(study.documents[0])

    def sensitivity(
        self, output: str | None, limit: float | None, failing: Side, confidence: float
    ) -> dict[str, Any]:
        """Return what one output owes to each parameter."""
        study = self._study_with("sensitivity")
        if failing not in get_args(Side):
            raise _refused("failing", f"failing is {failing!r}; it is 'above' or 'below'.")
        if not 0.5 <= confidence <= 0.999:
            raise _refused("confidence", f"confidence is {confidence:g}; it is 0.5 to 0.999.")
        try:
            return sensitivity(study, Question(output, limit, failing, confidence))
        except NoSuchOutput as error:
            raise _refused("output", str(error)) from None

    def branch(self) -> dict[str, Any]:
        """Return the branches of a continuation."""
        study = self._study_with("branch")
        return branch_document(study)

    def study(
        self, observables: Names, channels: Names, sections: tuple[int, int] | None
    ) -> StudyReader:
        """Return the points of a study: all there is, whatever was asked for."""
        if isinstance(self._reader, StudyReader):
            return self._reader
        raise self._absent("points")

    def source(self, query: WindowQuery) -> ResultReader:
        """Return a simulation: all there is, whatever was asked for."""
        return self._reader_of("history")

    def figures(self) -> list[str]:
        """Return the names of the figures that can be drawn."""
        return [one.name for one in figures.available(self._reader)]

    def figure(self, name: str, form: Form, shown: Shown, options: Options) -> bytes:
        """Draw a figure."""
        with _refusals():
            over = None if shown.over is None else shown.over.study()
            part = (shown.channels, shown.joints, shown.start, shown.stop)
            chosen = figures.select(self._reader, *part, over)
            return figures.render(self._reader, name, form, chosen, options)

    def film(
        self,
        path: Path,
        shown: Shown,
        pace: Pace,
        options: Options,
        report: Callable[[float], object],
    ) -> None:
        """Write a film."""
        reader = self._reader_of("film")
        with _refusals():
            part = (shown.channels, shown.joints, shown.start, shown.stop)
            figures.film(reader, path, figures.select(reader, *part), options, pace, report)

    def _reader_of(self, what: str) -> ResultReader:
        if isinstance(self._reader, ResultReader):
            return self._reader
        raise self._absent(what, "history")

    def _study_with(self, result: str) -> StudyReader:
        """Return the points of a study that has a result of its kind, or `NotFound`."""
        study = self._reader
        if isinstance(study, StudyReader) and (
            study.kind == result or _MARKS.get(result) in study.attributes
        ):
            return study
        raise self._absent(result)

    def _absent(self, what: str, result: str | None = None) -> NotFound:
        """Return the refusal of what a job of this kind does not have, as it lacks a result."""
        kind = self._reader.attributes["job"]["kind"]
        every = {name: one["results"] for name, one in KINDS.items()}
        others = kinds_with(every, what if result is None else result)
        sentence = f"{self._store} is of kind {kind} and has no {what}{others}."
        return NotFound(sentence, problem="wrong-kind")


def _chosen(channels: Names, reader: ResultReader) -> list[str]:
    with _refusals():
        known = [channel.name for channel in reader.channels]
        return choose(None if channels is None else ",".join(channels), known)


def _check_ends(start: Seconds, stop: Seconds) -> None:
    if (wrong := wrong_end(start, stop)) is not None:
        raise _refused(*wrong)


@contextmanager
def _refusals() -> Iterator[None]:
    """Say what cannot be as a service does."""
    try:
        yield
    except NoSuchChannel as error:
        raise _refused("channels", *error.sentences) from None
    except NoSuchWindow as error:
        raise _refused(error.end, str(error)) from None
    except figures.UnknownFigure as error:
        raise NotFound(str(error), problem="unknown-figure") from None
    except figures.NotDrawable as error:
        raise _refused(error.cause, str(error), problem="not-drawable") from None


def _refused(pointer: str, *sentences: str, problem: str = "invalid-request") -> Refused:
    fields = [FieldProblem(pointer, sentence) for sentence in sentences]
    return Refused(" ".join(sentences), problem=problem, fields=fields)
