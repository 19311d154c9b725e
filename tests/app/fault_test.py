#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Workers that are killed, stopped, or stopped for a while, at random moments of a render: the picture is the same file
and the job ends as if nothing had been."""

import os
import random
import signal
import time

import running_program
from harmed_run import FIRST_MOMENT_S, LAST_MOMENT_S, LEASE_S, HarmedRunTest


class FaultTest(HarmedRunTest):
    def harm_at_random_moments(self, number):
        for seed in range(int(self.rounds)):
            chance = random.Random(seed)
            victim = chance.randrange(1, self.ranks)
            moment = chance.uniform(FIRST_MOMENT_S, LAST_MOMENT_S)
            with self.subTest(victim=victim, moment=moment):
                stats = self.render_while(lambda ranks: self.signal_at(ranks[victim], moment, number))
                self.assertEqual(stats["faults"]["lost"], [victim])

    def test_killed_worker(self):
        self.harm_at_random_moments(signal.SIGKILL)

    def test_stopped_worker(self):
        self.harm_at_random_moments(signal.SIGSTOP)

    def test_worker_that_comes_back(self):
        def stall(ranks):
            self.signal_at(ranks[1], FIRST_MOMENT_S, signal.SIGSTOP)
            time.sleep(2 * LEASE_S)
            os.kill(ranks[1], signal.SIGCONT)

        stats = self.render_while(stall)
        self.assertEqual(stats["faults"]["lost"], [])
        self.assertGreaterEqual(stats["faults"]["silences"], 1)

    def test_all_workers_killed(self):
        def kill_all(ranks):
            for rank in range(1, self.ranks):
                self.signal_at(ranks[rank], FIRST_MOMENT_S, signal.SIGKILL)

        for master in ("auto", "dedicated"):
            with self.subTest(master=master):
                stats = self.render_while(kill_all, "--master", master)
                self.assertEqual(sorted(stats["faults"]["lost"]), list(range(1, self.ranks)))

    def test_owned_tiles_of_a_killed_worker(self):
        for schedule in ("static-bands", "cyclic-rows", "guided"):
            with self.subTest(schedule=schedule):
                stats = self.render_while(lambda ranks: self.signal_at(ranks[2], FIRST_MOMENT_S, signal.SIGKILL),
                                          "--schedule", schedule)
                self.assertEqual(stats["faults"]["lost"], [2])
                self.assertGreater(stats["faults"]["reissued"], 0)


if __name__ == "__main__":
    running_program.main(__doc__, rounds="how many workers to kill, and how many to stop")
