#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The scenes that scripts/compare_peers.py measures ray tracers on.

Writes them as TOML with their sphere tables beside them: scripts/peer_scenes.py FOLDER [NAME ...]. The first four are
the ones that everybody knows; the others put the cost where those do not. All have three lights, mirrors of k = 0.3 and
five bounces unless they say otherwise. Random numbers are seeded: the same scenes every time.
"""

import argparse
import dataclasses
import math
import pathlib
import random

BACKGROUND = (0.078, 0.361, 0.753)
LIGHTS = [("position", place) for place in ((4, 3, 6), (1, -4, 4), (-3, 1, 5))]
INTENSITY = 0.35
LIGHTS_INSIDE = [("position", place) for place in ((0.35, 0.2, 0.3), (-0.4, 0.5, -0.1), (0.1, -0.45, 0.6))]
MATERIALS = [f"m{i}" for i in range(8)]
FLAKE_EYE = (2.1, 1.3, 1.7)
CLOUD_EYE = (2.6, 1.9, 2.2)


@dataclasses.dataclass
class Scene:
    """What a scene has beside lights and materials; a sphere is (x, y, z, radius, material)."""

    about: str
    eye: tuple = CLOUD_EYE
    target: tuple = (0, 0, 0)
    height: float = 0  # orthographic where it is not 0
    lights: list = dataclasses.field(default_factory=lambda: LIGHTS)
    generate: dict = dataclasses.field(default_factory=dict)
    plane: bool = False  # z = 0, in material m0
    spheres: list = dataclasses.field(default_factory=list)


def cloud_of(count, rng, gaps=()):
    """Spheres at random in [-1, 1]^3 as [generate] makes them, but none at a point of `gaps`."""
    largest = 0.7 * count ** (-1 / 3)
    spheres = []
    while len(spheres) != count:
        x, y, z = (rng.uniform(-1, 1) for _ in range(3))
        r = largest * rng.uniform(0.3, 1)
        if all(math.dist((x, y, z), gap) > r + 0.03 for gap in gaps):
            spheres.append((x, y, z, r, rng.choice(MATERIALS)))
    return spheres


def in_disc(radius, rng):
    """A point of the disc, everywhere as likely."""
    distance, angle = radius * math.sqrt(rng.random()), rng.uniform(0, 2 * math.pi)
    return distance * math.cos(angle), distance * math.sin(angle)


def flake(level, eye=FLAKE_EYE):
    return lambda: Scene(f"sphereflake of {level} levels", eye, generate={"kind": "sphereflake", "level": level})


def cloud(count):
    return lambda: Scene(f"{count} spheres at random", generate={"kind": "cloud", "count": count, "seed": 1})


def lights_inside():
    """Every light sees spheres on all sides, and most shadow rays are short."""
    places = [place for _, place in LIGHTS_INSIDE]
    return Scene("10000 spheres around the lights", lights=LIGHTS_INSIDE,
                 spheres=cloud_of(10_000, random.Random(2), places))


def eye_inside():
    """No ray misses for long: the eye is in the middle, the lights around it."""
    eye = (0, 0, 0)
    places = [place for _, place in LIGHTS_INSIDE]
    return Scene("100000 spheres around eye and lights", eye, (1, 0.6, -0.2), lights=LIGHTS_INSIDE,
                 spheres=cloud_of(100_000, random.Random(3), [eye, *places]))


def carpet():
    """Small spheres on a huge one under two large mirrors: the light's view is filled by three spheres."""
    rng = random.Random(4)
    huge = 100
    spheres = [(0, 0, -huge, huge, "m0"), (-0.75, 0.2, 1.1, 0.6, "mirror"), (0.75, -0.1, 1.3, 0.7, "mirror")]
    for _ in range(20_000):
        x, y = in_disc(2.5, rng)
        r = rng.uniform(0.006, 0.02)
        scale = (huge + r) / math.hypot(x, y, huge)
        spheres.append((scale * x, scale * y, scale * huge - huge, r, rng.choice(MATERIALS)))
    return Scene("20000 spheres on one huge one, two mirrors", (0.4, -4, 2.4), (0, 0, 0.5), spheres=spheres)


def six_decades():
    """Radii from 0.3 down to 0.0000003, more of them the smaller they are."""
    rng = random.Random(5)
    spheres = []
    for _ in range(20_000):
        x, y, z = (rng.uniform(-1, 1) for _ in range(3))
        spheres.append((x, y, z, 0.3 * 10 ** (-6 * rng.random() ** 0.4), rng.choice(MATERIALS)))
    return Scene("20000 spheres, radii over six decades", (1.7, 1.2, 1.4), spheres=spheres)


