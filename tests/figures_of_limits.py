"""Sentences of the pages on limits and fidelities whose figures come from the tables under docs/results."""

from tests.figures_of_settled import limits_of_settled
from tests.tables import (
    CASES,
    critical_speed,
    fastest,
    moved,
    rounded,
    row,
    scene_line,
    settings_of,
    table,
    up,
    usual,
)


def limits():
    """What rests on assumed values, settled runs, three balls."""
    yield from _rests_on_assumed_values()
    yield from limits_of_settled()
    yield f"peaks ({critical_speed()} r/min) is an input, not a prediction"
    gap = row("three_balls", case="in contact, 0.5 m/s, Hertz")
    paper = float(row("three_balls", case="measured, ref. [24]")["paper"])
    rigid, elastic, without = (
        f"{100.0 * (1.0 - float(gap[key]) / paper):.0f} %"
        for key in ("rigid max", "elastic max", "no scattering, max")
    )
    yield (
        f"in the three-ball test {rigid} (rigid) and {elastic} (elastic) below the measurement with "
        f"scattering, {without} without"
    )


def response_limits():
    """Levels beside those of rings."""
    spindle = [scene_line("7003C-spindle", "20,000", fidelity) for fidelity in ("rings", "response")]
    apart = max(abs(float(spindle[0][key]) - float(spindle[1][key])) for key in _LEVELS)
    yield f"On the 7003C's spindle at 20,000 r/min its levels lie within {up(apart)} dB(A) of `rings`"


def full_limits():
    """Speed of full, its goals, heavy radial load."""
    yield from _loads_and_goals()
    settled = [usual(case)[0] for case in CASES if not ("first" in case or "example" in case)]
    free = [float(one["sim/CPU"]) for one in settled if "radial" not in one["case"]]
    loaded = [float(one["sim/CPU"]) for one in settled if "radial" in one["case"]]
    yield f"runs at {min(free):.1f} to {max(free):.1f} simulated seconds per second of the processor"
    yield f"at {min(loaded):.1f} to {max(loaded):.1f} under radial loads of 1000 and 300 N"


_LEVELS = "loudest, dB(A)", "quietest, dB(A)"


def _rests_on_assumed_values():
    """Contact damping, friction torque, seed."""
    inner, torque, sound = "inner ring rms, %", "friction torque, %", "sound, dB(A)"
    less = [moved("bearing.contact_damping_us", "2", key) for key in (inner, sound)]
    yield (
        f"20 % less damping makes ring vibration {less[0]:.0f} % larger and the level "
        f"{less[1]:.1f} dB(A) higher"
    )
    most = [
        max(
            abs(float(one[torque])) for one in table("sensitivity") if one["parameter"] == f"lubricant.{name}"
        )
        for name in ("density_kg_m3", "viscosity_Pa_s", "land_viscosity_Pa_s")
    ]
    yield (
        f"It depends on oil density (20 %: {most[0]:.0f} %), viscosity (20 %: {most[1]:.0f} %) and the "
        f"viscosity between cage and lands (20 %: {most[2]:.0f} %)"
    )
    steep = [moved("imperfections.waviness_exponent", to, sound) for to in ("1", "1.6")]
    yield (
        "from 1.0 to 1.6 move the level of the 7003C's spindle at 20,000 r/min by another "
        f"{steep[0] - steep[1]:.0f} dB(A)"
    )
    drawn = [[abs(moved("imperfections.seed", seed, key)) for seed in ("0", "2")] for key in (inner, sound)]
    yield f"two seeds differ by up to {max(drawn[0]):.0f} % in ring rms and {max(drawn[1]):.1f} dB(A)"


def rings_limits():
    """What steps of rings cost."""
    rings = [one for one in table("band") if one["fidelity"] == "rings"]
    level = max(float(one[key]) for one in rings for key in ("quarter steps: dB", "dB(A)"))
    octave = max(float(one["third octaves, dB"]) for one in rings)
    yield (
        "With quarter steps the levels on the 7003C's spindle move by at most "
        f"{level:.2f} dB, third octaves by at most {octave:.2f} dB"
    )


def band():
    """What the band of excitation gives."""
    apart = {
        key: max(
            abs(float(one[key]) - float(row("band", **{"r/min": one["r/min"], "band, kHz": "20",
                                                       "fidelity": one["fidelity"]})[key]))
            for one in table("band")
            if one["band, kHz"] == "2.5"
        )
        for key in _LEVELS
    }  # fmt: skip
    yield (
        f"on the spindle 2.5 kHz read within {apart[_LEVELS[0]]:.1f} dB(A) of 20 kHz at the loudest "
        f"microphone, and up to {apart[_LEVELS[1]]:.1f} dB(A) less at the quietest"
    )


def _loads_and_goals():
    """How far the goals of full were missed; what a tolerance costs under a heavy load."""
    settled = [usual(case)[0] for case in CASES if not ("first" in case or "example" in case)]
    goals = [(float(one["sim/CPU"]), float(one["goal"])) for one in settled]
    missed = [100.0 * (1.0 - speed / goal) for speed, goal in goals if speed < goal]
    least, most = (f"{bound([goal for _, goal in goals]):g}" for bound in (min, max))
    yield (
        f"The goals of {least} to {most} were missed by {min(missed):.0f} to {max(missed):.0f} % in "
        f"{len(missed)} of {len(goals)} cases"
    )
    case = "7003C-spindle 20,000 r/min, 1000 N radial"
    coarse, finer = usual(case)[0], fastest(case)
    tolerance, longest = settings_of(finer)
    share = float(finer["sim/CPU"]) / float(coarse["sim/CPU"])
    yield (
        f"under 1000 N on the 7003C's spindle the error is {rounded(coarse['error'])} even at a tolerance of "
        "1e-3"
    )
    yield (
        f"`tolerance = {tolerance}` with steps up to {longest} us ({rounded(finer['error'])}), "
        f"at {share:.2f} of the speed"
    )
