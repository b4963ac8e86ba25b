# SPDX-License-Identifier: MIT
"""liblacuna by ctypes: an interpreter for each thread, and calls that a signal or a callback can stop."""
from __future__ import annotations

import _thread
import ctypes
import os
import queue
import threading
import weakref

VERSION = "0.1.0"
_OK, _FAILED, _CANCELLED = 0, 1, 2
_folder = os.path.dirname(os.path.realpath(__file__))


class Error(Exception):
    """A call failed. It prints as one message, with its code.

    message   what was expected, what was found, what to try
    code      "folder.what_went_wrong": does not change between versions
    entities  list of what the message names, each with `kind` ("face", "edge", "node" …) and `tag`
    found     list of numbers and texts: what the input has
    needed    list of numbers and texts: what it would need instead
    remedy    the part of the message that says what to try, or None
    attempts  list of `message`, `code` and `entities`: why what was tried instead failed too
    """

    __module__ = "lacuna"

    def __init__(self, message, code="core.unexpected", entities=(), found=(), needed=(), remedy=None,
                 attempts=()):
        super().__init__(message, code, entities, found, needed, remedy, attempts)
        self.message = message
        self.code = code
        self.entities = list(entities)
        self.found = list(found)
        self.needed = list(needed)
        self.remedy = remedy
        self.attempts = list(attempts)

    def __str__(self):
        return f"{self.message} [{self.code}]"


# --- the C interface, as in lacuna.h --------------------------------------------------------------------

_Progress = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_double)
_Text = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.POINTER(ctypes.c_char), ctypes.c_size_t)
_Function = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.POINTER(ctypes.c_double), ctypes.c_size_t,
                             ctypes.POINTER(ctypes.c_double), ctypes.c_size_t)


class _Options(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("user", ctypes.c_void_p), ("print", ctypes.c_void_p),
                ("log", _Text), ("progress", _Progress), ("cancelled", ctypes.c_void_p),
                ("memory", ctypes.c_size_t), ("instructions", ctypes.c_uint64),
                ("output_folder", ctypes.c_char_p), ("sandbox", ctypes.c_int), ("traceback", ctypes.c_int),
                ("threads", ctypes.c_int)]


class _Buffer(ctypes.Structure):
    _fields_ = [("data", ctypes.c_void_p), ("rows", ctypes.c_size_t), ("columns", ctypes.c_size_t),
                ("type", ctypes.c_int)]


def _load():
    """LACUNA_LIBRARY, else that in the wheel, of a build of the clone, of an installation, of the system."""
    named = os.environ.get("LACUNA_LIBRARY")
    wheel = os.path.join(_folder, "lib", "liblacuna.so")
    build = os.path.join(_folder, "..", "..", "build", "release", "liblacuna.so")
    prefix = os.path.join(_folder, "..", "..", "..", "liblacuna.so.0.1")
    places = [named] if named else [path for path in (wheel, build, prefix) if os.path.exists(path)]
    try:
        lua = os.path.join(_folder, "lib", "liblua5.4.so.0")
        if os.path.exists(lua):  # found by the library under its name
            ctypes.CDLL(lua)
        library = ctypes.CDLL((places + ["liblacuna.so.0.1"])[0])
    except OSError as error:
        raise ImportError(f"liblacuna is not there ({error}); install the wheel or liblacuna0.1, or name the "
                          "library in LACUNA_LIBRARY") from None
    handle, text, size = ctypes.c_void_p, ctypes.c_char_p, ctypes.c_size_t
    for name, result, *arguments in [
        ("version", text), ("default_options", None, ctypes.POINTER(_Options)),
        ("open", handle, ctypes.POINTER(_Options)), ("close", None, handle), ("cancel", None, handle),
        ("run_string", ctypes.c_int, handle, text, size, text),
        ("set_string", ctypes.c_int, handle, text, text, size),
        ("get_string", ctypes.c_int, handle, text, ctypes.POINTER(ctypes.c_void_p), ctypes.POINTER(size)),
        ("get_buffer", ctypes.c_int, handle, text, ctypes.POINTER(_Buffer)),
        ("set_function", ctypes.c_int, handle, text, _Function, handle),
        ("error_message", text, handle), ("error_code", text, handle),
    ]:
        function = getattr(library, "lacuna_" + name)
        function.restype, function.argtypes = result, arguments
    if library.lacuna_version().decode() != VERSION:
        raise ImportError(f"this is lacuna {VERSION} for Python, and the library is of version "
                          f"{library.lacuna_version().decode()}; install both of one version")
    return library


