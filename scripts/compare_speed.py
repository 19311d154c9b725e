#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the speed of two builds of tessera on one core.

Renders every scene with A and B in turn, several rounds over, so that whatever else the machine does hits both alike,
and prints one line per scene. Trust the last columns rather than the seconds.

  A, B      median user seconds, and how far the runs spread: (max - min) / median
  B/A       median over the rounds of B's time / A's time in the same round
  picture   whether all pictures are the same bytes
"""

import argparse
import os
import statistics
import subprocess
import sys

import interleaved


def fail(message):
    sys.exit(f"compare_speed: {message}")


def render(tessera, scene, picture, options):
    """Renders once and returns (user seconds, picture bytes)."""
    command = [tessera, "render", scene, "-q", "-o", picture]
    if options.resolution:
        command += ["--resolution", options.resolution]
    if options.kernel:
        command += ["--kernel", options.kernel]
    try:
        process = subprocess.Popen(list(map(str, command)))
    except OSError as error:
        fail(f"{tessera}: {error.strerror}")
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        fail(f"{tessera}, {scene}: exit code {process.returncode}")
    return usage.ru_utime, picture.read_bytes()


def compare(scene, options):
    """A row of the table, and all the different pictures."""
    (a, b), pictures = interleaved.measure(
        (options.a, options.b), options.repeat,
        lambda tessera, folder: render(tessera, scene, folder / "picture.png", options))
    ratio = statistics.median(second / first for first, second in zip(a, b))
    return [*interleaved.cells(a), *interleaved.cells(b), f"{ratio:.3f}"], pictures


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("a", metavar="A", help="the program to compare with")
    parser.add_argument("b", metavar="B", help="the program to compare")
    interleaved.add_arguments(parser)
    parser.add_argument("--kernel", help="instead of the programs' default")
    options = parser.parse_args(words)
    if options.repeat < 1:
        parser.error("--repeat must be at least 1")
    if os.path.realpath(options.a) == os.path.realpath(options.b):
        parser.error("A and B are the same file")
    return options


def main(words):
    options = parse(words)
    all_same = interleaved.table(("A", "spread", "B", "spread", "B/A"), interleaved.scenes_of(options),
                                 lambda scene: compare(scene, options), cell_width=7)
    return 0 if all_same else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
