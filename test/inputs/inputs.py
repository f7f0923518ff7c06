#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""What a user is told of input that is not what was meant: results kept beside changed input, files with nearly the
right name, values that are improbable. Beside them: the same input without the mistake, of which nothing is said.

inputs.py BIN CASE       CASE: a block on ground under a pulse
"""
import math
import os
import re
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from caseTest import CaseTest, applications, tutorial, header

tutorials = os.path.abspath(os.path.join(tutorial, "../../.."))
controls = {"application": "contactDynamics", "startFrom": "latestTime", "startTime": "0", "stopAt": "endTime",
            "endTime": "0.02", "deltaT": "0.002", "writeControl": "runTime", "writeInterval": "0.01"}
warning = "--> DRYSTONE Warning :"


class InputTest(CaseTest):
    application = "contactDynamics"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.base = os.path.join(cls.root.name, "base")
        cls.copyInput(tutorial, cls.base)
        os.remove(os.path.join(cls.base, "constant/groundMotion"))
        cls.control(cls.base)
        cls.build(cls.base)

    @staticmethod
    def build(case, *options):
        made = subprocess.run([os.path.join(applications, "blockTexture"), "-case", case, *options],
                              capture_output=True, text=True, check=False)
        assert made.returncode == 0, made.stdout + made.stderr
        return made.stdout + made.stderr

    @classmethod
    def write(cls, case, name, text):
        path = os.path.join(case, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    @classmethod
    def control(cls, case, **changes):
        cls.write(case, "system/controlDict", header % "controlDict" +
                  "".join(f"{key} {value};\n" for key, value in {**controls, **changes}.items()))

    @classmethod
    def edit(cls, case, name, pattern, new):
        text, count = re.subn(pattern, new, cls.read(case, name))
        assert count, (name, pattern)
        cls.write(case, name, text)

    def copy(self, name):
        case = os.path.join(self.root.name, name)
        shutil.copytree(self.base, case)
        return case

    def warnings(self, case, *options):
        """Of a run, and its standard output."""
        done = self.run_(case, *options)
        parts = done.stderr.split(warning)
        self.assertEqual(parts[0], "", done.stderr)
        return [part.strip() for part in parts[1:]], done.stdout


class KeptResults(InputTest):
    def changed(self, name, change, **control):
        """The warnings of a second run after a change, and its output."""
        case = self.copy(name)
        self.assertEqual(self.warnings(case)[0], [])
        change(case)
        self.control(case, **control)
        return self.warnings(case)

    def testChangedFrictionAtEndTimeIsTheOldAnswer(self):
        warned, said = self.changed("done", lambda case: self.edit(case, "constant/contactProperties", r"mu +\S+;",
                                                                   "mu 0.61;"))
        self.assertEqual(len(warned), 1, warned)
        self.assertIn("constant/contactProperties has changed", warned[0])
        self.assertIn("the old answer", warned[0])
        self.assertIn("0.02/state", warned[0])
        self.assertIn("nothing to compute", said)
        self.assertNotIn("Time of the stages", said)
        self.assertNotIn("Estimated error", said)

    def testChangedLoadsWhileTheRunGoesOn(self):
        warned, said = self.changed("onwards", lambda case: self.write(
            case, "constant/groundMotion", "direction (1 0 0); acceleration { type constant; value 1; }"),
            endTime="0.03")
        self.assertEqual(len(warned), 1, warned)
        self.assertIn("constant/groundMotion is new", warned[0])
        self.assertIn("continues from them", warned[0])
        self.assertIn("Time = 0.03", said)

    def testTheMotionAtTheBeginningCounts(self):
        warned, _ = self.changed("start", lambda case: self.write(case, "0/motion", "1 { velocity (0.1 0); }"),
                                 endTime="0.03")
        self.assertIn("0/motion is new", warned[0])

    def testARecordCountsByItsContent(self):
        case = self.copy("record")
        self.write(case, "constant/groundMotion",
                   "direction (1 0 0); acceleration { type table; file \"constant/pulse.dat\"; }")
        self.write(case, "constant/pulse.dat", "0 0\n0.005 1\n0.01 0\n")
        self.assertEqual(self.warnings(case)[0], [])
        self.write(case, "constant/pulse.dat", "0 0\n0.005 2\n0.01 0\n")
        self.assertIn("constant/pulse.dat has changed", self.warnings(case)[0][0])

    def testWhatChangesNoAnswerIsNoChange(self):
        def change(case):
            for name in ("constant/contactProperties", "constant/g", "system/schemes"):
                self.edit(case, name, r"\A", "// a comment\n\n")
            self.edit(case, "constant/g", r"9\.81", "9.810")
            self.build(case)

        warned, said = self.changed("same", change, endTime="0.03", writeInterval="0.015", purgeWrite="3",
                                    writeFormat="binary", functions="{ energy { type energy; } }")
        self.assertEqual(warned, [])
        self.assertNotIn("other settings", said)
        self.assertIn("Time = 0.03", said)

    def testSmallerStepsAreWhatARunIsContinuedFor(self):
        warned, said = self.changed("steps", lambda case: None, endTime="0.03", deltaT="0.001")
        self.assertEqual(warned, [])
        self.assertIn("system/controlDict has changed", said)
        warned, _ = self.changed("stepsAtEnd", lambda case: None, deltaT="0.001")
        self.assertIn("system/controlDict has changed", warned[0])

    def testStatesOfOlderVersionsAreReadAndReportedOnce(self):
        case = self.copy("old")
        self.run_(case)
        self.edit(case, "0.02/state", r"(?s)\ninput \d+\n\(.*?\);\n", "\n")
        self.edit(case, "0.02/state", r"(?:timeBeginning|deltaTGiven|timeWrites) \S+;\n", "")
        self.edit(case, "0.02/state", r"\nchecksum \S+;\n", "")
        self.control(case, endTime="0.03")
        warned, said = self.warnings(case)
        self.assertEqual(warned, [])
        self.assertEqual(said.count("an older version has written it"), 1)
        self.assertIn("Time = 0.03", said)

    def testPostProcessNamesTheTimesOfOtherInput(self):
        case = self.copy("postProcess")
        self.run_(case)
        self.assertEqual(self.warnings(case, "-postProcess")[0], [])
        self.edit(case, "constant/g", r"9\.81", "9.8")
        warned, _ = self.warnings(case, "-postProcess")
        self.assertEqual(len(warned), 1, warned)
        self.assertRegex(warned[0], r"time 0.01 0.02 are .*constant/g has changed")

    def testBlocksOfAnotherDictionary(self):
        case = self.copy("blocks")
        self.edit(case, "system/blockTextureDict", r"thickness +\S+;", "thickness 0.7;")
        warned, _ = self.warnings(case, "-dry-run")
        self.assertEqual(len(warned), 1, warned)
        self.assertIn("system/blockTextureDict has changed since the blocks were built", warned[0])
        self.assertRegex(warned[0], r"constant/assembly/blocks/builtFrom at line \d+")
        self.build(case)
        self.assertEqual(self.warnings(case, "-dry-run")[0], [])
        # -dict: the dictionary that was used counts, wherever it is.
        shutil.copy(os.path.join(case, "system/blockTextureDict"), os.path.join(case, "other"))
        self.edit(case, "other", r"thickness +\S+;", "thickness 0.6;")
        self.build(case, "-dict", "other")
        self.assertEqual(self.warnings(case, "-dry-run")[0], [])

    def testBlocksOfOlderVersionsAreReadAndReportedOnce(self):
        case = self.copy("oldBlocks")
        self.edit(case, "constant/assembly/blocks", r"(?s)builtFrom\n\(.*?\);\n", "")
        warned, said = self.warnings(case)
        self.assertEqual(warned, [])
        self.assertEqual(said.count("does not say from which dictionary"), 1)


class KeptLimitAnalysis(InputTest):
    application = "limitAnalysis"

    def testPostProcessOfChangedInput(self):
        case = self.copy("limit")
        self.write(case, "constant/loads", "dead { type gravity; } live { type inertial; direction (1 0 0); }")
        self.assertEqual(self.warnings(case)[0], [])
        self.assertEqual(self.warnings(case, "-postProcess")[0], [])
        self.edit(case, "constant/loads", r"\(1 0 0\)", "(1 1 0)")
        warned, _ = self.warnings(case, "-postProcess")
        self.assertEqual(len(warned), 1, warned)
        self.assertIn("constant/loads has changed", warned[0])
        os.remove(os.path.join(case, "postProcessing/limitAnalysis/0/input"))
        warned, said = self.warnings(case, "-postProcess")
        self.assertEqual(warned, [])
        self.assertIn("an older version has written it", said)


class Misnamed(InputTest):
    def testFilesThatAreNearlyRightAreRefused(self):
        for wrong, meant in {"constant/groundmotion": "constant/groundMotion", "0/motoin": "0/motion",
                             "system/fvSchemes": "system/schemes", "system/fvSolution": "system/solution",
                             "constant/supportMotions": "constant/supportMotion",
                             "constant/groundMotion.txt": "constant/groundMotion",
                             "system/groundMotion": "constant/groundMotion", "groundMotion": "constant/groundMotion",
                             "constant/load": "constant/loads"}.items():
            with self.subTest(wrong):
                case = self.copy("wrong." + wrong.replace("/", "."))
                self.write(case, wrong, "direction (1 0 0); acceleration { type constant; value 3; }\n")
                done = self.run_(case, status=1)
                self.assertIn("--> DRYSTONE FATAL IO ERROR:\n", done.stderr)
                self.assertIn(f"Nothing reads {wrong}. Did you mean {meant}?", done.stderr)
                self.assertIn("DRYSTONE exiting", done.stderr)

    def testOtherFilesAreAllowed(self):
        case = self.copy("others")
        for name in ("constant/README", "constant/README.txt", "constant/groundMotion.off", "constant/loads~",
                     "constant/loads.orig", "constant/.loads.swp", "constant/elCentro.AT2", "constant/records/a.csv",
                     "constant/contactProperties2", "constant/triSurface/a.obj", "system/notes", "system/solution.old",
                     "system/decomposeParDict", "0/U", "README.md", "Allrun", "common/groundMotion"):
            self.write(case, name, "anything { ;\n")
        self.assertEqual(self.warnings(case, "-dry-run")[0], [])

    def testNothingOfTheTutorialsIsRefusedOrDoubted(self):
        # All of them, as some include files beside their case.
        copied = os.path.join(self.root.name, "tutorials")
        shutil.copytree(tutorials, copied, ignore=shutil.ignore_patterns("VTK", "postProcessing", "log.*", "assembly",
                                                                         "largeWall", "pages"))
        cases = sorted(os.path.dirname(folder) for folder, _, files in os.walk(copied)
                       if os.path.basename(folder) == "system" and "blockTextureDict" in files)
        self.assertGreater(len(cases), 50)
        for case in cases:
            with self.subTest(os.path.relpath(case, copied)):
                self.assertNotIn(warning, self.build(case))
                solver = subprocess.run([os.path.join(applications, "caseDictionary"), "-case", case,
                                         "system/controlDict", "-entry", "application", "-value"],
                                        capture_output=True, text=True, check=False).stdout.strip() or "limitAnalysis"
                if solver == "blockTexture":
                    continue
                done = subprocess.run([os.path.join(applications, solver), "-case", case, "-dry-run"],
                                      capture_output=True, text=True, timeout=120, check=False)
                self.assertEqual((done.returncode, done.stderr), (0, ""))


class Improbable(InputTest):
    def only(self, case, *said, options=("-dry-run",)):
        """Demands one warning, with all of these in it."""
        warned, _ = self.warnings(case, *options)
        self.assertEqual(len(warned), 1, warned)
        for what in said:
            self.assertRegex(warned[0], what)

    def testGravityUpwardsOrInMillimetres(self):
        case = self.copy("upwards")
        self.edit(case, "constant/g", r"-9\.81", "9.81")
        self.only(case, r"\(0 9.81\)", "upwards", r"\(0 -9.81\)", r"constant/g/value at line \d+")
        self.edit(case, "constant/g", r"9\.81", "-9810")
        self.only(case, "9810 m/s2", "usual is 9.81")

    def testALoadCaseThatIsTwiceInACombination(self):
        case = self.copy("terms")
        loads = "cases { w { type gravity; } }\ndead { type combined; terms (%s); }\n"
        self.write(case, "constant/loads", loads % "(1 w) (0.35 w)")
        self.only(case, "load case w is there twice", "factors add up", "dead/terms at line 2")
        self.write(case, "constant/loads", loads % "(1.35 w)")
        self.assertEqual(self.warnings(case, "-dry-run")[0], [])

    def testDensityInTonnes(self):
        case = self.copy("density")
        self.write(case, "constant/materialProperties", "\ndensity 2.2;\n")
        self.only(case, r"density = 2.2 \[kg/m3\]", "from 300 to 8000", "materialProperties/density at line 2")

    def testFrictionInDegrees(self):
        case = self.copy("degrees")
        self.edit(case, "constant/contactProperties", r"mu +\S+;", "mu 31;")
        self.only(case, "mu = 31", "0.3 to 1", r"contactProperties/friction/mu at line \d+")

    def testSizesInMillimetres(self):
        case = self.copy("millimetres")
        self.edit(case, "system/blockTextureDict", r"\(([-\d.]+) ([-\d.]+)\)",
                  lambda found: f"({1000 * float(found[1]):g} {1000 * float(found[2]):g})")
        said = self.build(case)
        self.assertEqual(said.count(warning), 1, said)
        self.assertRegex(said, r"mean size of \S+ m.*usual is from 0.005 to 10 m")
        self.assertRegex(said, r"blockTextureDict/texture at line \d+")
        self.only(case, "mean size", r"assembly/blocks/outlines at line \d+")

    def record(self, case, mean=0.0, **entries):
        """Two seconds of a sine with whole periods, of 0.3 g, sampled at 0.01 s."""
        values = [0.3 * math.sin(2 * math.pi * i / 40) + mean for i in range(201)]
        self.write(case, "constant/record.csv", "time [s],north [g]\n" +
                   "".join(f"{0.01 * i:.2f},{value:.9f}\n" for i, value in enumerate(values)))
        self.write(case, "constant/groundMotion", "direction (1 0 0);\nacceleration\n{\n    type record;\n    format "
                   "csv;\n    file \"constant/record.csv\";\n" +
                   "".join(f"    {key} {value};\n" for key, value in entries.items()) + "}\n")
        self.control(case, endTime="3")

    def testARecordThatIsAsUsual(self):
        case = self.copy("usual")
        self.record(case)
        self.assertEqual(self.warnings(case, "-dry-run")[0], [])

    def testARecordConvertedTwice(self):
        case = self.copy("twice")
        self.record(case, scale=9.81)
        self.only(case, "scale 9.81", r"28\.86 m/s2", r"2\.942 m/s2", "scale 1", "acceleration/scale at line 7")

    def testARecordWithoutUnitWhoseValuesAreAsUsualInG(self):
        case = self.copy("unitless")
        self.record(case)
        record = self.read(case, "constant/record.csv")
        self.write(case, "constant/record.csv", record.replace(" [g]", ""))
        self.only(case, "does not say its unit", "m/s2 is assumed", r"largest value of 0\.3 ", "unit g;",
                  "acceleration/file at line 6")
        self.record(case, unit="g")
        self.write(case, "constant/record.csv", record.replace(" [g]", ""))
        self.assertEqual(self.warnings(case, "-dry-run")[0], [])

    def testARecordStrongerThanAny(self):
        case = self.copy("strong")
        self.record(case, scale=20)
        self.only(case, r"58\.84 m/s2", "from 0.01 to 20 m/s2", "acceleration/file at line 6")

    def testARecordWithADrift(self):
        case = self.copy("drift")
        self.record(case, mean=0.01)
        self.only(case, r"mean acceleration is 0\.098", "at most 10%", "baseline", "acceleration/file at line 6")
        self.record(case, mean=0.01, baseline="constant")
        self.assertEqual(self.warnings(case, "-dry-run")[0], [])

    def testStepsCoarserThanTheRecord(self):
        case = self.copy("coarse")
        self.record(case)
        self.control(case, endTime="3", deltaT="0.02")
        self.only(case, r"deltaT 0\.02 s", "every 0.01 s", r"controlDict/deltaT at line \d+")
        self.control(case, endTime="3", deltaT="0.02", adjustTimeStep="yes")  # they end at its points
        self.assertEqual(self.warnings(case, "-dry-run")[0], [])

    def testStepsCoarserThanAPulse(self):
        case = self.copy("coarsePulse")
        self.write(case, "constant/groundMotion", header % "groundMotion" +
                   "direction (1 0 0);\nacceleration { type sine; amplitude 0.1; duration 2; cycles 10; }\n")
        self.control(case, endTime="3", deltaT="0.2")
        self.only(case, r"deltaT 0\.2 s is more than a quarter of a pulse or wave", r"at most 0\.01 s",
                  r"controlDict/deltaT at line \d+")
        for changes in ({"deltaT": "0.04"}, {"deltaT": "0.2", "adjustTimeStep": "yes"}):
            self.control(case, endTime="3", **changes)
            self.assertEqual(self.warnings(case, "-dry-run")[0], [])

    def testAnEndWithinTheRecord(self):
        case = self.copy("early")
        self.record(case)
        self.control(case, endTime="1")
        self.only(case, "endTime 1 s", "until 2 s", r"controlDict/endTime at line \d+")


class StaticsTest(CaseTest):
    application = "limitAnalysis"

    def build(self, case, files):
        """A case of these files, by name and content, with its blocks."""
        for name, text in files.items():
            InputTest.write(case, name, header % os.path.basename(name) + text + "\n")
        self.runApplication("blockTexture", case)

    def testABlockInTwoZonesOfDifferentDensities(self):
        case = os.path.join(self.root.name, "zones")
        files = {
            "system/blockTextureDict": "dimensions 2; texture { type polygons; thickness 1; blocks ( ((0 0) (1 0) (1 1) (0 1)) ); } "
                "zones { a { type blocks; blocks (0); } b { type blocks; blocks (0); } } supports { ground { type ground; } }",
            "constant/g": "value (0 -9.81);", "constant/contactProperties": "friction { type Coulomb; mu 0.5; }",
            "constant/loads": "dead { type gravity; } live { type inertial; direction (1 0 0); }"}
        for second, isSaid in (("b", True), ("\"b.*\"", False)):
            files["constant/materialProperties"] = "density 2000; zones { a { density 1000; } " + second + " { density 3000; } }"
            self.build(case, files)
            done = self.run_(case)
            self.assertEqual("Block 0 is in the zones a and b" in done.stdout + done.stderr, isSaid, done.stdout + done.stderr)

    def testAToleranceOfJointPoints(self):
        """A twisted triangular joint with cohesion: its exact multiplier is 10.464923."""
        case = os.path.join(self.root.name, "triangle")
        files = {
            "system/blockTextureDict": "dimensions 3; texture { type polyhedra; blocks ( { vertices ((0 0 0) (1 0 0) "
                "(0.2 0.8 0) (0 0 1) (1 0 1) (0.2 0.8 1)); faces ((2 1 0) (3 4 5) (0 1 4 3) (1 2 5 4) (2 0 3 5)); } ); } "
                "supports { ground { type ground; } }",
            "constant/g": "value (0 0 -9.81);", "constant/materialProperties": "density 2000;",
            "constant/loads": "dead { type gravity; } live { type sum; loads { a { type force; at (0 0 .5); value (0 -100 0); } "
                "b { type force; at (1 0 .5); value (0 100 0); } } }"}
        for tolerance in ("1e-3", "1e-5"):
            files["constant/contactProperties"] = ("cohesion { strength 10000; } jointPoints { type adaptive; tolerance "
                                                   + tolerance + "; }")
            self.build(case, files)
            done = self.run_(case)
            said = done.stdout + done.stderr
            alpha = float(re.search(r"alpha = (\S+)", said)[1])
            self.assertLess(abs(alpha / 10.464923 - 1), 1e-3)
            isSaid = "The tolerance 1e-05 of jointPoints is not reached" in said
            self.assertEqual(isSaid, alpha / 10.464923 - 1 > float(tolerance), said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
