#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Distributions, samples and Sobol' indices of ensembles beside those of OpenTURNS, on limit analyses of a wall.

openTurns.py BIN CASE       CASE: the tutorial masonryPanels

OpenTURNS draws points, ensemble computes them as a table, OpenTURNS evaluates them; ensemble with a design and statistics
of its own must agree. Skipped (exit status 77) where OpenTURNS is not installed.
"""
import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
sys.path.insert(0, os.path.dirname(__file__))
try:
    import openturns
except ImportError:
    # Debian's package is for Debian's interpreter, which may not be the first one.
    debian = "/usr/bin/python3"
    if os.path.exists(debian) and os.path.realpath(sys.executable) != os.path.realpath(debian):
        os.execv(debian, [debian, *sys.argv])
    print("Skipped: OpenTURNS is not installed (python3-openturns; etc/bootstrap test installs it)")
    sys.exit(77)
import ensemble

points = 20000
base = 2048


class OpenTurns(ensemble.Ensemble):
    def setUp(self):
        openturns.RandomGenerator.SetSeed(1)
        logarithm = openturns.LogNormal(__import__("math").log(0.65), 0.15)
        self.inputs = openturns.ComposedDistribution(
            [openturns.TruncatedDistribution(logarithm, 0.2, 1.2), openturns.Uniform(0.35, 0.45)])

    def alphasAt(self, name, sample):
        """Multipliers of the points that OpenTURNS has chosen."""
        case = self.case(name)
        with open(os.path.join(case, "constant/samples.dat"), "w", encoding="utf-8") as file:
            file.write("# mu unit\n" + "".join(f"{point[0]!r} {point[1]!r}\n" for point in sample))
        path = os.path.join(case, "system/ensembleDict")
        with open(path, encoding="utf-8") as file:
            text = file.read()
        with open(path, "w", encoding="utf-8") as file:
            file.write(text.replace("design { type latinHypercube; samples 300; seed 1; }",
                                    "design { type table; file \"constant/samples.dat\"; }"))
        self.run_(case)
        return openturns.Sample([[float(row[3])] for row in self.table(case)[1:]])

    def statistics(self, case):
        rows = self.read(case, "postProcessing/ensemble/0/statistics.dat").splitlines()[1:]
        return {row.split()[1]: [float(word) for word in row.split()[2:]] for row in rows}

    def testQuantilesOfTheVariables(self):
        case = self.case("quantiles", design="latinHypercube", samples=2000)
        self.run_(case)
        rows = self.table(case)[1:]
        for column, marginal in ((1, self.inputs.getMarginal(0)), (2, self.inputs.getMarginal(1))):
            # Of a Latin hypercube the i-th smallest value lies in the i-th of equal parts.
            values = sorted(float(row[column]) for row in rows)
            for i in (0, 100, 999, 1500, 1999):
                probability = marginal.computeCDF(values[i])
                self.assertTrue(i / 2000 - 1e-9 <= probability <= (i + 1) / 2000 + 1e-9, (column, i, probability))

    def testMeanAndFractilesOfTheMultiplier(self):
        experiment = openturns.LHSExperiment(self.inputs, points)
        alphas = self.alphasAt("drawn", experiment.generate())
        case = self.case("own", samples=points)
        self.run_(case)
        own = self.statistics(case)
        deviation = alphas.computeStandardDeviation()[0]
        self.assertAlmostEqual(own["mean"][0], alphas.computeMean()[0], delta=4 * deviation * (2 / points) ** 0.5)
        self.assertAlmostEqual(own["standardDeviation"][0], deviation, delta=0.02 * deviation)
        for part in (0.05, 0.5, 0.95):
            value, _, lower, upper = own[f"fractile{part:g}"]
            self.assertAlmostEqual(value, alphas.computeQuantile(part)[0], delta=1.5 * (upper - lower))
        print("mean", own["mean"][0], alphas.computeMean()[0], "deviation", own["standardDeviation"][0], deviation,
              "fractiles", [(own[f"fractile{part:g}"][0], alphas.computeQuantile(part)[0]) for part in (0.05, 0.5, 0.95)])

    def testSobolIndices(self):
        design = openturns.SobolIndicesExperiment(self.inputs, base, False).generate()
        outputs = self.alphasAt("indices", design)
        theirs = openturns.SaltelliSensitivityAlgorithm(design, outputs, base)
        case = self.case("sensitivity", design="sobol; sensitivity yes", samples=base,
                         statistics="shares { type sensitivity; value alpha; }")
        self.run_(case)
        own = self.statistics(case)
        for k, name in enumerate(("mu", "unit")):
            for kind, other in (("first", theirs.getFirstOrderIndices()), ("total", theirs.getTotalOrderIndices())):
                value, error = own[f"{kind}_{name}"][:2]
                print(kind, name, value, other[k], "standard error", error)
                # Their points are as random as ours.
                self.assertAlmostEqual(value, other[k], delta=4 * error * 2 ** 0.5)


if __name__ == "__main__":
    suite = unittest.TestSuite([OpenTurns(name) for name in dir(OpenTurns) if name in
                                ("testQuantilesOfTheVariables", "testMeanAndFractilesOfTheMultiplier",
                                 "testSobolIndices")])
    sys.exit(0 if unittest.TextTestRunner().run(suite).wasSuccessful() else 1)
