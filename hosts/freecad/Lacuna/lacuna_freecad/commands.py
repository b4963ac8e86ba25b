# SPDX-License-Identifier: MIT
"""The commands of the workbench."""
import FreeCAD
import FreeCADGui as Gui
from PySide import QtGui

from . import filled_void, views


def parts(document):
    """Objects with faces that a void may be in: those that no other object is made from, but filled voids."""
    found = [obj for obj in document.Objects
             if hasattr(obj, "Shape") and not obj.Shape.isNull() and obj.Shape.Faces
             and not isinstance(getattr(obj, "Proxy", None), filled_void.SealedSolid)]
    last = [obj for obj in found if not any(user in found for user in obj.InList)]
    return [obj for obj in last if obj.ViewObject.Visibility] or last


def chosen_part():
    """The selected part and the names of its selected faces, or the only part there is."""
    selected = views.selected_faces(FreeCAD.ActiveDocument.Name)
    if selected:
        return selected[0]
    found = parts(FreeCAD.ActiveDocument)
    return (found[0], []) if len(found) == 1 else (None, [])


def chosen_void():
    selected = [obj for obj in Gui.Selection.getSelection() if filled_void.is_filled_void(obj)]
    found = selected or [obj for obj in FreeCAD.ActiveDocument.Objects if filled_void.is_filled_void(obj)]
    return found[0] if len(found) == 1 else None


def say(text):
    QtGui.QMessageBox.information(Gui.getMainWindow(), "Lacuna", text)


class FillVoid:
    def GetResources(self):
        return {"Pixmap": views.icon("filled_void"), "MenuText": "Fill a void",
                "ToolTip": "Fill a pocket, a bore or the space in an open shell with hexahedra. Select the part, "
                           "or the faces that bound the void, or nothing where there is one part"}

    def IsActive(self):
        return FreeCAD.ActiveDocument is not None and not Gui.Control.activeDialog()

    def Activated(self):
        from . import panel
        part, faces = chosen_part()
        if part is None:
            say("Select the part that bounds the void, or faces of it.")
            return
        document = FreeCAD.ActiveDocument
        document.openTransaction("Fill a void")
        Gui.doCommand("from lacuna_freecad import filled_void")
        Gui.doCommand(f"void = filled_void.make(FreeCAD.getDocument({part.Document.Name!r})"
                      f".getObject({part.Name!r}), {faces!r})")
        panel.edit(document.ActiveObject.FilledVoid, "Fill a void")


class Analyse:
    def GetResources(self):
        return {"Pixmap": views.icon("analyse"), "MenuText": "Analyse the filled void",
                "ToolTip": "Hold and press groups of the mesh, and solve with CalculiX. All is made of objects of "
                           "the FEM workbench, to be changed there"}

    def IsActive(self):
        return FreeCAD.ActiveDocument is not None and not Gui.Control.activeDialog()

    def Activated(self):
        from . import analysis_panel
        void = chosen_void()
        if void is None:
            say("Select a filled void.")
        elif not void.FemMesh.VolumeCount:
            say(f"{void.Label} has no mesh: double-click it in the tree.")
        else:
            analysis_panel.show(void)


COMMANDS = {"Lacuna_FillVoid": FillVoid, "Lacuna_Analyse": Analyse}


def add_commands():
    for name, command in COMMANDS.items():
        Gui.addCommand(name, command())
    return list(COMMANDS)
