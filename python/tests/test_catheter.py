# SPDX-License-Identifier: LGPL-3.0-or-later
"""Lumens, wires, and their safety, judged exactly.

CELLWALK_TEST_LENGTH multiplies the number of steps that are judged (2000).
"""

import itertools
import math
import os
import pathlib
import pickle
import tempfile
import unittest
import warnings

import numpy

import cellwalk
from catheter_runs import actions, lumen, run, wire_env
from cellwalk.catheter import CatheterEnv, Lumen, _wire
from wire_judge import Judge, apart_exactly

LENGTH = float(os.environ.get("CELLWALK_TEST_LENGTH", "1"))


class Lumens(unittest.TestCase):
    def test_the_ends_of_branches(self):
        """They are those of the tubes of the generator: as many, and each line is as long as its branches or a little shorter."""
        for forks in (0, 1, 2):
            found = lumen(forks)
            self.assertEqual(len(found.names), 2**forks)
            ends = numpy.array([line[-1] for line in found.lines])
            apart = numpy.linalg.norm(ends[:, None] - ends, axis=2) + 9 * numpy.eye(len(ends))
            self.assertGreater(apart.min(), 2)
            for line, left, reach in zip(found.lines, found.left, found.reaches):
                numpy.testing.assert_array_equal(line[0], (0, 0, 0.2))
                self.assertAlmostEqual(left[0], numpy.linalg.norm(line[1:] - line[:-1], axis=1).sum(), places=10)
                self.assertEqual(left[-1], 0)
                self.assertGreater(reach, 0.3)
                self.assertTrue((found.environment.locate(line).status == cellwalk.Place.FREE).all())
                end = line[-1:].copy()
                near, far = (found.environment.walk(end, end, radius=factor * reach).status[0] for factor in (0.999, 1.05))
                self.assertEqual(near, cellwalk.Status.FREE, "nothing is nearer to the end than it reaches")

    def test_points_and_groups(self):
        vessel = lumen().environment
        chosen = Lumen(vessel, (0, 0, 0.2), [(0, 0, 3), lumen().lines[1][-1]])
        self.assertEqual(chosen.names, ["target 1", "target 2"])
        self.assertAlmostEqual(chosen.left[0][0], 2.8, delta=0.1)
        numpy.testing.assert_array_equal(chosen.lines[1][-1], lumen().lines[1][-1])
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "named.msh"
            path.write_text(tube_with_caps())
            tube = cellwalk.Environment.import_mesh(path)
        self.assertEqual(sorted(tube.groups), ["inlet", "outlet", "physical volume 3"])
        named = Lumen(tube, "inlet")
        self.assertEqual(named.names, ["outlet"], "the group of all cells is no target unless it is named")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(Lumen(tube, numpy.array([1.1, 1.1, 1.0])).names, ["inlet", "outlet"])
        self.assertLess(named.entry[2], 2)
        self.assertGreater(named.lines[0][-1][2], 6)
        env = CatheterEnv(named, radius=0.2, vertices=20, tip_degrees=0)
        env.reset(seed=1)
        for _ in range(200):
            *_, arrived, _, _ = env.step([1, 0])
            if arrived:
                return
        self.fail("a straight tube leads to its outlet")

    def test_refusals(self):
        vessel = lumen().environment
        for start, targets, said in (((9, 9, 9), None, "start at .9.0, 9.0, 9.0. is not in free space"), ((0, 0), None, "start has shape .2,."),
                                     ((0, 0, 0.2), [(9, 9, 9)], "target 1 at"), ("inlet", None, "no group"), ((0, 0, 0.2), ["inlet"], "no group")):
            with self.assertRaisesRegex(cellwalk.Error, said):
                Lumen(vessel, start, targets)
        for targets in ([], "inlet"):
            with self.assertRaisesRegex(cellwalk.UsageError, "a list of points or names is needed"):
                Lumen(vessel, (0, 0, 0.2), targets)
        with self.assertRaisesRegex(cellwalk.UsageError, "target 2 is at the start"):
            Lumen(vessel, (0, 0, 1.0), [(0, 0, 2), (0, 0, 1)])
        with self.assertRaisesRegex(cellwalk.UsageError, "2 dimensions"):
            Lumen(cellwalk.Environment.generate("squares", cells=2), (0.5, 0.5))
        rooms = cellwalk.Environment.generate("hexes", cells=(3, 1, 1))
        with rooms.editing() as edits:
            edits.close(rooms.select(box=((2, 0, 0), (2, 1, 1))).facets)
        with self.assertRaisesRegex(cellwalk.OutsideError, "target 1 is not connected with the start"):
            Lumen(rooms, (0.5, 0.5, 0.5), [(2.5, 0.5, 0.5)])

    def test_a_target_too_near_to_a_wall_for_the_wire(self):
        """Its tip keeps the radius from the wall, and has to come nearer to the target than the wall is."""
        tube = Lumen(cellwalk.Environment.generate("hexes", cells=(8, 3, 3)), (0.5, 1.5, 1.5), [(6.5, 1.5, 0.25)])
        self.assertAlmostEqual(tube.reaches[0], 0.25)
        with self.assertRaisesRegex(cellwalk.OutsideError, "target 1 is 0.25 from a wall: a wire of radius 0.5 does not reach it"):
            CatheterEnv(tube, radius=0.5)
        CatheterEnv(tube, radius=0.49)

    def test_reaches_of_points(self):
        """Nothing is nearer, and something is little farther away."""
        vessel = lumen().environment
        rng = numpy.random.default_rng(7)
        points = rng.uniform(vessel.points.min(axis=0), vessel.points.max(axis=0), size=(1000, 3))
        points = points[vessel.locate(points).status == cellwalk.Place.FREE][:40]
        self.assertEqual(len(points), 40)
        reaches = numpy.array(Lumen(vessel, (0, 0, 0.2), points).reaches)
        near, far = (vessel.walk(points, points, radius=factor * reaches).status for factor in (0.999, 1.001))
        self.assertTrue((near == cellwalk.Status.FREE).all())
        self.assertFalse((far == cellwalk.Status.FREE).any())

    def test_pickles(self):
        env = wire_env()
        other = CatheterEnv(pickle.loads(pickle.dumps(lumen())), radius=0.15, vertices=40)
        self.assertEqual(run(other, 3, 100), run(env, 3, 100))


