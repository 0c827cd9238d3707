"""Results as plain numbers: what a job gives however it is reached, without pandas or xarray."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from jointplay.client.window import Window
from jointplay.records import peak
from jointplay.records.figure_form import Form
from jointplay.records.run import Source
from jointplay.records.study import StudySource
from jointplay.records.window_query import WindowQuery

if TYPE_CHECKING:
    from jointplay.figures import Options, Pace
    from jointplay.records.sensitivity.analysis import Side

Names = Sequence[str] | None
"""Names or globs of channels; all if None."""
Seconds = float | None
"""A time, s; None is unbounded."""


@dataclass(frozen=True)
class Peak(peak.Peak):
    """Signed extremes of one channel, each with its time in s; NaN where nothing was computed."""

    unit: str = "1"


@dataclass(frozen=True)
class Impacts:
    """Contacts in order of release, one row each; arrays have shape (n,).

    ``onset`` and ``release`` in s (release NaN: in contact at the end), ``approach_rate`` in
    m/s, ``peak_force`` in N, ``impulse`` in N s.
    """

    joint: list[str]
    onset: NDArray[np.float64]
    release: NDArray[np.float64]
    approach_rate: NDArray[np.float64]
    peak_force: NDArray[np.float64]
    impulse: NDArray[np.float64]


class Store(NamedTuple):
    """A Zarr store: its address or path, and what fsspec needs to reach it."""

    address: str
    options: dict[str, Any] | None


class Beneath(Protocol):
    """The job of a study that lies beneath a figure of another."""

    @property
    def id(self) -> str:
        """Its id, which a service knows."""

    def study(self) -> StudySource:
        """Return its points."""


class Shown(NamedTuple):
    """Content of a figure or a film; all channels and joints where there are none."""

    channels: Sequence[str]
    joints: Sequence[str]
    start: Seconds
    stop: Seconds
    over: Beneath | None = None


class Results(Protocol):
    """The results of one job; one implementation speaks HTTP, one reads a folder.

    Everything raises `NotFound` where a job of this kind has no such result, and
    `ResultsNotReady` before there is any.
    """

    def store(self) -> Store:
        """Return where stock Zarr clients find the stored arrays."""

    def content(self, key: str) -> bytes:
        """Return a file of the store, such as ``zarr.json``; FileNotFoundError if there is none."""

    def window(self, query: WindowQuery) -> Window:
        """Return channels in a window of time, as samples, extremes or at instants."""

    def sections(self, channels: Names) -> Window:
        """Return channels at the Poincare sections of a simulation."""

    def peaks(self, start: Seconds = None, stop: Seconds = None) -> Mapping[str, Peak]:
        """Return the signed extremes of every channel of a simulation, or of a window of it."""

    def impacts(self) -> Impacts:
        """Return the contacts of the clearance joints of a simulation."""

    def statistics(self) -> dict[str, Any]:
        """Return what a simulation cost, and its energy ledger with the residual, in J."""

    def certificate(self) -> dict[str, Any]:
        """Return how far a simulation can be believed."""

    def accuracy(self) -> dict[str, Any]:
        """Return what every method and tolerance costs and buys, of an accuracy-study."""

    def attractors(self) -> dict[str, Any]:
        """Return the attractors of many starts, and how often they are reached."""

    def branch(self) -> dict[str, Any]:
        """Return the branches of a continuation."""

    def calibration(self) -> dict[str, Any]:
        """Return what a calibration found."""

    def sensitivity(
        self, output: str | None, limit: float | None, failing: "Side", confidence: float
    ) -> dict[str, Any]:
        """Return what one output owes to each parameter, of a job of the kind sensitivity."""

    def study(
        self, observables: Names, channels: Names, sections: tuple[int, int] | None
    ) -> StudySource:
        """Return the points of a study as they are now."""

    def source(self, query: WindowQuery) -> Source:
        """Return the samples of a window as exports take them; there may be more."""

    def figures(self) -> list[str]:
        """Return the names of the figures that can be drawn."""

    def figure(self, name: str, form: Form, shown: Shown, options: "Options") -> bytes:
        """Return a figure as a file's bytes."""

    def film(
        self,
        path: Path,
        shown: Shown,
        pace: "Pace",
        options: "Options",
        report: Callable[[float], object],
    ) -> None:
        """Write a film of a simulation, and report the share that is done."""
