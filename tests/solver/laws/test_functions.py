"""Functions of one argument: derivatives, bounds, periods, tables against SciPy, traced ones."""

import math
import re
from typing import Any, ClassVar

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline, PchipInterpolator

from jointplay.solver.kernels.trace.derivative import Derivative
from jointplay.solver.kernels.trace.tracer import Tracer
from jointplay.solver.laws.function import FUNCTIONS, Function
from jointplay.solver.laws.function.constant import Constant
from jointplay.solver.laws.function.piecewise_polynomial import PiecewisePolynomial
from jointplay.solver.laws.function.polynomial import Polynomial
from jointplay.solver.laws.function.ramp import Ramp
from jointplay.solver.laws.function.sinusoidal import Sinusoidal
from jointplay.solver.laws.function.start_up import StartUp
from jointplay.solver.laws.function.table import Table
from tests.solver.kernels.test_tracer import evaluate

some = settings(
    max_examples=40, suppress_health_check=[HealthCheck.differing_executors], database=None
)
numbers = st.floats(-3.0, 3.0).map(lambda x: round(x, 3))
lengths = st.floats(0.1, 3.0).map(lambda x: round(x, 3))
arguments = st.floats(0.0, 8.0)
UNTIL = 8.0


class FunctionSpecification:
    """Subclass it with the model and a strategy that draws functions of it."""

    model: ClassVar[type[Function]]
    functions: ClassVar[st.SearchStrategy[Function]]

    def bends_at(self, _function: Function, _x: float) -> bool:
        """Whether the curvature may jump at an argument: there either side's is right."""
        return False

    def test_it_says_what_it_is(self) -> None:
        assert re.match(r"f(\(x\) =|' =| through) ", self.model.__doc__ or "")

    @some
    @given(data=st.data(), x=arguments)
    def test_slope_and_curvature_are_its_derivatives(self, data: st.DataObject, x: float) -> None:
        """A traced derivative is exact, and follows the branch that is in force."""
        function = data.draw(self.functions)
        assume(not self.bends_at(function, x))
        tracer = Tracer()
        variable = tracer.variable("x")
        found = [tracer.lift(part) for part in function.at(variable)]
        derivative = Derivative({"x": tracer.constant(1.0)})
        given_x = {"x": x}
        here = function.at(x)
        exact = [evaluate(derivative(part), given_x, {}) for part in found[:2]]
        bounds = [1.0, *function.largest(UNTIL), 0.0, 0.0]
        # rounding, as a share of the function's own derivatives; a table divides by its widths
        np.testing.assert_allclose(exact[0], here.slope, rtol=1e-9, atol=1e-9 * bounds[1])
        np.testing.assert_allclose(exact[1], here.curvature, rtol=1e-9, atol=1e-8 * bounds[2])
        for part, value in zip(found, here, strict=True):
            assert evaluate(part, given_x, {}) == pytest.approx(value, rel=1e-12, abs=1e-12)

    @some
    @given(data=st.data())
    def test_its_derivatives_keep_their_bounds(self, data: st.DataObject) -> None:
        function = data.draw(self.functions)
        x = np.linspace(0.0, UNTIL, 801)
        found = [np.broadcast_to(part, x.shape) for part in function.at(x)]
        bounds = [*function.largest(UNTIL), 0.0, 0.0]
        for part, bound in zip(found[1:], bounds, strict=False):
            assert np.abs(part).max() <= bound * (1.0 + 1e-9) + 1e-12
        # no step of value or slope: neighbours differ by what the next derivative allows
        spacing = x[1] - x[0]
        for k, part in enumerate(found[:2]):
            if k == 0 or function.has_curvature:
                least = 1e-12 * (1.0 + np.abs(part).max())
                assert np.abs(np.diff(part)).max() <= bounds[k] * spacing * (1 + 1e-9) + least

    @some
    @given(data=st.data(), x=arguments)
    def test_it_repeats_after_its_period(self, data: st.DataObject, x: float) -> None:
        function = data.draw(self.functions)
        period = function.period
        size = 1.0 + sum(function.largest(UNTIL))
        if period == 0.0:
            np.testing.assert_allclose(function.at(x + 1.7), function.at(x), atol=1e-12 * size)
        elif math.isfinite(period):
            here, later = function.at(x), function.at(x + 3.0 * period)
            # an argument that is rounded moves a value by its slope, and a slope's by more
            np.testing.assert_allclose(later[:2], here[:2], rtol=0, atol=1e-12 * size)

    @some
    @given(data=st.data())
    def test_it_gives_arrays_what_it_gives_numbers(self, data: st.DataObject) -> None:
        function = data.draw(self.functions)
        x = np.array([-0.5, 0.0, 0.3, 1.0, 2.2, 7.0])
        together = np.stack([np.broadcast_to(part, x.shape) for part in function.at(x)], axis=1)
        # NumPy's sine may differ from the C library's in the last place
        alone = [function.at(float(each)) for each in x]
        np.testing.assert_allclose(together, alone, rtol=1e-13, atol=1e-12)


