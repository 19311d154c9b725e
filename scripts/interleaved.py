# SPDX-License-Identifier: BSD-3-Clause
"""Two ways to render the same scenes in turn, so that whatever else the machine does hits both alike: what the scripts
that compare such have in common."""

import pathlib
import statistics
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


def measure(ways, rounds, render):
    """What render(way, folder) gave each round for both of `ways`, and all the different pictures.

    render returns a measurement and the picture's bytes; the folder is a temporary one.
    """
    runs = {way: [] for way in ways}
    pictures = set()
    with tempfile.TemporaryDirectory() as folder:
        for round_number in range(rounds):
            # Who goes first changes: the second of a pair may find the machine warmer.
            for way in list(runs)[:: 1 if round_number % 2 == 0 else -1]:
                measurement, picture = render(way, pathlib.Path(folder))
                runs[way].append(measurement)
                pictures.add(picture)
    return [runs[way] for way in ways], pictures


def cells(seconds):
    """Median and spread of some runs, as a table shows them; the spread is (max - min) / median."""
    median = statistics.median(seconds)
    return f"{median:.3f} s", f"{(max(seconds) - min(seconds)) / median:.0%}"


def add_arguments(parser):
    """Which scenes, how often and how large."""
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="default: all of scenes/")
    parser.add_argument("--repeat", type=int, default=7, metavar="N", help="rounds [%(default)s]")
    parser.add_argument("--resolution", metavar="WxH", help="instead of the scene's own")


def scenes_of(options):
    return options.scenes or sorted((ROOT / "scenes").glob("*.toml"))


def table(header, scenes, compare, cell_width):
    """Prints a line a scene, its name before what compare(scene) gives: cells, and the pictures.

    Returns whether all pictures of each scene are the same.
    """
    width = max(len(pathlib.Path(scene).stem) for scene in scenes)

    def line(name, row):
        print(name.ljust(width) + "".join(f"  {cell:>{cell_width}}" for cell in row), flush=True)

    line("scene", [*header, "picture"])
    all_same = True
    for scene in scenes:
        row, pictures = compare(scene)
        all_same = all_same and len(pictures) == 1
        line(pathlib.Path(scene).stem, [*row, "same" if len(pictures) == 1 else "OTHER"])
    return all_same
