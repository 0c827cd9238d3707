"""A job's results for notebooks: arrays, tables, windows and pictures."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from jointplay.client.errors import FieldProblem, Refused
from jointplay.client.notebook import Picture
from jointplay.client.results import Beneath, Shown
from jointplay.client.tables import TabledJob
from jointplay.client.window import Window
from jointplay.records.figure_form import Form
from jointplay.records.study import StudySource
from jointplay.records.window_query import WindowQuery

if TYPE_CHECKING:
    from jointplay.exports.table_query import Table
    from jointplay.records.sensitivity.analysis import Side

Names = str | Sequence[str]
Made = TypeVar("Made")


class ReadableJob(TabledJob):
    """A job's record with the ways to its results."""

    def window(
        self,
        channels: Names | None = None,
        start: float | None = None,
        stop: float | None = None,
        *,
        points: int | None = None,
        step: float | None = None,
    ) -> Window:
        """Return channels in a window of time: samples, extremes for a screen, or any instants.

        Parameters
        ----------
        channels
            Names or globs; all if None.
        start, stop
            Both included, s; None is unbounded.
        points
            Pairs of smallest and largest values, each of an equal span; see `Window`.
        step
            Time between instants, s; values there are computed from the steps of the run.
        """
        return self.results.window(WindowQuery(_listed(channels), start, stop, points, step))

    @property
    def statistics(self) -> dict[str, Any]:
        """Cost of a simulation, and its energy ledger with the residual, in J."""
        return self.results.statistics()

    @property
    def certificate(self) -> dict[str, Any]:
        """Certificate of a simulation; `NotFound` where there is none."""
        return self.results.certificate()

    @property
    def accuracy(self) -> dict[str, Any]:
        """Costs and errors of an accuracy-study's ``points`` as they are now, and ``advice``."""
        return self.results.accuracy()

    @property
    def attractors(self) -> dict[str, Any]:
        """Attractors of many starts, their shares with errors; of a map its boundary."""
        return self.results.attractors()

    @property
    def calibration(self) -> dict[str, Any]:
        """Findings of a calibration: its ``parameters`` with their spread, ``targets``, ``search``.

        `ResultsNotReady` until its search has ended.
        """
        return self.results.calibration()

    def sensitivity(
        self,
        output: str | None = None,
        limit: float | None = None,
        *,
        failing: "Side" = "above",
        confidence: float = 0.95,
    ) -> dict[str, Any]:
        """Return what an output owes to each parameter as far as is known; any, without new runs.

        Parameters
        ----------
        output
            An extreme of a channel, such as ``displacement.maximum``, or a statistic that the job
            chose; the first if None.  The answer's ``outputs`` has all of them.
        limit
            Of the output, in its unit: ``failure`` says how probable it is beyond.
        failing
            Which side of the limit that is.
        confidence
            Probability of every interval, 0.5 to 0.999.

        Returns
        -------
        dict
            ``measures`` by name, each with ``values`` of the ``parameters`` and both ends of their
            intervals, ``low`` and ``high``; ``quantiles``, ``mean``, ``standard_deviation``,
            ``failure``, and the ``rows`` that were used and left out.
        """
        return self.results.sensitivity(output, limit, failing, confidence)

    @property
    def branch(self) -> dict[str, Any]:
        """Branches of a continuation as they are now: ``columns`` and ``special`` orbits of each.

        Where a second parameter varies, curves of special orbits follow, ``of`` a label. `poincare`
        has the columns as a table.
        """
        return self.results.branch()

    def study(
        self,
        observables: Names | None = None,
        channels: Names | None = None,
        sections: tuple[int, int] | None = None,
    ) -> StudySource:
        """Return the points of a study as they are now, as arrays; it need not be finished.

        Parameters
        ----------
        observables
            Names or globs of channels whose values at the sections to fetch; all if None.
        channels
            Of a sweep, names or globs of channels whose extremes to fetch; all if None.
        sections
            First section of each point, and the one before which to end; all if None.
        """
        self._insist_on_points()
        return self.results.study(_listed(observables), _listed(channels), sections)

    def export(
        self,
        path: Path | str,
        table: "Table | None" = None,
        channels: Names | None = None,
        start: float | None = None,
        stop: float | None = None,
        *,
        points: int | None = None,
        step: float | None = None,
    ) -> Path:
        """Write a table to a file, every bit of it, in the form that its suffix names.

        Parameters
        ----------
        path
            Ends in ``.csv``, ``.json``, ``.npz``, ``.mat`` (MATLAB), ``.arrow`` or ``.parquet``;
            the last two need ``pip install 'jointplay[arrow]'``.
        table
            Of a simulation "history" (default), "poincare", "peaks" or "impacts"; of a study
            "poincare" or "points".
        channels
            Names or globs; all if None.
        start, stop
            Window of time, s; of a study the first point, and the one before which to end.
        points
            Of a history, most pairs of smallest and largest values.
        step
            Of a history, time between instants, s.

        Returns
        -------
        Path
            Of the file; there is none, or the one before, if it could not be written whole.

        Raises
        ------
        NoSuchTable, NoSuchPart
            Errors of values: the job has no such table, or the table no such part.
        """
        from jointplay.exports.table_columns import columns_of
        from jointplay.records.table_files import encode, form_of
        from jointplay.records.whole_file import whole

        form_of(path)  # before anything is fetched
        query = WindowQuery(_listed(channels), start, stop, points, step)
        columns = columns_of(self, table, query)
        file = Path(path)
        content = encode(file, columns, complete=self.state == "succeeded")
        with whole(file) as partial:
            partial.write_bytes(content)
        return file

    @property
    def figures(self) -> list[str]:
        """Names of the figures that can be drawn; the name of any channel is one, too."""
        return self.results.figures()

    def figure(
        self,
        /,
        name: str,
        *,
        channel: Names = (),
        joint: Names = (),
        start: float | None = None,
        stop: float | None = None,
        over: Beneath | None = None,
        form: Form = "png",
        **options: Any,
    ) -> Picture:
        """Draw a figure; notebooks show it, and ``save`` writes it to a file.

        Parameters
        ----------
        name
            One of `figures`, or a channel.
        channel, joint
            What to show, one or several; all if not given.
        start, stop
            Window of time, s; of a study the first point, and the one before which to end.
        over
            Job of a chart or of basins, over whose map branches and curves are drawn.
        form
            "png", "svg", "pdf" or "eps".
        options
            Of the page: width and height in mm, ``x_min``, ``x_max``, ``y_min``, ``y_max`` in the
            unit that the axis shows, ``x_scale``, ``y_scale`` "linear" or "log", ``title``,
            ``units`` such as "mm,kN", ``font`` "serif" and ``font_size`` in points; see
            `jointplay.figures.Options`.
        """
        from jointplay.figures import chosen_options

        page = _drawable(chosen_options, options)
        shown = Shown(_listed(channel) or (), _listed(joint) or (), start, stop, over)

        def draw(form: Form) -> bytes:
            return self.results.figure(name, form, shown, page)

        return Picture(draw(form), form, draw)

    def film(
        self,
        /,
        path: Path | str,
        *,
        joint: Names = (),
        start: float | None = None,
        stop: float | None = None,
        rate: float | None = None,
        frames_per_second: int = 20,
        impact_to_impact: bool = False,
        report: Callable[[float], object] = lambda share: None,
        **options: Any,
    ) -> Path:
        """Write a film of the mechanism, its joints with play magnified; of a run in a folder.

        Parameters
        ----------
        path
            Ends in ``.gif``, ``.mp4`` or ``.webm``; the last two need ffmpeg, which
            ``pip install 'jointplay[film]'`` brings along.
        joint
            What to magnify, one or several; the first six with play if not given.
        start, stop
            Window of time, s; the first turn of the drivers if not given.
        rate
            Seconds of motion in one second of film; if not given, the film lasts 6 s.
        frames_per_second
            Of the film, which has at most 300 frames.
        impact_to_impact
            Show the middle of each impact, one a frame; there is no rate then.
        report
            Called with the share that is done.
        options
            Of the page, as those of `figure`.

        Returns
        -------
        Path
            Of the file.
        """
        from jointplay.figures import Pace, chosen_options

        page = _drawable(chosen_options, options)
        pace = _drawable(Pace, rate, frames_per_second, impact_to_impact)
        file = Path(path)
        shown = Shown((), _listed(joint) or (), start, stop)
        self.results.film(file, shown, pace, page, report)
        return file


def _listed(names: Names | None) -> list[str] | None:
    if names is None:
        return None
    return [names] if isinstance(names, str) else list(names)


def _drawable(make: Callable[..., Made], *given: Any) -> Made:
    """Return what is made for a drawing; what cannot be is refused as a service does."""
    from jointplay.figures import NotDrawable

    try:
        return make(*given)
    except NotDrawable as error:
        field = FieldProblem(error.cause, str(error))
        raise Refused(str(error), problem="not-drawable", fields=[field]) from None
