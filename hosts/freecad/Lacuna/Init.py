# SPDX-License-Identifier: MIT
# FreeCAD runs this at its start, with and without a window. The objects need nothing of it.
