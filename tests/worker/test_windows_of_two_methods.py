"""Windows of a run that changed its method: each stretch is made again by its own."""

import numpy as np

from jointplay.solver.kinds import admit
from jointplay.solver.kinds.simulate import Admission
from jointplay.solver.runs.dense_output.columns import methods
from jointplay.solver.runs.simulate import Simulation
from jointplay.worker.windows.evaluate import answer
from jointplay.worker.windows.question import Question
from tests.solver.held_part import held_part


def test_values_extremes_and_works_on_both_sides_of_the_change() -> None:
    document = {"kind": "simulate", "scene": held_part(), "duration": 0.4, "certificate": False}
    admission = admit(document | {"output_step": 1e-3, "steps_limit": 10**8})
    assert isinstance(admission, Admission)
    simulation = Simulation(admission)
    pieces = list(simulation.slices())
    steps = np.concatenate([piece.steps for piece in pieces])
    assert len(np.unique(steps[:, -1])) == 2
    samples = np.concatenate([piece.samples for piece in pieces])
    times = np.concatenate([piece.sample_time for piece in pieces])
    names = tuple(channel.name for channel in admission.channels)
    job, known = admission.job, tuple(methods())

    values = answer(Question(job, names, steps, times=times, methods=known)).values
    assert values is not None
    assert np.all(np.abs(values - samples) <= 1e-15 * np.ptp(samples, axis=0) + 1e-18)
    late = answer(Question(job, names, steps, times=times[-3:], methods=known)).values
    assert np.array_equal(late, values[-3:])

    edges = np.linspace(0.0, 0.4, 5)
    extremes = answer(Question(job, names, steps, edges=edges, methods=known)).values
    assert extremes is not None
    assert not np.isnan(extremes).any()
    peaks = simulation.summary().peaks
    for i, name in enumerate(names):
        tiny = 1e-6 * (peaks[name].maximum - peaks[name].minimum) + 1e-30
        np.testing.assert_allclose(extremes[:, i, 0].min(), peaks[name].minimum, atol=tiny)
        np.testing.assert_allclose(extremes[:, i, 2].max(), peaks[name].maximum, atol=tiny)

    works = answer(Question(job, names, steps, methods=known)).values
    assert works is not None
    energy = simulation.summary().statistics["energy"]
    np.testing.assert_allclose(works[:, 2].sum(), energy["friction_loss"], rtol=1e-9)
