"""The command ``jointplay``.

One command is one file.  Command files import at their top only what parsing the command line
needs (typer and the standard library), everything else inside the function: ``jointplay --help``
then starts in about a tenth of a second, and ``jointplay ls`` never loads a compiler.
"""

import gc


def main() -> None:
    """Run the command that the process's arguments name, and exit with its code.

    What is still there is left to the system: Python would look at every object of a compiler and
    of its figures once more, for half a second, only to end.
    """
    from jointplay.command_line.application import run

    code = run()
    gc.freeze()
    raise SystemExit(code)
