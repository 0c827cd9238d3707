"""Expected cost of a job, in words."""

from typing import TYPE_CHECKING

import typer

from jointplay.progress import duration

if TYPE_CHECKING:
    from jointplay.client import Estimate


def print_estimate(estimate: "Estimate") -> None:
    """Print time, steps and bytes, and what else is known of a job before it runs."""
    seconds = estimate.seconds
    time = duration(seconds) if seconds >= 10 else f"{seconds:.2g} s"
    typer.echo(f"computing  {time} of one core, {estimate.steps:.3g} steps")
    typer.echo(f"results    {estimate.bytes / 1e6:.3g} MB")
    if estimate.points > 1:
        typer.echo(f"points     {estimate.points} in {estimate.blocks} blocks")
    if estimate.cached:
        typer.echo("an identical job is there already: submitting it costs nothing")
    if estimate.failure is not None:
        typer.echo(f"it will end early: {estimate.failure}")
