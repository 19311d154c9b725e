#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A job over several hosts: the same picture, also where a rank dies or stops. Run by scripts/test_multihost.sh, which
makes the hosts."""

import shlex
import signal

import running_program
from harmed_run import FIRST_MOMENT_S, HarmedRunTest


class MultihostTest(HarmedRunTest):
    def setUp(self):
        self.launcher = shlex.split(self.mpirun)
        super().setUp()

    def test_picture_is_the_same(self):
        stats = self.render_while(lambda ranks: None)
        self.assertEqual(stats["mpi"]["nodes"], 3)
        self.assertEqual({rank["host"] for rank in stats["ranks"]}, {"tessera-1", "tessera-2", "tessera-3"})
        self.assertEqual(stats["faults"]["lost"], [])

    def test_killed_worker_on_another_host(self):
        stats = self.render_while(lambda ranks: self.signal_at(ranks[3], FIRST_MOMENT_S, signal.SIGKILL))
        self.assertEqual(stats["faults"]["lost"], [3])

    def test_stopped_worker_on_another_host(self):
        # Its neighbour on the host ends it.
        stats = self.render_while(lambda ranks: self.signal_at(ranks[1], FIRST_MOMENT_S, signal.SIGSTOP))
        self.assertEqual(stats["faults"]["lost"], [1])


if __name__ == "__main__":
    running_program.main(__doc__, mpirun="the launcher with its options, as a shell would split it")
