# SPDX-License-Identifier: MIT
"""Runs in freecadcmd, started by test_freecad.py: filled voids without a window."""
import os
import sys
import tempfile
import time
import unittest
import unittest.mock

import FreeCAD
import ObjectsFem
import Part
from FreeCAD import Vector

from lacuna_freecad import analysis, convert, filled_void, job


def housing(document, depth=15.0):
    """A block with a pocket; the depth of the pocket can be changed."""
    block = document.addObject("Part::Box", "Block")
    block.Length, block.Width, block.Height = 40, 30, 20
    pocket = document.addObject("Part::Box", "Pocket")
    pocket.Length, pocket.Width, pocket.Height = 30, 20, 20
    cut = document.addObject("Part::Cut", "Housing")
    cut.Base, cut.Tool = block, pocket
    set_depth(document, depth)
    return cut


def set_depth(document, depth):
    document.Pocket.Placement.Base = Vector(5, 5, 20 - depth)
    document.recompute()


def pocket_faces(part):
    """Names of the faces inside the block's outer box."""
    outer = part.Shape.BoundBox
    return [f"Face{number}" for number, face in enumerate(part.Shape.Faces, 1)
            if outer.XMin < face.CenterOfMass.x < outer.XMax and outer.YMin < face.CenterOfMass.y < outer.YMax
            and outer.ZMin < face.CenterOfMass.z < outer.ZMax]


def groups(mesh, kind="Face"):
    return {mesh.getGroupName(group): len(mesh.getGroupElements(group)) for group in mesh.Groups
            if mesh.getGroupElementType(group) == kind}


def volume_of(mesh):
    """The volume inside the quads of the skin, which hold every group's once."""
    total = 0.0
    for group in mesh.Groups:
        name = mesh.getGroupName(group)
        if mesh.getGroupElementType(group) != "Face" or name.startswith("void:"):
            continue  # the void faces are the target once more
        for element in mesh.getGroupElements(group):
            corners = [mesh.getNodeById(node) for node in mesh.getElementNodes(element)]
            middle = sum(corners, Vector()) / len(corners)
            for a, b in zip(corners, corners[1:] + corners[:1]):
                total += (a - middle).cross(b - middle).dot(middle) / 6
    return abs(total)


def alive(process):
    try:
        with open(f"/proc/{process}/stat") as file:
            return file.read().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


def children(process):
    found = []
    for thread in os.listdir(f"/proc/{process}/task"):
        with open(f"/proc/{process}/task/{thread}/children") as file:
            found += file.read().split()
    return {int(child) for child in found}


def soon(condition):
    end = time.monotonic() + 20
    while not condition() and time.monotonic() < end:
        time.sleep(0.02)
    return condition()


