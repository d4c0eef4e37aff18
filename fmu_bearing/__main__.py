"""The command line, as ``python -m fmu_bearing`` and as the command ``fmu-bearing``."""

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


if __name__ == "__main__":
    main()
