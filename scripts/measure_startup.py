#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures how long a large scene takes from opening its file to its first tile.

Writes a cloud of spheres into a temporary folder, as a binary table and as a Tachyon scene, renders both several times
and prints median seconds by phase, one line per file. The bars hold for a million spheres on two cores.

  read        parsing, checks and scaling, rank 0 alone
  broadcast   the scene to the other ranks
  build       the tree, by all ranks
  tile        from there to the end of the first tile
  first tile  all of these
  bar         what the first tile may take
  memory      the most that the ranks together take at any time, in a run of its own; shared memory counts once
"""

import argparse
import array
import csv
import json
import pathlib
import random
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
BARS = {"table.toml": 1.5, "tachyon.dat": 3.0}  # seconds
SCENE = """format = 1
[image]
width = 256
height = 256
transfer = "none"
[camera]
eye = [2.6, 1.9, 2.2]
target = [0, 0, 0]
[[light]]
position = [4, 3, 6]
[[spheres]]
file = "spheres.bin"
"""


def fail(message):
    sys.exit(f"measure_startup: {message}")


def write_scenes(folder, tessera, count):
    """A cloud as table.toml with spheres.bin, and as tachyon.dat."""
    uniform = random.Random(1).uniform
    largest = 0.6 / count ** (1 / 3)
    numbers = array.array("d")
    for _ in range(count):
        numbers.extend((uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(0.3, 1) * largest))
    if sys.byteorder == "big":
        numbers.byteswap()
    (folder / "spheres.bin").write_bytes(numbers.tobytes())
    (folder / "table.toml").write_text(SCENE)
    subprocess.run([tessera, "convert", folder / "table.toml", "-o", folder / "tachyon.dat"], check=True,
                   capture_output=True)


def command_of(scene, options):
    folder = scene.parent
    command = [options.tessera, "render", scene, "-q", "-o", folder / "picture.png", "--stats", folder / "stats.json",
               "--tile-stats", folder / "tiles.csv"]
    if options.ranks > 0:
        command = ["mpirun", "--oversubscribe", "-n", options.ranks, *command]
    return list(map(str, command))


def render(scene, options):
    """Seconds by phase of one run."""
    folder = scene.parent
    code = subprocess.run(command_of(scene, options)).returncode
    if code != 0:
        fail(f"{scene.name}: exit code {code}")
    seconds = json.loads((folder / "stats.json").read_text())["time_s"]
    with open(folder / "tiles.csv", newline="") as file:
        seconds["tile"] = min(float(row["end_s"]) for row in csv.DictReader(file))
    phases = [seconds[phase] for phase in ("read", "broadcast", "build", "tile")]
    return [*phases, sum(phases)]


def ranks_of(process):
    """The process itself, or what it has started."""
    pids = [process.pid]
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue  # it has just ended
        if int(words[1]) == process.pid:
            pids.append(int(folder.name))
    return pids[1:] or pids


def proportional_bytes(pid):
    """What a process has in memory, of what it shares its share."""
    try:
        for row in pathlib.Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines():
            if row.startswith("Pss:"):
                return 1024 * int(row.split()[1])
    except OSError:
        pass  # it has just ended
    return 0


def most_memory(scene, options):
    """Megabytes of all ranks together at the worst time."""
    process = subprocess.Popen(command_of(scene, options))
    most = 0
    while process.poll() is None:
        most = max(most, sum(map(proportional_bytes, ranks_of(process))))
        time.sleep(0.005)
    return most / 1e6


def line(cells):
    return cells[0].ljust(12) + "".join(f"  {cell:>10}" for cell in cells[1:])


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tessera", default=ROOT / "build/release/tessera", help="the program [%(default)s]")
    parser.add_argument("--spheres", type=int, default=1_000_000, metavar="N", help="[%(default)s]")
    parser.add_argument("--ranks", type=int, default=2, metavar="N", help="0: without mpirun [%(default)s]")
    parser.add_argument("--repeat", type=int, default=5, metavar="N", help="runs of each [%(default)s]")
    options = parser.parse_args(words)
    if options.spheres < 1 or options.repeat < 1 or options.ranks < 0:
        parser.error("--spheres and --repeat must be at least 1, --ranks at least 0")
    return options


def main(words):
    options = parse(words)
    within = True
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_scenes(folder, options.tessera, options.spheres)
        print(line(["file", "read", "broadcast", "build", "tile", "first tile", "bar", "memory"]))
        for scene, bar in BARS.items():
            runs = [render(folder / scene, options) for _ in range(options.repeat)]
            medians = [statistics.median(times) for times in zip(*runs)]
            within = within and medians[-1] <= bar
            memory = most_memory(scene, options)
            print(line([scene, *(f"{seconds:.3f} s" for seconds in medians), f"{bar:.1f} s", f"{memory:.0f} MB"]),
                  flush=True)
    return 0 if within else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
