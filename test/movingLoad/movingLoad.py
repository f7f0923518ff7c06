# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Every multiplier of the arches of the tutorial movingLoad in a second way, which shares nothing with Drystone. An arch is
three times statically indeterminate: with force and moment at one springing, statics gives the resultant at every other
joint, and the largest load at which all of them stay between intrados and extrados and within the cone of friction is a
linear program of four unknowns (safe theorem: Heyman 1966). Geometry, weight, fill and load are written here in closed
form; the program is solved by a simplex method of its own. `movingLoad.py BIN TUTORIAL print` prints the tables.

Of the vault in space the arch of the same width is an upper bound: what the mechanism of the arch does, all slices of the
vault may do side by side. Here the vault has no mechanism below it, so that the bound is met. A limit analysis of one place,
with its axles as forces of constant/loads, is another way to the same row."""
import math
import os
import re
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from caseTest import CaseTest, tutorial  # noqa: E402

radius, thickness, density, gravity, friction = 2.0, 0.3, 2000.0, 9.81, 0.65
inner, outer = radius - thickness / 2, radius + thickness / 2
fillWeight, level = 18000.0, 2.6  # [N/m3], [m]
first = -2.1  # place of the load at the beginning of its path [m]


def solve(rows, right):
    """The solution of a few equations, by elimination with pivots."""
    rows = [[*row, value] for row, value in zip(rows, right)]
    size = len(rows)
    for i in range(size):
        pivot = max(range(i, size), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(size):
            if k != i and rows[k][i] != 0:
                factor = rows[k][i] / rows[i][i]
                rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
    return [rows[i][size] / rows[i][i] for i in range(size)]


def largestLast(constraints):
    """Largest x[-1] with a.x <= b for each (a, b) of constraints that have a solution; infinite where none limits it.

    Simplex method on the dual, min b.y with A'y = (0 .. 0 1), y >= 0, by Bland's rule; |x| <= 1e6 is its first basis."""
    size = len(constraints[0][0])
    bound = 1e6
    unit = [[float(i == k) for k in range(size)] for i in range(size)]
    rows = [(row, bound) for row in unit] + [([-a for a in row], bound) for row in unit] + constraints
    basis = list(range(size))
    while True:
        matrix = [rows[i][0] for i in basis]
        transposed = [list(column) for column in zip(*matrix)]
        x = solve(matrix, [rows[i][1] for i in basis])
        entering = next((i for i, (row, limit) in enumerate(rows)
                         if i not in basis and sum(a * b for a, b in zip(row, x)) > limit + 1e-9), None)
        if entering is None:
            return math.inf if max(map(abs, x)) > 0.99 * bound else x[-1]
        y = solve(transposed, unit[-1])
        direction = solve(transposed, rows[entering][0])
        basis[min((y[k] / direction[k], basis[k], k) for k in range(size) if direction[k] > 1e-12)[2]] = entering


class Arch:
    def __init__(self, voussoirs, width, hasFill):
        """`dead` has the weight of each voussoir with its fill [N] and its moment about x = 0 [Nm]; width [m]."""
        self.voussoirs, self.dead = voussoirs, []
        for i in range(voussoirs):
            outline = [self.corner(i, inner), self.corner(i, outer), self.corner(i + 1, outer), self.corner(i + 1, inner)]
            sides = [(a, b, a[0] * b[1] - b[0] * a[1]) for a, b in zip(outline, outline[1:] + outline[:1])]
            weight = width * density * gravity * sum(twice for _, _, twice in sides) / 2
            moment = width * density * gravity * sum(twice * (a[0] + b[0]) for a, b, twice in sides) / 6
            if hasFill:
                right, left = self.corner(i, outer), self.corner(i + 1, outer)
                middle = ((right[0] + left[0]) / 2, (right[1] + left[1]) / 2)
                for (x, y), part in ((right, 1 / 6), (middle, 4 / 6), (left, 1 / 6)):  # exact: a quadratic of x
                    weight += width * part * (right[0] - left[0]) * fillWeight * (level - y)
                    moment += width * part * (right[0] - left[0]) * fillWeight * (level - y) * x
            self.dead.append((weight, moment))
        self.weight = sum(weight for weight, _ in self.dead)

    def corner(self, joint, r):
        """Of a joint, 0 at the right springing to `voussoirs` at the left one, at the distance r from the centre."""
        angle = math.pi * joint / self.voussoirs
        return r * math.cos(angle), r * math.sin(angle)

    def multiplier(self, live):
        """Of a live load, for each voussoir a force downwards and its moment about x = 0."""
        force = sum(value for value, _ in live)
        if force == 0:
            return math.nan
        constraints = []
        dead = [0.0, 0.0]  # of what stands between joint 0 and this one, in units of the weight
        load = [0.0, 0.0]  # likewise, in units of the live load
        for joint in range(self.voussoirs + 1):
            # Acting upon what follows: H, V and the moment M about the centre at joint 0, less what stands before; each
            # is (coefficients of H V M and alpha's force; constant).
            horizontal, vertical = ((1, 0, 0, 0), 0), ((0, 1, 0, -load[0]), -dead[0])
            turning = ((0, 0, 1, -load[1]), -dead[1])

            def sum_(*terms):
                return ([sum(c * term[0][i] for c, term in terms) for i in range(4)], sum(c * term[1] for c, term in terms))

            # Joint 0 is entered upwards, along (-sin, cos) of the angle; (cos, sin) points outwards.
            cos, sin = self.corner(joint, 1)
            normal = sum_((-sin, horizontal), (cos, vertical))
            shear = sum_((cos, horizontal), (sin, vertical))
            # The moment about the inner end is not negative, about the outer end not positive.
            for end, sign in ((inner, -1), (outer, 1)):
                x, y = self.corner(joint, end)
                row, constant = sum_((sign, turning), (-sign * x, vertical), (sign * y, horizontal))
                constraints.append((row, -constant))
            for sign in (1, -1):
                row, constant = sum_((sign, shear), (-friction, normal))
                constraints.append((row, -constant))
            if joint < self.voussoirs:
                dead = [sum_ + part / self.weight for sum_, part in zip(dead, self.dead[joint])]
                load = [sum_ + part / force for sum_, part in zip(load, live[joint])]
        return largestLast(constraints) * self.weight / force

    def concentrated(self, axles):
        """Live load of axles (x [m], force [N]): each on the voussoir below it."""
        live = [(0.0, 0.0)] * self.voussoirs
        for x, force in axles:
            for i in range(self.voussoirs):
                if self.corner(i + 1, outer)[0] <= x < self.corner(i, outer)[0]:
                    live[i] = (live[i][0] + force, live[i][1] + force * x)
        return live

    def spread(self, axles, length=0.3, slope=0.5, parts=200):
        """Live load of axles from the level of the fill on, uniform over length + 2 slope depth: the share of a force that
        passes to the left of (x, y) is 1/2 + (x - its place)/(length + 2 slope (level - y))."""
        live = []
        for i in range(self.voussoirs):
            (x0, y0), (x1, y1) = self.corner(i + 1, outer), self.corner(i, outer)
            points = [(x0 + (x1 - x0) * k / parts, y0 + (y1 - y0) * k / parts) for k in range(parts + 1)]
            force = moment = 0.0
            for place, value in axles:
                shares = [min(0.5, max(-0.5, (x - place) / (length + 2 * slope * (level - y)))) for x, y in points]
                for a, b, (xa, _), (xb, _) in zip(shares, shares[1:], points, points[1:]):
                    if b > a:  # else this side of the voussoir looks away from the rays
                        force += value * (b - a)
                        moment += value * (b - a) * (xa + xb) / 2
            live.append((force, moment))
        return live


def tandem(x):
    return [(x, 10000.0), (x - 1.2, 5000.0)]


# Each case of the tutorial: the distance from one place of its load to the next [m], the arch, and its live load with the
# first axle at x.
cases = {"arch": (0.05, Arch(31, 1, False), lambda arch, x: arch.concentrated([(x, 1000.0)])),
         "axles": (0.05, Arch(31, 1, True), lambda arch, x: arch.concentrated(tandem(x))),
         "spread": (0.05, Arch(31, 1, True), lambda arch, x: arch.spread(tandem(x))),
         "vault": (0.2, Arch(15, 2, True), lambda arch, x: arch.concentrated(tandem(x)))}


class MovingLoad(CaseTest):
    def table(self, case):
        """Distance along the path, multiplier and block of each place."""
        for self.application in ("blockTexture", "limitAnalysis"):
            self.said = self.run_(case).stdout
        rows = [line.split() for line in self.read(case, "postProcessing/limitAnalysis/0/movingLoad.dat").splitlines()]
        names = [name.split("[")[0] for name in rows[0][1:]]
        columns = [names.index(name) for name in ("distance", "alpha")]
        return [tuple(float(row[column]) for column in columns) for row in rows[1:]]

    def compare(self, name, every, tolerance):
        """Every so many rows of a table; tolerance(the load there), relative."""
        step, arch, load = cases[name]
        finite, worst = 0, math.inf
        for distance, alpha in self.table(self.copyOf(os.path.join(tutorial, name)))[::every]:
            with self.subTest(distance=distance):
                live = load(arch, first + step * round(distance / step))
                expected = arch.multiplier(live)
                # Near the springings no load makes an arch collapse: unbounded here and there.
                self.assertEqual(math.isfinite(expected), math.isfinite(alpha), alpha)
                if math.isfinite(expected):
                    self.assertAlmostEqual(alpha / expected, 1, delta=tolerance(live))
                    finite, worst = finite + 1, min(worst, expected)
        return finite, worst

    def testOfOneAxle(self):
        finite, worst = self.compare("arch", 1, lambda _: 1e-7)
        self.assertEqual(finite, 73)
        self.assertAlmostEqual(worst, 4.65275041, places=8)

    def testOfTwoAxlesAndAFill(self):
        finite, worst = self.compare("axles", 1, lambda _: 1e-7)
        self.assertGreater(finite, 80)
        self.assertAlmostEqual(worst, 1.67001539, places=8)

    def testOfAxlesThatSpreadThroughTheFill(self):
        # Both cut an axle where voussoirs meet, and take forces at the middles of equal parts on each: 20 or more there, as
        # many as of 200 lie in the axle here.
        finite, _ = self.compare("spread", 6, lambda live: 5e-5)
        self.assertGreater(finite, 10)

    def testTheArchOfItsWidthBoundsAVault(self):
        finite, worst = self.compare("vault", 1, lambda _: 1e-7)
        self.assertEqual(finite, 36)  # of 39 rows: a place above a joint has two
        self.assertAlmostEqual(worst, 3.68501283, places=8)

    def testOnePlaceOfAVaultByHand(self):
        """The worst place, its axles as two forces on the faces below them."""
        case = self.copyOf(os.path.join(tutorial, "vault"))
        distance, worst = min(self.table(case), key=lambda row: row[1])
        step, arch, _ = cases["vault"]
        forces = ""
        # The front axle is above a joint: the block on which it stands is that of the table.
        rear, front = re.search(r"(?m)^Worst place: .* on blocks (\d+) (\d+)$", self.said).groups()
        for name, block, (x, force) in zip(("front", "rear"), (front, rear), tandem(first + distance)):
            joint = next(i for i in range(arch.voussoirs) if arch.corner(i + 1, outer)[0] <= x < arch.corner(i, outer)[0])
            (x0, z0), (x1, z1) = arch.corner(joint, outer), arch.corner(joint + 1, outer)
            z = z0 + (z1 - z0) * (x - x0) / (x1 - x0)
            forces += f"{name} {{ type force; at ({x:.12g} 1 {z:.12g}); value (0 0 {-force:g}); block {block}; }}\n"
        loads = self.read(case, "constant/loads")
        with open(os.path.join(case, "constant/loads"), "w", encoding="utf-8") as file:
            file.write(loads[:loads.index("live")] + f"live {{ type sum; loads {{ {forces} }} }}\n")
        self.run_(case)
        alpha = self.read(case, "postProcessing/limitAnalysis/0/limitAnalysis.dat").splitlines()[1].split()[0]
        self.assertAlmostEqual(float(alpha) / worst, 1, delta=1e-8)


if __name__ == "__main__":
    if sys.argv[3:] == ["print"]:
        for name, (step, arch, load) in cases.items():
            for i in range(round((5.4 if name in ("axles", "spread") else 4.2) / step) + 1):
                print(f"{name:6} {step * i:5.2f} {arch.multiplier(load(arch, first + step * i)):.9g}")
    else:
        unittest.main(argv=sys.argv[:1])
