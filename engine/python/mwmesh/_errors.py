# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""The errors that mwmesh raises."""


class Error(Exception):
    """Any error of mwmesh.  The message names the thing, the reason and the way out."""


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


def _error_of(kind, message):
    return _KINDS[kind](message)
