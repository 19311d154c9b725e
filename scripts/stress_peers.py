#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What Tachyon and POV-Ray (Debian packages tachyon, povray) make of cases 1, 2, 20, 22 and 39 of the stress matrix.

Writes each scene in the languages of all programs, renders small linear pictures with one sample a pixel, and counts
wrong pixels: those that differ by more than 0.05 from the reference at their own place and at all eight neighbours'. The
reference of cases 1 and 39 is a closed form, that of the others Tessera's picture, which test_stress holds to quad
precision. A program that is not installed is left out. Prints rows as scripts/stress.sh does; exits with 0 always.
"""

import argparse
import dataclasses
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TOLERANCE = 0.05
TIME_LIMIT_S = 120
AMBIENT, DIFFUSE = 0.1, 0.9


@dataclasses.dataclass
class Scene:
    """White matte spheres seen along the line from eye to target; `half` is half the picture at distance 1."""
    spheres: list  # (center, radius)
    lights: list  # ("point" or "directional", vector, intensity)
    eye: tuple = (0, -5, 0)
    target: tuple = (0, 0, 0)
    half: float = 0.25
    background: float = 0.0
    diffuse: float = DIFFUSE


def text(vector, separator=" "):
    return separator.join(repr(float(x)) for x in vector)


def unit(v):
    length = math.hypot(*v)
    return tuple(x / length for x in v)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def view_of(scene):
    """Forward, right and up, of length 1."""
    forward = unit([t - e for t, e in zip(scene.target, scene.eye)])
    right = unit(cross(forward, (0, 0, 1)))
    return forward, right, cross(right, forward)


def run(command, folder):
    environment = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    try:
        subprocess.run(list(map(str, command)), cwd=folder, env=environment, capture_output=True, timeout=TIME_LIMIT_S,
                       check=False)
    except subprocess.TimeoutExpired:
        pass


def red_channel(path):
    """Width and values in [0, 1] of a binary PPM, or None where there is no picture."""
    data = path.read_bytes() if path.exists() else b""
    header = re.match(rb"P6\s+(?:#.*\s)*(\d+)\s+(\d+)\s+255\s", data)
    return header and (int(header[1]), [value / 255 for value in data[header.end()::3]])


class Tessera:
    name = "tessera"
    handedness = "right"

    def __init__(self, program):
        self.program = program

    def scene_text(self, scene, side):
        lines = [f"[image]\nwidth = {side}\nheight = {side}", "[camera]", f"eye = [{text(scene.eye, ', ')}]",
                 f"target = [{text(scene.target, ', ')}]", f"fov = {math.degrees(2 * math.atan(scene.half))!r}",
                 f'handedness = "{self.handedness}"',
                 f"[environment]\nbackground = [{text([scene.background] * 3, ', ')}]",
                 f"[material.white]\ncolor = [1, 1, 1]\nambient = {AMBIENT}\ndiffuse = {scene.diffuse!r}"]
        for kind, vector, intensity in scene.lights:
            key = "position" if kind == "point" else "direction"
            lines.append(f"[[light]]\n{key} = [{text(vector, ', ')}]\nintensity = {intensity!r}")
        for center, radius in scene.spheres:
            lines.append(f"[[sphere]]\ncenter = [{text(center, ', ')}]\nradius = {float(radius)!r}\nmaterial = \"white\"")
        return "\n".join(lines) + "\n"

    def picture(self, scene, side, folder):
        (folder / "scene.toml").write_text(self.scene_text(scene, side))
        run([self.program, "render", "scene.toml", "-o", "out.ppm", "--transfer", "none", "-q"], folder)
        picture = red_channel(folder / "out.ppm")
        return picture and picture[1]


class LeftHandedTessera(Tessera):
    """Draws as Tachyon does, whose pictures are mirrored."""
    handedness = "left"


class Tachyon:
    name = "tachyon"
    reference = LeftHandedTessera

    def scene_text(self, scene, side):
        forward, _, up = view_of(scene)
        lines = ["BEGIN_SCENE", f"RESOLUTION {side} {side}", f"CAMERA ZOOM {0.5 / scene.half!r} ASPECTRATIO 1",
                 f"ANTIALIASING 0 RAYDEPTH 3 CENTER {text(scene.eye)} VIEWDIR {text(forward)} UPDIR {text(up)}",
                 f"END_CAMERA\nBACKGROUND {text([scene.background] * 3)}"]
        for kind, vector, intensity in scene.lights:
            place = f"LIGHT CENTER {text(vector)} RAD 1e-9" if kind == "point" else \
                f"DIRECTIONAL_LIGHT DIRECTION {text(vector)}"
            lines.append(f"{place} COLOR {text([intensity] * 3)}")
        for center, radius in scene.spheres:
            lines.append(f"SPHERE CENTER {text(center)} RAD {float(radius)!r} TEXTURE AMBIENT {AMBIENT} DIFFUSE {scene.diffuse!r} "
                         "SPECULAR 0 OPACITY 1 COLOR 1 1 1 TEXFUNC 0")
        return "\n".join([*lines, "END_SCENE"]) + "\n"

    def picture(self, scene, side, folder):
        """Tachyon samples half a pixel off the centres: at twice the size, these pixels are ours."""
        (folder / "scene.dat").write_text(self.scene_text(scene, 2 * side))
        run(["tachyon", "scene.dat", "-fullshade", "-shade_phong", "-numthreads", "1", "-format", "PPM", "-o",
             "tachyon.ppm"], folder)
        picture = red_channel(folder / "tachyon.ppm")
        if picture is None:
            return None
        return [picture[1][(2 * y + 1) * 2 * side + 2 * x] for y in range(side) for x in range(side)]


class PovRay:
    name = "povray"
    reference = Tessera

    def scene_text(self, scene, side):
        def vector(v):
            return f"<{text(v, ', ')}>"

        forward, right, up = view_of(scene)
        size = [2 * scene.half] * 3
        lines = ["#version 3.7;", "global_settings { assumed_gamma 1 max_trace_level 3 }",
                 f"background {{ rgb {scene.background} }}",
                 f"camera {{ location {vector(scene.eye)} direction {vector(forward)} "
                 f"right {vector([s * x for s, x in zip(size, right)])} up {vector([s * x for s, x in zip(size, up)])} }}"]
        for kind, place, intensity in scene.lights:
            if kind == "point":
                lines.append(f"light_source {{ {vector(place)} rgb {intensity!r} }}")
            else:
                lines.append(f"light_source {{ {vector([-100 * x for x in place])} rgb {intensity!r} parallel "
                             "point_at <0, 0, 0> }")
        for center, radius in scene.spheres:
            lines.append(f"sphere {{ {vector(center)}, {float(radius)!r} pigment {{ rgb 1 }} "
                         f"finish {{ ambient {AMBIENT} diffuse {scene.diffuse!r} }} }}")
        return "\n".join(lines) + "\n"

    def picture(self, scene, side, folder):
        (folder / "scene.pov").write_text(self.scene_text(scene, side))
        run(["povray", "-D", "-A", "+Iscene.pov", "+Opovray.ppm", "+FP8", f"+W{side}", f"+H{side}", "+WT1",
             "File_Gamma=1.0"], folder)
        picture = red_channel(folder / "povray.ppm")
        return picture and picture[1]


def count_wrong(picture, reference, side):
    """Pixels that are not as the reference is there or next to it."""
    def is_near(x, y):
        around = [(u, v) for v in (y, y - 1, y + 1) for u in (x, x - 1, x + 1) if 0 <= u < side and 0 <= v < side]
        return any(abs(picture[y * side + x] - reference[v * side + u]) <= TOLERANCE for u, v in around)

    return sum(not is_near(x, y) for y in range(side) for x in range(side))


def lit_from_the_eye(distance, half, side):
    """The closed form of case 1: ambient + diffuse sqrt(1 - b^2), b being how far a ray passes from the centre."""
    values = []
    for y, x in ((y, x) for y in range(side) for x in range(side)):
        slope = half * math.hypot((2 * x + 1) / side - 1, (2 * y + 1) / side - 1)
        passing = distance * slope / math.hypot(1, slope)
        values.append(AMBIENT + DIFFUSE * math.sqrt(1 - passing**2) if passing <= 1 else 0)
    return values


def case_1(_):
    """(label, scene, side, reference) for each picture of the case; no reference means Tessera's picture."""
    for k in range(0, 13, 2):
        distance, half = 1.5 if k == 0 else 10.0**k, 0.8 if k == 0 else 1.25 / 10.0**k
        eye = (0, -distance, 0)
        yield f"1e{k}", Scene([((0, 0, 0), 1)], [("point", eye, 1.0)], eye, half=half), 64, \
            lit_from_the_eye(distance, half, 64)


