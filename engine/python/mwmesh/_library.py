# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Loads the library and calls it (engine/mwmesh_c.h says what each function does).

The interpreter must not end while a thread is in the library: a thread that asks for its lock too
late is ended by force, which aborts a program that has C++ on the stack.  So each call is counted,
and at the end the long ones are stopped and all are waited for."""

import atexit
import collections
import contextlib
import ctypes
import math
import os
import sys
import threading
import time
import warnings
from ctypes import POINTER, byref, c_char_p, c_double, c_int, c_int64, c_size_t, c_uint64, c_void_p

from ._errors import Error, UsageError, error_of
from ._version import LIBRARY, VERSION

_FOLDER = os.path.dirname(os.path.abspath(__file__))
#: How often a thread that waits for a run looks at signals and progress, in seconds.
_LOOK = 0.1
#: The kind of an error that a function of ours has caused.
_CALLBACK = 7


class Column(ctypes.Structure):
    """mw_column: numbers of a mesh."""
    _fields_ = [("data", c_void_p), ("rows", c_size_t), ("width", c_size_t), ("type", c_int)]


class Name(ctypes.Structure):
    """mw_name: the name and the colour of a label."""
    _fields_ = [("label", c_uint64), ("name", c_char_p), ("colour", ctypes.c_uint8 * 4),
                ("has_colour", c_int)]


class Space(ctypes.Structure):
    """mw_space: where a volume lies."""
    _fields_ = [("spacing", c_double * 3), ("origin", c_double * 3), ("axes", c_double * 3 * 3),
                ("unit", c_char_p), ("frame", c_char_p)]


_PROGRESS = ctypes.CFUNCTYPE(None, c_void_p, c_uint64, c_uint64, c_double)
_CANCEL = ctypes.CFUNCTYPE(c_int, c_void_p)
_WARN = ctypes.CFUNCTYPE(None, c_void_p, c_char_p)
#: Reads the labels of a box.
Reader = ctypes.CFUNCTYPE(c_int, c_void_p, POINTER(c_int64), POINTER(c_int64), c_void_p)


class _Hooks(ctypes.Structure):
    """mw_hooks: what watches a run."""
    _fields_ = [("size", c_size_t), ("data", c_void_p), ("progress", _PROGRESS),
                ("cancel", _CANCEL), ("warn", _WARN), ("stop", POINTER(c_int))]


_SPACE, _NAMES, _COLUMN = POINTER(Space), POINTER(Name), POINTER(Column)
_HOOKS, _INDEX, _LABEL = POINTER(_Hooks), POINTER(c_int64), POINTER(c_uint64)
#: What functions return, and what they take.
_CERTAIN = {
    "version": (c_char_p,), "free": (None, c_void_p),
    "error_kind": (c_int, c_void_p), "error_text": (c_char_p, c_void_p),
    "error_option": (c_char_p, c_void_p), "error_free": (None, c_void_p),
    "options_free": (None, c_void_p), "options_table": (c_char_p,),
    "volume_free": (None, c_void_p), "volume_shape": (None, c_void_p, _INDEX),
    "volume_type": (c_int, c_void_p), "volume_is_signed": (c_int, c_void_p),
    "volume_space": (None, c_void_p, _SPACE),
    "volume_names": (c_size_t, c_void_p, POINTER(_NAMES)),
    "mesh_free": (None, c_void_p), "mesh_value_count": (c_size_t, c_void_p),
    "mesh_values": (c_char_p, c_void_p, c_size_t, _COLUMN),
    "mesh_names": (c_size_t, c_void_p, POINTER(_NAMES)),
    "mesh_text": (c_char_p, c_void_p, c_char_p), "mesh_is_in_parts": (c_int, c_void_p),
}
#: The same of those that take the place of an error last.
_FALLIBLE = {
    "options_new": (c_void_p,), "options_set": (c_int, c_void_p, c_char_p, c_char_p),
    "space_of_affine": (c_int, c_void_p, c_char_p, c_void_p, _SPACE),
    "volume_open": (c_void_p, c_char_p, c_void_p, _HOOKS),
    "volume_of_array": (c_void_p, c_void_p, c_int, _INDEX, _INDEX, _SPACE),
    "volume_of_reader": (c_void_p, c_int, _INDEX, _INDEX, _SPACE, Reader, c_void_p),
    "volume_with_names": (c_void_p, c_void_p, _NAMES, c_size_t),
    "volume_read_names": (c_void_p, c_void_p, c_char_p),
    "volume_read": (c_int, c_void_p, _INDEX, _INDEX, c_void_p),
    "volume_find_label": (c_int, c_void_p, c_char_p, _LABEL),
    "synth": (c_int, c_char_p, _INDEX, c_uint64, c_uint64, c_void_p),
    "make_mesh": (c_void_p, c_void_p, c_void_p, _HOOKS),
    "mesh_to_file": (c_int, c_char_p, c_void_p, c_void_p, _HOOKS, POINTER(c_void_p)),
    "mesh_read": (c_void_p, c_char_p),
    "mesh_of_arrays": (c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_size_t, c_int),
    "mesh_column": (c_int, c_void_p, c_char_p, _COLUMN),
    "mesh_set_values": (c_int, c_void_p, c_char_p, c_void_p, c_size_t),
    "mesh_set_names": (c_int, c_void_p, _NAMES, c_size_t),
    "mesh_read_names": (c_int, c_void_p, c_char_p),
    "mesh_set_record": (c_int, c_void_p, c_char_p, c_int),
    "mesh_find_label": (c_int, c_void_p, c_char_p, _LABEL),
    "mesh_write": (c_int, c_void_p, c_char_p, c_void_p),
    "mesh_digest": (c_void_p, c_void_p), "mesh_summary": (c_void_p, c_void_p, c_char_p),
    "mesh_picture": (c_void_p, c_void_p, c_int, c_int, POINTER(c_size_t)),
    "verify": (c_void_p, c_void_p, c_void_p, c_void_p, _HOOKS, POINTER(c_int)),
}


def _load():
    """Returns the library: the one beside the modules, that of their prefix, or the system's."""
    places = os.path.join(_FOLDER, "libmwmesh.so"), os.path.normpath(os.path.join(_FOLDER, LIBRARY))
    file = next(filter(os.path.exists, places), os.path.basename(LIBRARY))
    try:
        # What the library needs is found from where it lies, not from a link to it.
        library = ctypes.CDLL(os.path.realpath(file) if os.path.exists(file) else file)
        for name, (result, *arguments) in _CERTAIN.items():
            function = getattr(library, f"mw_{name}")
            function.restype, function.argtypes = result, arguments
        version = library.mw_version().decode()
        if version != VERSION:
            raise OSError(f"it is of version {version}")
        for name, (result, *arguments) in _FALLIBLE.items():
            function = getattr(library, f"mw_{name}")
            function.restype, function.argtypes = result, [*arguments, POINTER(c_void_p)]
    except (OSError, AttributeError) as error:
        raise ImportError(f"mwmesh: {file} is not the library of the modules in {_FOLDER}, which "
                          f"are of version {VERSION}: {error}; build the target mwmesh_python "
                          "again, or reinstall the package") from None
    return library


