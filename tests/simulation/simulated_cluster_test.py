#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the simulator of clusters as its users do. Exit code 77 and a word where it is not built."""

import argparse
import csv
import io
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
EVEN = ["--tiles", 640, "--tile-time", 1e-3, "--tile-spread", 0.5]
OPTIONS = None


def simulate(*arguments):
    """Statistics of a simulated run and the rows of its tiles."""
    with tempfile.TemporaryDirectory() as folder:
        tiles = pathlib.Path(folder, "tiles.csv")
        command = [OPTIONS.simulate, *arguments, "--tile-stats", tiles]
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False, timeout=100)
        if done.returncode != 0:
            raise AssertionError(f"exit code {done.returncode}: {done.stderr}")
        return json.loads(done.stdout), list(csv.DictReader(io.StringIO(tiles.read_text(encoding="utf-8"))))


def record(folder):
    """What the tiles of a scene with dear regions cost."""
    costs = pathlib.Path(folder, "costs.csv")
    command = [OPTIONS.tessera, "render", OPTIONS.scenes / "corner_cluster.toml", "-q", "-r", "512x512",
               "--tile-size", "16", "-o", pathlib.Path(folder, "picture.ppm"), "--tile-stats", costs]
    subprocess.run(list(map(str, command)), check=True, timeout=100)
    return costs


class SimulatedCluster(unittest.TestCase):
    def test_every_pixel_comes_once(self):
        """The simulator itself ends with an error where a result is missing, comes twice or is another task's."""
        for schedule in ("dynamic", "static-bands", "cyclic-rows", "self", "guided"):
            stats, tiles = simulate("--ranks", 16, "--schedule", schedule, *EVEN)
            with self.subTest(schedule):
                seen = bytearray(stats["image"]["width"] * stats["image"]["height"])
                for tile in tiles:
                    x, y, width, height = (int(tile[key]) for key in ("x", "y", "width", "height"))
                    for row in range(y, y + height):
                        begin = row * stats["image"]["width"] + x
                        self.assertFalse(any(seen[begin:begin + width]))
                        seen[begin:begin + width] = b"\x01" * width
                self.assertTrue(all(seen))

    def test_equal_calls_give_equal_bytes(self):
        self.assertEqual(simulate("--ranks", 16, *EVEN), simulate("--ranks", 16, *EVEN))

    def test_tiles_on_demand_beat_static_bands(self):
        with tempfile.TemporaryDirectory() as folder:
            costs = record(folder)
            shared = {schedule: simulate("--ranks", 16, "--schedule", schedule, "--costs", costs, "--tile-size", 16,
                                         "--resolution", "2048x2048")[0]
                      for schedule in ("dynamic", "static-bands")}
        self.assertGreater(shared["dynamic"]["balance"]["efficiency"], shared["static-bands"]["balance"]["efficiency"])

    def test_work_is_what_was_asked_for(self):
        stats, tiles = simulate("--ranks", 8, "--tiles", 100, "--tile-time", 2e-3)
        self.assertEqual(len(tiles), 100)
        for tile in tiles:
            self.assertAlmostEqual(float(tile["end_s"]) - float(tile["start_s"]), 2e-3, delta=2e-9)
        self.assertAlmostEqual(sum(rank["busy_s"] for rank in stats["ranks"]), 0.2, delta=1e-6)

    def test_a_message_takes_its_time(self):
        """One worker, one tile that it begins with: the tile, its result of 32 and 3000 bytes, rank 0's time."""
        latency_s, bandwidth, cost_s = 1e-3, 1e6, 0.5e-3
        stats, _ = simulate("--ranks", 2, "--master", "dedicated", "--tiles", 1, "--tile-time", 0.25,
                            "--tile-bytes", 3000, "--latency", latency_s, "--bandwidth", bandwidth,
                            "--master-cost", cost_s)
        self.assertEqual(stats["messages"]["count"], 4)
        expected_s = 0.25 + latency_s + (32 + 3000) / bandwidth + cost_s
        self.assertAlmostEqual(stats["balance"]["makespan_s"], expected_s, delta=1e-8)

    def test_four_tiles_in_hand_hide_a_round_trip_of_two(self):
        """10 ms there and back, 5 ms a tile: one in hand reaches a third, four all of it but for the start."""
        throughput = {}
        for prefetch in (1, 4):
            stats, _ = simulate("--ranks", 9, "--master", "dedicated", "--tiles", 1600, "--tile-time", 5e-3,
                                "--latency", 5e-3, "--prefetch", prefetch)
            throughput[prefetch] = 1600 * 5e-3 / 8 / stats["balance"]["makespan_s"]
        self.assertAlmostEqual(throughput[1], 1 / 3, delta=0.01)
        self.assertGreater(throughput[4], 0.95)

    def test_a_slow_rank_0_limits_them_all(self):
        """W / (P - 1) is 0.1 s, but 1,000 messages of 1 ms are a second."""
        stats, _ = simulate("--ranks", 101, "--tiles", 1000, "--tile-time", 1e-2, "--master-cost", 1e-3,
                            "--master", "dedicated")
        self.assertGreater(stats["balance"]["makespan_s"], 1.0)
        self.assertLess(stats["balance"]["makespan_s"], 1.25)

    def test_nothing_to_do_is_refused(self):
        for arguments in (["--ranks", "4"], ["--ranks", "0", "--tiles", "1", "--tile-time", "1"],
                          ["--tiles", "4", "--tile-time", "0"], ["--costs", "missing.csv"],
                          ["--tiles", "4", "--tile-time", "1", "--schedule", "dynamc"]):
            done = subprocess.run([OPTIONS.simulate, *arguments], capture_output=True, text=True, check=False)
            with self.subTest(arguments):
                self.assertIn(done.returncode, (64, 66))
                self.assertRegex(done.stderr, r"^tessera_simulate: [^\n]*\n$")

    def test_the_script_writes_the_same_table_twice(self):
        tables = []
        for _ in range(2):
            with tempfile.TemporaryDirectory() as folder:
                subprocess.run([sys.executable, ROOT / "scripts" / "simulate_cluster.py", "--simulate",
                                OPTIONS.simulate, "--ranks", "4,8", "--uniform", "1ms", "--tiles-per-rank", "10",
                                "--schedule", "dynamic,static-bands", "--output", folder],
                               check=True, capture_output=True)
                tables.append(pathlib.Path(folder, "simulate_cluster.csv").read_text(encoding="utf-8"))
        self.assertEqual(tables[0], tables[1])
        self.assertEqual(len(tables[0].splitlines()), 1 + 4)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--simulate", required=True)
    parser.add_argument("--tessera", required=True)
    parser.add_argument("--scenes", type=pathlib.Path, required=True)
    OPTIONS, rest = parser.parse_known_args()
    if not OPTIONS.simulate:
        print("skipped: tessera_simulate is not built (install libsimgrid-dev, configure with -DTESSERA_SIMULATION=ON)")
        sys.exit(77)
    unittest.main(argv=[sys.argv[0], *rest])
