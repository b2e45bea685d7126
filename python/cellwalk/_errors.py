# SPDX-License-Identifier: LGPL-3.0-or-later
"""The exceptions of the library. Each has the exit code of the program `cellwalk` for the same error."""


class Error(Exception):
    """The library refused an input; the message gives the problem, the place and the remedy."""

    code = 1


class UsageError(Error, ValueError):
    """An invalid call, such as one with an unknown option."""

    code = 2


class InputError(Error, ValueError):
    """A file or an array that is unreadable or invalid."""

    code = 3


class RowError(InputError, IndexError):
    """A row, vertex, point or cell that does not exist."""


class NotCertifiedError(Error, ValueError):
    """Cells that cannot be certified; the message names the cell and the reason."""

    code = 4


class OutsideError(Error, ValueError):
    """A body that starts outside free space or across a wall."""

    code = 5
