# SPDX-License-Identifier: MIT
"""How filled voids look in FreeCAD's window: in the tree, in the 3-D view, and while they are recomputed."""
import os

import FreeCADGui as Gui
from pivy import coin
from PySide import QtCore, QtGui

from . import filled_void

ICONS = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "icons")


def icon(name):
    return os.path.join(ICONS, name + ".svg")


def selected_faces(document=None):
    """Parts that are selected, with the names of their selected faces. FreeCAD names the last feature of a body
    when a face of the body is picked; the part is the body, which keeps its place when features are added."""
    found = []
    for selected in Gui.Selection.getSelectionEx(document or "*"):
        body = selected.Object.getParentGeoFeatureGroup()
        part = body if body and getattr(body, "Tip", None) == selected.Object else selected.Object
        if hasattr(part, "Shape") and part.Shape.Faces:
            found.append((part, [name for name in selected.SubElementNames if name.startswith("Face")]))
    return found


class FilledVoidView:
    def __init__(self, view):
        view.Proxy = self

    def attach(self, view):
        self.void = view.Object

    def getIcon(self):
        return icon("filled_void")

    def claimChildren(self):
        solid = filled_void.solid_of(self.void)
        return [solid] if solid else []

    def doubleClicked(self, view):
        from . import panel
        panel.edit(view.Object, f"Change {view.Object.Label}")
        return True

    def onDelete(self, view, _):
        solid = filled_void.solid_of(view.Object)
        if solid:
            view.Object.Document.removeObject(solid.Name)
        return True

    def dumps(self):
        return None

    def loads(self, _):
        pass

    __getstate__, __setstate__ = dumps, loads


class SealedSolidView:
    def __init__(self, view):
        view.Proxy = self
        view.Visibility = False  # it would hide the mesh

    def getIcon(self):
        return icon("sealed_solid")

    def dumps(self):
        return None

    def loads(self, _):
        pass

    __getstate__, __setstate__ = dumps, loads


def wait_with_bar(job, label):
    """Wait for a job of a recompute. Nothing else of the window can be used meanwhile but the stop button."""
    bar = QtGui.QProgressDialog(f"Filling {label}", "Stop", 0, 100, Gui.getMainWindow())
    bar.setAutoReset(False)
    bar.setWindowTitle("Lacuna")
    bar.setWindowModality(QtCore.Qt.ApplicationModal)
    bar.canceled.connect(job.stop)
    bar.show()
    while not job.wait(0.05):
        bar.setLabelText(f"Filling {label}: {job.stage}")
        bar.setValue(round(100 * job.share))
        QtGui.QApplication.processEvents()
    bar.canceled.disconnect(job.stop)
    bar.deleteLater()  # it is a child of the window


class RedEdges:
    """Edges drawn in red over a view until they are removed."""

    def __init__(self, view):
        self._root = view.getSceneGraph()
        self._node = coin.SoSeparator()
        self._root.addChild(self._node)

    def show(self, edges):
        self._node.removeAllChildren()
        colour = coin.SoBaseColor()
        colour.rgb = (1, 0, 0)
        style = coin.SoDrawStyle()
        style.lineWidth = 5
        self._node.addChild(colour)
        self._node.addChild(style)
        for edge in edges:
            points = [tuple(point) for point in edge.discretize(Number=2 if is_straight(edge) else 40)]
            place = coin.SoCoordinate3()
            place.point.setValues(0, len(points), points)
            line = coin.SoLineSet()
            line.numVertices.setValue(len(points))
            self._node.addChild(place)
            self._node.addChild(line)

    def remove(self):
        self._root.removeChild(self._node)


def is_straight(edge):
    return edge.Curve.TypeId == "Part::GeomLine"
