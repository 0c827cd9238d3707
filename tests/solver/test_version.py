"""The solver's version changes with every source that its numbers depend on."""

import ast
from collections.abc import Iterator
from pathlib import Path

from jointplay.solver import version

ROOT = Path(__file__).resolve().parents[2]
HASHED = {"solver", "records"}


def imported(text: str) -> Iterator[str]:
    """Yield the packages below jointplay that a source imports."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("jointplay"):
            inside = (node.module or "").split(".")[1:2]
            yield from inside or [alias.name for alias in node.names]


def test_the_version_covers_all_that_the_solver_imports() -> None:
    found = {
        name for path in (ROOT / "solver").rglob("*.py") for name in imported(path.read_text())
    }
    assert found == HASHED
    assert {folder.name for folder in version._SOURCES} == HASHED
