# SPDX-License-Identifier: LGPL-3.0-or-later
"""Objects that were never made raise whatever they are asked, instead of ending the interpreter."""
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


def parts(text):
    """The parts of a text between commas outside brackets."""
    found, depth = [""], 0
    for c in text:
        depth += (c in "([{<") - (c in ")]}>")
        found = found + [""] if c == "," and depth == 0 else found[:-1] + [found[-1] + c]
    return [part.strip() for part in found if part.strip()]


def plausible(kind):
    """A value of a type, as signatures of compiled functions name it."""
    values = {"int": 1, "float": 0.5, "bool": True, "str": "name", "bytes": b"", "tuple": (), "dict": {}}
    for name in CLASSES:
        if kind.endswith("." + name.__name__):
            return name.__new__(name)
    if "ndarray" in kind:
        return numpy.full((1, 3), 0.5)
    if kind.startswith(("List", "list", "Sequence", "Iterable")):
        return []
    if kind.startswith("Tuple"):
        return tuple(plausible(part) for part in parts(kind[len("Tuple["):-1]))
    return values.get(kind)


def signature(member):
    """The arguments that a compiled method must be given, by position and by name; none if its doc does not tell."""
    line = next((line for line in (member.__doc__ or "").split("\n") if "(self" in line), None)
    if line is None:
        return None
    inside = line[line.index("(") + 1:line.rindex(") ->")]
    positional, named, by_name = [], {}, False
    for part in parts(inside)[1:]:
        if part == "*":
            by_name = True
        elif " = " not in part and not part.startswith("*"):
            name, kind = part.split(": ", 1)
            if by_name:
                named[name] = plausible(kind)
            else:
                positional.append(plausible(kind))
    return positional, named


class WithoutValue(unittest.TestCase):
    def test_every_member_of_every_class_raises(self):
        asked = reached = 0
        for cls in CLASSES:
            for name, member in vars(cls).items():
                if not is_of_class(name, member) or name in ("__init__", "__setstate__"):
                    continue
                arguments = [((), {})]
                if not isinstance(member, property) and signature(member):
                    arguments.append(signature(member))
                for positional, named in arguments:
                    thing = cls.__new__(cls)
                    with self.assertRaises(Exception, msg=f"{cls.__name__}.{name}") as raised:
                        value = getattr(thing, name)
                        if not isinstance(member, property):
                            value(*positional, **named)
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
