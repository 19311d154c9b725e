#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Many short jobs, one after the other, with whatever options chance gives: none of them hangs, fails or renders another
picture."""

import random

import running_program
from running_program import ProgramTest

SCENE = """
format = 1
[image]
width = 120
height = 90
[[light]]
position = [4, 3, 6]
[material.mirror]
reflection = 0.5
[generate]
kind = "cloud"
count = 60
seed = 3
material = "mirror"
"""
SCHEDULES = ("dynamic", "static-bands", "cyclic-rows", "self", "guided", "factoring", "trapezoid")


class SoakTest(ProgramTest):
    def test_many_short_jobs(self):
        scene = self.write("cloud.toml", SCENE)
        alone = self.run_tessera("render", scene, "-o", "alone.png", "-q")
        self.assertEqual(alone.returncode, 0, alone.stderr)
        picture = (self.folder / "alone.png").read_bytes()
        for job in range(int(self.jobs)):
            chance = random.Random(job)
            options = ["--schedule", chance.choice(SCHEDULES), "--tile-size", chance.choice((1, 7, 8, 16, 64, 500)),
                       "--prefetch", chance.choice(("auto", 1, 2, 9)), "--ask-back", chance.choice(("on", "off")),
                       "--lease", chance.choice(("off", 0.05, 1))]
            ranks = chance.randrange(1, 7)
            with self.subTest(job=job, ranks=ranks, options=options):
                run = self.run_tessera("render", scene, "-o", "out.png", "-q", *options, ranks=ranks)
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertEqual((self.folder / "out.png").read_bytes(), picture)


if __name__ == "__main__":
    running_program.main(__doc__, jobs="how many")
