#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""parameterSearch in a case: interruption, continuation, history, and points that cannot be computed.

parameterSearch.py BIN CASE       CASE: the tutorial liveLoadDirection
"""
import os
import re
import shutil
import signal
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from caseTest import CaseTest, applications, tutorial, header

search = header % "parameterSearchDict" + """
applications (blockTexture limitAnalysis);
variables { angle { file "constant/loads"; entry angle; bounds (%(bounds)s); } }
results { alpha { table "postProcessing/limitAnalysis/0/limitAnalysis.dat"; column %(column)s; %(otherwise)s } }
objective { goal minimise; value alpha; }
%(constraints)s
search ( { algorithm %(algorithm)s; maximumEvaluations %(evaluations)s; tolerance 1e-5; } );
"""
good = {"bounds": "0 90", "column": "alpha", "otherwise": "", "constraints": "", "algorithm": "SBPLX",
        "evaluations": "100"}


class ParameterSearch(CaseTest):
    application = "parameterSearch"

    def case(self, name, **changes):
        case = os.path.join(self.root.name, name)
        shutil.copytree(tutorial, case, ignore=shutil.ignore_patterns("VTK", "postProcessing", "log.*", "assembly",
                                                                      "parameterSearch"))
        self.set(case, **changes)
        return case

    @staticmethod
    def set(case, **changes):
        with open(os.path.join(case, "system/parameterSearchDict"), "w", encoding="utf-8") as file:
            file.write(search % {**good, **changes})

    def rows(self, case):
        """Points of the history without their times."""
        text = self.read(case, "postProcessing/parameterSearch/0/history.dat")
        return [line.split()[:-1] for line in text.splitlines() if not line.startswith("#")]

    def testASearchLeavesItsHistoryItsBestCaseAndTheCaseAsItWas(self):
        case = self.case("plain")
        before = self.read(case, "constant/loads")
        done = self.run_(case)
        self.assertRegex(done.stdout, r"Least alpha = 0\.54075")
        self.assertEqual(self.read(case, "constant/loads"), before)
        self.assertEqual(sorted(os.listdir(os.path.join(case, "parameterSearch"))), ["best"])
        best = self.read(case, "postProcessing/parameterSearch/0/best.dat").split()
        angle = float(best[best.index("evaluations") + 1])
        self.assertAlmostEqual(angle, 32.7353, delta=0.02)
        kept = self.read(case, "parameterSearch/best/constant/loads")
        self.assertAlmostEqual(float(re.search(r"^angle\s+(\S+);", kept, re.M).group(1)), angle, delta=1e-9)
        self.assertTrue(os.path.exists(os.path.join(case, "parameterSearch/best/VTK")))
        self.assertTrue(os.path.exists(os.path.join(case, "postProcessing/parameterSearch/0/parameterSearch.svg")))

    def testAnInterruptedSearchGoesOnAndEndsAsIfItHadNotBeen(self):
        whole = self.case("whole")
        self.run_(whole)
        for name, sent, status in (("interrupted", signal.SIGINT, 130), ("terminated", signal.SIGTERM, 143)):
            case = self.case(name)
            process = subprocess.Popen([os.path.join(applications, "parameterSearch"), "-case", case],
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            for line in process.stdout:
                if line.startswith("Evaluation 7:"):
                    process.send_signal(sent)
                    break
            output, errors = process.communicate(timeout=60)
            self.assertEqual(process.returncode, status, output + errors)
            self.assertIn("continues from here", output)
            known = self.rows(case)
            self.assertLess(len(known), len(self.rows(whole)))
            done = self.run_(case)
            self.assertEqual(len(re.findall(r"\(known\)", done.stdout)) >= len(known), True)
            self.assertEqual(self.rows(case), self.rows(whole))
            self.assertEqual(self.rows(case)[:len(known)], known)

    def testASearchThatIsDoneComputesNothingAnewAndOneThatGoesFurtherOnlyWhatIsNew(self):
        case = self.case("again", evaluations="12")
        self.assertIn("not converged: raise maximumEvaluations", self.run_(case, status=2).stdout)
        first = self.rows(case)
        self.assertLessEqual(len(first), 12)
        self.set(case)
        self.run_(case)
        self.assertGreater(len(self.rows(case)), len(first))
        self.assertEqual(self.rows(case)[:len(first)], first)
        known = self.read(case, "postProcessing/parameterSearch/0/history.dat")
        done = self.run_(case)
        self.assertEqual(self.read(case, "postProcessing/parameterSearch/0/history.dat"), known)
        self.assertEqual(len(re.findall(r"^Evaluation", done.stdout, re.M)), len(re.findall(r"known\)", done.stdout)))

    def testPraxisSaysThatItHasBeenOutsideTheBounds(self):
        case = self.case("praxis", algorithm="PRAXIS", evaluations="40", bounds="40 90")
        done = self.run_(case, status=2)
        self.assertRegex(done.stderr, r"PRAXIS knows no bounds[^$]*BOBYQA[^$]*search at line 8")
        said = re.search(r"not converged: PRAXIS has spent (\d+) of 40 evaluations outside the bounds.*take BOBYQA",
                         done.stdout)
        self.assertTrue(said, done.stdout)
        self.assertLessEqual(int(said.group(1)) + len(self.rows(case)), 40)
        self.assertGreater(int(said.group(1)), 0)

    def testAnExpressionWithoutAValueEndsTheSearchWithItsPlace(self):
        case = self.case("logarithm", constraints="constraints { own { value \"log(angle-95)\"; atLeast 0; } }",
                         algorithm="COBYLA")
        done = self.run_(case, status=1)
        self.assertIn("has no value at a point that the search came to", done.stderr)
        self.assertRegex(done.stderr, r"parameterSearchDict/constraints/own/value at line 7")

    def testPointsWhoseSearchByCoulombsLawIsCutShortAreCountedOnce(self):
        for name, limit, isEnded in (("endsAtOnce", 1e-9, True), ("hasTime", 1000, False)):
            case = self.case(name, evaluations="4", algorithm="DIRECT_L", bounds="0 20", otherwise="otherwise 10;")
            with open(os.path.join(case, "constant/contactProperties"), "w", encoding="utf-8") as file:
                file.write(header % "contactProperties" + "friction { type Coulomb; mu 0.65; flowRule nonAssociative; }\n")
            with open(os.path.join(case, "system/solution"), "w", encoding="utf-8") as file:
                file.write(header % "solution" + f"limitAnalysis\n{{ nonAssociative {{\nmaximumTime {limit}; }} }}\n")
            done = self.run_(case)
            points = len(self.rows(case))
            self.assertEqual(done.stderr.count("maximumTime has ended the search"), int(isEnded), done.stderr)
            if isEnded:
                self.assertIn(f"at {points} of {points} points", done.stderr)
                self.assertRegex(done.stderr, r"solution/limitAnalysis/nonAssociative/maximumTime at line "
                                 + str((header % "solution").count("\n") + 3))
                self.set(case, evaluations="4", algorithm="DIRECT_L", bounds="0 20")
                shutil.rmtree(os.path.join(case, "postProcessing/parameterSearch"))
                self.assertIn("maximumTime has ended the search", self.run_(case, status=1).stderr)

    def testAHistoryOfAnotherCaseIsRefused(self):
        case = self.case("changed", evaluations="3", algorithm="DIRECT_L")
        self.run_(case)
        properties = self.read(case, "constant/contactProperties")
        with open(os.path.join(case, "constant/contactProperties"), "w", encoding="utf-8") as file:
            file.write(properties.replace("0.65", "0.6"))
        done = self.run_(case, status=1)
        self.assertIn("Remove postProcessing/parameterSearch", done.stderr)
        self.assertIn("constant/contactProperties has changed", done.stderr)
        with open(os.path.join(case, "constant/contactProperties"), "w", encoding="utf-8") as file:
            file.write("// of the arch\n\n" + properties)
        self.run_(case)
        with open(os.path.join(case, "postProcessing/parameterSearch/0/history.dat"), "a", encoding="utf-8") as file:
            file.write("45 half a ro")
        lines = self.read(case, "postProcessing/parameterSearch/0/history.dat").count("\n")
        done = self.run_(case, status=1)
        self.assertIn(f"history.dat at line {lines + 1}.", done.stderr)

    def testACaseThatIsEditedMeanwhileHasNoPointsOfBoth(self):
        whole = self.case("unedited")
        self.run_(whole)
        for attempt in range(10):  # on a busy machine a search may end before this process comes to edit its case
            case = self.case(f"edited{attempt}")
            properties = self.read(case, "constant/contactProperties")
            with subprocess.Popen([os.path.join(applications, "parameterSearch"), "-case", case],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
                for line in process.stdout:
                    if line.startswith("Evaluation 3:"):
                        with open(os.path.join(case, "constant/contactProperties"), "w", encoding="utf-8") as file:
                            file.write(properties.replace("0.65", "0.3"))
                        break
                _, stopped = process.communicate(timeout=60)
            if process.returncode != 0:
                break
        self.assertEqual(process.returncode, 1, stopped)
        self.assertIn("constant/contactProperties has changed", stopped)
        self.assertIn("Restore what was there to continue", stopped)
        known = self.rows(case)
        self.assertGreaterEqual(len(known), 3)
        self.assertEqual(known, self.rows(whole)[:len(known)])
        with open(os.path.join(case, "constant/contactProperties"), "w", encoding="utf-8") as file:
            file.write(properties)
        self.run_(case)
        self.assertEqual(self.rows(case), self.rows(whole))

    def testAResultThatIsNotThereEndsTheSearchUnlessOtherwiseIsGiven(self):
        case = self.case("unbounded", bounds="-90 -80", algorithm="DIRECT_L", evaluations="4")
        done = self.run_(case, status=1)
        self.assertIn("no finite number for the result alpha at angle = -8", done.stderr)
        self.assertRegex(done.stderr, r"parameterSearchDict\S* at line 5")
        self.set(case, bounds="-90 -80", algorithm="DIRECT_L", evaluations="4", otherwise="otherwise 10;")
        done = self.run_(case)
        self.assertIn("Least alpha = 10", done.stdout)
        self.assertRegex(done.stderr, r"The best point has no alpha: 10 is its `otherwise`[^$]*otherwise at line 5")

    def testAColumnThatThereIsNotIsToldWithThoseThatThereAre(self):
        case = self.case("column", column="beta")
        for options in ((), ("-dry-run",)):
            done = self.run_(case, *options, status=1)
            self.assertIn("has no column beta", done.stderr)
            self.assertIn("alpha[-]", done.stderr)
            self.assertRegex(done.stderr, r"parameterSearchDict\S*column at line 5")
        self.assertFalse(os.path.exists(os.path.join(case, "parameterSearch")))

    def testATableThatNothingWritesIsToldBeforeTheFirstPoint(self):
        case = self.case("table")
        dictionary = os.path.join(case, "system/parameterSearchDict")
        text = self.read(case, "system/parameterSearchDict")
        for applications, table, told in (
                ("limitAnalysis", "postProcessing/limitAnalysis/0/limitAnalysi.dat", "Unknown limitAnalysis table limitAnalysi"),
                ("limitAnalysis", "postProcessing/limitAnalysis/O/limitAnalysis.dat", "into postProcessing/limitAnalysis/0, and not"),
                ("limitAnalysis", "postProcessin/limitAnalysis/0/limitAnalysis.dat", "their tables are in postProcessing."),
                ("contactDynamics", "postProcessing/enrgy/0/energy.dat", "postProcessing/enrgy")):
            with open(dictionary, "w", encoding="utf-8") as file:
                file.write(text.replace("limitAnalysis);", applications + ");")
                           .replace("postProcessing/limitAnalysis/0/limitAnalysis.dat", table))
            done = self.run_(case, "-dry-run", status=1)
            self.assertIn(told, done.stderr)
            self.assertRegex(done.stderr, r"parameterSearchDict\S*table at line 5")

    def testATableOfEffectsNeedsNoFunction(self):
        case = self.case("effects")
        dictionary = os.path.join(case, "system/parameterSearchDict")
        text = self.read(case, "system/parameterSearchDict")
        with open(dictionary, "w", encoding="utf-8") as file:
            file.write(text.replace("limitAnalysis);", "contactDynamics);")
                       .replace("postProcessing/limitAnalysis/0/limitAnalysis.dat", "postProcessing/effects/0/effects.dat"))
        self.run_(case, "-dry-run")

    def testATableThatIsNotWrittenEndsASearchByDirect(self):
        # The first point ended NLopt's DIRECT_L with SIGSEGV.
        case = self.case("notWritten", algorithm="DIRECT_L", evaluations="4",
                         constraints="constraints { rubs { value alpha; atLeast 0.3; } }")
        dictionary = os.path.join(case, "system/parameterSearchDict")
        text = self.read(case, "system/parameterSearchDict")
        with open(dictionary, "w", encoding="utf-8") as file:
            file.write(text.replace("limitAnalysis.dat", "coulomb.dat"))
        self.assertIn("have not written the table", self.run_(case, status=1).stderr)

    def testACaseThatIsFaultyIsToldAtItsFirstPoint(self):
        case = self.case("faulty")
        with open(os.path.join(case, "constant/g"), "w", encoding="utf-8") as file:
            file.write("value (0 -9.81);\nvalu 3;\n")
        done = self.run_(case, status=1)
        self.assertIn("The first point of the search cannot be computed", done.stderr)
        self.assertIn("valu", done.stderr)

        self.assertRegex(done.stderr, r"file: constant/g/valu at line 2")  # of the case, not of its copy
        self.assertNotIn("evaluation/constant", done.stderr)

    def testWhatApplicationsWarnOfIsSaidOnceAboutTheCase(self):
        case = self.case("improbable", evaluations="5", algorithm="DIRECT_L")
        with open(os.path.join(case, "constant/materialProperties"), "w", encoding="utf-8") as file:
            file.write("density 2.2;\n")
        dictionary = os.path.join(case, "system/parameterSearchDict")
        with open(dictionary, encoding="utf-8") as file:  # every friction coefficient that is tried is improbable
            text = file.read().replace('file "constant/loads"; entry angle; bounds (0 90);',
                                       'file "constant/contactProperties"; entry "friction/mu"; bounds (30 31);')
        with open(dictionary, "w", encoding="utf-8") as file:
            file.write(text)
        for options in ("-dry-run",), ():
            done = self.run_(case, *options)
            self.assertEqual(done.stderr.count("density = 2.2 [kg/m3] is unusual"), 1, done.stderr)
            self.assertEqual(len(re.findall(r"mu = 30(\.\d+)? \[-\] is unusual", done.stderr)), 1, done.stderr)
            self.assertIn(f"file: {case}/constant/materialProperties/density at line 1.", done.stderr)
            self.assertEqual(done.stderr.count("--> DRYSTONE Warning"), 2, done.stderr)

    def testAnUnreadableFirstPointCountsWhereOtherwiseIsGivenButNotASecondOne(self):
        case = self.case("badBound", otherwise="otherwise -1;", algorithm="bisection",
                         constraints="constraints { rubs { value alpha; atLeast 0.3; } }")
        dictionary = os.path.join(case, "system/parameterSearchDict")
        with open(dictionary, encoding="utf-8") as file:
            text = file.read()
        text = text.replace('file "constant/loads"; entry angle; bounds (0 90);',
                            'file "constant/contactProperties"; entry "friction/mu"; bounds (-0.5 0.5);')
        with open(dictionary, "w", encoding="utf-8") as file:
            file.write(text.replace("minimise; value alpha;", "minimise; value angle;"))
        done = self.run_(case)
        self.assertIn(f"At 1 of {len(self.rows(case))} points an application failed", done.stdout)
        with open(dictionary, encoding="utf-8") as file:
            looser = file.read().replace("tolerance 1e-5", "tolerance 0.1")
        with open(dictionary, "w", encoding="utf-8") as file:
            file.write(looser)
        again = self.run_(case).stdout
        evaluations = again.count("Evaluation ")
        self.assertLess(evaluations, len(self.rows(case)))
        self.assertIn(f"At 1 of {evaluations} points an application failed", again)  # those of the first search are not its own
        faulty = self.case("badBounds", otherwise="otherwise -1;")
        with open(os.path.join(faulty, "constant/g"), "a", encoding="utf-8") as file:
            file.write("valu 3;\n")
        self.assertIn("The first points of the search cannot be computed", self.run_(faulty, status=1).stderr)

    def testACopyIncludesWhatTheCaseIncludesFromOutside(self):
        case = self.case("sharing")
        shared = os.path.join(self.root.name, "shared")
        os.rename(os.path.join(case, "constant/g"), shared)
        with open(os.path.join(case, "constant/g"), "w", encoding="utf-8") as file:
            file.write('#include "../../shared"\n')
        self.assertRegex(self.run_(case).stdout, r"Least alpha = 0\.54075")

    def testConstraintsThatNothingMeetsGiveNoAnswer(self):
        case = self.case("infeasible", constraints="constraints { strong { value alpha; atLeast 100; } }",
                         algorithm="COBYLA")
        done = self.run_(case, status=2)
        self.assertIn("No point that was tried meets the constraints", done.stdout)
        self.assertNotIn("Least alpha", done.stdout)

    def testABisectionSaysThatNeitherBoundMeetsTheConstraints(self):
        case = self.case("beyond", constraints="constraints { strong { value alpha; atLeast 100; } }",
                         algorithm="bisection", bounds="0 20")
        done = self.run_(case, status=2)
        self.assertIn("not converged: neither bound meets the constraints", done.stdout)

    def testADryRunReadsTheCaseThatIsVaried(self):
        case = self.case("dryFault")
        with open(os.path.join(case, "constant/contactProperties"), "a", encoding="utf-8") as file:
            file.write("cohesoin { c 1; }\n")
        before = sorted(os.listdir(case))
        done = self.run_(case, "-dry-run", status=1)
        self.assertIn("cohesoin", done.stderr)
        self.assertEqual(sorted(os.listdir(case)), before)

    def testDryRunChecksAndComputesNothing(self):
        case = self.case("dry")
        done = self.run_(case, "-dry-run")
        self.assertIn("Objective: minimise alpha", done.stdout)
        self.assertFalse(os.path.exists(os.path.join(case, "parameterSearch")))
        self.assertFalse(os.path.exists(os.path.join(case, "postProcessing")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
