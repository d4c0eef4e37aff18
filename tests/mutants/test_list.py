"""The list of mutants fits the sources and the tests as they are."""

import ast

import pytest

from tests.mutants.draw import places
from tests.mutants.entries import ROOT, mutants, text_of
from tests.mutants.schemata import woven

EVERY = mutants()


@pytest.mark.lint
def test_texts_are_there_once_and_what_takes_their_place_is_another_program():
    for one in EVERY:
        source = (ROOT / one.file).read_text("utf-8")
        assert source.count(one.old) == 1, f"{one.id}: {source.count(one.old)} times in {one.file}: {one.old}"
        other = ast.parse(source.replace(one.old, one.new))
        assert ast.dump(other) != ast.dump(ast.parse(source)), f"{one.id} changes nothing"


def test_names_are_unique():
    names = [one.id for one in EVERY]
    assert len(set(names)) == len(names)


def test_killers_are_tests_that_are_there():
    for one in EVERY:
        for killer in one.killers:
            file, _, name = killer.partition("::")
            function = name.split("[")[0].rpartition("::")[2]
            assert f"def {function}(" in (ROOT / file).read_text("utf-8"), f"{one.id}: no {killer}"


def test_each_is_killed_or_says_why_it_lives():
    for one in EVERY:
        assert bool(one.killers) != bool(one.alive), one.id


def test_all_mutants_of_the_engine_can_be_chosen_in_one_copy():
    there = [(number, one) for number, one in enumerate(EVERY, 1) if one.engine]
    for file in {one.file for _, one in there}:
        entries = [(number, one) for number, one in there if one.file == file]
        asked = woven((ROOT / file).read_text("utf-8"), entries)
        for number, _ in entries:
            assert f"mutant({number})" in asked


def test_a_mutation_is_one_operator_at_one_place():
    source = "def f(x, p):\n    if x[0] < 2.0:\n        return -x[1] * p**2\n    return x[1] - 3.0\n"
    found = {(kind, source[:begin] + new + source[end:]) for kind, begin, end, new in places(source)}
    changed = {
        (kind, line)
        for kind, other in found
        for line, old in zip(other.splitlines(), source.splitlines(), strict=True)
        if line != old
    }
    assert changed == {
        ("index", "    if x[1] < 2.0:"),
        ("factor", "    if x[0] < 2.2:"),
        ("boundary", "    if x[0] <= 2.0:"),
        ("comparison", "    if x[0] > 2.0:"),
        ("sign", "        return x[1] * p**2"),
        ("index", "        return -x[0] * p**2"),
        ("factor", "        return -x[1] / p**2"),
        ("exponent", "        return -x[1] * p**3"),
        ("index", "    return x[0] - 3.0"),
        ("sign", "    return x[1] + 3.0"),
        ("factor", "    return x[1] - 3.3"),
    }


@pytest.mark.parametrize("new", ["+", "/"])
def test_a_text_reaches_back_to_where_it_is_alone(new):
    source = "a = b * c\nd = 1\na = b * c\n"
    begin = source.rindex("*")
    assert text_of(source, begin, begin + 1, new) == ("d = 1\na = b * c", f"d = 1\na = b {new} c")
