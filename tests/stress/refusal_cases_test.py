#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Cases 13, 15 and 31 of the stress matrix: what cannot be rendered is refused by the program, with and without mpirun,
in one line with the place, with a code other than 0, and no picture is left behind. Nothing hangs."""

import itertools
import pathlib
import struct
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "app"))

import running_program  # noqa: E402
from running_program import BAD_SCENE, USAGE  # noqa: E402
from verdict import Verdict  # noqa: E402

NOT_FINITE = ["nan", "inf", "-inf"]
CRITERION = "one line with the place, code not 0, no output file, no hang"

# Every number that a scene can hold; one key a line, so that each has a line number to be named.
SCENE = """format = 1
[image]
width = 8
height = 6
samples = 1
max_bounces = 2
[camera]
eye = [0, -4, 2]
target = [0, 0, 0]
up = [0, 0, 1]
fov = 40
[environment]
ambient = [1, 1, 1]
background = [0, 0, 0]
[[light]]
position = [3, -3, 5]
color = [1, 1, 1]
intensity = 1
[[light]]
direction = [1, 1, -1]
[material.grey]
color = [1, 1, 1]
ambient = 0.1
diffuse = 0.9
specular = 0.5
shininess = 20
reflection = 0.5
[[sphere]]
center = [0, 0, 0]
radius = 1
[[plane]]
point = [0, 0, -1]
normal = [0, 0, 1]
checker_material = "grey"
checker_size = 1
"""
FLAT = SCENE.replace("fov = 40", "height = 3")
FLAKE = SCENE + '[generate]\nkind = "sphereflake"\nlevel = 1\ncenter = [0, 0, 0]\nradius = 1\n'
CLOUD = SCENE + '[generate]\nkind = "cloud"\ncount = 5\nseed = 1\nfill = 0.1\ncenter = [0, 0, 0]\nscale = 1\n'
TABLE = SCENE + "[[spheres]]\nfile = \"FILE\"\n"
TACHYON = """BEGIN_SCENE
RESOLUTION 8 6
CAMERA ZOOM 1 ASPECTRATIO 1 ANTIALIASING 0 RAYDEPTH 2
CENTER 0 0 -5
VIEWDIR 0 0 1
UPDIR 0 1 0 END_CAMERA
BACKGROUND 0 0 0
LIGHT CENTER 3 3 -5 RAD 0.1 COLOR 1 1 1
DIRECTIONAL_LIGHT DIRECTION 1 1 1 COLOR 1 1 1
SPHERE CENTER 0 0 0 RAD 1
TEXTURE AMBIENT 0.1 DIFFUSE 0.9 SPECULAR 0 OPACITY 1 COLOR 1 1 1 TEXFUNC 0
PLANE CENTER 0 -1 0 NORMAL 0 1 0
TEXTURE AMBIENT 0.1 DIFFUSE 0.9 SPECULAR 0 OPACITY 1 COLOR 1 1 1 TEXFUNC 0
END_SCENE
"""
COLUMNS = ["x", "y", "z", "radius", "red", "green", "blue"]


def is_number(word):
    return word.lstrip("-").replace(".", "").isdigit()


def with_line(scene, line, text):
    """The scene with another line of that number, from 1 on."""
    lines = scene.splitlines()
    lines[line - 1] = text
    return "\n".join(lines) + "\n"


def line_of(scene, start):
    return next(i for i, text in enumerate(scene.splitlines(), 1) if text.startswith(start))


def with_bad_numbers(scene, bad):
    """(scene, line, key) for each number of the scene in turn, replaced by each of `bad`."""
    for line, text in enumerate(scene.splitlines(), 1):
        key, _, value = text.partition(" = ")
        if not value or value.startswith('"'):
            continue
        numbers = value.strip("[]").split(", ")
        for at, word in itertools.product(range(len(numbers)), bad):
            changed = ", ".join(word if i == at else number for i, number in enumerate(numbers))
            yield with_line(scene, line, f"{key} = [{changed}]" if "[" in value else f"{key} = {changed}"), line, key


def with_bad_words(scene, bad):
    """(scene, line) for each number of a Tachyon scene in turn, replaced by each of `bad`."""
    for line, text in enumerate(scene.splitlines(), 1):
        words = text.split()
        for at, word in itertools.product(filter(lambda i: is_number(words[i]), range(len(words))), bad):
            yield with_line(scene, line, " ".join([*words[:at], word, *words[at + 1:]])), line


class RefusalCases(running_program.ProgramTest):
    def setUp(self):
        super().setUp()
        self.wrong, self.tried = [], {0: 0, 2: 0}

    def look(self, ranks, code, words, says):
        """Notes what is not refused as it should be."""
        before = set(self.folder.iterdir())
        run = self.run_tessera(*words, ranks=ranks)
        lines = self.own_lines(run)
        self.tried[ranks] += 1
        if (run.returncode != code or len(lines) != 1 or run.stdout or set(self.folder.iterdir()) != before
                or not all(part in lines[0] for part in says)):
            self.wrong.append(f"{ranks} ranks, {' '.join(map(str, words))}, expected {code} {says}: "
                              f"{run.returncode} {run.stderr.strip()}")

    def refused(self, text, line, key, ranks=(0,), name="bad.toml"):
        scene = self.write(name, text)
        for count in ranks:
            self.look(count, BAD_SCENE, ["render", scene, "-o", "out.png"], [f"{name}:{line}:", key])

    def tachyon_refused(self, old, new, line, key):
        self.refused(TACHYON.replace(old, new), line, key, name="bad.dat")

    def table_refused(self, name, content, says, ranks=(0,)):
        """As INPUT, and named by a scene."""
        table = self.write(name, content)
        scene = self.write("scene.toml", TABLE.replace("FILE", name))
        for count in ranks:
            for path in (table, scene):
                self.look(count, BAD_SCENE, ["render", path, "-o", "out.png"], says)

    def text_table_refused(self, column, word, ranks=(0,)):
        row = ["0", "1", "2", "0.5", "1", "1", "1"]
        row[column] = word
        self.table_refused("bad.txt", "0 0 0 1 1 1 1\n" + " ".join(row) + "\n", ["bad.txt:2:", COLUMNS[column]], ranks)

    def binary_table_refused(self, column, number, ranks=(0,)):
        row = [0, 1, 2, 0.5]
        row[column] = number
        self.table_refused("bad.bin", struct.pack("<8d", 0, 0, 0, 1, *row), ["bad.bin: row 2:", COLUMNS[column]], ranks)

    def command_line_refused(self, option, value, ranks=(0,)):
        good = self.write("good.toml", SCENE)
        for count in ranks:
            self.look(count, USAGE, ["render", good, "-o", "out.png", f"{option}={value}"], [option.lstrip("-")])

    def report(self, verdict):
        verdict.none_wrong(f"inputs not refused ({self.tried[0]} alone, {self.tried[2]} by mpirun -n 2)", self.wrong,
                           sum(self.tried.values()))

    def test_the_scene_itself_renders(self):
        scenes = [("good.toml", scene) for scene in (SCENE, FLAT, FLAKE, CLOUD)] + [("good.dat", TACHYON)]
        for name, scene in scenes:
            run = self.run_tessera("render", self.write(name, scene), "-o", "out.png", "-q")
            self.assertEqual(run.returncode, 0, run.stderr)

    def test_case_13_zero_directions_and_numbers_that_are_not_finite(self):
        with Verdict(13, "zero directions, NaN and inf in any field: " + CRITERION) as verdict:
            for key in ("direction", "normal", "up"):
                line = line_of(SCENE, key)
                self.refused(with_line(SCENE, line, f"{key} = [0, 0, 0]"), line, key,
                             ranks=(0, 2) if key == "normal" else (0,))
                self.refused(with_line(SCENE, line, f"{key} = [0, -0.0, 0.0]"), line, key)
            for text, line, key in with_bad_numbers(SCENE, NOT_FINITE):
                self.refused(text, line, key, ranks=(0, 2) if "[nan, 0, 0]" in text and key == "center" else (0,))
            for scene, own in ((FLAT, ["height"]), (FLAKE, ["level", "center", "radius"]),
                               (CLOUD, ["count", "seed", "fill", "center", "scale"])):
                for text, line, key in with_bad_numbers(scene, NOT_FINITE):
                    if key in own and (scene == FLAT or line > len(SCENE.splitlines())):
                        self.refused(text, line, key)
            for text, line in with_bad_words(TACHYON, NOT_FINITE):
                self.refused(text, line, "", name="bad.dat")
            # What a camera lacks is found at its end and named where it begins.
            self.tachyon_refused("VIEWDIR 0 0 1", "VIEWDIR 0 0 0", 3, "view direction")
            self.tachyon_refused("UPDIR 0 1 0", "UPDIR 0 0 0", 3, "up")
            self.tachyon_refused("DIRECTION 1 1 1", "DIRECTION 0 0 0", 9, "direction")
            self.tachyon_refused("NORMAL 0 1 0", "NORMAL 0 0 0", 12, "normal")
            for column, word in itertools.product(range(len(COLUMNS)), [*NOT_FINITE, "1e999"]):
                self.text_table_refused(column, word, ranks=(0, 2) if (column, word) == (1, "nan") else (0,))
            for column, word in itertools.product(range(4), NOT_FINITE):
                self.binary_table_refused(column, float(word), ranks=(0, 2) if (column, word) == (2, "nan") else (0,))
            for word in NOT_FINITE:
                for option, value in [("--resolution", f"{word}x8"), ("--resolution", f"8x{word}"), ("--spp", word),
                                      ("--max-bounces", word), ("--crop", f"0,0,{word},2"), ("--crop", f"{word},0,2,2"),
                                      ("--bits", word), ("--tile-size", word), ("--prefetch", word)]:
                    self.command_line_refused(option, value, ranks=(0, 2) if (option, value) == ("--spp", "nan") else (0,))
                self.look(0, USAGE, ["compare", "a.pfm", "b.pfm", f"--tolerance={word}"], ["--tolerance"])
            self.report(verdict)

    def test_case_15_radii_that_are_none(self):
        with Verdict(15, "radius < 0, NaN, inf: " + CRITERION) as verdict:
            line = line_of(SCENE, "radius")
            for word in [*NOT_FINITE, "-1", "-1e-300", "-5e-324"]:
                ranks = (0, 2) if word == "-1" else (0,)
                self.refused(with_line(SCENE, line, f"radius = {word}"), line, "radius", ranks)
                self.text_table_refused(3, word)
                self.tachyon_refused("RAD 1\n", f"RAD {word}\n", 10, "")
                self.binary_table_refused(3, float(word), ranks)
            self.report(verdict)

    def test_case_31_cameras_and_sizes(self):
        with Verdict(31, "up parallel to view, eye = target, fov, sizes 0: " + CRITERION
                     + "; 1x1, 1x10000 render") as verdict:
            for up in ("[0, 4, -2]", "[0, -2, 1]", "[0, 4e-9, -2e-9]", "[0, -2e12, 1e12]"):
                text = with_line(SCENE, line_of(SCENE, "up"), f"up = {up}")
                self.refused(text, line_of(SCENE, "up"), "parallel", ranks=(0, 2) if up == "[0, 4, -2]" else (0,))
            text = with_line(SCENE, line_of(SCENE, "target"), "target = [0, -4, 2]")
            self.refused(text, line_of(SCENE, "eye"), "same point", ranks=(0, 2))
            self.tachyon_refused("UPDIR 0 1 0", "UPDIR 0 0 1", 3, "parallel")
            self.tachyon_refused("RESOLUTION 8 6", "RESOLUTION 0 6", 2, "width")
            line = line_of(SCENE, "fov")
            for fov in ("0", "-0.0", "-1", "-1e-300", "180", "180.00000000000003", "360", "1e300"):
                self.refused(with_line(SCENE, line, f"fov = {fov}"), line, "fov", ranks=(0, 2) if fov == "180" else (0,))
            for key, size in itertools.product(("width", "height"), ("0", "-1", "1.5", "65537", "4294967297")):
                line = line_of(SCENE, key)
                self.refused(with_line(SCENE, line, f"{key} = {size}"), line, key, ranks=(0, 2) if (key, size) == ("width", "0") else (0,))
            for size in ("0x8", "8x0", "0x0", "-1x8", "1.5x8", "4294967297x8"):
                self.command_line_refused("--resolution", size, ranks=(0, 2) if size == "0x0" else (0,))
            self.command_line_refused("--crop", "0,0,0,2")
            self.report(verdict)
            self.sizes_render(verdict)

    def sizes_render(self, verdict):
        scene = self.write("good.toml", SCENE)
        bad, tried = [], 0
        for width, height in [(1, 1), (1, 10000), (10000, 1)]:
            pictures = []
            for ranks in (0, 2):
                run = self.run_tessera("render", scene, "-r", f"{width}x{height}", "-o", "out.ppm", "-q", ranks=ranks)
                tried += 1
                pictures.append((self.folder / "out.ppm").read_bytes() if run.returncode == 0 else run.stderr)
                header = f"P6\n{width} {height}\n255\n".encode()
                if pictures[-1] != pictures[0] or len(pictures[-1]) != len(header) + 3 * width * height:
                    bad.append(f"{width}x{height}, {ranks} ranks: {pictures[-1][:80]}")
        verdict.none_wrong("sizes not rendered", bad, tried)


if __name__ == "__main__":
    running_program.main(__doc__)
