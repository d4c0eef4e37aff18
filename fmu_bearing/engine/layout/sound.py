"""Places in the sound blocks: parameters ``ps``, state ``ss``, work ``ws``; rates and sizes of the filters.

``ps`` begins with a head (``H_*``: sizes, then offsets into ``ps``, ``ss`` and ``ws``), followed by tables:

* decimator, ``DECIMATOR_TAPS`` numbers, symmetric; high-pass b0 b1 b2 a1 a2; A-weighting 3 x (b0 b1 b2 a1
  a2); third octaves: 4 sections x (b0 b1 b2 a1 a2) x ``BAND_LANES`` bands;
* scalars that the paper rungs need to form their channels;
* lane of each channel in the history: channels that the same microphones hear lie side by side, the unheard
  last;
* banks, ``BANK_SIZE`` numbers each: runs of neighbouring lanes, filtered side by side;
* taps of the direct part: per bank ``BANK_TAPS`` rows (a multiple of 4) of one number per lane, newest
  sample first; then runs (output, count) of neighbouring lanes that add to one output;
* levels of the partitioned convolution, ``LEVEL_SIZE`` numbers each, with their tables of cosines and
  sines, their segments (first lane, count: the lanes they transform) and their filters, ``FILTER_SIZE``
  numbers each, in the order of their outputs, with the spectra of their parts: part, real then imaginary,
  frequency;
* sources: component and kind of each, and the source of each output;
* groups of microphones, ``GROUP_SIZE`` numbers each, with weights: one row of microphones per output;
* for each microphone of the scene its lane: microphones of a group lie side by side.

Microphones on one circle about the bearing axis share their filters: a body of revolution sounds the same
all round, up to cos(m phi) and sin(m phi), which are the weights.
"""

RAW_RATE = 204_800.0  # Hz, of motion samples
DECIMATION = 4
RATE = RAW_RATE / DECIMATION  # Hz, of pressures and meters
DECIMATOR_TAPS = 64
LATENCY = 24  # samples at RATE by which every pressure comes late: 0.47 ms
COMPONENTS = ("inner_ring", "outer_ring", "cage", "balls")
KINDS = ("radial", "axial", "rotation", "flexure", "balls")  # source types
RADIAL, AXIAL, ROTATION, FLEXURE, BALLS_KIND = range(5)
# How the engine forms the channels: printed scalars; accelerations (compact, bem, table, paper_vector);
# volume velocities at the contact points.
RUNG_PAPER, RUNG_VECTORS, RUNG_CONTACTS = 1, 2, 3
BAND_LANES = 32  # lanes kept for the third octaves ``z.BANDS``: whole vectors

# --- head of ps ---------------------------------------------------------------------------------
(
    H_RUNG,
    H_BALLS,
    H_HARMONICS,  # highest circumferential order of the balls (contacts: of all sources)
    H_FLEXURES,  # count of flexural coordinates
    H_CHANNELS,
    H_ROWS,  # of the channel history
    H_BANKS,
    H_LEVELS,  # of the partitioned convolution; 0: direct form
    H_OUTPUTS,  # filter outputs
    H_SOURCES,
    H_MICS,
    H_GROUPS,
    H_LANES,  # A-weighting filters: paper one per filter output, others one per microphone
    H_DETAILS,  # switch: meters beyond the first `PLAIN` are kept
    H_BANDS,  # third octaves; 0: none
    H_AT_DECIMATOR,
    H_AT_HIGH_PASS,
    H_AT_A_WEIGHTING,
    H_AT_BANDS,
    H_AT_SCALARS,
    H_AT_LANES,
    H_AT_BANKS,
    H_AT_LEVELS,
    H_AT_SOURCES,
    H_AT_OUTPUTS,
    H_AT_GROUPS,
    H_AT_ORDER,
    H_S_HIGH_PASS,  # offsets into ss
    H_S_CHANNELS,
    H_S_A_WEIGHTING,
    H_S_METERS,
    H_S_BANDS,
    H_W_OUTPUTS,  # offsets into ws
    H_W_LANES,  # of one bank
    H_W_WEIGHTED,
    H_W_SOURCES,
    H_W_METERS,
    H_W_TRANSFORM,
    H_STATE,  # sizes
    H_WORK,
) = range(40)
HEAD_SIZE = 40

