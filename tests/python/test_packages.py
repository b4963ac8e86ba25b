# SPDX-License-Identifier: MIT
"""Meshes to and from meshio, PyVista and dolfinx. Tests are left out where a package is missing, and exit code
is 77 where numpy is. Without PyVista, VTK's own module stands for what PyVista does with arrays and files."""
import sys
import tempfile
import types
import unittest
import unittest.mock

try:
    import numpy
except ImportError:
    print("left out: numpy is not installed")
    sys.exit(77)

import lacuna


def has(module):
    try:
        __import__(module)
    except ImportError:
        return False
    return True


PYVISTA = has("pyvista")


def prism(**options):
    return lacuna.synthetic.prism(**{"sides": 4, **options}).open_volume(
        source="source", target="target", walls="auto", name="foam")


def with_wedges():
    """Three hexahedra and six wedges, of the volume 24."""
    model = lacuna.model()
    model.add_face([(0, 0, 0), (2, 0, 0), (4, 0, 0), (4, 2, 0), (2, 2, 0), (0, 2, 0)],
                   [(1, 6, 5, 2), (2, 5, 3), (3, 5, 4)], keep_mesh=True)
    model.add_face([(0, 0, 3), (4, 0, 3), (4, 2, 3), (0, 2, 3)], [(1, 2, 3, 4)])
    return model.open_volume(source=1, target=2).sweep(layers=3, wedges=True)


def of_two_volumes(**options):
    part = lacuna.synthetic.prism(sides=6)
    low, high = part.open_volume(source=1, target=2, walls="auto").cut(plane=[(0, 0, 1), (0, 0, 1)])
    return lacuna.assembly([low, high]).sweep(layers=2, size=0.5, **options)


@unittest.skipUnless(has("meshio"), "meshio is not installed")
class Meshio(unittest.TestCase):
    def test_a_mesh_goes_there_and_back(self):
        import meshio
        mesh = prism().sweep(layers=2, size=0.5)
        out = mesh.to_meshio()
        self.assertIsInstance(out, meshio.Mesh)
        self.assertTrue((out.points == mesh.coordinates()).all())
        self.assertTrue((out.cells_dict["hexahedron"] == mesh.cells() - 1).all())
        self.assertLess({"source", "target", "wall_1"}, set(out.cell_sets))
        part = lacuna.load(out)
        again = part.open_volume(source=dict(facing=(0, 0, -1)), target=dict(facing=(0, 0, 1)), walls="auto")
        self.assertTrue(part.faces()[0].has_mesh)
        self.assertEqual(again.sweep().hexes, mesh.hexes)
        self.assertIn("target", part.face(facing=(0, 0, 1)).name)
        bare = lacuna.load(meshio.Mesh(out.points, [("hexahedron", mesh.cells() - 1)]), keep_mesh=False)
        self.assertEqual(len(bare.faces()), 6)

    def test_sets_of_cells_are_groups(self):
        import meshio
        mesh = prism().sweep(layers=2, size=0.5)
        out = mesh.to_meshio()
        out.cell_sets["lid"] = out.cell_sets["target"]  # a second name of its quads
        part = lacuna.load(out)
        self.assertEqual(len(part.faces()), 6)
        for name in "lid", "target":
            self.assertEqual([face.centroid[2] for face in part.faces(name=name)], [2])
        layers = numpy.arange(mesh.hexes).reshape(2, -1)
        bare = meshio.Mesh(out.points, [("hexahedron", mesh.cells() - 1)],
                           cell_sets={"low": [layers[0]], "high": [layers[1]]})
        part = lacuna.load(bare)
        self.assertEqual(len(part.faces(region="low")), 6)  # one of them is beside the other
        rest = lacuna.load(bare, without="high")
        self.assertEqual({face.name for face in rest.faces()}, {"low"})
        some = meshio.Mesh(out.points, bare.cells, cell_sets={"low": [layers[0]]})
        self.assertEqual(len(lacuna.load(some).faces()), 11)  # cells in no set stay

    def test_a_set_of_solids_and_of_faces_is_two_groups(self):
        import meshio
        mesh = prism().sweep(layers=2, size=0.5)
        out = mesh.to_meshio()
        of_all = [numpy.arange(len(block)) if block.type == "hexahedron" or number == 0 else None
                  for number, block in enumerate(out.cells)]
        part = lacuna.load(meshio.Mesh(out.points, out.cells, cell_sets={"mine": of_all}))
        self.assertEqual(len(part.faces(name="mine:faces")), 1)
        self.assertEqual(len(part.faces(region="mine")), 6)

    def test_cells_of_order_2_and_numbers_of_groups(self):
        mesh = prism().sweep(layers=2, size=0.5, order=2)
        out = mesh.to_meshio()
        part = lacuna.load(out)
        self.assertIn("target", [face.name for face in part.faces(facing=(0, 0, 1))])
        out.cell_sets.clear()
        out.field_data.clear()
        part = lacuna.load(out)
        self.assertEqual(len(part.faces(name="physical_1")), 1)

    def test_messages_name_the_mesh_and_no_file(self):
        import meshio
        out = prism().sweep(layers=2, size=0.5).to_meshio()
        cells = [("hexahedron", out.cells_dict["hexahedron"] + len(out.points) - 1)]
        for wrong in meshio.Mesh(out.points, cells), \
                meshio.Mesh(out.points, cells, cell_sets={"a": [numpy.array([0])]}), meshio.Mesh(out.points, []):
            with self.assertRaises(lacuna.Error) as caught:
                lacuna.load(wrong)
            self.assertIn("the meshio mesh", caught.exception.message)
            self.assertNotIn("/", caught.exception.message)
        self.assertEqual(str(lacuna.load(out)), "Model of 6 faces from the meshio mesh")

    def test_sets_of_points_are_left_out_with_a_note(self):
        out = prism().sweep(layers=2, size=0.5).to_meshio()
        out.point_sets["held"] = numpy.array([0, 1])
        with self.assertLogs("lacuna", "WARNING") as caught:
            lacuna.load(out)
        self.assertIn("point sets", caught.output[0])


