# SPDX-License-Identifier: LGPL-3.0-or-later
"""Vectors of fractions or integers. Points in the plane get a third coordinate of 0."""

from fractions import Fraction


def vec(p):
    return tuple(Fraction(x) for x in p) + (Fraction(0),) * (3 - len(p))


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def at(a, b, t):
    return tuple(x + t * (y - x) for x, y in zip(a, b))


def sign(x):
    return (x > 0) - (x < 0)


def integral(v):
    """The same direction in coprime integers."""
    denominator = 1
    for x in v:
        denominator = denominator * x.denominator // gcd(denominator, x.denominator)
    numbers = [int(x * denominator) for x in v]
    common = gcd(gcd(numbers[0], numbers[1]), numbers[2])
    return tuple(x // common for x in numbers) if common else tuple(numbers)


def gcd(a, b):
    while b:
        a, b = b, a % b
    return abs(a)