def tube_with_caps():
    """A square tube of 2 x 2 x 8 hexahedra with its ends as groups, in Gmsh's format 2.2."""
    points = [(x, y, z) for z in range(9) for y in range(3) for x in range(3)]
    at = {point: number for number, point in enumerate(points, 1)}

    def quad(x, y, z):
        return [at[x, y, z], at[x + 1, y, z], at[x + 1, y + 1, z], at[x, y + 1, z]]

    cells = list(itertools.product(range(2), range(2)))
    elements = [(3, group, quad(x, y, z)) for group, z in ((1, 0), (2, 8)) for x, y in cells]
    elements += [(5, 3, quad(x, y, z) + quad(x, y, z + 1)) for z in range(8) for x, y in cells]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "2", '2 1 "inlet"', '2 2 "outlet"', "$EndPhysicalNames", "$Nodes", str(len(points))]
    lines += [f"{number} {x} {y} {z}" for number, (x, y, z) in enumerate(points, 1)]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    lines += [f"{number} {kind} 2 {group} {group} {' '.join(map(str, corners))}" for number, (kind, group, corners) in enumerate(elements, 1)]
    return "\n".join([*lines, "$EndElements", ""])


class Wires(unittest.TestCase):
    def test_turns(self):
        for angle in numpy.linspace(-math.pi, math.pi, 101):
            numpy.testing.assert_allclose(_wire.turned(angle), (math.cos(angle), math.sin(angle)), atol=4e-15)

    def test_smoothers_are_inverses(self):
        for stiffness in (0.0, 1.0, 100.0):
            for n, inverse in enumerate(_wire._smoothers(30, stiffness)):
                second = numpy.diff(numpy.eye(n + 2), n=2, axis=0)  # at all vertices but the tip; the last two columns are held by the guide
                matrix = numpy.eye(n) + stiffness * (second.T @ second)[:n, :n]
                numpy.testing.assert_allclose(inverse @ matrix, numpy.eye(n), atol=1e-10)

    def test_the_side_is_carried_along_the_wire(self):
        """Against rotations from link to link, one after the other."""
        env = wire_env(vertices=60)
        env.reset(seed=2)
        for action in actions(2, 150):
            env.step(action)
        wire = env.wire
        tangents = wire._tangents.T
        self.assertLess((tangents @ tangents[-1]).min(), 0.9, "it is bent")
        side = numpy.array(wire._side)
        for k in range(tangents.shape[0] - 1, 0, -1):
            axis, cosine = numpy.cross(tangents[k], tangents[k - 1]), tangents[k] @ tangents[k - 1]
            side = cosine * side + numpy.cross(axis, side) + (axis @ side) / (1 + cosine) * axis
            if k - 1 == wire._bent:
                numpy.testing.assert_allclose(wire._bend_side, side, atol=1e-12)
        numpy.testing.assert_allclose(wire._carried_side(0), side, atol=1e-12)

    def test_a_free_wire_has_its_natural_shape(self):
        """In a wide room: straight but for the tip, which is curved by its angle to the side to which the base is turned."""
        room = Lumen(cellwalk.Environment.generate("hexes", cells=(12, 12, 12)), (6.5, 6.5, 1.5), [(6.5, 6.5, 11.5)])
        env = CatheterEnv(room, radius=0.1, vertices=21, spacing=0.4, tip_degrees=60, stiffness=1e4)
        for turn in (0, 90, -135):
            env.reset(options={"turn": turn})
            for _ in range(50):
                observation = env.step([1, 0])[0]
            for _ in range(300):
                observation = env.step([0, 0])[0]
            links = env.body.positions[:-1] - env.body.positions[1:]
            numpy.testing.assert_allclose(numpy.linalg.norm(links, axis=1), 0.4, rtol=2e-3)
            numpy.testing.assert_allclose(links[8:], numpy.tile([0, 0, 0.4], (12, 1)), atol=2e-3)
            self.assertAlmostEqual(math.degrees(math.acos(observation["direction"][2])), 60, delta=0.5)
            towards = observation["direction"][:2] / numpy.linalg.norm(observation["direction"][:2])
            env.reset(options={"turn": 0})
            first = numpy.array(env.wire._side)[:2]
            wanted = math.cos(math.radians(turn)) * first + math.sin(math.radians(turn)) * numpy.array([-first[1], first[0]])
            numpy.testing.assert_allclose(towards, wanted, atol=5e-3)
            self.assertAlmostEqual(observation["curve"] @ observation["direction"], 0, places=12)

    def test_pulled_out_it_is_as_before(self):
        env = wire_env()
        start = env.reset(seed=1)[0]
        for action in [[1, 0.3]] * 40 + [[-1, -0.3]] * 45:
            observation, *_, info = env.step(action)
        self.assertEqual(observation["inserted"].tolist(), [0])
        numpy.testing.assert_array_equal(env.body.positions, numpy.tile(lumen().entry, (40, 1)))
        numpy.testing.assert_allclose(observation["direction"], start["direction"], atol=1e-12)
        self.assertLess(info["slipped"], 0, "nothing is left to be pulled")

    def test_walls_hold_it(self):
        """Pushed against the end of a tube, the drive slips."""
        env = wire_env(forks=0, vertices=60, spacing=0.2, tip_degrees=0)
        env.reset(seed=1)
        for _ in range(120):
            contacts = env.wire.step(0.1, 0.0)
        self.assertGreater(env.wire.slipped, 0)
        self.assertGreater(len(contacts), 0)
        self.assertLess(env.wire.inside - env.wire.length, 0.4)


