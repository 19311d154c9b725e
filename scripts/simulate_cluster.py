#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Simulates how tessera's ranks share work on clusters of many nodes, on this machine.

The program's own master, workers, policies and messages run on ranks and networks of SimGrid's
(scripts/install_packages.sh simulate, cmake --preset simulation); a tile takes the time that it took in a recorded run, or a given time. Every combination of the
lists is simulated; the same call gives the same numbers.

  simulate_cluster.py --ranks 16,64,256 --costs costs.csv    (tessera render SCENE --tile-stats costs.csv)
  simulate_cluster.py --ranks 448 --uniform 1ms --tiles-per-rank 200
  simulate_cluster.py --validate scenes/corner_cluster.toml  (two real ranks beside two simulated ones)

Prints a table, and writes simulate_cluster.csv and, where matplotlib is installed, simulate_cluster.png to --output.

  x           W / (P^2 o): the whole work over ranks^2 times rank 0's time for a message
  makespan    start of rank 0 -> last tile there, in simulated seconds
  efficiency  sum of busy time / (ranks x makespan), rank 0 counted
  imbalance   longest busy time / mean busy time - 1
  tail        first rank idle for good -> last tile there
"""

import argparse
import csv
import itertools
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SIMULATORS = [ROOT / "build" / preset / "tessera_simulate" for preset in ("simulation", "release")]
PROGRAMS = [ROOT / "build" / preset / "tessera" for preset in ("release", "demo", "simulation")]
SECONDS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
BYTES = {"kB/s": 1e3, "MB/s": 1e6, "GB/s": 1e9, "Mbit/s": 1e6 / 8, "Gbit/s": 1e9 / 8}
ALLOWED = 0.05  # how far a simulation may be from the run that it repeats
COLUMNS = ["schedule", "work", "latency", "ranks", "tiles", "x", "makespan_s", "efficiency", "imbalance", "tail_s",
           "messages", "traffic_bytes"]


def fail(message):
    sys.exit(f"simulate_cluster: {message}")


def quantity(text, units):
    """The number before one of the units: "10ms" is 0.01 with SECONDS."""
    for unit in sorted(units, key=len, reverse=True):
        if text.endswith(unit):
            try:
                return float(text[:-len(unit)]) * units[unit]
            except ValueError:
                break
    fail(f'"{text}" is not a number with a unit ({", ".join(units)})')


def seconds(text):
    return quantity(text, SECONDS)


def shown(value):
    """A time for a person."""
    for unit in ("s", "ms", "us"):
        if value >= SECONDS[unit]:
            return f"{value / SECONDS[unit]:.4g} {unit}"
    return f"{value / SECONDS['ns']:.4g} ns"


def run(command, problem):
    """Standard output of a command that must succeed."""
    environment = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    try:
        done = subprocess.run(list(map(str, command)), env=environment, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        fail(f"{command[0]} is not installed")
    if done.returncode != 0:
        fail(f"{problem}: exit code {done.returncode}\n{done.stderr.strip()}")
    return done.stdout


def first_built(candidates, what):
    for path in candidates:
        if path.is_file():
            return path
    fail(f"{what} is not built (looked for {', '.join(str(path.relative_to(ROOT)) for path in candidates)})")


def simulate(options, schedule, ranks, latency_s, work):
    """Statistics of one simulated run, in the keys of tessera render --stats; `work` are the options that say what is
    to be done."""
    command = [options.simulate, "--ranks", ranks, "--schedule", schedule, "--latency", latency_s,
               "--bandwidth", quantity(options.bandwidth, BYTES), "--master-cost", seconds(options.master_cost),
               "--tile-size", options.tile_size, "--master", options.master, *work]
    command += ["--prefetch", options.prefetch] if options.prefetch else []
    command += ["--known-costs"] if options.known_costs else []
    command += ["--resolution", options.resolution] if options.resolution else []
    return json.loads(run(command, f"{schedule} on {ranks} ranks"))


def row_of(options, schedule, work, latency, stats):
    """One line of the table."""
    balance, ranks = stats["balance"], stats["mpi"]["size"]
    work_s = sum(rank["busy_s"] for rank in stats["ranks"])
    return {"schedule": schedule, "work": work, "latency": latency, "ranks": ranks, "tiles": stats["schedule"]["tiles"],
            "x": work_s / (ranks**2 * seconds(options.master_cost)), "makespan_s": balance["makespan_s"],
            "efficiency": balance["efficiency"], "imbalance": balance["imbalance"], "tail_s": balance["tail_s"],
            "messages": stats["messages"]["count"], "traffic_bytes": stats["messages"]["bytes"]}


def works(options):
    """What is to be simulated: (name, options of the simulator for so many ranks)."""
    if options.costs:
        return [(pathlib.Path(options.costs).stem, lambda ranks: ["--costs", options.costs])]

    def even(time):
        return lambda ranks: ["--tiles", ranks * options.tiles_per_rank, "--tile-time", seconds(time),
                              "--tile-spread", options.uneven]
    return [(time, even(time)) for time in options.uniform.split(",")]


HEADER = f"{'schedule':13}{'work':>14}{'latency':>9}{'ranks':>7}{'tiles':>9}{'x':>9}{'makespan':>11}" \
         f"{'efficiency':>12}{'imbalance':>11}{'tail':>11}{'messages':>10}"


def line(row):
    return f"{row['schedule']:13}{row['work']:>14.14}{row['latency']:>9}{row['ranks']:>7}{row['tiles']:>9}" \
           f"{row['x']:>9.3g}{shown(row['makespan_s']):>11}{row['efficiency']:>12.1%}{row['imbalance']:>11.1%}" \
           f"{shown(row['tail_s']):>11}{row['messages']:>10}"


def plot(rows, path):
    """Efficiency over ranks, a curve for each schedule, work and latency."""
    try:
        import matplotlib
    except ImportError:
        print("no plot: install python3-matplotlib", file=sys.stderr)
        return
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
    curve = lambda row: (row["schedule"], row["work"], row["latency"])
    for key, points in itertools.groupby(sorted(rows, key=lambda row: (curve(row), row["ranks"])), key=curve):
        points = list(points)
        axes.plot([row["ranks"] for row in points], [100 * row["efficiency"] for row in points], marker="o",
                  label=", ".join(key))
    axes.set_xscale("log", base=2)
    axes.set_ylim(0, 100)
    axes.set_xlabel("ranks, rank 0 counted")
    axes.set_ylabel("efficiency, %")
    axes.grid(alpha=0.3)
    axes.legend()
    figure.savefig(path, dpi=120)
    plt.close(figure)


def simulate_all(options):
    rows = []
    print(HEADER)
    for (work, work_options), latency, schedule in itertools.product(
            works(options), options.latency.split(","), options.schedule.split(",")):
        for ranks in map(int, options.ranks.split(",")):
            stats = simulate(options, schedule, ranks, seconds(latency), work_options(ranks))
            rows.append(row_of(options, schedule, work, latency, stats))
            print(line(rows[-1]), flush=True)
    options.output.mkdir(parents=True, exist_ok=True)
    with open(options.output / "simulate_cluster.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    plot(rows, options.output / "simulate_cluster.png")


def validate(options):
    """Renders on two real ranks, repeats the fastest run of each schedule in simulation, and prints both."""
    tessera = options.tessera or first_built(PROGRAMS, "tessera")
    far = 0
    print(f"{'schedule':14}{'':12}{'makespan':>11}{'efficiency':>12}")
    for schedule in options.schedule.split(","):
        with tempfile.TemporaryDirectory() as folder:
            stats_file, costs = pathlib.Path(folder, "stats.json"), pathlib.Path(folder, "costs.csv")
            least_disturbed = pathlib.Path(folder, "least_disturbed.csv")
            command = ["mpirun", "-n", 2, "--oversubscribe", tessera, "render", options.validate, "-q",
                       "-o", pathlib.Path(folder, "picture.ppm"), "--stats", stats_file, "--tile-stats", costs,
                       "--tile-size", options.tile_size, "--schedule", schedule, "--master", options.master]
            command += ["--resolution", options.resolution] if options.resolution else []
            command += ["--prefetch", options.prefetch] if options.prefetch else []
            real = None
            for _ in range(options.repeat):
                run(command, f"{options.validate}, {schedule}")
                balance = json.loads(stats_file.read_text(encoding="utf-8"))["balance"]
                if real is None or balance["makespan_s"] < real["makespan_s"]:
                    real = balance
                    costs.replace(least_disturbed)
            simulated = simulate(options, schedule, 2, seconds(options.latency.split(",")[0]),
                                 ["--costs", least_disturbed])["balance"]
        for name, balance in (("real", real), ("simulated", simulated)):
            print(f"{schedule:14}{name:12}{shown(balance['makespan_s']):>11}{balance['efficiency']:>12.2%}")
        apart = [simulated[key] / real[key] - 1 for key in ("makespan_s", "efficiency")]
        print(f"{'':14}{'apart':12}{apart[0]:>+11.2%}{apart[1]:>+12.2%}")
        far += max(map(abs, apart)) > ALLOWED
    if far:
        fail(f"{far} of the simulations are more than {ALLOWED:.0%} from their runs")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ranks", default="16,64,256", help="list of rank counts [16,64,256]")
    parser.add_argument("--latency", default="1us", help="list of times from rank to rank [1us]")
    parser.add_argument("--bandwidth", default="10GB/s", help="of a node's cable [10GB/s]")
    parser.add_argument("--schedule", default="dynamic", help="list of schedules [dynamic]")
    parser.add_argument("--costs", help="recorded tiles: a file of tessera render --tile-stats")
    parser.add_argument("--uniform", help="or list of times that tiles take, for example 1ms,10ms")
    parser.add_argument("--tiles-per-rank", type=int, default=100, help="with --uniform [100]")
    parser.add_argument("--uneven", type=float, default=0, help="with --uniform: spread of the times, 0 ... 1 [0]")
    parser.add_argument("--known-costs", action="store_true", help="tell the scheduler what the tiles will take")
    parser.add_argument("--resolution", help="of the picture [as recorded]")
    parser.add_argument("--tile-size", default="32", help="[32]")
    parser.add_argument("--master", default="auto", help="auto, dedicated or rendering [auto]")
    parser.add_argument("--prefetch", help="tiles that a worker holds [as the schedule finds right]")
    parser.add_argument("--master-cost", default="3us", help="rank 0's own time for a message [3us]")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("simulate_cluster"),
                        help="folder [simulate_cluster]")
    parser.add_argument("--validate", metavar="SCENE", help="compare two simulated ranks with two real ones")
    parser.add_argument("--repeat", type=int, default=5, help="with --validate: runs of which the fastest counts [5]")
    parser.add_argument("--simulate", type=pathlib.Path, help="tessera_simulate, if not in build/")
    parser.add_argument("--tessera", type=pathlib.Path, help="tessera, if not in build/")
    options = parser.parse_args()
    options.simulate = options.simulate or first_built(SIMULATORS, "tessera_simulate")
    if options.validate:
        validate(options)
    elif bool(options.costs) == bool(options.uniform):
        fail("give one of --costs FILE, --uniform TIMES, --validate SCENE")
    else:
        simulate_all(options)


if __name__ == "__main__":
    main()
