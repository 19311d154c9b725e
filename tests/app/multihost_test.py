#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A job over several hosts under tessera-run: the same picture, also where a rank or a whole host is lost. Run by
scripts/test_multihost.sh, which makes the hosts."""

import os
import pathlib
import signal

import running_program
from harmed_run import FIRST_MOMENT_S, HarmedRunTest

RUN = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "tessera-run"


def parent_of(process):
    fields = pathlib.Path(f"/proc/{process}/stat").read_text(encoding="ascii").rsplit(")", 1)[1].split()
    return int(fields[1])


def daemon_of(process):
    """What mpirun started on the host of a rank."""
    while pathlib.Path(f"/proc/{process}/comm").read_text(encoding="ascii").strip() != "orted":
        process = parent_of(process)
    return process


class MultihostTest(HarmedRunTest):
    def launch(self):
        return [str(RUN), "--mpirun", self.mpirun, "--tessera", self.tessera, "-n", str(self.ranks), "--"]

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

    def test_killed_daemon(self):
        def kill_host(ranks):
            daemon = daemon_of(ranks[3])
            self.signal_at(ranks[3], FIRST_MOMENT_S, 0)
            os.kill(daemon, signal.SIGKILL)

        self.render_while(kill_host)


if __name__ == "__main__":
    running_program.main(__doc__, mpirun="the launcher, for the hosts")