_library = _load()

# --- calls ------------------------------------------------------------------------------------------------


class _Job:
    """A call on the interpreter's own thread, while the caller waits: so signals reach the caller at once."""

    def __init__(self, interpreter, request, callables, read, progress):
        self.interpreter = interpreter
        self.request = request
        self.callables = callables
        self.read = read
        self.progress = progress
        self.caller = _thread.get_ident()
        self.thread = None
        self.inbox = queue.SimpleQueue()  # shares of stages; None: it has ended
        self.result = self.error = None
        self._guard = threading.Lock()
        self._running = self._stopped = self._ended = False

    def run(self):
        own = self.interpreter
        self.thread = _thread.get_ident()
        try:
            with own._lock:
                own._job = self
                try:
                    with self._guard:
                        self._running = not self._stopped
                    if self._running:
                        self.result = self.read(own._exchange(self.request))
                except BaseException as error:  # goes on in the caller
                    self.error = self.error or error
                finally:
                    with self._guard:
                        self._running = False
                    own._job = None
                    own._settle(self._stopped)
        finally:
            self._ended = True
            self.inbox.put(None)

    def stop(self):
        with self._guard:
            self._stopped = True
            if self._running:
                _library.lacuna_cancel(self.interpreter._handle)

    def wait(self):
        """The result. What a signal's handler or the progress callback raises stops the job and is raised."""
        raised = None
        while True:
            try:
                if self._ended and self.inbox.empty():  # a signal may come while the last item is taken
                    break
                told = self.inbox.get()
                if told is not None and raised is None and self.progress(*told) is False:
                    raised = Error("stopped by the progress callback", "core.cancelled")
                    self.stop()
            except BaseException as error:  # the job has to end first
                raised = raised or error
                self.stop()
        result, raised = self.result, raised or self.error
        self.result = self.error = None
        if raised is None:
            return result
        try:
            raise raised
        finally:
            del raised, result  # they would keep this frame, and all arguments, until the next collection


class _Stand(weakref.ref):
    """Kept while an object of Python stands for one in the interpreter. The end of the former puts this into
    the queue of jobs, without a line of Python that a signal could interrupt."""

    __slots__ = ("number",)


def _work(jobs, own):
    while True:
        job = jobs.get()
        if job is None:
            return
        if isinstance(job, _Stand):
            interpreter = own()
            if interpreter is not None:
                interpreter._release(job)
            del interpreter
        else:
            job.run()
        del job  # nothing of it stays while the thread waits