def corner():
    """Nearly all the cost in one corner of the picture."""
    rng = random.Random(6)
    spheres = [(-0.75 + 0.22 * x, y * 0.22, 0.72 + 0.22 * z, 0.22 * r, m) for x, y, z, r, m in cloud_of(50_000, rng)]
    spheres += [(1.2 * x, 1.2 * y, 1.2 * z, r / 3, m) for x, y, z, r, m in cloud_of(300, rng)]
    return Scene("50000 spheres in one corner, 300 elsewhere", (0, -3.2, 0), spheres=spheres)


def field():
    """Spheres resting on an infinite mirror plane."""
    rng = random.Random(7)
    spheres = []
    for _ in range(30_000):
        x, y = in_disc(3, rng)
        r = rng.uniform(0.006, 0.03)
        spheres.append((x, y, r, r, rng.choice(MATERIALS)))
    return Scene("30000 spheres resting on a plane", (0.5, -3.4, 1.3), (0, -0.4, 0), plane=True, spheres=spheres)


def lattice():
    """Touching spheres in a regular grid, as in a crystal: no gaps, long grazing mirror paths."""
    side = 46
    step = 2 / side
    places = [-1 + step * (i + 0.5) for i in range(side)]
    spheres = [(x, y, z, step / 2, MATERIALS[(i + j + k) % 2]) for i, x in enumerate(places)
               for j, y in enumerate(places) for k, z in enumerate(places)]
    return Scene("97336 spheres touching in a grid", spheres=spheres)


def parallel():
    """Parallel camera rays and parallel light."""
    directions = [(-4, -3, -6), (-1, 4, -4), (3, -1, -5)]
    return Scene("50000 spheres, orthographic, directional lights", height=3.2,
                 lights=[("direction", direction) for direction in directions],
                 generate={"kind": "cloud", "count": 50_000, "seed": 8})


SCENES = {
    "flake4": flake(4),
    "flake6": flake(6),
    "cloud10k": cloud(10_000),
    "cloud1m": cloud(1_000_000),
    "lights_inside": lights_inside,
    "eye_inside": eye_inside,
    "flake5_below": flake(5, (-1.5, -1.6, -0.9)),
    "carpet": carpet,
    "six_decades": six_decades,
    "corner": corner,
    "field": field,
    "lattice": lattice,
    "parallel": parallel,
}


def array(values):
    return "[" + ", ".join(repr(value) for value in values) + "]"


def quoted(value):
    return f'"{value}"' if isinstance(value, str) else repr(value)


def material_lines():
    rng = random.Random(0)
    shading = "ambient = 0.1\ndiffuse = 0.8\nspecular = 0.5\nshininess = 50"
    for name in MATERIALS:
        color = [round(rng.uniform(0.15, 1), 3) for _ in range(3)]
        yield f"[material.{name}]\ncolor = {array(color)}\n{shading}\nreflection = 0.3\n"
    yield f"[material.mirror]\ncolor = [0.9, 0.9, 0.9]\n{shading}\nreflection = 0.9\n"


def write_scene(name, folder, size):
    """Writes folder/name.toml, and folder/name.txt where the spheres are not [generate]d; returns the TOML's path."""
    scene = SCENES[name]()
    view = f"height = {scene.height}" if scene.height else "fov = 45"
    parts = [f"# {scene.about}\nformat = 1\n",
             f'[image]\nwidth = {size[0]}\nheight = {size[1]}\nmax_bounces = 5\ntransfer = "none"\n',
             f"[camera]\neye = {array(scene.eye)}\ntarget = {array(scene.target)}\n{view}\n",
             f"[environment]\nbackground = {array(BACKGROUND)}\n"]
    parts += [f"[[light]]\n{kind} = {array(vector)}\nintensity = {INTENSITY}\n" for kind, vector in scene.lights]
    parts += material_lines()
    if scene.plane:
        parts.append('[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nmaterial = "m0"\n')
    if scene.generate:
        parts.append("[generate]\n" + "".join(f"{key} = {quoted(value)}\n" for key, value in scene.generate.items())
                     + "materials = [" + ", ".join(map(quoted, MATERIALS)) + "]\n")
    if scene.spheres:
        parts.append(f'[[spheres]]\nfile = "{name}.txt"\n')
        rows = ("{!r} {!r} {!r} {!r} {}\n".format(*sphere) for sphere in scene.spheres)
        (folder / f"{name}.txt").write_text("".join(rows))
    path = folder / f"{name}.toml"
    path.write_text("\n".join(parts))
    return path


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, metavar="FOLDER", help="made if it is not there")
    parser.add_argument("names", nargs="*", metavar="NAME", help="default: all; " + ", ".join(SCENES))
    options = parser.parse_args(words)
    for name in options.names:
        if name not in SCENES:
            parser.error(f"there is no scene {name}, use {', '.join(SCENES)}")
    return options


def main(words=None):
    options = parse(words)
    options.folder.mkdir(parents=True, exist_ok=True)
    for name in options.names or SCENES:
        print(write_scene(name, options.folder, (1024, 1024)))


if __name__ == "__main__":
    main()
