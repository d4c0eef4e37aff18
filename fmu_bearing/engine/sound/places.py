"""Places in the sound blocks: parameters ``ps``, state ``ss``, work ``ws``; rates and sizes of the filters.

``ps`` begins with a head (``H_*``: sizes, then offsets into ``ps`` itself), followed by tables:

* decimator, ``DECIMATOR_TAPS`` numbers, symmetric; high-pass b0 b1 b2 a1 a2; A-weighting 3 x (b0 b1 b2 a1
a2);
* scalars of the paper's eq. 19: D/4, then half the radii of inner ring, outer ring, cage;
* banks, ``BANK_SIZE`` numbers each: runs of neighbouring channels with one delay, filtered side by side;
* taps: per bank ``BANK_TAPS`` rows (a multiple of 4) of one number per channel, newest sample first;
* component of each filter output (0 inner ring, 1 outer ring, 2 cage, 3 balls);
* microphones, ``MIC_SIZE`` numbers each, and their weights.

Microphones on one circle about the bearing axis share their filters: a body of revolution sounds the same
all round, up to cos(m phi) and sin(m phi), which are the weights.
"""

RAW_RATE = 204_800.0  # Hz, of motion samples
DECIMATION = 4
RATE = RAW_RATE / DECIMATION  # Hz, of pressures and meters
DECIMATOR_TAPS = 64
LATENCY = 24  # samples at RATE by which every pressure comes late: 0.47 ms
COMPONENTS = ("inner_ring", "outer_ring", "cage", "balls")
RUNG_PAPER, RUNG_COMPACT = 1, 2

# --- head of ps ---------------------------------------------------------------------------------
(
    H_RUNG,
    H_BALLS,
    H_HARMONICS,  # compact: highest circumferential order of the balls
    H_CHANNELS,
    H_ROWS,  # of the channel history
    H_BANKS,
    H_OUTPUTS,  # filter outputs of all banks
    H_MICS,
    H_LANES,  # A-weighting filters: paper one per filter output, compact one per microphone
    H_AT_DECIMATOR,
    H_AT_HIGH_PASS,
    H_AT_A_WEIGHTING,
    H_AT_SCALARS,
    H_AT_BANKS,
    H_AT_COMPONENTS,
    H_AT_MICS,
) = range(16)
HEAD_SIZE = 16

BANK_CHANNEL, BANK_COUNT, BANK_DELAY, BANK_TAPS, BANK_OUTPUT, BANK_AT_TAPS = range(6)
BANK_SIZE = 6
MIC_FIRST, MIC_COUNT, MIC_AT_WEIGHTS = range(3)  # run of filter outputs that belong to the microphone
MIC_SIZE = 3

# --- channels of rung compact: accelerations x y z of inner ring, outer ring, cage; then the balls' sums
# over cos(m theta), sin(m theta): x r for m = 0, then per m: x cos, x sin, r cos, r sin, t cos, t sin.
C_INNER, C_OUTER, C_CAGE, C_BALLS = 0, 3, 6, 9

# --- channels of rung paper: cylinders of inner ring, outer ring, cage; their points; their pistons; then
# per ball: ball, point.
C_CYLINDERS, C_POINTS, C_PISTONS = 0, 3, 6
SPEED_FLOOR = 1e-9  # m/s or rad/s in the root of |v|, so that its derivative exists at rest


def compact_channels(harmonics: int) -> int:
    """Count of channels of the compact rung with the balls' circumferential orders 0 .. ``harmonics``."""
    return C_BALLS + 2 + 6 * harmonics


def paper_channels(n_balls: int) -> int:
    """Count of channels of the paper rung."""
    return C_BALLS + 2 * n_balls


# --- state ss -------------------------------------------------------------------------------------
SS_RAW = 0  # motion samples so far
SS_COUNT = 1  # samples at RATE so far
SS_METERED = 2  # of which metered
SS_WEIGHT = 3  # sum of the exponential meter's weights, 1 after long
SS_TABLES = 4

# Meters of one microphone.
(
    M_PRESSURE,
    M_FAST,
    M_FAST_A,
    M_SUM,
    M_SUM_A,
    M_PART,  # four components
) = range(6)
METER_SIZE = M_PART + len(COMPONENTS)


def state_size(ps) -> int:
    """Length of ``ss`` for the sound parameters ``ps`` (0 without sound)."""
    if len(ps) == 0:
        return 0
    channels = int(ps[H_CHANNELS])
    histories = channels * (DECIMATOR_TAPS + 2 + int(ps[H_ROWS]))
    return SS_TABLES + histories + 6 * int(ps[H_LANES]) + METER_SIZE * int(ps[H_MICS])


def work_size(ps) -> int:
    """Length of ``ws`` for the sound parameters ``ps`` (0 without sound)."""
    if len(ps) == 0:
        return 0
    return int(ps[H_CHANNELS]) + int(ps[H_OUTPUTS]) + int(ps[H_LANES]) + 8 * int(ps[H_MICS])
