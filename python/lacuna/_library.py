# SPDX-License-Identifier: MIT
"""liblacuna by ctypes: an interpreter for each thread, and calls that a signal or a callback can stop."""
from __future__ import annotations

import _thread
import atexit
import ctypes
import logging
import os
import queue
import threading
import weakref

from ._wire import plain, without_folder

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

# Found here, as a signal that raises within getLogger() would leave the lock of all loggers held.
_logger = logging.getLogger("lacuna")
_logger.isEnabledFor(logging.INFO)  # kept by the logger, which does not take the lock for it again

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
        self.inner = None  # a call that a callback of this one made
        self.inbox = queue.SimpleQueue()  # notes, shares of stages; None: it has ended
        self.result = self.error = None
        self.stopped = False
        self._guard = threading.Lock()
        self._running = self._ended = False

    def run(self):
        if self.thread is not None:
            return
        self.thread = _thread.get_ident()
        try:
            self.interpreter._held(self._run)
        except Error as error:
            self.error = error
        finally:
            self._ended = True
            self.inbox.put(None)

    def _run(self):
        own = self.interpreter
        outer, _local.job, own._job = getattr(_local, "job", None), self, self
        try:
            with self._guard:
                self._running = not self.stopped and not _ends(self.caller)
            if self._running:
                self.result = self.read(own._exchange(self.request))
        except BaseException as error:  # goes on in the caller
            self.error = self.error or error
        finally:
            with self._guard:
                self._running = False
            _local.job, own._job = outer, None
            own._settle(self.stopped)

    def stop(self):
        with self._guard:
            self.stopped = True
            if self._running:
                _library.lacuna_cancel(self.interpreter._handle)
            inner = self.inner
        if inner is not None:
            inner.stop()

    def run_inside(self, outer):
        """On this thread, in a callback of another job, which stops both."""
        with outer._guard:
            outer.inner, self.stopped = self, outer.stopped
        self.run()
        outer.inner = None

    def wait(self, jobs=None):
        """The result, once it was put into the queue. What a signal's handler or the progress callback raises stops the job and is raised;
        False from the callback stops it unless it is done before."""
        raised, unwanted = None, False
        while True:
            try:
                if jobs is not None:
                    jobs.put(self)  # again, if a signal comes before the next line: it runs once
                    jobs = None
                if self._ended and self.inbox.empty():  # a signal may come while the last item is taken
                    break
                told = self.inbox.get()
                if isinstance(told, str):
                    _note(told)
                elif told is not None and raised is None and not unwanted \
                        and plain(self.progress(*told)) is False:
                    unwanted = True
                    self.stop()
            except BaseException as error:  # the job has to end first
                raised = raised or error
                self.stop()
        result, raised = self.result, raised or self.error
        if raised is None and unwanted and not (result and result[0]):
            raised = Error("stopped by the progress callback", "core.cancelled")
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
        if isinstance(job, _Job):
            job.run()
        elif isinstance(job, _Stand):
            interpreter = own()
            if interpreter is not None:
                interpreter._release(job)
            del interpreter
        elif isinstance(job, _thread.LockType):
            job.release()
        else:
            handle, _ = job  # and the callbacks, which have to stay until here
            _library.lacuna_close(handle)
            return
        del job  # nothing of it stays while the thread waits


