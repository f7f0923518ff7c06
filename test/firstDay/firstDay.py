#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""What a user complained of on a first day and no other test concerns: names and marks in tables and pictures, one value of
g, studies that are interrupted, dictionaries of etc/annotated that are copied.

firstDay.py BIN CASES       CASES: the tutorial limitAnalysis/masonryPanels
"""
import os
import re
import shutil
import signal
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from caseTest import CaseTest, applications, header, tutorial  # noqa: E402

root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")
tutorials = os.path.join(root, "tutorials")


class FirstDay(CaseTest):
    def case(self, name, files=None):
        """A copy of a tutorial, with other files in it, and its blocks."""
        case = self.copyOf(os.path.join(tutorials, name))
        for path, text in (files or {}).items():
            self.write(case, path, text)
        self.call("blockTexture", case)
        return case

    @staticmethod
    def write(case, path, text):
        with open(os.path.join(case, path), "w", encoding="utf-8") as file:
            file.write(text)

    def call(self, *command):
        return self.runApplication(*command).stdout

    def incremental(self):
        """Wall 1 under two records, to the intensity at which it moves."""
        texture = self.read(os.path.join(tutorial, "wall1"), "system/blockTextureDict")
        return self.case("incrementalDynamics/masonryPanels/wall", files={
            "system/blockTextureDict": texture, "constant/kobe.csv": "t [s],a [g]\n0,0\n0.1,0.5\n0.3,-0.4\n0.4,0\n",
            "constant/northridge.csv": "t [s],a [g]\n0,0\n0.05,0.3\n0.2,-0.5\n0.4,0\n",
            "system/incrementalDynamicsDict": header % "incrementalDynamicsDict" +
            "intensity { type bisection; unit g; low 0.1; high 0.9; tolerance 0.001; }\n"
            "criterion { type motion; displacement 1e-6; }\njobs 1;\n"
            "records { kobe { file \"constant/kobe.csv\"; format csv; } northridge { file \"constant/northridge.csv\"; "
            "format csv; } }\n"})

    def testMotionsHaveTheNamesOfTheirRecords(self):
        case = self.incremental()
        self.call("incrementalDynamics", case)
        table = self.read(case, "postProcessing/incrementalDynamics/0/leastIntensity.dat")
        self.assertTrue(table.startswith("# motion 0: kobe\n# motion 1: northridge\n"), table)

    def testAnInterruptedIncrementalAnalysisGoesOn(self):
        case, table = self.incremental(), "postProcessing/incrementalDynamics/0/leastIntensity.dat"
        self.call("incrementalDynamics", case)
        whole = self.read(case, table)
        shutil.rmtree(os.path.join(case, "postProcessing"))
        process = subprocess.Popen([os.path.join(applications, "incrementalDynamics"), "-case", case], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        done = 0
        for line in process.stdout:
            done += line.startswith(("kobe: intensity", "northridge: intensity"))
            if done == 4:
                process.send_signal(signal.SIGINT)
                break
        output, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, output + errors)
        self.assertIn("started again, it continues", output)
        again = self.call("incrementalDynamics", case)
        known = int(re.search(r"Continuing: (\d+) runs are known", again).group(1))
        self.assertTrue(4 <= known < 24, again)  # what was printed was done, and the log is not behind the runs
        self.assertEqual(self.read(case, table), whole)

    def testOneLogHasOneValueOfG(self):
        case = self.case("contactDynamics/slidingBlock/basePulse", files={
            "constant/north.csv": "t [s],a [g]\n0,0\n0.1,0.32\n0.2,0\n",
            "constant/groundMotion": header % "groundMotion" + "direction (1 0 0);\nacceleration { type record; file "
                                     "\"constant/north.csv\"; format csv; }\n"})
        said = self.call("contactDynamics", case, "-dry-run")
        self.assertIn("1 g = 9.80665 m/s2", said)  # the unit of the record, once
        inG = f"{0.32 * 9.80665 / 9.81:.6g}"       # all else by the gravity of the case
        self.assertRegex(said, rf"PGA +3\.13813 m/s2 = {inG} g")
        self.assertRegex(said, rf"Peak a/g = {inG[:7]}")

    def testTheBestPointOfASearchIsMarked(self):
        case = self.case("parameterSearch/liveLoadDirection")
        self.call("parameterSearch", case)
        self.assertRegex(self.read(case, "postProcessing/parameterSearch/0/parameterSearch.svg"), r">\s*best\s*<")

    def testAPlateauDoesNotFlattenThePictureOfASearch(self):
        case = self.case("parameterSearch/archThickness/stands")
        self.call("parameterSearch", case)
        self.assertRegex(self.read(case, "postProcessing/parameterSearch/0/parameterSearch.svg"), r">\s*beyond the axis\s*<")

    def testTheAnnotatedDictionaryOfAccuracyCostIsReadAsItIs(self):
        case = self.case("accuracyCost/rockingBlock/freeRocking")
        shutil.copy(os.path.join(root, "etc/annotated/system/accuracyCostDict"), os.path.join(case, "system"))
        self.call("accuracyCost", case, "-dry-run")

    def testLimitAnalysisSaysTheForceBehindItsMultiplier(self):
        case = self.case("limitAnalysis/masonryPanels/wall1")
        said = self.call("limitAnalysis", case)
        self.assertRegex(said, r"(?m)^Live load: \S+ k?N along \(1 0\); at collapse \S+ k?N, 0\.6429 of the dead load$")
        self.assertIn("mechanism.svg", said)

    @staticmethod
    def polygons(*outlines):
        """A texture of blocks, the first of which is fixed."""
        blocks = " ".join("(" + " ".join(f"({x} {y})" for x, y in outline) + ")" for outline in outlines)
        return (header % "blockTextureDict" + f"dimensions 2; texture {{ type polygons; thickness 1; blocks ( {blocks} ); }} "
                "supports { ground { type blocks; blocks (0); } }")

    # It had one multiplier for a limit analysis, and stood under twice as much in motion, without a word.
    def testACornerThatStandsOnAFaceWithoutAJointIsWarnedOf(self):
        ground, pier = [(-5, -1), (5, -1), (5, 0), (-5, 0)], [(0, 0), (1, 0), (1, 1), (0, 1)]
        tip, beam = [(1.2, 0), (1.8, 0), (1.5, 1)], [(-1, 1), (2, 1), (2, 1.5), (-1, 1.5)]
        case = self.case("limitAnalysis/masonryPanels/wall1", files={
            "system/blockTextureDict": self.polygons(ground, pier, tip, beam)})
        done = self.runApplication("limitAnalysis", case, "-report")
        self.assertRegex(done.stdout, "(?m)^Status: optimal$")
        said = "no force where block 2 touches block 3 at a corner only"
        self.assertIn(said, " ".join(done.stderr.split()))
        self.assertIn(said, self.read(case, "report.html"))
        shutil.rmtree(case)
        scene = self.case("contactDynamics/slidingBlock/basePulse", files={
            "system/blockTextureDict": self.polygons(ground, pier, tip, beam)})
        self.assertIn("none: they know joints only, and block 2 touches block 3 at a corner only",
                      self.call("contactDynamics", scene, "-dry-run"))

    # Runs began where that of contactDynamics had ended, and no acceleration met the criterion.
    def testAStudyBeginsAtStartTimeWhateverHasRunInItsCase(self):
        case = self.incremental()
        self.call("caseDictionary", case, "system/controlDict", "-entry", "startFrom", "-set", "latestTime")
        self.call("incrementalDynamics", case)
        table = "postProcessing/incrementalDynamics/0/leastIntensity.dat"
        alone = self.read(case, table)
        shutil.rmtree(os.path.join(case, "postProcessing"))
        self.call("contactDynamics", case)
        done = self.runApplication("incrementalDynamics", case)
        self.assertEqual(self.read(case, table), alone)
        self.assertIn("The runs of this study begin at startTime", done.stderr)

    # Its blocks are in each other by up to 0.7 mm: refused, unless interfaces and a tolerance were stated.
    def testAPublishedAssemblyIsComputedAsItIs(self):
        published = os.path.join(tutorials, "limitAnalysis/space/importedAssemblies")
        case = self.case("limitAnalysis/space/importedAssemblies/structure", files={
            "constant/contactProperties": header % "contactProperties" + "friction { type Coulomb; mu 0.7; }",
            "system/blockTextureDict": header % "blockTextureDict" + "dimensions 3; texture { type import; format auto; file "
                                       f"\"{published}/structures/crossvault_assembly.json\"; }} supports {{ i {{ type import; }} }}"})
        done = self.runApplication("limitAnalysis", case)
        self.assertRegex(done.stdout, r"(?m)^Collapse load multiplier alpha = 0\.43951[0-9]*$")
        self.assertIn("Their joints are those that the file states", done.stderr)

    # They stayed, and reports had the name of a combination that is no more.
    def testTablesOfAnEarlierAnalysisAreRemoved(self):
        case = self.case("limitAnalysis/masonryPanels/wall1")
        folder = os.path.join(case, "postProcessing/limitAnalysis/0")
        for name in ("combinations.dat", "coulomb.dat", "capacity.dat", "capacity.svg"):
            os.makedirs(folder, exist_ok=True)
            self.write(folder, name, "of an earlier run")
        self.call("limitAnalysis", case)
        self.assertEqual([name for name in os.listdir(folder) if name.startswith(("comb", "coul", "capa"))], [])

    def testAReportSaysWhichBlocksNothingHolds(self):
        ground, floating = [(-5, -1), (5, -1), (5, 0), (-5, 0)], [(0, 1), (1, 1), (1, 2), (0, 2)]
        case = self.case("limitAnalysis/masonryPanels/wall1", files={
            "system/blockTextureDict": self.polygons(ground, floating)})
        self.call("limitAnalysis", case, "-report")
        self.assertIn("Cause: a block with no path to a support through joints: 1.", self.read(case, "report.html"))

    # The answer was `unstable` alone, as of a structure that nothing holds up.
    def testALoadThatHoldsAStructureUpHasARangeOfMultipliers(self):
        case = self.case("limitAnalysis/masonryPanels/wall1", files={
            "constant/loads": header % "loads" + "dead { type inertial; direction (1 0 0); } live { type gravity; }"})
        said = self.call("limitAnalysis", case)
        self.assertRegex(said, "(?m)^Status: unstable")
        self.assertRegex(said, r"(?m)^The live load holds the blocks up: they stand for alpha from 1\.5555\d\d to inf$")

    # The place was not named: at others another range holds the structure up, or none.
    def testThePlaceIsNamedAtWhichAMovingLoadHoldsAStructureUp(self):
        pier, slab = [(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1), (3, 1), (3, 1.5), (0, 1.5)]
        case = self.case("limitAnalysis/masonryPanels/wall1", files={
            "system/blockTextureDict": self.polygons([(-9, -1), (9, -1), (9, 0), (-9, 0)], pier, slab),
            "constant/loads": header % "loads" + "dead { type gravity; } live { type moving; from (0.1 2); to (2.9 2); "
                              "positions 8; value (0 -100000 0); }"})
        self.assertRegex(self.call("limitAnalysis", case),
                         r"(?m)^At 0 m along the path, from \(0\.1 2\), the live load holds the blocks up: they stand for "
                         r"alpha from 0\.\d+ to inf$")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
