#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The supervisor: whatever is killed or stopped, the picture is the same in the end, and nothing is left behind."""

import os
import pathlib
import signal
import subprocess
import time

import running_program
from running_program import BAD_SCENE, CANNOT_CREATE, ENVIRONMENT, INPUT_MISSING, MIRROR_SCENE, TIME_LIMIT_S, USAGE

SCENE = MIRROR_SCENE + """
[generate]
kind = "sphereflake"
level = 2
"""
SIZE = ("-r", "1600x1200", "-s", "4")
IMPATIENT = ("-n", "2", "--patience", "4")  # a busy machine may take that long to start a run


class TesseraRunTest(running_program.ProgramTest):
    reference = None  # the picture, rendered once

    def setUp(self):
        super().setUp()
        self.scene = self.write("scene.toml", SCENE)

    def start(self, *words, options=("-n", "2"), size=SIZE):
        return subprocess.Popen([self.supervisor, "--tessera", self.tessera, *options, "--", self.scene, "-o", "out.png",
                                 *size, *words], cwd=self.folder, env=ENVIRONMENT, stderr=subprocess.PIPE, text=True)

    def finish(self, process):
        stderr = process.communicate(timeout=TIME_LIMIT_S)[1]
        self.assertEqual(list(self.ranks()), [], "processes are left")
        return process.returncode, stderr

    def ranks(self, rank=None):
        """Processes of the program that run in our folder: all, or those of one rank."""
        for process in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                if os.readlink(process / "cwd") != str(self.folder) or os.readlink(process / "exe") != self.tessera:
                    continue
                environment = (process / "environ").read_bytes().split(b"\0")
                if rank is None or f"OMPI_COMM_WORLD_RANK={rank}".encode() in environment:
                    yield int(process.name)
            except OSError:
                pass

    def wait_for(self, process, what):
        """The first true value of what()."""
        limit = time.monotonic() + TIME_LIMIT_S
        while process.poll() is None and time.monotonic() < limit:
            if value := what():
                return value
            time.sleep(0.002)
        self.fail(f"it did not happen: {process.communicate()[1]}")

    def wait_for_records(self, process):
        journal = self.folder / "out.png.journal"
        self.wait_for(process, lambda: journal.exists() and journal.stat().st_size > 48)

    def assert_done(self, process, says, restarts=(1,)):
        code, stderr = self.finish(process)
        self.assertEqual(code, 0, stderr)
        for part in says:
            self.assertIn(part, stderr)
        self.assertIn(stderr.count("going on from out.png.journal"), restarts, stderr)
        picture = self.folder / "out.png"
        done = picture.read_bytes()
        self.assertEqual({path.name for path in self.folder.iterdir()}, {"scene.toml", "out.png"})
        if TesseraRunTest.reference is None:
            self.run_tessera("render", self.scene, "-o", "reference.png", "-q", *SIZE)
            TesseraRunTest.reference = (self.folder / "reference.png").read_bytes()
        self.assertEqual(done, TesseraRunTest.reference)

    def first(self, process, rank):
        return self.wait_for(process, lambda: next(self.ranks(rank), None))

    def test_a_run_without_faults_is_left_alone(self):
        self.assert_done(self.start(), [], restarts=(0,))

    def test_a_killed_rank_0_is_resumed_at_once(self):
        process = self.start()
        self.wait_for_records(process)
        os.kill(self.first(process, 0), signal.SIGKILL)
        self.assert_done(process, ["rank 0 ended with 137 (signal 9)", "resumed:"])

    def test_a_worker_killed_while_the_ranks_meet_costs_a_restart(self):
        process = self.start(options=IMPATIENT)
        os.kill(self.first(process, 1), signal.SIGKILL)
        self.assert_done(process, [], restarts=(1, 2, 3))  # MPI hangs there, or ends rank 0, as it happens

    def test_a_killed_or_stopped_worker_costs_no_restart(self):
        for number in (signal.SIGKILL, signal.SIGSTOP):
            process = self.start("--lease", "0.5")
            self.wait_for_records(process)
            os.kill(self.first(process, 1), number)
            self.assert_done(process, ["lost: rank 1"], restarts=(0,))
            (self.folder / "out.png").unlink()

    def test_a_stopped_rank_0_is_resumed(self):
        process = self.start(options=IMPATIENT)
        self.wait_for_records(process)
        os.kill(self.first(process, 0), signal.SIGSTOP)
        self.assert_done(process, ["no sign of life for 4 s", "resumed:"], restarts=(1, 2, 3))

    def test_a_killed_launcher_is_resumed(self):
        process = self.start()
        self.wait_for_records(process)
        children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
        os.kill(int(children[0]), signal.SIGKILL)
        self.assert_done(process, ["mpirun ended with -9", "resumed:"])

    def test_it_gives_up_after_so_many_restarts_and_keeps_the_journal(self):
        process = self.start(options=("-n", "2", "--restarts", "1"))
        for _ in range(2):
            self.wait_for_records(process)
            killed = self.first(process, 0)
            os.kill(killed, signal.SIGKILL)
            self.wait_for(process, lambda: killed not in self.ranks())  # pylint: disable=cell-var-from-loop
        code, stderr = self.finish(process)
        self.assertEqual(code, 137, stderr)
        self.assertIn("gave up", stderr)
        self.assertTrue((self.folder / "out.png.journal").exists())
        self.assert_done(self.start(), ["resumed:"], restarts=(0,))

    def test_signals_go_on_to_rank_0(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            process = self.start()
            self.first(process, 0)
            self.wait_for_records(process)
            process.send_signal(number)
            code, stderr = self.finish(process)
            self.assertEqual(code, 128 + number, stderr)
            self.assertIn("the same command goes on from", stderr)
            self.assertEqual({path.name for path in self.folder.iterdir()}, {"scene.toml", "out.png.journal"})
        self.assert_done(self.start(), ["resumed:"], restarts=(0,))

    def test_what_another_run_would_not_mend_is_not_repeated(self):
        notes = self.write("notes.txt", "no journal")
        for words, code in [(("--tile-size", "0"), USAGE), (("--journal", "notes.txt", "--resume"), BAD_SCENE)]:
            process = self.start(*words)
            ended_with, stderr = self.finish(process)
            self.assertEqual(ended_with, code, stderr)
            self.assertEqual(len([line for line in stderr.splitlines() if line.startswith("tessera:")]), 1, stderr)
            self.assertEqual({path.name for path in self.folder.iterdir()}, {"scene.toml", "notes.txt"})
        self.assertEqual(notes.read_text(), "no journal")
        for words, code in [(["nowhere.toml"], INPUT_MISSING), (["scene.toml", "-ono/such/a.png"], CANNOT_CREATE)]:
            run = subprocess.run([self.supervisor, "--tessera", self.tessera, "-n", "1", "--", *words], cwd=self.folder,
                                 env=ENVIRONMENT, capture_output=True, text=True, check=False)
            self.assertEqual(run.returncode, code, run.stderr)

    def test_mpirun_may_be_missing_or_refuse(self):
        process = self.start(options=("--mpirun", "no-such-program"))
        self.assertEqual(self.finish(process)[0], 69)
        self.assertEqual({path.name for path in self.folder.iterdir()}, {"scene.toml"})
        process = self.start(options=("-n", "2", "--no-such-option"))
        code, stderr = self.finish(process)
        self.assertNotIn(code, (0, None), stderr)
        self.assertNotIn("going on", stderr)

    def test_a_command_without_a_scene_is_refused(self):
        for words in (["--patience", "long"], ["--restarts", "-1", "--", "scene.toml"]):
            run = subprocess.run([self.supervisor, *words], capture_output=True, text=True, check=False)
            self.assertEqual((run.returncode, words[0] in run.stderr), (USAGE, True), run.stderr)
        for words in ([], ["-n", "2"], ["-n", "2", "--"], ["-n", "2", "--", "-o", "out.png"]):
            run = subprocess.run([self.supervisor, *words], capture_output=True, text=True, check=False)
            self.assertEqual((run.returncode, "the scene is missing" in run.stderr), (USAGE, True), run.stderr)
        run = subprocess.run([self.supervisor, "--help"], capture_output=True, text=True, check=False)
        self.assertEqual((run.returncode, "--patience" in run.stdout), (0, True))


if __name__ == "__main__":
    running_program.main(__doc__, supervisor="scripts/tessera-run")
