#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares our pictures of Tachyon scenes with Tachyon's own (Debian package tachyon).

Tachyon samples half a pixel off the centres. Its picture at twice the size, row 2 y + 1 and column 2 x, holds exactly
our sample points, so the two can be compared pixel by pixel. Prints for each scene the share of pixels whose largest
channel difference is at most 2/255, and what our reader said it had to leave out.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILDS = [ROOT / "build" / preset / "tessera" for preset in ("release", "demo")]
DEFAULT_SCENES = ["balls", "820spheres", "smallballs", "2balls", "trypsin4pti", "gridtest", "dna"]
CLOSE = 2  # of 255


def fail(message):
    sys.exit(f"compare_tachyon: {message}")


def read_ppm(path):
    """(width, height, bytes) of a binary PPM with one byte a channel."""
    data = path.read_bytes()
    header = re.match(rb"P6\s+(?:#.*\s)*(\d+)\s+(\d+)\s+255\s", data)
    if not header:
        fail(f"{path}: not a PPM with 8 bits")
    return int(header[1]), int(header[2]), data[header.end():]


def our_picture(tessera, scene, folder):
    """Our picture and what the reader noted."""
    output = folder / "ours.ppm"
    environment = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    run = subprocess.run(["mpirun", "-n", "2", "--oversubscribe", tessera, "render", scene, "-o", output],
                         env=environment, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        fail(run.stderr.strip())
    return read_ppm(output), [line for line in run.stderr.splitlines() if line.startswith("note:")]


def tachyon_picture(scene, size, folder):
    """Tachyon's picture at twice the size. Its textures are found from the scene's own folder."""
    output = folder / "tachyon.ppm"
    command = ["tachyon", scene.name, "-fullshade", "-shade_phong", "-numthreads", "1", "-format", "PPM",
               "-res", str(2 * size[0]), str(2 * size[1]), "-o", output]
    try:
        subprocess.run(list(map(str, command)), cwd=scene.parent, capture_output=True, check=False)
    except FileNotFoundError:
        fail("tachyon is not installed (Debian package tachyon)")
    picture = read_ppm(output) if output.exists() else None
    if picture is None or picture[:2] != (2 * size[0], 2 * size[1]):
        fail(f"tachyon made no picture of {scene} with {2 * size[0]}x{2 * size[1]} pixels")
    return picture


def largest_differences(ours, theirs):
    """Per pixel the largest difference of a channel, over our sample points."""
    width, height, our_bytes = ours
    their_width, _, their_bytes = theirs
    for y in range(height):
        for x in range(width):
            a, b = 3 * (y * width + x), 3 * ((2 * y + 1) * their_width + 2 * x)
            yield max(abs(our_bytes[a + c] - their_bytes[b + c]) for c in range(3))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="Tachyon .dat files; default: seven of tachyon-doc")
    parser.add_argument("--tessera", default=next(filter(pathlib.Path.exists, BUILDS), BUILDS[0]), metavar="PATH")
    options = parser.parse_args()
    if not os.path.isfile(options.tessera):
        fail(f"{options.tessera} is not there; build it with scripts/demo.sh or name it with --tessera")
    scenes = [pathlib.Path(scene).resolve() for scene in options.scenes]
    if not scenes:
        folder = subprocess.run([ROOT / "scripts" / "tachyon_scenes.sh"], capture_output=True, text=True, check=True)
        scenes = [pathlib.Path(folder.stdout.strip()) / f"{name}.dat" for name in DEFAULT_SCENES]
    for scene in scenes:
        with tempfile.TemporaryDirectory() as name:
            ours, notes = our_picture(options.tessera, scene, pathlib.Path(name))
            theirs = tachyon_picture(scene, ours[:2], pathlib.Path(name))
            differences = list(largest_differences(ours, theirs))
        close = sum(d <= CLOSE for d in differences) / len(differences)
        print(f"{scene.stem:14} {ours[0]}x{ours[1]}  within {CLOSE}/255: {close:7.2%}  largest: {max(differences)}")
        for note in notes:
            print(f"    {note}")


if __name__ == "__main__":
    main()
