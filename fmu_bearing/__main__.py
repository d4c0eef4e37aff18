"""The command line, as ``python -m fmu_bearing`` and as the command ``fmu-bearing``."""

import os
import sys


def main() -> None:
    """Run the command; Ctrl-C ends it with one line at any time, while modules are loaded too."""
    try:
        from fmu_bearing.cli import app

        app(prog_name="fmu-bearing")
    except KeyboardInterrupt:
        sys.stderr.write("interrupted\n")
        sys.exit(130)
    finally:
        # CPython takes an interrupt within `exec` of a text (dataclasses do that) for unhandled, and then
        # ends the process by its signal whatever caught it. The next `exec` of a text clears that.
        exec("")


def _without_current_folder() -> None:
    """Take no more modules from the current folder, which `python -m` puts in front of all others."""
    if not sys.flags.safe_path:
        del sys.path[0]
        sys.path.append(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


if __name__ == "__main__":
    _without_current_folder()
    main()
