"""Meshes for the format tests: the program's OBJ output, read by a parser that is not the program's."""

import re
import subprocess
from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class QuadMesh:
    """Nodes, and the elements and edge segments of each named group in the order of the file; indices from 0."""

    nodes: list = field(default_factory=list)
    faces: dict = field(default_factory=dict)
    edges: dict = field(default_factory=dict)

    def elements(self):
        return [element for group in self.faces.values() for element in group]

    def count(self, corners):
        return sum(len(element) == corners for element in self.elements())


def read_obj(path):
    mesh = QuadMesh()
    group = ""
    for line in Path(path).read_text(encoding="utf-8").splitlines():
        keyword, _, rest = line.partition(" ")
        if keyword == "v":
            mesh.nodes.append(tuple(float(number) for number in rest.split()))
        elif keyword == "g":
            group = rest
        elif keyword == "f":
            mesh.faces.setdefault(group, []).append(tuple(int(index) - 1 for index in rest.split()))
        elif keyword == "l":
            points = [int(index) - 1 for index in rest.split()]
            mesh.edges.setdefault(group, []).extend(zip(points, points[1:]))
    return mesh


def mesh_part(program, part, folder, formats, *options):
    """Meshes the part once per format (runs are deterministic) and returns the OBJ's content."""
    for name in ["obj", *formats]:
        output = Path(folder) / f"mesh.{name}"
        subprocess.run([program, "mesh", part, "-o", output, "--quiet", *options], check=True)
    return read_obj(Path(folder) / "mesh.obj")


def plain(name):
    """What all rules for names have in common: letters and digits, and '_' for any other characters between them."""
    return re.sub("[^A-Za-z0-9]+", "_", name)


def labelled_cube():
    """A cube of three named groups, whose names hold what some formats can't: blanks, quotes, umlauts, digits first."""
    corners = [(x, y, z) for z in (0, 10) for y in (0, 10) for x in (0, 10)]
    sides = {
        "top side": [(5, 6, 8, 7)],
        'Rückseite "B"': [(1, 3, 4, 2)],
        "4 walls": [(1, 2, 6, 5), (2, 4, 8, 6), (4, 3, 7, 8), (3, 1, 5, 7)],
    }
    lines = [f"v {x} {y} {z}" for x, y, z in corners]
    # Labels divide faces when their regions have four triangles or more on average: each side is a fan of 16.
    for name, quads in sides.items():
        lines.append(f"g {name}")
        for quad in quads:
            ring = []
            for a, b in zip(quad, quad[1:] + quad[:1]):
                pa, pb = corners[a - 1], corners[b - 1]
                ring += [tuple(pa[k] + (pb[k] - pa[k]) * i / 4 for k in range(3)) for i in range(4)]
            centre = tuple(sum(corners[i - 1][k] for i in quad) / 4 for k in range(3))
            base = sum(line.startswith("v ") for line in lines)
            lines += [f"v {x} {y} {z}" for x, y, z in [*ring, centre]]
            lines += [f"f {base + 1 + i} {base + 1 + (i + 1) % 16} {base + 17}" for i in range(16)]
    return "\n".join(lines) + "\n"
