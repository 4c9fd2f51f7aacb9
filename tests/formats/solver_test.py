"""A plate with a hole in tension, meshed, solved by CalculiX with the sets of the INP output, against the formula.

Stress at the hole's edge over the stress far away, for a hole of diameter d in a plate of width W (R. B. Heywood 1952;
Pilkey, Peterson's Stress Concentration Factors, chart 4.1): (2 + (1 - d/W)^3) / (1 - d/W).
"""

import math
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from quad_mesh import mesh_part

PROGRAM = Path(os.environ["QMCF"]).resolve()
RADIUS, HALF_WIDTH, THICKNESS = 1.0, 8.0, 0.1


def quarter_plate():
    """The quarter x, y > 0 as one polygon of an OBJ file, its hole of half a degree a side."""
    count = 180
    arc = [
        (RADIUS * math.cos(math.radians(90 * i / count)), RADIUS * math.sin(math.radians(90 * i / count)))
        for i in range(count, -1, -1)
    ]
    arc[0], arc[-1] = (0.0, RADIUS), (RADIUS, 0.0)
    outline = [*arc, (HALF_WIDTH, 0.0), (HALF_WIDTH, HALF_WIDTH), (0.0, HALF_WIDTH)]
    return "".join(f"v {x!r} {y!r}\n" for x, y in outline) + "f " + " ".join(
        str(i + 1) for i in range(len(outline))
    )


def read_inp(text):
    """Nodes {number: point}, element sets {name: [(number, corners)]} and node sets {name: [numbers]}."""
    nodes, elements, sets = {}, {}, {}
    card, name = "", ""
    for line in text.splitlines():
        if line.startswith("*"):
            card, *parameters = [word.strip() for word in line.split(",")]
            values = dict(word.split("=") for word in parameters if "=" in word)
            name = values.get("ELSET") or values.get("NSET") or ""
            continue
        fields = [word.strip() for word in line.split(",") if word.strip()]
        if card == "*NODE":
            nodes[int(fields[0])] = tuple(float(word) for word in fields[1:])
        elif card == "*ELEMENT":
            elements.setdefault(name, []).append(tuple(int(word) for word in fields))
        elif card == "*NSET":
            sets.setdefault(name, []).extend(int(word) for word in fields)
    return nodes, elements, sets


def read_stress(path):
    """[(point, xx stress)] of a CalculiX result file, whose fields have fixed widths."""
    points, found, block = {}, [], ""
    for line in Path(path).read_text().splitlines():
        if line.startswith("    2C"):
            block = "nodes"
        elif line.startswith(" -4"):
            block = line.split()[1]
        elif line.startswith(" -3"):
            block = ""
        elif line.startswith(" -1") and block == "nodes":
            points[int(line[3:13])] = tuple(float(line[13 + 12 * i : 25 + 12 * i]) for i in range(3))
        elif line.startswith(" -1") and block == "STRESS":
            found.append((points[int(line[3:13])], float(line[13:25])))
    return found


class PlateWithHole(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        part = cls.folder / "quarter.obj"
        part.write_text(quarter_plate())
        cls.mesh = mesh_part(PROGRAM, part, cls.folder, ["inp"], "--quads", "8000")
        cls.text = (cls.folder / "mesh.inp").read_text()
        cls.nodes, cls.elements, cls.sets = read_inp(cls.text)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def set_at(self, holds):
        """The name of the set of exactly the nodes with this property."""
        wanted = {number for number, point in self.nodes.items() if holds(point)}
        names = [name for name, numbers in self.sets.items() if set(numbers) == wanted]
        self.assertEqual(len(names), 1, f"one set for {len(wanted)} nodes, of {list(self.sets)}")
        return names[0]

    def test_counts_and_sets_agree_with_the_mesh(self):
        self.assertEqual(len(self.nodes), len(self.mesh.nodes))
        read = [corners for group in self.elements.values() for _, *corners in group]
        self.assertEqual(len(read), len(self.mesh.elements()))
        self.assertEqual(
            {frozenset(c - 1 for c in corners) for corners in read},
            {frozenset(element) for element in self.mesh.elements()},
        )
        self.assertEqual(set(self.elements), set(self.mesh.faces))
        self.assertEqual(set(self.sets), set(self.mesh.edges))
        for name, segments in self.mesh.edges.items():
            self.assertEqual(set(self.sets[name]), {node + 1 for segment in segments for node in segment})

    def load(self, right):
        """A tension of 1 along x, spread over the nodes of the right side."""
        height = {number: self.nodes[number][1] for number in self.sets[right]}
        order = sorted(height, key=height.get)
        force = dict.fromkeys(order, 0.0)
        for a, b in zip(order, order[1:]):
            for node in (a, b):
                force[node] += (height[b] - height[a]) / 2 * THICKNESS
        self.assertAlmostEqual(sum(force.values()), HALF_WIDTH * THICKNESS, places=9)
        return "".join(f"{node}, 1, {value!r}\n" for node, value in force.items())

    @unittest.skipUnless(shutil.which("ccx"), "CalculiX is not installed; Debian 13 has no package of it")
    def test_stress_concentration(self):
        left = self.set_at(lambda p: abs(p[0]) < 1e-9)
        bottom = self.set_at(lambda p: abs(p[1]) < 1e-9)
        right = self.set_at(lambda p: abs(p[0] - HALF_WIDTH) < 1e-9)
        sections = "".join(
            f"*SHELL SECTION, MATERIAL=STEEL, ELSET={name}\n{THICKNESS}\n" for name in self.elements
        )
        (self.folder / "run.inp").write_text(
            f"{self.text}*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n{sections}"
            f"*BOUNDARY\n{left}, 1, 1\n{bottom}, 2, 2\n{left}, 3, 3\n{bottom}, 3, 3\n{right}, 3, 3\n"
            f"*STEP\n*STATIC\n*CLOAD\n{self.load(right)}*EL FILE\nS\n*END STEP\n"
        )
        run = subprocess.run(["ccx", "run"], cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stdout[-2000:])
        self.assertNotIn("*ERROR", run.stdout)
        at_hole = [s for (x, y, _), s in read_stress(self.folder / "run.frd") if abs(x) < 1e-6 and abs(y - RADIUS) < 1e-3]
        self.assertTrue(at_hole)
        ratio = RADIUS / HALF_WIDTH
        expected = (2 + (1 - ratio) ** 3) / (1 - ratio)
        measured = sum(at_hole) / len(at_hole)
        print(f"stress concentration {measured:.3f}, by the formula {expected:.3f}")
        self.assertAlmostEqual(measured / expected, 1.0, delta=0.05)


if __name__ == "__main__":
    unittest.main()
