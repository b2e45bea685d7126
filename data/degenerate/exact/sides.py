# SPDX-License-Identifier: LGPL-3.0-or-later
"""The sides of walls at a point: components of a small ball around it without the walls. The planes of the walls, and those through their
sides, cut the ball into cells, which are held by their signs; cells are joined across pieces of planes that no wall covers.
"""

from fractions import Fraction

from exact.vectors import cross, dot, integral, sign, sub


class Sides:
    AXES = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]

    def __init__(self, world, x):
        self.walls = []  # (normal, inward normals of the sides on which x lies)
        planes = {}
        for normal, sides in world.planes:
            corner = sides[0][1]
            if dot(normal, sub(x, corner)) != 0 or any(dot(m, sub(x, v)) < 0 for m, v in sides):
                continue
            rims = [m for m, v in sides if dot(m, sub(x, v)) == 0]
            self.walls.append((normal, rims))
            for n in [normal] + rims:
                planes[max(n, tuple(-c for c in n))] = None
        for n in self.AXES:
            planes[n] = None
        self.planes = list(planes)
        self.parent = {}
        if self.walls:
            self.join()

    def signs(self, *directions):
        """Of a direction, and where it is 0 of the next one."""
        return tuple(next((s for s in (sign(dot(n, d)) for d in directions) if s), 0) for n in self.planes)

    def root(self, cell):
        while self.parent[cell] != cell:
            cell = self.parent[cell]
        return cell

    def covered(self, v, r):
        def weakly_inside(m):
            return next((s for s in (sign(dot(m, v)), sign(dot(m, r))) if s), 0) >= 0

        return any(dot(n, v) == 0 and dot(n, r) == 0 and all(map(weakly_inside, rims)) for n, rims in self.walls)

    def join(self):
        corners = set()
        for i, n in enumerate(self.planes):
            for m in self.planes[:i]:
                v = integral([Fraction(c) for c in cross(n, m)])
                corners |= {v, tuple(-c for c in v)}
        for v in corners:
            rays = []
            for n in self.planes:
                if dot(n, v) == 0:
                    w = integral([Fraction(c) for c in cross(n, v)])
                    rays += [w, tuple(-c for c in w)]
            rays = self.around(v, rays)
            cells = []
            for r, s in zip(rays, rays[1:] + rays[:1]):
                cell = self.signs(v, tuple(a + b for a, b in zip(r, s)))
                cells.append(cell)
                self.parent.setdefault(cell, cell)
            for k, r in enumerate(rays):
                if not self.covered(v, r):
                    one, other = self.root(cells[k - 1]), self.root(cells[k])
                    self.parent[one] = other

    @staticmethod
    def around(v, rays):
        x = rays[0]
        y = cross(v, x)

        def half(r):
            a, b = dot(r, x), dot(r, y)
            return 0 if b > 0 or (b == 0 and a > 0) else 1

        # Within half a turn, by the slope a / b in multiples of the lengths of x and y.
        def slope(r):
            a, b = dot(r, x), dot(r, y)
            return (half(r), Fraction(-a, b) if b else Fraction(-(10**18) ** 9))

        return sorted(rays, key=slope)

    def cells(self):
        return self.parent if self.walls else {(): ()}

    def side_of(self, cell):
        return self.root(cell) if self.walls else ()

    def with_direction(self, d):
        """The cells whose closure holds a direction."""
        if not self.walls:
            return [()]
        of_d = [sign(dot(n, d)) for n in self.planes]
        return [c for c in self.parent if all(s * t >= 0 for s, t in zip(c, of_d))]

    def is_on_wall(self, d):
        return any(dot(n, d) == 0 and all(dot(m, d) >= 0 for m in rims) for n, rims in self.walls)

    def shifted(self, other, cell, d):
        """The side, at a point a little further in direction d, whose sides are `other`, of a cell that holds d."""
        if not other.walls:
            return ()
        mine = dict(zip(self.planes, cell))
        signs = tuple(sign(dot(n, d)) or mine[n] for n in other.planes)
        return other.root(signs)
