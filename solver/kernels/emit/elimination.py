"""Linear equations of a step, solved by Gaussian elimination: a system a lane, without pivoting.

Blocks of work arrays hold vectors and the matrix, row after row. These are loops, not straight
lines: there are n^3 / 3 products.
"""

from itertools import count

from jointplay.solver.kernels.emit.lane_arithmetic import Builder, same

VECTORS = ("direction", "product", "drift", "right", "pivot")
"""Blocks of a number a state. In front of them is the direction's part of time, behind them the
matrix ``factor``."""


def factorise(
    build: Builder, product: str, states: str, gamma: str, tried: str, first: str
) -> None:
    """Write what leaves the factors of I - h γ J, inverse pivots and the drift, J's part of time.

    `product` : a function that multiplies J with the direction; `states` : how many, n; `tried` :
    the slot of h; `first` : that of the direction's part of time.
    """
    slots = _Slots(build, states, first)
    one, none = same(1.0), same(0.0)
    with build.loop("0", states) as i:
        slots.store(none, "direction", i)
    slots.store(one, "time")
    build.lines.append(f"call void {product}(ptr %W)")
    with build.loop("0", states) as i:
        slots.store(slots.load("product", i), "drift", i)
    slots.store(none, "time")
    with build.loop("0", states) as j:
        slots.store(one, "direction", j)
        build.lines.append(f"call void {product}(ptr %W)")
        with build.loop("0", states) as i:
            slope = build.arithmetic("fmul", same(float(gamma)), slots.load("product", i))
            slope = build.arithmetic("fmul", slope, slots.load(tried))
            diagonal = build.new(f"icmp eq i64 {i}, {j}")
            numbers = build.numbers_type
            unit = build.new(f"select i1 {diagonal}, {numbers} {one}, {numbers} {none}")
            rest = build.arithmetic("fsub", unit, slope)
            slots.store(rest, "factor", slots.entry(i), j)
        slots.store(none, "direction", j)
    with build.loop("0", states) as k:
        top = slots.entry(k)
        slots.store(build.arithmetic("fdiv", one, slots.load("factor", top, k)), "pivot", k)
        below = build.new(f"add i64 {k}, 1")
        with build.loop(below, states) as i:
            row = slots.entry(i)
            share = slots.load("factor", row, k)
            share = build.arithmetic("fmul", share, slots.load("pivot", k))
            slots.store(share, "factor", row, k)
            with build.loop(below, states) as j:
                less = build.arithmetic("fmul", share, slots.load("factor", top, j))
                rest = build.arithmetic("fsub", slots.load("factor", row, j), less)
                slots.store(rest, "factor", row, j)


def substitute(build: Builder, states: str, first: str) -> None:
    """Write what solves the factorised equations, in place of their right side."""
    slots = _Slots(build, states, first)
    last = str(int(states) - 1)
    with build.loop("0", states) as i, build.loop("0", i) as k:
        slots.reduce(i, k)
    with build.loop("0", states) as done:
        i = build.new(f"sub i64 {last}, {done}")
        with build.loop(build.new(f"add i64 {i}, 1"), states) as k:
            slots.reduce(i, k)
        scaled = build.arithmetic("fmul", slots.load("right", i), slots.load("pivot", i))
        slots.store(scaled, "right", i)


class _Slots:
    """Numbers of all lanes, at a slot or the first one of a block, and what is added to it."""

    def __init__(self, build: Builder, states: str, first: str) -> None:
        self.build, self.states = build, states
        blocks = count(int(first) + 1, int(states))
        self._firsts = dict(zip((*VECTORS, "factor"), map(str, blocks), strict=False))
        self._firsts["time"] = first

    def load(self, *parts: str) -> str:
        return self.build.load(self._at(*parts))

    def store(self, value: str, *parts: str) -> None:
        self.build.store(value, self._at(*parts))

    def entry(self, row: str) -> str:
        return self.build.new(f"mul i64 {row}, {self.states}")

    def reduce(self, i: str, k: str) -> None:
        """Subtract a product of a factor and the right side from the right side."""
        share = self.load("factor", self.entry(i), k)
        less = self.build.arithmetic("fmul", share, self.load("right", k))
        rest = self.build.arithmetic("fsub", self.load("right", i), less)
        self.store(rest, "right", i)

    def _at(self, name: str, *others: str) -> str:
        slot = self._firsts.get(name, name)
        for other in others:
            slot = self.build.new(f"add i64 {slot}, {other}")
        return self.build.new(f"getelementptr {self.build.numbers_type}, ptr %W, i64 {slot}")