def case_2(tessera):
    def sphere(r):
        return Scene([((0, 0, 0), r)], [("point", (3 * r, -9 * r, 4 * r), 1.0)], (0, -10 * r, 0), half=0.12)

    one = tessera(sphere(1.0), 64)
    for k in (-150, -12, -9, -6, -5, -3, 3, 6, 8, 9, 12, 150):
        yield f"1e{k}", sphere(10.0**k), 64, one


def case_20(_):
    for k in range(0, 13, 3):
        width = 10.0**-k
        spheres = [((-1, 0, 0), 1), ((1, 0, 0), 1)]
        yield f"width 1e-{k}", Scene(spheres, [("point", (0.3, -5, 1), 1.0)], (0, -4, 1), (0, 0, 0), width / 8), 64, None


def case_22(_):
    for k in (2, 3, 4, 5, 6, 8, 10, 12):
        q = 10.0**-k
        spheres = [((0, 0, 0), 1), ((0, 0, 1 + q), q)]
        yield f"1e-{k}", Scene(spheres, [("point", (-2, 2, 4), 1.0)], (2, -1, 3), (0, 0, 1), 4 * q / 3), 64, None


def case_39(_):
    ball = [((0, 0, 0), 1)]
    yield "no spheres", Scene([], [("point", (0, -9, 0), 1.0)], background=0.5), 16, [0.5] * 256
    yield "no lights", Scene(ball, [], half=0.1), 16, [AMBIENT] * 256
    many = [("directional", (0, 1, 0), 0.5 / 10000)] * 10000
    yield "10,000 lights", Scene(ball, many, half=1e-3), 16, [AMBIENT + 0.5 * DIFFUSE] * 256
    many = [("directional", (0, 1, 0), 1.0)] * 10000
    yield "the weight in the material", Scene(ball, many, half=1e-3, diffuse=0.5 / 10000), 16, [AMBIENT + 0.5] * 256


