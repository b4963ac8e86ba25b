# SPDX-License-Identifier: MIT
"""Values of Python as bytes and back. The twin of this file is bridge.lua."""
from __future__ import annotations

import io
import os
import re
import struct
from collections.abc import Iterable, Mapping

_INTEGER = struct.Struct("<cq")
_NUMBER = struct.Struct("<cd")
_COUNTS = struct.Struct("<qq")
_WHOLE = struct.Struct("<q")
_REAL = struct.Struct("<d")

HANDED_OVER = "lacuna-handed-over-"  # begins the names of the folders that meshes of meshio and PyVista pass through
_HANDED_OVER_FILE = re.compile(rf"[^\s'\";]*/{HANDED_OVER}[^/]*/(.*? mesh)\.(?:vtu|msh)")


def without_folder(text):
    """Such a file is called "the meshio mesh": its path would tell nobody anything."""
    return _HANDED_OVER_FILE.sub(r"\1", text) if HANDED_OVER in text else text


class Table(dict):
    """What a call returns: a dict whose keys are attributes too. A key that is a word of Python has `_`
    behind its name: `edge.from_`."""

    __slots__ = ()

    def __getattr__(self, name):
        try:
            return self[name[:-1] if name.endswith("_") else name]
        except KeyError:
            raise AttributeError(f"no field {name!r}; there are: {', '.join(map(str, self))}") from None


class Report(list):
    """Lines that say what was done; prints as lines. `seconds` and the like are attributes."""

    def __str__(self):
        return "\n".join(map(str, self))


class NoFaces(list):
    """The empty result of a selection by a selector of these `words`. A role refuses it, so that a selector that
    matches nothing is not taken for `[]`, a role without faces."""

    __slots__ = ("words",)

    def __init__(self, words):
        super().__init__()
        self.words = words

    def __add__(self, other):
        nothing = isinstance(other, NoFaces) and not self and not other
        return NoFaces(self.words) if nothing else super().__add__(other)


def plain(value):
    """A scalar of numpy, or an array without dimensions, as a value of Python; others as they are."""
    return value.item() if getattr(value, "ndim", None) == 0 and hasattr(value, "item") else value


class _Refused(Exception):
    """What no call takes, and where it stands: the keys and indices that lead to it."""

    def __init__(self, what):
        self.what = what
        self.where = ""

    def inside(self, place):
        self.where = place + self.where


