#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures Tessera side by side with Embree, Tachyon and POV-Ray: same scenes, same rays, one core each.

Writes the scenes of scripts/peer_scenes.py, converts them for every program, and renders each with all programs in
turn, several rounds over, another one going first each time, all on the same core. Then checks that all pictures agree
and exits with 1 where they do not. A peer that is not installed is left out.

  render     median of the seconds that the program itself reports for its pixels; no reading, building or writing
  spread     (slowest - fastest) / median
  build      median of the seconds for the tree; for Tachyon preprocessing, for POV-Ray bounding
  RMSE       of the picture to ours, linear channels; edges of subpixel spheres are what is left of it
  peer/ours  median over the rounds of the peer's render time / ours in the same round: above 1 we are faster.
             Embree renders in two modes; the one marked * has the better median on the scene and counts
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import peer_programs
import peer_scenes
import peer_summary

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "bench"
PEERS = ["embree", "tachyon", "povray"]
LARGEST_RMSE = 0.02


def build():
    """Builds what is measured, as users are told to."""
    log = []
    for command in (["cmake", "--preset", "bench"], ["cmake", "--build", "--preset", "bench"]):
        try:
            run = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
        except OSError as error:
            raise peer_programs.ProgramError(f"cmake: {error.strerror} (scripts/install_packages.sh)") from error
        log += run.stdout.splitlines()
        if run.returncode != 0:
            raise peer_programs.ProgramError("the build failed:\n" + "\n".join(log[-20:]) + run.stderr)


def programs_of(options):
    """Tessera and every peer that is asked for and there."""
    ours = peer_programs.Tessera(options.tessera or BUILD / "tessera")
    embree = options.embree or BUILD / "bench" / "embree_render"
    peers = [peer_programs.Embree(embree, "single"), peer_programs.Embree(embree, "packets"), peer_programs.Tachyon(),
             peer_programs.PovRay()]
    if not ours.is_installed():
        raise peer_programs.ProgramError(f"{ours.package} is not there")
    missing = [peer.peer for peer in peers if peer.peer in options.peers and not peer.is_installed()]
    for name in dict.fromkeys(missing):
        print(f"{name} is left out: it is not installed (scripts/install_packages.sh peers)")
    return ours, [peer for peer in peers if peer.peer in options.peers and peer.peer not in missing]


def measure(stem, ours, peers, options):
    """The rows of a scene, all rounds of all programs."""
    programs = [ours, *peers]
    rows = []
    for number in range(options.rounds):
        # Another program goes first each round: what ran before leaves the machine warmer or colder.
        turn = number % len(programs)
        for program in programs[turn:] + programs[:turn]:
            if program.is_slow and number >= options.slow_rounds:
                continue
            run = program.render(stem, options.resolution)
            rows.append({"scene": stem.name, "program": program.name, "round": number, "render_s": run.render_s,
                         "build_s": run.build_s, "rays": run.rays, "spheres": 0, "rmse": 0.0})
    order = [program.name for program in programs]
    rows.sort(key=lambda row: (order.index(row["program"]), row["round"]))
    return rows


def check_pictures(stem, ours, peers, options):
    """{name: RMSE to our picture} for all peers."""
    errors = {}
    for peer in peers:
        theirs, factor = peer.comparable(stem)
        picture = ours.picture(stem)
        if factor != 1:
            picture = picture.with_suffix(f".by{factor}.ppm")
            ours.draw(stem, [length // factor for length in options.resolution], picture)
        errors[peer.name] = ours.rmse(picture, theirs)
    return errors


def compare(name, ours, peers, folder, options):
    stem = peer_scenes.write_scene(name, folder, options.resolution).with_suffix("")
    for peer in peers:
        peer.convert(ours.package, stem)
    rows = measure(stem, ours, peers, options)
    spheres = ours.sphere_count(stem)
    errors = check_pictures(stem, ours, peers, options)
    for row in rows:
        row.update(spheres=spheres, rmse=errors.get(row["program"], 0.0))
    return rows, [f"{name}: {peer} is off by an RMSE of {error:.4f}" for peer, error in errors.items()
                  if not error <= LARGEST_RMSE]


def run(options):
    if not options.tessera or ("embree" in options.peers and not options.embree):
        build()
    ours, peers = programs_of(options)
    core = max(os.sched_getaffinity(0))
    os.sched_setaffinity(0, {core})  # the programs inherit it
    rows, wrong = [], []
    for name in options.scenes:
        with tempfile.TemporaryDirectory() as temporary:
            of_scene, wrong_here = compare(name, ours, peers, options.folder or pathlib.Path(temporary), options)
        rows += of_scene
        wrong += wrong_here
        print("\n" + peer_summary.table(peer_summary.summarize(of_scene)), flush=True)
        if options.csv:
            peer_summary.write_csv(options.csv, rows)  # what is measured stays if a later scene fails
    if peers:
        print("\n" + peer_summary.overview(peer_summary.summarize(rows)))
    if options.chart:
        with tempfile.TemporaryDirectory() as temporary:
            table = pathlib.Path(temporary) / "rows.csv"
            peer_summary.write_csv(table, rows)
            subprocess.run([ROOT / "scripts" / "peer_chart.py", table, options.chart], check=False)
    for message in wrong:
        print(f"compare_peers: {message} (more than {LARGEST_RMSE})", file=sys.stderr)
    return 1 if wrong else 0


def names_in(text, known, parser, option):
    names = text.split(",")
    for name in names:
        if name not in known:
            parser.error(f"{option}: \"{name}\" is none of {', '.join(known)}")
    return names


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tessera", type=pathlib.Path, metavar="PATH", help="default: built in build/bench")
    parser.add_argument("--embree", type=pathlib.Path, metavar="PATH",
                        help="embree_render; default: built in build/bench")
    parser.add_argument("--scenes", default=",".join(peer_scenes.SCENES), metavar="NAME,...",
                        help="default: all of scripts/peer_scenes.py")
    parser.add_argument("--peers", default=",".join(PEERS), metavar="NAME,...", help="[%(default)s]")
    parser.add_argument("--rounds", type=int, default=7, metavar="N", help="[%(default)s]")
    parser.add_argument("--slow-rounds", type=int, default=1, metavar="N", help="of POV-Ray [%(default)s]")
    parser.add_argument("--resolution", default="1024x1024", metavar="WxH", help="[%(default)s]")
    parser.add_argument("--folder", type=pathlib.Path, metavar="DIR", help="keep scenes and pictures there")
    parser.add_argument("--csv", type=pathlib.Path, metavar="FILE", help="write all runs")
    parser.add_argument("--chart", type=pathlib.Path, metavar="FILE.png", help="draw the ratios")
    options = parser.parse_args(words)
    options.scenes = names_in(options.scenes, list(peer_scenes.SCENES), parser, "--scenes")
    options.peers = names_in(options.peers, PEERS, parser, "--peers")
    if min(options.rounds, options.slow_rounds) < 1:
        parser.error("--rounds and --slow-rounds must be at least 1")
    size = re.fullmatch(r"(\d+)x(\d+)", options.resolution)
    options.resolution = size and [int(size[1]), int(size[2])]
    if not size or any(length < 2 or length % 2 for length in options.resolution):
        parser.error("--resolution must be WxH, both even (half of Tachyon's sample points are ours)")
    for path in (options.folder, options.csv, options.chart):
        if path:
            (path if path is options.folder else path.parent).mkdir(parents=True, exist_ok=True)
    return options


def main(words):
    options = parse(words)
    try:
        return run(options)
    except peer_programs.ProgramError as error:
        sys.exit(f"compare_peers: {error}")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
