"""Random linkages that a crank drives, with their closed form: intersections of circles."""

import cmath
import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.optimize import brentq, minimize_scalar

Point = complex
SCANNED = 3000
TURN = 2.0 * math.pi


@dataclass
class Dyad:
    """Two links, `first` from the point `base` to their common pin, `second` to the ground."""

    name: str
    base: str
    ground: Point
    first: float
    second: float
    side: float
    """Sign of the cross product from the base to the ground and to the pin."""
    coupler: complex = 0j
    """A further point of the first link, as its complex factor of base to pin."""

    def spare(self, base: Point) -> float:
        """Return by how much the links reach, m; below zero they do not."""
        apart = abs(self.ground - base)
        return min(self.first + self.second - apart, apart - abs(self.first - self.second))

    def pin(self, base: Point) -> Point:
        """Return where the circles about both ends meet."""
        apart = abs(self.ground - base)
        along = (apart**2 + self.first**2 - self.second**2) / (2.0 * apart)
        # the product of factors is exact where the circles touch, the difference of squares is not
        sums = (self.first + self.second + apart) * (self.first + self.second - apart)
        sums *= (apart + self.first - self.second) * (apart - self.first + self.second)
        across = math.sqrt(max(sums, 0.0)) / (2.0 * apart)
        return base + (self.ground - base) / apart * complex(along, self.side * across)


@dataclass
class Linkage:
    """A crank of `length` about `ground`, from an angle on at 1 rad/s either way, and dyads."""

    length: float
    angle: float
    sense: float
    dyads: list[Dyad] = field(default_factory=list)

    def positions(self, time: float) -> dict[str, Point]:
        """Return the points at a time: B of the crank, the pin and E of each dyad."""
        found = {"B": cmath.rect(self.length, self.angle + self.sense * time)}
        for dyad in self.dyads:
            base = found[dyad.base]
            pin = dyad.pin(base)
            found[f"{dyad.name}P"] = pin
            found[f"{dyad.name}E"] = base + dyad.coupler * (pin - base)
        return found

    def spare(self, time: float) -> float:
        """Return the smallest spare of the dyads up to the first that does not reach."""
        found = {"B": cmath.rect(self.length, self.angle + self.sense * time)}
        least = math.inf
        for dyad in self.dyads:
            base = found[dyad.base]
            least = min(least, dyad.spare(base))
            if least < 0.0:
                return least
            pin = dyad.pin(base)
            found[f"{dyad.name}E"] = base + dyad.coupler * (pin - base)
        return least

    def dead_point(self) -> tuple[float, float]:
        """Return when it jams within a turn (infinite: it does not), and the least spare before."""
        times = np.linspace(0.0, TURN, SCANNED).tolist()
        spares = [self.spare(t) for t in times]
        least = math.inf
        for k in range(1, len(times)):
            before, here = spares[k - 1], spares[k]
            end = times[k]
            if here > 0.0 and k + 1 < len(times) and here <= before and here <= spares[k + 1]:
                bounds = (times[k - 1], times[k + 1])
                options = {"xatol": 1e-13}
                near = minimize_scalar(self.spare, bounds=bounds, method="bounded", options=options)
                end, here = (near.x, near.fun) if near.fun < here else (end, here)
            least = min(least, here)
            if here <= 0.0:
                return float(brentq(self.spare, times[k - 1], end, xtol=1e-14)), least
        return math.inf, least

    def document(self) -> dict[str, Any]:
        """Return the scene, put together as it stands at the start."""
        at = self.positions(0.0)
        ground: dict[str, Point] = {"A": 0j}
        bodies, joints = {}, {}

        def body(name: str, **points: Point) -> None:
            centre = sum(points.values()) / len(points)
            local = {n: [(p - centre).real, (p - centre).imag] for n, p in points.items()}
            bodies[name] = {"mass": 1.0, "inertia": 1.0, "points": local}

        def pinned(name: str, bearing: str, journal: str) -> None:
            joints[name] = {"type": "revolute", "bearing": bearing, "journal": journal}

        turned = cmath.rect(1.0, -self.angle)
        body("crank", A=0j, B=at["B"] * turned)
        pinned("A", "ground.A", "crank.A")
        holding = {"B": "crank.B"}
        for dyad in self.dyads:
            base, pin, name = at[dyad.base], at[f"{dyad.name}P"], dyad.name
            points = {"base": base, "pin": pin}
            if dyad.coupler:
                points["E"] = at[f"{name}E"]
            body(f"{name}1", **points)
            body(f"{name}2", pin=pin, ground=dyad.ground)
            ground[name] = dyad.ground
            pinned(f"{name}B", holding[dyad.base], f"{name}1.base")
            pinned(f"{name}C", f"{name}1.pin", f"{name}2.pin")
            pinned(f"{name}D", f"ground.{name}", f"{name}2.ground")
            holding[f"{name}E"] = f"{name}1.E"
        driver = {"joint": "A", "position": self.angle, "speed": self.sense}
        return {
            "name": "linkage",
            "ground": {"points": {n: [p.real, p.imag] for n, p in ground.items()}},
            "bodies": bodies,
            "joints": joints,
            "drivers": {"motor": driver},
            "recorded": [f"{d.name}1.pin" for d in self.dyads],
        }


def drawn(random: np.random.Generator, kind: str) -> Linkage:
    """Return a random linkage that is not at a dead point, of one of `KINDS`."""
    while True:
        found = _tried(random, kind)
        if found.spare(0.0) > 1e-3:
            return found


KINDS = ("any", "near a change point", "opposed", "six-bar")


def _tried(random: np.random.Generator, kind: str) -> Linkage:
    crank, coupler, rocker, ground = random.uniform(0.2, 1.0, 4)
    if kind != "any":
        crank = min(crank, 0.8 * min(coupler, rocker))
    if kind in ("near a change point", "opposed"):
        # the sums of the shortest and the longest link and of the others are all but equal
        near = 10.0 ** random.uniform(-4.0, -1.5) * random.choice([-1.0, 1.0])
        ground = abs(coupler - rocker) + crank * (1.0 + near)
        if random.random() < 0.5:
            ground = coupler + rocker - crank * (1.0 + near)
    found = Linkage(crank, random.uniform(-math.pi, math.pi), random.choice([-1.0, 1.0]))
    direction = cmath.rect(1.0, random.uniform(-math.pi, math.pi))
    side = random.choice([-1.0, 1.0])
    factor = complex(*random.uniform(-1.0, 1.5, 2))
    found.dyads.append(Dyad("a", "B", ground * direction, coupler, rocker, side, factor))
    if kind == "opposed":
        turned = direction * random.choice([1.0, -1.0])
        scaled = 1.0 + random.choice([0.0, 1e-3])
        found.dyads.append(Dyad("b", "B", ground * turned, coupler * scaled, rocker, side))
    if kind == "six-bar":
        position = complex(*random.uniform(-1.5, 1.5, 2))
        one, two = random.uniform(0.3, 1.5, 2)
        found.dyads.append(Dyad("b", "aE", position, one, two, random.choice([-1.0, 1.0])))
    return found
