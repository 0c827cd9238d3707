"""Maps folders to packages below `jointplay`: ``solver/`` to ``jointplay.solver`` and so on."""

from pathlib import Path

from setuptools import find_packages, setup

ROOMS = (
    *("chaos", "figures", "page", "paper", "records"),
    *("scenes", "service", "solver", "storage", "worker"),
)
ROOT = Path(__file__).parent

folders = {"jointplay": "jointplay"} | {f"jointplay.{room}": room for room in ROOMS}
setup(
    package_dir=folders,
    packages=[
        name
        for package, folder in folders.items()
        for name in [package, *(f"{package}.{p}" for p in find_packages(str(ROOT / folder)))]
    ],
)
