"""In which order tests run and which share a worker: by the CPU seconds that they took when measured.

`make test` and `make heavy` name a file of times (``--times``). With ``--measure-times`` as well, the run
writes what it measured into that file; files that it did not run keep their times. The longest go first, so
that the last are short and no worker waits for the other.
"""

import os
from collections import Counter

import pytest

#: Folders whose files share a worker, because they share what takes long to make (one report, for instance).
TOGETHER = ("tests/reports/",)
SHORT = 2.0  # s: what takes less is not listed


def scope(node):
    """What one worker runs as a whole: the file of a test, or its folder."""
    file = node.partition("::")[0]
    return next((folder for folder in TOGETHER if file.startswith(folder)), file)


def read(path):
    """Seconds by scope."""
    lines = path.read_text("utf-8").splitlines() if path.exists() else []
    pairs = (line.split(maxsplit=1) for line in lines if line and line[0] != "#")
    return {name: float(seconds) for seconds, name in pairs}


class Order:
    """Sorts tests by a file of times, and measures them."""

    def __init__(self, path, measure, root, worker="gw0"):
        self.path, self.measure, self.root = path, measure, root
        self.backwards = int(worker.removeprefix("gw")) % 2 == 1
        self.times, self.measured, self._begin = read(path), Counter(), 0.0

    @pytest.hookimpl(wrapper=True)
    def pytest_make_collect_report(self, collector):
        """Let every other worker go through folders from their end.

        In a new clone pytest rewrites the asserts of every file, which takes 15 s, and keeps what it makes:
        so each worker does it for half of the files, and reads the other half.
        """
        report = yield
        if self.backwards and isinstance(collector, pytest.Directory):
            report.result.reverse()
        return report

    def pytest_collection_modifyitems(self, items):
        """Put the longest scopes first, then files by name: the order is that of all workers."""

        def place(item):
            return -self.times.get(scope(item.nodeid), 0.0), item.nodeid.partition("::")[0]

        items.sort(key=place)

    @pytest.hookimpl(optionalhook=True)
    def pytest_xdist_make_scheduler(self, config, log):
        """Give each worker whole scopes."""
        from xdist.scheduler import LoadFileScheduling

        class Scheduling(LoadFileScheduling):
            def _split_scope(self, nodeid):
                return scope(nodeid)

        return Scheduling(config, log)

    @pytest.hookimpl(wrapper=True, tryfirst=True)
    def pytest_runtest_setup(self, item):
        """Begin to measure."""
        self._begin = sum(os.times()[:4])
        return (yield)

    @pytest.hookimpl(wrapper=True, tryfirst=True)
    def pytest_runtest_teardown(self, item):
        """Note the seconds of this process and of those that it waited for."""
        try:
            return (yield)
        finally:
            item.user_properties.append(("cpu", sum(os.times()[:4]) - self._begin))

    def pytest_runtest_logreport(self, report):
        """Collect the seconds of all workers."""
        if report.when == "teardown":
            self.measured[scope(report.nodeid)] += dict(report.user_properties).get("cpu", 0.0)

    def pytest_terminal_summary(self, terminalreporter):
        """Print the sum; write the file where asked for."""
        terminalreporter.write_line(f"CPU seconds of all tests: {sum(self.measured.values()):.0f}")
        if self.measure:
            kept = {name: s for name, s in self.times.items() if (self.root / name).exists()}
            every = Counter(kept | self.measured).most_common()
            lines = [f"{s:.0f} {name}" for name, s in every if s >= SHORT]
            head = "# CPU seconds by file (or folder), written by --measure-times (CONTRIBUTING.md)"
            self.path.write_text("\n".join([head, *lines, ""]), "utf-8")
