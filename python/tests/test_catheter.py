# SPDX-License-Identifier: LGPL-3.0-or-later
"""The environment of catheters: the rules of Gymnasium's interface, determinism, its geometry, and safety, judged exactly.

CELLWALK_TEST_LENGTH multiplies the number of steps that are judged (2000).
"""

import functools
import inspect
import itertools
import math
import os
import pathlib
import pickle
import tempfile
import unittest

import numpy

import cellwalk
from cellwalk.catheter import CatheterEnv, Lumen, _gymnasium, _wire
from wire_judge import Judge, apart_exactly

LENGTH = float(os.environ.get("CELLWALK_TEST_LENGTH", "1"))
HAS_GYMNASIUM = _gymnasium.Env is not _gymnasium._Env


@functools.lru_cache(maxsize=None)
def lumen(forks=1):
    return Lumen(cellwalk.Environment.generate("vessel", generations=forks), start=(0, 0, 0.2))


def wire_env(forks=1, **words):
    return CatheterEnv(lumen(forks), **{"radius": 0.15, "vertices": 40, **words})


def actions(seed, count):
    """Long pushes, now and then a pull, and turns to all sides; some beyond the space."""
    rng = numpy.random.default_rng(seed)
    pushes = numpy.repeat(rng.choice([1.0, 1.0, 1.0, 0.3, -1.0], count // 20 + 1), 20)[:count]
    return numpy.stack([pushes, numpy.repeat(rng.uniform(-1.5, 1.5, count // 10 + 1), 10)[:count]], axis=1)


def run(env, seed, count):
    """The bytes of all that a run gives."""
    observation, info = env.reset(seed=seed)
    parts, over = [], False
    for action in actions(seed, count):
        if over:
            observation, info = env.reset()
        observation, reward, terminated, truncated, info = env.step(action)
        over = terminated or truncated
        parts += [observation[name].tobytes() for name in sorted(observation)]
        parts += [repr((reward, terminated, truncated, info["remaining"])).encode(), info["contacts"].tobytes(), env.contacts.tobytes(), env.body.positions.tobytes()]
    return b"".join(parts)


class Rules(unittest.TestCase):
    """What Gymnasium's documentation (Env, spaces) demands of every environment."""

    def setUp(self):
        self.env = wire_env(most_steps=60)

    def test_attributes(self):
        self.assertIsInstance(self.env, _gymnasium.Env)
        self.assertIs(self.env.unwrapped, self.env)
        self.assertIn("render_modes", self.env.metadata)
        self.assertGreater(self.env.metadata["render_fps"], 0)
        self.assertIsNone(self.env.render_mode)
        for name in ("seed", "options"):
            parameter = inspect.signature(self.env.reset).parameters[name]
            self.assertEqual((parameter.kind, parameter.default), (inspect.Parameter.KEYWORD_ONLY, None))
        self.env.close()
        self.env.close()  # of a closed one is allowed

    def test_spaces(self):
        space = self.env.action_space
        self.assertEqual((space.shape, space.dtype), ((2,), numpy.float32))
        self.assertTrue((space.low == -1).all() and (space.high == 1).all(), "normalized and symmetric")
        boxes = [space, *self.env.observation_space.spaces.values()]
        for box in boxes:
            self.assertTrue(numpy.isfinite(box.low).all() and numpy.isfinite(box.high).all() and (box.low < box.high).all())
            sample = box.sample()
            self.assertEqual((sample.shape, sample.dtype), (box.shape, box.dtype))
            self.assertIn(sample, box)
            for wrong in (sample + 1e3, sample[..., :-1], sample.astype(complex), numpy.full_like(sample, numpy.nan)):
                self.assertNotIn(wrong, box)
        for some in (space, self.env.observation_space):
            samples = []
            for seed in (3, 3, 4):
                some.seed(seed)
                samples.append(pickle.dumps(some.sample()))
            self.assertEqual(samples[0], samples[1])
            self.assertNotEqual(samples[0], samples[2])
        sample = self.env.observation_space.sample()
        self.assertIn(sample, self.env.observation_space)
        for wrong in ({**sample, "more": 1}, {"tip": sample["tip"]}, {**sample, "tip": sample["tip"][:2]}, list(sample.values())):
            self.assertNotIn(wrong, self.env.observation_space)

    def test_reset_and_step(self):
        result = self.env.reset(seed=5)
        self.assertIsInstance(result, tuple)
        observation, info = result
        self.assertIn(observation, self.env.observation_space)
        self.assertIsInstance(info, dict)
        kept = {name: value.copy() for name, value in observation.items()}
        for number in range(1, 61):
            result = self.env.step(self.env.action_space.sample())
            self.assertEqual(len(result), 5)
            later, reward, terminated, truncated, info = result
            self.assertIn(later, self.env.observation_space)
            self.assertIsInstance(reward, float)
            self.assertTrue(math.isfinite(reward))
            self.assertIs(type(terminated), bool)
            self.assertIs(type(truncated), bool)
            self.assertIsInstance(info, dict)
            self.assertEqual((terminated, truncated), (False, number == 60))
        for name, value in kept.items():
            self.assertEqual(value.tobytes(), observation[name].tobytes(), "an observation stays as it was")

    def test_the_order_of_calls(self):
        with self.assertRaisesRegex(cellwalk.UsageError, "has not begun: call reset"):
            self.env.step([0, 0])
        self.env.reset(seed=1)
        for _ in range(60):
            *_, truncated, _ = self.env.step([0, 0])
        self.assertTrue(truncated)
        with self.assertRaisesRegex(cellwalk.UsageError, "is over"):
            self.env.step([0, 0])
        self.env.reset()
        self.env.step([0, 0])

    def test_actions(self):
        self.env.reset(seed=1)
        for wrong in ([1], [1, 2, 3], 1, [[1, 1]], [numpy.nan, 0], [0, numpy.inf]):
            with self.assertRaisesRegex(cellwalk.InputError, "two finite numbers, the push and the turn, are needed"):
                self.env.step(wrong)
        ends = []
        for action in ([1, -1], [5, -7.5], (1, -1), numpy.array([1, -1], dtype=numpy.float32)):
            self.env.reset(seed=1)
            self.env.step(action)
            ends.append(self.env.step(action)[0]["shape"].tobytes())
        self.assertEqual(len(set(ends)), 1, "the nearest action of the space, of any type")

    def test_seeds(self):
        def drawn(seed):
            observation, info = self.env.reset(seed=seed)
            return pickle.dumps((observation, info["target"])), self.env.np_random.bit_generator.state

        first, again, other = drawn(123), drawn(123), drawn(456)
        self.assertEqual(first, again)
        self.assertNotEqual(first[1], other[1])
        self.env.reset(seed=7)
        later = [self.env.reset()[1]["target"] for _ in range(20)]
        self.assertEqual(set(later), set(lumen().names), "a reset without a seed goes on with the random numbers")
        self.env.reset(seed=7)
        self.assertEqual([self.env.reset()[1]["target"] for _ in range(20)], later)

    def test_options(self):
        for target in (1, lumen().names[1]):
            observation, info = self.env.reset(options={"target": target, "turn": 90})
            self.assertEqual(info["target"], lumen().names[1])
            numpy.testing.assert_array_equal(observation["target"], lumen().lines[1][-1])
        self.env.reset(options={})
        for wrong in ({"target": 2}, {"target": -1}, {"target": "nowhere"}, {"turn": 181}, {"speed": 1}):
            with self.assertRaisesRegex(cellwalk.UsageError, "reset.*target, one of"):
                self.env.reset(options=wrong)

    def test_render(self):
        self.env.reset(seed=1)
        self.assertIsNone(self.env.render())
        env = wire_env(render_mode="ansi")
        env.reset(seed=1)
        env.step([1, 0])
        self.assertRegex(env.render(), r"^step 1: 0\.\d+ inside, \d+\.\d+ from end [12]$")

    def test_rewards_of_ones_own(self):
        env = wire_env(reward=lambda observation, info: observation["inserted"][0] + 10 * len(info["contacts"]))
        env.reset(seed=1)
        rewards = [env.step([1, 0])[1] for _ in range(3)]
        numpy.testing.assert_allclose(rewards, numpy.arange(1, 4) * env.most_push, rtol=1e-12)

    def test_refused_arguments(self):
        for words, said in (({"vertices": 3}, "vertices is 3"), ({"vertices": 40.0}, "vertices is 40.0"), ({"most_steps": 0}, "most_steps"),
                            ({"spacing": -1}, "spacing is -1"), ({"spacing": 0}, "spacing"), ({"stiffness": math.nan}, "stiffness is nan"),
                            ({"most_push": 9}, "most_push is 9"), ({"most_turn": 181}, "most_turn"), ({"render_mode": "human"}, "'human'")):
            with self.assertRaisesRegex(cellwalk.UsageError, said):
                wire_env(**words)
        with self.assertRaisesRegex(ValueError, "radius must be a finite number"):
            wire_env(radius=-1)
        with self.assertRaisesRegex(cellwalk.OutsideError, "less than its radius 2"):
            wire_env(radius=2.0)

    @unittest.skipUnless(HAS_GYMNASIUM, "gymnasium is not installed")
    def test_the_checker_of_gymnasium(self):
        from gymnasium.utils.env_checker import check_env
        from gymnasium.wrappers import FlattenObservation, TimeLimit

        check_env(wire_env(render_mode="ansi"))
        env = FlattenObservation(TimeLimit(wire_env(), 5))
        observation, _ = env.reset(seed=1)
        self.assertEqual(observation.shape, env.observation_space.shape)
        self.assertEqual([env.step(env.action_space.sample())[3] for _ in range(5)], [False] * 4 + [True])


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
        with self.assertRaisesRegex(cellwalk.UsageError, "2 dimensions"):
            Lumen(cellwalk.Environment.generate("squares", cells=2), (0.5, 0.5))
        rooms = cellwalk.Environment.generate("hexes", cells=(3, 1, 1))
        with rooms.editing() as edits:
            edits.close(rooms.select(box=((2, 0, 0), (2, 1, 1))).facets)
        with self.assertRaisesRegex(cellwalk.OutsideError, "target 1 is not connected with the start"):
            Lumen(rooms, (0.5, 0.5, 0.5), [(2.5, 0.5, 0.5)])

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


class Determinism(unittest.TestCase):
    def test_same_seed_and_actions_same_bytes(self):
        first = run(wire_env(most_steps=150), 11, 400)
        again = wire_env(most_steps=150)
        run(again, 12, 200)  # what went before does not matter
        self.assertEqual(run(again, 11, 400), first)
        self.assertNotEqual(run(wire_env(most_steps=150), 12, 400), first)

    def test_without_gymnasium_the_same_random_numbers(self):
        """As its documentation has them: a generator PCG64 of the seed."""
        env = wire_env()
        env.reset(seed=42)
        rng = numpy.random.default_rng(42)
        self.assertEqual(env.target, int(rng.integers(2)))
        rng.uniform(-180.0, 180.0)
        self.assertEqual(env.np_random.bit_generator.state, rng.bit_generator.state)


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
        self.assertGreater(judge.pairs, 50 * judge.steps)

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
