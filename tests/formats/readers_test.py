"""The program's output as gmsh and VTK read it: nodes, elements and named groups agree with the OBJ output."""

import os
import tempfile
import unittest
from collections import Counter
from pathlib import Path

import gmsh
from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

from quad_mesh import labelled_cube, mesh_part, plain

PROGRAM = Path(os.environ["QMCF"]).resolve()
SAMPLES = Path(__file__).resolve().parents[2] / "samples"
LINE, TRIANGLE, QUAD = 1, 2, 3  # Element types of gmsh.
VTK_LINE, VTK_TRIANGLE, VTK_QUAD = 3, 5, 9


def sides(points):
    """Elements or segments as sets of coordinates: how a reader numbers nodes must not matter."""
    return Counter(frozenset(corner) for corner in points)


class Readers:
    """The tests of one part; subclasses say which."""

    part = None
    options = ()

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        part = cls.part(cls.folder)
        cls.mesh = mesh_part(PROGRAM, part, cls.folder, ["msh", "bdf", "vtu", "ply", "stl"], *cls.options)
        assert cls.mesh.count(4) > 100 and len(cls.mesh.faces) > 1 and len(cls.mesh.edges) > 1

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def file(self, extension):
        return str(self.folder / f"mesh.{extension}")

    def corners(self, elements):
        return sides([self.mesh.nodes[node] for node in element] for element in elements)

    def open_in_gmsh(self, extension):
        gmsh.initialize()
        self.addCleanup(gmsh.finalize)
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setNumber("General.AbortOnError", 0)
        gmsh.logger.start()
        gmsh.open(self.file(extension))
        problems = [line for line in gmsh.logger.get() if line.startswith(("Error", "Warning"))]
        gmsh.logger.stop()
        self.assertEqual(problems, [])
        tags, coordinates, _ = gmsh.model.mesh.getNodes()
        return {int(tag): tuple(coordinates[3 * i : 3 * i + 3]) for i, tag in enumerate(tags)}

    def entity_elements(self, dimension, entity):
        """{element type: [node tags of an element]} of a gmsh entity."""
        found = {}
        types, _, nodes = gmsh.model.mesh.getElements(dimension, entity)
        for kind, tags in zip(types, nodes):
            size = {LINE: 2, TRIANGLE: 3, QUAD: 4}[int(kind)]
            found[int(kind)] = [tuple(int(t) for t in tags[i : i + size]) for i in range(0, len(tags), size)]
        return found

    def physical_groups(self, dimension, nodes):
        """{name: the corners of its elements}."""
        groups = {}
        for dim, tag in gmsh.model.getPhysicalGroups(dimension):
            elements = []
            for entity in gmsh.model.getEntitiesForPhysicalGroup(dim, tag):
                for of_type in self.entity_elements(dim, entity).values():
                    elements += [[nodes[t] for t in element] for element in of_type]
            groups[plain(gmsh.model.getPhysicalName(dim, tag))] = sides(elements)
        return groups

    def test_msh_in_gmsh(self):
        nodes = self.open_in_gmsh("msh")
        self.assertEqual(sorted(nodes.values()), sorted(self.mesh.nodes))
        by_name = {plain(name): self.corners(group) for name, group in self.mesh.faces.items()}
        self.assertEqual(self.physical_groups(2, nodes), by_name)
        by_name = {plain(name): self.corners(group) for name, group in self.mesh.edges.items()}
        self.assertEqual(self.physical_groups(1, nodes), by_name)

    def test_bdf_in_gmsh(self):
        nodes = self.open_in_gmsh("bdf")
        self.assertEqual(len(nodes), len(self.mesh.nodes))
        # Fields of 16 characters: not every double fits. The order of nodes is that of the OBJ.
        scale = max(abs(x) for node in self.mesh.nodes for x in node)
        for tag, node in nodes.items():
            for read, written in zip(node, self.mesh.nodes[tag - 1]):
                self.assertAlmostEqual(read / scale, written / scale, delta=1e-9)
        groups = []
        for dimension, entity in gmsh.model.getEntities(2):
            elements = self.entity_elements(dimension, entity)
            groups.append((entity, Counter(tuple(t - 1 for t in e) for of_type in elements.values() for e in of_type)))
        expected = [(i + 1, Counter(group)) for i, group in enumerate(self.mesh.faces.values())]
        self.assertEqual(sorted(groups), sorted(expected, key=lambda entry: entry[0]))
        text = Path(self.file("bdf")).read_text()
        for number, name in enumerate(self.mesh.faces, 1):
            self.assertIn(f"$ Property {number}: ", text)
            self.assertIn(plain(name), plain(text))

    def read_with_vtk(self, reader, extension):
        reader.SetFileName(self.file(extension))
        reader.Update()
        self.assertEqual(reader.GetErrorCode(), 0)
        return reader.GetOutput()

    def cells(self, grid):
        """[(cell type, its points' coordinates)]."""
        found = []
        for i in range(grid.GetNumberOfCells()):
            cell = grid.GetCell(i)
            points = [grid.GetPoint(cell.GetPointId(k)) for k in range(cell.GetNumberOfPoints())]
            found.append((cell.GetCellType(), points))
        return found

    def test_vtu_in_vtk(self):
        grid = self.read_with_vtk(vtkXMLUnstructuredGridReader(), "vtu")
        self.assertEqual(grid.GetNumberOfPoints(), len(self.mesh.nodes))
        self.assertEqual([grid.GetPoint(i) for i in range(len(self.mesh.nodes))], self.mesh.nodes)
        cells = self.cells(grid)
        self.assertEqual(
            Counter(kind for kind, _ in cells),
            Counter({
                VTK_QUAD: self.mesh.count(4),
                VTK_TRIANGLE: self.mesh.count(3),
                VTK_LINE: sum(len(group) for group in self.mesh.edges.values()),
            }) + Counter(),
        )
        for array, names, groups, kinds in (
            ("face", "faceNames", self.mesh.faces, (VTK_QUAD, VTK_TRIANGLE)),
            ("edge", "edgeNames", self.mesh.edges, (VTK_LINE,)),
        ):
            ids = grid.GetCellData().GetArray(array)
            texts = grid.GetFieldData().GetAbstractArray(names)
            found = {}
            for i, (kind, points) in enumerate(cells):
                if kind in kinds:
                    name = plain(texts.GetValue(int(ids.GetTuple1(i))))
                    found.setdefault(name, []).append(points)
            self.assertEqual(
                {name: sides(group) for name, group in found.items()},
                {plain(name): self.corners(group) for name, group in groups.items()},
            )

    def test_obj_in_vtk(self):
        grid = self.read_with_vtk(vtkOBJReader(), "obj")
        kinds = Counter(kind for kind, _ in self.cells(grid))
        self.assertEqual((kinds[VTK_QUAD], kinds[VTK_TRIANGLE]), (self.mesh.count(4), self.mesh.count(3)))

    def test_ply_in_vtk(self):
        grid = self.read_with_vtk(vtkPLYReader(), "ply")
        self.assertEqual(grid.GetNumberOfPoints(), len(self.mesh.nodes))
        kinds = Counter(kind for kind, _ in self.cells(grid))
        self.assertEqual((kinds[VTK_QUAD], kinds[VTK_TRIANGLE]), (self.mesh.count(4), self.mesh.count(3)))

    def test_stl_in_vtk(self):
        grid = self.read_with_vtk(vtkSTLReader(), "stl")
        self.assertEqual(grid.GetNumberOfCells(), 2 * self.mesh.count(4) + self.mesh.count(3))
        # The reader merges equal points: the mesh hangs together in single precision, too.
        self.assertEqual(grid.GetNumberOfPoints(), len(self.mesh.nodes))