class Test(unittest.TestCase):
    def setUp(self):
        self.document = FreeCAD.newDocument("Test")

        self.begin = time.monotonic()

    def tearDown(self):
        if "Test" in FreeCAD.listDocuments():
            FreeCAD.closeDocument("Test")
        self.assertEqual(job.running, [])
        print(f"{self.id()}: {time.monotonic() - self.begin:.1f} s", file=sys.stderr)

    def filled(self, part, faces, **options):
        void = filled_void.make(part, faces)
        for name, value in options.items():
            setattr(void, name, value)
        self.document.recompute()
        return void

    def test_a_void_follows_the_depth_of_its_pocket(self):
        part = housing(self.document)
        faces = pocket_faces(part)
        void = self.filled(part, faces, Size=5)
        for depth in 15, 10:
            with self.subTest(depth=depth):
                if depth != 15:
                    set_depth(self.document, depth)
                self.assertTrue(void.isValid(), void.Report)
                mesh = void.FemMesh
                self.assertGreater(mesh.HexaCount, 0)
                self.assertEqual(mesh.VolumeCount, mesh.HexaCount)
                self.assertEqual(groups(mesh, "Volume"), {"volume": mesh.HexaCount})
                self.assertEqual(groups(mesh)["source"], groups(mesh)["target"])
                self.assertEqual(sum(name.startswith("wall:") for name in groups(mesh)), 4)
                for volume in void.Volume, void.SealedVolume, void.SealedShape.Volume, volume_of(mesh), \
                        filled_void.solid_of(void).Shape.Volume:
                    self.assertAlmostEqual(volume / (30 * 20 * depth), 1, 6)
        self.assertEqual(self.document.recompute(), 0)

        # An error names faces and leaves no mesh, which would be taken for that of these options.
        void.Source, void.Target, void.Faces = (part, faces[:1]), (part, faces[:1]), None
        self.document.recompute()
        self.assertFalse(void.isValid())
        self.assertEqual(void.FemMesh.NodeCount, 0)
        self.assertRegex(void.Report[0], rf"^error: .*\b{faces[0]}\b")

    def test_an_open_shell_and_cells_of_order_2(self):
        box = Part.makeBox(4, 4, 4)
        shell = self.document.addObject("Part::Feature", "Shell")
        shell.Shape = Part.Shell(box.Faces[:5])
        self.document.recompute()
        void = self.filled(shell, [], Size=2, Layers=2, Order="2")
        self.assertTrue(void.isValid(), void.Report)
        self.assertEqual(len(void.FemMesh.getElementNodes(void.FemMesh.Volumes[0])), 20)
        self.assertAlmostEqual(void.Volume, 64, 6)
        self.assertTrue(void.SealedShape.isClosed())
        self.assertEqual(len(convert.free_edges(shell.Shape, [])), 4)

    def test_nodes_of_a_missing_bent_face_are_found(self):
        arch = Part.makeBox(20, 10, 10).cut(Part.makeCylinder(40, 12, Vector(10, -1, -38), Vector(0, 1, 0)))
        part = self.document.addObject("Part::Feature", "Arch")
        part.Shape = Part.Shell([face for face in arch.Faces if not isinstance(face.Surface, Part.Cylinder)])
        void = self.filled(part, [], Size=3)
        self.assertEqual(len(analysis.faces_of_groups(void, ["void:1"])), 1)
        self.assertTrue(void.SealedShape.isValid())

    def test_undo_gives_back_the_mesh_too(self):
        part = housing(self.document)
        self.document.UndoMode = 1
        self.document.openTransaction("fill")
        void = self.filled(part, pocket_faces(part), Size=10, Layers=1)
        self.document.commitTransaction()
        cells = void.FemMesh.HexaCount
        self.document.openTransaction("change")
        void.Layers = 2
        self.document.recompute()
        self.document.commitTransaction()
        report, solid = void.Report, filled_void.solid_of(void)
        with unittest.mock.patch.object(job, "Job", side_effect=AssertionError("a job was started")):
            for layers, step in (1, self.document.undo), (2, self.document.redo), (1, self.document.undo):
                step()
                self.assertEqual((void.Layers, void.FemMesh.HexaCount), (layers, layers * cells))
                self.assertTrue(void.isValid())
                self.assertAlmostEqual(solid.Shape.Volume, 30 * 20 * 15, 3)
            self.document.redo()
        self.assertEqual(void.Report, report)
        self.document.openTransaction("deepen")
        set_depth(self.document, 10)
        self.document.commitTransaction()
        self.assertAlmostEqual(void.Volume, 30 * 20 * 10, 3)
        self.document.undo()
        self.assertAlmostEqual(void.Volume, 30 * 20 * 15, 3)
        self.assertEqual(len(void.Proxy._taken), 3)
        void.Layers = 3
        started = filled_void.start(void)
        started.wait()
        void.Proxy.deliver(started)
        void.Layers = 4  # so that the job is of another void, and goes
        with unittest.mock.patch.object(filled_void, "kTaken", 2):
            self.document.recompute()
        self.assertEqual((len(void.Proxy._taken), void.FemMesh.HexaCount), (2, 4 * cells))
        self.assertFalse(os.path.exists(started.folder))

    def test_named_roles_and_a_bore(self):
        part = self.document.addObject("Part::Feature", "Plate")
        part.Shape = Part.makeBox(20, 20, 5).cut(Part.makeCylinder(4, 5, Vector(10, 10, 0)))
        bore, = (f"Face{number}" for number, face in enumerate(part.Shape.Faces, 1)
                 if isinstance(face.Surface, Part.Cylinder))
        void = filled_void.make(part)
        void.Walls = (part, [bore])
        self.document.recompute()
        self.assertTrue(void.isValid(), void.Report)
        self.assertAlmostEqual(void.SealedVolume / (16 * 3.14159265 * 5), 1, 1)
        self.assertAlmostEqual(void.SealedShape.Volume, 16 * 3.14159265 * 5, 3)

    def test_cells_of_all_kinds_are_in_the_input_of_calculix(self):
        """A cube with a pyramid, a wedge and a tetrahedron on it, as Lacuna writes UNV: see the reference."""
        points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1),
                  (.5, .5, 2), (2, 0, 0), (2, 0, 1), (2, 1, 2)]
        cells = [(115, [1, 2, 3, 4, 5, 6, 7, 8]), (115, [5, 6, 7, 8, 9, 9, 9, 9]),
                 (112, [2, 10, 3, 6, 11, 7]), (111, [6, 11, 7, 12])]
        lines = ["    -1", "  2411"]
        for number, point in enumerate(points, 1):
            lines += [f"{number:10}{1:10}{1:10}{11:10}", "".join(f"{x:25.16e}" for x in point)]
        lines += ["    -1", "    -1", "  2412"]
        for number, (kind, nodes) in enumerate(cells, 1):
            lines += [f"{number:10}{kind:10}{1:10}{1:10}{7:10}{len(nodes):10}", "".join(f"{n:10}" for n in nodes)]
        with tempfile.TemporaryDirectory() as folder:
            mesh_path, path = os.path.join(folder, "mesh.unv"), os.path.join(folder, "mesh.inp")
            with open(mesh_path, "w") as file:
                file.write("\n".join([*lines, "    -1", ""]))
            mesh = convert.read_mesh(mesh_path)
            self.assertEqual((mesh.HexaCount, mesh.PrismCount, mesh.TetraCount), (2, 1, 1))
            mesh.writeABAQUS(path, 1, False)
            with open(path) as file:
                text = file.read()
        kinds = [line.split("TYPE=")[1].split(",")[0] for line in text.splitlines() if line.startswith("*Element")]
        self.assertEqual(sorted(kinds), ["C3D4", "C3D6", "C3D8"])
        self.assertIn("9, 9, 9, 9", text)

        # As pyramids they are for other solvers: FreeCAD leaves them out of that input.
        mesh.addGroupElements(mesh.addGroup("all", "Volume"), list(mesh.Volumes))
        void = filled_void.make(housing(self.document))
        result = {"hexes": 1, "wedges": 1, "pyramids": 1, "tets": 1, "volume": 2.0, "sealed_volume": 2.0, "class": "V",
                  "min_scaled_jacobian": 0.1, "notes": [], "report": ["done"]}
        for choice, counts in ("as bricks", (2, 0)), ("as pyramids", (1, 1)):
            void.Pyramids = choice
            filled_void.take(void, result, mesh, Part.Shape())
            self.assertEqual((void.FemMesh.HexaCount, void.FemMesh.PyramidCount), counts)
            self.assertEqual((void.FemMesh.PrismCount, void.FemMesh.TetraCount), (1, 1))
            self.assertEqual(void.Cells, "1 hexahedra, 1 wedges, 1 pyramids, 1 tetrahedra")
            self.assertEqual(groups(void.FemMesh, "Volume"), {"all": 4})
            self.assertEqual(void.Report, ["done"])
        with self.assertRaisesRegex(analysis.HasPyramids, "set its property Pyramids"):
            analysis.make(void, ["source"], ["target"], 1.0, 2800.0, 0.38)
        ObjectsFem.makeAnalysis(self.document, "Analysis").Group = [void]
        filled_void.take(void, result, mesh, Part.Shape())
        self.assertIn("leaves pyramids out", void.Report[0])

    def test_a_job_leaves_nothing_behind(self):
        part = housing(self.document)
        for ended_by in "stop", "document", "crash of FreeCAD":
            with self.subTest(ended_by=ended_by):
                void = filled_void.make(part, pocket_faces(part))
                void.Size, void.Layers = 0.1, 500  # minutes of work
                started = filled_void.start(void)
                self.assertTrue(soon(lambda: children(started.process)))  # that which reads CAD
                processes = [started.process, *children(started.process)]
                self.assertFalse(started.done())
                if ended_by == "stop":
                    started.stop()
                elif ended_by == "document":
                    FreeCAD.closeDocument("Test")
                    self.document = FreeCAD.newDocument("Test")
                    part = housing(self.document)
                else:
                    started._process.stdin.close()
                    self.assertTrue(started.wait(20))
                self.assertTrue(soon(lambda: not any(alive(process) for process in processes)))
                self.assertFalse(os.path.exists(started.folder))
                with self.assertRaises(job.Failed) as caught:
                    started.result()
                self.assertEqual(caught.exception.code, "core.cancelled")
        started.stop()

    def test_a_python_that_is_missing_is_named(self):
        shape = Part.makeBox(1, 1, 1)
        with unittest.mock.patch.dict(os.environ, LACUNA_PYTHON="/no/python"):
            with self.assertRaisesRegex(job.Failed, "/no/python"):
                job.Job(shape, convert.request_for("find", shape, {}))

    def test_a_saved_void_is_the_same_again(self):
        part = housing(self.document)
        void = self.filled(part, pocket_faces(part), Size=10)
        cells, name = void.FemMesh.HexaCount, void.Name
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "Test.FCStd")
            self.document.saveAs(path)
            FreeCAD.closeDocument("Test")
            self.document = FreeCAD.openDocument(path)
            void = self.document.getObject(name)
            self.assertEqual(self.document.recompute(), 0)  # it is up to date
            self.assertEqual(void.FemMesh.HexaCount, cells)
            set_depth(self.document, 10)
            self.assertAlmostEqual(void.Volume, 30 * 20 * 10, 3)
            self.assertAlmostEqual(filled_void.solid_of(void).Shape.Volume, 30 * 20 * 10, 3)

    def test_faces_are_told_by_place_and_not_by_number(self):
        shape = Part.makeBox(1, 2, 3)
        request = convert.request_for("fill", shape, {"source": [1], "walls": [3, 4, 5, 6]}, sweep={"size": 1})
        request["faces"].reverse()  # as if Lacuna numbered them the other way round
        started = job.Job(shape, request)
        started.wait()
        result = started.result()
        self.assertIn("source: Face1", result["report"])
        walls = {name for name in result["groups"].values() if name.startswith("wall:")}
        self.assertEqual(walls, {"wall:3", "wall:4", "wall:5", "wall:6"})
        mesh = convert.read_mesh(started.path("mesh.unv"), result["groups"])
        self.assertLessEqual(walls | {"source", "void:1"}, set(groups(mesh)))
        started.stop()

    def test_calculix_finds_the_nodes_of_the_groups(self):
        part = housing(self.document)
        void = self.filled(part, pocket_faces(part), Size=10)
        made = analysis.make(void, ["source"], ["target"], 1.0, 2800.0, 0.38)
        for name in convert.groups_of_faces(void.FemMesh):
            self.assertTrue(analysis.faces_of_groups(void, [name]), name)
        if not os.path.exists("/usr/bin/ccx"):
            self.skipTest("ccx is not installed")
        results = analysis.solve(made)
        # Of a block that is held below: pressure over modulus times height, a bit less as it is held sideways.
        most = max(results.DisplacementLengths)
        self.assertLess(0.3 * 15 / 2800, most)
        self.assertLess(most, 1.2 * 15 / 2800)


begin = time.monotonic()
result = unittest.TextTestRunner(stream=sys.stderr, verbosity=2).run(
    unittest.defaultTestLoader.loadTestsFromTestCase(Test))
print(f"{time.monotonic() - begin:.1f} s", file=sys.stderr)
sys.stderr.flush()
os._exit(0 if result.wasSuccessful() else 1)  # FreeCAD's own exit code says nothing of scripts
