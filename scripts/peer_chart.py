#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the CSV of scripts/compare_peers.py as bars: scripts/peer_chart.py RESULTS.csv CHART.png.

A bar says how many times our render time a peer needed; of Embree's modes the better one is drawn. Debian's Python, for
which python3-matplotlib is.
"""

import sys

from peer_summary import OURS, best_of_each_peer, read_csv, summarize

try:
    import matplotlib
except ImportError:
    sys.exit("no chart: python3-matplotlib is not installed (scripts/install_packages.sh peers)")

matplotlib.use("Agg")
from matplotlib import pyplot, ticker  # noqa: E402  the backend comes first

COLORS = {"embree": "#4477aa", "tachyon": "#ccbb44", "povray": "#aa3377"}


def draw(summaries, path):
    best = best_of_each_peer(summaries)
    scenes = list(dict.fromkeys(s.scene for s in summaries))
    peers = [peer for peer in dict.fromkeys(peer for _, peer in best) if peer != OURS]
    width = 0.8 / len(peers)
    figure, axes = pyplot.subplots(figsize=(2 + len(scenes), 4.5))
    for i, peer in enumerate(peers):
        places = [x + (i - (len(peers) - 1) / 2) * width for x in range(len(scenes))]
        ratios = [best[scene, peer].ratio for scene in scenes]
        # Bars grow from 1, so that losing points down.
        bars = axes.bar(places, [ratio - 1 for ratio in ratios], width, bottom=1, label=peer, color=COLORS.get(peer))
        axes.bar_label(bars, [f"{ratio:.2g}" for ratio in ratios], fontsize=8, padding=2)
    axes.axhline(1, color="black", linewidth=1)
    axes.set_yscale("log")
    axes.yaxis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
    axes.yaxis.set_major_formatter("{x:g}")
    axes.yaxis.set_minor_locator(ticker.NullLocator())
    axes.set_ylabel("render time / Tessera's, one core")
    axes.set_xticks(range(len(scenes)), [f"{s}\n{best[s, OURS].spheres:,}" for s in scenes], fontsize=8)
    axes.set_xlabel("scene and its spheres")
    axes.legend()
    axes.margins(y=0.15)
    figure.tight_layout()
    figure.savefig(path, dpi=150)


def main(words):
    if len(words) != 2:
        sys.exit(__doc__)
    summaries = summarize(read_csv(words[0]))
    if all(s.program == OURS for s in summaries):
        sys.exit("no chart: no peer was measured")
    draw(summaries, words[1])


if __name__ == "__main__":
    main(sys.argv[1:])
