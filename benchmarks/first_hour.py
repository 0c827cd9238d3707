"""Time to one's own mechanism: the commands of the tutorial, one after the other, nothing compiled.

Reading and typing are not in it, nor is the installation: ``time make install`` measures that.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

PAGE = Path(__file__).resolve().parent.parent / "docs" / "tutorial.md"
BLOCK = re.compile(r"^```(json|bash)\n(.*?)^```", re.DOTALL | re.MULTILINE)


def merged(before: Any, patch: Any) -> Any:
    """Return a document with a later part of it merged in, as the tutorial says."""
    if not (isinstance(before, dict) and isinstance(patch, dict)):
        return patch
    return {**before, **{name: merged(before.get(name), value) for name, value in patch.items()}}


def main() -> None:
    """Print a line for each command: seconds since the first one, its own, and its words."""
    scene: Any = {}
    with tempfile.TemporaryDirectory() as folder:
        environment = os.environ | {"JOINTPLAY_CACHE": f"{folder}/cache"}
        program = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
        begun = time.perf_counter()
        for language, text in BLOCK.findall(PAGE.read_text()):
            if language == "json":
                scene = merged(scene, json.loads(text))
                (Path(folder) / "mine.json").write_text(json.dumps(scene))
                continue
            for command in text.splitlines():
                start = time.perf_counter()
                subprocess.run(
                    ["sh", "-c", command],
                    check=True,
                    capture_output=True,
                    cwd=folder,
                    env=environment | {"PATH": program},
                )
                now = time.perf_counter()
                print(f"{now - begun:6.1f} s {now - start:6.1f} s  {command}")


if __name__ == "__main__":
    main()
