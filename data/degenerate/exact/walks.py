# SPDX-License-Identifier: LGPL-3.0-or-later
"""Whether walls block a point that moves."""

from fractions import Fraction

from exact.sides import Sides
from exact.vectors import at, dot, sub


def walk_truth(world, a, b, side):
    """Whether a point can come from a to b, and the times at which it may be blocked."""
    d = sub(b, a)
    if d == (0, 0, 0):
        return True, []
    back = tuple(-x for x in d)
    events = {Fraction(0), Fraction(1)}
    for normal, sides in world.planes:
        height, slope = dot(normal, sub(a, sides[0][1])), dot(normal, d)
        low, high = Fraction(0), Fraction(1)
        if slope != 0:
            low = high = -height / slope
            if not 0 <= low <= 1:
                continue
        elif height != 0:
            continue
        for m, v in sides:
            first, change = dot(m, sub(a, v)), dot(m, d)
            if change == 0:
                if first < 0:
                    low, high = Fraction(1), Fraction(0)
            elif change > 0:
                low = max(low, -first / change)
            else:
                high = min(high, -first / change)
        if low <= high:
            events |= {low, high}
    events = sorted(events)
    here = Sides(world, a)
    if side is None:
        states = {here.side_of(c) for c in here.cells()}
        if len(states) != 1:
            raise ValueError("starts on a wall, and has no side")
    else:
        states = {here.side_of(here.with_direction(sub(side, a))[0])}
    blocked = []
    for t, after in zip(events, events[1:]):
        onward = [c for c in here.with_direction(d) if here.side_of(c) in states]
        if states - {here.side_of(c) for c in onward}:
            blocked.append(t)
        middle = Sides(world, at(a, b, (t + after) / 2))
        between = {here.shifted(middle, c, d) for c in onward}
        here = Sides(world, at(a, b, after))
        states = {here.side_of(c) for c in here.with_direction(back) if here.shifted(middle, c, back) in between}
        if not states:
            break
    return bool(states), blocked
