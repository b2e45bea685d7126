# SPDX-License-Identifier: LGPL-3.0-or-later
"""Arguments that do not fit, in one line and in Python's words."""

import inspect
import numbers
import re
from typing import Any, Mapping, Sequence

import numpy

_OURS = "cellwalk._cellwalk."
_TYPES = {"int": numbers.Integral, "float": numbers.Real, "str": str, "bool": (bool, numpy.bool_)}


def _fits(value: Any, kind: str) -> bool:
    """Whether a value is of a type, as pybind11 names it. All values are of types that are not known here."""
    if kind.startswith("Optional["):
        return value is None or _fits(value, kind[len("Optional["):-1])
    if kind.startswith("Union["):
        return any(_fits(value, part) for part in kind[len("Union["):-1].split(", "))
    if kind.lower().startswith("list["):
        return isinstance(value, Sequence) and not isinstance(value, (str, bytes))
    if kind in _TYPES:
        return isinstance(value, _TYPES[kind])  # type: ignore[arg-type]
    return not kind.startswith(_OURS) or kind[len(_OURS):] in (base.__name__ for base in type(value).__mro__)


def _parameter(text: str, by_name: bool) -> inspect.Parameter:
    if text.startswith("**"):
        return inspect.Parameter(text[2:], inspect.Parameter.VAR_KEYWORD)
    name, kind, has_default = re.fullmatch(r"(\w+): (.*?)( = .*)?", text).groups()  # type: ignore[union-attr]
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY if by_name else inspect.Parameter.POSITIONAL_OR_KEYWORD,
                             default=None if has_default else inspect.Parameter.empty, annotation=kind)


def refusal(said: str, arguments: Sequence[Any], named: Mapping[str, Any]) -> str:
    """What is wrong with a call of a compiled function.

    said: the text of pybind11: the function with all its types, and everything that was given.
    """
    name, inside = re.search(r"1\. (?:cellwalk\._cellwalk\.)?(\w*)\((.*)\)(?: -> .*)?\n", said).groups()  # type: ignore[union-attr]
    if name:  # a class, which is called with the object that is made
        arguments = arguments[1:]
    else:
        name = said[:said.index("(")]
    parts = re.split(r", (?=\*|\w+: )", inside)
    star = parts.index("*") if "*" in parts else len(parts)
    parameters = [_parameter(part, i > star) for i, part in enumerate(parts) if part not in ("", "*")]
    try:
        bound = inspect.Signature(parameters).bind(*arguments, **named)
    except TypeError as error:
        return f"{name}(): {error}"
    kinds = {parameter.name: parameter.annotation for parameter in parameters}
    for parameter, value in bound.arguments.items():
        if not _fits(value, kinds[parameter]):
            return f"{name}(): {parameter} must be {kinds[parameter].replace(_OURS, '')}, and is {type(value).__name__}"
    for parameter, value in bound.arguments.items():
        if kinds[parameter] == "int" and not 0 <= value < 2**31:
            return f"{name}(): {parameter} is {value}, which is out of range"
    return f"{name}(): the arguments do not fit: see help()"
