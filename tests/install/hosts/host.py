#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A host in Python, by ctypes and nothing else: host.py liblacuna.so

Buffers become arrays without a copy; numpy takes them as numpy.ctypeslib.as_array(...).
"""
import ctypes
import sys


class Buffer(ctypes.Structure):
    _fields_ = [("data", ctypes.c_void_p), ("rows", ctypes.c_size_t), ("columns", ctypes.c_size_t),
                ("type", ctypes.c_int)]


class LacunaError(Exception):
    """A recipe failed; code, line and entities as in Lua."""


class Lacuna:
    def __init__(self, path):
        self.library = ctypes.CDLL(path)
        self.library.lacuna_open.restype = ctypes.c_void_p
        for name in "text", "message", "code", "file", "entity":
            getattr(self.library, "lacuna_error_" + name).restype = ctypes.c_char_p
        self.library.lacuna_error_entity_count.restype = ctypes.c_size_t
        self.handle = ctypes.c_void_p(self.library.lacuna_open(None))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.library.lacuna_close(self.handle)

    def check(self, status):
        if status == 0:
            return
        error = LacunaError(self.library.lacuna_error_text(self.handle).decode())
        error.code = self.library.lacuna_error_code(self.handle).decode()
        error.line = self.library.lacuna_error_line(self.handle)
        error.entities = []
        for at in range(self.library.lacuna_error_entity_count(self.handle)):
            tag = ctypes.c_int64()
            kind = self.library.lacuna_error_entity(self.handle, ctypes.c_size_t(at), ctypes.byref(tag))
            error.entities.append((kind.decode(), tag.value))
        raise error

    def run(self, text):
        data = text.encode()
        self.check(self.library.lacuna_run_string(self.handle, data, ctypes.c_size_t(len(data)), None))

    def set_number(self, path, value):
        self.check(self.library.lacuna_set_number(self.handle, path.encode(), ctypes.c_double(value)))

    def number(self, path):
        value = ctypes.c_double()
        self.check(self.library.lacuna_get_number(self.handle, path.encode(), ctypes.byref(value)))
        return value.value

    def array(self, path):
        """Rows of a buffer, in place: as long as a variable of the recipe holds it."""
        buffer = Buffer()
        self.check(self.library.lacuna_get_buffer(self.handle, path.encode(), ctypes.byref(buffer)))
        of = ctypes.c_double if buffer.type == 0 else ctypes.c_int32
        return (of * buffer.columns * buffer.rows).from_address(buffer.data)


with Lacuna(sys.argv[1]) as lacuna:
    lacuna.set_number("height", 2.5)
    lacuna.run("""
        local lacuna = require "lacuna"
        local part = lacuna.synthetic.prism { sides = 4, height = height, drop = "walls" }
        local void = part:open_volume { source = "source", target = "target" }
        mesh = void:sweep { layers = 5, size = 0.25 }
        nodes, cells = mesh:coordinates(), mesh:cells()
    """)
    nodes, cells = lacuna.array("nodes"), lacuna.array("cells")
    top = max(row[2] for row in nodes) - min(row[2] for row in nodes)
    print(len(nodes), "nodes,", len(cells), "cells, height", top)
    assert abs(top - 2.5) < 1e-12 and len(cells) == lacuna.number("mesh.hexes")
    assert all(1 <= node <= len(nodes) for cell in cells for node in cell)
    try:
        lacuna.run("local part = require 'lacuna'.synthetic.prism {}\npart:face(99)")
        sys.exit("nothing failed")
    except LacunaError as error:
        print(error)
        assert error.line == 2 and error.entities[0][0] == "face", error.entities
