"""Table of the heaviest lines of fidelity `response`: a place for each new one, the weakest when it is full.

``lines``: lines of ``size`` numbers each, of a single bearing or of a set, whose first numbers are the same.
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import L

_WEAK = 1e-5  # of the strongest line's weight, as an amplitude: left out


@kernel
def place_for(lines, size, count, most, weight):
    """Place of a new line of this weight among ``count`` lines of ``size`` numbers; -1 where there is none.

    In a full table, of ``most``, it is that of the weakest line, if that is weaker.
    """
    if not (weight < 1e9):
        return -1
    if count < most:
        return count
    weakest = int(lines[L.LINE_HEAP])
    return weakest if lines[weakest * size + L.LINE_WEIGHT] < weight else -1


@kernel
def counted(lines, size, count, most):
    """How many lines there are when one was written to its place (`place_for`), ``count`` before that.

    A full table is kept as a heap: the weakest line is found at once, and where it is replaced a path from
    the heap's top is put in order.
    """
    if count == most:
        sink(lines, size, most, 0)
        return count
    if count + 1 == most:
        for k in range(most):
            lines[k * size + L.LINE_HEAP] = k
        for k in range(most // 2 - 1, -1, -1):
            sink(lines, size, most, k)
    return count + 1


@kernel
def sink(lines, size, count, place):
    """Move the number at one ``place`` of the heap down until no line below it is weaker."""
    number = lines[place * size + L.LINE_HEAP]
    weight = lines[int(number) * size + L.LINE_WEIGHT]
    below = 2 * place + 1
    while below < count:
        least = lines[int(lines[below * size + L.LINE_HEAP]) * size + L.LINE_WEIGHT]
        if below + 1 < count:
            other = lines[int(lines[(below + 1) * size + L.LINE_HEAP]) * size + L.LINE_WEIGHT]
            if other < least:
                least = other
                below += 1
        if least >= weight:
            break
        lines[place * size + L.LINE_HEAP] = lines[below * size + L.LINE_HEAP]
        place = below
        below = 2 * place + 1
    lines[place * size + L.LINE_HEAP] = number


@kernel
def drop_weak(lines, size, count):
    """Leave out lines, of ``size`` numbers each, that are nothing beside the strongest; how many are left."""
    most = 0.0
    for k in range(count):
        most = max(most, lines[k * size + L.LINE_WEIGHT])
    into = 0
    for k in range(count):
        at = k * size
        if lines[at + L.LINE_WEIGHT] > _WEAK * _WEAK * most:
            for i in range(size):
                lines[into * size + i] = lines[at + i]
            into += 1
    return into