class Safety(unittest.TestCase):
    def test_no_wall_is_nearer_than_the_radius(self):
        env = wire_env(forks=2, vertices=100, most_steps=300)
        judge = Judge(env.lumen.environment, 0.15, env.wire.spacing)
        met, over, episodes = 0, True, 0
        for number, action in enumerate(actions(1, int(2000 * LENGTH))):
            if over:
                env.reset(seed=episodes)
                episodes, before = episodes + 1, env.body.positions.copy()
                self.assertEqual(judge.violations(None, before), ([], []))
            *_, terminated, truncated, info = env.step(action)
            after = env.body.positions.copy()
            self.assertEqual(judge.violations(before, after), ([], []), f"step {number}")
            over, before = terminated or truncated, after
            met += len(info["contacts"])
        env.body.validate()
        self.assertGreater(met, judge.steps / 4, "walls are met all the time")
        self.assertGreater(judge.pairs, 20 * judge.steps)

    def test_the_judge_finds_what_is_wrong(self):
        env = wire_env(forks=1, vertices=60)
        judge = Judge(env.lumen.environment, 0.15, env.wire.spacing)
        env.reset(seed=1)
        while True:
            env.step([1, 0.5])
            contacts = env.contacts
            if len(contacts) > 0 and contacts["vertex"][0] < 3:
                break
        at, contact = env.body.positions.copy(), contacts[0]
        vertex, normal = int(contact["vertex"]), contact["normal"]
        self.assertEqual(judge.violations(at, at), ([], []))
        for depth in (1e-13, 1e-9, 1e-3):  # nearer than the radius, by little
            closer = at.copy()
            closer[vertex] -= depth * normal
            too_near, through = judge.violations(at, closer)
            self.assertIn(vertex, [*too_near, *(row + 1 for row in too_near)], depth)
            self.assertEqual(through, [])
        behind = at.copy()
        behind[: vertex + 1] -= 0.5 * normal  # on the other side of a wall, free of it at both ends
        self.assertIn(vertex, judge.violations(at, behind)[1])

    def test_the_judge_in_integers(self):
        wall = numpy.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0]])
        for edge, square in (([[1, 1, 3], [2, 1, 3]], 9), ([[1, 1, 2], [9, 9, 2]], 4), ([[-3, 1, 0], [-3, 1, 4]], 9), ([[-1, -2, 2], [-1, -2, 4]], 9),
                             ([[3, 3, -1], [3, 3, 1]], 2), ([[1, 1, -1], [1, 1, 1]], 0), ([[-1, 2, 1], [2, -1, 1]], 1)):
            edge = numpy.array(edge, dtype=float)
            for radius in (0.5, 1.0, 2.0, 3.0, numpy.nextafter(3.0, 4), 4.0):
                self.assertEqual(apart_exactly(edge, wall, radius), square >= radius**2 and square > 0, (edge, radius))
            self.assertEqual(apart_exactly(edge, wall, 0.0), square > 0)


if __name__ == "__main__":
    unittest.main()