LIB = _load()

_running = {}  # the stop flag, or None, of each call that is in the library
_ending = None  # the thread that ends the interpreter, which may still call what it likes


def _is_late():
    """Whether the interpreter ends, and by another thread."""
    return _ending not in (None, threading.get_ident())


@contextlib.contextmanager
def _counted(stop=None):
    """Counts a call.  It is counted before the end is looked at, and the end comes before the count
    is looked at, so none is missed.  A thread that is late ends silently: Python aborts where it
    prints an error while the interpreter ends."""
    call = object()
    _running[call] = stop
    try:
        if _is_late():
            raise SystemExit
        yield
    except Error:
        if _is_late():
            raise SystemExit from None
        raise
    finally:
        _running.pop(call, None)


@atexit.register
def _end_calls():
    global _ending
    _ending = threading.get_ident()
    while _running:
        for stop in list(_running.values()):
            if stop is not None:
                stop.value = 1
        time.sleep(_LOOK / 10)


# A child of os.fork() has one thread, whatever ran in its parent.
os.register_at_fork(after_in_child=_running.clear)


def checked(data, name):
    """Returns the bytes of a text.  A zero byte would end it."""
    if b"\0" in data:
        raise UsageError(f"{name}: {data!r} has a zero byte in it")
    return data


def encoded(text, name):
    return checked(text.encode("utf-8", "surrogateescape"), name)


