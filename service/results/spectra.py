"""``/v1/jobs/{id}/spectrum``: power over frequency of a window of time, as its figure shows it."""

from typing import Annotated

from fastapi import APIRouter, Query, Response
from pydantic import Field

from jointplay.figures.kind import NotDrawable, Selection, at_most
from jointplay.figures.power_density import NOTHING, PowerDensity, aliased, power_density
from jointplay.figures.quantity import per_hertz
from jointplay.figures.time_history import MOST_PANELS, declared
from jointplay.records.channel import Channel, by_name
from jointplay.service.fields import in_unit
from jointplay.service.problems import RequestRefused, kinds, problems
from jointplay.service.results.queries import Selection as SelectionQuery
from jointplay.service.results.queries import chosen_channels
from jointplay.service.results.schemas import Described, Partial, Values
from jointplay.service.results.streaming import as_json
from jointplay.service.results.windows import ExactReaderOfThePath

router = APIRouter(
    prefix="/v1/jobs/{job_id}", tags=["results"], responses=problems(*kinds.OF_RESULTS)
)


class SpectralDensity(Described):
    """Power spectral density of one channel less its mean: its area is the variance."""

    frequency: Values = Field(
        description="Hz, above zero. Of more than 2000, those of the largest and the smallest power"
        " in each of 1000 columns of a logarithmic axis."
    )
    density: Values = Field(description="One-sided, by Welch's method with Hann windows.")
    band_limit: float = in_unit(
        "Hz", "Half of the instants a second: what is faster appears below it."
    )


class Spectrum(Partial):
    """Power spectral densities in a window of time."""

    spectra: dict[str, SpectralDensity]
    note: str = Field(description="What is to be known of these numbers; mostly empty.")


@router.get("/spectrum", response_model=Spectrum)
def show_spectrum(
    exact: ExactReaderOfThePath, query: Annotated[SelectionQuery, Query()]
) -> Response:
    """Return the power spectral density of channels in a window; default: the declared outputs.

    It is computed of instants 10 us apart, but of 1025 at least and 131 073 at most, where the run
    keeps its steps; else of its samples.
    """
    reader = exact.reader
    reader.trajectory = exact.trajectory
    names = chosen_channels(query.channels, reader.channels) if query.channels else []
    selection = Selection(tuple(names), (), *query.checked())
    try:
        chosen = at_most(MOST_PANELS, declared(reader, selection))
        found = {name: power_density(reader, name, selection) for name in chosen}
    except NotDrawable as error:
        cause = error.cause if error.cause == "start" else "channels"
        raise RequestRefused.of_parameter(cause, str(error)) from None
    described = by_name(reader.channels)
    shown = {name: _shown(described[name], one) for name, one in found.items()}
    nothing = [f"{name}: {NOTHING}." for name, one in found.items() if not len(one.frequency)]
    rough = aliased(reader, found)
    note = " ".join(filter(None, [rough, *nothing]))
    return as_json(Spectrum.model_construct(complete=reader.complete, spectra=shown, note=note))


def _shown(channel: Channel, found: PowerDensity) -> SpectralDensity:
    frequency, density = found.thinned() if len(found.frequency) else (found.frequency, found.power)
    shown = SpectralDensity.of(
        channel, frequency=frequency, density=density, band_limit=found.band_limit
    )
    return shown.model_copy(update={"unit": per_hertz(channel.unit)})
