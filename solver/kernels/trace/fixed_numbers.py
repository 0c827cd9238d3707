"""Expressions of a scene's numbers alone, evaluated for one scene after the other."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from pydantic import BaseModel

from jointplay.solver.kernels.trace.operations import operate
from jointplay.solver.kernels.trace.reachable import with_arguments
from jointplay.solver.kernels.trace.tracer import Expression
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.scene.document import Scene


class FixedNumbers:
    """Slots, and how the number in each follows from those of a scene: listed once a kernel."""

    def __init__(self, nodes: dict[int, Expression]) -> None:
        """List what is to be evaluated, by slot."""
        self.slots = list(nodes)
        self._nodes = with_arguments(nodes.values())
        order = {node.index: i for i, node in enumerate(self._nodes)}
        self._wanted = [order[node.index] for node in nodes.values()]
        self._pointers = [
            str(node.data).split("/")[1:] if node.operation == "number" else []
            for node in self._nodes
        ]
        self._arguments = [[order[a.index] for a in node.arguments] for node in self._nodes]

    def values(self, scene: Scene) -> list[Scalar]:
        """Return the numbers of a scene in the order of `slots`; (points,) where they vary.

        The scene must have the structure that the kernel was compiled for.
        """
        found: list[Scalar] = []
        for node, pointer, arguments in zip(
            self._nodes, self._pointers, self._arguments, strict=True
        ):
            if pointer:
                found.append(_number_at(scene, pointer))
            elif node.operation == "constant":
                found.append(node.value)
            else:
                found.append(operate(node.operation, [found[i] for i in arguments]))
        return [found[i] for i in self._wanted]


def _number_at(scene: Scene, pointer: Sequence[str]) -> Scalar:
    """Return the number at the parts of a JSON pointer."""
    part_of_scene: Any = scene
    for part in pointer:
        if isinstance(part_of_scene, BaseModel):
            part_of_scene = getattr(part_of_scene, part)
        else:
            part_of_scene = part_of_scene[int(part) if isinstance(part_of_scene, list) else part]
    return part_of_scene if isinstance(part_of_scene, np.ndarray) else float(part_of_scene)
