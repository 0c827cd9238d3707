"""The packages in a tree laid out like the wheel, for checkers that read folders, not finders."""

import runpy
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TREE = ROOT / "build" / "tree"


def lay_out() -> Path:
    """Link every package where a wheel has it, below `build/tree`; return that folder."""
    import setuptools

    rooms: dict[str, str] = {}
    original, setuptools.setup = (
        setuptools.setup,
        lambda **given: rooms.update(given["package_dir"]),
    )
    try:
        runpy.run_path(str(ROOT / "setup.py"))
    finally:
        setuptools.setup = original
    top = TREE / "jointplay"
    top.mkdir(parents=True, exist_ok=True)
    linked = {path.name: path for path in (ROOT / rooms.pop("jointplay")).iterdir()}
    linked |= {package.partition(".")[2]: ROOT / folder for package, folder in rooms.items()}
    for link in top.iterdir():  # those that are right stay: a checker may be reading them
        if linked.get(link.name) != link.readlink():
            link.unlink()
    for name, target in linked.items():
        if not (top / name).is_symlink():
            (top / name).symlink_to(target)
    return TREE


if __name__ == "__main__":
    lay_out()
