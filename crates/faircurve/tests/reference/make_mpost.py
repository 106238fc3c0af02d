#!/usr/bin/env python3
"""Makes mpost.json: random paths, and the control points that MetaPost gives them.

    python3 make_mpost.py > mpost.json       needs mpost (Debian's texlive-metapost)

Knots have tensions (negative: at least), curls, directions and corners, as in a document.
"""

import json
import math
import os
import random
import subprocess
import tempfile

random.seed(1986)
PATHS = 48


def rounded(number):
    return float(f"{number:.6g}")


def tension():
    size = rounded(random.choice([0.75, 1.0, random.uniform(0.75, 3.0), random.uniform(0.75, 50.0)]))
    return size * random.choice([1, 1, -1])


def direction():
    angle = random.uniform(-math.pi, math.pi)
    return [rounded(math.cos(angle)), rounded(math.sin(angle))]


def path(index):
    count = [2, 3, 4, 5, 8, 12][index % 6]
    closed = index % 2 == 1 and count > 2
    scale = 10.0 ** random.randint(-3, 4)
    knots = []
    for _ in range(count):
        knot = {"x": rounded(random.uniform(-1, 1) * scale), "y": rounded(random.uniform(-1, 1) * scale)}
        for name in ("tension_in", "tension_out"):
            if random.random() < 0.3:
                knot[name] = tension()
        if random.random() < 0.3:
            knot["curl"] = rounded(random.choice([0.0, random.uniform(0, 3), 1000.0]))
        if random.random() < 0.15:
            knot["tangent_in"] = knot["tangent_out"] = direction()
        elif random.random() < 0.2:
            knot["join"] = "corner"
            for name in ("tangent_in", "tangent_out"):
                if random.random() < 0.4:
                    knot[name] = direction()
        knots.append(knot)
    avoid_wrong_curls(knots, closed)
    return {"closed": closed, "knots": knots}


def avoid_wrong_curls(knots, closed):
    """MetaPost's double arithmetic has a slip in the curl of ends whose tension is less than that at
    the segment's other end (its scaled arithmetic, and METAFONT, have it right): no such ends."""
    last = len(knots) - 1
    for i, knot in enumerate(knots):
        for name, beyond, other in (("out", i + 1, "tension_in"), ("in", i - 1, "tension_out")):
            is_end = not closed and i == (0 if name == "out" else last)
            is_other_end = not closed and i == (last if name == "out" else 0)
            if is_other_end or "}" not in side(knot, name, is_end) or "tangent_" + name in knot:
                continue
            other = knots[beyond % len(knots)].get(other, 1.0)
            if abs(knot.get("tension_" + name, 1.0)) < abs(other):
                knot["tension_" + name] = other


def number(value):
    return f"{value:.12f}"


def side(knot, name, is_end):
    """What stands in braces before or after a knot."""
    given = knot.get("tangent_" + name)
    if given:
        return "{(" + number(given[0]) + "," + number(given[1]) + ")}"
    if is_end or knot.get("join") == "corner":
        return "{curl " + number(knot.get("curl", 1.0)) + "}"
    return ""


def at_least(value):
    return ("atleast " if value < 0 else "") + number(abs(value))


def metapost(path):
    knots, closed = path["knots"], path["closed"]
    text = ""
    for i, knot in enumerate(knots):
        before = "" if i == 0 else side(knot, "in", not closed and i == len(knots) - 1)
        is_last = i == len(knots) - 1
        after = "" if is_last and not closed else side(knot, "out", not closed and i == 0)
        text += before + f"({number(knot['x'])},{number(knot['y'])})" + after
        if not is_last or closed:
            next_knot = knots[(i + 1) % len(knots)]
            tensions = (knot.get("tension_out", 1.0), next_knot.get("tension_in", 1.0))
            text += "\n  ..tension " + " and ".join(map(at_least, tensions)) + ".."
    if closed:
        text += side(knots[0], "in", False) + "cycle"
    return text


def solve(paths):
    lines = ["path p; string s;"]
    for path in paths:
        lines.append("p := " + metapost(path) + ";")
        lines.append(
            'for i=0 upto length p - 1: message "@ " & decimal xpart postcontrol i of p'
            ' & " " & decimal ypart postcontrol i of p & " " & decimal xpart precontrol i+1 of p'
            ' & " " & decimal ypart precontrol i+1 of p; endfor message "=";'
        )
    lines.append("end")
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "paths.mp"), "w") as file:
            file.write("\n".join(lines) + "\n")
        output = subprocess.run(
            ["mpost", "-numbersystem=double", "-interaction=nonstopmode", "paths.mp"],
            cwd=folder,
            env={**os.environ, "max_print_line": "1000"},
            capture_output=True,
            text=True,
        ).stdout
    assert "\n! " not in output, output
    found = [[]]
    for line in output.splitlines():
        if line.startswith("@ "):
            x0, y0, x1, y1 = map(float, line[2:].split()[:4])
            found[-1].append([[x0, y0], [x1, y1]])
        elif line.startswith("="):
            found.append([])
    return found[:-1]


paths = [path(index) for index in range(PATHS)]
for path, controls in zip(paths, solve(paths), strict=True):
    path["controls"] = controls
print('{\n"made": "make_mpost.py, MetaPost 2.02 with -numbersystem=double",\n"paths": [')
print(",\n".join(json.dumps(path) for path in paths))
print("]\n}")
