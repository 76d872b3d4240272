#!/usr/bin/env python3
"""colours.py SVG: how far apart the fills of a picture are for eyes that see all colours, or lack one
of the three kinds of cones: for each, the least distance in CIELAB of any two.

The cones' loss is simulated by the matrices of Machado, Oliveira and Fernandes, A Physiologically-based
Model for Simulation of Color Vision Deficiency, 2009, at full severity."""
import itertools
import re
import sys

EYES = {
    "all": ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "no-long": ((0.152286, 1.052583, -0.204868), (0.114503, 0.786281, 0.099216),
                (-0.003882, -0.048116, 1.051998)),
    "no-middle": ((0.367322, 0.860646, -0.227968), (0.280085, 0.672501, 0.047413),
                  (-0.011820, 0.042940, 0.968881)),
    "no-short": ((1.255528, -0.076749, -0.178779), (-0.078411, 0.930809, 0.147602),
                 (0.004733, 0.691367, 0.303900)),
}


def times(matrix, v):
    return [sum(m * x for m, x in zip(row, v)) for row in matrix]


def lab(colour, eye):
    linear = [((v + 0.055) / 1.055) ** 2.4 if v > 0.04045 else v / 12.92 for v in colour]
    seen = [min(1, max(0, v)) for v in times(eye, linear)]
    xyz = times(((0.4124, 0.3576, 0.1805), (0.2126, 0.7152, 0.0722), (0.0193, 0.1192, 0.9505)), seen)
    f = [t ** (1 / 3) if t > 0.008856 else 7.787 * t + 16 / 116
         for t in (v / w for v, w in zip(xyz, (0.9505, 1, 1.089)))]
    return 116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])


fills = set()
for text in re.findall(r'fill[:=]"?rgb\(([^)]*)\)', open(sys.argv[1], encoding="utf-8").read()):
    fills.add(tuple(float(v.rstrip("% ")) / 100 for v in text.split(",")))
fills.discard((1, 1, 1))
fills = [f for f in fills if sum(f) > 0.5]  # wires and text
print(len(fills), end="")
for eye in EYES.values():
    seen = [lab(f, eye) for f in fills]
    least = min(sum((a - b) ** 2 for a, b in zip(p, q)) ** 0.5 for p, q in itertools.combinations(seen, 2))
    print(" %.1f" % least, end="")
print()
