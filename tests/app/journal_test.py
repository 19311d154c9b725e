#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs that are killed at any moment, and what --resume makes of what they left."""

import fcntl
import json
import os
import pathlib
import random
import signal
import subprocess
import time

import running_program
from running_program import BAD_SCENE, CANNOT_CREATE, ENVIRONMENT, IO_FAILURE, MIRROR_SCENE, TIME_LIMIT_S, USAGE

SCENE = MIRROR_SCENE + """
[image]
width = 61
height = 47
samples = 4
[generate]
kind = "sphereflake"
level = 2
"""
LARGE = ("-r", "900x700")  # long enough to be killed on the way


class JournalTest(running_program.ProgramTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write("scene.toml", SCENE)
        self.random = random.Random(5)

    def render(self, *words, ranks=0):
        return self.run_tessera("render", self.scene, *words, ranks=ranks)

    def reference(self, *words):
        run = self.render("-o", "reference.png", "-q", *words)
        self.assertEqual(run.returncode, 0, run.stderr)
        picture = (self.folder / "reference.png").read_bytes()
        (self.folder / "reference.png").unlink()
        return picture

    def whole_journal(self, *words):
        """A journal with every pixel: its run could not write its last output."""
        run = self.render("-o", "unwritten.png", "-q", "--journal", "whole", "--stats", "/dev/full", *words)
        self.assertEqual(run.returncode, IO_FAILURE, run.stderr)
        return (self.folder / "whole").read_bytes()

    def start(self, *words, ranks=0):
        launcher = ["mpirun", "-n", str(ranks), "--oversubscribe"] if ranks else []
        return subprocess.Popen([*launcher, self.tessera, "render", self.scene, *map(str, words)], cwd=self.folder,
                                env=ENVIRONMENT, stderr=subprocess.PIPE, text=True, start_new_session=True)

    def wait_for_records(self, process, least=1):
        """Waits until so many bytes are in the journal, or until there is none any more."""
        journal = self.folder / "j"
        limit = time.monotonic() + TIME_LIMIT_S
        while process.poll() is None and time.monotonic() < limit:
            if journal.exists() and journal.stat().st_size >= 48 + least:
                return True
            time.sleep(0.005)
        return False

    def assert_resumes(self, picture, *words, ranks=0):
        run = self.render("-o", "out.png", "--journal", "j", "--resume", "--stats", "stats.json", *words, ranks=ranks)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual((self.folder / "out.png").read_bytes(), picture)
        self.assertEqual({path.name for path in self.folder.iterdir()} - {"whole", "unwritten.png.part"},
                         {"scene.toml", "out.png", "stats.json"})
        return run, json.loads((self.folder / "stats.json").read_text())

    # what is left of a journal

    def test_a_journal_cut_off_anywhere_resumes_to_the_same_file(self):
        picture = self.reference()
        whole = self.whole_journal("--tile-size", "16")
        cuts = [0, 1, 47, 48, 49, len(whole) - 1, len(whole)] + self.random.sample(range(len(whole)), 12)
        for number, cut in enumerate(cuts):
            ranks, tile = [(0, "7"), (2, "16"), (3, "9x40"), (0, "16")][number % 4]
            with self.subTest(cut=cut, ranks=ranks, tile=tile):
                self.write("j", whole[:cut])
                _, stats = self.assert_resumes(picture, "--tile-size", tile, ranks=ranks)
                resumed = stats.get("resumed", {"pixels": 0})["pixels"]
                self.assertEqual(resumed + sum(rank["pixels"] for rank in stats["ranks"]), 61 * 47)

    def test_nothing_is_rendered_where_all_is_there(self):
        picture = self.reference()
        whole = self.whole_journal()
        for ranks in (0, 3):
            self.write("j", whole)
            run, stats = self.assert_resumes(picture, "--tile-stats", "-", "--schedule", "static-bands", ranks=ranks)
            self.assertEqual(stats["resumed"]["pixels"], 61 * 47)
            self.assertEqual(stats["resumed"]["tiles"], max(ranks, 1))
            self.assertGreater(stats["resumed"]["rays"], 4 * 61 * 47)
            self.assertEqual((stats["schedule"]["tiles"], stats["rays"]["primary"], stats["messages"]["count"]), (0, 0, 0))
            self.assertEqual(len(run.stdout.splitlines()), 1)
            self.assertIn("100.0 % of the pixels, from j", run.stderr)

    def test_every_layer_comes_back(self):
        outputs = ["--signature", "s.sig", "--error", "e.pfm"]
        self.assertEqual(self.render("-o", "a.pfm", "-q", *outputs).returncode, 0)
        files = [(self.folder / name).read_bytes() for name in ("a.pfm", "s.sig", "e.pfm")]
        self.render("-o", "a.pfm", "-q", "--journal", "j", "--stats", "/dev/full", *outputs)
        journal = (self.folder / "j").read_bytes()
        self.write("j", journal[:len(journal) // 2])
        run = self.render("-o", "a.pfm", "-q", "--journal", "j", "--resume", *outputs, ranks=2)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual([(self.folder / name).read_bytes() for name in ("a.pfm", "s.sig", "e.pfm")], files)

    def test_without_a_journal_all_is_rendered_with_a_note(self):
        run, stats = self.assert_resumes(self.reference())
        self.assertIn("note: j was not there to resume from", run.stderr)
        self.assertNotIn("resumed", stats)

    # what is refused

    def test_another_picture_is_refused(self):
        self.write("j", self.whole_journal())
        (self.folder / "whole").unlink()
        for words in (["-s", "1"], ["-b", "1"], ["--bits", "16"], ["--signature", "s.sig"], ["--reference"],
                      ["-r", "61x40"], ["--crop", "0,0,61,40"]):
            self.assert_refused(BAD_SCENE, "render", self.scene, "-o", "a.png", "--journal", "j", "--resume", *words,
                                says=["j: a journal of another picture", "remove it"], ranks=(0,))
        other = self.write("other.toml", SCENE.replace("radius = 1", "radius = 1.0000001"))
        self.assert_refused(BAD_SCENE, "render", other, "-o", "a.png", "--journal", "j", "--resume",
                            says="the scene, the image options")

    def test_a_journal_is_not_lost_by_mistake(self):
        self.write("j", self.whole_journal())
        (self.folder / "whole").unlink()
        self.assert_refused(CANNOT_CREATE, "render", self.scene, "-o", "a.png", "--journal", "j", says="add --resume")
        notes = self.write("notes.txt", "not to be lost" * 10)
        self.assert_refused(BAD_SCENE, "render", self.scene, "-o", "a.png", "--journal", "notes.txt", "--resume",
                            says="no journal", ranks=(0,))
        self.assertEqual(notes.read_text(), "not to be lost" * 10)

    def test_wrong_command_lines(self):
        self.assert_refused(USAGE, "render", self.scene, "--resume", says="--journal FILE --resume")
        self.assert_refused(USAGE, "render", self.scene, "-o", "a.png", "--journal", "a.png", says="-o as well")
        self.assert_refused(CANNOT_CREATE, "render", self.scene, "--journal", "no/such/j", says="no/such/j", ranks=(0,))
        self.assert_refused(CANNOT_CREATE, "render", self.scene, "--journal", "/dev/null", says="/dev/null", ranks=(0,))

    def test_a_failed_start_leaves_no_journal(self):
        self.assert_refused(CANNOT_CREATE, "render", self.scene, "-o", "no/such/out.png", "--journal", "j", says="no/such")

    # killed runs

    def test_a_run_that_was_killed_resumes_to_the_same_file(self):
        picture = self.reference(*LARGE)
        for ranks in (0, 0, 2, 2):
            process = self.start("-o", "out.png", "--journal", "j", *LARGE, ranks=ranks)
            with self.subTest(ranks=ranks):
                self.assertTrue(self.wait_for_records(process, self.random.randrange(1, 1_000_000)), "ended too soon")
                time.sleep(self.random.uniform(0, 0.05))
                process.kill()
                process.communicate()
                self.wait_until_nobody_writes()
                self.assert_resumes(picture, *LARGE, ranks=self.random.choice((0, 1, 2)))

    # interrupted runs

    def interrupted(self, number, *words, ranks=0):
        """Sends a signal to rank 0 while it renders: exit code, seconds to the end, lines of the program's own."""
        process = self.start("-o", "out.png", *LARGE, *words, ranks=ranks)
        if "--journal" in words:
            self.assertTrue(self.wait_for_records(process), "ended too soon")
        else:
            while process.poll() is None and not (self.folder / "out.png.part").exists():
                time.sleep(0.005)
        self.assertIsNone(process.poll())
        os.kill(self.rank_zero(process.pid) if ranks else process.pid, number)
        start = time.monotonic()
        stderr = process.communicate(timeout=TIME_LIMIT_S)[1]
        return process.returncode, time.monotonic() - start, stderr

    def rank_zero(self, launcher):
        for status in pathlib.Path("/proc").glob("[0-9]*/status"):
            try:
                is_child = f"\nPPid:\t{launcher}\n" in status.read_text()
                if is_child and b"\0OMPI_COMM_WORLD_RANK=0\0" in (status.parent / "environ").read_bytes():
                    return int(status.parent.name)
            except OSError:
                pass
        self.fail("rank 0 is not there")

    def test_a_signal_ends_a_run_in_order(self):
        picture = self.reference(*LARGE)
        for number, says in ((signal.SIGINT, "interrupted (SIGINT)"), (signal.SIGTERM, "terminated (SIGTERM)")):
            for ranks in (0, 2):
                with self.subTest(signal=number.name, ranks=ranks):
                    code, seconds, stderr = self.interrupted(number, "--journal", "j", ranks=ranks)
                    self.assertEqual(code, 128 + number)
                    self.assertLess(seconds, 10)
                    self.assertIn(f"tessera: {says} j keeps what was rendered; add --resume to go on from it", stderr)
                    self.assertEqual({path.name for path in self.folder.iterdir()} - {"out.png", "stats.json"},
                                     {"scene.toml", "j"})
                    _, stats = self.assert_resumes(picture, *LARGE)
                    self.assertGreater(stats["resumed"]["pixels"], 0)
                    (self.folder / "out.png").unlink()
                    (self.folder / "stats.json").unlink()

    def test_without_a_journal_nothing_is_left(self):
        for number, ranks in ((signal.SIGINT, 0), (signal.SIGTERM, 0), (signal.SIGTERM, 2)):
            with self.subTest(signal=number.name, ranks=ranks):
                code, seconds, stderr = self.interrupted(number, ranks=ranks)
                self.assertEqual(code, 128 + number)
                self.assertLess(seconds, 10)
                self.assertIn("nothing is kept", stderr)
                self.assertEqual({path.name for path in self.folder.iterdir()}, {"scene.toml"})

    def test_a_launcher_that_is_told_to_end_lets_rank_0_put_things_in_order(self):
        process = self.start("-o", "out.png", "--journal", "j", "-r", "4000x4000", ranks=2)
        self.assertTrue(self.wait_for_records(process))
        process.terminate()
        process.communicate(timeout=TIME_LIMIT_S)
        self.assertEqual({path.name for path in self.folder.iterdir()}, {"scene.toml", "j"})

    def wait_until_nobody_writes(self):
        """Ranks notice only later that their mpirun was killed, and may even come to their end."""
        journal = self.folder / "j"
        limit = time.monotonic() + TIME_LIMIT_S
        while journal.exists() and time.monotonic() < limit:
            with open(journal, "rb") as file:
                try:
                    fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                    return
                except BlockingIOError:
                    time.sleep(0.05)


if __name__ == "__main__":
    running_program.main(__doc__)
