#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Rows of grow.py as a picture: seconds over hexahedra, both logarithmic, a line a shape, as SVG.

usage: plot.py ROWS.jsonl OUT.svg [--what total_s|peak_mib]
"""
import argparse
import json
import math
import pathlib

WIDE, HIGH, LEFT, BELOW = 760, 480, 70, 50
COLOURS = ["#1b6ca8", "#c8553d", "#3c8d53", "#7d4fa3", "#a07a17", "#2a9d9d", "#8a5a44", "#555555", "#b03a7a"]
TITLES = {"total_s": "processor seconds, closing to file", "peak_mib": "peak memory, MiB"}


def decades(values):
    low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
    return low, max(high, low + 1)


def power(points):
    """The power that time grows by over the larger half of the rows, by least squares of the logarithms."""
    points = sorted(points)[len(points) // 2 - 1 if len(points) > 2 else 0:]
    xs, ys = zip(*((math.log(x), math.log(y)) for x, y in points))
    middle_x, middle_y = sum(xs) / len(xs), sum(ys) / len(ys)
    spread = sum((x - middle_x) ** 2 for x in xs)
    return sum((x - middle_x) * (y - middle_y) for x, y in zip(xs, ys)) / spread if spread else float("nan")


def draw(rows, what):
    value = {"total_s": lambda r: r["processor_seconds"]["total"], "peak_mib": lambda r: r["peak_mib"]}[what]
    lines = {}
    for row in rows:
        lines.setdefault(row["shape"], []).append((row["hexes"], max(value(row), 1e-4)))
    (x0, x1), (y0, y1) = (decades([p[k] for line in lines.values() for p in line]) for k in (0, 1))

    def at(x, y):
        return (LEFT + (math.log10(x) - x0) / (x1 - x0) * (WIDE - LEFT - 190),
                HIGH - BELOW - (math.log10(y) - y0) / (y1 - y0) * (HIGH - BELOW - 30))

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDE}" height="{HIGH}" font-family="sans-serif" '
             'font-size="12"><rect width="100%" height="100%" fill="white"/>']

    def line(a, b, style):
        parts.append(f'<line x1="{a[0]:.1f}" y1="{a[1]:.1f}" x2="{b[0]:.1f}" y2="{b[1]:.1f}" {style}/>')

    def text(x, y, words, anchor="middle", style=""):
        parts.append(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" {style}>{words}</text>')

    for k in range(x0, x1 + 1):
        line(at(10**k, 10**y0), at(10**k, 10**y1), 'stroke="#ddd"')
        text(at(10**k, 10**y0)[0], HIGH - BELOW + 18, f"1e{k}")
    for k in range(y0, y1 + 1):
        line(at(10**x0, 10**k), at(10**x1, 10**k), 'stroke="#ddd"')
        text(LEFT - 8, at(10**x0, 10**k)[1] + 4, f"1e{k}", "end")
    text((LEFT + WIDE - 190) / 2, HIGH - 12, "hexahedra")
    text(LEFT, 18, TITLES[what], "start")
    for colour, (shape, points) in zip(COLOURS, sorted(lines.items(), key=lambda item: -max(item[1])[1])):
        placed = [at(*p) for p in sorted(points)]
        parts.append(f'<polyline fill="none" stroke="{colour}" stroke-width="2" points="'
                     + " ".join(f"{x:.1f},{y:.1f}" for x, y in placed) + '"/>')
        parts.extend(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>' for x, y in placed)
        label = f"{shape}: power {power(points):.2f}" if len(points) > 1 else shape
        row = 40 + 18 * list(sorted(lines, key=lambda name: -max(lines[name])[1])).index(shape)
        parts.append(f'<rect x="{WIDE - 178}" y="{row - 9}" width="10" height="10" fill="{colour}"/>')
        text(WIDE - 162, row, label, "start")
    return "\n".join(parts) + "\n</svg>\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rows")
    parser.add_argument("picture")
    parser.add_argument("--what", choices=TITLES, default="total_s")
    options = parser.parse_args()
    rows = [json.loads(line) for line in pathlib.Path(options.rows).read_text().splitlines() if line.strip()]
    rows = [row for row in rows if "failed" not in row]
    pathlib.Path(options.picture).write_text(draw(rows, options.what))


if __name__ == "__main__":
    main()
