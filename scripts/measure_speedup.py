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
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
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


def measure(scene, options):
    """The phases' seconds of all runs on one rank and on several, and all the different pictures they gave."""
    times = {1: [], options.ranks: []}
    pictures = set()
    with tempfile.TemporaryDirectory() as folder:
        for round_number in range(options.repeat):
            # Who goes first changes: the second of a pair may find the machine warmer.
            for ranks in list(times)[:: 1 if round_number % 2 == 0 else -1]:
                seconds, picture = render(scene, ranks, pathlib.Path(folder), options)
                times[ranks].append(seconds)
                pictures.add(picture)
    return times[1], times[options.ranks], pictures


def speed_up(one, many, phase):
    return statistics.median(a[phase] / b[phase] if b[phase] > 0 else 1 for a, b in zip(one, many))


def row(scene, one, many, pictures):
    def cells(runs):
        jobs = [seconds["job"] for seconds in runs]
        median = statistics.median(jobs)
        return f"{median:.3f} s", f"{(max(jobs) - min(jobs)) / median:.0%}"

    return [pathlib.Path(scene).stem, *cells(one), *cells(many), f"{speed_up(one, many, 'job'):.2f}",
            f"{statistics.median(seconds['broadcast'] for seconds in many):.3f} s",
            *(f"{speed_up(one, many, phase):.2f}" for phase in PHASES), "same" if len(pictures) == 1 else "OTHER"]


def line(cells, width):
    return cells[0].ljust(width) + "".join(f"  {cell:>9}" for cell in cells[1:])


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="default: all of scenes/")
    parser.add_argument("--tessera", default=ROOT / "build/release/tessera", help="the program [%(default)s]")
    parser.add_argument("--ranks", type=int, default=2, metavar="N", help="[%(default)s]")
    parser.add_argument("--repeat", type=int, default=7, metavar="N", help="rounds [%(default)s]")
    parser.add_argument("--resolution", metavar="WxH", help="instead of the scene's own")
    options = parser.parse_args(words)
    if options.repeat < 1 or options.ranks < 2:
        parser.error("--repeat must be at least 1, --ranks at least 2")
    options.scenes = options.scenes or sorted((ROOT / "scenes").glob("*.toml"))
    return options


def main(words):
    options = parse(words)
    width = max(len(pathlib.Path(scene).stem) for scene in options.scenes)
    print(line(["scene", "T1", "spread", f"T{options.ranks}", "spread", "speed-up", "broadcast", *PHASES, "picture"],
               width))
    all_same = True
    for scene in options.scenes:
        one, many, pictures = measure(scene, options)
        all_same = all_same and len(pictures) == 1
        print(line(row(scene, one, many, pictures), width), flush=True)
    return 0 if all_same else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