class Interpreter:
    """An interpreter and the objects that live in it. Used by one thread at a time; others wait."""

    def __init__(self):
        self._lock = threading.Lock()
        self._job = None  # the one that runs
        self._jobs = self._process = None
        self._stands = {}  # by id: they hash as what they stand for
        own = weakref.ref(self)
        self._callbacks = (_Text(lambda _, text, length: _note(ctypes.string_at(text, length))),
                           _Progress(lambda _, stage, share: own()._tell(stage, share)),
                           _Function(lambda _, *arguments: own()._host(*arguments)))
        options = _Options()
        _library.lacuna_default_options(options)
        options.log, options.progress = self._callbacks[:2]
        self._handle = _library.lacuna_open(options)
        if not self._handle:
            raise MemoryError
        with open(os.path.join(_folder, "bridge.lua"), "rb") as file:
            bridge = file.read()
        self._check(_library.lacuna_run_string(self._handle, bridge, len(bridge), b"bridge.lua"))
        self._check(_library.lacuna_set_function(self._handle, b"lacuna_python.host", self._callbacks[2],
                                                 None))

    def __del__(self):
        if getattr(self, "_handle", None) and _library is not None:
            _library.lacuna_close(self._handle)
            if self._jobs:
                self._jobs.put(None)

    def call(self, request, callables, read, at_once):
        """Send a request, and return what `read` makes of the answer."""
        me = _thread.get_ident()
        running = self._job
        if running is not None and me in (running.caller, running.thread):
            remedy = "make the call when the one that runs is done"
            raise Error(f"a callback cannot use objects of the thread that it is called for; {remedy}",
                        "lua.busy", remedy=remedy)
        if self._process != os.getpid():  # no thread yet, or none in a process that was forked
            self._process, self._jobs = os.getpid(), queue.SimpleQueue()
            _thread.start_new_thread(_work, (self._jobs, weakref.ref(self)))
        if at_once:
            with self._lock:
                return read(self._exchange(request))
        job = _Job(self, request, callables, read, getattr(_local, "progress", None))
        self._jobs.put(job)
        return job.wait()

    def buffer(self, number):
        found = _Buffer()
        with self._lock:
            self._check(_library.lacuna_get_buffer(self._handle, b"lacuna_python.objects.%d" % number, found))
        return found

    def stand(self, made, number):
        """`made` stands for an object from now on, which is released when it ends."""
        made._interpreter, made._number = self, number
        stand = _Stand(made, self._jobs.put)
        stand.number = number
        self._stands[id(stand)] = stand

    def _release(self, stand):
        del self._stands[id(stand)]
        text = b"lacuna_python.release(%d)" % stand.number
        with self._lock:  # if that fails, the object stays as long as the interpreter
            _library.lacuna_run_string(self._handle, text, len(text), None)

    # With the lock held:

    def _exchange(self, request):
        self._check(_library.lacuna_set_string(self._handle, b"lacuna_python.request", request, len(request)))
        try:
            self._run(b"lacuna_python.call()")
        except Error:
            self._run(b"lacuna_python.forget()")
            raise
        data, length = ctypes.c_void_p(), ctypes.c_size_t()
        self._check(_library.lacuna_get_string(self._handle, b"lacuna_python.answer", data, length))
        return ctypes.string_at(data, length.value)

    def _settle(self, stopped):
        """After a job: a request to stop that came too late would stop the next one."""
        if stopped:
            _library.lacuna_run_string(self._handle, b"", 0, None)

    def _run(self, text):
        self._check(_library.lacuna_run_string(self._handle, text, len(text), b"python"))

    def _check(self, status):
        if status == _OK:
            return
        raise Error(_library.lacuna_error_message(self._handle).decode("utf-8", "replace"),
                    _library.lacuna_error_code(self._handle).decode())

    # Called by the library, on the thread of the job:

    def _tell(self, stage, share):
        job = self._job
        if job is not None and job.progress is not None:
            job.inbox.put((stage.decode(), share))
        return 0

    def _host(self, arguments, count, results, room):
        job = self._job
        try:
            results[0] = job.callables[int(arguments[0])](*arguments[1:count])
            return 1
        except BaseException as error:  # goes on in the caller
            job.error = error
            return -1


def _note(line):
    """Notes are warnings, which logging shows on standard error unless the program says otherwise."""
    import logging
    text = line.decode("utf-8", "replace")
    level = logging.WARNING if text.startswith("note: ") else logging.INFO
    logging.getLogger("lacuna").log(level, "%s", text)


_local = threading.local()


def own_interpreter():
    """That of this thread."""
    try:
        return _local.interpreter
    except AttributeError:
        _local.interpreter = Interpreter()
        return _local.interpreter


class progress:
    """Calls made within report how far they are: `with lacuna.progress(callback): ...`

    callback(stage, share)   the stage's name and its share done, from 0 to 1; on the calling thread.
                             Returning False, or raising, stops the call.
    """

    def __init__(self, callback):
        self._callback = callback

    def __enter__(self):
        self._before = getattr(_local, "progress", None)
        _local.progress = self._callback
        return self

    def __exit__(self, *_):
        _local.progress = self._before