def grid_of_vtk(cells, kinds, points):
    """What pyvista.UnstructuredGrid(cells, kinds, points) is, as far as Lacuna uses it."""
    import vtk
    from vtk.util import numpy_support

    class CellData(dict):
        """As in PyVista: an array has a value a cell, and is written with the grid."""

        def __setitem__(self, name, values):
            if len(values) != grid.GetNumberOfCells():
                raise ValueError(f"{len(values)} values for {grid.GetNumberOfCells()} cells")
            array = numpy_support.numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
            array.SetName(name)
            grid.GetCellData().AddArray(array)
            super().__setitem__(name, values)

    class UnstructuredGrid(vtk.vtkUnstructuredGrid):
        def __init__(self):
            super().__init__()
            self.cell_data, self.cells_dict = CellData(), {}

        def cast_to_unstructured_grid(self):
            return self

        def save(self, path):
            writer = vtk.vtkXMLUnstructuredGridWriter()
            writer.SetFileName(path)
            writer.SetInputData(self)
            writer.Write()

    grid, places, lists = UnstructuredGrid(), vtk.vtkPoints(), vtk.vtkCellArray()
    places.SetData(numpy_support.numpy_to_vtk(points, deep=True))
    lists.ImportLegacyFormat(numpy_support.numpy_to_vtkIdTypeArray(cells.astype(numpy.int64), deep=True))
    grid.SetPoints(places)
    grid.SetCells(numpy_support.numpy_to_vtk(kinds, deep=True, array_type=vtk.VTK_UNSIGNED_CHAR), lists)
    return grid


def cylinder():
    """pyvista.Cylinder(resolution=24).triangulate(), of radius 0.5 and height 1, whose caps have points of their
    own."""
    if PYVISTA:
        import pyvista
        return pyvista.Cylinder(resolution=24).triangulate()
    import vtk
    source, triangles, grid = vtk.vtkCylinderSource(), vtk.vtkTriangleFilter(), vtk.vtkAppendFilter()
    source.SetResolution(24)
    triangles.SetInputConnection(source.GetOutputPort())
    grid.SetInputConnection(triangles.GetOutputPort())  # as PolyData.cast_to_unstructured_grid does
    grid.Update()

    def save(path):
        writer = vtk.vtkXMLUnstructuredGridWriter()
        writer.SetFileName(path)
        writer.SetInputData(grid.GetOutput())
        writer.Write()

    made = types.SimpleNamespace(cell_data={}, save=save)
    made.cast_to_unstructured_grid = lambda: made
    return made


