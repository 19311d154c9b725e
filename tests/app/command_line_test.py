#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the program as its users do, with and without mpirun: pictures, exit codes, messages, and no hang."""

import csv
import json
import math
import pathlib
import random
import struct
import subprocess

import running_program
from running_program import BAD_SCENE, CANNOT_CREATE, INPUT_MISSING, IO_FAILURE, MIRROR_SCENE, TIME_LIMIT_S, USAGE

SMALL_SCENE = MIRROR_SCENE + """
[image]
width = 40
height = 30
[[plane]]
point = [0, 0, -1]
normal = [0, 0, 1]
"""


def runs_avx2():
    """Whether this machine has the instructions of the avx2 kernel."""
    flags = pathlib.Path("/proc/cpuinfo").read_text(encoding="ascii", errors="replace").split()
    return "avx2" in flags and "fma" in flags


class CommandLineTest(running_program.ProgramTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write("small.toml", SMALL_SCENE)

    def bad_scene(self, text, says, name="bad.toml"):
        self.assert_refused(BAD_SCENE, "render", self.write(name, text), "-o", "out.png", says=says, ranks=(0,))

    # pictures

    def test_every_rank_count_and_schedule_writes_the_same_file(self):
        self.assertEqual(self.run_tessera("render", self.scene, "-o", "one.png", "-q").returncode, 0)
        reference = (self.folder / "one.png").read_bytes()
        for ranks, schedule, tile in [(1, "dynamic", "8"), (2, "dynamic", "7x5"), (3, "static-bands", "16"),
                                      (4, "cyclic-rows", "16"), (2, "self", "1"), (4, "guided", "1000"),
                                      (3, "factoring", "4"), (2, "trapezoid", "4"), (4, "dynamic", "auto")]:
            with self.subTest(ranks=ranks, schedule=schedule, tile=tile):
                run = self.run_tessera("render", self.scene, "-o", "many.png", "--schedule", schedule,
                                       "--tile-size", tile, ranks=ranks)
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertEqual((self.folder / "many.png").read_bytes(), reference)
                self.assertEqual(run.stdout, "")

    def test_costs_of_an_earlier_run_change_the_tiles_and_nothing_else(self):
        def render(picture, *words, ranks=2):
            run = self.run_tessera("render", self.scene, "-s", "16", "-o", picture, "--stats", "s.json", *words, ranks=ranks)
            self.assertEqual(run.returncode, 0, run.stderr)
            return (self.folder / picture).read_bytes(), json.loads((self.folder / "s.json").read_text())

        reference, _ = render("one.png", "--tile-stats", "costs.csv", "--tile-size", "4", ranks=0)
        header, *rows = (self.folder / "costs.csv").read_text().splitlines(keepends=True)
        times = [row.split(",")[6:8] for row in rows]
        random.Random(1).shuffle(times)
        self.write("shuffled.csv", header + "".join(
            ",".join(row.split(",")[:6] + time + row.split(",")[8:]) for row, time in zip(rows, times)))
        for costs in ("costs.csv", "shuffled.csv"):
            for words in ([], ["--tile-size", "5"], ["--schedule", "guided"], ["--schedule", "factoring"],
                          ["--schedule", "trapezoid"], ["--prefetch", "1"]):
                with self.subTest(costs=costs, words=words):
                    picture, _ = render("many.png", "--costs", costs, *words, ranks=3)
                    self.assertEqual(picture, reference)
        # Enough work, so that tiles follow from it, at another resolution; and a later frame's costs from those tiles.
        self.write("slow.csv", header + "".join(
            ",".join(row.split(",")[:6] + ["0", str(1 + int(row.split(",")[1]))] + row.split(",")[8:]) for row in rows))
        reference, _ = render("large.png", "-r", "160x120")
        picture, cut = render("cut.png", "-r", "160x120", "--costs", "slow.csv", "--tile-stats", "slow.csv")
        self.assertEqual(picture, reference)
        self.assertEqual(cut["schedule"]["policy"], "dynamic")
        widths = {row.split(",")[3] for row in (self.folder / "slow.csv").read_text().splitlines()[1:]}
        self.assertGreater(len(widths), 1)
        self.assertEqual(render("again.png", "-r", "160x120", "--costs", "slow.csv")[0], reference)

    def test_little_work_is_shared_out_in_bands_unless_told_otherwise(self):
        def policy(*words, ranks):
            run = self.run_tessera("render", self.scene, "-o", "many.png", "--stats", "s.json", *words, ranks=ranks)
            self.assertEqual(run.returncode, 0, run.stderr)
            return json.loads((self.folder / "s.json").read_text())["schedule"]["policy"]

        self.assertEqual(policy(ranks=2), "dynamic")
        self.assertEqual(policy(ranks=8), "static-bands")
        self.assertEqual(policy("--tile-size", "8", ranks=8), "dynamic")
        self.assertEqual(policy("--master", "dedicated", ranks=8), "dynamic")
        self.assertEqual(policy("--schedule", "self", ranks=8), "self")
        self.write("fast.csv", "x,y,width,height,start_s,end_s\n0,0,40,30,0,1e-6\n")
        self.assertEqual(policy("--costs", "fast.csv", ranks=2), "static-bands")
        self.write("slow.csv", "x,y,width,height,start_s,end_s\n0,0,40,30,0,1\n")
        self.assertEqual(policy("--costs", "slow.csv", ranks=8), "dynamic")

    def test_costs_that_do_not_fit_are_refused(self):
        self.assertEqual(self.run_tessera("render", self.scene, "-o", "one.png", "--tile-stats", "costs.csv").returncode, 0)
        costs = self.folder / "costs.csv"
        self.assert_refused(BAD_SCENE, "render", self.scene, "--costs", self.scene, says=["small.toml:1:1", "--tile-stats"])
        self.assert_refused(BAD_SCENE, "render", self.scene, "-r", "64x9", "--costs", costs, says="costs.csv:1:1")
        self.assert_refused(INPUT_MISSING, "render", self.scene, "--costs", "none.csv", says="none.csv")
        self.assert_refused(USAGE, "render", self.scene, "--costs", costs, "--schedule", "cyclic-rows",
                            says="--costs does not go with --schedule cyclic-rows")
        cut_off = costs.read_text()[:-4]
        self.assert_refused(BAD_SCENE, "render", self.scene, "--costs", self.write("off.csv", cut_off[:cut_off.rindex(",")]),
                            says="off.csv:", ranks=(0,))

    def test_every_kernel_writes_the_same_file(self):
        planes = self.write("planes.toml", SMALL_SCENE[:SMALL_SCENE.index("[[sphere]]")] +
                            SMALL_SCENE[SMALL_SCENE.index("[[plane]]"):])
        for scene in (self.scene, planes):
            self.assertEqual(self.run_tessera("render", scene, "-o", "scalar.png", "--kernel", "scalar").returncode, 0)
            reference = (self.folder / "scalar.png").read_bytes()
            for kernel, ranks in [("auto", 0), ("brute", 0), ("avx2", 0), ("avx2", 2)]:
                with self.subTest(scene=scene, kernel=kernel, ranks=ranks):
                    run = self.run_tessera("render", scene, "-o", "other.png", "--kernel", kernel, ranks=ranks)
                    if kernel == "avx2" and not runs_avx2():
                        self.assertEqual(run.returncode, USAGE)
                        self.assertIn("AVX2", run.stderr)
                        continue
                    self.assertEqual(run.returncode, 0, run.stderr)
                    self.assertEqual((self.folder / "other.png").read_bytes(), reference)
        self.assert_refused(USAGE, "render", self.scene, "--kernel", "avx3", says='did you mean "avx2"')

    def test_every_format_and_depth_holds_the_same_picture(self):
        for name, extra in [("a.png", ["--bits", "16"]), ("b.ppm", ["--bits", "16"])]:
            self.assertEqual(self.run_tessera("render", self.scene, "-o", name, *extra).returncode, 0)
        self.assertEqual(self.run_tessera("compare", "a.png", "b.ppm").returncode, 0)
        for name in ["linear.png", "linear.pfm"]:
            run = self.run_tessera("render", self.scene, "-o", name, "--transfer", "none")
            self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.run_tessera("compare", "linear.png", "linear.pfm", "--tolerance", "0.00197").returncode, 0)
        self.assertEqual(self.run_tessera("compare", "linear.png", "linear.pfm", "--tolerance", "0.0001").returncode, 1)

    def test_a_crop_and_the_default_output_name(self):
        self.assertEqual(self.run_tessera("render", self.scene, "--crop", "3,4,20,10", "-q").returncode, 0)
        header = (self.folder / "small.png").read_bytes()[16:24]
        self.assertEqual(header, (20).to_bytes(4, "big") + (10).to_bytes(4, "big"))

    def test_every_scene_of_the_collection_renders(self):
        for scene in sorted(pathlib.Path(self.scenes).glob("*.toml")):
            with self.subTest(scene=scene.name):
                run = self.run_tessera("render", scene, "-r", "32x24", "-o", "scene.png", ranks=2)
                self.assertEqual(run.returncode, 0, run.stderr)

    # reports

    def test_stats_have_the_keys_that_scripts_rely_on(self):
        run = self.run_tessera("render", self.scene, "-q", "--stats", "-", "--tile-stats", "tiles.csv", ranks=2)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stderr, "")
        stats = json.loads(run.stdout)
        keys = {
            "scene": "spheres planes lights materials", "image": "width height samples max_bounces",
            "mpi": "size nodes library",
            "schedule": "policy tile_width tile_height tiles prefetch master prefetch_mean prefetch_most",
            "time_s": "read broadcast build render write total", "rays": "primary shadow mirror",
            "balance": "imbalance load_balance efficiency tail_s graham_bound_s makespan_s",
            "messages": "count bytes per_tile bytes_per_tile master_s_per_tile",
            "faults": "silences reissued damaged late returned wasted_s lost",
            "memory": "bytes_per_sphere node_bytes rank_bytes",
        }
        for key, inner in keys.items():
            self.assertEqual(set(stats[key]), set(inner.split()), key)
        self.assertLessEqual({"schema", "version", "command", "skipped", "ranks"}, set(stats))
        self.assertEqual(len(stats["ranks"]), 2)
        self.assertEqual(set(stats["ranks"][0]), set("rank host tiles pixels rays busy_s wait_s".split()))
        self.assertEqual(sum(rank["pixels"] for rank in stats["ranks"]), 40 * 30)
        self.assertEqual(sum(rank["rays"] for rank in stats["ranks"]), sum(stats["rays"].values()))
        self.assertEqual(stats["mpi"]["size"], 2)
        self.assertEqual(stats["rays"]["primary"], 1200)
        self.assertGreater(stats["memory"]["bytes_per_sphere"], 40)
        self.assertGreaterEqual(stats["memory"]["node_bytes"], stats["memory"]["bytes_per_sphere"])
        self.assertGreater(stats["memory"]["rank_bytes"], 0)
        messages, tiles = stats["messages"], stats["schedule"]["tiles"]
        self.assertAlmostEqual(messages["per_tile"], messages["count"] / tiles)
        self.assertAlmostEqual(messages["bytes_per_tile"], messages["bytes"] / tiles)

        with open(self.folder / "tiles.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(rows[0]), "tile,x,y,width,height,rank,start_s,end_s,rays,bytes".split(","))
        self.assertEqual(len(rows), stats["schedule"]["tiles"])
        self.assertEqual(sum(int(row["width"]) * int(row["height"]) for row in rows), 1200)
        self.assertTrue(all(0 <= float(row["start_s"]) <= float(row["end_s"]) for row in rows))

    def test_the_report_goes_to_stderr_and_quiet_silences_it(self):
        loud = self.run_tessera("render", self.scene, ranks=2)
        self.assertIn("load balance: efficiency", loud.stderr)
        self.assertRegex(loud.stderr, r"memory: \d+ bytes a sphere, \d+\.\d MiB a node, besides \d+\.\d MiB on rank 0\n")
        self.assertRegex(loud.stderr, r"\nmessages: \d\.\d\d and \d+ bytes a tile, rank 0 spent")
        self.assertEqual(loud.stdout, "")
        alone = self.run_tessera("render", self.scene)
        self.assertIn("load balance: efficiency", alone.stderr)
        self.assertNotIn("messages:", alone.stderr)
        self.assertEqual(self.run_tessera("render", self.scene, "-q", ranks=2).stderr, "")

    def test_plain_progress_is_whole_lines(self):
        run = self.run_tessera("render", self.scene, "-r", "3000x3000", "--progress", "plain", ranks=1)
        lines = [line for line in run.stderr.splitlines() if line.startswith("rendered")]
        for line in lines:
            self.assertRegex(line, r"^rendered +\d+ %, \d+ s, about \d+ s left$")

    def test_compare_tells_pictures_apart(self):
        self.run_tessera("render", self.scene, "-o", "a.png", "-q")
        self.run_tessera("render", self.scene, "-o", "b.png", "-q", "-b", "0")
        same = self.run_tessera("compare", "a.png", "a.png", "--json")
        self.assertEqual((same.returncode, json.loads(same.stdout)["max_abs"]), (0, 0))
        other = self.run_tessera("compare", "a.png", "b.png", "--json")
        self.assertEqual(other.returncode, 1)
        self.assertGreater(json.loads(other.stdout)["rmse"], 0)

    def test_the_reference_takes_the_same_decisions(self):
        for name, words, ranks in [("fast", [], 2), ("exact", ["--reference"], 3), ("flat", ["-b", "0"], 0)]:
            run = self.run_tessera("render", self.scene, "-o", name + ".pfm", "--signature", name + ".sig", *words,
                                   ranks=ranks)
            self.assertEqual(run.returncode, 0, run.stderr)
        same = self.run_tessera("compare", "fast.pfm", "exact.pfm", "--signatures", "fast.sig", "exact.sig", "--json",
                                "--tolerance", "1e-6")
        self.assertEqual(same.returncode, 0, same.stderr)
        figures = json.loads(same.stdout)
        self.assertEqual([figures[key] for key in ("other_first", "other_surfaces", "other_lights")], [0, 0, 0])
        other = self.run_tessera("compare", "fast.pfm", "flat.pfm", "--signatures", "fast.sig", "flat.sig")
        self.assertEqual(other.returncode, 1)
        self.assertRegex(other.stdout, r"\nids +0 pixels see another surface first, [1-9]\d* meet other surfaces")
        self.assert_refused(BAD_SCENE, "compare", "fast.pfm", "fast.pfm", "--signatures", "fast.sig", "fast.pfm",
                            says=["fast.pfm", "--signature"], ranks=(0,))

    def test_no_output_takes_the_name_of_another_that_is_being_written(self):
        self.assert_refused(USAGE, "render", self.scene, "-o", "a.png", "--error", "b.pfm", "--signature", "b.pfm.part",
                            says=["--error", "--signature"], ranks=(0,))
        (self.folder / "link.pfm").symlink_to("new.pfm")
        self.assert_refused(USAGE, "render", self.scene, "-o", "new.pfm", "--error", "link.pfm", says="-o", ranks=(0,))
        self.assert_refused(USAGE, "render", self.scene, "-o", "a.png", "--signature", "-", says="--signature", ranks=(0,))

    def test_signatures_are_those_of_the_pictures(self):
        self.run_tessera("render", self.scene, "-o", "a.png", "--signature", "a.sig", "-q")
        self.run_tessera("render", self.scene, "-o", "b.png", "-r", "20x10", "-q")
        self.assert_refused(BAD_SCENE, "compare", "b.png", "b.png", "--signatures", "a.sig", "a.sig", says="a.sig",
                            ranks=(0,))

    def test_error_bounds_come_as_a_picture_and_a_line(self):
        run = self.run_tessera("render", self.scene, "-o", "a.png", "--error", "bound.pfm", "--stats", "-", ranks=2)
        self.assertEqual(run.returncode, 0, run.stderr)
        error = json.loads(run.stdout)["error"]
        self.assertTrue(0 < error["largest"] < 1e-10, error)
        self.assertRegex(run.stderr, r"error: at most \S+ of a linear channel, \d+ pixels? uncertified")
        header, values = (self.folder / "bound.pfm").read_bytes().split(b"\n-1.0\n")
        self.assertEqual(header, b"Pf\n40 30")
        bounds = struct.unpack("<1200f", values)
        self.assertEqual(max(b for b in bounds if b < math.inf), error["largest"])
        self.assertEqual(sum(b == math.inf for b in bounds), error["uncertified"])
        plain = self.run_tessera("render", self.scene, "-o", "b.png", "--stats", "-")
        self.assertNotIn("error", json.loads(plain.stdout))
        self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())
        self.assert_refused(USAGE, "render", self.scene, "-o", "c.png", "--error", "c.txt", says="must end in .pfm")
        self.assert_refused(USAGE, "render", self.scene, "-o", "c.png", "--error", "c.pfm", "--reference",
                            says="--reference")

    def test_info_counts_what_is_there(self):
        run = self.run_tessera("info", self.scene)
        self.assertEqual(run.returncode, 0)
        self.assertRegex(run.stdout, r"spheres +1\nplanes +1\nlights +1\n")
        self.assertRegex(run.stdout, r"memory +\d+\.\d MiB a node, \d+ bytes a sphere")

    def convert(self, *words):
        run = self.run_tessera("convert", *words)
        self.assertEqual((run.returncode, run.stdout), (0, ""), run.stderr)
        return run.stderr

    def test_convert_writes_the_format_of_the_ending_and_notes(self):
        self.assertRegex(self.convert(self.scene, "-o", "small.dat"), r"^note: .*mirror image")
        self.assertEqual(self.convert(self.scene, "-o", "small.POV", "-q"), "")
        self.assertIn("#version 3.7", (self.folder / "small.POV").read_text())

    def test_a_left_handed_scene_keeps_its_picture_as_dat(self):
        scene = self.write("left.toml", SMALL_SCENE.replace("[camera]", '[camera]\nhandedness = "left"'))
        self.assertEqual(self.convert(scene, "-o", "left.dat"), "")
        for name in ("left.toml", "left.dat"):
            self.run_tessera("render", name, "-o", name + ".png", "--transfer", "none", "-q")
        # Weights go through a product and a quotient, which may round them to the next byte.
        self.assertEqual(self.run_tessera("compare", "left.toml.png", "left.dat.png", "--tolerance", "0.004").returncode, 0)

    def test_a_scene_written_as_toml_keeps_its_picture_to_the_byte(self):
        flake = self.write("flake.toml", SMALL_SCENE + '[generate]\nkind = "sphereflake"\nlevel = 3\n')
        for scene, name in [(self.scene, "plain"), (flake, "bulk")]:
            note = self.convert(scene, "-o", name + ".toml")
            self.assertEqual(note, "note: the 821 spheres are in bulk.spheres.txt\n" if name == "bulk" else "")
            self.run_tessera("render", scene, "-o", "a.png", "-q")
            self.run_tessera("render", name + ".toml", "-o", "b.png", "-q")
            self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())
        self.assert_refused(USAGE, "convert", self.write("c.spheres.txt", "0 0 0 1\n" * 400), "-o", "c.toml",
                            says="the table of its spheres", ranks=(0,))

    def test_convert_frames_a_scene_without_a_camera(self):
        self.convert(self.write("row.txt", "0 0 0 1\n3 0 0 1\n"), "-o", "row.dat", "-q")
        self.assertIn("CENTER 3.", (self.folder / "row.dat").read_text())
        self.assertEqual(self.run_tessera("render", "row.dat", "-r", "32x18", "-o", "row.png").returncode, 0)

    def test_what_cannot_be_converted(self):
        scene = self.scene
        self.assert_refused(USAGE, "convert", scene, says="output")
        self.assert_refused(USAGE, "convert", scene, "-o", "out.obj", says=["out.obj", ".toml, .pov or .dat"], ranks=(0,))
        self.assert_refused(INPUT_MISSING, "convert", "nowhere.toml", "-o", "out.dat", says="nowhere.toml", ranks=(0,))
        self.assert_refused(CANNOT_CREATE, "convert", scene, "-o", "no/out.dat", says="no/out.dat", ranks=(0,))
        bad = self.write("bad.toml", "[[sphere]]\nradius = -1\n")
        self.assert_refused(BAD_SCENE, "convert", bad, "-o", "out.dat", says="bad.toml:1:", ranks=(0,))
        self.convert(scene, "-o", "same.dat", "-q")
        before = (self.folder / "same.dat").read_bytes()
        self.assert_refused(USAGE, "convert", "same.dat", "-o", "./same.dat", says="INPUT as well", ranks=(0,))
        self.assertEqual((self.folder / "same.dat").read_bytes(), before)

    def test_help_and_version_go_to_stdout_once(self):
        for words in [["--help"], ["render", "--help"], ["--version"]]:
            for ranks in (0, 2):
                run = self.run_tessera(*words, ranks=ranks)
                self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertEqual(self.run_tessera("--version", ranks=3).stdout.count("tessera"), 1)

    # bad input: one line, the right exit code on every rank, nothing left behind

    def test_wrong_command_lines(self):
        scene = self.scene
        self.assert_refused(USAGE, "render", says="INPUT")
        self.assert_refused(USAGE, "render", scene, "--tile-size", "0", says="--tile-size")
        self.assert_refused(USAGE, "render", scene, "--schedule", "dynamc", says='did you mean "dynamic"')
        self.assert_refused(USAGE, "render", scene, "-o", "out.jpg", says=".png, .ppm or .pfm")
        self.assert_refused(USAGE, "render", scene, "--crop", "30,0,20,20", says="--crop")
        self.assert_refused(USAGE, "render", scene, "-s", "5", says="4 or 9")
        self.assert_refused(USAGE, "render", scene, "-o", "a.pfm", "--bits", "16", says="--bits")
        self.assert_refused(USAGE, "render", scene, "--schedule", "static-bands", "--master", "dedicated",
                            says="dedicated", ranks=(3,))
        self.assert_refused(USAGE, "render", scene, "--master", "dedicated", says="dedicated", ranks=(0, 1))
        self.assert_refused(USAGE, "frobnicate", says="frobnicate")

    def test_an_empty_argument_is_refused_and_does_not_hang(self):
        self.assert_refused(USAGE, "render", self.scene, "", "-q", says="argument 3 is empty")
        self.assert_refused(USAGE, "render", self.scene, "-o", "", says="empty", ranks=(0,))

    def test_one_file_for_two_things_is_refused(self):
        self.assert_refused(USAGE, "render", self.scene, "-o", "x.png", "--stats", "./x.png", says="-o as well")
        self.assert_refused(USAGE, "render", self.scene, "--stats", self.scene, says="INPUT as well", ranks=(0,))

    def test_outputs_appear_together_or_not_at_all(self):
        self.assert_refused(IO_FAILURE, "render", self.scene, "-q", "--stats", "/dev/full", says="/dev/full")

    def test_a_full_standard_output_is_an_error(self):
        with open("/dev/full", "w") as full:
            run = subprocess.run([self.tessera, "info", self.scene], stdout=full, stderr=subprocess.PIPE, text=True,
                                 timeout=TIME_LIMIT_S, check=False)
        self.assertEqual((run.returncode, len(self.own_lines(run))), (IO_FAILURE, 1))

    def test_files_that_cannot_be_read_or_written(self):
        self.assert_refused(INPUT_MISSING, "render", "nowhere.toml", says="nowhere.toml")
        self.assert_refused(CANNOT_CREATE, "render", self.scene, "-o", "no/such/folder/out.png", says="no/such/folder")
        self.assert_refused(CANNOT_CREATE, "render", self.scene, "--stats", "no/such/stats.json", says="no/such")
        self.assert_refused(BAD_SCENE, "render", self.write("scene.xml", "<x/>"), says=".toml")
        self.assert_refused(INPUT_MISSING, "compare", "a.png", "b.png", says="a.png", ranks=(0,))

    def test_scenes_that_cannot_be_rendered(self):
        self.assert_refused(BAD_SCENE, "render", self.write("bad.toml", "[[sphere]]\ncenter = [0, 0, 0]\nradius = -1\n"),
                            says=["bad.toml:3:10:", "radius", "-1"])
        self.bad_scene("[image\nwidth = 3\n", "bad.toml:1:")
        self.bad_scene("[[sphere]]\ncenter = [0, 0, 0]\nradious = 1\n", 'did you mean "radius"')
        self.bad_scene("[[sphere]]\ncenter = [0, 0, 0]\nradius = \"big\"\n", "bad.toml:3:10:")
        self.bad_scene("[[sphere]]\ncenter = [0, 0, nan]\nradius = 1\n", "bad.toml:2:")
        self.bad_scene("[[sphere]]\ncenter = [0, 0, 0]\nradius = inf\n", "bad.toml:3:10:")
        self.bad_scene("[camera]\neye = [1, 2, 3]\ntarget = [1, 2, 3]\n", "same point")
        self.bad_scene("[camera]\neye = [0, 0, 3]\ntarget = [0, 0, 0]\n", "parallel")
        self.bad_scene("[camera]\neye = [0, 0, 3]\n", ["bad.toml:1:", "target"])
        self.bad_scene("[[sphere]]\ncenter = [0, 0, 1e200]\nradius = 1e-2\n", ["bad.toml:", "span from 0.01 to 1e+200"])
        self.bad_scene("[material.hot]\ncolor = [1e300, 1, 1]\n", "bad.toml:2:9:")
        self.bad_scene("[image]\nwidth = 0\n", "bad.toml:2:9:")
        self.bad_scene("[image]\nsamples = 5\n", "4 or 9")

    def test_tachyon_files_that_are_cut_off_or_junk(self):
        good = ("BEGIN_SCENE\nRESOLUTION 8 8\nCAMERA ZOOM 1 ASPECTRATIO 1 ANTIALIASING 0 RAYDEPTH 2\n"
                "CENTER 0 0 -5 VIEWDIR 0 0 1 UPDIR 0 1 0 END_CAMERA\n"
                "SPHERE CENTER 0 0 0 RAD 1 TEXTURE AMBIENT 1 DIFFUSE 0 SPECULAR 0 OPACITY 1 COLOR 1 1 1 TEXFUNC 0\n"
                "END_SCENE\n")
        run = self.run_tessera("render", self.write("good.dat", good), "-o", "good.png", "-q")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.bad_scene(good[:-len("END_SCENE\n")], "cut.dat:", name="cut.dat")
        self.bad_scene(good[:200], "cut.dat:", name="cut.dat")
        self.bad_scene(good.replace("RAD 1", "RAD one"), "junk.dat:5:", name="junk.dat")
        self.bad_scene("\x00\x01\x02 rubbish", "junk.dat:1:", name="junk.dat")


if __name__ == "__main__":
    running_program.main(__doc__, scenes="folder of the scene collection")
