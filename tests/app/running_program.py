# SPDX-License-Identifier: BSD-3-Clause
"""What tests that run the program share: a folder of their own, the program with and without mpirun, and refusals."""

import argparse
import os
import pathlib
import subprocess
import tempfile
import unittest

TIME_LIMIT_S = 60
# Root in a container, and no complaints of mpirun's own about what a container hides.
ENVIRONMENT = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                            "HWLOC_HIDE_ERRORS": "2"}

# A mirror in front of a camera, to be gone on with
MIRROR_SCENE = """
[camera]
eye = [0, -4, 2]
target = [0, 0, 0]
[[light]]
position = [3, -3, 5]
[material.mirror]
reflection = 0.5
[[sphere]]
center = [0, 0, 0]
radius = 1
material = "mirror"
"""

USAGE, BAD_SCENE, INPUT_MISSING, CANNOT_CREATE, IO_FAILURE = 64, 65, 66, 73, 74


class ProgramTest(unittest.TestCase):
    tessera = ""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def run_tessera(self, *words, ranks=0):
        """Runs the program, under mpirun where ranks > 0. A hang fails the test by its time limit."""
        launcher = ["mpirun", "-n", str(ranks), "--oversubscribe"] if ranks else []
        return subprocess.run([*launcher, self.tessera, *map(str, words)], cwd=self.folder, env=ENVIRONMENT,
                              capture_output=True, text=True, timeout=TIME_LIMIT_S, check=False)

    def own_lines(self, run):
        """What the program itself wrote to stderr, without mpirun's words."""
        return [line for line in run.stderr.splitlines() if line.startswith("tessera:")]

    def assert_refused(self, code, *words, says, ranks=(0, 3)):
        """One line from rank 0, this exit code, nothing on stdout, no file left."""
        before = set(self.folder.iterdir())
        for count in ranks:
            with self.subTest(ranks=count, words=words):
                run = self.run_tessera(*words, ranks=count)
                self.assertEqual(run.returncode, code, run.stderr)
                self.assertEqual(len(self.own_lines(run)), 1, run.stderr)
                for part in [says] if isinstance(says, str) else says:
                    self.assertIn(part, self.own_lines(run)[0])
                self.assertEqual(run.stdout, "")
                self.assertEqual(set(self.folder.iterdir()), before)


def main(description, **options):
    """Runs the tests of the calling file. Each option of the command line becomes an attribute of ProgramTest; what is
    left goes to unittest."""
    parser = argparse.ArgumentParser(description=description)
    for name, text in {"tessera": "the program", **options}.items():
        parser.add_argument(f"--{name}", required=True, help=text)
    arguments, rest = parser.parse_known_args()
    for name, value in vars(arguments).items():
        setattr(ProgramTest, name, value)
    unittest.main(argv=["test", *rest])
