# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""The errors that mwmesh raises."""


class Error(Exception):
    """Any error of mwmesh.  The message names the thing, the reason and the way out."""

    option = ""  #: the argument that it is about, where the library tells


class InternalError(Error):
    """An invariant broke: please report it, with the volume and the settings."""


class UsageError(Error, ValueError):
    """An argument or a setting that makes no sense."""


class InputError(Error, ValueError):
    """A volume or file that is unreadable, damaged or unsupported."""


class ResourceError(Error):
    """Memory, disk or threads do not suffice."""


class CheckFailedError(Error):
    """The mesh does not pass its own check, and is not returned or written."""


class CancelledError(Error):
    """The run was cancelled."""


class MissingPackageError(Error, ImportError):
    """A package that the call needs is not installed."""


_KINDS = {
    1: InternalError,
    2: UsageError,
    3: InputError,
    4: ResourceError,
    5: CheckFailedError,
    6: CancelledError,
}


#: Options that go by another name here.
NAMES = {"from": "from_kept", "measure": "report"}


def error_of(kind, message, option):
    """Returns an error of the library, whose message names the argument that it is about."""
    option = NAMES.get(option, option)
    error = _KINDS.get(kind, Error)(message if option in message else f"{option}: {message}")
    error.option = option
    return error
