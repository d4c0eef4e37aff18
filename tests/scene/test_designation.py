"""Misspelt and short names: which entries of a catalogue are suggested."""

import pytest

from fmu_bearing.scene.designation import suggestion
from fmu_bearing.scene.entries import entries
from fmu_bearing.scene.nsk import sizes


@pytest.mark.parametrize(
    ("wanted", "words"),
    [
        ("7010C", "did you mean 'NSK-7010C'? "),  # letters alone would say 7009C
        ("7010", "did you mean 'NSK-7010C' or 'NSK-7010AC'? "),
        ("NSK 7010 c", "did you mean 'NSK-7010C'? "),
        ("NKS-7009C", "did you mean 'NSK-7009C'? "),
        ("7009", "did you mean '7009C'? "),  # no maker is asked for
        ("7003D", "did you mean '7003C'? "),
        ("71910C", "did you mean 'NSK-7910C'? "),  # series 719 and 79 have equal dimensions
        ("7010CD/P4A", "did you mean 'NSK-7010C'? "),
        ("B7010-A5", "did you mean 'NSK-7010AC'? "),
        ("7020C", "the nearest in size is 'NSK-7014C'; "),
        ("NSK-701C", "did you mean 'NSK-7901C'? "),  # no size in it: by letters
        ("honey", ""),
    ],
)
def test_bearings_are_suggested_by_size_and_maker(wanted, words):
    assert suggestion(wanted, entries("bearings")) == words


def test_each_size_is_found_without_its_maker():
    """Of the papers' sizes the papers' own bearing, which has no maker."""
    known = entries("bearings")
    for name in known.keys() & sizes().keys():
        short = name.removeprefix("NSK-")
        if short not in known:
            assert suggestion(short, known) == f"did you mean '{name}'? "


def test_other_names_are_suggested_by_their_letters():
    known = entries("materials")
    assert suggestion("si3n", known) == "did you mean 'Si3N4'? "
    assert suggestion("7010C", known) == "" == suggestion("7010C", [])
    assert suggestion("own-7008c", ["my-7008C", "7003C"]) == "did you mean 'my-7008C'? "
