"""Rules that linters cannot see: sizes, names, units, and what importing a package loads."""

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from graphlib import TopologicalSorter
from pathlib import Path
from typing import Any

import pytest

from jointplay.solver.joints import JOINTS

ROOT = Path(__file__).resolve().parent.parent
PACKAGES = ["records", "solver", "storage", "figures", "worker", "service", "chaos", "paper"]
PACKAGES += ["src/jointplay"]
SOURCES = sorted(path for package in PACKAGES for path in (ROOT / package).rglob("*.py"))
EVERYTHING = SOURCES + sorted((ROOT / "tests").rglob("*.py"))


def relative(path: Path) -> str:
    return str(path.relative_to(ROOT))


def test_no_file_is_longer_than_450_lines():
    long = [relative(path) for path in EVERYTHING if len(path.read_text().splitlines()) > 450]
    assert long == []


def test_no_module_is_named_for_what_found_no_home():
    homeless = {"utils", "util", "helpers", "helper", "common", "misc", "manager", "handler"}
    assert [relative(path) for path in SOURCES if path.stem in homeless] == []


def test_all_tests_can_be_collected_at_once() -> None:
    """Files of tests are modules without a package, of which two cannot have one name."""
    names = [path.name for path in (ROOT / "tests").rglob("test_*.py")]
    assert sorted(names) == sorted(set(names))


def test_every_package_says_what_it_is_for():
    silent = [
        relative(path)
        for path in SOURCES
        if path.name == "__init__.py" and not ast.get_docstring(ast.parse(path.read_text()))
    ]
    assert silent == []


def test_docstrings_begin_with_what_a_thing_is():
    """Not with a question about it, nor in the middle of a sentence."""
    begins = re.compile(r'"""(What|Of|How) ')
    written = EVERYTHING + sorted((ROOT / "benchmarks").rglob("*.py"))
    assert [relative(path) for path in written if begins.search(path.read_text())] == []


def test_docstrings_say_what_is_returned_in_a_sentence_of_its_own():
    """Which begins with Returns; behind a semicolon it reads as a part of what is done."""
    clause = re.compile(r'"""[^"]*?;\s+(return|how many|whether)\s')
    assert [relative(path) for path in SOURCES if clause.search(path.read_text())] == []


def test_types_of_joints_are_named_only_in_their_family() -> None:
    """Others ask a joint what it does, so that a new type needs nothing of them."""
    named = re.compile("[\"']({})[\"']".format("|".join(JOINTS)))
    taken = re.compile(r"solver\.joints\.({}) ".format("|".join(map(module_of, JOINTS.values()))))
    others = [path for path in SOURCES if "joints" not in path.parts and "chaos" not in path.parts]
    others += sorted((ROOT / "page" / "mechanism").rglob("*.js"))
    found = {path: path.read_text() for path in others}
    assert [relative(path) for path, text in found.items() if named.search(text)] == []
    assert [relative(path) for path, text in found.items() if taken.search(text)] == []


def module_of(member: type) -> str:
    return member.__module__.rpartition(".")[2]


def test_nothing_evaluates_or_unpickles_what_it_reads():
    forbidden = re.compile(r"(?<![\w.])(eval|pickle\.loads?|marshal\.loads?|yaml\.load)\(")
    assert [relative(path) for path in SOURCES if forbidden.search(path.read_text())] == []


def test_python_is_started_without_the_current_folder_on_its_path():
    """A file `queue.py` in a user's folder must stay unread; -I and -P leave the folder out."""
    started = re.compile(r"\[\s*sys\.executable,\s*(\S+)")
    flags = [flag for path in SOURCES for flag in started.findall(path.read_text())]
    assert len(flags) >= 4
    assert set(flags) <= {'"-P",', '"-I",'}


def test_no_code_outside_the_scenes_knows_a_preset():
    """The press is a document; a name of it in the code would be a special case."""
    names = re.compile(r"slider7|seven.bar|crank1|link2|bouncing.journal", re.IGNORECASE)
    knowing = []
    for path in SOURCES:
        tree = ast.parse(path.read_text())
        documentation = {id(node) for node in docstrings_and_help(tree)}
        for node in ast.walk(tree):
            is_text = isinstance(node, ast.Constant) and isinstance(node.value, str)
            if is_text and id(node) not in documentation and names.search(node.value):
                knowing.append(f"{relative(path)}:{node.lineno}: {node.value[:60]}")
    assert knowing == []


