"""Sources of results call no function whose bits depend on the processor or the C library."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

SOLVER = Path(__file__).resolve().parent.parent.parent / "solver"
TRANSCENDENTAL = {
    *("sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "exp", "expm1"),
    *(
        "exp2",
        "log",
        "log2",
        "log10",
        "log1p",
        "pow",
        "cbrt",
        "power",
        "hypot",
        "arctan2",
        "arctan",
        "geomspace",
        "logspace",
    ),
    *("arcsin", "arccos", "dot", "vdot", "matmul", "inner", "tensordot", "einsum", "polyfit"),
}
OF_PYTHON = {"hypot"}
"""Which `math` computes without the C library."""
SHOWN = {
    "joints/prismatic.py": "whether sizes fit",
    "joints/revolute.py": "whether a start fits",
    "kinds/observables.py": "a name of an axis",
    "kinds/start_hints.py": "sentences",
    "mechanics/dragging.py": "poses that are shown",
    "mechanics/open_joint.py": "a sentence",
    "mechanics/redundancy.py": "sentences",
    "nonlinear/estimate.py": "digits of a sentence",
    "runs/centred_journals.py": "a sentence",
    "runs/ideal/constraints.py": "poses that are shown",
    "runs/ideal/dead_point.py": "a sentence",
    "runs/ideal/margin.py": "a sentence",
}
"""Files that call such functions, and what for: none of it is stored as a number."""


def foreign(tree: ast.AST) -> Iterator[str]:
    """Yield calls whose bits are not our own."""
    for node in ast.walk(tree):
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.MatMult):
            yield "@"
        if not isinstance(node, ast.Attribute):
            continue
        owner = ast.unparse(node.value)
        if owner == "np.linalg" and node.attr != "LinAlgError":
            yield f"np.linalg.{node.attr}"
        own = node.attr in OF_PYTHON and owner == "math"
        if owner in ("math", "np", "cmath") and node.attr in TRANSCENDENTAL and not own:
            yield f"{owner}.{node.attr}"


@pytest.mark.parametrize(
    "path", sorted(SOLVER.rglob("*.py")), ids=lambda path: str(path.relative_to(SOLVER))
)
def test_a_source_computes_with_arithmetic_of_our_own(path: Path) -> None:
    found = sorted(set(foreign(ast.parse(path.read_text()))))
    assert bool(found) == (str(path.relative_to(SOLVER)) in SHOWN), found
