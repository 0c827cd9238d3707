"""The section map next to an orbit by simulations, each a job of its own, and its derivative.

Loops of ideal joints are simulated by the other formulation: its coordinates are positions and
angles of bodies, and loops are held by multipliers as joints of a tree are. States that loops do
not allow are brought back to those that they do, in another way than the map of the product does,
which changes no multiplier but zero.
"""

import json
from dataclasses import dataclass
from typing import Any

import numpy as np

from jointplay.local import run
from jointplay.records.arrays import Floats
from jointplay.solver.continuation.plan import ContinuationStudy
from jointplay.solver.mechanics.tree import Tree, spanning_tree
from jointplay.solver.runs.starts import start_scales
from jointplay.solver.scene.document import Scene

TOLERANCE, METHOD = 1e-12, "dormand-prince-853"
CHANNELS = {"theta": ("theta", "omega"), "s": ("x", "vx"), "x": ("x", "vx"), "y": ("y", "vy")}
"""Channels of a coordinate and its rate; slides of all mechanisms here are along x."""
SMALL = 0.3
"""Extent of a state at least, in the largest of all."""


@dataclass(frozen=True, eq=False)
class SimulatedMap:
    """The map at an orbit: its section, the mechanism at its parameter, and how it is simulated."""

    scene: Scene
    names: tuple[str, ...]
    """Columns of the states, then of the latched impact rates."""
    section: Floats
    duration: float
    """s."""

    @classmethod
    def of(cls, study: ContinuationStudy, columns: dict[str, Floats]) -> "SimulatedMap":
        """Return the map at the first orbit of a branch."""
        names = [name for name in columns if name.startswith(("state.", "rate."))]
        names += [name for name in columns if name.startswith("impact_rate.")]
        section = np.array([columns[name][0] for name in names])
        return cls(study.point_scene(0), tuple(names), section, float(columns["duration"][0]))

    @property
    def tree(self) -> Tree:
        """Its spanning tree."""
        return spanning_tree(self.scene)

    @property
    def formulation(self) -> str:
        """The other formulation where loops are closed by ideal joints and there is no play."""
        tree = self.tree
        return "lagrange" if tree.closing and not tree.pairs else "reduced"

    def derivative(self, share: float) -> Floats:
        """Return the derivative by central differences, steps being shares of states' extents.

        Rates of contacts that last from the start on stay what they are, and are no states.
        """
        _, lasting = self.after(self.section)
        moving = [
            k
            for k, name in enumerate(self.names)
            if not name.startswith("impact_rate.") or (self.section[k] > 0.0 and not lasting[k])
        ]
        extents = self._extents()
        found = np.empty((len(moving), len(moving)))
        for column, k in enumerate(moving):
            step = np.zeros(len(self.section))
            step[k] = share * extents[k]
            ahead, behind = (self.after(self.section + sign * step)[0] for sign in (1.0, -1.0))
            found[:, column] = ((ahead - behind) / (2.0 * step[k]))[moving]
        return found

    def _extents(self) -> Floats:
        """Return what steps are shares of: of states, what counts as one, or less."""
        states = start_scales(self.scene, self.tree.coordinates, self.duration)
        sizes = np.abs(self.section[: len(states)])
        sizes = np.maximum(sizes, SMALL * sizes.max())
        return np.concatenate([np.minimum(states, sizes), self.section[len(states) :]])

    def after(self, section: Floats) -> tuple[Floats, Floats]:
        """Return the section a period later, and which contacts have lasted since the start."""
        states = [name for name in self.names if not name.startswith("impact_rate.")]
        read = [_channel(name) for name in states]
        scene = json.loads(self.scene.model_dump_json(exclude_none=True, exclude={"parameters"}))
        job = {"kind": "simulate", "duration": self.duration, "tolerance": TOLERANCE}
        job |= {"method": METHOD, "certificate": False, "channels": read}
        if self.formulation == "lagrange":
            scene["start"] = self._start(dict(zip(self.names, section.tolist(), strict=True)))
            job |= {"formulation": "lagrange"}
        else:
            job |= {"state": section.tolist()}
        results = run(job | {"scene": scene})
        history, impacts = results.history, results.impacts
        end = [float(history[name].values[-1]) for name in read]
        lasting = [0.0] * len(end)
        for name in self.names[len(end) :]:
            pair = name.removeprefix("impact_rate.")
            last = [k for k, one in enumerate(impacts.joint) if one == pair][-1:]
            held = [k for k in last if np.isnan(impacts.release[k])]
            end.append(float(impacts.approach_rate[held[0]]) if held else 0.0)
            lasting.append(float(bool(held) and impacts.onset[held[0]] == 0.0))
        return np.array(end), np.array(lasting)

    def _start(self, section: dict[str, float]) -> dict[str, Any]:
        """Return a section as a scene's start."""
        points = {"ground": self.scene.ground.points}
        start: dict[str, Any] = {"angles": {}, "points": {}, "angular_velocities": {}}
        start["velocities"] = {}
        for branch in self.tree.branches:
            for name in branch.coordinates:
                position, rate = section[f"state.{name}"], section[f"rate.{name}"]
                if name.endswith(".theta"):
                    start["angles"][branch.body] = position
                    start["angular_velocities"][branch.body] = rate
                else:
                    x, y = points[branch.parent][branch.parent_point]
                    start["points"][f"{branch.body}.{branch.body_point}"] = [x + position, y]
                    start["velocities"][branch.body] = [rate, 0.0]
        return start


def _channel(name: str) -> str:
    """Return the channel of a column: `rate.mass.s` is mass.vx, `state.P.bristle` P.bristle."""
    kind, body, last = name.split(".")
    return f"{body}.{CHANNELS[last][kind == 'rate'] if last in CHANNELS else last}"