def drawn(model: type[Function], **fields: st.SearchStrategy[Any]) -> st.SearchStrategy[Function]:
    name = next(name for name, known in FUNCTIONS.items() if known is model)
    return st.builds(model, type=st.just(name), **fields)


class TestConstant(FunctionSpecification):
    model = Constant
    functions = drawn(Constant, value=numbers)


class TestPolynomial(FunctionSpecification):
    model = Polynomial
    functions = drawn(Polynomial, coefficients=st.lists(numbers, min_size=1, max_size=5))


class TestSinusoidal(FunctionSpecification):
    model = Sinusoidal
    functions = drawn(
        Sinusoidal, amplitude=numbers, frequency=lengths, phase=numbers, offset=numbers
    )


class TestRamp(FunctionSpecification):
    model = Ramp
    functions = drawn(Ramp, start=numbers, end=numbers, length=lengths)


class TestStartUp(FunctionSpecification):
    model = StartUp
    functions = drawn(StartUp, start_speed=numbers, speed=numbers, length=lengths)


@st.composite
def tables(draw: st.DrawFn) -> Function:
    widths = draw(st.lists(lengths, min_size=1, max_size=6))
    knots = np.cumsum([draw(numbers), *widths]).tolist()
    values = [draw(numbers) for _ in knots]
    outside = draw(st.sampled_from(["held", "periodic"]))
    if outside == "periodic":
        values[-1] = values[0]
    between = draw(st.sampled_from(["smooth", "monotone"]))
    return Table(type="table", knots=knots, values=values, between=between, outside=outside)


class TestTable(FunctionSpecification):
    model = Table
    functions = tables()

    def bends_at(self, function: Function, x: float) -> bool:
        assert isinstance(function, Table | PiecewisePolynomial)
        knots = np.array(function.knots)
        span = knots[-1] - knots[0] if function.outside == "periodic" else np.inf
        away = np.abs(x - knots) % span
        return bool(np.any((away < 1e-9) | (away > span - 1e-9)))


@st.composite
def pieces(draw: st.DrawFn) -> Function:
    """Draw lines between values, or a cubic spline that is flat at its ends or repeats."""
    table = draw(tables())
    assert isinstance(table, Table)
    outside, knots, values = table.outside, table.knots, table.values
    if table.between == "smooth":
        spline = CubicSpline(
            knots, values, bc_type="periodic" if outside == "periodic" else "clamped"
        )
        coefficients = spline.c[::-1].T.tolist()
    else:
        rises = np.diff(values) / np.diff(knots)
        coefficients = [list(pair) for pair in zip(values, rises.tolist(), strict=False)]
    fields = {"knots": knots, "coefficients": coefficients, "outside": outside}
    return PiecewisePolynomial.model_validate({"type": "piecewise-polynomial", **fields})


class TestPiecewisePolynomial(FunctionSpecification):
    model = PiecewisePolynomial
    functions = pieces()
    bends_at = TestTable.bends_at

    @some
    @given(table=tables(), x=arguments)
    def test_it_is_the_spline_whose_coefficients_it_has(self, table: Table, x: float) -> None:
        assume(table.between == "smooth" and not self.bends_at(table, x))
        found = table._cubics.pieces()
        fields = {"knots": table.knots, "coefficients": [list(piece[1:]) for piece in found]}
        kind = {"type": "piecewise-polynomial", "outside": table.outside}
        function = PiecewisePolynomial.model_validate(kind | fields)
        assert not any(rule.broken(function) for rule in function.rules)
        assert function.has_curvature
        np.testing.assert_allclose(function.at(x), table.at(x), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"coefficients": [[0.0]]}, "1 polynomials for 3 knots; give 2"),
        ({"coefficients": [[0.0, 1.0], [0.5]]}, "jumps at a knot, by 0.5 of its largest"),
        ({"outside": "periodic"}, "the last end where the first begins"),
    ],
)
def test_pieces_that_do_not_meet_are_refused(changes: dict[str, Any], words: str) -> None:
    fields = {"knots": [0.0, 1.0, 2.0], "coefficients": [[0.0, 1.0], [1.0]], "outside": "held"}
    kind = {"type": "piecewise-polynomial"}
    function = PiecewisePolynomial.model_validate(kind | fields | changes)
    (broken,) = [rule for rule in function.rules if rule.broken(function)]
    assert broken.field == "coefficients"
    assert words in broken.sentence(function)


