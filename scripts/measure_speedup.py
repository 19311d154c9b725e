#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures how much faster several ranks are than one, for the whole job but reading the scene.

Renders each scene on one rank and on several in turn, so that whatever else the machine does hits both alike, checks
that the pictures are the same bytes, and prints medians, one line per scene.

  T1, Tn      seconds from the start of the command to its end, without reading; starting MPI is not part of it
  spread      (max - min) / median
  speed-up    median over the rounds of T1 / Tn in the same round
  broadcast   the scene to the other ranks, seconds
  build, render, write   speed-up of each phase; with several ranks most of the picture is packed while it is rendered
"""

import argparse
import json
import statistics
import subprocess
import sys

import interleaved

PHASES = ("build", "render", "write")


def fail(message):
    sys.exit(f"measure_speedup: {message}")


def render(scene, ranks, folder, options):
    """Seconds by phase of one run, "job" among them, and the picture's bytes."""
    picture = folder / "picture.png"
    command = ["mpirun", "-n", ranks, options.tessera, "render", scene, "-q", "-o", picture, "--stats",
               folder / "stats.json"]
    if options.resolution:
        command += ["--resolution", options.resolution]
    run = subprocess.run(list(map(str, command)))
    if run.returncode != 0:
        fail(f"{scene}, {ranks} ranks: exit code {run.returncode}")
    seconds = json.loads((folder / "stats.json").read_text())["time_s"]
    seconds["job"] = seconds["total"] - seconds["read"]
    return seconds, picture.read_bytes()


def speed_up(one, many, phase):
    return statistics.median(a[phase] / b[phase] if b[phase] > 0 else 1 for a, b in zip(one, many))


def compare(scene, options):
    """A row of the table, and all the different pictures."""
    (one, many), pictures = interleaved.measure(
        (1, options.ranks), options.repeat, lambda ranks, folder: render(scene, ranks, folder, options))
    jobs = [interleaved.cells([seconds["job"] for seconds in runs]) for runs in (one, many)]
    broadcast = statistics.median(seconds["broadcast"] for seconds in many)
    return [*jobs[0], *jobs[1], f"{speed_up(one, many, 'job'):.2f}", f"{broadcast:.3f} s",
            *(f"{speed_up(one, many, phase):.2f}" for phase in PHASES)], pictures


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    interleaved.add_arguments(parser)
    parser.add_argument("--tessera", default=interleaved.ROOT / "build/release/tessera", help="the program [%(default)s]")
    parser.add_argument("--ranks", type=int, default=2, metavar="N", help="[%(default)s]")
    options = parser.parse_args(words)
    if options.repeat < 1 or options.ranks < 2:
        parser.error("--repeat must be at least 1, --ranks at least 2")
    return options


def main(words):
    options = parse(words)
    header = ("T1", "spread", f"T{options.ranks}", "spread", "speed-up", "broadcast", *PHASES)
    all_same = interleaved.table(header, interleaved.scenes_of(options), lambda scene: compare(scene, options),
                                 cell_width=9)
    return 0 if all_same else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
