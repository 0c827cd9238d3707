"""What the driving loop keeps for each lane beside the work array."""

from enum import IntEnum


class Status(IntEnum):
    """How a lane stands."""

    RUNNING = 0
    DONE = 1
    UNDERFLOW = 2
    STEP_LIMIT = 3
    ONSET_LOST = 4
    IDLE = 5


class SectionKind(IntEnum):
    """What makes a Poincare section."""

    CRANK = 0
    ONSET = 1
    CROSSING = 2


class Counter(IntEnum):
    """Rows of the whole-number array (kinds, LANES)."""

    STATUS = 0
    PERIOD = 1
    SAMPLE = 2
    SAMPLES = 3
    SECTION = 4
    SECTIONS = 5
    REJECTIONS = 6
    ONSETS = 7
    LANDING = 8
    LANDINGS = 9
    SAMPLE_ROWS = 10
    SECTION_ROWS = 11
    IMPACT_ROWS = 12
    GROWTH_ROWS = 13
    COUNT = 14


class Setting(IntEnum):
    """Rows of the float array (kinds, LANES); from FIRST_DRIVER two rows a driver."""

    PERIOD = 0
    COMMON = 1
    TURNING = 2
    DURATION = 3
    OUTPUT_STEP = 4
    SECTION_OFFSET = 5
    SMALLEST_STEP = 6
    SAMPLE_DUE = 7
    SECTION_DUE = 8
    SECTION_KIND = 9
    SECTION_PLACE = 10
    SECTION_VALUE = 11
    SECTION_SENSE = 12
    SECTION_FROM = 13
    PACE_TIME = 14
    FIRST_DRIVER = 15


def row_width(drivers: int, states: int, joints: int) -> int:
    """Width of a row: period, time, phases, turns, state, then mode and impact rate of joints."""
    return 2 + 2 * drivers + states + 2 * joints