class Request:
    """The bytes of one call, and what they refer to. It lives until the answer is there."""

    def __init__(self, object_class):
        self.parts = []
        self.callables = []
        self.objects = []  # those that a generator made have no other reference
        self.interpreter = None  # that of the objects among the arguments
        self._object_class = object_class

    def put(self, value):
        parts = self.parts
        if value is None:
            parts.append(b"N")
        elif value is True:
            parts.append(b"T")
        elif value is False:
            parts.append(b"F")
        elif isinstance(value, str):
            self._put_bytes(value.encode("utf-8", "surrogateescape"))
        elif isinstance(value, float):
            parts.append(_NUMBER.pack(b"d", value))
        elif isinstance(value, int):
            self._put_whole(value)
        elif isinstance(value, self._object_class):
            self._put_object(value)
        elif isinstance(value, Mapping):
            self._put_map(value)
        elif isinstance(value, NoFaces) and not value:
            parts.append(b"E")
            self._put_bytes(value.words.encode("utf-8", "surrogateescape"))
        elif isinstance(value, (list, tuple)):
            self._put_list(value)
        elif isinstance(value, os.PathLike):
            self._put_bytes(os.fsencode(value))
        elif isinstance(value, bytes):
            self._put_bytes(value)
        elif type(plain(value)) is not type(value):
            self.put(plain(value))
        elif hasattr(value, "__array_interface__") and getattr(value, "ndim", 0) > 0:
            self._put_array(value)
        elif callable(value):
            parts.append(_INTEGER.pack(b"f", len(self.callables)))
            self.callables.append(value)
        elif isinstance(value, Iterable) and not isinstance(value, io.IOBase):
            self._put_list(list(value))
        elif hasattr(value, "__index__"):
            self._put_whole(value.__index__())
        elif hasattr(value, "__float__"):
            parts.append(_NUMBER.pack(b"d", float(value)))
        else:
            raise _Refused(f"Lacuna takes no {type(value).__name__}")

    def _put_whole(self, value):
        if not -2**63 <= value < 2**63:
            raise _Refused(f"{value} is too large")
        self.parts.append(_INTEGER.pack(b"i", value))

    def _put_map(self, values):
        self.parts.append(_INTEGER.pack(b"{", len(values)))
        for key, item in values.items():
            if key is None:
                raise _Refused("None is no key")
            self.put(key)
            try:
                self.put(item)
            except _Refused as refused:
                refused.inside(f".{key}")
                raise

    def _put_list(self, values):
        self.parts.append(_INTEGER.pack(b"[", len(values)))
        try:
            for i, item in enumerate(values):
                if item is None:  # in Lua the list would end here
                    raise _Refused("a list cannot hold None")
                self.put(item)
        except _Refused as refused:
            refused.inside(f"[{i}]")
            raise

    def _put_bytes(self, data):
        if 0 in data:
            raise _Refused(f"no text can hold a zero byte, found {data!r}")
        self.parts.append(_INTEGER.pack(b"s", len(data)))
        self.parts.append(data)

    def _put_object(self, value):
        if self.interpreter not in (None, value._interpreter):
            raise ValueError("these objects were made in different threads, and one call cannot take both")
        self.interpreter = value._interpreter
        self.objects.append(value)
        self.parts.append(_INTEGER.pack(b"o", value._number))

    def _put_array(self, array):
        """A block of numbers; other arrays as lists."""
        kind = {"f": (b"<d", "<f8"), "i": (b"<i8", "<i8"), "u": (b"<i8", "<i8")}.get(array.dtype.kind)
        masked = getattr(array, "mask", False) is not False and array.mask.any()
        if kind is None or array.ndim > 2 or 0 in array.shape or masked \
                or array.dtype.kind == "u" and array.max() >= 2**63:
            self._put_list(array.tolist())  # None where it is masked
            return
        rows, columns = array.shape[0], array.shape[1] if array.ndim == 2 else 0
        self.parts.append(b"a" + bytes([len(kind[0])]) + kind[0] + _COUNTS.pack(rows, columns))
        self.parts.append(array.astype(kind[1], copy=False).tobytes())

    def bytes(self, values):
        """A count, and the values."""
        try:
            for value in values:
                self.put(value)
        except _Refused as refused:
            where = refused.where.lstrip(".")
            raise TypeError(f"{where}: {refused.what}" if where else refused.what) from None
        return _WHOLE.pack(len(values)) + b"".join(self.parts)


class Answer:
    """Reads the values of an answer. `make_object(class, number)` makes what stands for an object."""

    def __init__(self, data, make_object):
        self._data = data
        self._at = 0
        self._make_object = make_object

    def take(self, count):
        begin = self._at
        self._at = begin + count
        return self._data[begin:self._at]

    def whole(self):
        value, = _WHOLE.unpack_from(self._data, self._at)
        self._at += 8
        return value

    def text(self):
        return without_folder(self.take(self.whole()).decode("utf-8", "surrogateescape"))

    def value(self):
        tag = self.take(1)
        if tag == b"d":
            value, = _REAL.unpack_from(self._data, self._at)
            self._at += 8
            return value
        if tag == b"i":
            return self.whole()
        if tag == b"s":
            return self.text()
        if tag == b"o":
            number = self.whole()
            return self._make_object(self.text(), number)
        if tag == b"E":
            self.take(1)  # the letter of a text
            return NoFaces(self.text())
        if tag in (b"t", b"R"):
            return self._table(tag)
        return {b"N": None, b"T": True, b"F": False}[tag]

    def _table(self, tag):
        count, others = self.whole(), self.whole()
        items = [self.value() for _ in range(count)]
        named = {}
        for _ in range(others):
            key = self.value()
            named[key] = self.value()
        if tag == b"R":
            report = Report(items)
            report.__dict__.update(named)
            return report
        if not named:
            return items
        table = Table(enumerate(items, 1))
        table.update(sorted(named.items(), key=lambda item: (isinstance(item[0], str), item[0])))
        return table
