# SPDX-License-Identifier: MIT
"""Lacuna in FreeCAD: filled voids as objects of a document."""
