# SPDX-License-Identifier: MIT
"""Hexahedra for models of Gmsh; exit code 77 where its module for Python is not installed."""
import os
import subprocess
import sys
import tempfile
import unittest

try:
    import gmsh
    import numpy
except ImportError as error:
    print("left out:", error)
    sys.exit(77)

import lacuna
import lacuna.gmsh


def groups():
    model = gmsh.model
    return {model.getPhysicalName(dim, tag): (dim, list(model.getEntitiesForPhysicalGroup(dim, tag)))
            for dim, tag in model.getPhysicalGroups()}


class Gmsh(unittest.TestCase):
    def setUp(self):
        gmsh.initialize()
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setNumber("Mesh.MeshSizeMax", 0.5)
        self.folder = tempfile.TemporaryDirectory()

    def tearDown(self):
        gmsh.finalize()
        self.folder.cleanup()

    def checked(self):
        """Quality of the groups' cells, by a file."""
        path = os.path.join(self.folder.name, "filled.msh")
        gmsh.write(path)
        return lacuna.check(path)

    def test_a_step_file_of_solids_that_touch_has_the_faces_between_them_twice(self):
        cad = gmsh.model.occ
        solids = [(3, cad.addCylinder(0, 0, 0, 0, 0, 30, radius)) for radius in (6, 9)]
        cad.fragment(solids + [(3, cad.addBox(-20, -15, 0, 40, 30, 30))], [])
        cad.synchronize()
        path = os.path.join(self.folder.name, "joint.step")
        gmsh.write(path)
        part = lacuna.load(path)
        self.assertEqual(len(part.faces()), 14)
        volumes = [part.open_volume(source=dict(near=(x, 0, 0)), target=dict(near=(x, 0, 30)), walls="auto", name=name)
                   for name, x in (("bolt", 0), ("bush", 7.5), ("block", 15))]
        mesh = lacuna.assembly(volumes).sweep(layers=4, size=3)
        self.assertAlmostEqual(mesh.quality().volume, 40 * 30 * 30, 6)

    def test_surfaces_of_triangles_are_a_shape(self):
        gmsh.model.occ.addBox(0, 0, 0, 4, 3, 2, 7)
        gmsh.model.occ.synchronize()
        for wrong in "bottom", [None], 1.5:
            with self.assertRaisesRegex(TypeError, "source takes tags of Gmsh's surfaces"):
                lacuna.gmsh.fill(source=wrong)
        with self.assertRaises(lacuna.Error) as caught:
            lacuna.gmsh.fill()
        self.assertEqual(caught.exception.code, "gmsh.no_mesh")
        gmsh.model.mesh.generate(2)
        before = gmsh.model.getCurrent(), gmsh.model.getEntities(2)
        volume = lacuna.gmsh.fill(source=numpy.int64(5), walls=(i for i in (1, 2, 3, 4)),
                                  layers=4, size=0.5, name="foam")
        self.assertEqual(gmsh.model.getCurrent(), before[0])
        self.assertLess(set(before[1]), set(gmsh.model.getEntities(2)))
        named = groups()
        self.assertEqual(named["foam"], (3, [volume]))
        self.assertEqual(set(named), {"foam", "source", "target", "wall:1", "wall:2", "wall:3", "wall:4"})
        quality = self.checked()
        self.assertEqual((quality.hexes, quality.inverted), (192, 0))
        self.assertAlmostEqual(quality.volume, 24)

    def test_quads_keep_their_nodes(self):
        gmsh.model.occ.addCylinder(0, 0, 0, 0, 0, 2, 1, 3)
        gmsh.model.occ.synchronize()
        gmsh.option.setNumber("Mesh.RecombineAll", 1)
        gmsh.option.setNumber("Mesh.RecombinationAlgorithm", 0)
        gmsh.option.setNumber("Mesh.SubdivisionAlgorithm", 1)  # quads alone
        gmsh.model.mesh.generate(2)
        ends = [tag for _, tag in gmsh.model.getEntities(2) if gmsh.model.getType(2, tag) == "Plane"]
        source = min(ends, key=lambda tag: gmsh.model.getBoundingBox(2, tag)[2])
        given = gmsh.model.mesh.getElementsByType(3, source)[1].reshape(-1, 4)
        walls = [tag for _, tag in gmsh.model.getEntities(2) if tag not in ends]
        with self.assertRaisesRegex(lacuna.Error, "rows"):
            lacuna.gmsh.fill(source=source, walls=walls)
        volume = lacuna.gmsh.fill(source=source, walls=walls, keep_mesh=numpy.array([source]))
        _, (surface,) = groups()["source"]
        made = gmsh.model.mesh.getElementsByType(3, surface)[1].reshape(-1, 4)
        self.assertEqual({frozenset(quad) for quad in given.tolist()},
                         {frozenset(quad) for quad in made.tolist()})
        tags = gmsh.model.mesh.getNodes()[0]
        self.assertEqual(len(numpy.unique(tags)), len(tags))
        self.assertTrue(numpy.isin(gmsh.model.mesh.getElementsByType(5, volume)[1], tags).all())
        self.assertEqual(self.checked().inverted, 0)

    def test_the_command_fills_a_file(self):
        path = os.path.join(self.folder.name, "box.geo")
        with open(path, "w") as file:
            file.write('SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 4, 3, 2};')

        def run(*words):
            return subprocess.run([sys.executable, "-m", "lacuna.gmsh", path, *words], capture_output=True,
                                  text=True)

        done = run("source=5", "target=6", "walls=1,2,3,4", "layers=3", "size=1", "keep_mesh=False")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(lacuna.check(done.stdout.strip()).hexes, 36)
        done = run("source=5", "layers=0")
        self.assertEqual(done.returncode, 1)
        self.assertTrue(done.stderr.startswith("lacuna: "), done.stderr)
        usage = subprocess.run([sys.executable, "-m", "lacuna.gmsh"], capture_output=True)
        self.assertEqual(usage.returncode, 2)


if __name__ == "__main__":
    unittest.main()
