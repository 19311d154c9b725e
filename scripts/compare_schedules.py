#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares ways to share a picture out among ranks: static bands, cyclic rows, tiles on demand, guided, factoring,
trapezoid, and tiles cut to what an earlier run found.

Runs every schedule in turn, several times over, checks that all pictures are the same bytes, and prints one table per
scene; the same numbers go to compare_schedules.csv in the output folder.

  makespan    median render time in seconds, and how far the runs spread: (max - min) / median
  speed-up    static bands' makespan / this makespan
  efficiency  sum of busy time / (ranks x makespan), rank 0 counted
  parallel    T1 / (ranks x makespan), T1 the same program on one rank: busy time alone can hide a slower kernel
  imbalance   longest busy time / mean busy time - 1
  tail        first rank idle for good -> last result
"""

import argparse
import csv
import dataclasses
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
DEFAULT_SCENES = [ROOT / "scenes" / name for name in ("corner_cluster.toml", "empty_top.toml", "uniform_cloud.toml")]
BUILDS = [ROOT / "build" / preset / "tessera" for preset in ("release", "demo")]
UNTILED = {"static-bands", "cyclic-rows"}  # these cut the picture themselves
ALL = "static-bands,cyclic-rows,dynamic,self,guided,factoring,trapezoid"


@dataclasses.dataclass(frozen=True)
class Variant:
    """One way to render: a schedule and, where it has one, a tile size; "costs" is one that cuts to an earlier run."""

    schedule: str
    tile_size: str  # "" for a schedule that cuts the picture itself

    def options(self):
        if self.tile_size == "costs":
            return ["--schedule", self.schedule, "--costs", COSTS]
        return ["--schedule", self.schedule] + (["--tile-size", self.tile_size] if self.tile_size else [])

    def __str__(self):
        return f"{self.schedule} {self.tile_size}".strip()


ONE_RANK = Variant("dynamic", "16")
COSTS = "costs.csv"  # what the first run on one rank found


def fail(message):
    sys.exit(f"compare_schedules: {message}")


def variants_of(schedules, tile_sizes):
    """Each schedule with each tile size, or once where the size does not matter."""
    variants = [Variant(schedule, size) for schedule in schedules
                for size in ([""] if schedule in UNTILED else tile_sizes)]
    return list(dict.fromkeys(variants))


def render(tessera, scene, variant, ranks, resolution, folder):
    """Renders once and returns (statistics, picture bytes)."""
    picture, stats = folder / "picture.ppm", folder / "stats.json"
    command = ["mpirun", "-n", str(ranks), "--oversubscribe", os.path.abspath(tessera), "render", os.path.abspath(scene),
               "-q", "-o", picture, "--stats", stats, *variant.options()]
    if variant is ONE_RANK:
        command += ["--tile-stats", COSTS]
    if resolution:
        command += ["--resolution", resolution]
    environment = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    try:
        run = subprocess.run(list(map(str, command)), cwd=folder, env=environment, capture_output=True, text=True,
                             check=False)
    except FileNotFoundError:
        fail("mpirun is not installed (Debian package openmpi-bin)")
    if run.returncode != 0:
        ours = [line for line in run.stderr.splitlines() if line.startswith("tessera:")]
        fail(f"{scene}, {variant}: exit code {run.returncode}\n" + ("\n".join(ours) or run.stderr.strip()))
    return json.loads(stats.read_text()), picture.read_bytes()


def measure(tessera, scene, variants, ranks, repeat, resolution):
    """Statistics of every run, {variant: [statistics]}, and the one-rank times; the runs are interleaved."""
    runs = {variant: [] for variant in variants}
    one_rank = []
    reference = None
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for _ in range(repeat):
            for variant, count in [(ONE_RANK, 1)] + [(variant, ranks) for variant in variants]:
                stats, picture = render(tessera, scene, variant, count, resolution, folder)
                reference = reference or picture
                if picture != reference:
                    fail(f"{scene}: {variant} on {count} ranks gave another picture")
                if count == 1 and variant is ONE_RANK:
                    one_rank.append(stats["time_s"]["render"])
                else:
                    runs[variant].append(stats)
    return runs, one_rank


def summarize(scene, ranks, runs, one_rank):
    """One row per variant, medians over its runs."""
    makespans = {variant: statistics.median(s["balance"]["makespan_s"] for s in stats) for variant, stats in runs.items()}
    bands = next((makespans[variant] for variant in runs if variant.schedule == "static-bands"), None)
    alone = statistics.median(one_rank)
    rows = []
    for variant, stats in runs.items():
        def median(key, stats=stats):
            return statistics.median(s["balance"][key] for s in stats)

        times = [s["balance"]["makespan_s"] for s in stats]
        makespan = makespans[variant]
        rows.append({
            "scene": pathlib.Path(scene).stem,
            "ranks": ranks,
            "schedule": variant.schedule,
            "tile_size": variant.tile_size,
            "runs": len(stats),
            "makespan_s": makespan,
            "spread": (max(times) - min(times)) / makespan,
            "speed_up": bands / makespan if bands else None,
            "efficiency": median("efficiency"),
            "parallel_efficiency": alone / (ranks * makespan),
            "imbalance": median("imbalance"),
            "tail_s": median("tail_s"),
            "messages": statistics.median(s["messages"]["count"] for s in stats),
            "bytes": statistics.median(s["messages"]["bytes"] for s in stats),
        })
    return rows


def table(rows):
    """The rows as text, right-aligned columns under their names."""
    def cells(row):
        speed_up = f"{row['speed_up']:.2f}x" if row["speed_up"] else ""
        return [row["schedule"], row["tile_size"], f"{row['makespan_s']:.3f} s", f"{row['spread']:.1%}", speed_up,
                f"{row['efficiency']:.1%}", f"{row['parallel_efficiency']:.1%}", f"{row['imbalance']:.1%}",
                f"{1e3 * row['tail_s']:.1f} ms", f"{row['messages']:.0f}", f"{row['bytes'] / 1e6:.2f} MB"]

    head = ["schedule", "tile", "makespan", "spread", "speed-up", "efficiency", "parallel", "imbalance", "tail",
            "messages", "traffic"]
    lines = [head] + [cells(row) for row in rows]
    widths = [max(len(line[column]) for line in lines) for column in range(len(head))]
    return "\n".join("  ".join([line[0].ljust(widths[0])] + [cell.rjust(width) for cell, width in
                                                             zip(line[1:], widths[1:])]).rstrip() for line in lines)


def write_csv(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", default=DEFAULT_SCENES, metavar="SCENE", help="default: three of scenes/")
    parser.add_argument("--ranks", type=int, default=2, help="ranks to start [%(default)s]")
    parser.add_argument("--tile-size", default="16,32,auto,costs",
                        help="tile sizes, with commas between; costs: cut to what one rank found [%(default)s]")
    parser.add_argument("--schedules", default="static-bands,cyclic-rows,dynamic", help=f"some of {ALL} [%(default)s]")
    parser.add_argument("--repeat", type=int, default=3, help="runs of each [%(default)s]")
    parser.add_argument("--resolution", metavar="WxH", help="instead of the scene's own")
    parser.add_argument("--tessera", default=next(filter(pathlib.Path.exists, BUILDS), BUILDS[0]), metavar="PATH",
                        help="the program [%(default)s]")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("out/compare_schedules"), metavar="DIR",
                        help="folder for the CSV [%(default)s]")
    options = parser.parse_args(words)
    if not all(options.tile_size.split(",")) or not all(options.schedules.split(",")):
        parser.error("--tile-size and --schedules are lists with commas between, and no empty entry")
    if options.ranks < 1 or options.repeat < 1:
        parser.error("--ranks and --repeat must be at least 1")
    return options


def main(words):
    options = parse(words)
    if not os.path.isfile(options.tessera):
        fail(f"{options.tessera} is not there; build it with scripts/demo.sh or name it with --tessera")
    cores = len(os.sched_getaffinity(0))
    if options.ranks > cores:
        print(f"note: {options.ranks} ranks share {cores} cores here; these times say little about {options.ranks} cores")
    variants = variants_of(options.schedules.split(","), options.tile_size.split(","))
    options.output.mkdir(parents=True, exist_ok=True)
    rows = []
    for scene in options.scenes:
        runs, one_rank = measure(options.tessera, scene, variants, options.ranks, options.repeat, options.resolution)
        of_scene = summarize(scene, options.ranks, runs, one_rank)
        rows += of_scene
        print(f"\n{pathlib.Path(scene).stem}, {options.ranks} ranks, {options.repeat} runs each; "
              f"one rank: {statistics.median(one_rank):.3f} s")
        print(table(of_scene), flush=True)
    write_csv(options.output / "compare_schedules.csv", rows)
    print(f"\nall pictures of a scene are the same bytes; numbers in {options.output / 'compare_schedules.csv'}")


if __name__ == "__main__":
    main(sys.argv[1:])
