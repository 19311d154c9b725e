# SPDX-License-Identifier: BSD-3-Clause
"""What tests share that do harm to ranks while they render."""

import json
import os
import pathlib
import subprocess
import time

from running_program import ENVIRONMENT, TIME_LIMIT_S, ProgramTest

LEASE_S = 0.4
SCENE = """
format = 1
[image]
width = 1000
height = 1000
samples = 9
max_bounces = 8
[[light]]
position = [4, 3, 6]
[[light]]
position = [1, -4, 4]
[material.mirror]
reflection = 0.6
[generate]
kind = "cloud"
count = 10000
seed = 7
material = "mirror"
"""

# A rank has said hello long before it has used so much of a core; starting takes about 0.15 s of one.
FIRST_MOMENT_S, LAST_MOMENT_S = 0.35, 0.7
TICKS_PER_SECOND = os.sysconf("SC_CLK_TCK")


def core_seconds(process):
    """How long a process has computed, or None if it is gone."""
    try:
        fields = pathlib.Path(f"/proc/{process}/stat").read_text(encoding="ascii").rsplit(")", 1)[1].split()
    except OSError:
        return None
    return (int(fields[11]) + int(fields[12])) / TICKS_PER_SECOND


def is_running(process):
    return core_seconds(process) is not None


def processes_of(folder):
    """rank -> process, of the job that works in `folder`."""
    ranks = {}
    for path in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            is_ours = pathlib.Path(os.readlink(path / "cwd")) == folder.resolve()
            if not is_ours or (path / "comm").read_text(encoding="ascii").strip() != "tessera":
                continue
            variables = (path / "environ").read_bytes().split(b"\0")
        except OSError:
            continue
        for variable in variables:
            name, _, value = variable.partition(b"=")
            if name == b"OMPI_COMM_WORLD_RANK":
                ranks[int(value)] = int(path.name)
    return ranks


class HarmedRunTest(ProgramTest):
    """Knows the picture as one process renders it."""

    ranks = 4

    def setUp(self):
        super().setUp()
        self.scene = self.write("cloud.toml", SCENE)
        alone = self.run_tessera("render", self.scene, "-o", "alone.png", "-q")
        self.assertEqual(alone.returncode, 0, alone.stderr)
        self.picture = (self.folder / "alone.png").read_bytes()

    def launch(self):
        """What starts the ranks, up to the program's own options."""
        return ["mpirun", "--oversubscribe", "--enable-recovery", "-n", str(self.ranks), self.tessera, "render"]

    def render_while(self, harm, *options):
        """Renders with all ranks, does `harm` to {rank: process} meanwhile, and returns the statistics."""
        command = [*self.launch(), str(self.scene), "-o", "out.png", "-q", "--lease", str(LEASE_S), "--stats",
                   "stats.json", *options]
        job = subprocess.Popen(command, cwd=self.folder, env=ENVIRONMENT, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)
        try:
            deadline = time.monotonic() + TIME_LIMIT_S
            while len(processes := processes_of(self.folder)) < self.ranks:
                self.assertLess(time.monotonic(), deadline, "the job does not start")
                self.assertIsNone(job.poll(), "the job ended before it began")
                time.sleep(0.01)
            harm(processes)
            _, errors = job.communicate(timeout=TIME_LIMIT_S)
        finally:
            job.kill()
            job.communicate()
        self.assertEqual(job.returncode, 0, errors)
        self.assertEqual((self.folder / "out.png").read_bytes(), self.picture)
        for process in processes.values():
            self.assertFalse(is_running(process), "a process is left")
        return json.loads((self.folder / "stats.json").read_text(encoding="utf-8"))

    def signal_at(self, process, core_s, number):
        """Sends a signal once the process has used so much of a core."""
        deadline = time.monotonic() + TIME_LIMIT_S
        while (used := core_seconds(process)) is not None and used < core_s:
            self.assertLess(time.monotonic(), deadline, "a rank does not get to work")
            time.sleep(0.002)
        os.kill(process, number)
