"""A campaign in a process of its own: its plan as JSON in, its report as JSON out."""

import json
import sys
from pathlib import Path

from jointplay.chaos.campaign import campaign


def main() -> None:
    """Carry out the plan of the first argument; the folder in it is there, and empty."""
    plan = json.loads(sys.argv[1])
    folder = Path(plan.pop("folder"))
    report = campaign(folder, **plan, tell=_tell)
    sys.stdout.write(json.dumps(report.document()) + "\n")


def _tell(line: str) -> None:
    sys.stderr.write(line + "\n")
    sys.stderr.flush()


if __name__ == "__main__":
    main()
