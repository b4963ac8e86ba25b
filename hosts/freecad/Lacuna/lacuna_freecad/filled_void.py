# SPDX-License-Identifier: MIT
"""The object *Filled void* of the tree: a FEM mesh that is made anew when the part or an option changes.

Its properties are Lacuna's options, which docs/reference.md of Lacuna describes; beside it stands the sealed
solid that it fills.
"""
import os

import Fem
import FreeCAD
import Part

from . import convert, job

kTaken = 4  # results that a filled void keeps for undo and redo: a choice, as meshes are large

# Name, type, group, value, meaning. The value is FreeCAD's word for "as Lacuna does by default".
OPTIONS = [
    ("Part", "App::PropertyLink", "Void", None, "The part that bounds the void"),
    ("Faces", "App::PropertyLinkSub", "Void", None,
     "The faces that bound the void, whose roles are found. Without these and those below: all faces"),
    ("Source", "App::PropertyLinkSub", "Void", None, "The faces where the sweep starts"),
    ("Target", "App::PropertyLinkSub", "Void", None, "The faces where the sweep ends"),
    ("Walls", "App::PropertyLinkSub", "Void", None,
     "The faces along the sweep; empty: those that are connected to the named end"),
    ("Reading", "App::PropertyInteger", "Void", 0,
     "Which void, where the faces bound several or its shape is a guess, as the error numbers them; 0: none"),
    ("EdgeShape", "App::PropertyEnumeration", "Void", ["auto", "straight", "follow", "smooth"],
     "How edges of missing faces run"),
    ("Cap", "App::PropertyEnumeration", "Void", ["auto", "flat", "parallel"], "The shape of a missing end"),
    ("Holes", "App::PropertyEnumeration", "Void", ["ask", "cover", "through"],
     "What becomes of holes of an end that have no walls"),
    ("Size", "App::PropertyLength", "Mesh", 0.0, "Edge length of the cells on the source; 0: by the part"),
    ("Layers", "App::PropertyInteger", "Mesh", 0, "Cells from source to target; 0: about as high as wide"),
    ("Order", "App::PropertyEnumeration", "Mesh", ["1", "2"], "Of the cells: 8 or 20 nodes a hexahedron"),
    ("Quads", "App::PropertyEnumeration", "Mesh", ["auto", "paved", "mapped"], "How the source is meshed"),
    ("Fallback", "App::PropertyEnumeration", "Mesh", ["none", "wedges", "leave_out", "mixed"],
     "What becomes of a void that hexahedra alone do not fill; mixed: tetrahedra and pyramids too"),
    ("Pyramids", "App::PropertyEnumeration", "Mesh", ["as bricks", "as pyramids"],
     "Bricks whose upper four nodes are one, which CalculiX solves; or pyramids, for other solvers: FreeCAD leaves "
     "them out of CalculiX's input"),
    ("MinScaledJacobian", "App::PropertyFloat", "Mesh", 0.0, "A mesh with a worse cell is refused, 0 to 1"),
    ("Solid", "App::PropertyBool", "Mesh", True, "Make the sealed solid too"),
]
RESULTS = [
    ("Class", "App::PropertyString", "The class of the void: which of its faces are missing"),
    ("Report", "App::PropertyStringList", "What was done, or why nothing was"),
    ("Cells", "App::PropertyString", "How many of each kind"),
    ("Volume", "App::PropertyFloat", "Of the mesh"),
    ("SealedVolume", "App::PropertyFloat", "Of the void with its missing faces"),
    ("WorstCell", "App::PropertyFloat", "Least scaled Jacobian of the cells; 1 is a cube"),
    ("SealedShape", "Part::PropertyPartShape", "The solid that the mesh fills"),
]


def make(part, faces=(), document=None):
    """A filled void of a part, not computed yet; `faces` are names such as "Face3" of those that bound it."""
    document = document or part.Document
    void = document.addObject("Fem::FemMeshObjectPython", "FilledVoid")
    void.Label = "Filled void"
    FilledVoid(void)
    void.Part = part
    if faces:
        void.Faces = (part, list(faces))
    solid = document.addObject("Part::FeaturePython", "SealedSolid")
    solid.Label = "Sealed solid"
    SealedSolid(solid)
    solid.FilledVoid = void
    if FreeCAD.GuiUp:
        from . import views
        views.FilledVoidView(void.ViewObject)
        views.SealedSolidView(solid.ViewObject)
    return void


def solid_of(void):
    return next((other for other in void.InList if isinstance(getattr(other, "Proxy", None), SealedSolid)), None)


def is_filled_void(obj):
    return isinstance(getattr(obj, "Proxy", None), FilledVoid)


def roles_of(void):
    """Options of Lacuna's open_volume, with FreeCAD's numbers of faces."""
    roles = {role.lower(): convert.face_numbers(getattr(void, role)) for role in convert.ROLES}
    roles = {role: numbers for role, numbers in roles.items() if numbers}
    if ("source" in roles or "target" in roles) and "walls" not in roles:
        roles["walls"] = "auto"
    if void.Reading:
        roles["reading"] = void.Reading
    return roles


