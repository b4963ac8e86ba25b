# SPDX-License-Identifier: MIT
# FreeCAD runs this text at its start where it has a window; names outside the class are gone afterwards.
import FreeCADGui as Gui


class LacunaWorkbench(Gui.Workbench):
    """Fill voids with hexahedra."""

    MenuText = "Lacuna"
    ToolTip = "Fill pockets, bores and open shells with hexahedra, as parametric FEM meshes"

    def __init__(self):
        from lacuna_freecad import views
        self.__class__.Icon = views.icon("lacuna")

    def Initialize(self):
        from lacuna_freecad import commands
        names = commands.add_commands()
        self.appendToolbar("Lacuna", names)
        self.appendMenu("Lacuna", names)

    def GetClassName(self):
        return "Gui::PythonWorkbench"


Gui.addWorkbench(LacunaWorkbench())
