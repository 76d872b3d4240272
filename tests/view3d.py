#!/usr/bin/env python3
"""view3d.py PAGE: what a page of hmdraw -3 holds, read by the description in encode.c and scene_write.c
and not by the page's own code, as lines

    mesh NAME NODES ELEMENTS
    v NUMBER X Y Z FLAGS OWNER
    t|q NUMBER NODE ... MATERIAL RESIDUAL-CLASS N RMS WORST
    line KIND VERTICES"""
import base64
import json
import re
import sys

page = open(sys.argv[1], encoding="utf-8").read()
info = json.loads(re.search(r'<script type="application/json" id="scene">(.*?)</script>', page, re.S)[1])


def numbers(name):
    """Unsigned numbers of a block."""
    text = re.search(r'<script type="text/plain" id="data-%s">([^<]*)</script>' % name, page)[1]
    v = shift = 0
    for byte in base64.b64decode(text, validate=True):
        v |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            yield v
            v = shift = 0
    assert shift == 0


def signed(v):
    return -(v + 1) // 2 if v & 1 else v // 2


def runs(source, n):
    out = []
    while len(out) < n:
        out += [next(source)] * next(source)
    assert len(out) == n
    return out


def ascending(source, n):
    out, at = [], 0
    while len(out) < n:
        at += next(source)
        count = next(source)
        out += range(at, at + count)
        at += count
    assert len(out) == n
    return out


nodes = sum(m["nodes"] for m in info["meshes"])
elements = sum(m["elements"] for m in info["meshes"])

places, last = [], [0, 0, 0]
for k, v in enumerate(numbers("nodes")):
    last[k % 3] += signed(v)
    if k % 3 == 2:
        places.append([o + s * p for o, s, p in zip(info["origin"], info["step"], last)])
assert len(places) == nodes

marks = numbers("marks")
flags, owners = runs(marks, nodes), runs(marks, nodes)
corners = runs(numbers("corners"), elements)
source, first, element = numbers("elements"), 0, []
for n in corners:
    first += signed(next(source))
    element.append([first] + [first + signed(next(source)) for _ in range(n - 1)])
classes = [runs(numbers("classes-%d" % k), elements) for k in range(len(info["colourings"]))]

residuals, source, k = {}, numbers("residuals"), 0
for gap in source:
    k += gap
    residuals[k] = next(source), next(source) * 1e-4, signed(next(source)) * 1e-4

source, node_number, element_number = numbers("numbers"), [], []
for m in info["meshes"]:
    print("mesh", m["name"], m["nodes"], m["elements"])
    node_number += ascending(source, m["nodes"])
    element_number += ascending(source, m["elements"])
for k in range(nodes):
    print("v", node_number[k], *("%.4f" % c for c in places[k]), flags[k], owners[k])
for k in range(elements):
    texts = [info["colourings"][c]["classes"][classes[c][k]]["text"] for c in range(len(classes))]
    n, rms, worst = residuals.get(k, (0, 0, 0))
    print("tq"[corners[k] - 3], element_number[k], *(node_number[c] for c in element[k]), texts[0].replace(" ", "_"),
          (texts[2] if len(texts) > 2 else "-").replace(" ", "_"), n, "%.4f" % rms, "%.4f" % worst)
source = numbers("lines")
for kind in info["lines"]:
    for _ in range(kind["count"]):
        n = next(source)
        for _ in range(3 * n):
            next(source)
        print("line", kind["text"].replace(" ", "_"), n)
