"""What users ask: the page that answers each question is at most two clicks from the first page."""

import collections
import posixpath
import re

import pytest

from tests.pages import DOCS

pytestmark = pytest.mark.pages

FIRST = "index.md"

#: Question; the page that answers it; words of the answer, line breaks aside.
QUESTIONS = (
    # the spindle engineer
    ("Is my preload right, and what if it is too large?", "learn/preload.md",
     "between the skidding limit and the heavy class"),
    ("How hot do the rings and the oil get?", "learn/heat.md", "info --temperatures"),
    ("Will it last 20,000 hours?", "learn/life.md", "For 20,000 h keep the"),
    ("At which speed may I cut deeper before it chatters?", "learn/chatter.md",
     "run this mill at 20,250 r/min"),
    ("My bearing is not in the catalogue. How do I enter it?", "sizes.md",
     "give the balls. `fmu-bearing scene new` with `--bore`"),
    ("Which speed excites a resonance, and which preload avoids it?", "modes.md", "Take 650 N"),
    ("Which fidelity gives torque and heat of a long run?", "choosing.md",
     "torque and heat for a drive or a thermal network"),
    ("How far can I trust the friction torque?", "limits.md", "Friction torque is a model"),
    # the NVH engineer
    ("How do I get a level in dB(A) and a WAV file?", "quick-start.md", "32-bit float"),
    ("Is the level right, or only the difference of two scenes?", "limits.md",
     "Absolute sound levels are not calibrated"),
    ("What makes the line at 1987 Hz, and what helps?", "learn/noise.md", "the waves of the inner race make"),
    ("May I read directivity from `compact`?", "limits.md", "Read no directivity from it"),
    ("Up to which frequency do surfaces excite?", "choosing.md", "end of the excitation"),
    ("Why is a bare bearing too quiet in `rings`?", "fidelities/rings.md", "The cage's own sound is missing"),
    ("What does `response` do when a load jumps?", "fidelities/response.md",
     "A jump of an input is followed 5 to 30 ms late"),
    ("How do I see a damaged race, and how long is the spall?", "learn/spall.md",
     "The time gives its 1 mm within a tenth"),
    ("I have a CSV of an accelerometer. Which race is damaged?", "analysis.md",
     "here strokes at 104.6 Hz in a logger's place"),
    # the author of a test harness
    ("Does the FMU need Python?", "fmu.md", "the C library of the system"),
    ("Which sign has the torque, and who owns the inertia?", "coupling.md", "which **the drive owns**"),
    ("Does the scene keep a step of 1 ms on my machine?", "realtime.md", "A fidelity keeps the step"),
    ("A step was refused. Where is the reason?", "fmu.md", "value not taken: preload = -5.0 is refused"),
    ("Does it run in Simulink?", "hosts/simulink.md", "Nothing on this page was run"),
    ("How do I build for Windows on Linux?", "cross-builds.md", "--platforms linux64,win64"),
    ("How do I guard a FMU against changes?", "testing.md", "assert_matches_reference"),
)  # fmt: skip

_FENCED = re.compile(r"^(`{3,}).*?^\1", flags=re.MULTILINE | re.DOTALL)
_LINK = re.compile(r"(?:\]\(|^\[\w+\]: )([^)\s#:]+\.md)", flags=re.MULTILINE)


def text(page):
    return (DOCS / page).read_text(encoding="utf-8")


def linked(page):
    """Pages under docs that a page links to, in its order."""
    folder = posixpath.dirname(page)
    found = (
        posixpath.normpath(posixpath.join(folder, link))
        for link in _LINK.findall(_FENCED.sub("", text(page)))
    )
    return [one for one in dict.fromkeys(found) if (DOCS / one).is_file()]


def clicks():
    """Clicks from the first page to each page that links lead to."""
    away, queue = {FIRST: 0}, collections.deque([FIRST])
    while queue:
        page = queue.popleft()
        for one in linked(page):
            if one not in away:
                away[one] = away[page] + 1
                queue.append(one)
    return away


@pytest.fixture(scope="module")
def away():
    return clicks()


@pytest.mark.parametrize(("question", "page", "words"), QUESTIONS, ids=[one[0] for one in QUESTIONS])
def test_a_question_is_answered_within_two_clicks(away, question, page, words):
    assert away.get(page, 99) <= 2, f"{page} is too far from {FIRST}"
    assert words in " ".join(text(page).split()), f"{page} does not answer: {question}"


def test_every_page_is_reached_within_three_clicks(away):
    """Pages of docs; the change log and tables are reached from pages that explain them."""
    every = {path.relative_to(DOCS).as_posix() for path in DOCS.rglob("*.md")}
    assert not {page for page in every if away.get(page, 99) > 3}


def test_three_pages_lead_each_reader_to_a_decision():
    part = text(FIRST).split("## From question to decision")[1].split("\n## ")[0]
    places = dict(re.findall(r"^\[(\w+)\]: (\S+)", part, flags=re.MULTILINE))
    readers = [line for line in part.splitlines() if line.startswith("|")][2:]
    assert len(readers) == 4
    for line in readers:
        path = [direct or places[name] for direct, name in re.findall(r"\](?:\(([^)]+)\)|\[(\w+)\])", line)]
        assert len(path) == 3 == len({one.split("#")[0] for one in path}), line
        assert "**Decision: " in text(path[-1].split("#")[0]), line


if __name__ == "__main__":
    distances = clicks()
    for question, page, _ in QUESTIONS:
        print(f"{distances.get(page, '-')} | {page} | {question}")
