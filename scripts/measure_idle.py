#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures what ranks cost that have nothing to do.

  idle ranks        one of three ranks renders a single tile, the others wait: their share of a core
  8 ranks, 2 cores  render time of 8 ranks on two cores as a multiple of that of 2 ranks, in turn

Each line ends with the bar, and the exit code is 1 where a median is above it. Linux only, for it reads /proc.
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import interleaved

IDLE_BAR = 0.05  # of a core
CROWD_BAR = 1.15
SETTLE = 1.5  # seconds from the start of mpirun until every rank is surely rendering or waiting
WINDOW = 2.0  # seconds that are measured
MPIRUN = ["mpirun", "--bind-to", "none", "--oversubscribe"]
TICK = os.sysconf("SC_CLK_TCK")


def fail(message):
    sys.exit(f"measure_idle: {message}")


def children(pid):
    return [int(child) for child in pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def cpu_seconds(pid):
    """User and system time of a process and all its threads."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / TICK


def shares_of_core(options, folder):
    """What the ranks of a render take while one of them renders all of it, the least first."""
    command = [*MPIRUN, "-n", "3", options.tessera, "render", options.scene, "-q", "-r", options.large, "--tile-size",
               "100000", "--master", "dedicated", "-o", folder / "picture.ppm"]
    process = subprocess.Popen(list(map(str, command)))
    try:
        time.sleep(SETTLE)
        ranks = children(process.pid)
        before = [cpu_seconds(rank) for rank in ranks]
        start = time.monotonic()
        time.sleep(WINDOW)
        if process.poll() is not None:
            fail("the picture was ready too soon, use a larger one (--large)")
        return sorted((cpu_seconds(rank) - cpu) / (time.monotonic() - start) for rank, cpu in zip(ranks, before))
    finally:
        process.terminate()
        process.wait()


def render(ranks, folder, options):
    """Seconds of a render on two cores, and its picture."""
    cores = ",".join(map(str, sorted(os.sched_getaffinity(0))[:2]))
    command = ["taskset", "-c", cores, *MPIRUN, "-n", ranks, options.tessera, "render", options.scene, "-q", "-r",
               options.resolution, "-o", folder / "picture.ppm", "--stats", folder / "stats.json"]
    subprocess.run(list(map(str, command)), check=True)
    return json.loads((folder / "stats.json").read_text())["time_s"]["render"], (folder / "picture.ppm").read_bytes()


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tessera", default=interleaved.ROOT / "build/release/tessera", help="the program [%(default)s]")
    parser.add_argument("--scene", default=interleaved.ROOT / "scenes/sphereflake.toml", help="[%(default)s]")
    parser.add_argument("--resolution", default="2048x2048", metavar="WxH", help="of the two in turn [%(default)s]")
    parser.add_argument("--large", default="8192x8192", metavar="WxH", help="of the single tile [%(default)s]")
    parser.add_argument("--repeat", type=int, default=5, metavar="N", help="runs of each [%(default)s]")
    options = parser.parse_args(words)
    if options.repeat < 1:
        parser.error("--repeat must be at least 1")
    return options


def line(name, values, bar):
    """Prints a line; returns whether the median is within the bar."""
    median = statistics.median(values)
    print(f"{name:<17}  {median:6.3f}  {min(values):.3f} ... {max(values):.3f}   bar {bar:.2f}", flush=True)
    return median <= bar


def main(words):
    options = parse(words)
    with tempfile.TemporaryDirectory() as folder:
        shares = [shares_of_core(options, pathlib.Path(folder)) for _ in range(options.repeat)]
    within = line("idle ranks", [max(run[:-1]) for run in shares], IDLE_BAR)
    (few, many), pictures = interleaved.measure(
        (2, 8), options.repeat, lambda ranks, folder: render(ranks, folder, options))
    within = line("8 ranks, 2 cores", [b / a for a, b in zip(few, many)], CROWD_BAR) and within
    if len(pictures) != 1:
        fail("the pictures differ")
    return 0 if within else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
