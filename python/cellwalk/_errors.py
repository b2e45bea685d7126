# SPDX-License-Identifier: LGPL-3.0-or-later
"""The exceptions of the library. Each has the code with which the program `cellwalk` ends for the same reason."""


class Error(Exception):
    """The library refused something; the message says what is wrong, where, and what to do."""

    code = 1


class UsageError(Error, ValueError):
    """A call that makes no sense, such as a word that is no option."""

    code = 2


class InputError(Error, ValueError):
    """A file or an array that is unreadable or invalid."""

    code = 3


class NotCertifiedError(Error, ValueError):
    """Cells that are not an environment; the message names the cell and the reason."""

    code = 4


class OutsideError(Error, ValueError):
    """A body that starts outside free space or across a wall."""

    code = 5
