#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The files that show a schedule: traces keep every rule of their viewers, maps paint what the statistics say."""

import csv
import json
import math
import pathlib
import struct
import zlib

import running_program
from running_program import CANNOT_CREATE, IO_FAILURE, USAGE
from trace_check import Trace

# A microsecond holds more than 3 ns and what three sums of seconds may be off.
ROUNDING_S = 1e-8


class PngFile:
    """Pixels of a PNG of 8 bits a channel whose rows are differences to the left, and its text."""

    def __init__(self, path):
        data = path.read_bytes()
        self.text = {}
        packed = b""
        at = 8
        while at < len(data):
            length, kind = struct.unpack_from(">I4s", data, at)
            chunk = data[at + 8:at + 8 + length]
            if kind == b"IHDR":
                self.width, self.height = struct.unpack_from(">II", chunk)
            elif kind == b"tEXt":
                key, value = chunk.split(b"\0", 1)
                self.text[key.decode("latin-1")] = value.decode("latin-1")
            elif kind == b"IDAT":
                packed += chunk
            at += 12 + length
        rows = zlib.decompress(packed)
        self.rows = []
        for y in range(self.height):
            start = y * (3 * self.width + 1)
            assert rows[start] == 1, "the filter of a row is another one"
            left = [0, 0, 0]
            row = []
            for x in range(self.width):
                left = [(l + d) % 256 for l, d in zip(left, rows[start + 1 + 3 * x:start + 4 + 3 * x])]
                row.append("#" + bytes(left).hex())
            self.rows.append(row)

    def colors_in(self, x, y, width, height):
        return {color for row in self.rows[y:y + height] for color in row[x:x + width]}


