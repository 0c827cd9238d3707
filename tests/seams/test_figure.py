"""A figure from outside: the speed of a body, one object and one registry line."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from jointplay import figures
from jointplay.client import Job, NotFound, Refused
from jointplay.command_line.application import run
from jointplay.figures import colours, page, scene_facts
from jointplay.figures.kind import RunFigure, Selection
from jointplay.local import load
from jointplay.records.run import Source
from tests.seams.conftest import Platform

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def velocities(source: Source, selection: Selection) -> tuple[str, ...]:
    """Both components of the velocity of the first body that has them."""
    owners = [one.name.removesuffix(".vx") for one in source.channels if one.name.endswith(".vx")]
    return scene_facts.stored(source, [f"{body}.{name}" for body in owners[:1] for name in VX_VY])


def draw(source: Source, selection: Selection) -> Figure:
    names = velocities(source, selection)
    figure, ((axes,),) = page.panels(1, 1, 40.0)
    for time, columns in source.blocks(names, *source.between(selection.start, selection.stop)):
        axes.plot(time, np.hypot(*columns.values()), color=colours.COMPUTED)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("speed [m/s]")
    return figure


VX_VY = ("vx", "vy")
SPEED = RunFigure("speed", "Speed of a body", ("start", "stop"), velocities, draw)
SWING = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 0.2}


@pytest.fixture
def speed() -> Iterator[None]:
    figures.RUN_FIGURES[SPEED.name] = SPEED
    yield
    del figures.RUN_FIGURES[SPEED.name]


@pytest.fixture(scope="module")
def job(platform: Platform) -> Job:
    return platform.computed(SWING)


def test_it_is_unknown_before(job: Job) -> None:
    assert "speed" not in job.figures
    with pytest.raises(NotFound, match="no figure 'speed'"):
        job.figure("speed")


@pytest.mark.usefixtures("speed")
def test_it_is_drawn_alike_over_http_from_a_folder_and_by_the_command_line(
    platform: Platform, service_url: str, job: Job, tmp_path: Path
) -> None:
    assert "speed" in job.figures
    over_http = job.figure("speed").content
    assert over_http.startswith(b"\x89PNG")
    sealed = platform.settings.sealed_run(job.id, job.attempt)
    local = load(platform.settings.data / "results" / sealed.key)
    assert "speed" in local.figures
    assert local.figure("speed").content == over_http
    command = ["plot", job.id, "speed", "-o", str(tmp_path), "--url", service_url]
    assert run(command) == 0
    assert (tmp_path / "speed.png").read_bytes() == over_http


@pytest.mark.usefixtures("speed")
def test_its_selection_is_checked_and_used(job: Job) -> None:
    assert job.figure("speed", stop=0.1).content != job.figure("speed").content
    with pytest.raises(Refused, match="does not depend on joints"):
        job.figure("speed", joint="A")
