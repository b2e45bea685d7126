# SPDX-License-Identifier: LGPL-3.0-or-later
"""The environment of catheters by the rules of Gymnasium's interface, and its determinism. Where Gymnasium is installed, its checker is used, too."""

import inspect
import math
import pickle
import unittest

import numpy

import cellwalk
from catheter_runs import lumen, run, wire_env
from cellwalk.catheter import CatheterEnv, Lumen, _gymnasium

HAS_GYMNASIUM = _gymnasium.Env is not _gymnasium._Env


class Rules(unittest.TestCase):
    """What Gymnasium's documentation (Env, spaces) demands of every environment."""

    def setUp(self):
        self.env = wire_env(most_steps=60)

    def test_attributes(self):
        self.assertIsInstance(self.env, _gymnasium.Env)
        self.assertIs(self.env.unwrapped, self.env)
        self.assertEqual(self.env.metadata["render_modes"], [])
        self.assertIsNone(self.env.render_mode)
        self.assertIsNone(self.env.spec)
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
            # Environments are put together as if an array in an info always had the same shape.
            self.assertFalse(any(isinstance(value, numpy.ndarray) for value in info.values()))
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
        state = self.env.np_random.bit_generator.state
        for wrong in ({"target": 2}, {"target": -1}, {"target": "nowhere"}, {"turn": 181}, {"turn": None}, {"turn": "9"}, {"speed": 1}):
            with self.assertRaisesRegex(cellwalk.UsageError, "reset.*target, one of"):
                self.env.reset(options=wrong)
            self.assertEqual(self.env.np_random.bit_generator.state, state, "nothing was drawn")
            with self.assertRaisesRegex(cellwalk.UsageError, "call reset"):
                self.env.step([0, 0])

    def test_rewards_of_ones_own(self):
        env = wire_env(reward=lambda observation, info: observation["inserted"][0] + 10 * len(info["contacts"]))
        env.reset(seed=1)
        rewards = [env.step([1, 0])[1] for _ in range(3)]
        numpy.testing.assert_allclose(rewards, numpy.arange(1, 4) * env.most_push, rtol=1e-12)

    def test_integers_of_numpy(self):
        words = {"vertices": 40, "most_steps": 50, "shape_points": 5, "path_points": 2}
        self.assertEqual(run(wire_env(**{name: numpy.int64(number) for name, number in words.items()}), 1, 60), run(wire_env(**words), 1, 60))

    def test_observations_are_in_their_space(self):
        """Wires of fewer vertices than points of their shape, and with integers as lengths, also outside the lumen."""
        for words in ({"vertices": 4, "spacing": 1, "most_push": 1, "tip_degrees": 0}, {"vertices": 10}):
            env = wire_env(**words)
            observation, _ = env.reset(seed=1)
            for action in [[0, 0]] + [[1, 0.2]] * 8 + [[-1, -0.5]] * 10:
                self.assertIn(observation, env.observation_space)
                for name, value in observation.items():
                    self.assertEqual((value.dtype, value.shape), (env.observation_space[name].dtype, env.observation_space[name].shape), name)
                observation = env.step(action)[0]
            self.assertEqual(env.wire.count, 0)

    def test_a_vertex_that_is_pulled_out_meets_a_wall(self):
        """Its contact is not one of the wire inside."""
        start = -1.3536903438035695, -0.8423884921747744, 8.611245070262214
        env = CatheterEnv(Lumen(lumen().environment, start, [lumen().lines[0][-1]]), radius=0.1, vertices=20, spacing=0.3, most_push=0.3, tip_degrees=90,
                          tip_length=0.9, stiffness=3.0)
        env.reset(seed=41)
        rng = numpy.random.default_rng(41)
        for push in (1, 1, 1, 1, 1, 1, -1, -1):
            observation = env.step([push, rng.uniform(-1, 1)])[0]
        self.assertGreaterEqual(env.contacts["vertex"].max(), env.wire.count)
        self.assertIn(observation, env.observation_space)

    def test_refused_arguments(self):
        for words, said in (({"vertices": 3}, "vertices is 3"), ({"vertices": 40.0}, "vertices is 40.0"), ({"most_steps": 0}, "most_steps"),
                            ({"spacing": -1}, "spacing is -1"), ({"spacing": 0}, "spacing"), ({"stiffness": math.nan}, "stiffness is nan"),
                            ({"most_push": 9}, "most_push is 9"), ({"most_turn": 181}, "most_turn"), ({"vertices": 1001}, "from 4 to 1000"),
                            ({"vertices": "40"}, "vertices is '40': an integer"), ({"spacing": "1"}, "spacing is '1': a finite number"),
                            ({"stiffness": 1e308}, "stiffness"), ({"reward": 5}, "a function as reward")):
            with self.assertRaisesRegex(cellwalk.UsageError, said):
                wire_env(**words)
        with self.assertRaisesRegex(cellwalk.UsageError, "a Lumen and a function"):
            CatheterEnv(lumen().environment, radius=0.1)
        with self.assertRaisesRegex(ValueError, "radius must be a finite number"):
            wire_env(radius=-1)
        with self.assertRaisesRegex(cellwalk.OutsideError, "less than its radius 2"):
            wire_env(radius=2.0)

    @unittest.skipUnless(HAS_GYMNASIUM, "gymnasium is not installed")
    def test_the_checker_of_gymnasium(self):
        from gymnasium.utils.env_checker import check_env
        from gymnasium.wrappers import FlattenObservation, TimeLimit

        check_env(wire_env())
        env = FlattenObservation(TimeLimit(wire_env(), 5))
        observation, _ = env.reset(seed=1)
        self.assertEqual(observation.shape, env.observation_space.shape)
        self.assertEqual([env.step(env.action_space.sample())[3] for _ in range(5)], [False] * 4 + [True])

    @unittest.skipUnless(HAS_GYMNASIUM, "gymnasium is not installed")
    def test_vectors_of_gymnasium(self):
        from gymnasium.vector import SyncVectorEnv

        envs = SyncVectorEnv([wire_env] * 3)
        envs.reset(seed=5)
        counts = set()
        for _ in range(150):
            *_, infos = envs.step(numpy.array([[1, 0.3], [1, -1], [0.5, 0]], dtype=numpy.float32))
            self.assertEqual([len(contacts) for contacts in infos["contacts"]], [len(env.contacts) for env in envs.envs])
            counts.add(tuple(len(contacts) for contacts in infos["contacts"]))
        self.assertGreater(len(counts), 3)


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


if __name__ == "__main__":
    unittest.main()