def docstrings_and_help(tree: ast.AST) -> Iterator[ast.Constant]:
    """Yield the texts for readers, where the press may be an example."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            yield node.value
        if isinstance(node, ast.keyword) and node.arg in {"help", "description"}:
            yield from (part for part in ast.walk(node.value) if isinstance(part, ast.Constant))


WAITS_FOR_NOTHING = {
    *("is_visible", "is_hidden", "is_enabled", "is_disabled", "is_checked", "is_editable"),
    *("all_inner_texts", "all_text_contents", "inner_text", "inner_html", "text_content"),
    *("evaluate", "evaluate_all", "get_attribute", "input_value", "bounding_box"),
    *("query_selector", "query_selector_all", "title", "content"),
}
"""Questions that Playwright answers at once; `count()` and `url` are two more."""


def asked_at_once(assertion: ast.AST) -> Iterator[str]:
    """Yield what an assertion asks of a page that may not be drawn yet."""
    for node in ast.walk(assertion):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            name = node.func.attr
            if name in WAITS_FOR_NOTHING or (name == "count" and not node.args):
                yield name
        if isinstance(node, ast.Attribute) and ast.unparse(node) == "page.url":
            yield "url"


@pytest.mark.parametrize("path", sorted((ROOT / "tests/page").glob("test_*.py")), ids=relative)
def test_no_test_of_the_page_guesses_a_moment(path):
    """A sentence of a page may come later than the one before: `expect` and `wait_for` wait."""
    tree = ast.parse(path.read_text())
    asserted = [node for node in ast.walk(tree) if isinstance(node, ast.Assert)]
    assert {name for one in asserted for name in asked_at_once(one)} == set()
    assert not re.search(r"wait_for_timeout|\bsleep\(|timeout=", path.read_text())


def imported_by(path: Path, modules: dict[str, Path]) -> Iterator[str]:
    """Yield the modules of ours that a file imports, also where it does so inside a function."""

    def nodes(parent: ast.AST) -> Iterator[ast.AST]:
        for node in ast.iter_child_nodes(parent):
            for_types_only = isinstance(node, ast.If) and "TYPE_CHECKING" in ast.dump(node.test)
            if not for_types_only:
                yield node
                yield from nodes(node)

    for node in nodes(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in modules)
        elif isinstance(node, ast.ImportFrom) and node.module in modules:
            for alias in node.names:
                inner = f"{node.module}.{alias.name}"
                yield inner if inner in modules else str(node.module)


def test_no_files_import_each_other_in_a_circle():
    modules = {}
    for path in SOURCES:
        parts = list(path.relative_to(ROOT).with_suffix("").parts)
        parts = parts[1:] if parts[0] == "src" else ["jointplay", *parts]
        modules[".".join(parts).removesuffix(".__init__")] = path
    graph = {name: {*imported_by(path, modules)} - {name} for name, path in modules.items()}
    assert len(graph) > 400
    TopologicalSorter(graph).prepare()  # raises CycleError, which lists the files


def schemas() -> Iterator[tuple[str, dict[str, Any]]]:
    from jointplay.service.jobs.schemas import JobResource
    from jointplay.service.results.schemas import History, Impacts, Peaks
    from jointplay.service.studies.schemas import Bifurcation, Sections, Sweep
    from jointplay.solver.kinds import KINDS

    for model in (
        *(kind.document for kind in KINDS.values()),
        JobResource,
        History,
        Impacts,
        Peaks,
        Bifurcation,
        Sections,
        Sweep,
    ):
        schema = model.model_json_schema()
        for name, definition in {model.__name__: schema, **schema.get("$defs", {})}.items():
            for field, described in definition.get("properties", {}).items():
                yield f"{name}.{field}", described


# Numbers whose unit stands beside them as a field, or which are pure numbers by their nature.
WITHOUT_UNIT = {
    "Output.factor",
    "Output.offset",
    "Parameter.default",
    "Parameter.minimum",
    "Parameter.maximum",
    "Peak.minimum",
    "Peak.maximum",
    "PeakColumns.maximum",
    "PeakColumns.minimum",
    "PeakColumns.range",
    "PresetScene.parameters",
    "Progress.fraction",
    "Reported.parameters",
    "Reported.value",
    "Rows.values",
    "Series.values",
    "Target.factor",
}


def test_every_number_of_the_documents_has_a_unit():
    without = {
        name
        for name, described in schemas()
        if "'number'" in str(described) and "unit" not in str(described)
    }
    assert without == WITHOUT_UNIT


def loaded_by(module: str, watched: list[str]) -> list[str]:
    program = f"import sys, {module}; print(*(m for m in {watched} if m in sys.modules))"
    ended = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    return ended.stdout.split()


@pytest.mark.parametrize(
    ("module", "never"),
    [
        ("jointplay.client", ["numba", "celery", "fastapi", "sqlalchemy", "zarr", "matplotlib"]),
        ("jointplay.local.folder_results", ["numba", "celery", "httpx", "matplotlib"]),
        ("jointplay.figures", ["numba", "celery", "fastapi", "matplotlib", "httpx"]),
        ("jointplay.command_line.application", ["numpy", "pydantic", "rich", "httpx", "numba"]),
        ("jointplay.solver.kinds", ["numba", "celery", "fastapi", "zarr", "scipy"]),
        ("jointplay.worker.execute", ["numba", "celery", "fastapi"]),
        ("jointplay.storage.results", ["numba", "celery", "fastapi", "sqlalchemy"]),
        ("jointplay.storage.catalogue", ["numba", "celery", "fastapi", "zarr", "numpy"]),
        (
            "jointplay.service.app",
            [
                "numba",
                "scipy",
                "matplotlib",
                "jointplay.solver.computations",
                "jointplay.solver.runs.simulate",
                "jointplay.worker.tasks",
            ],
        ),
    ],
)
def test_importing_a_module_does_not_load(module, never):
    assert loaded_by(module, never) == []


def test_version_control_ignores_what_the_targets_make():
    ignored = (ROOT / ".gitignore").read_text().split()
    assert {".venv/", "demo/", "__pycache__/", ".jointplay/"} <= set(ignored)


def test_documents_name_files_that_are_there():
    named = re.compile(r"`((?:[a-z_]+/)+[\w.-]*)`")
    missing = [
        f"{page.name}: {path}"
        for page in [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
        for path in named.findall(page.read_text())
        if (ROOT / (folder := path.partition("/")[0])).is_dir()
        if folder != "build" and not (ROOT / path).exists()  # it has what commands make
    ]
    assert missing == []