CASES = [
    (1, "D/r: no wrong pixel against the closed form", case_1),
    (2, "radius at D/r = 10: the same picture", case_2),
    (20, "contact of two spheres, zoomed in: as Tessera", case_20),
    (22, "shadow of a tiny sphere on a unit sphere: as Tessera", case_22),
    (39, "background; ambient; 10,000 lights of 1/20,000", case_39),
]


def measure(program, tessera, pictures):
    """What there is to say about one case, and whether it passes."""
    found, passes = [], True
    with tempfile.TemporaryDirectory() as name:
        for label, scene, side, reference in pictures:
            folder = pathlib.Path(tempfile.mkdtemp(dir=name))
            picture = program.picture(scene, side, folder)
            reference = reference or tessera.picture(scene, side, folder)
            wrong = count_wrong(picture, reference, side) if picture and len(picture) == side * side else None
            found.append(f"{label}: {'no picture' if wrong is None else wrong}")
            passes = passes and wrong == 0
    return f"wrong pixels of {side * side}: {', '.join(found)}", passes


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tessera", default=ROOT / "build" / "release" / "tessera", metavar="PATH")
    options = parser.parse_args()
    if not os.path.isfile(options.tessera):
        sys.exit(f"stress_peers: {options.tessera} is not there; build it or name it with --tessera")
    program = pathlib.Path(options.tessera).resolve()
    for peer in (Tachyon(), PovRay()):
        if shutil.which(peer.name) is None:
            print(f"{peer.name}: not installed (apt-get install {peer.name}), left out")
            continue
        print(f"{peer.name}:")
        tessera = peer.reference(program)
        with tempfile.TemporaryDirectory() as folder:
            for number, criterion, pictures in CASES:
                reference = lambda scene, side: tessera.picture(scene, side, pathlib.Path(folder))  # noqa: E731
                measured, passes = measure(peer, tessera, pictures(reference))
                print(f"{number:4}  {'pass' if passes else 'FAIL'}  {criterion}\n            {measured}", flush=True)


if __name__ == "__main__":
    main()
