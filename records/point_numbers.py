"""Numbers that every point has beside its sections and peaks: unit and long name."""

from jointplay.records.study import StudySource

STATISTICS = {
    "steps": ("1", "accepted steps"),
    "rejections": ("1", "rejected steps"),
    "rough_steps": (
        "1",
        "steps in which a channel strayed too far for all its extremes to be found",
    ),
    "onsets": ("1", "beginnings of contact"),
    "slow_impacts": ("1", "impacts slower than the smallest rate by which their law divides"),
    "smallest_step": ("s", "smallest accepted step"),
    "driver_work": ("J", "work of the drivers"),
    "contact_loss": ("J", "energy lost in normal contact"),
    "friction_loss": ("J", "energy lost in friction"),
    "gross_work": ("J", "all works, summed without their signs"),
    "energy_residual": ("J", "what the energy ledger lacks"),
    "settled_periods": ("1", "periods left out before the first recorded section"),
    "settling": ("1", "how settling ended, a position in the attribute settlings"),
    "from_neighbour": ("1", "1 if it started from its neighbour's last state, else 0"),
    "attractors": ("1", "different attractors that its starts end on"),
    "inherited": ("1", "1 if it has the results of another point of its cell, else 0"),
}
INDICATORS = {
    "lyapunov": ("1/s", "largest Lyapunov exponent"),
    "lyapunov_error": ("1/s", "standard error of the largest Lyapunov exponent"),
    "zero_one": ("1", "growth rate of the 0-1 test"),
    "zero_one_error": ("1", "standard error of the growth rate of the 0-1 test"),
    "period": ("1", "sections after which the motion recurs; 0: none"),
    "rotation": ("1", "rotation number: turns about the closed curve per section"),
    "rotation_error": ("1", "standard error of the rotation number"),
    "line_frequency": ("Hz", "frequency of the strongest line of the section's spectrum"),
    "line_share": ("1", "share of the power in that line, 0 to 1"),
    "flatness": ("1", "flatness of the spectrum: 0 lines, 1 white noise"),
    "verdict": ("1", "a position in the attribute verdicts"),
}
OUTPUTS = STATISTICS | INDICATORS


def meanings_of(source: StudySource) -> dict[str, tuple[str, str]]:
    """Return unit and long name of the statistics and indicators of a study, by name.

    Those of every study come first, then those of its kind, and those that the job chose.
    """
    return {**OUTPUTS, **source.attributes.get("meanings", {})}
