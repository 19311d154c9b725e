# SPDX-License-Identifier: BSD-3-Clause
"""The ray tracers of scripts/compare_peers.py behind one interface: their commands, their times, their pictures."""

import dataclasses
import json
import pathlib
import re
import shutil
import subprocess


class ProgramError(Exception):
    """A program that did not do what it was asked to, in one line."""


@dataclasses.dataclass(frozen=True)
class Run:
    """One rendering. Seconds as the program itself measures them, reading and writing files left out."""

    render_s: float
    build_s: float  # the tree; POV-Ray: its bounding hierarchy, parsing left out
    rays: int  # 0 where the program does not say


@dataclasses.dataclass(frozen=True)
class Ppm:
    width: int
    height: int
    pixels: bytes


def read_ppm(path):
    """A binary PPM with one byte a channel."""
    data = path.read_bytes()
    header = re.match(rb"P6\s+(?:#.*\s)*(\d+)\s+(\d+)\s+255\s", data)
    if not header:
        raise ProgramError(f"{path}: not a PPM with 8 bits")
    return Ppm(int(header[1]), int(header[2]), data[header.end():])


def write_ppm(path, picture):
    path.write_bytes(b"P6\n%d %d\n255\n" % (picture.width, picture.height) + picture.pixels)


def execute(command):
    """Runs a command and returns what it says on stdout and stderr."""
    command = list(map(str, command))
    try:
        run = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False)
    except OSError as error:
        raise ProgramError(f"{command[0]}: {error.strerror}") from error
    if run.returncode != 0:
        last = (run.stderr.strip() or run.stdout.strip() or "no message").splitlines()[-1]
        raise ProgramError(f"{' '.join(command[:3])} ...: exit code {run.returncode}: {last}")
    return run.stdout, run.stderr


def seconds_after(pattern, text, program):
    match = re.search(pattern + r"\s*([\d.]+)", text)
    if not match:
        raise ProgramError(f"{program} did not print its times")
    return float(match[1])


class Program:
    """A ray tracer. `stem` is the scene's TOML without its ending; what a program writes begins with it too."""

    name = ""
    peer = ""  # as --peers calls it
    package = ""  # the command that must be there
    is_slow = False

    def is_installed(self):
        return shutil.which(self.package) is not None

    def convert(self, tessera, stem):
        """Writes the scene in the program's own language."""

    def render(self, stem, size):
        """Renders once. Returns a Run; picture(stem) is the picture."""
        raise NotImplementedError

    def picture(self, stem):
        return pathlib.Path(f"{stem}.{self.name.replace(' ', '_')}.ppm")

    def comparable(self, stem):
        """(picture, how many times smaller it is than the one that was timed), our sample points and orientation."""
        return self.picture(stem), 1


class Tessera(Program):
    name = "tessera"

    def __init__(self, path):
        self.package = str(path)

    def render(self, stem, size):
        return self.draw(stem, size, self.picture(stem))

    def draw(self, stem, size, picture):
        stats = pathlib.Path(f"{stem}.stats.json")
        execute([self.package, "render", f"{stem}.toml", "-q", "-o", picture, "--stats", stats, "--resolution",
                 f"{size[0]}x{size[1]}"])
        found = json.loads(stats.read_text())
        return Run(found["time_s"]["render"], found["time_s"]["build"], sum(found["rays"].values()))

    def sphere_count(self, stem):
        return json.loads(pathlib.Path(f"{stem}.stats.json").read_text())["scene"]["spheres"]

    def rmse(self, ours, theirs):
        """Of linear channels: the scenes have no transfer curve."""
        text = subprocess.run([self.package, "compare", "--json", ours, theirs], capture_output=True, text=True,
                              check=False)
        try:
            return float(json.loads(text.stdout)["rmse"])
        except (ValueError, KeyError) as error:
            raise ProgramError(f"cannot compare {ours} with {theirs}: {text.stderr.strip()}") from error


class Embree(Program):
    """bench/embree_render: the same scene files and the same camera rays."""

    peer = "embree"

    def __init__(self, path, mode):
        self.package = str(path)
        self.mode = mode
        self.name = f"embree {mode}"

    def render(self, stem, size):
        out, _ = execute([self.package, f"{stem}.toml", "--mode", self.mode, "-o", self.picture(stem), "--resolution",
                          f"{size[0]}x{size[1]}"])
        found = json.loads(out)
        return Run(found["render_s"], found["build_s"], sum(found["rays"].values()))


class Tachyon(Program):
    name = peer = package = "tachyon"

    def convert(self, tessera, stem):
        execute([tessera, "convert", f"{stem}.toml", "-o", f"{stem}.dat"])

    def render(self, stem, size):
        self.picture(stem).unlink(missing_ok=True)
        out, _ = execute([self.package, f"{stem}.dat", "-numthreads", "1", "-fullshade", "-shade_phong", "-format",
                          "PPM", "-res", size[0], size[1], "-o", self.picture(stem)])
        return Run(seconds_after("Ray Tracing Time:", out, self.name),
                   seconds_after("Preprocessing Time:", out, self.name), 0)

    def comparable(self, stem):
        """Tachyon's pictures are mirrored and sampled half a pixel off the centres: row 2 y + 1 and column 2 x are what
        we see at half the size."""
        picture = read_ppm(self.picture(stem))
        width, height = picture.width // 2, picture.height // 2
        rows = []
        for y in range(height):
            theirs = picture.pixels[3 * (2 * y + 1) * picture.width:3 * (2 * y + 2) * picture.width]
            ours = bytearray(3 * width)
            for channel in range(3):
                ours[channel::3] = theirs[channel::6][::-1]
            rows.append(bytes(ours))
        path = self.picture(stem).with_suffix(".half.ppm")
        write_ppm(path, Ppm(width, height, b"".join(rows)))
        return path, 2


class PovRay(Program):
    name = peer = package = "povray"
    is_slow = True

    def convert(self, tessera, stem):
        execute([tessera, "convert", f"{stem}.toml", "-o", f"{stem}.pov"])

    def render(self, stem, size):
        _, log = execute([self.package, f"+I{stem}.pov", f"+O{self.picture(stem)}", "+FP8", f"+W{size[0]}",
                          f"+H{size[1]}", "-D", "+WT1", "-A", "-P", "File_Gamma=1.0"])
        return Run(seconds_after(r"Trace Time:[^(]*\(", log, self.name),
                   seconds_after(r"Bounding Time:[^(]*\(", log, self.name), 0)
