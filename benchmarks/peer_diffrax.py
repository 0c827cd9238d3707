"""diffrax on eight presses at once: the traced equations as a JAX function, vmapped.

Optional: `pip install diffrax jax`. A leg ends at an onset or release, which diffrax locates; all
legs of a lane are one loop, so that the eight lanes are advanced together, on the CPU.
"""

import time
from collections.abc import Callable
from typing import Any

import numpy as np

from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.trace.reachable import reachable
from jointplay.solver.kernels.trace.tracer import Expression
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem

LONGEST_STEP, FIRST_STEP = 1e-3, 1e-7
"""s, as other peers have."""
ROOT = 1e-13
"""Tolerance of the located onsets, m."""


def operations() -> dict[str, Callable[..., Any]]:
    """Return what the tracer's operations are in JAX."""
    import jax.numpy as jnp

    return {
        "add": jnp.add,
        "sub": jnp.subtract,
        "mul": jnp.multiply,
        "div": jnp.divide,
        "neg": jnp.negative,
        "abs": jnp.abs,
        "sqrt": jnp.sqrt,
        "floor": jnp.floor,
        "quarter_turns": lambda n, s, c: jnp.choose(
            jnp.mod(n, 4.0).astype(int), [s, c, -s, -c], mode="clip"
        ),
        "select": lambda x, a, b: jnp.where(x > 0.0, a, b),
    }


def equations_of(kernel: Kernel) -> Callable[..., tuple[Any, Any, Any]]:
    """Return (time, state, modes, impact rates, numbers) -> slopes, penetrations, their rates."""
    import jax.numpy as jnp

    equations, known = kernel.equations, operations()
    penetrations = [one for pair in equations.penetrations for one in pair]
    ordered = reachable([*equations.accelerations, *penetrations])
    fixed = {slot: index for index, slot in enumerate(kernel.fixed.slots)}

    def slope(t: Any, y: Any, mode: Any, rate: Any, numbers: Any) -> tuple[Any, Any, Any]:
        values: dict[int, Any] = {}
        given = {"stage": y, "mode": mode, "impact_rate": rate, "phase": numbers[len(fixed) :]}

        def value(node: Expression) -> Any:
            return node.value if node.operation == "constant" else values[node.index]

        for node in ordered:
            if node.operation == "constant":
                continue
            if node.fixed:
                values[node.index] = numbers[fixed[kernel.layout[f"fixed{node.index}"]]]
            elif node.data == "stage_time":
                values[node.index] = t
            elif node.operation == "variable":
                name = str(node.data).rstrip("0123456789")
                values[node.index] = given[name][int(str(node.data)[len(name) :])]
            else:
                arguments = [value(argument) for argument in node.arguments]
                values[node.index] = known[node.operation](*arguments)
        accelerations = jnp.stack([value(node) for node in equations.accelerations])
        found = jnp.stack([value(node) for node in penetrations])
        return jnp.concatenate([y[len(accelerations) :], accelerations]), found[::2], found[1::2]

    return slope


def solver_of(kernel: Kernel, tolerance: float) -> Callable[..., tuple[Any, Any]]:
    """Return the compiled (states, numbers, floors, end) -> states at the end, steps; by lanes."""
    import diffrax
    import jax
    import jax.numpy as jnp
    import optimistix

    slope, joints = equations_of(kernel), len(kernel.pairs)
    controller = diffrax.PIDController(rtol=tolerance, atol=1e-3 * tolerance, dtmax=LONGEST_STEP)
    term = diffrax.ODETerm(lambda t, y, args: slope(t, y, *args)[0])

    def passes(j: int) -> Callable[..., Any]:
        def penetration(t: Any, y: Any, args: Any, **_: Any) -> Any:
            found = slope(t, y, *args)[1][j]
            return jnp.where(args[0][j] > 0.0, -found, found)

        return penetration

    events = diffrax.Event(
        [passes(j) for j in range(joints)],
        root_finder=optimistix.Newton(rtol=0.0, atol=ROOT),
        direction=[True] * joints,
    )

    def lane(start: Any, numbers: Any, floor: Any, end: Any) -> tuple[Any, Any]:
        def leg(carry: Any) -> Any:
            t, y, mode, rate, steps = carry
            found = diffrax.diffeqsolve(
                term,
                diffrax.Tsit5(),
                t,
                end,
                FIRST_STEP,
                y,
                args=(mode, rate, numbers),
                saveat=diffrax.SaveAt(t1=True),
                stepsize_controller=controller,
                event=events,
                max_steps=None,
                adjoint=diffrax.DirectAdjoint(),
                throw=False,
            )
            now, state = found.ts[0], found.ys[0]
            fired = jnp.stack(found.event_mask) & (now < end)
            penetration_rate = slope(now, state, mode, rate, numbers)[2]
            latched = jnp.where(fired & (mode == 0.0), jnp.maximum(penetration_rate, floor), rate)
            changed = jnp.where(fired, 1.0 - mode, mode)
            return now, state, changed, latched, steps + found.stats["num_steps"]

        begun = (jnp.zeros(()), start, jnp.zeros(joints), floor, jnp.zeros((), int))
        reached = jax.lax.while_loop(lambda carry: carry[0] < end, leg, begun)
        return reached[1], reached[4]

    lanes: Callable[..., tuple[Any, Any]] = jax.jit(jax.vmap(lane, in_axes=(0, 0, 0, None)))
    return lanes


def measure_diffrax(
    kernel: Kernel, problems: list[LaneProblem], check_time: float, end: float
) -> tuple[float, float, np.ndarray] | None:
    """Measure Tsit5 on problems of one tolerance; None where diffrax is not installed.

    Returns
    -------
    Processor seconds to `end` and evaluations, both a lane, and the states (lanes, states) at
    `check_time`.
    """
    try:
        import diffrax  # noqa: F401
        import jax
    except ImportError:
        return None
    jax.config.update("jax_enable_x64", True)
    bundle = Bundle(kernel, problems, watch=False)
    count = len(problems)
    start = bundle.block("y").T[:count]
    floor = bundle.block("impact_floor").T[:count]
    fixed = np.array([kernel.fixed.values(each.scene) for each in problems])
    numbers = np.concatenate([fixed, bundle.block("phase").T[:count]], axis=1)
    run = solver_of(kernel, problems[0].tolerance)
    at_check = np.asarray(run(start, numbers, floor, check_time)[0])  # compiles, too
    begun = time.process_time()
    _, steps = jax.block_until_ready(run(start, numbers, floor, end))
    seconds = (time.process_time() - begun) / count
    return seconds, 6.0 * float(np.mean(steps)), at_check
