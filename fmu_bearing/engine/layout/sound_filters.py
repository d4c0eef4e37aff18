"""SD: the sound blocks: parameters ``ps``, state ``ss``, work ``ws``; rates and sizes of the filters.

``ps`` begins with a head (``H_*``: sizes, then places in ``ps``, ``ss`` and ``ws``), followed by tables:

* decimator: the outer taps of its two half-band filters, which are symmetric, outermost first, every other
  one being zero and the middle one 1/2; then the high-pass, ``HIGH_PASS`` numbers; then sections of second
  order, ``SECTION`` numbers each: ``A_SECTIONS`` of A-weighting, ``BAND_SECTIONS`` of the third octaves,
  these with ``BAND_LANES`` bands side by side;
* scalars that the papers' radiation models need to form their channels; of accelerometers the weights of a
  raw row in each channel;
* lane of each channel in the history: channels with paths to the same microphones lie side by side, channels
  without a path last; once in the order of the channels, once in that in which they are formed (`formed`);
* banks, ``BANK_SIZE`` numbers each: runs of neighbouring lanes, filtered side by side;
* taps of the direct part: per bank ``BANK_TAPS`` rows (a multiple of ``FOUR``) of one number per lane, newest
  sample first; then runs, ``RUN_SIZE`` numbers each: neighbouring lanes that add to one output;
* spans of lags that the convolution by blocks serves with one block length, ``SPAN_SIZE`` numbers each, with
  their tables of cosines and sines, their segments (``SEGMENT_SIZE`` numbers: the lanes they transform), what
  they keep of each lane (``PAST_SIZE`` numbers), the shares of a block's samples in its work, their jobs
  (``JOB_SIZE`` numbers: products that add to one output) and the filters of these, ``FILTER_SIZE`` numbers
  each, with the spectra of their parts: part, real then imaginary, frequency;
* sources, ``SOURCE_SIZE`` numbers each, and the source of each output;
* groups of microphones, ``GROUP_SIZE`` numbers each, with weights: one row of microphones per output;
* for each microphone of the scene its lane: microphones of a group lie side by side.

A block of *lines* (fidelity response, see `sound.beats`) has no decimator, banks and spans. It has transfer
functions: per group rows of ``RAY_SIZE`` numbers, one per path, and tables of ``NODES`` places ``NODE_STEP``
apart, each with value and slope (per step) of a complex number; the flight is taken out.

Microphones on one circle about the bearing axis share their filters: a body of revolution sounds the same
all round, up to cos(m phi) and sin(m phi), which are the weights.
"""

import math

from fmu_bearing.engine.choices import VECTORS
from fmu_bearing.engine.layout import z as _Z
from fmu_bearing.engine.layout.sizes import Places