def test_slopes_that_jump_drive_nothing() -> None:
    fields = {"knots": [0.0, 1.0, 2.0], "coefficients": [[0.0, 1.0], [1.0]], "outside": "refused"}
    kind = {"type": "piecewise-polynomial"}
    assert not PiecewisePolynomial.model_validate(kind | fields).has_curvature
    smooth = {"coefficients": [[0.0, 0.0, 1.0], [1.0, 2.0]]}
    assert PiecewisePolynomial.model_validate(kind | fields | smooth).has_curvature


@pytest.mark.parametrize("model", ["table", "piecewise-polynomial"])
def test_a_refused_argument_is_not_a_number(model: str) -> None:
    own = {"table": {"values": [0.0, 1.0]}, "piecewise-polynomial": {"coefficients": [[0.0, 1.0]]}}
    document = {"type": model, "knots": [0.0, 2.0], "outside": "refused"} | own[model]
    function = FUNCTIONS[model].model_validate(document)
    assert function.domain == (0.0, 2.0)
    assert math.isfinite(function.at(2.0 + 1e-10).value)
    assert math.isnan(function.at(2.0 + 1e-8).value)
    tracer = Tracer()
    traced = tracer.lift(function.at(tracer.variable("x")).value)
    assert math.isnan(evaluate(traced, {"x": -1.0}, {}))
    assert evaluate(traced, {"x": 1.0}, {}) == pytest.approx(function.at(1.0).value)


def test_every_function_in_the_registry_is_specified() -> None:
    specified = {each.model for each in FunctionSpecification.__subclasses__()}
    assert specified == set(FUNCTIONS.values())


@some
@given(table=tables())
def test_a_table_is_the_interpolant_of_scipy(table: Table) -> None:
    x = np.linspace(table.knots[0], table.knots[-1], 50)
    if table.between == "smooth":
        end = "periodic" if table.outside == "periodic" else "clamped"
        spline = CubicSpline(table.knots, table.values, bc_type=end)
        expected, tight = spline(x), 1e-10
    else:  # whose slopes at the ends are others: the inner pieces are the same
        if len(table.knots) < 4:
            return
        x = np.linspace(table.knots[1], table.knots[-2], 50)
        expected, tight = PchipInterpolator(table.knots, table.values)(x), 1e-10
    # widths of 0.1 to 3: conditions of a few hundred
    np.testing.assert_allclose(table.at(x).value, expected, rtol=0, atol=tight)


@some
@given(table=tables().filter(lambda table: table.between == "monotone"))
def test_a_monotone_table_stays_between_neighbouring_values(table: Table) -> None:
    for k in range(len(table.knots) - 1):
        inside = table.at(np.linspace(table.knots[k], table.knots[k + 1], 20)[:-1]).value
        low, high = sorted(table.values[k : k + 2])
        assert np.all(inside >= low - 1e-12)
        assert np.all(inside <= high + 1e-12)


def test_a_start_up_ends_at_its_speed_and_half_its_ramp_behind() -> None:
    function = StartUp(type="start-up", speed=6.0, length=0.5)
    # a symmetric ramp covers half of what full speed would have
    assert function.at(2.0) == pytest.approx((6.0 * (2.0 - 0.25), 6.0, 0.0), rel=1e-13, abs=1e-12)


@pytest.mark.parametrize(
    ("changes", "field", "words"),
    [
        ({"knots": [0.0, 2.0, 1.0]}, "knots", "Knot 2 is 1, not above 2"),
        ({"knots": [0.0, 1e-6, 1.0]}, "knots", "1e+06 times"),
        ({"values": [0.0, 1.0]}, "values", "2 values for 3 knots"),
        ({"outside": "periodic"}, "values", "first value is 0, its last 0.5"),
    ],
)
def test_a_table_that_cannot_be_followed_says_why(
    changes: dict[str, Any], field: str, words: str
) -> None:
    fields = {"knots": [0.0, 1.0, 2.0], "values": [0.0, 1.0, 0.5], "outside": "held"}
    table = Table.model_validate({"type": "table", **fields, **changes})
    (broken,) = [rule for rule in table.rules if rule.broken(table)]
    assert broken.field == field
    assert words in broken.sentence(table)
