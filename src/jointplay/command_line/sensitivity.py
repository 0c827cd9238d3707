"""``jointplay sensitivity``: what an output owes to each parameter, and how it is distributed."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, Any, cast

import typer

from jointplay.command_line.options import (
    AS_JSON,
    DEFAULT_URL,
    RESULTS,
    URL,
    job_of,
    refused_as_typed,
)
from jointplay.command_line.output import aligned, print_result

if TYPE_CHECKING:
    from jointplay.records.sensitivity.analysis import Side


def sensitivity(
    results: RESULTS,
    output: Annotated[
        str | None,
        typer.Option(
            metavar="NAME", help="An output, such as displacement.maximum; default: the first."
        ),
    ] = None,
    limit: Annotated[
        float | None, typer.Option(metavar="VALUE", help="How probable is the output beyond it?")
    ] = None,
    failing: Annotated[
        str, typer.Option(metavar="above|below", help="Which side of the limit that is.")
    ] = "above",
    confidence: Annotated[float, typer.Option(help="Probability of every interval.")] = 0.95,
    as_json: AS_JSON = False,
    url: URL = DEFAULT_URL,
) -> None:
    """Print what an output owes to each parameter; any output of a job, without new runs.

    Of jobs of `--sensitivity`: the measures of their design with intervals, quantiles, and how
    probable the output is beyond a limit.

    Example: `jointplay sensitivity OUT --output A.normal_force.maximum --limit 2000`
    """
    options = ("output", "limit", "failing", "confidence")
    with job_of(results, url) as job, refused_as_typed(*options):
        side = cast("Side", failing)
        found = job.sensitivity(output, limit, failing=side, confidence=confidence)
    print_result(found, sensitivity_lines(found), as_json=as_json)


def sensitivity_lines(found: dict[str, Any]) -> Iterator[str]:
    """Yield what is known of an output: a table of the parameters, one of quantiles, the limit."""
    rows, unit = found["rows"], "" if found["unit"] == "1" else f" {found['unit']}"
    yield f"{found['output']}: {found['long_name']}"
    left = f", {rows['left_out']} left out (failed points: {rows['failed_points']})"
    waiting = f", {rows['waiting']} waiting" if rows["waiting"] else ""
    yield f"{rows['used']} rows of the design {found['design']}{left}{waiting}"
    if found["note"]:
        yield found["note"]
    if found["mean"] is not None:
        deviation = found["standard_deviation"]
        yield f"mean {found['mean']:.6g}{unit}, standard deviation {deviation:.3g}{unit}"
    if (failure := found["failure"]) is not None:
        yield (
            f"{failure['failing']} {failure['limit']:g}{unit}: probability"
            f" {failure['probability']:.4g} ({failure['low']:.3g} to {failure['high']:.3g})"
        )
    if measures := found["measures"]:
        yield ""
        names = [name.replace("_", " ") for name in measures]
        head = ["parameter", *(f"{name} ({found['confidence']:.0%})" for name in names)]
        yield from aligned(
            [
                head,
                *(
                    [parameter, *(_cell(one, index) for one in measures.values())]
                    for index, parameter in enumerate(found["parameters"])
                ),
            ]
        )
    if (quantiles := found["quantiles"]) is not None:
        yield ""
        shares = [f"{share:.0%}" for share in quantiles["shares"]]
        cells = [_cell(quantiles, index) for index in range(len(shares))]
        yield from aligned([["quantile", found["output"] + unit], *zip(shares, cells, strict=True)])


def _cell(columns: dict[str, list[float | None]], index: int) -> str:
    """Return a number with its interval."""
    value, low, high = (columns[name][index] for name in ("values", "low", "high"))
    if value is None:
        return "unknown"
    if low is None and high is None:
        return f"{value:.5g}"
    below, above = ("..." if end is None else f"{end:.4g}" for end in (low, high))
    return f"{value:.5g} ({below} to {above})"
