"""Sentences on runs of `full` beside the operating point, made from their table."""

from tests.tables import table


def _of(support, *verdicts):
    """Rows with or without a tilt support that have one of the verdicts."""
    return [one for one in table("settled") if one["tilt support"] == support and one["verdict"] in verdicts]


def _ratios(rows):
    return [float(one[key]) for one in rows for key in ("ratio", "ratio from elsewhere")]


def _off(rows, *keys):
    """Largest difference from 1 in per cent."""
    return 100.0 * max(abs(float(one[key]) - 1.0) for one in rows for key in keys)


_TORQUE, _CAGE = ("ratio", "ratio from elsewhere"), ("cage speed", "cage speed from elsewhere")


def _one(bearing, support):
    (found,) = (
        one for one in table("settled") if (one["bearing"], one["tilt support"]) == (bearing, support)
    )
    return found


def settled():
    """How many bearings agree, and what those that are off do."""
    every = len(table("settled")) // 2
    yield f"has {every} bearings"
    speeds = [float(one["n d_m, 1e6"]) for one in table("settled")]
    yield f"n d_m of {min(speeds):.2f} to {max(speeds):.2f} million mm r/min"
    good, named, weight = (_of("yes", one) for one in ("agrees", "named", "weight"))
    assert not any(one["growth, 1/s"] for one in good) and not _of("yes", "other", "unsteady", "missed")
    yield (
        f"{len(good)} of {every} points agree with both runs within {_off(good, *_TORQUE):.1f} % in torque "
        f"and {_off(good, *_CAGE):.2f} % in cage speed"
    )
    growths = [float(one["growth, 1/s"]) for one in named]
    yield (
        f"Of {len(named)} the point names a ring that whirls by itself, with {min(growths):.0f} to "
        f"{max(growths):.0f} 1/s"
    )
    yield f"{min(_ratios(named)):.3f} to {max(_ratios(named)):.3f} of the point's"
    two = [_one(name, "yes") for name in ("NSK-7904AC", "NSK-7913AC")]
    assert not two[0]["growth, 1/s"] and two[1]["growth, 1/s"]
    yield (
        f"stays within {_off(two, 'ratio'):.1f} %, from elsewhere it comes to "
        f"{two[0]['ratio from elsewhere']} (NSK-7904AC, no whirl is named) and "
        f"{two[1]['ratio from elsewhere']} (NSK-7913AC)"
    )
    (heavy,) = [one for one in weight if one["bearing"] != "NSK-7904AC"]
    yield f"1 is off by its weight without a word: the {heavy['bearing']}, {heavy['ratio']}"
    yield f"in runs without weight the ratio is {heavy['ratio without weight']}"
    narrow = _one("NSK-7012C", "yes")
    yield f"The same takes {_off([narrow], 'ratio'):.1f} % from the {narrow['bearing']}"
    good, named, other = (_of("no", one) for one in ("agrees", "named", "other"))
    (slow,) = _of("no", "weight")
    assert not _of("no", "unsteady", "missed")
    quiet = [one for one in good if not one["growth, 1/s"]]
    yield (
        f"{len(good)} of {every} agree within 2 %, the {len(quiet)} of them without a named whirl within "
        f"{_off(quiet, *_TORQUE):.1f} %"
    )
    off = [ratio for ratio in _ratios(named) if abs(ratio - 1.0) > 0.02]
    yield f"{len(named)} are off and turn as the point names it, at {min(off):.3f} to {max(off):.3f}"
    turns = ", ".join(f"{one['bearing']} {one['at, Hz']} and {one['turns at, Hz']}" for one in other)
    low, high = min(_ratios(other)), max(_ratios(other))
    yield f"{len(other)} are named, but turn otherwise, at {low:.3f} to {high:.3f}"
    yield f"Named and turning, Hz: {turns}"
    yield (
        f"1 has two steady motions and names none: the {slow['bearing']}, {slow['ratio']} from the point and "
        f"{slow['ratio from elsewhere']} from elsewhere"
    )
    calm = [one for one in table("settled") if not one["growth, 1/s"]]
    yield (
        f"where no whirl is named runs from the point are off by {_off(calm, 'ratio'):.1f} % at most, those "
        f"from elsewhere by {_off(calm, 'ratio from elsewhere'):.1f} %"
    )


def limits_of_settled():
    """Two steady motions, rings that whirl."""
    two = _off([_one("NSK-7913AC", "yes")], "ratio from elsewhere")
    yield f"by {two:.0f} % (NSK-7913AC, 19,400 r/min, 200 N)"
    off = _ratios([one for support in ("yes", "no") for one in _of(support, "named", "other")])
    yield f"In the same table `full` has {min(off):.3f} to {max(off):.3f} of its torque"