class Interpreter:
    """An interpreter and the objects that live in it. Used by one thread at a time; others wait."""

    def __init__(self):
        self._lock = threading.RLock()  # which says whose it is: no signal comes between that and the lock
        self._job = None  # the one that runs
        self._jobs = queue.SimpleQueue()
        self._process = None  # in which a thread takes the jobs
        self._lost = False  # the process was forked during a call
        self._stands = {}  # by id: they hash as what they stand for
        self._notes = []
        own = weakref.ref(self)
        self._callbacks = (_Text(lambda _, text, length: own()._log(ctypes.string_at(text, length))),
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

        _interpreters.add(self)

    def __del__(self):
        """The thread that takes jobs closes it, as it may be releasing an object: a weak reference still
        gives what is being deleted."""
        handle, self._handle = getattr(self, "_handle", None), None
        if handle is None or _library is None:
            return
        if self._process == os.getpid():
            self._jobs.put((handle, self._callbacks))
        else:
            _library.lacuna_close(handle)

    def call(self, request, callables, read, at_once):
        """Send a request, and return what `read` makes of the answer."""
        me = _thread.get_ident()
        running = self._job
        if self._lock._is_owned() or running is not None and me in (running.caller, running.thread):
            raise _busy("a callback cannot use objects of the thread that it is called for",
                        "make the call when the one that runs is done")
        if self._lost:
            raise _busy("the process was forked while a call used these objects",
                        "make them again in this process")
        outer = getattr(_local, "job", None)  # this is a callback, on the thread of a job
        try:
            if self._process != os.getpid():
                self._held(self._start)
            if at_once and outer is None:
                return self._held(self._look_up, request, read)
            job = _Job(self, request, callables, read, getattr(_local, "progress", None))
            if outer is None:
                return job.wait(self._jobs)
            job.run_inside(outer)
            return job.wait()
        finally:
            while self._notes:
                _note(self._notes.pop(0))
            if _ends(me):
                _stay()

    def buffer(self, number):
        found = _Buffer()
        name = b"lacuna_python.objects.%d" % number
        self._held(lambda: self._check(_library.lacuna_get_buffer(self._handle, name, found)))
        return found

    def _held(self, work, *arguments):
        """What `work` returns with the lock held. Callbacks do not wait for a job: two could wait for each
        other. Look-ups and releases are short, and wait for nothing."""
        if getattr(_local, "job", None) is None:
            with self._lock:
                return work(*arguments)
        while not self._lock.acquire(timeout=0.01):
            if self._job is None:
                continue
            raise _busy("another thread's call uses these objects, and a callback does not wait for it",
                        "give each thread objects of its own")
        try:
            return work(*arguments)
        finally:
            self._lock.release()

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

    def _start(self):
        """A thread that takes jobs; there is none yet in a process that was forked."""
        if self._process != os.getpid():
            _thread.start_new_thread(_work, (self._jobs, weakref.ref(self)))
            self._process = os.getpid()

    def _look_up(self, request, read):
        if _ends(_thread.get_ident()):
            raise Error("Python ends", "core.cancelled")
        return read(self._exchange(request))

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

    def _log(self, line):
        text = without_folder(line.decode("utf-8", "replace"))
        if self._job is not None:
            self._job.inbox.put(text)
        else:
            self._notes.append(text)

    def _tell(self, stage, share):
        job = self._job
        if job is not None and job.progress is not None:
            job.inbox.put((stage.decode(), share))
        return 0

    def _host(self, arguments, count, results, room):
        job = self._job
        if job.stopped:
            return -1
        try:
            function = job.callables[int(arguments[0])]
            value = function(*arguments[1:count])
            if getattr(value, "ndim", None) == 1 and hasattr(value, "tolist"):
                value = value.tolist()  # an array of numpy: a point
            values = value if isinstance(value, (tuple, list)) and len(value) <= room else (value,)
            try:
                for number, one in enumerate(values):
                    results[number] = one
            except TypeError:
                name = getattr(function, "__name__", function)
                raise TypeError(f"the function {name} has to return a number or a list of numbers, found {value!r}") from None
            return len(values)
        except BaseException as error:  # goes on in the caller
            job.error = error
            return -1


def _busy(what, remedy):
    return Error(f"{what}; {remedy}", "lua.busy", remedy=remedy)


def _note(text):
    """Notes are warnings, which logging shows on standard error unless the program says otherwise."""
    level = logging.WARNING if text.startswith("note: ") else logging.INFO
    _logger.log(level, "%s", text)


# --- forks and the end of Python --------------------------------------------------------------------------

_interpreters = weakref.WeakSet()
_ending = None  # the thread that ends Python
_CALLBACKS_END = 5.0  # seconds; a callback that takes longer is left alone
_held_for_fork = []


def _ends(thread):
    """Whether Python ends, and the thread's calls with it."""
    return _ending not in (None, thread)


def _stay():
    """For threads that Python does not wait for: they end with the process."""
    lock = threading.Lock()
    lock.acquire()
    lock.acquire()


def _end():
    """Callbacks are not called any more, so jobs of other threads have to end before Python does."""
    global _ending
    _ending = _thread.get_ident()
    for own in list(_interpreters):
        job = own._job
        if job is not None:
            job.stop()
        if not own._lost and own._lock.acquire(timeout=_CALLBACKS_END):
            own._lock.release()


def _forks():
    """Objects that were dropped are released first; a call that runs is not waited for. The queue of jobs is
    left with its thread waiting for more: between an item and the thread that it woke, it would be copied
    into the new process as woken, and nothing would wake it there."""
    for own in list(_interpreters):
        if own._job is not None or own._lock._is_owned():
            continue
        if own._process == os.getpid():
            waiting = threading.Lock()
            waiting.acquire()
            own._jobs.put(waiting)
            waiting.acquire(timeout=_CALLBACKS_END)
        if own._lock.acquire(timeout=_CALLBACKS_END):
            _held_for_fork.append(own)


def _forked_here():
    while _held_for_fork:
        _held_for_fork.pop()._lock.release()


def _forked():
    """In the new process no thread takes jobs, and those of other threads are not its own."""
    _forked_here()
    for own in list(_interpreters):
        own._lost = own._lock._is_owned() or not own._lock.acquire(blocking=False)
        if not own._lost:
            own._lock.release()
        waiting = []
        while not own._jobs.empty():
            waiting.append(own._jobs.get_nowait())
        for item in waiting:
            if isinstance(item, _Stand):
                own._jobs.put(item)


atexit.register(_end)
os.register_at_fork(before=_forks, after_in_parent=_forked_here, after_in_child=_forked)

_local = threading.local()


def own_interpreter():
    """That of this thread."""
    own = getattr(_local, "interpreter", None)
    if own is None or own._lost:
        own = _local.interpreter = Interpreter()
    return own


class progress:
    """Calls made within report how far they are: `with lacuna.progress(callback): ...`

    callback(stage, share)   the stage's name when it begins, with the share 0, which rises to 1 while CAD is
                             read; on the calling thread. Returning False, or raising, stops the call.
    """

    def __init__(self, callback):
        self._callback = callback
        self._before = []

    def __enter__(self):
        self._before.append(getattr(_local, "progress", None))
        _local.progress = self._callback
        return self

    def __exit__(self, *_):
        _local.progress = self._before.pop()
