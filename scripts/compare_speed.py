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
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


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


def measure(scene, options):
    """User seconds of A's and of B's runs, and all the different pictures they gave."""
    times = {options.a: [], options.b: []}
    pictures = set()
    with tempfile.TemporaryDirectory() as folder:
        for round_number in range(options.repeat):
            # Who goes first changes: the second of a pair may find the machine warmer.
            for tessera in list(times)[:: 1 if round_number % 2 == 0 else -1]:
                seconds, picture = render(tessera, scene, pathlib.Path(folder) / "picture.png", options)
                times[tessera].append(seconds)
                pictures.add(picture)
    return times[options.a], times[options.b], pictures


def row(scene, a, b, pictures):
    def cells(times):
        median = statistics.median(times)
        return f"{median:.3f} s", f"{(max(times) - min(times)) / median:.0%}"

    ratio = statistics.median(second / first for first, second in zip(a, b))
    return [pathlib.Path(scene).stem, *cells(a), *cells(b), f"{ratio:.3f}", "same" if len(pictures) == 1 else "OTHER"]


def line(cells, width):
    return cells[0].ljust(width) + "".join(f"  {cell:>7}" for cell in cells[1:])


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("a", metavar="A", help="the program to compare with")
    parser.add_argument("b", metavar="B", help="the program to compare")
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="default: all of scenes/")
    parser.add_argument("--repeat", type=int, default=7, metavar="N", help="rounds [%(default)s]")
    parser.add_argument("--resolution", metavar="WxH", help="instead of the scene's own")
    parser.add_argument("--kernel", help="instead of the programs' default")
    options = parser.parse_args(words)
    if options.repeat < 1:
        parser.error("--repeat must be at least 1")
    if os.path.realpath(options.a) == os.path.realpath(options.b):
        parser.error("A and B are the same file")
    options.scenes = options.scenes or sorted((ROOT / "scenes").glob("*.toml"))
    return options


def main(words):
    options = parse(words)
    width = max(len(pathlib.Path(scene).stem) for scene in options.scenes)
    print(line(["scene", "A", "spread", "B", "spread", "B/A", "picture"], width))
    all_same = True
    for scene in options.scenes:
        a, b, pictures = measure(scene, options)
        all_same = all_same and len(pictures) == 1
        print(line(row(scene, a, b, pictures), width), flush=True)
    return 0 if all_same else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
