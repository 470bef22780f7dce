#!/usr/bin/env python3
"""Whether objects exist as often as maps claim, and how their sizes differ when they do not.

  existence.py RUN...   each RUN is a folder of quadmap-slam and RUN.json, what quadmap-evaluate --json
                        made of it

For all objects that a run came to think of, map with these options:

  [CQuadricObjectMap_insertOpts]
  falseAlarmSpread = 1
  confirmLogOdds = -1000
  minObservations = 1
  minPartial = 1

An object is true when the evaluation paired it with one of the truth. Sizes count when measurements
told more than half of their variance, in spreads of the label.
"""
import configparser
import json
import math
import pathlib
import sys

LABELS = pathlib.Path(__file__).resolve().parents[2] / "share/quadmap/labels.ini"
BOUNDS = (-math.inf, -1, 0, 1, 2.2, 4, 6, math.inf)


def label_sizes():
    """{label: (typical size [m], spread)}"""
    table = configparser.ConfigParser(inline_comment_prefixes=("#", ";"))
    table.read(LABELS)
    return {name: ([float(size) for size in table[name]["typicalSize"].split()], float(table[name]["sizeSpread"]))
            for name in table.sections() if "typicalSize" in table[name]}


def deviations(entry, typical, spread):
    """Of the sizes that were measured, in spreads."""
    size = entry["size"]
    x, y, z = typical
    if (size[0] - size[1]) * (x - y) < 0:
        x, y = y, x
    variances = [entry["covariance"][i][i] for i in (4, 5, 6)]
    return [math.log(s / t) / spread for s, t, v in zip(size, (x, y, z), variances) if v < 0.5 * spread**2]


def main():
    if len(sys.argv) < 2 or sys.argv[1] in ("-h", "--help"):
        sys.exit(__doc__)
    sizes, claims, squares = label_sizes(), [], {True: [], False: []}
    for run in map(pathlib.Path, sys.argv[1:]):
        true = {match["id"] for match in json.loads(pathlib.Path(f"{run}.json").read_text()).get("matches", [])}
        for entry in json.loads((run / "objects.json").read_text())["objects"]:
            exists = entry["id"] in true
            claim = min(max(entry["existence"], 1e-9), 1 - 1e-9)
            claims.append((math.log(claim / (1 - claim)), exists))
            if entry["label"] in sizes:
                squares[exists] += [d * d for d in deviations(entry, *sizes[entry["label"]])]
    print("log-odds of existence      objects  true")
    for low, high in zip(BOUNDS, BOUNDS[1:]):
        inside = [exists for odds, exists in claims if low <= odds < high]
        if inside:
            print(f"{low:8.1f} to {high:8.1f} {len(inside):12d}  {sum(inside) / len(inside):.2f}")
    for exists, name in ((True, "true"), (False, "false")):
        if squares[exists]:
            rms = math.sqrt(sum(squares[exists]) / len(squares[exists]))
            print(f"sizes of {name} objects are off by {rms:.2f} spreads of their label (RMS of {len(squares[exists])})")


if __name__ == "__main__":
    main()