def request_of(void):
    close = {"edge_shape": void.EdgeShape, "cap": void.Cap, "holes": void.Holes}
    sweep = {"size": void.Size.Value, "layers": void.Layers, "quads": void.Quads, "fallback": void.Fallback,
             "min_scaled_jacobian": void.MinScaledJacobian}
    if void.Order == "2":
        sweep.update(order=2, serendipity=True)  # FreeCAD has no hexahedra of 27 nodes

    def given(options):
        return {key: value for key, value in options.items() if value not in (0, "auto", "ask", "none")}
    return convert.request_for("fill", void.Part.Shape, roles_of(void), given(close), given(sweep), void.Solid)


class FilledVoid:
    _delivered = None  # a finished job; not saved, as are the results that were taken last

    def __init__(self, obj):
        for name, kind, group, value, meaning in OPTIONS:
            obj.addProperty(kind, name, group, meaning)
            if value is not None:
                setattr(obj, name, value)
        for name, kind, meaning in RESULTS:
            obj.addProperty(kind, name, "Result", meaning, 1 | 4)  # read only, and without effect on touched
        obj.Proxy = self
        self._taken = {}

    def deliver(self, finished):
        """A job that was run for this object as it is now: the next recompute takes its result."""
        self._delivered = finished

    def execute(self, obj):
        finished, self._delivered = self._delivered, None
        if not obj.Part:
            raise ValueError("The filled void has no part: set its property Part.")
        key = convert.fingerprint(obj.Part.Shape, request_of(obj))
        try:
            if finished is not None and finished.key != key:  # the void has changed meanwhile
                finished.stop()
                finished = None
            if finished is None and key not in self._taken:
                finished = run(obj)
            if finished is not None:
                self._taken[key] = read(finished)
            self._taken[key] = self._taken.pop(key)  # it is the last
            while len(self._taken) > kTaken:
                del self._taken[next(iter(self._taken))]
            take(obj, *self._taken[key])
        except job.Failed as error:
            clear(obj, error)
            raise ValueError(str(error)) from None
        finally:
            if finished:
                finished.stop()

    def dumps(self):
        return None

    def loads(self, _):
        self._taken = {}

    __getstate__, __setstate__ = dumps, loads


class SealedSolid:
    """The solid that a filled void fills: the given faces as they are, and those that were missing."""

    def __init__(self, obj):
        obj.addProperty("App::PropertyLink", "FilledVoid", "Void", "The filled void whose solid this is")
        obj.Proxy = self

    def execute(self, obj):
        obj.Shape = obj.FilledVoid.SealedShape if obj.FilledVoid else Part.Shape()

    def dumps(self):
        return None

    def loads(self, _):
        pass

    __getstate__, __setstate__ = dumps, loads


def start(void):
    """The job that fills the void as its properties say."""
    request = request_of(void)
    started = job.Job(void.Part.Shape, request, void.Document.Name)
    started.key = convert.fingerprint(void.Part.Shape, request)
    return started


def run(void):
    """Start the job and wait for it: with a bar and a stop button where there is a window."""
    started = start(void)
    if FreeCAD.GuiUp:
        from . import views
        views.wait_with_bar(started, void.Label)
    else:
        started.wait()
    return started


def refresh(document):
    """Recompute voids that undo has changed: FreeCAD gives back their properties, but not their meshes. Those that
    were taken last are there still."""
    if any(is_filled_void(obj) and "Touched" in obj.State for obj in document.Objects):
        document.recompute()


class RefreshAfterUndo:
    def slotUndoDocument(self, document):
        refresh(document)

    def slotRedoDocument(self, document):
        refresh(document)


def read(finished):
    """The result of a finished job, its mesh and its solid, which may be none."""
    result = finished.result()
    mesh = convert.read_mesh(finished.path("mesh.unv"), result["groups"])
    solid = Part.Shape()
    if os.path.exists(finished.path("sealed.brep")):
        solid = convert.read_shape(finished.path("sealed.brep"))
        convert.widen_fitted_faces(solid, mesh)
    return result, mesh, solid


def take(void, result, mesh, solid):
    notes = list(result["notes"])
    if result["pyramids"] and void.Pyramids == "as pyramids":
        mesh = convert.with_pyramids(mesh)
        notes += [f"note: FreeCAD leaves pyramids out of CalculiX's input, and {user.Label} has this mesh"
                  for user in void.InList if user.isDerivedFrom("Fem::FemAnalysis")]
    void.FemMesh = mesh
    void.SealedShape = solid
    kinds = ("hexes", "hexahedra"), ("wedges", "wedges"), ("pyramids", "pyramids"), ("tets", "tetrahedra")
    void.Cells = ", ".join(f"{result[kind]} {words}" for kind, words in kinds if result[kind])
    void.Class = result["class"]
    void.Report = notes + result["report"]
    void.Volume, void.SealedVolume = result["volume"], result["sealed_volume"]
    void.WorstCell = result["min_scaled_jacobian"]


def clear(void, error):
    """A mesh of another part or other options would be taken for that of this one."""
    void.FemMesh = Fem.FemMesh()
    void.SealedShape = Part.Shape()
    void.Class = void.Cells = ""
    void.Report = [f"error: {error} [{error.code}]"] + error.attempts
    void.Volume = void.SealedVolume = void.WorstCell = 0.0


FreeCAD.addDocumentObserver(RefreshAfterUndo())
