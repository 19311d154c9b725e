#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""No tolerance, shift or smallest distance in what traces a ray: the files named here hold no small decimal number and
nothing that is called like one. (Powers of two such as 0x1p-53 are roundoffs of proven error bounds.)"""
import pathlib
import re
import sys

TRACING = """bounded bvh certified decide dyadic entry_points entry_points_avx2 exact exact_formula float_search_avx2
frustum frustum_avx2 intersect light_cells light_cells_avx2 light_grid order path_observer perpendicular_avx2 phong
plane raster raster_avx2 ray ray_counts region scene search shading shading_avx2 signature signature_observer sphere
stream stream_avx2 tile_renderer tracer traversal_avx2 tree_space vec3 vec3_avx2 vec3_lanes vertex
vertices wavefront""".split()
SMALL = re.compile(r"\b\d+(?:\.\d*)?e-\d+|\b0\.0\d*", re.IGNORECASE)
NAMED = re.compile(r"epsilon|\beps\b|\bt_?min\b|tolerance|\bbias\b|\bnudge", re.IGNORECASE)


def offences(text):
    for number, line in enumerate(text.splitlines(), 1):
        code = line.split("//")[0]
        for found in (SMALL.search(code), NAMED.search(code)):
            # 0.0 itself is zero, not small.
            if found and not re.fullmatch(r"0\.0+", found.group()):
                yield number, line.strip()


def main():
    # The check itself must be able to fail.
    assert list(offences("if (t > 1e-9) return;")) and list(offences("double kEpsilon = 1;"))
    assert not list(offences("return {0.0, 0x1p-53, 1e30};  // 1e-9"))
    files = [f for f in sorted(pathlib.Path(sys.argv[1]).glob("*.*")) if f.stem in TRACING and f.suffix in (".h", ".cpp")]
    assert len({f.stem for f in files}) == len(TRACING), "a file of the tracing path is missing"
    found = [f"{f.name}:{number}: {line}" for f in files for number, line in offences(f.read_text())]
    print("\n".join(found) or f"{len(files)} files without a tolerance")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
