#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""accuracyCost in a case: interruption, continuation, history, table, pictures and page.

accuracyCost.py BIN CASE       CASE: the tutorial accuracyCost/rockingBlock/freeRocking
"""
import csv
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from caseTest import CaseTest, applications, tutorial

results = "postProcessing/accuracyCost/0"
study = """FoamFile { version 2.0; format ascii; class dictionary; object accuracyCostDict; }
quantities
{
    first { type returnTime; block 1; count 1; reference { type %(reference)s; } }
    loss { type energy; part dissipation; reference { type finest; deltaT 0.01; phases 3; } }
}
sweeps
{
    schemes { quantity first; deltaT (0.04 0.02 0.01); theta (0.5 1); phases %(phases)s; }
    solvers
    {
        quantity first; deltaT (0.02 0.01); theta (0.5 1); phases 3;
        solver (interiorPoint augmentedLagrangian); tolerance (1e-4 1e-8);
    }
    tolerances { quantity first; tolerance (1e-3 1e-5 1e-8); flowRule (associative nonAssociative); phases 2; }
    losses { quantity loss; deltaT (0.04 0.02); phases 3; }
    %(more)s
}
"""
good = {"reference": "Housner", "phases": "4", "more": ""}


class AccuracyCost(CaseTest):
    application = "accuracyCost"

    def case(self, name, **changes):
        case = os.path.join(self.root.name, name)
        shutil.copytree(tutorial, case, ignore=shutil.ignore_patterns("VTK", "postProcessing", "log.*", "assembly"))
        subprocess.run([os.path.join(applications, "blockTexture"), "-case", case], check=True, capture_output=True)
        for old, new in (("deltaT .*;", "deltaT 0.01;"), ("endTime .*;", "endTime 1;")):
            self.replace(case, "system/controlDict", "(?m)^" + old, new)
        self.set(case, **changes)
        return case

    def replace(self, case, name, old, new):
        text = self.read(case, name)
        with open(os.path.join(case, name), "w", encoding="utf-8") as file:
            file.write(re.sub(old, new, text))

    @staticmethod
    def set(case, **changes):
        with open(os.path.join(case, "system/accuracyCostDict"), "w", encoding="utf-8") as file:
            file.write(study % {**good, **changes})

    def table(self, case):
        """Rows of the table without their times."""
        rows = list(csv.DictReader(self.read(case, results + "/accuracyCost.csv").splitlines()))
        return [{key: value for key, value in row.items() if key not in ("cpuTime[s]", "F[s]")} for row in rows]

    def runs(self, case):
        """Rows of the history without their times."""
        rows = [line.split() for line in self.read(case, results + "/history.dat").splitlines() if line[0] != "#"]
        return [row[:17] + row[18:] for row in rows]

    def testAStudyLeavesTableHistoryPicturesAndAPageThatShowsThem(self):
        case = self.case("plain")
        self.run_(case)
        table = self.table(case)
        self.assertEqual(len(table), 6 + 16 + 6 + 2)
        self.assertEqual(len(self.runs(case)), 6 * 4 + 16 * 3 + 6 * 2 + 3 * 3)  # two of `losses` are of the reference
        page = self.read(case, results + "/accuracyCost.md")
        pictures = re.findall(r"!\[\w+\]\(([^)]+)\)", page)
        self.assertEqual(sorted(pictures), ["losses.svg", "schemes.svg", "solvers.svg", "solversSolvers0.0001.svg",
                                            "solversSolvers1e-08.svg", "tolerances.svg"])
        for picture in pictures:
            self.assertIn("</svg>", self.read(case, results + "/" + picture))
        for text in ("Housner's equation", "Cheapest settings", "| 5% |", "| 0.1% |", "Dolan", "knee", "Coulomb",
                     "finest run"):
            self.assertIn(text, page)
        # A finer step is nearer, the trapezoidal rule most of all; no error is zero.
        error = {(row["deltaT[s]"], row["theta"]): float(row["medianError"]) for row in table if row["sweep"] == "schemes"}
        self.assertLess(error["0.01", "1"], 0.6 * error["0.02", "1"])
        self.assertLess(error["0.01", "0.5"], 0.1 * error["0.01", "1"])
        self.assertGreater(error["0.01", "0.5"], 1e-9)

    def testAnInterruptedStudyGoesOnAndEndsAsIfItHadNotBeen(self):
        whole = self.case("whole")
        self.run_(whole)
        for name, sent, status in (("interrupted", signal.SIGINT, 130), ("terminated", signal.SIGTERM, 143)):
            case = self.case(name)
            with subprocess.Popen([os.path.join(applications, "accuracyCost"), "-case", case],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
                while not os.path.exists(os.path.join(case, results, "history.dat")):
                    time.sleep(0.001)
                process.send_signal(sent)
                output, errors = process.communicate(timeout=60)
            self.assertEqual(process.returncode, status, output + errors)
            self.assertIn("continues from here", output)
            known = self.runs(case)
            self.assertLess(len(known), len(self.runs(whole)))
            self.assertIn(f"{len(known)} runs are known", self.run_(case).stdout)
            self.assertEqual(self.runs(case), self.runs(whole))
            self.assertEqual(self.table(case), self.table(whole))

    def testAStudyThatIsKilledLosesTheRunsOfOneSettingAtMost(self):
        case = self.case("killed")
        with subprocess.Popen([os.path.join(applications, "accuracyCost"), "-case", case],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            while not os.path.exists(os.path.join(case, results, "history.dat")):
                time.sleep(0.001)
            process.kill()
            process.communicate(timeout=60)
        self.assertGreater(len(self.runs(case)), 0)
        self.run_(case)
        self.assertEqual(len(self.table(case)), 30)

    def testMoreSweepsAndOtherReferencesKeepWhatIsKnown(self):
        case = self.case("more")
        self.run_(case)
        before = self.runs(case)
        known = self.read(case, results + "/history.dat")
        self.run_(case)
        self.assertEqual(self.read(case, results + "/history.dat"), known)
        self.set(case, more="again { quantity first; deltaT (0.04 0.03); phases 4; }",
                 reference='value; value 0.4938; source "another program"')
        self.run_(case)
        self.assertEqual(self.runs(case)[:len(before)], before)
        self.assertEqual(len(self.runs(case)), len(before) + 4)
        self.assertIn("another program", self.read(case, results + "/accuracyCost.md"))

    def testAHistoryOfAnotherCaseIsRefused(self):
        case = self.case("changed")
        self.run_(case)
        self.replace(case, "constant/contactProperties", r"mu\s+1;", "\n    mu 1; // of stone")
        self.run_(case)
        properties = self.read(case, "constant/contactProperties")
        self.replace(case, "constant/contactProperties", r"mu\s+1;", "mu 0.9;")
        refused = self.run_(case, status=1).stderr
        self.assertIn("Remove postProcessing/accuracyCost", refused)
        self.assertIn("constant/contactProperties has changed", refused)
        with open(os.path.join(case, "constant/contactProperties"), "w", encoding="utf-8") as file:
            file.write(properties)
        self.run_(case)
        with open(os.path.join(case, results, "history.dat"), "a", encoding="utf-8") as file:
            file.write("1 2 half a ro")
        self.assertRegex(self.run_(case, status=1).stderr, r"history.dat at line \d+")

    def testNumbersOfAHistoryThatNoRunHasAreRefusedWithTheirLine(self):
        case = self.case("edited")
        self.run_(case)
        history = os.path.join(case, results, "history.dat")
        sound = self.read(case, results + "/history.dat")
        *before, last = sound.splitlines()
        for column, numbers in ((0, ("-1", "1e300", "0.5", "2")), (3, ("99", "-1", "nan")), (12, ("3", "-1")),
                                (13, ("0",)), (19, ("77", "3"))):
            for number in numbers:
                words = last.split()
                words[column] = number
                with open(history, "w", encoding="utf-8") as file:
                    file.write("\n".join([*before, " ".join(words), ""]))
                refused = self.run_(case, status=1).stderr
                self.assertIn(f"column {column + 1} of a row of the history, is ", refused)
                self.assertIn(f"history.dat at line {len(before) + 1}.", refused)
        for text in "", "garbage", sound[:30]:
            with open(history, "w", encoding="utf-8") as file:
                file.write(text)
            self.assertIn("The history is damaged: it ", self.run_(case, status=1).stderr)

    def testAFigureThatARunDoesNotHaveIsAFailureAndNotAnError(self):
        case = self.case("short", reference='value; value 0.4938; source "Housner"')
        self.replace(case, "system/controlDict", r"endTime 1;", "endTime 0.3;")
        done = self.run_(case)
        self.assertIn("4 of 4 runs FAILED", done.stdout)
        self.assertTrue(all(row["medianError"] == "nan" for row in self.table(case) if row["quantity"] == "first"))
        self.assertIn("none of those tried", self.read(case, results + "/accuracyCost.md"))

    def testASettingWhoseFirstThreeRunsAreNotSolvedIsGivenUp(self):
        case = self.case("hopeless", more="hopeless { quantity first; solver (interiorPoint gaussSeidel); "
                                          "deltaT (0.02 0.01); tolerance (1e-30); phases 5; }")
        self.assertIn("3 of 3 runs FAILED, no more tried", self.run_(case).stdout)
        rows = [row for row in self.table(case) if row["sweep"] == "hopeless"]
        self.assertEqual([(row["runs"], row["failed"]) for row in rows], 4 * [("3", "3")])
        self.assertIn("the first 3 of 5: no more were tried", self.read(case, results + "/accuracyCost.md"))
        known = self.runs(case)
        self.run_(case)
        self.assertEqual(self.runs(case), known)

    def multiplierCase(self, name, sweep):
        case = self.case(name)
        with open(os.path.join(case, "constant/loads"), "w", encoding="utf-8") as file:
            file.write("dead { type gravity; } live { type inertial; direction (1 0 0); }")
        with open(os.path.join(case, "system/solution"), "a", encoding="utf-8") as file:
            file.write("limitAnalysis { solver interiorPoint; tolerance 1e-9; }")
        with open(os.path.join(case, "system/accuracyCostDict"), "w", encoding="utf-8") as file:
            file.write("quantities { alpha { type multiplier; reference { type value; value 0.25; source slenderness; } } }\n"
                       "sweeps { surface { quantity alpha; %s } }" % sweep)
        return case

    def testWhereNoRunHasItsFigureTheReasonIsGivenAndTheStatusIsNotZero(self):
        case = self.multiplierCase("unbounded", "tolerance (1e-3 1e-9);")
        with open(os.path.join(case, "constant/loads"), "w", encoding="utf-8") as file:
            file.write("dead { type gravity; } live { type inertial; direction (0 -1 0); }")
        done = self.run_(case, status=1)
        self.assertRegex(done.stdout, r"runs FAILED: there is no multiplier, as where the live load is unbounded")
        self.assertIn("End", done.stdout)
        self.run_(case, status=1)  # known from the history

    def testAThresholdIsKnownToHalfTheIntervalOfItsIntensities(self):
        case = self.case("threshold")
        with open(os.path.join(case, "constant/groundMotion"), "w", encoding="utf-8") as file:
            file.write("direction (1 0); acceleration { type rectangularPulse; amplitude 1; duration 0.3; }")
        if os.path.exists(os.path.join(case, "0")):
            shutil.rmtree(os.path.join(case, "0"))
        with open(os.path.join(case, "system/accuracyCostDict"), "w", encoding="utf-8") as file:
            file.write("quantities { c { type threshold; intensity { type step; unit m/s2; from 2; to 6; step 2; } "
                       "criterion { type rotation; block 1; limit 0.1; } "
                       "reference { type finest; deltaT 0.01; phases 1; } } }\n"
                       "sweeps { steps { quantity c; deltaT (0.02 0.01); phases 1; } }")
        done = self.run_(case)
        self.assertRegex(done.stdout, r"Reference of c: \d m/s2 \+- 1: .* half the interval between the intensities")
        self.assertRegex(done.stdout, r"c: 0\.1% is reached .*; but the reference is known to \d+% only")
        page = self.read(case, "postProcessing/accuracyCost/0/accuracyCost.md")
        self.assertRegex(page, r"\| c \| 0\.1% .*%; the reference is known to \d+% only \|")

    def testAReferenceOfALargerToleranceThanItsSweepIsWarnedOf(self):
        case = self.multiplierCase("tolerance", "tolerance (1e-6 1e-10);")
        reference = r"type value; value 0.25; source slenderness;"
        self.replace(case, "system/accuracyCostDict", reference, "type finest; tolerance 1e-9;")
        self.assertNotIn("Warning", self.run_(case, "-dry-run").stderr)
        self.replace(case, "system/accuracyCostDict", "tolerance 1e-9", "tolerance 1e-6")
        warned = self.run_(case, "-dry-run")
        self.assertRegex(warned.stdout + warned.stderr, r"(?s)Warning.*tolerance of at most 1e-10.*accuracyCostDict"
                                                        r"/quantities/alpha/reference/tolerance at line 1")

    def testContactByPointsIsSetAgainstThatBySurfaces(self):
        case = self.multiplierCase("surface", "formulation (points surface); flowRule (associative); "
                                              "tolerance (1e-6 1e-9);")
        self.run_(case)
        rows = self.table(case)
        self.assertEqual([row["formulation"] for row in rows], 2 * ["points"] + 2 * ["surface"])
        for row in rows:
            self.assertLess(float(row["medianError"]), float(row["tolerance"]))
            self.assertEqual(row["failed"], "0")
        page = self.read(case, results + "/accuracyCost.md")
        self.assertRegex(page, r"### Point against surface contact[^#]*\| tolerance 1e-09 \| 0.25 \| 0.25 \|")
        self.assertIn("| by surfaces | 1e-09 |", page)

    def testContactBySurfacesIsRefusedWhereItIsNotFormulated(self):
        for name, more, line in (("points", "\npointsPerJoint (5);\n formulation (surface); flowRule (associative);", 4),
                                 ("coulomb", "\nformulation (surface); flowRule (nonAssociative);", 3)):
            case = self.multiplierCase(name, more)
            self.assertRegex(self.run_(case, "-dry-run", status=1).stderr,
                             rf"(?s)remove surface.*accuracyCostDict\S* at line {line}")
        motion = self.case("motion", more="m { quantity first;\nformulation (points); }")
        self.assertIn("formulation is for multipliers", self.run_(motion, "-dry-run", status=1).stderr)

    def testEffectsAsGivenChosenByTheProgramAndAllOfThem(self):
        case = self.case("chosen", more="""chosen
{
    quantity first; deltaT (0.02); flowRule (associative nonAssociative); displacements (large small);
    effects (asGiven automatic everything);
}""")
        self.run_(case)
        rows = [row for row in self.table(case) if row["sweep"] == "chosen"]
        def of(effects):
            return {(row["flowRule"], row["displacements"]): float(row["value"]) for row in rows
                    if row["effects"] == effects}
        self.assertEqual(len(of("asGiven")), 4)
        for setting, value in of("asGiven").items():
            self.assertAlmostEqual(value, of("automatic")[setting], delta=1e-8)
        # Everything on is by Coulomb's law with large displacements, once, whatever the sweep has.
        self.assertEqual(of("everything"), {("nonAssociative", "large"): of("asGiven")["nonAssociative", "large"]})
        self.assertEqual(len(rows), 9)
        page = self.read(case, results + "/accuracyCost.md")
        self.assertIn("### Effects as given in every step against those that it calls for (sweep `chosen`)", page)
        chosen = page.split("### Chosen effects against everything on (sweep `chosen`)")[1].split("\n\n")[1]
        self.assertEqual(len(chosen.splitlines()), 2 + 8)

    def testATypingErrorAmongTheEffectsIsNamed(self):
        case = self.case("typing", more="chosen { quantity first;\neffects (asGiven everthing); }")
        self.assertRegex(self.run_(case, "-dry-run", status=1).stderr,
                         r"(?s)everthing. Did you mean everything\?.*accuracyCostDict\S* at line 18")

    def testByHowMuchPointsGiveWayIsAnAxisOfItsOwn(self):
        case = self.case("overlap", more="overlap { quantity first; deltaT (0.02); flowRule (nonAssociative); "
                                         "contactOverlap (1e-11 1e-6 1e-8); phases 1; }")
        self.run_(case)
        rows = [row for row in self.table(case) if row["sweep"] == "overlap"]
        value = {row["contactOverlap"]: float(row["value"]) for row in rows}
        self.assertLess(abs(value["1e-08"] - value["1e-11"]), 1e-5)
        self.assertNotEqual(value["1e-06"], value["1e-11"])
        self.assertRegex(self.read(case, results + "/accuracyCost.md"),
                         r"(?s)\| setting \| overlap \[block\] \|.*\| 1e-06 \|.*\| 1e-08 \|.*\| 1e-11 \|")
        multiplier = self.multiplierCase("overlapOfMultiplier", "\ncontactOverlap (1e-6 1e-8);")
        self.assertRegex(self.run_(multiplier, "-dry-run", status=1).stderr,
                         r"(?s)contactOverlap is for motions.*accuracyCostDict\S* at line \d+")
        space = self.spaceCase("overlapInSpace", "slidingBox/box",
                               "s { quantity slip; deltaT (0.005); contactOverlap (1e-6 1e-8); phases 1; }")
        self.run_(space)
        value = {row["contactOverlap"]: float(row["value"]) for row in self.table(space)}
        self.assertAlmostEqual(value["1e-06"], value["1e-08"], delta=1e-5)
        self.assertNotEqual(value["1e-06"], value["1e-08"])

    def spaceCase(self, name, of="jointPoints/box", sweep="points { quantity alpha; pointsPerSide (2 9 3); }", **changes):
        """A tutorial of space with another sweep. changes: (file, old, new)"""
        case = os.path.join(self.root.name, name)
        shutil.copytree(os.path.join(tutorial, "../../space", of), case,
                        ignore=shutil.ignore_patterns("VTK", "postProcessing", "log.*", "assembly"))
        self.replace(case, "system/accuracyCostDict", r"(?s)sweeps\s*\{.*\}", "sweeps\n{\n%s\n}" % sweep)
        for change in changes.values():
            self.replace(case, *change)
        subprocess.run([os.path.join(applications, "blockTexture"), "-case", case], check=True, capture_output=True)
        return case

    def testInSpacePointsASideApproachTheTorsionOfACohesionWithTheSquareOfTheirDistance(self):
        case = self.spaceCase("torsion", sweep="points { quantity alpha; pointsPerSide (17 2 9 5); }\n"
                                               "own { quantity alpha; tolerance (1e-6 1e-9); }")
        self.run_(case)
        rows = self.table(case)
        error = {int(row["pointsPerSide"]): float(row["medianError"]) for row in rows if row["sweep"] == "points"}
        self.assertAlmostEqual(error[2], 1.767766953 / 0.956494646 - 1, delta=1e-6)  # six digits: sqrt(2) a/2 times c a^2
        self.assertLess(error[17], 0.003)
        self.assertGreater(error[5] / error[9], 3)
        self.assertGreater(error[9] / error[17], 3)
        self.assertEqual([row["pointsPerSide"] for row in rows if row["sweep"] == "own"], ["0", "0"])
        page = self.read(case, results + "/accuracyCost.md")
        self.assertRegex(page, r"(?s)\| setting \| points a side \|.*\| 2 \|.*\| 5 \|.*\| 9 \|.*\| 17 \|")
        self.assertIn("Few points a joint against many", page)
        known = self.read(case, results + "/history.dat")
        self.run_(case)
        self.assertEqual(self.read(case, results + "/history.dat"), known)

    def testInSpaceABoxThatSlidesAcrossItsAxesStopsWhereTheClosedFormSays(self):
        case = self.spaceCase("slides", "slidingBox/box",
                              "steps { quantity slip; deltaT (0.02 0.01 0.005); theta (0.5 1); phases 2; }")
        self.run_(case)
        error = {(row["deltaT[s]"], row["theta"]): float(row["medianError"]) for row in self.table(case)}
        self.assertAlmostEqual(error["0.01", "1"] / error["0.005", "1"], 2, delta=0.2)
        self.assertLess(error["0.005", "0.5"], 0.1 * error["0.005", "1"])

    def testWhatThereIsInThePlaneOnlyIsRefusedInSpaceWithItsLine(self):
        for name, sweep, says in (("joint", "p { quantity alpha;\npointsPerJoint (2 5); }", "write pointsPerSide"),
                                  ("surfaces", "p { quantity alpha;\nformulation (surface); }", "joints of the plane")):
            errors = self.run_(self.spaceCase(name, sweep=sweep), "-dry-run", status=1).stderr
            self.assertRegex(errors, rf"(?s){says}.*accuracyCostDict\S* at line \d+")
        case = self.spaceCase("upright", "slidingBox/box", "s { quantity slip; deltaT (0.02 0.01); }",
                              quantity=("system/accuracyCostDict", r"type\s+displacement;", "type returnTime;"),
                              direction=("system/accuracyCostDict", r"direction.*", ""))
        self.assertRegex(self.run_(case, "-dry-run", status=1).stderr,
                         r"(?s)returnTime is of blocks that rock in the plane.*accuracyCostDict\S* at line \d+")

    def testHousnersEquationOfAnotherCaseIsRefusedWithItsLine(self):
        case = self.case("rebound")
        with open(os.path.join(case, "constant/contactProperties"), "a", encoding="utf-8") as file:
            file.write("restitution { normal 0.5; }\n")
        self.assertRegex(self.run_(case, status=1).stderr, r"(?s)remove restitution.*accuracyCostDict\S* at line 4")

    def testDryRunChecksAndComputesNothing(self):
        case = self.case("dry")
        self.assertIn("Sweep schemes: first over 6 settings, 24 runs", self.run_(case, "-dry-run").stdout)
        self.assertFalse(os.path.exists(os.path.join(case, "postProcessing")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