@unittest.skipUnless(PYVISTA or has("vtk"), "neither PyVista nor VTK is installed")
class PyVista(unittest.TestCase):
    def setUp(self):
        if not PYVISTA:
            stand_in = types.SimpleNamespace(UnstructuredGrid=grid_of_vtk)
            patch = unittest.mock.patch.dict(sys.modules, pyvista=stand_in)
            patch.start()
            self.addCleanup(patch.stop)

    def volumes(self, grid):
        import vtk
        from vtk.util import numpy_support
        sizes = vtk.vtkCellSizeFilter()
        sizes.SetInputData(grid)
        sizes.Update()
        return numpy_support.vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Volume"))

    def test_cells_are_as_vtk_has_them(self):
        for mesh in with_wedges(), prism(sides=6).sweep(layers=3, size=0.4), of_two_volumes(), \
                prism(sides=6).sweep(layers=2, size=0.5, order=2, serendipity=True):
            grid = mesh.to_pyvista()
            self.assertEqual(grid.GetNumberOfCells(), mesh.hexes + mesh.wedges)
            volumes = self.volumes(grid)
            self.assertGreater(volumes.min(), 0)
            self.assertAlmostEqual(volumes.sum() / mesh.quality().volume, 1, 9)
            values = grid.cell_data["scaled_jacobian"]
            self.assertEqual(len(values), len(volumes))
            self.assertAlmostEqual(values.min(), mesh.quality().min_scaled_jacobian, 6)

    def test_middle_nodes_are_where_vtk_has_them(self):
        for mesh in prism(sides=6).sweep(layers=2, size=0.5, order=2), of_two_volumes(order=2), \
                prism(sides=6).sweep(layers=2, size=0.5, order=2, serendipity=True):
            grid = mesh.to_pyvista()
            self.assertEqual(grid.GetNumberOfPoints(), mesh.nodes)
            for number in range(0, grid.GetNumberOfCells(), 5):
                cell = grid.GetCell(number)
                count = cell.GetNumberOfPoints()
                self.assertIn(count, (20, 27))
                at = numpy.array(cell.GetParametricCoords()[:3 * count]).reshape(-1, 3)
                places = numpy.array([cell.GetPoints().GetPoint(i) for i in range(count)])
                corners = at[:8]
                weights = (corners[None] * at[:, None] + (1 - corners[None]) * (1 - at[:, None])).prod(axis=2)
                self.assertLess(abs(weights @ places[:8] - places).max(), 1e-9)

    def test_a_grid_is_loaded_with_its_cells(self):
        for mesh in with_wedges(), prism(sides=6).sweep(layers=3, size=0.4):
            part = lacuna.load(mesh.to_pyvista())
            self.assertTrue(all(face.has_mesh for face in part.faces()))
            self.assertEqual(len(part.faces()), 6 if mesh.wedges else 8)
            self.assertIn("from the PyVista mesh", str(part))
        grid = mesh.to_pyvista()
        grid.cell_data["gmsh:physical"] = numpy.ones(mesh.hexes)
        with self.assertLogs("lacuna", "WARNING") as caught:
            lacuna.load(grid)
        self.assertIn("'gmsh:physical'", caught.output[0])

    def test_surfaces_of_pyvista(self):
        part = lacuna.load(cylinder())
        self.assertEqual(len(part.faces()), 3)
        mesh = part.open_volume().sweep(layers=4)
        self.assertAlmostEqual(mesh.quality().volume, 24 * numpy.sin(numpy.pi / 12) / 8, 2)


@unittest.skipUnless(has("dolfinx"), "dolfinx is not installed")
class Dolfinx(unittest.TestCase):
    def test_cells_and_groups_are_those_of_the_mesh(self):
        import dolfinx
        for mesh in prism(sides=6, twist=20).sweep(layers=3, size=0.4), of_two_volumes(), \
                prism(sides=6, twist=20).sweep(layers=2, size=0.5, order=2):
            made, cell_tags, facet_tags, groups = mesh.to_dolfinx()
            self.assertEqual(made.topology.index_map(3).size_local, mesh.hexes)
            cells = made.geometry.dofmap.array.reshape(mesh.hexes, -1)
            self.assertEqual(cells.shape[1], 27 if mesh.order == 2 else 8)
            self.assertEqual({tuple(point) for point in made.geometry.x},
                             {tuple(point) for point in mesh.coordinates()})
            self.assertEqual({frozenset(map(tuple, made.geometry.x[cell])) for cell in cells},
                             {frozenset(map(tuple, mesh.coordinates()[cell - 1])) for cell in mesh.cells()})
            counts = {(group.name, group.dim): group.cells for group in mesh.groups()}
            for name, (dim, tag) in groups.items():
                tags = {3: cell_tags, 2: facet_tags}[dim]
                self.assertEqual(len(tags.find(tag)), counts[name, dim], name)
            self.assertEqual(len(cell_tags.values), mesh.hexes)
            heights = dolfinx.mesh.compute_midpoints(made, 2, facet_tags.find(groups[next(
                name for name in groups if name.endswith("source"))][1]))[:, 2]
            self.assertEqual(len(set(heights.round(12))), 1)

    def test_tetrahedra_alone(self):
        if not hasattr(lacuna, "gmsh_version") or lacuna.gmsh_version == "none":
            self.skipTest("no CAD")
        with tempfile.NamedTemporaryFile("w", suffix=".geo") as file:
            file.write('SetFactory("OpenCASCADE"); Sphere(1) = {0, 0, 0, 1}; Box(2) = {-2, -2, -2, 4, 4, 4};'
                       'BooleanDifference(3) = { Volume{2}; Delete; }{ Volume{1}; Delete; };')
            file.flush()
            void = lacuna.load(file.name).open_volume()
        with self.assertLogs("lacuna", "WARNING"):
            mesh = void.sweep(fallback="mixed", size=1)
        if mesh.hexes or mesh.pyramids:
            self.skipTest("it has other cells too")
        made = mesh.to_dolfinx().mesh
        self.assertEqual(made.topology.index_map(3).size_local, mesh.tets)

    def test_other_cells_are_an_error(self):
        for mesh in with_wedges(), prism().sweep(layers=2, size=0.5, order=2, serendipity=True):
            with self.assertRaisesRegex(lacuna.Error, "hexahedra of 8 or 27 nodes alone") as caught:
                mesh.to_dolfinx()
            self.assertEqual(caught.exception.code, "python.cells_of_dolfinx")
            self.assertIn("sweep without", caught.exception.remedy)


if __name__ == "__main__":
    unittest.main()
