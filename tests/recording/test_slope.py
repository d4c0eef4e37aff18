"""The rise of the level with speed follows the exponent of the surfaces."""

import numpy as np
import pytest

from fmu_bearing import record
from fmu_bearing.scene.read import with_fidelity

SPEEDS = np.geomspace(3000.0, 30000.0, 13)  # seven leave the slope for p = 2 to which lines meet a mode: 26.9
SEEDS = range(8)
ASIDE = [(0.0, 0.105, 0.0)]


def level(scene, rpm, seed, exponent):
    """Level aside of the bearing; waves of the races alone, all that is audible."""
    flaws = scene.imperfections.model_copy(
        update={
            "seed": seed,
            "waviness_exponent": exponent,
            "contact_filter": False,
            "highest_frequency_kHz": 20.0,  # up to order 476 at 3,000 r/min: higher ones sound above 20 kHz
            "unbalance_um": 0.0,
            "ball_diameter_spread_nm": 0.0,
            "ball_form_nm": 0.0,
        }
    )
    operation = scene.operation.model_copy(update={"speed_rpm": float(rpm)})
    changed = scene.model_copy(update={"imperfections": flaws, "operation": operation})
    made = record(
        with_fidelity(changed, model="response"), 0.05, settle=0.02, step=4e-3, progress=False, warn=False,
        radiation_model="compact", outputs=(),
    )  # fmt: skip
    return made.levels(ASIDE)[0]


@pytest.mark.heavy
@pytest.mark.filterwarnings("ignore:the fastest wave")
@pytest.mark.parametrize("exponent", [1.0, 2.0])
def test_level_rises_by_20_p_minus_10_per_decade(example, exponent):
    """A wave of order n meets a mode at the speed f / n: its square is n^-2p, and lines lie f_r apart.

    So the mean square goes as (f / f_r)^-2p / f_r, 20 p - 10 dB per decade. Which lines meet the modes, and
    the balls' centrifugal force, move single speeds by some decibels: hence 3 dB, over a decade, on the
    median of eight seeds.
    """
    bare = example("7003C-bare")
    levels = [np.median([level(bare, rpm, seed, exponent) for seed in SEEDS]) for rpm in SPEEDS]
    slope = np.polyfit(np.log10(SPEEDS), levels, 1)[0]
    assert slope == pytest.approx(20.0 * exponent - 10.0, abs=3.0)
