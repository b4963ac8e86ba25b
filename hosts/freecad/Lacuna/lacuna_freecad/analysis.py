# SPDX-License-Identifier: MIT
"""A CalculiX analysis of FreeCAD's FEM workbench on a filled void: its groups say where it is held and pressed.

FreeCAD finds the nodes of a constraint by the place of the faces that it refers to. These are faces of the
sealed solid, so a constraint on a group is one on the faces of the solid whose nodes are the group's.
"""
import FreeCAD
import ObjectsFem

from . import convert, filled_void


class NoFaces(Exception):
    """FreeCAD does not find the nodes of a group by faces of the sealed solid."""


class HasPyramids(Exception):
    """FreeCAD leaves pyramids out of CalculiX's input."""


class InUse(Exception):
    """A mesh can be in one analysis only."""


def faces_of_groups(void, names):
    """Names of the sealed solid's faces on which the nodes of these groups lie, and no other nodes."""
    groups = convert.groups_of_faces(void.FemMesh)
    wanted = set().union(*(groups[name] for name in names))
    faces, covered = [], set()
    for number, face in enumerate(void.SealedShape.Faces, 1):
        nodes = set(void.FemMesh.getNodesByFace(face))
        if nodes and nodes <= wanted:
            faces.append(f"Face{number}")
            covered |= nodes
    if covered != wanted:
        raise NoFaces(f"{len(wanted - covered)} nodes of the group {', '.join(names)} lie on no face of the "
                      "sealed solid as FreeCAD measures it; name faces of the solid in the constraint instead.")
    return faces


def make(void, held, pressed, pressure, youngs_modulus, poissons_ratio):
    """An analysis of the void: groups held, groups under a pressure [MPa], a material [MPa]."""
    for user in void.InList:
        if user.isDerivedFrom("Fem::FemAnalysis"):
            raise InUse(f"{void.Label} is in {user.Label} already: change that one in the FEM workbench, or "
                        "delete it.")
    if void.FemMesh.PyramidCount:
        raise HasPyramids(f"{void.Label} has {void.FemMesh.PyramidCount} pyramids, which FreeCAD leaves out of "
                          "CalculiX's input: set its property Pyramids to \"as bricks\".")
    if void.SealedShape.isNull():
        raise NoFaces(f"{void.Label} has no sealed solid, whose faces constraints refer to; its Report says why.")
    document = void.Document
    solid = filled_void.solid_of(void)
    analysis = ObjectsFem.makeAnalysis(document, "Analysis")
    solver = ObjectsFem.makeSolverCalculixCcxTools(document)
    material = ObjectsFem.makeMaterialSolid(document)
    material.Material = {"Name": "Solid", "YoungsModulus": f"{youngs_modulus} MPa",
                         "PoissonRatio": str(poissons_ratio)}
    fixed = ObjectsFem.makeConstraintFixed(document)
    fixed.References = [(solid, face) for face in faces_of_groups(void, held)]
    load = ObjectsFem.makeConstraintPressure(document)
    load.References = [(solid, face) for face in faces_of_groups(void, pressed)]
    load.Pressure = pressure
    analysis.Group = [solver, material, fixed, load, void]
    if FreeCAD.GuiUp:
        import FemGui
        FemGui.setActiveAnalysis(analysis)
    return analysis


def solve(analysis):
    """Run CalculiX as FreeCAD does, which reports what is wrong. @return the results, or None"""
    from femtools import ccxtools
    tools = ccxtools.FemToolsCcx(analysis)
    tools.purge_results()
    if not tools.run():
        return None
    return next((member for member in analysis.Group if member.isDerivedFrom("Fem::FemResultObject")), None)


def show_results(document):
    """Open FreeCAD's panel of the results, with colours to choose."""
    import FreeCADGui as Gui
    results = [obj for obj in document.Objects if obj.isDerivedFrom("Fem::FemResultObject")]
    if results:
        Gui.getDocument(document.Name).setEdit(results[-1].Name)