MAX_CHANNELS = 256  # side by side in one bank
MAX_FREQUENCIES = 520  # of one block, 512 samples long: real and imaginary sums lie this far apart
(BANK_LANE, BANK_COUNT, BANK_DELAY, BANK_TAPS, BANK_AT_TAPS, BANK_RUNS, BANK_AT_RUNS) = range(7)
BANK_SIZE = 7
(
    LEVEL_BLOCK,
    LEVEL_SLOTS,
    LEVEL_LANES,
    LEVEL_SEGMENTS,
    LEVEL_AT_SEGMENTS,
    LEVEL_FILTERS,
    LEVEL_AT_FILTERS,
    LEVEL_AT_TURNS,
    LEVEL_S_SPECTRA,  # lane of the level, slot, real then imaginary, frequency
    LEVEL_S_FUTURE,
) = range(10)
LEVEL_SIZE = 10
FILTER_LANE, FILTER_OUTPUT, FILTER_FIRST, FILTER_COUNT, FILTER_AT = range(5)  # first part, parts
FILTER_SIZE = 5
GROUP_FIRST, GROUP_COUNT, GROUP_LANE, GROUP_MICS, GROUP_AT_WEIGHTS = range(5)  # outputs, then microphones
GROUP_SIZE = 5

# --- channels of the vector rungs: accelerations x y z of inner ring, outer ring, cage; angular
# accelerations about y, z of the same; the balls' sums over cos(m theta), sin(m theta): x r for m = 0, then
# per m: x cos, x sin, r cos, r sin, t cos, t sin; then flexural coordinates.
C_INNER, C_OUTER, C_CAGE, C_TILTS, C_BALLS = 0, 3, 6, 9, 15

# --- channels of rung paper: cylinders of inner ring, outer ring, cage; their points; their pistons; then
# per ball: ball, point.
C_CYLINDERS, C_POINTS, C_PISTONS, C_PAPER_BALLS = 0, 3, 6, 9
SPEED_FLOOR = 1e-9  # m/s or rad/s in the root of |v|, so that its derivative exists at rest

# --- channels of rung paper_contacts: per family (contacts of the inner ring, of the outer ring, pockets of
# the cage, balls) the rates of normal velocity summed over the contacts: m = 0, then cos, sin per order m.
FAMILIES = 4

# --- scalars --------------------------------------------------------------------------------------
SCALAR_BALL = 0  # eq. 19: D/4, then half the radii of inner ring, outer ring, cage
SCALAR_SINE = 4  # of the contact angle
SCALAR_COSINE = 5
SCALAR_ORBIT = 6  # m: pitch radius
SCALARS = 7


def c_flex(harmonics: int) -> int:
    """First flexural channel of the vector rungs with the balls' circumferential orders 0 .. harmonics."""
    return C_BALLS + 2 + 6 * harmonics


def vector_channels(harmonics: int, flexures: int = 0) -> int:
    """Count of channels of the vector rungs with ``flexures`` flexural coordinates."""
    return c_flex(harmonics) + flexures


def paper_channels(n_balls: int) -> int:
    """Count of channels of the paper rung."""
    return C_PAPER_BALLS + 2 * n_balls


def contact_channels(harmonics: int) -> int:
    """Count of channels of the rung paper_contacts."""
    return FAMILIES * (1 + 2 * harmonics)


# --- state ss -------------------------------------------------------------------------------------
SS_RAW = 0  # motion samples so far
SS_COUNT = 1  # samples at RATE so far
SS_METERED = 2  # of which metered
SS_WEIGHT = 3  # sum of weights of the exponential meter: of the chosen time constant, Fast, Slow
SS_FAST = 4
SS_SLOW = 5
SS_TABLES = 6  # history of the decimator begins here

# Meters: one row per name of ``z.MIC_OUTPUTS``, one lane per microphone.
(
    M_PRESSURE,
    M_LEVEL,
    M_LEVEL_A,
    M_SUM,
    M_SUM_A,
    M_PART,  # four components
) = range(6)
PLAIN = M_PART + len(COMPONENTS)  # meters that every scene has
M_FAST, M_FAST_A, M_SLOW, M_SLOW_A, M_ENERGY, M_KIND = range(PLAIN, PLAIN + 6)
METERS = M_KIND + len(KINDS) - 1  # the kind "balls" is the component


def state_size(ps) -> int:
    """Length of ``ss`` for the sound parameters ``ps`` (0 without sound)."""
    return int(ps[H_STATE]) if len(ps) else 0


def work_size(ps) -> int:
    """Length of ``ws`` for the sound parameters ``ps`` (0 without sound)."""
    return int(ps[H_WORK]) if len(ps) else 0