class ScheduleFilesTest(running_program.ProgramTest):
    def render(self, *words, ranks):
        scene = pathlib.Path(self.scenes) / "corner_cluster.toml"
        run = self.run_tessera("render", scene, "-o", "picture.png", "--tile-stats", "tiles.csv", *words, ranks=ranks)
        self.assertEqual(run.returncode, 0, run.stderr)
        with open(self.folder / "tiles.csv", newline="", encoding="ascii") as file:
            self.tiles = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        return run

    def check_trace(self, trace, ranks):
        self.assertEqual(sorted(trace.names), list(range(ranks)))
        for rank, name in trace.names.items():
            self.assertRegex(name, rf"^rank {rank} \(.+\)$")
            self.assertEqual(trace.sort_indices[rank], rank)
            self.assertEqual(trace.thread_names[rank, rank], "tiles")
        scheduling = (0, ranks)
        self.assertEqual(trace.thread_names[scheduling], "scheduling")

        # Each tile has one slice, on the rank that rendered it, and says what the statistics say
        slices = {each.args["tile"]: each for each in trace.slices if each.name.startswith("tile ")}
        self.assertEqual(len([each for each in trace.slices if each.name.startswith("tile ")]), len(self.tiles))
        self.assertEqual(sorted(slices), list(range(len(self.tiles))))
        begins = [each.begin for each in trace.slices if each.name == "render"]
        self.assertEqual(len(begins), 1)
        for tile in self.tiles:
            shown = slices[tile["tile"]]
            self.assertEqual(shown.name, f"tile {int(tile['tile'])}")
            self.assertEqual(shown.thread, (tile["rank"], tile["rank"]))
            for key in ("tile", "x", "y", "width", "height", "rays", "bytes"):
                self.assertEqual(shown.args[key], tile[key], key)
            self.assertLess(abs(1e-9 * (shown.begin - begins[0]) - tile["start_s"]), ROUNDING_S)
            if tile["rank"] > 0:
                self.assertLess(abs(1e-9 * (shown.end - begins[0]) - tile["end_s"]), ROUNDING_S)

        # Arrows lead from rank 0 to each tile, but for those that a worker began with, and back
        assigned = trace.arrows("assign")
        told = {tile.args["tile"] for _, tile in assigned}
        self.assertEqual(len(told), len(assigned))
        for rank in range(ranks):
            of_rank = sorted((each for each in slices.values() if each.thread[0] == rank), key=lambda each: each.begin)
            is_told = [each.args["tile"] in told for each in of_rank]
            self.assertEqual(is_told, sorted(is_told) if rank > 0 else [True] * len(of_rank))
        for hand_out, tile in assigned:
            self.assertIs(tile, slices[tile.args["tile"]])
            self.assertEqual(hand_out.thread, scheduling)
            self.assertEqual(hand_out.name, f"assign to rank {tile.thread[0]}")
            self.assertLessEqual(hand_out.begin, tile.begin)
        delivered = trace.arrows("deliver")
        self.assertEqual(sorted(tile.args["tile"] for tile, _ in delivered), sorted(slices))
        for tile, acceptance in delivered:
            self.assertIs(tile, slices[tile.args["tile"]])
            self.assertEqual(acceptance.thread, scheduling)
            self.assertEqual(acceptance.name, f"accept from rank {tile.thread[0]}")
            self.assertEqual(acceptance.args["tile"], tile.args["tile"])
            self.assertEqual(acceptance.args["bytes"], tile.args["bytes"])
            self.assertLessEqual(tile.end, acceptance.begin)
        hand_outs = [each for each in trace.slices if each.name.startswith("assign")]
        self.assertEqual(sum(each.args["tiles"] for each in hand_outs), len(told))

        self.assertEqual(dict(trace.counters), {(0, "tiles left"): list(range(len(self.tiles), -1, -1))})

    def test_a_trace_keeps_the_rules_of_its_viewers(self):
        for ranks, words in [(3, []), (3, ["--tile-size", "64", "--master", "dedicated"]), (2, ["--tile-size", "4"]),
                             (3, ["--schedule", "static-bands"]), (3, ["--schedule", "guided"]), (1, []), (0, [])]:
            with self.subTest(ranks=ranks, words=words):
                self.render("-r", "160x90", "--trace", "trace.json", *words, ranks=ranks)
                trace = Trace((self.folder / "trace.json").read_text(encoding="utf-8"))
                self.check_trace(trace, max(ranks, 1))

    def test_phases_hold_the_tiles_of_rank_0(self):
        for ranks in (0, 3):
            self.render("-r", "320x180", "--trace", "trace.json", "--stats", "stats.json", "--master", "rendering",
                        ranks=ranks)
            trace = Trace((self.folder / "trace.json").read_text(encoding="utf-8"))
            phases = [each for each in trace.slices if each.thread == (0, 0) and not each.args]
            self.assertEqual([each.name for each in phases],
                             ["read", *["broadcast"] * (ranks > 0), "build", "render", "write"])
            times = json.loads((self.folder / "stats.json").read_text())["time_s"]
            for phase in phases:
                self.assertLess(abs(1e-9 * (phase.end - phase.begin) - times[phase.name]), ROUNDING_S, phase.name)
            render = next(each for each in phases if each.name == "render")
            own = [each for each in trace.slices if each.thread == (0, 0) and each.args]
            self.assertTrue(own)
            self.assertTrue(all(render.begin <= each.begin and each.end <= render.end for each in own))

    def test_a_trace_goes_to_standard_output_and_changes_no_picture(self):
        self.render("-r", "80x45", ranks=0)
        before = (self.folder / "picture.png").read_bytes()
        run = self.render("-r", "80x45", "--trace", "-", "-q", ranks=3)
        self.check_trace(Trace(run.stdout), 3)
        self.assertEqual((self.folder / "picture.png").read_bytes(), before)

    def test_maps_paint_what_the_statistics_say(self):
        for ranks, crop in [(3, []), (0, ["--crop", "50,20,75,33"])]:
            self.render("-r", "160x90", *crop, "--cost-map", "cost.png", "--owner-map", "owner.png", ranks=ranks)
            cost, owner = PngFile(self.folder / "cost.png"), PngFile(self.folder / "owner.png")
            corner = (50, 20) if crop else (0, 0)
            for picture in (cost, owner):
                self.assertEqual((picture.width, picture.height), (75, 33) if crop else (160, 90))
            ranks_shown = dict(line.split() for line in owner.text["Colors"].splitlines())
            self.assertEqual(len(ranks_shown), max(ranks, 1))
            per_pixel, shown = [], {}
            for tile in self.tiles:
                place = [int(tile["x"]) - corner[0], int(tile["y"]) - corner[1], int(tile["width"]),
                         int(tile["height"])]
                self.assertEqual(owner.colors_in(*place), {ranks_shown[str(int(tile["rank"]))]})
                per_pixel.append((tile["end_s"] - tile["start_s"]) / (tile["width"] * tile["height"]))
                [shown[per_pixel[-1]]] = cost.colors_in(*place)
            self.assertEqual((cost.text["Scale"], cost.text["Unit"]), ("logarithmic", "seconds per pixel"))
            self.assertTrue(math.isclose(float(cost.text["Minimum"]), min(per_pixel), rel_tol=1e-3))
            self.assertTrue(math.isclose(float(cost.text["Maximum"]), max(per_pixel), rel_tol=1e-3))
            self.assertIn("minimum " + shown[min(per_pixel)] + ", maximum " + shown[max(per_pixel)],
                          cost.text["Colors"])

    def test_the_statistics_say_how_many_tiles_a_worker_had(self):
        for prefetch in (1, 3):
            self.render("-r", "160x90", "--stats", "stats.json", "--prefetch", prefetch, ranks=2)
            schedule = json.loads((self.folder / "stats.json").read_text(encoding="utf-8"))["schedule"]
            self.assertEqual(schedule["prefetch_most"], prefetch)
            self.assertGreaterEqual(schedule["prefetch_mean"], 1)
            self.assertLessEqual(schedule["prefetch_mean"], prefetch)

    def test_names_that_cannot_be_written_to(self):
        scene = self.write("scene.toml", "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n[image]\nwidth = 8\nheight = 8\n")
        for option in ("--cost-map", "--owner-map"):
            self.assert_refused(USAGE, "render", scene, "-o", "a.png", option, "map.jpg", says=[option, "end in .png"])
            self.assert_refused(USAGE, "render", scene, "-o", "a.png", option, "-", says=option, ranks=(0,))
            self.assert_refused(USAGE, "render", scene, "-o", "a.png", option, "a.png", says="-o as well", ranks=(0,))
        self.assert_refused(USAGE, "render", scene, "-o", "a.png", "--trace", "t", "--stats", "t", says="--trace",
                            ranks=(0,))
        self.assert_refused(CANNOT_CREATE, "render", scene, "-o", "a.png", "--trace", "no/t.json", says="no/t.json")
        self.assert_refused(IO_FAILURE, "render", scene, "-o", "a.png", "-q", "--trace", "/dev/full", says="/dev/full")


if __name__ == "__main__":
    running_program.main(__doc__, scenes="folder of the scene collection")
