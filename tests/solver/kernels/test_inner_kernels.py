"""Kernels that kernels alone call: a call from Python would be one of a null pointer."""

import ast
from collections.abc import Iterator
from pathlib import Path

from jointplay.solver.kernels.compile_loop import FUNCTIONS

ROOT = Path(__file__).resolve().parents[3]
LOOP = "jointplay.solver.kernels.loop"
COMPILED = ("kernel(", "written_out(")
ENTRIES = {one.__name__ for part in FUNCTIONS.values() for one in part.values()}
"""Functions that Python calls by their entry points alone."""


def is_compiled(function: ast.FunctionDef, by: tuple[str, ...] = COMPILED) -> bool:
    return any(word in ast.unparse(each) for each in function.decorator_list for word in by)


def inner_kernels() -> dict[str, set[str]]:
    """Names of inner kernels by their module."""
    found = {}
    for path in (ROOT / "solver" / "kernels" / "loop").rglob("*.py"):
        functions = [n for n in ast.parse(path.read_text()).body if isinstance(n, ast.FunctionDef)]
        inner = {one.name for one in functions if is_compiled(one, ("inner_kernel(",))}
        found[module_of(path)] = inner
    return found


def module_of(path: Path) -> str:
    return ".".join(["jointplay", *path.relative_to(ROOT).with_suffix("").parts])


def interpreted(node: ast.AST) -> Iterator[ast.AST]:
    """Yield what Python itself runs: all but the bodies of kernels."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.FunctionDef) and (is_compiled(child) or child.name in ENTRIES):
            continue
        yield child
        yield from interpreted(child)


def test_python_calls_no_inner_kernel() -> None:
    inner = inner_kernels()
    assert sum(map(len, inner.values())) > 100
    looked_at = 0
    for path in [*(ROOT / "solver").rglob("*.py"), *(ROOT / "tests" / "solver").rglob("*.py")]:
        text = path.read_text()
        own = inner.get(module_of(path), set())
        if LOOP not in text and not own:
            continue
        tree = ast.parse(text)
        imported = {
            alias.asname or alias.name
            for node in ast.walk(tree)
            if isinstance(node, ast.ImportFrom) and node.module in inner
            for alias in node.names
            if alias.name in inner[node.module]
        }
        used = {node.id for node in interpreted(tree) if isinstance(node, ast.Name)}
        assert not used & (imported | own), path
        looked_at += 1
    assert looked_at > 20
