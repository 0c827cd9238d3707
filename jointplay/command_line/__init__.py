"""The command ``jointplay``.

One command is one file.  Command files import at their top only what parsing the command line
needs (typer and the standard library), everything else inside the function: ``jointplay --help``
then starts in about a tenth of a second, and ``jointplay ls`` never loads a compiler.
"""


def main() -> None:
    """Run the command that the process's arguments name, and exit with its code."""
    from jointplay.command_line.application import run

    raise SystemExit(run())
