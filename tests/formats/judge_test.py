"""OBJ and PLY as an independent judge of quad meshes reads them: valid, with the counts of the OBJ output.

The judge is a Node program outside this project: QMCF_JUDGE, or ../shared/judge/judge.mjs beside the checkout."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

from quad_mesh import mesh_part

PROGRAM = Path(os.environ["QMCF"]).resolve()
ROOT = Path(__file__).resolve().parents[2]
JUDGE = Path(os.environ.get("QMCF_JUDGE", ROOT / ".." / "shared" / "judge" / "judge.mjs"))


@unittest.skipUnless(JUDGE.exists(), "there is no judge: set QMCF_JUDGE")
class JudgeTest(unittest.TestCase):
    def test_obj_and_ply_are_valid_with_the_same_counts(self):
        for part in ["bracket_with_fillets.stl", "t_sheets.obj"]:
            sample = ROOT / "samples" / part
            with self.subTest(part), tempfile.TemporaryDirectory() as folder:
                mesh = mesh_part(PROGRAM, sample, folder, ["ply"], "--quads", "1200")
                for extension in ["obj", "ply"]:
                    file = Path(folder) / f"mesh.{extension}"
                    judged = subprocess.run(
                        ["node", JUDGE, "--json", "--ref", sample, file], capture_output=True, text=True
                    )
                    report = json.loads(judged.stdout)
                    self.assertEqual(judged.returncode, 0, report["validity"])
                    self.assertTrue(report["validity"]["valid"])
                    composition = report["composition"]
                    self.assertEqual(composition["vertices"], len(mesh.nodes))
                    self.assertEqual(composition["quads"], mesh.count(4))
                    self.assertEqual(composition["triangles"], mesh.count(3))
                    self.assertEqual(composition["other"], 0)


if __name__ == "__main__":
    unittest.main()
