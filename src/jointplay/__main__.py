"""``python -m jointplay``: the same as the command ``jointplay``."""

from jointplay.command_line import main

if __name__ == "__main__":
    main()