def decoded(data):
    return (data or b"").decode("utf-8", "surrogateescape")


def taken(address, size=-1):
    """Returns the bytes at an address, whose memory this frees."""
    try:
        return ctypes.string_at(address, size) if address else b""
    finally:
        LIB.mw_free(address)


def _raise(error, arguments):
    """Raises the error of a call, or what a function of ours raised in it."""
    try:
        kind = LIB.mw_error_kind(error)
        told = decoded(LIB.mw_error_text(error)), decoded(LIB.mw_error_option(error))
    finally:
        LIB.mw_error_free(error)
    if kind == _CALLBACK:
        for failures in (getattr(argument, "failures", None) for argument in arguments):
            if failures:
                raise failures.pop()
    raise error_of(kind, *told)


def call(name, *arguments):
    """Calls a function that can fail, and raises its error."""
    error = c_void_p()
    with _counted():
        result = getattr(LIB, f"mw_{name}")(*arguments, byref(error))
        if error.value:
            _raise(error, arguments)
    return result


def _warn(lines):
    """Warns the caller of the package."""
    frame, level = sys._getframe(1), 2
    while frame.f_back and frame.f_code.co_filename.startswith(_FOLDER + os.sep):
        frame, level = frame.f_back, level + 1
    while lines:
        warnings.warn(lines.popleft(), RuntimeWarning, stacklevel=level)


def run(name, made, *arguments, progress=None, out=()):
    """Calls a function that takes mw_hooks, in a thread of its own, and returns made(result).

    Meanwhile this thread looks at signals, gives warnings, and tells the progress.  What one of
    these raises stops the call and is raised again."""
    news, lines, stop = collections.deque(maxlen=1), collections.deque(), c_int()
    results, error, done = [], c_void_p(), threading.Event()

    @_PROGRESS
    def take_news(_data, finished, total, left):
        news.append((finished, total, None if math.isnan(left) else left))

    @_WARN
    def take_line(_data, line):
        lines.append(decoded(line))

    hooks = _Hooks(ctypes.sizeof(_Hooks), None, _PROGRESS() if progress is None else take_news,
                   _CANCEL(), take_line, ctypes.pointer(stop))

    def work():
        try:
            result = getattr(LIB, f"mw_{name}")(*arguments, byref(hooks), *out, byref(error))
            if not error.value:
                results.append(made(result))
        finally:
            done.set()

    def look():
        _warn(lines)
        while news and progress is not None:
            progress(*news.popleft())

    with _counted(stop):
        if _ending is not None:  # no thread would run any more
            work()
        else:
            thread = threading.Thread(target=work, daemon=True)
            try:
                thread.start()
                while not done.wait(_LOOK):
                    look()
            except BaseException:
                stop.value = 1
                while thread.is_alive() and not done.is_set():  # there is none after a fork
                    with contextlib.suppress(KeyboardInterrupt):
                        done.wait()
                LIB.mw_error_free(error)
                raise
        if error.value:
            _raise(error, arguments)
    look()
    return results[0]