class Solid(Readers, unittest.TestCase):
    options = ("--quads", "1500")

    @staticmethod
    def part(folder):
        return SAMPLES / "plate_with_holes.stl"


class NonManifoldSheets(Readers, unittest.TestCase):
    options = ("--quads", "400")

    @staticmethod
    def part(folder):
        return SAMPLES / "t_sheets.obj"

    def test_sheets_share_the_nodes_of_their_common_edge(self):
        uses = Counter()
        for element in self.mesh.elements():
            for a, b in zip(element, element[1:] + element[:1]):
                uses[frozenset((a, b))] += 1
        shared = {side for side, count in uses.items() if count == 3}
        self.assertIn(shared, [{frozenset(segment) for segment in group} for group in self.mesh.edges.values()])


class NamedGroups(Readers, unittest.TestCase):
    options = ("--quads", "600")

    @staticmethod
    def part(folder):
        path = folder / "part.obj"
        path.write_text(labelled_cube(), encoding="utf-8")
        return path

    def test_names_of_the_file_arrive(self):
        nodes = self.open_in_gmsh("msh")
        names = {gmsh.model.getPhysicalName(dim, tag) for dim, tag in gmsh.model.getPhysicalGroups(2)}
        del nodes
        self.assertIn("top side", names)
        self.assertTrue(any(name.startswith("4 walls") for name in names), names)
        self.assertTrue(any(name.startswith("Rückseite _B_") for name in names), names)


if __name__ == "__main__":
    unittest.main()
