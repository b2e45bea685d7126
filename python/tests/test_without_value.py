# SPDX-License-Identifier: LGPL-3.0-or-later
"""Objects that were never made raise whatever they are asked, instead of ending the interpreter."""
import inspect
import subprocess
import sys
import unittest

import numpy

import cellwalk
from cellwalk import _cellwalk

CLASSES = [value for value in vars(_cellwalk).values() if isinstance(value, type)]


def is_of_class(name, member):
    """Not what every object has: those of object ask nothing of the value."""
    return name not in vars(object) and (callable(member) or isinstance(member, property))


# Arguments by the names of parameters; all others are arrays.
VALUES = {"environment": cellwalk.Environment.__new__(cellwalk.Environment), "vertex": 1, "point": 1, "u": 1, "v": 1, "onto": 1, "up_to": 0.5,
          "path": "name"}


def arguments_of(member):
    """The arguments that a compiled method must be given; none if it has no signature."""
    try:
        parameters = list(inspect.signature(member).parameters.values())[1:]
    except ValueError:
        return None
    return [VALUES.get(p.name, numpy.full((1, 3), 0.5)) for p in parameters if p.default is p.empty and p.kind is p.POSITIONAL_OR_KEYWORD]


class WithoutValue(unittest.TestCase):
    def test_every_member_of_every_class_raises(self):
        asked = reached = 0
        for cls in CLASSES:
            for name, member in vars(cls).items():
                if not is_of_class(name, member) or name in ("__init__", "__setstate__"):
                    continue
                arguments = [()]
                if not isinstance(member, property) and arguments_of(member):
                    arguments.append(arguments_of(member))
                for given in arguments:
                    thing = cls.__new__(cls)
                    with self.assertRaises(Exception, msg=f"{cls.__name__}.{name}") as raised:
                        value = getattr(thing, name)
                        if not isinstance(member, property):
                            value(*given)
                    self.assertNotIsInstance(raised.exception, SystemError)
                    reached += "was not made yet" in str(raised.exception)
                    asked += 1
        self.assertGreater(len(CLASSES), 10)
        self.assertGreater(asked, 100)
        self.assertGreater(reached, 80, "the value is asked for, not only the arguments refused")

    def test_properties_name_the_remedy(self):
        asked = 0
        for cls in CLASSES:
            for name, member in vars(cls).items():
                if isinstance(member, property):
                    with self.assertRaisesRegex(TypeError, "was not made yet"):
                        getattr(cls.__new__(cls), name)
                    asked += 1
        self.assertGreater(asked, 40)

    def test_text_and_length_raise(self):
        for cls in CLASSES:
            thing = cls.__new__(cls)
            for ask in (len, list, lambda x: x[0], lambda x: x()):
                with self.assertRaises(TypeError):
                    ask(thing)
            if "__repr__" in vars(cls):
                with self.assertRaises(TypeError):
                    repr(thing)

    def test_a_subclass_that_asks_before_it_is_made(self):
        class Early(cellwalk.Particles):
            def __init__(self):
                self.positions

        with self.assertRaisesRegex(TypeError, "was not made yet"):
            Early()

    def test_one_given_to_others_raises(self):
        environment = cellwalk.Environment.generate("hexes", cells=2)
        for make in (lambda: cellwalk.Particles(cellwalk.Environment.__new__(cellwalk.Environment), [[0.5, 0.5, 0.5]]),
                     lambda: environment.editing(bodies=[cellwalk.Body.__new__(cellwalk.Body)]).__enter__(),
                     lambda: environment.editing(particles=[cellwalk.Particles.__new__(cellwalk.Particles)]).__enter__()):
            with self.assertRaises(Exception):
                make()

    def test_one_made_later_works(self):
        environment = cellwalk.Environment.generate("hexes", cells=2)
        particles = cellwalk.Particles.__new__(cellwalk.Particles)
        with self.assertRaises(TypeError):
            particles.positions
        particles.__init__(environment, numpy.array([[0.5, 0.5, 0.5]]))
        self.assertEqual(len(particles), 1)

    def test_none_of_this_ends_the_interpreter(self):
        """As a process of its own, so that a crash is told."""
        code = ("from cellwalk import _cellwalk\n"
                "for cls in [v for v in vars(_cellwalk).values() if isinstance(v, type)]:\n"
                "    for name in dir(cls):\n"
                "        try:\n"
                "            member = getattr(cls.__new__(cls), name)\n"
                "            member() if name not in ('__init_subclass__', '__class__') and callable(member) else None\n"
                "        except Exception:\n"
                "            pass\n"
                "print('done')\n")
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (0, "done\n"), done.stderr)


if __name__ == "__main__":
    unittest.main()
