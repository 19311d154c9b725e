# SPDX-License-Identifier: BSD-3-Clause
"""What the rows of scripts/compare_peers.py say, one row being one program's run in one round on one scene."""

import csv
import dataclasses
import statistics

OURS = "tessera"
FIELDS = ["scene", "spheres", "program", "round", "render_s", "build_s", "rays", "rmse"]


@dataclasses.dataclass(frozen=True)
class Summary:
    """A program on a scene, over all rounds."""

    scene: str
    spheres: int
    program: str
    runs: int
    render_s: float  # median
    spread: float  # (slowest - fastest) / median
    build_s: float  # median
    ratio: float  # median over the rounds of this render time / ours of the same round
    rays: int
    rmse: float  # of its picture to ours


def write_csv(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=FIELDS)
        writer.writeheader()
        writer.writerows(rows)


def read_csv(path):
    kinds = {"spheres": int, "round": int, "render_s": float, "build_s": float, "rays": int, "rmse": float}
    with open(path, newline="") as file:
        return [{field: kinds.get(field, str)(value) for field, value in row.items()} for row in csv.DictReader(file)]


def summarize(rows):
    """A Summary per scene and program, in the order in which they first come."""
    ours = {(row["scene"], row["round"]): row["render_s"] for row in rows if row["program"] == OURS}
    groups = {}
    for row in rows:
        groups.setdefault((row["scene"], row["program"]), []).append(row)
    summaries = []
    for (scene, program), runs in groups.items():
        times = [run["render_s"] for run in runs]
        median = statistics.median(times)
        summaries.append(Summary(
            scene, runs[0]["spheres"], program, len(runs), median, (max(times) - min(times)) / median,
            statistics.median(run["build_s"] for run in runs),
            statistics.median(run["render_s"] / ours[scene, run["round"]] for run in runs), runs[0]["rays"],
            runs[0]["rmse"]))
    return summaries


def best_of_each_peer(summaries):
    """{(scene, peer): Summary}: of several modes of a peer ("embree single") the one with the least median."""
    best = {}
    for summary in summaries:
        key = (summary.scene, summary.program.split()[0])
        if key not in best or summary.render_s < best[key].render_s:
            best[key] = summary
    return best


HEAD = ["program", "render", "spread", "runs", "build", "rays", "RMSE", "peer/ours"]


def line(cells):
    return cells[0].ljust(16) + "".join(cell.rjust(11) for cell in cells[1:])


def table(summaries):
    """One scene as text; `*` marks the mode that counts for a peer with several."""
    best = best_of_each_peer(summaries)
    lines = [f"{summaries[0].scene}, {summaries[0].spheres} spheres", line(HEAD)]
    for s in summaries:
        is_mode = " " in s.program
        is_best = best[s.scene, s.program.split()[0]] is s
        lines.append(line([
            s.program, f"{s.render_s:.3f} s", f"{s.spread:.1%}" if s.runs > 1 else "", str(s.runs),
            f"{s.build_s:.3f} s", str(s.rays or ""), f"{s.rmse:.4f}" if s.program != OURS else "",
            f"{s.ratio:.2f}{'*' if is_mode and is_best else ' '}" if s.program != OURS else ""]))
    return "\n".join(lines)


def overview(summaries):
    """The best ratio of every peer on every scene."""
    best = best_of_each_peer(summaries)
    scenes = list(dict.fromkeys(s.scene for s in summaries))
    peers = [peer for peer in dict.fromkeys(peer for _, peer in best) if peer != OURS]
    lines = [line(["peer/ours", *peers])]
    for scene in scenes:
        lines.append(line([scene] + [f"{best[scene, peer].ratio:.2f}" for peer in peers]))
    return "\n".join(lines)