RAW_RATE = 204_800.0  # Hz, of motion samples
HALF = 2  # each stage of the decimator keeps every other sample
DECIMATION = HALF * HALF
RATE = RAW_RATE / DECIMATION  # Hz, of pressures and meters
FIRST_TAPS = 15  # of the decimator's first stage, RAW_RATE to RAW_RATE / 2,
SECOND_TAPS = 71  # and of its second, to RATE
FIRST_ROWS = FIRST_TAPS + 1  # samples that the first stage keeps
MIDDLE = FIRST_TAPS // 2 + HALF * (SECOND_TAPS // 2)  # motion samples by which the decimator is late
TURNING = -MIDDLE % DECIMATION  # motion samples whose number leaves this rest are in its middle once
TURN_WAIT = -(-MIDDLE // DECIMATION)  # samples at RATE until then
BATCH = 16  # samples at RATE that pass the filters together at most
SECOND_ROWS = SECOND_TAPS + 1 + HALF * BATCH  # samples that the second stage keeps
TURN_ROWS = TURN_WAIT + BATCH  # angles kept
FAST, SLOW = 0.125, 1.0  # s: time constants of IEC 61672-1
LATENCY = 88  # samples at RATE by which every pressure comes late: 1.72 ms
COMPONENTS = ("inner_ring", "outer_ring", "cage", "balls")
KINDS = ("radial", "axial", "rotation", "flexure", "balls")  # source types
RADIAL, AXIAL, ROTATION, FLEXURE, BALLS_KIND = range(len(KINDS))
BAND_LANES = 32  # lanes kept for the third octaves ``z.BANDS``: whole vectors

# --- head of ps -----------------------------------------------------------------------------------
_head = Places()
H_FORM = _head()  # how the channels are formed: see choices.CHANNEL_FORMS
H_BALLS = _head()  # number of balls
H_BALL_LANES = _head()  # the same, filled up to a multiple of FOUR
H_HARMONICS = _head()  # highest circumferential order of the balls (form contacts: of all sources)
H_FLEXURES = _head()  # number of flexural coordinates
H_RAW = _head()  # numbers of a motion sample that are decimated
H_CHANNELS = _head()  # number of channels
H_ROWS = _head()  # of the channel history
H_BANKS = _head()  # number of banks
H_SPANS = _head()  # block lengths of the convolution; 0: direct form
H_OUTPUTS = _head()  # number of filter outputs
H_SOURCES = _head()  # number of sources
H_MICS = _head()  # number of microphones
H_GROUPS = _head()  # number of groups of microphones
H_LANES = _head()  # A-weighting filters: form scalars one per filter output, others one per microphone
H_DETAILS = _head()  # switch: meters beyond the first `PLAIN` are kept
H_BANDS = _head()  # third octaves; 0: none
H_LINES = _head()  # most lines that a block of lines has; 0: sound is sampled
H_BEARINGS = _head()  # whose levels alone a block of lines keeps; 0: a single bearing's
H_DELAY = _head()  # s: by which the pressures of lines come late, beside their flight
# places in ps
H_AT_FIRST = _head()  # of the decimator
H_AT_SECOND = _head()
H_AT_HIGH_PASS = _head()
H_AT_A_WEIGHTING = _head()
H_AT_BANDS = _head()
H_AT_SCALARS = _head()
H_AT_LANES = _head()
H_AT_FORMED = _head()  # the same in the order in which the channels are formed
H_AT_BANKS = _head()
H_AT_SPANS = _head()
H_AT_SOURCES = _head()
H_AT_OUTPUTS = _head()
H_AT_GROUPS = _head()
H_AT_ORDER = _head()
H_AT_RESONATORS = _head()  # of accelerometers: RESONATOR numbers per output, then per sensor
H_AT_BOUNDS = _head()  # of lines: largest pressure per channel, by BOUND_NODES nodes: see `transfer.bound`
# places in ss
H_S_SECOND = _head()  # history of the decimator's second stage
H_S_TURNS = _head()  # cosines, then sines of the balls' angles, until their sample is in the middle
H_S_HIGH_PASS = _head()
H_S_CHANNELS = _head()  # channel history
H_S_A_WEIGHTING = _head()
H_S_METERS = _head()
H_S_RESONATORS = _head()  # of accelerometers
H_S_BANDS = _head()
H_S_LINES = _head()  # lines, `line_size` numbers each,
H_S_ALONE = _head()  # Pa2: mean squares of each bearing of a set alone,
H_S_MEANS = _head()  # Pa2: their mean squares, rows of microphones: see QUANTITIES,
H_S_BEATS = _head()  # and what close pairs of them add, `beat_size` numbers each
# places in ws
H_W_FORMED = _head()  # channels, a row per sample of a batch,
H_W_OUTPUTS = _head()  # outputs of the filters, the same
H_W_CHANNELS = _head()  # of one line: real, then imaginary parts, then first and last that is not zero
H_W_ROWS = _head()  # Pa: rows of microphones of one line: see `sound_lines`; real, then imaginary parts
H_W_PARTS = _head()  # the same of every line
H_W_INDEX = _head()  # of lines: see there
H_W_GAINS = _head()  # of filters at each line's frequency, squared
H_W_PHASES = _head()  # rad: of lines, then their cosines and sines
H_W_TURNS = _head()  # of beats
H_W_ANGLES = _head()  # of each bearing
H_W_LANES = _head()  # of one bank
H_W_WEIGHTED = _head()
H_W_SOURCES = _head()
H_W_METERS = _head()
H_W_SCRATCH = _head()
# sizes
H_STATE = _head()  # of ss
H_WORK = _head()  # of ws
HEAD_SIZE = _head.next

# --- tables in ps ---------------------------------------------------------------------------------
_gain = Places()
HIGH_PASS_GAIN = _gain()  # of what the slow part leaves
HIGH_PASS_FOLLOW = _gain()  # of the slow part's value, per sample
HIGH_PASS_STEER = _gain()  # of its slope
HIGH_PASS = _gain.next
HIGH_PASS_STATES = 2  # numbers kept per channel: value and slope of its slow part

# section of second order: (B0 + B1/z + B2/z2) / (1 + A1/z + A2/z2)
_section = Places()
B0 = _section()
B1 = _section()
B2 = _section()
A1 = _section()
A2 = _section()
SECTION = _section.next
SECTION_STATES = 2  # numbers that a section keeps per lane
A_SECTIONS = 3  # of A-weighting
BAND_SECTIONS = 4  # of a third octave

MAX_CHANNELS = 256  # side by side in one bank
MAX_FREQUENCIES = 520  # of one block, 512 samples long; real and imaginary sums lie this far apart

_bank = Places()
BANK_LANE = _bank()  # first lane
BANK_COUNT = _bank()  # number of lanes
BANK_DELAY = _bank()  # samples
BANK_TAPS = _bank()  # rows of the direct part
BANK_AT_TAPS = _bank()
BANK_RUNS = _bank()  # number of runs
BANK_AT_RUNS = _bank()
BANK_SIZE = _bank.next

_run = Places()
RUN_OUTPUT = _run()
RUN_COUNT = _run()  # number of lanes
RUN_SIZE = _run.next

_span = Places()
SPAN_BLOCK = _span()  # samples: block length
SPAN_WAIT = _span()  # samples from the end of a block of inputs until the outputs it serves begin
SPAN_STAGES = _span()  # number of the transform's stages: the block length is 2 to this power
SPAN_LANES = _span()  # number of lanes transformed
SPAN_SEGMENTS = _span()  # number of segments
SPAN_AT_SEGMENTS = _span()
SPAN_JOBS = _span()  # number of jobs: one of the first parts of each output, then the others
SPAN_AT_JOBS = _span()
SPAN_EARLY = _span()  # number of early units: transforms and first parts
SPAN_AT_SHARES = _span()  # per sample of a block the first unit of its work, then the number of units
SPAN_AT_TURNS = _span()  # cosines, then sines
SPAN_AT_PAST = _span()  # spectra of past inputs: PAST_SIZE numbers per lane
SPAN_S_TRANSFORM = _span()  # in ss: the transform under way
SPAN_S_SUMS = _span()  # in ss: spectra of the next outputs, see `sums_place`
SPAN_S_FUTURE = _span()  # in ss: the next block of outputs
SPAN_SIZE = _span.next

_segment = Places()
SEGMENT_LANE = _segment()  # first lane
SEGMENT_COUNT = _segment()  # number of lanes
SEGMENT_SIZE = _segment.next

_past = Places()
PAST_SLOTS = _past()  # blocks of inputs: as many as the lane's longest filter still needs
PAST_S_SPECTRA = _past()  # in ss: slot, real then imaginary, frequency
PAST_SIZE = _past.next

_job = Places()
JOB_SUMS = _job()  # place of its output among the span's sums
JOB_ADDS = _job()  # switch: to the sums of the jobs before; off: these begin
JOB_FILTERS = _job()  # number of filters
JOB_AT_FILTERS = _job()
JOB_SIZE = _job.next

_filter = Places()
FILTER_LANE = _filter()  # of the span
FILTER_BACK = _filter()  # blocks from the newest one back to that of its first part
FILTER_COUNT = _filter()  # number of parts
FILTER_AT = _filter()  # spectra of the parts
FILTER_SIZE = _filter.next

_source = Places()
SOURCE_COMPONENT = _source()  # see COMPONENTS
SOURCE_KIND = _source()  # see KINDS
SOURCE_SIZE = _source.next

_group = Places()
GROUP_FIRST = _group()  # first output
GROUP_COUNT = _group()  # number of outputs
GROUP_LANE = _group()  # first microphone's lane
GROUP_MICS = _group()  # number of microphones
GROUP_AT_WEIGHTS = _group()
GROUP_AT_RAYS = _group()  # paths to it, in a block of lines, in the order of their channels,
GROUP_AT_FIRST = _group()  # and the number of the first path of each channel, of all at the end
GROUP_FLIGHT = _group()  # s: taken out of their transfer functions
GROUP_SIZE = _group.next

_ray = Places()
RAY_CHANNEL = _ray()
RAY_OUTPUT = _ray()
RAY_FACTOR = _ray()
RAY_AT_NODES = _ray()
RAY_SIZE = _ray.next

NODE_STEP = 62.5  # Hz between the nodes of a transfer function, from zero on
NODES = 353  # up to 22 kHz,
BOUND_NODES = 16  # over so many a transfer function is bounded by its largest value
TOP = 2.0 * math.pi * NODE_STEP * (NODES - 1)  # rad/s
_node = Places()
NODE_REAL = _node()
NODE_IMAGINARY = _node()
NODE_REAL_SLOPE = _node()
NODE_IMAGINARY_SLOPE = _node()
NODE_SIZE = _node.next

_scalar = Places()
SCALAR_BALL = _scalar()  # m: D/4, eq. 19 of the multi-source paper
SCALAR_BODY = _scalar(3)  # m: half the outer radii of inner ring, outer ring, cage
SCALAR_SINE = _scalar()  # of the contact angle
SCALAR_COSINE = _scalar()
SCALAR_ORBIT = _scalar()  # m: pitch radius
SCALARS = _scalar.next

# --- channels -------------------------------------------------------------------------------------
# A motion sample is decimated as a raw row, and channels are formed of it at RATE. Form scalars: the row is
# the channels. Form vectors: channels of the bodies, accelerations of the balls (rows of ball lanes x r
# theta), flexural coordinates. Form contacts: two rows of ball lanes per family.
BODIES = 3  # inner ring, outer ring, cage
AXES = 3  # x y z; for balls x r theta

# Form vectors. The balls' harmonics are sums over all balls of acceleration times cos or sin(m theta).
_at = Places()
C_INNER = _at(AXES)  # m/s2: inner ring
C_OUTER = _at(AXES)  # outer ring
C_CAGE = _at(AXES)  # cage
TILTS = 2  # about y, about z
C_TILTS = _at(TILTS * BODIES)  # rad/s2: of the same bodies
C_BALLS = _at.next  # m/s2: harmonic 0, then per order m from 1 on a harmonic, then flexural coordinates

_mean = Places()  # harmonic 0
MEAN_X = _mean()  # m/s2
MEAN_R = _mean()
MEAN_SIZE = _mean.next

_harmonic = Places()  # harmonic m
HARMONIC_X_COS = _harmonic()  # m/s2
HARMONIC_X_SIN = _harmonic()
HARMONIC_R_COS = _harmonic()
HARMONIC_R_SIN = _harmonic()
HARMONIC_T_COS = _harmonic()
HARMONIC_T_SIN = _harmonic()
HARMONIC_SIZE = _harmonic.next
C_HARMONICS = C_BALLS + MEAN_SIZE  # harmonic 1

# Form scalars: rates of the multi-source paper's magnitudes.
_at = Places()
C_CYLINDERS = _at(BODIES)  # m/s2: across the axis
C_POINTS = _at(BODIES)  # m/s2: rotation
C_PISTONS = _at(BODIES)  # m/s2: along the axis
C_PAPER_BALLS = _at.next  # m/s2: two per ball
PAPER_BALL = 2  # sphere, point
SPEED_FLOOR = 1e-9  # m/s or rad/s in the root of |v|, so that its derivative exists at rest

# Form sensors: a raw row of what an outer ring does, of which each sensor's channels are weighted sums.
R_ACCELERATION = 0  # m/s2, along x y z
R_SPIN_RATE = AXES  # rad/s2, about x y z
R_FLEXURES = 2 * AXES  # m/s2: of the flexural coordinates of both rings

# Form contacts: per family the rates (m/s2) of normal velocity summed over the contacts: m = 0, then cos, sin
# per order m.
FAMILY_INNER = 0  # contacts of the inner ring
FAMILY_OUTER = 1  # contacts of the outer ring
FAMILY_CAGE = 2  # pockets of the cage
FAMILY_BALLS = 3  # balls
FAMILIES = 4
FAMILY_RATE = 0  # m/s2: rows of a family: rate of the normal velocity,
FAMILY_TURN = 1  # and normal velocity times the orbit's speed
FAMILY_ROWS = 2


def c_body(body: int, axis: int = 0) -> int:
    """Channel of a body's acceleration along x (0), y (1) or z (2); see `BODIES`."""
    return C_INNER + AXES * body + axis


def c_tilt(body: int, axis: int) -> int:
    """Channel of a body's angular acceleration about y (0) or z (1)."""
    return C_TILTS + TILTS * body + axis


def c_ball(order: int, axis: int) -> int:
    """Channel of the balls' acceleration along x (0), r (1) or theta (2) times cos(order theta).

    The one with the sine is the next; order 0 has neither sine nor theta.
    """
    return C_BALLS + axis if order == 0 else C_HARMONICS + HARMONIC_SIZE * (order - 1) + 2 * axis


def c_flex(harmonics: int) -> int:
    """First flexural channel of form vectors with the balls' circumferential orders 0 .. harmonics."""
    return C_HARMONICS + HARMONIC_SIZE * harmonics


def formed(form: int, harmonics: int, channels: int) -> list[int]:
    """Return the channels in the order in which the engine forms them.

    Form vectors gives the balls' harmonics row by row: all orders with the cosine along x, then with the
    sine, then along r and theta.
    """
    order = list(range(channels))
    if form == VECTORS:
        inside = [HARMONIC_SIZE * m + i for i in range(HARMONIC_SIZE) for m in range(harmonics)]
        order[C_HARMONICS : c_flex(harmonics)] = [C_HARMONICS + place for place in inside]
    return order


def vector_channels(harmonics: int, flexures: int = 0) -> int:
    """Count of channels of form vectors with ``flexures`` flexural coordinates."""
    return c_flex(harmonics) + flexures


def vector_row(lanes: int, flexures: int = 0) -> int:
    """Numbers of a raw row of form vectors; ``lanes``: of the balls."""
    return C_BALLS + AXES * lanes + flexures


def contact_row(lanes: int) -> int:
    """Numbers of a raw row of form contacts; ``lanes``: of the balls."""
    return FAMILIES * FAMILY_ROWS * lanes


def scalar_channels(n_balls: int) -> int:
    """Count of channels of form scalars."""
    return C_PAPER_BALLS + PAPER_BALL * n_balls


def family_size(harmonics: int) -> int:
    """Channels of one family of contacts."""
    return 1 + 2 * harmonics


def contact_channels(harmonics: int) -> int:
    """Count of channels of form contacts."""
    return FAMILIES * family_size(harmonics)


# --- state ss -------------------------------------------------------------------------------------
_at = Places()
SS_RAW = _at()  # motion samples so far
SS_COUNT = _at()  # samples at RATE so far
SS_METERED = _at()  # of which metered
SS_WEIGHT = _at()  # sum of weights of the exponential meter with the chosen time constant,
SS_FAST = _at()  # Fast,
SS_SLOW = _at()  # and Slow
SS_LINES = _at()  # how many lines there are,
SS_BEATS = _at()  # and beats between them
SS_TABLES = _at.next  # history of the decimator's first stage begins here

# Third octaves of one microphone: states of each section, then running mean squares.
_at = Places()
BAND_STATE = _at(SECTION_STATES * BAND_SECTIONS * BAND_LANES)  # Pa
BAND_MEAN = _at(BAND_LANES)  # Pa2
BAND_SIZE = _at.next

# Meters: one row per name of ``z.MIC_OUTPUTS``, one lane per microphone.
M_PRESSURE = _Z.MIC_OUTPUTS.index("pressure")  # Pa
M_LEVEL = _Z.MIC_OUTPUTS.index("spl")  # Pa2: running mean squares, chosen time constant,
M_LEVEL_A = _Z.MIC_OUTPUTS.index("spl_a")  # A-weighted
M_SUM = _Z.MIC_OUTPUTS.index("leq")  # Pa2: sums of squares,
M_SUM_A = _Z.MIC_OUTPUTS.index("leq_a")  # A-weighted
M_PART = _Z.MIC_OUTPUTS.index("spl_inner_ring")  # Pa2: running mean squares of the components
M_FAST = _Z.MIC_OUTPUTS.index("spl_fast")  # Pa2: with other time constants
M_FAST_A = _Z.MIC_OUTPUTS.index("spl_fast_a")
M_SLOW = _Z.MIC_OUTPUTS.index("spl_slow")
M_SLOW_A = _Z.MIC_OUTPUTS.index("spl_slow_a")
M_ENERGY = _Z.MIC_OUTPUTS.index("spl_energy_sum")  # Pa2: energy sum over the components
M_KIND = _Z.MIC_OUTPUTS.index("spl_radial")  # Pa2: source types but the kind "balls", which is a component
METERS = _Z.PER_MIC
PLAIN = M_FAST  # meters that every scene has


# Accelerometers: all-pole sections 1 / (1 + A1/z + A2/z2), and meters, rows of one lane per sensor.
RESONATOR = 2  # numbers of a section, and of its state
_at = Places()
A_LAST = _at()  # m/s2
A_SUM = _at()  # sums of the first to fourth power
A_SQUARE = _at()
A_CUBE = _at()
A_FOURTH = _at()
A_PEAK = _at()  # m/s2
A_METERS = _at.next


def sums_place(output: int, block: int) -> int:
    """Place of an output's real sums in those of a span: as many as there is room for, then the imaginary."""
    side = MAX_FREQUENCIES // (block + 1)
    return output // side * 2 * MAX_FREQUENCIES + output % side * (block + 1)


def state_size(ps) -> int:
    """Length of ``ss`` for the sound parameters ``ps`` (0 without sound)."""
    return int(ps[H_STATE]) if len(ps) else 0


def work_size(ps) -> int:
    """Length of ``ws`` for the sound parameters ``ps`` (0 without sound)."""
    return int(ps[H_WORK]) if len(ps) else 0
