"""SL: the sound of fidelity `response` as a sum of lines: state and scratch of a block of lines.

Lines and beats belong to the first bearing's block where there are several. Rows of microphones are in the
order of that block's lanes.
"""

from fmu_bearing.engine.layout.sizes import Places
from fmu_bearing.engine.layout.sound_filters import COMPONENTS, KINDS

MOST_LINES = 1024  # per bearing,
FEWER_LINES, MANY_MICS = 512, 24  # and with more microphones than that
MOST_BEATS = 96  # differences of two lines' angles
REACH = 96.0  # rad/s: lines as close as that beat; at Fast what is left out is 12 times below the mean

_at = Places()
LINE_BALL = _at()  # multiples of angles, weight and heap as in the table of the rings' lines
LINE_SHAFT = _at()
LINE_ROLLED = _at()
LINE_WEIGHT = _at()  # Pa2
LINE_HEAP = _at()
LINE_MEMBER = _at()  # bearing whose angles they are
LINE_PRESSURE = _at.next  # Pa: at each microphone, real, then imaginary parts

_at = Places()
ROW_TOTAL = _at()
ROW_PART = _at(len(COMPONENTS))
ROW_KIND = _at(len(KINDS) - 1)
ROW_ALONE = _at.next  # and of each bearing of a set

# squared gains of a line, in scratch: of A-weighting, then of third octaves
GAIN_A = 0
GAIN_BANDS = 1

# what is metered of lines
_at = Places()
MEAN_TOTAL = _at()
MEAN_TOTAL_A = _at()
MEAN_PART = _at(len(COMPONENTS))
MEAN_KIND = _at(len(KINDS) - 1)
MEANS = _at.next  # then each bearing of a set alone, then third octaves

# a beat: bearings, and multiples of their angles, by which it turns
_at = Places()
BEAT_ONE = _at()
BEAT_OTHER = _at()
BEAT_BALL = _at()  # of the one bearing's ball 0
BEAT_OTHER_BALL = _at()
BEAT_SHAFT = _at()
BEAT_ROLLED = _at()
BEAT_OTHER_ROLLED = _at()
BEAT_KEY = _at.next
BEAT_PRODUCT = _at.next  # Pa2: rows of the quantities' microphones, real, then imaginary parts

# scratch of lines, one row of the most lines each
_at = Places()
INDEX_OMEGA = _at()  # rad/s
INDEX_NEXT = _at()  # next line with the same key
INDEX_SORTED = _at()  # numbers by frequency
INDEX_SIZE = _at()  # Pa: root of the weight
INDEX_ROWS = _at.next
HEADS = 256  # chains of lines by key, behind these rows,
_at = Places()
NOTE_STRONGEST = _at()  # Pa2: behind these the largest weight of a line of the rings,
NOTE_TOKEN = _at()  # and what the table is of,
PLACE_SIZE = 4  # numbers of the march from the stage of a renewal to its cursor
NOTE_PLACE = _at(PLACE_SIZE)  # and the piece that would follow
NOTES = _at.next

# scratch of beats over a step: rows of the most beats
_at = Places()
TURN_BEGIN = _at(MOST_BEATS)  # rad: how far they have turned at its begin, later the cosine;
TURN_BEGIN_SIN = _at(MOST_BEATS)
TURN_END = _at(MOST_BEATS)  # and at its end
TURN_END_SIN = _at(MOST_BEATS)
TURN_RATE = _at(MOST_BEATS)  # rad/s
TURN_RE = _at(MOST_BEATS)  # what their products count in the average that is moved
TURN_IM = _at(MOST_BEATS)
TURN = _at.next

# angles of a bearing at the time that is sounding, rad
_at = Places()
ANGLE_BALL = _at()
ANGLE_SHAFT = _at()
ANGLE_ROLLED = _at()
ANGLES = _at.next


def most_lines(mics: int) -> int:
    """Most lines per bearing: no fewer than the rings have."""
    return MOST_LINES if mics <= MANY_MICS else FEWER_LINES


def line_size(mics: int) -> int:
    """Count of the numbers of a line."""
    return LINE_PRESSURE + 2 * mics


def quantities(bearings: int, bands: int) -> int:
    """Count of the quantities metered: those of every block, each bearing of a set, third octaves."""
    return MEANS + bearings + bands


def beat_size(bearings: int, bands: int, mics: int) -> int:
    """Count of the numbers of a beat."""
    return BEAT_PRODUCT + 2 * mics * quantities(bearings, bands)
