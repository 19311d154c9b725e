#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures what a journal costs.

Renders each scene with and without --journal in turn, so that whatever else the machine does hits both alike, checks
that the pictures are the same bytes, and prints medians, one line per scene.

  without, with  seconds from the start of the command to its end; starting MPI is not part of it
  spread         (max - min) / median
  cost           median over the rounds of with / without in the same round, less 1
  cpu            the same for the processor time of all ranks, which a busy machine disturbs less; waiting ranks take some
"""

import argparse
import json
import pathlib
import resource
import statistics
import subprocess
import sys

import interleaved

WITHOUT, WITH = [], ["--journal", "journal"]


def render(scene, extra, folder, options):
    """Seconds of one run and of its processors, and the picture's bytes."""
    launcher = ["mpirun", "-n", options.ranks] if options.ranks > 0 else []
    command = [*launcher, options.tessera, "render", scene, "-q", "-o", "picture.png", "--stats", "stats.json", *extra]
    if options.resolution:
        command += ["--resolution", options.resolution]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run = subprocess.run(list(map(str, command)), cwd=folder)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if run.returncode != 0:
        sys.exit(f"measure_journal: {scene}: exit code {run.returncode}")
    seconds = json.loads((folder / "stats.json").read_text())["time_s"]["total"]
    processors = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return (seconds, processors), (folder / "picture.png").read_bytes()


def compare(scene, options):
    """A row of the table, and all the different pictures."""
    ways = {"without": WITHOUT, "with": WITH}
    (without, with_journal), pictures = interleaved.measure(
        tuple(ways), options.repeat, lambda way, folder: render(scene, ways[way], folder, options))
    costs = [statistics.median(b[clock] / a[clock] for a, b in zip(without, with_journal)) - 1 for clock in (0, 1)]
    walls = [interleaved.cells([wall for wall, _ in runs]) for runs in (without, with_journal)]
    return [*walls[0], *walls[1], *(f"{cost:+.1%}" for cost in costs)], pictures


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    interleaved.add_arguments(parser)
    parser.add_argument("--tessera", default=interleaved.ROOT / "build/release/tessera", help="the program [%(default)s]")
    parser.add_argument("--ranks", type=int, default=2, metavar="N", help="0: without mpirun [%(default)s]")
    options = parser.parse_args(words)
    if options.repeat < 1 or options.ranks < 0:
        parser.error("--repeat must be at least 1, --ranks at least 0")
    return options


def main(words):
    options = parse(words)
    scenes = [pathlib.Path(scene).resolve() for scene in interleaved.scenes_of(options)]
    all_same = interleaved.table(("without", "spread", "with", "spread", "cost", "cpu"), scenes,
                                 lambda scene: compare(scene, options), cell_width=9)
    return 0 if all_same else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
