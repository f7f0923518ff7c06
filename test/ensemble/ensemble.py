#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""ensemble in a case: the same table for any number of processes, after kills, crashes and Ctrl-C.

ensemble.py BIN CASE       CASE: the tutorial masonryPanels
"""
import hashlib
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from caseTest import CaseTest, applications, tutorial, header

dictionary = header % "ensembleDict" + """
applications (%(applications)s);
variables
{
    mu { file "constant/contactProperties"; entry "friction/mu";
         distribution { type lognormal; median 0.65; beta 0.15; minimum 0.2; maximum 1.2; } }
    unit { file "system/blockTextureDict"; entry "unitLength"; distribution { type uniform; minimum 0.35; maximum 0.45; } }
}
design { type %(design)s; samples %(samples)d; seed 1; }
results { alpha { table "postProcessing/limitAnalysis/0/limitAnalysis.dat"; column alpha; } }
failures { %(failures)s }
statistics { %(statistics)s }
"""
good = {"applications": "blockTexture limitAnalysis", "design": "latinHypercube", "samples": 300, "failures": "",
        "statistics": "capacity { type distribution; value alpha; }"}


class Ensemble(CaseTest):
    application = "ensemble"

    def case(self, name, **changes):
        case = os.path.join(self.root.name, name)
        self.copyInput(os.path.join(tutorial, "wall1"), case)
        texture = os.path.join(case, "system/blockTextureDict")
        with open(texture, encoding="utf-8") as file:
            text = file.read()
        with open(texture, "w", encoding="utf-8") as file:
            file.write(text.replace("dimensions      2;", "dimensions      2;\nunitLength 0.4;")
                       .replace("(0.4 0.175)", "($unitLength 0.175)"))
        self.set(case, **changes)
        return case

    def alike(self, name, **changes):
        """A case with friction alone uncertain, whose samples are computed together."""
        made = self.case(name, **{"samples": 1500, "design": "random", **changes})
        self.edit(made, "system/ensembleDict", "    unit { file \"system/blockTextureDict\"; entry \"unitLength\"; "
                  "distribution { type uniform; minimum 0.35; maximum 0.45; } }\n", "")
        return made

    def edit(self, case, name, old, new):
        text = self.read(case, name)
        self.assertIn(old, text)
        with open(os.path.join(case, name), "w", encoding="utf-8") as written:
            written.write(text.replace(old, new))

    @staticmethod
    def set(case, **changes):
        with open(os.path.join(case, "system/ensembleDict"), "w", encoding="utf-8") as file:
            file.write(dictionary % {**good, **changes})

    def table(self, case):
        """samples.dat without the CPU times."""
        lines = self.read(case, "postProcessing/ensemble/0/samples.dat").splitlines()
        return [line.split()[:-1] for line in lines]

    def digest(self, case):
        return hashlib.md5(repr(self.table(case)).encode()).hexdigest()

    def start(self, case, *options):
        return subprocess.Popen([os.path.join(applications, "ensemble"), "-case", case, *options],
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    @staticmethod
    def rowsOf(case):
        """Rows of the journals so far."""
        work = os.path.join(case, "postProcessing/ensemble/0/work")
        count = 0
        for name in os.listdir(work) if os.path.isdir(work) else []:
            if name.startswith("journal."):
                with open(os.path.join(work, name), encoding="utf-8") as file:
                    count += sum(line.endswith(" ;\n") for line in file)
        return count

    @staticmethod
    def ofProcess(process, name):
        """What /proc tells of a process; nothing of one that has ended meanwhile."""
        try:
            with open(f"/proc/{process}/{name}", encoding="utf-8") as file:
                return file.read().strip()
        except (FileNotFoundError, ProcessLookupError):
            return ""

    @classmethod
    def childrenOf(cls, process):
        return [int(word) for word in cls.ofProcess(process, f"task/{process}/children").split()]

    def runUntilItIsHit(self, name, jobs, hit, make=None):
        """A run of more than 20 samples that is hit before its end. On a busy machine it may end before this process
        comes to hit it: then another case is begun.

        hit(process)       whether there was something to hit
        """
        for attempt in range(10):
            case = (make or self.case)(f"{name}{attempt}")
            process = self.start(case, "-jobs", jobs)
            self.waitFor(lambda: self.rowsOf(case) > 20, process)
            isHit = process.poll() is None and hit(process)
            status = process.wait()
            if isHit:
                return case, status
        return self.fail("all runs ended before they were hit")

    @classmethod
    def reference(cls):
        """The table of one process."""
        if not hasattr(cls, "known"):
            test = cls("testItsTableAndStatistics")
            case = test.case("reference")
            test.run_(case, "-jobs", "1")
            cls.known = test.digest(case)
        return cls.known

    def waitFor(self, condition, process, seconds=60):
        end = time.monotonic() + seconds
        while not condition() and time.monotonic() < end and process.poll() is None:
            time.sleep(0.005)

    def testItsTableAndStatistics(self):
        case = self.case("plain")
        done = self.run_(case, "-jobs", "2")
        table = self.table(case)
        self.assertEqual(table[0], "# sample[-] mu unit alpha status[-] attempts[-]".split())
        self.assertEqual(len(table), 301)
        self.assertEqual([row[0] for row in table[1:]], [str(i) for i in range(300)])
        self.assertTrue(all(row[4:] == ["0", "1"] for row in table[1:]))
        alphas = [float(row[3]) for row in table[1:]]
        statistics = dict((line.split()[1], float(line.split()[2])) for line in
                          self.read(case, "postProcessing/ensemble/0/statistics.dat").splitlines()[1:])
        self.assertAlmostEqual(statistics["mean"], sum(alphas) / 300, places=9)
        self.assertIn("</svg>", self.read(case, "postProcessing/ensemble/0/capacity.svg"))
        csv = self.read(case, "postProcessing/ensemble/0/samples.csv").splitlines()
        self.assertEqual(csv[0], "sample,mu,unit,alpha,status,attempts,cpuTime")
        self.assertEqual(csv[1].split(",")[:-1], table[1])
        self.assertRegex(done.stdout, r"Samples: 300 of 300")
        self.assertEqual(self.digest(case), self.reference())
        # Nothing is left to do, and nothing of it changes.
        again = self.run_(case)
        self.assertEqual(self.digest(case), self.reference())
        self.assertRegex(again.stdout, r"Samples: 300 of 300")
        # Statistics may change afterwards.
        self.set(case, statistics="tail { type distribution; value \"alpha / mu\"; }")
        self.assertIn("tail", self.run_(case, "-postProcess").stdout)
        # The samples may not.
        self.set(case, samples=400)
        refused = self.run_(case, status=1)
        self.assertIn("belongs to another ensemble", refused.stderr)
        self.assertIn("design of system/ensembleDict has changed", refused.stderr)

    def testPostProcessWritesNothingOfOtherQuestions(self):
        case = self.case("otherQuestions", samples=5)
        self.run_(case)
        before = self.read(case, "postProcessing/ensemble/0/samples.dat")
        for old, new, changed in (("median 0.65", "median 0.4", "variables"), ("column alpha", "column gap", "results"),
                                  ("seed 1", "seed 2", "design"),
                                  ("(blockTexture limitAnalysis)", "(blockTexture checkBlocks limitAnalysis)",
                                   "applications")):
            self.edit(case, "system/ensembleDict", old, new)
            refused = self.run_(case, "-postProcess", status=1)
            self.assertRegex(refused.stderr, changed + " of system/ensembleDict ha(ve|s) changed")
            self.assertEqual(self.read(case, "postProcessing/ensemble/0/samples.dat"), before)
            self.edit(case, "system/ensembleDict", new, old)
        # The values of the samples are the same: their results are those of the case as it was, and it is said.
        self.edit(case, "constant/materialProperties", "unitWeight ", "unitWeight 1")
        warned = self.run_(case, "-postProcess")
        self.assertRegex(warned.stderr + warned.stdout,
                         r"those of other input: constant/materialProperties has changed\.")
        self.assertEqual(self.read(case, "postProcessing/ensemble/0/samples.dat"), before)
        shutil.rmtree(os.path.join(case, "postProcessing/ensemble/0/work"))
        self.assertIn("no samples to process", self.run_(case, "-postProcess", status=1).stderr)
        self.assertEqual(self.read(case, "postProcessing/ensemble/0/samples.dat"), before)

    def testItContinuesBesideFilesThatNoSampleReads(self):
        case = self.case("otherFiles", samples=5, design="random")
        self.run_(case)
        for samples, name in enumerate(("log", "out.txt", "nohup.out", "slurm-1.out", "report.html", "Allrun", "a.png",
                                        "constant/contactProperties.orig", "system/controlDict~",
                                        "system/.controlDict.swp", "system/accuracyCostDict",
                                        "constant/assembly/blocks"), 6):
            os.makedirs(os.path.dirname(os.path.join(case, name)), exist_ok=True)
            with open(os.path.join(case, name), "w", encoding="utf-8") as file:
                file.write("x")
            self.set(case, samples=samples, design="random")
            self.run_(case)
        # Comments and layout say nothing; what samples read is named.
        for name, old, new in (("constant/materialProperties", "unitWeight", "// [N/m3]\n\nunitWeight   "),
                               ("system/controlDict", "FoamFile", "// of the wall\nFoamFile")):
            self.edit(case, name, old, new)
            self.run_(case)
        for name, old, new in (("constant/materialProperties", "1000;", "1001;"),
                               ("system/controlDict", "FoamFile", "writeFormat binary;\nFoamFile")):
            text = self.read(case, name)
            self.edit(case, name, old, new)
            self.assertIn(f": {name} has changed.", self.run_(case, status=1).stderr)
            with open(os.path.join(case, name), "w", encoding="utf-8") as file:
                file.write(text)
        self.run_(case)
        # A macro is not its value, and what is written counts: a variable may be what it stands for.
        self.edit(case, "system/blockTextureDict", "($unitLength", "(#calc \"$unitLength\"")
        self.assertIn(": system/blockTextureDict has changed.", self.run_(case, status=1).stderr)

    def testACaseThatIsEditedMeanwhileHasNoSamplesOfBoth(self):
        for applications in ("blockTexture limitAnalysis \"./edit\"", "\"./edit\" blockTexture limitAnalysis"):
            case = self.case("edited" + str(len(os.listdir(self.root.name))), applications=applications, samples=40)
            loads = self.read(case, "constant/loads")
            with open(os.path.join(case, "edit"), "w", encoding="utf-8") as file:
                # The tenth sample, as the others, is computed in a copy of the case; it edits the case itself.
                file.write(f"#!/bin/bash\necho >> {self.root.name}/calls\n"
                           f"[ $(wc -l < {self.root.name}/calls) = 10 ] || exit 0\n"
                           f"sed -i 's/(1 0 0)/(-1 0.5 0)/' {case}/constant/loads\n")
            os.chmod(os.path.join(case, "edit"), 0o755)
            if os.path.exists(os.path.join(self.root.name, "calls")):
                os.remove(os.path.join(self.root.name, "calls"))
            stopped = self.run_(case, "-jobs", "1", status=1).stderr
            self.assertIn("constant/loads has changed", stopped)
            self.assertIn("Restore what was there to continue", stopped)
            self.assertLess(self.rowsOf(case), 10)
            self.assertFalse(os.path.exists(os.path.join(case, "postProcessing/ensemble/0/samples.dat")))
            with open(os.path.join(case, "constant/loads"), "w", encoding="utf-8") as file:
                file.write(loads)
            self.run_(case)
            whole = self.case("unedited" + str(len(os.listdir(self.root.name))), samples=40)
            self.run_(whole)
            self.assertEqual(self.table(case), self.table(whole))

    def testFilesThatScriptsAndDictionariesReadCount(self):
        case = self.case("scripts", samples=2, design="random", applications='"./prepare" blockTexture limitAnalysis')
        os.makedirs(os.path.join(case, "../common"))
        for name, text in (("prepare", "#!/bin/sh\ncat template > /dev/null\n"), ("template", "a\n"),
                           ("../common/density", "// nothing\ndensity 2000;\n"), ("notes", "a\n")):
            with open(os.path.join(case, name), "w", encoding="utf-8") as file:
                file.write(text)
        os.chmod(os.path.join(case, "prepare"), 0o755)
        with open(os.path.join(case, "constant/materialProperties"), "w", encoding="utf-8") as file:
            file.write('#include "%s/common/density"\n' % self.root.name)
        self.run_(case)
        for name in "prepare", "template", "../common/density":
            with open(os.path.join(case, name), "a", encoding="utf-8") as file:
                file.write("\n")
            self.assertIn(f"{name} has changed", self.run_(case, status=1).stderr)
        with open(os.path.join(case, "notes"), "a", encoding="utf-8") as file:
            file.write("b\n")
        self.assertNotIn("notes", self.run_(case, status=1).stderr)

    def testItsSamplesAreThoseOfTheApplications(self):
        case = self.case("byFiles", applications="blockTexture checkBlocks limitAnalysis", samples=6)
        self.run_(case)
        self.assertIn("in a copy of the case", self.run_(case, "-dry-run").stdout)
        inProcess = self.case("inProcess", samples=6)
        self.run_(inProcess)
        self.assertEqual(self.table(case), self.table(inProcess))
        self.assertEqual(os.path.exists(os.path.join(inProcess, "constant/assembly")), False)

    def testAnImportedFileIsThatOfTheCaseFromWhereverItRuns(self):
        """Samples in the process looked for the drawing in the working directory: all of them failed."""
        drawn = self.alike("drawn", samples=4, statistics="")
        imported = self.alike("imported", samples=4, statistics="")
        self.runApplication("blockTexture", drawn)
        self.runApplication("exportBlocks", drawn, "-format", "dxf", "-output", os.path.join(imported, "wall.dxf"))
        with open(os.path.join(imported, "system/blockTextureDict"), "w", encoding="utf-8") as file:
            file.write(header % "blockTextureDict" + """
dimensions 2;
texture { type import; file "wall.dxf"; thickness 1; }
supports { ground { type import; } }
""")
        for case in drawn, imported:
            self.run_(case)
        for row, expected in zip(self.table(imported)[1:], self.table(drawn)[1:], strict=True):
            self.assertEqual(row[3], "0")
            self.assertAlmostEqual(float(row[2]), float(expected[2]), places=7)

    def testFiguresOfBlocksThatAreNotThereAreRefusedAtOnce(self):
        for name, block, status in (("there", 30, 0), ("beyond", 4000, 1)):
            case = self.case(name, applications="blockTexture contactDynamics", samples=4, statistics="")
            self.edit(case, "system/ensembleDict", 'results { alpha { table "postProcessing/limitAnalysis/0/limitAnalysis.dat"; '
                      "column alpha; } }", "results { turn { type rotation; block %d; } }" % block)
            done = self.run_(case, "-dry-run", status=status)
            self.assertEqual("ensembleDict" in done.stderr, status == 1, done.stderr)

    def testTablesThatNothingWritesAreRefusedAtOnce(self):
        case = self.case("tables", applications="blockTexture contactDynamics", samples=4, statistics="")
        self.edit(case, "system/ensembleDict", "limitAnalysis/0/limitAnalysis.dat", "enrgy/0/energy.dat")
        for options in (("-dry-run",), ()):
            done = self.run_(case, *options, status=1)
            self.assertIn("postProcessing/enrgy", done.stderr)
            self.assertRegex(done.stderr, r"ensembleDict\S*/table at line")
        controlDict = os.path.join(case, "system/controlDict")
        with open(controlDict, "a", encoding="utf-8") as file:
            file.write("functions { energy { } }\n")
        self.assertIn("Did you mean energy?", self.run_(case, status=1).stderr)

    def testCurvesOfAResultAreRefusedAtOnce(self):
        for number, statistic in enumerate(("type fractiles; intensity mu; response alpha; curve alpha;",
                                            "type fragility; intensity mu; exceeded \"alpha > 0.6\"; "
                                            "method truncatedIDA; curve alpha;")):
            case = self.case("curves%d" % number, samples=4, statistics="curves { %s }" % statistic)
            done = self.run_(case, "-jobs", "1", status=1)
            self.assertIn("Unknown variable alpha", done.stderr)
            self.assertRegex(done.stderr, r"ensembleDict\S*/curve at line")

    def testRecordsThatAreNotThereAreRefusedAtOnce(self):
        case = self.case("records", applications="blockTexture contactDynamics", samples=9, statistics="")
        self.edit(case, "system/ensembleDict", 'results { alpha { table "postProcessing/limitAnalysis/0/limitAnalysis.dat"; '
                  "column alpha; } }", "results { top { type displacement; block 1; } }")
        self.edit(case, "system/ensembleDict", "variables\n{", "variables\n{\n"
                  '    record { file "constant/groundMotion"; entry "horizontal/file";\n'
                  '             distribution { type list; values ("constant/a.csv" "constant/b.csv" "constant/c.csv"); } }')
        with open(os.path.join(case, "constant/groundMotion"), "w", encoding="utf-8") as file:
            file.write('horizontal { type record; file "constant/a.csv"; unit "m/s2"; }\n')
        for name in "ac":
            with open(os.path.join(case, "constant/%s.csv" % name), "w", encoding="utf-8") as file:
                file.write("0,0\n0.01,1\n0.02,0\n")
        done = self.run_(case, status=1)
        self.assertIn("There is no file constant/b.csv", done.stderr)
        self.assertRegex(done.stderr, r"ensembleDict\S*/distribution at line")

    def testACaseThatCannotBeReadIsRefusedAtOnce(self):
        for name, applications in {"unread": "blockTexture limitAnalysis",
                                   "unreadCopy": "blockTexture checkBlocks limitAnalysis"}.items():
            case = self.case(name, applications=applications, samples=40)
            with open(os.path.join(case, "constant/contactProperties"), "a", encoding="utf-8") as file:
                file.write("cohesoin { c 1; }\n")
            before = sorted(os.listdir(case)), sorted(os.listdir(self.root.name))
            done = self.run_(case, "-dry-run", status=1)
            self.assertIn("cohesoin", done.stderr)
            self.assertEqual((sorted(os.listdir(case)), sorted(os.listdir(self.root.name))), before)
            self.assertIn("cohesoin", self.run_(case, status=1).stderr)
            # The folder that programs share is there before one of them tries the case, and stays.
            self.assertEqual(os.listdir(os.path.join(case, "postProcessing/ensemble/0/work")), [])
            self.assertNotIn("Samples: 40 of 40", done.stdout)

    def testRecordsOutsideConstantCount(self):
        case = self.case("recordsBeside")
        for name in ("a", "b"):
            os.makedirs(os.path.join(case, "records"), exist_ok=True)
            with open(os.path.join(case, f"records/{name}.csv"), "w", encoding="utf-8") as file:
                file.write("t [s],a [m/s2]\n0,0\n0.05,1\n0.1,0\n")
        for name, text in {
                "constant/groundMotion": 'direction (1 0 0);\nacceleration { type record; file "records/a.csv"; format csv; }\n',
                "system/controlDict": "application contactDynamics; startFrom startTime; startTime 0; stopAt endTime;\n"
                                      "endTime 0.1; deltaT 0.01; writeControl runTime; writeInterval 1;\n",
                "system/ensembleDict": 'applications (blockTexture contactDynamics);\nvariables { record { file "constant/'
                                       'groundMotion"; entry "acceleration/file"; distribution { type list; values '
                                       '("records/a.csv" "records/b.csv"); } } }\ndesign { type grid; }\n'
                                       'results { drift { type displacement; } }\n'}.items():
            with open(os.path.join(case, name), "w", encoding="utf-8") as file:
                file.write(text)
        self.run_(case)
        self.run_(case)
        with open(os.path.join(case, "records/b.csv"), "a", encoding="utf-8") as file:
            file.write("0.2,0\n")
        self.assertIn("records/b.csv has changed", self.run_(case, status=1).stderr)

    def testWhatApplicationsWarnOfIsSaidOnceAboutTheCase(self):
        for name, applications in {"improbable": "blockTexture limitAnalysis",
                                   "improbableCopy": "blockTexture checkBlocks limitAnalysis"}.items():
            case = self.case(name, applications=applications, samples=4)
            with open(os.path.join(case, "constant/materialProperties"), "w", encoding="utf-8") as file:
                file.write("density 2.2;\n")
            for options in ("-dry-run",), ():
                done = self.run_(case, *options)
                self.assertEqual(done.stderr.count("density = 2.2 [kg/m3] is unusual"), 1, done.stderr)
                self.assertIn(f"file: {case}/constant/materialProperties/density at line 1.", done.stderr)

    def testProcessesAreAWholeNumber(self):
        case = self.case("jobs", samples=4)
        for jobs in ("1.5", "1e3", "2x", "3 4", "0", "1025"):
            self.assertIn("is no number of processes", self.run_(case, "-jobs", jobs, status=1).stderr, jobs)

    def testAScriptThatIsNotThereIsRefusedAtOnce(self):
        case = self.case("script", applications='"./prepare" blockTexture limitAnalysis', samples=4)
        done = self.run_(case, status=1)
        self.assertRegex(done.stderr, r"The script ./prepare of the case cannot be run")
        self.assertIn("ensembleDict/applications at line", done.stderr)

    def testSamplesThatShareBlocksAreThoseOfTheApplications(self):
        """Blocks are kept from one sample to the next where their dictionary says the same."""
        changes = {"samples": 12, "design": "random"}
        cases = {"sharedByFiles": {"applications": "blockTexture checkBlocks limitAnalysis", **changes},
                 "shared": changes}
        for name, ofCase in cases.items():
            case = self.case(name, **ofCase)
            self.edit(case, "system/ensembleDict", "distribution { type uniform; minimum 0.35; maximum 0.45; }",
                      "distribution { type list; values (0.35 0.45); }")
            self.run_(case, "-jobs", "1")
        tables = [self.table(os.path.join(self.root.name, name)) for name in cases]
        self.assertEqual(*tables)
        units = [row[2] for row in tables[0][1:]]
        same = sum(one == next for one, next in zip(units, units[1:]))
        self.assertTrue(0 < same < len(units) - 1, units)

    def testSamplesThatAreComputedTogetherAreThoseOfTheApplications(self):
        """Friction alone is uncertain, so that limit analyses are solved several at once: to the tolerance as by the
        application, and the same to the last digit whatever samples are computed with one."""
        case = self.alike

        def alphas(of):
            return [float(row[2]) for row in self.table(of)[1:]]

        together = case("together")
        self.assertIn("several samples at once", self.run_(together, "-jobs", "1").stdout)
        byFiles = case("togetherByFiles", applications="blockTexture checkBlocks limitAnalysis", samples=6)
        self.run_(byFiles)
        for one, other in zip(alphas(byFiles), alphas(together)):
            self.assertAlmostEqual(one, other, delta=1e-9 * one)
        # In other company: other samples in the table, two processes, an interruption.
        fewer = case("togetherFewer", samples=201)
        self.run_(fewer, "-jobs", "2")
        self.assertEqual(self.table(fewer), self.table(together)[:202])
        stopped = case("togetherStopped")
        process = self.start(stopped, "-jobs", "2")
        self.waitFor(lambda: self.rowsOf(stopped) > 20, process)
        process.send_signal(signal.SIGINT)
        process.wait()
        self.run_(stopped, "-jobs", "2")
        self.assertEqual(self.table(stopped), self.table(together))
        # One by itself.
        with open(os.path.join(together, "one.in"), "w", encoding="utf-8") as file:
            file.write(f"1\nmu {self.table(together)[8][1]}\n")
        results = os.path.join(together, "one.out")
        self.run_(together, "-evaluate", os.path.join(together, "one.in"), results)
        with open(results, encoding="utf-8") as file:
            self.assertAlmostEqual(float(file.read()), alphas(together)[7], delta=1e-10)

    def testLeastIntensitiesAreThoseOfTheApplication(self):
        tables = []
        for name, applications_ in (("leastInProcess", "blockTexture incrementalDynamics"),
                                    ("leastByFiles", "blockTexture checkBlocks incrementalDynamics")):
            case = self.case(name, applications=applications_, samples=3, statistics="")
            for file, old, new in (("system/ensembleDict", "limitAnalysis/0/limitAnalysis.dat\"; column alpha",
                                    "incrementalDynamics/0/leastIntensity.dat\"; column leastIntensity"),
                                   ("system/controlDict", "endTime         1;\ndeltaT          1;",
                                    "endTime 0.1;\ndeltaT 0.01;")):
                self.edit(case, file, old, new)
            with open(os.path.join(case, "system/incrementalDynamicsDict"), "w", encoding="utf-8") as written:
                written.write("intensity { type bisection; unit g; low 0.3; high 1.1; tolerance 0.05; }\n"
                              "criterion { type motion; displacement 1e-6; }\n")
            with open(os.path.join(case, "constant/groundMotion"), "w", encoding="utf-8") as written:
                written.write("direction (1 0 0);\nacceleration { type constant; value 1; }\n")
            self.run_(case)
            tables.append(self.table(case))
        self.assertEqual(tables[0], tables[1])
        self.assertTrue(all(0.4 < float(row[3]) < 1 for row in tables[0][1:]), tables[0])

    def testMotionsInSpaceHaveFigures(self):
        """A box under a pulse a of the ground of length T slides (a - mu g) a T^2/(2 mu g) along it."""
        case = os.path.join(self.root.name, "space")
        self.copyInput(os.path.join(tutorial, "../../contactDynamics/slidingBlock/basePulse"), case)
        for file, pattern, text in (
                ("constant/g", r"\(0 -9[.]81 0\)", "(0 0 -9.81)"),
                ("constant/groundMotion", r"\(1 0 0\)", "(3 4 0)"),
                ("system/blockTextureDict", r"(?s)dimensions.*",
                 "dimensions 3;\ntexture { type boxes; blocks ( ((0 0 0) (0.5 0.5 0.2)) ); }\n"
                 "supports { ground { type ground; } }\n"),
                ("system/controlDict", r"(?s)functions\s*\{.*", "")):
            before = self.read(case, file)
            after = re.sub(pattern, text, before)
            with open(os.path.join(case, file), "w", encoding="utf-8") as written:
                written.write(after)
            self.assertTrue(before != after or "controlDict" in file, file)
        with open(os.path.join(case, "system/ensembleDict"), "w", encoding="utf-8") as written:
            written.write(header % "ensembleDict" + """
applications (blockTexture contactDynamics);
variables { mu { file "constant/contactProperties"; entry "friction/mu"; distribution { type list; values (0.2 0.3); } } }
design { type grid; }
results
{
    way  { type displacement; block 0; direction (3 4 0); take last; }
    far  { type displacement; }
    turn { type rotation; }
    drop { type drop; }
    lost { type energy; part frictionLoss; }
}
""")
        self.run_(case)
        a, duration, mass = 4.905, 0.5, 0.5 * 0.5 * 0.2 * 2000
        for row in self.table(case)[1:]:
            mu, way, far, turn, drop, lost = (float(word) for word in row[1:7])
            slip = (a - mu * 9.81) * a * duration**2 / (2 * mu * 9.81)
            self.assertAlmostEqual(abs(way) / slip, 1, delta=0.02, msg=row)
            self.assertAlmostEqual(far, abs(way), places=9)
            self.assertLess(turn, 1e-9)
            self.assertLess(drop, 1e-9)
            self.assertAlmostEqual(lost / (mu * mass * 9.81 * slip), 1, delta=0.03)
        refused = self.read(case, "system/ensembleDict").replace("{ type rotation; }", "{ type returnTime; block 0; }")
        with open(os.path.join(case, "system/ensembleDict"), "w", encoding="utf-8") as written:
            written.write(refused)
        shutil.rmtree(os.path.join(case, "postProcessing"))
        self.assertIn("returnTime is a figure of the plane", self.run_(case, status=1).stderr)

    def testAnApplicationThatSomebodyEndsIsBegunAgain(self):
        case = self.case("ended", applications="blockTexture \"./nap\" limitAnalysis", samples=4)
        with open(os.path.join(case, "nap"), "w", encoding="utf-8") as file:
            file.write("#!/bin/bash\nexec sleep 1\n")
        os.chmod(os.path.join(case, "nap"), 0o755)
        process = self.start(case, "-jobs", "1")

        ended = []

        def end():
            for worker in self.childrenOf(process.pid):
                for child in self.childrenOf(worker):
                    if not ended and self.ofProcess(child, "comm") == "sleep":
                        os.kill(child, signal.SIGTERM)
                        ended.append(child)
            return ended

        self.waitFor(end, process)
        self.assertEqual(len(ended), 1)
        self.assertEqual(process.wait(), 0)
        self.assertTrue(all(row[4:] == ["0", "1"] for row in self.table(case)[1:]))
        with open(os.path.join(case, "postProcessing/ensemble/0/work/failures"), encoding="utf-8") as file:
            self.assertEqual(len(file.readlines()), 1)

    def testMoreRandomSamplesExtendTheTable(self):
        for design in ("random", "sobol"):
            case = self.case("more" + design, design=design, samples=20)
            self.run_(case)
            few = self.table(case)
            self.set(case, design=design, samples=30)
            self.run_(case)
            self.assertEqual(self.table(case)[:21], few)
            self.assertEqual(len(self.table(case)), 31)

    def testKillsLoseNothing(self):
        case = self.case("killed")
        random.seed(1)
        for kills in range(8):
            process = self.start(case, "-jobs", "2")
            before = self.rowsOf(case)
            self.waitFor(lambda: self.rowsOf(case) > before + random.randint(0, 40), process)
            if process.poll() is not None:
                break
            victims = self.childrenOf(process.pid) + [process.pid]
            victim = random.choice(victims)
            try:
                os.kill(victim, signal.SIGKILL)
            except ProcessLookupError:
                process.wait()  # a worker that has ended meanwhile: all is done
                break
            if victim == process.pid:
                process.wait()
            else:
                self.waitFor(lambda: self.rowsOf(case) > before + 60, process)
                process.kill()
                process.wait()
        self.run_(case, "-jobs", "3")
        self.assertEqual(self.digest(case), self.reference())

    def testAWorkerThatCrashesIsReplaced(self):
        def crash(process):
            workers = self.childrenOf(process.pid)
            if workers:
                os.kill(workers[0], signal.SIGSEGV)
            return bool(workers)

        case, status = self.runUntilItIsHit("crashed", "2", crash)
        self.assertEqual(status, 0)
        self.assertEqual(self.digest(case), self.reference())

    def testACrashOfSamplesThatAreComputedTogetherIsBlamedOnNone(self):
        """They are begun again one by one, each with all of its attempts; so are those that together take longer than
        one of them may."""
        def abort(process):
            workers = self.childrenOf(process.pid)
            if workers:
                os.kill(workers[0], signal.SIGABRT)  # as a fault of its own
            return bool(workers)

        def hold(process):
            workers = self.childrenOf(process.pid)
            if not workers:
                return False
            os.kill(workers[0], signal.SIGSTOP)
            time.sleep(2.5)
            try:
                os.kill(workers[0], signal.SIGCONT)
            except ProcessLookupError:
                return True  # it was late with samples in hand
            return False

        whole = self.alike("wholeTogether")
        self.run_(whole)
        said = ""
        for name, hit in (*((f"abortedTogether{i}.", abort) for i in range(3)), ("heldTogether", hold)):
            case, status = self.runUntilItIsHit(
                name, "1", hit, lambda name: self.alike(name, failures="attempts 1; maximumTime 1;"))
            self.assertEqual(status, 0, name)
            self.assertEqual(self.table(case), self.table(whole), name)
            work = os.path.join(self.root.name, case, "postProcessing/ensemble/0/work")
            for file in os.listdir(work):
                if file.startswith("messages."):
                    with open(os.path.join(work, file)) as text:
                        said += text.read()
        self.assertIn("They are begun again one by one.", said)

    def testASampleThatCrashesByItselfAfterwardsIsBlamedAlone(self):
        """Workers are ended again and again, until one is hit that computes one by one."""
        def abortUntilOneIsBlamed(process):
            failures = os.path.join(self.root.name, self.newest, "postProcessing/ensemble/0/work/failures")
            while process.poll() is None and not os.path.exists(failures):
                time.sleep(random.uniform(0.005, 0.03))
                for worker in self.childrenOf(process.pid):
                    try:
                        os.kill(worker, signal.SIGABRT)
                    except ProcessLookupError:
                        pass  # it has ended meanwhile
            return os.path.exists(failures)

        def make(name):
            self.newest = name
            return self.alike(name, failures="attempts 1; maximumPart 0.01;")

        case, status = self.runUntilItIsHit("blamed", "1", abortUntilOneIsBlamed, make)
        self.assertEqual(status, 0)
        failed = [row for row in self.table(case)[1:] if row[3] != "0"]
        # One, or some more where next workers were hit before the first was seen.
        self.assertIn(len(failed), range(1, 8))
        self.assertEqual([row[2:] for row in failed], len(failed) * [["nan", "4", "1"]])
        whole = self.alike("blamedWhole")
        self.run_(whole)
        numbers = [row[0] for row in failed]
        self.assertEqual([row for row in self.table(case) if row not in failed],
                         [row for row in self.table(whole) if row[0] not in numbers])

    def testSettingsOfTheSolverAreHonoured(self):
        """Those that samples computed together do not know are for samples one by one."""
        for name, settings in (("fewIterations", "maximumIterations 3;"), ("fewCorrectors", "correctors 0;")):
            case = self.alike(name, samples=12)
            with open(os.path.join(case, "system/solution"), "w", encoding="utf-8") as file:
                file.write(header % "solution" + f"limitAnalysis {{ {settings} }}\n")
            isFew = name == "fewIterations"
            self.assertNotIn("several samples at once", self.run_(case, status=2 if isFew else 0).stdout)
            self.assertTrue(all(row[3] == ("3" if isFew else "0") for row in self.table(case)[1:]), self.table(case))

    def testASearchThatMaximumTimeEndsIsNamed(self):
        """As of a case by itself a sample without a collapse has no multiplier; one whose time suffices is the same."""
        for name, limit, isEnded in (("endsAtOnce", 1e-9, True), ("hasTime", 1000, False)):
            case = self.case(name, samples=3, statistics="")
            with open(os.path.join(case, "constant/contactProperties"), "w", encoding="utf-8") as file:
                file.write(header % "contactProperties" + "friction { type Coulomb; mu 0.65; flowRule nonAssociative; }\n")
            with open(os.path.join(case, "system/solution"), "w", encoding="utf-8") as file:
                file.write(header % "solution" + f"limitAnalysis {{ nonAssociative {{ maximumTime {limit}; }} }}\n")
            done = self.run_(case, "-jobs", "1")
            self.assertEqual("Samples had warnings: see" in done.stdout, isEnded, done.stdout)
            if isEnded:
                said = self.read(case, re.search(r"warnings: see (.*)", done.stdout).group(1))
                self.assertEqual(said.count("maximumTime has ended the search"), 1, said)
                self.assertIn("system/solution/limitAnalysis/nonAssociative/maximumTime at line", said)
            column = [row[3] for row in self.table(case)[1:]]
            self.assertEqual([value == "nan" for value in column], 3 * [isEnded], self.table(case))

    def testAFolderOfTheVersionBeforeIsContinued(self):
        """Its file of chunks had their number alone in its name; journals say what is done."""
        case, _ = self.runUntilItIsHit("before", "1", lambda process: process.send_signal(signal.SIGINT) is None,
                                       self.alike)
        work = os.path.join(case, "postProcessing/ensemble/0/work")
        chunks = [name for name in os.listdir(work) if name.startswith("chunks.")]
        self.assertEqual(len(chunks), 1, chunks)
        os.remove(os.path.join(work, chunks[0]))
        with open(os.path.join(work, "chunks.1500"), "wb") as file:
            file.write(b"\1" * 10 + b"\0" * 1490)
        before = self.rowsOf(case)
        self.run_(case)
        self.assertEqual(self.rowsOf(case), 1500)
        self.assertGreater(before, 0)
        whole = self.alike("beforeWhole")
        self.run_(whole)
        self.assertEqual(self.table(case), self.table(whole))

    def testSamplesThatJournalsHaveLostAreComputedAgain(self):
        """A journal without its second half, as after a power failure: its chunks are said to be complete."""
        case = self.alike("lost", samples=300)
        self.run_(case)
        whole = self.table(case)
        work = os.path.join(case, "postProcessing/ensemble/0/work")
        journals = [os.path.join(work, name) for name in os.listdir(work) if name.startswith("journal.")]
        for journal in journals:
            with open(journal, encoding="utf-8") as file:
                rows = file.readlines()
            with open(journal, "w", encoding="utf-8") as file:
                middle = len(rows) // 2
                file.writelines(rows[:middle])
                file.write(rows[middle][:5])  # torn
        lost = 300 - self.rowsOf(case)
        self.assertGreater(lost, 100)
        self.assertIn(f"{lost} samples that were computed are in no journal", self.run_(case).stderr)
        self.assertEqual(self.table(case), whole)
        self.assertNotIn("in no journal", self.run_(case).stderr)

    def testSamplesThatHaveLostTheirPlanAreRefused(self):
        case = self.alike("planless", samples=20)
        self.run_(case)
        before = self.read(case, "postProcessing/ensemble/0/samples.dat")
        plan = os.path.join(case, "postProcessing/ensemble/0/work/plan")
        whole = self.read(case, "postProcessing/ensemble/0/work/plan")
        self.edit(case, "system/ensembleDict", "median 0.65", "median 0.4")
        for text in None, "", "garbage\n", whole[:whole.index("attempts")]:
            if text is None:
                os.remove(plan)
            else:
                with open(plan, "w", encoding="utf-8") as file:
                    file.write(text)
            for option in (), ("-postProcess",):
                refused = self.run_(case, *option, status=1).stderr
                self.assertIn("The plan of the ensemble is " + ("gone" if text is None else "empty, cut off"), refused)
                self.assertIn("Remove postProcessing/ensemble to start again.", refused)
                self.assertRegex(refused, "file: .*postProcessing/ensemble/0/work/plan")
                self.assertEqual(self.read(case, "postProcessing/ensemble/0/samples.dat"), before)
        with open(plan, "w", encoding="utf-8") as file:
            file.write(whole)
        self.assertIn("variables of system/ensembleDict have changed", self.run_(case, status=1).stderr)
        self.edit(case, "system/ensembleDict", "median 0.4", "median 0.65")
        self.run_(case)
        self.assertEqual(self.read(case, "postProcessing/ensemble/0/samples.dat"), before)

    def testCtrlCStopsAndItContinues(self):
        """The program ends after the samples in hand, so all may be there already: then it is interrupted anew."""
        for attempt in range(10):
            case, status = self.runUntilItIsHit(f"stopped{attempt}.", "1",
                                                lambda process: process.send_signal(signal.SIGINT) is None)
            if status != 0:
                break
        self.assertEqual(status, 130)
        self.assertLess(len(self.table(case)), 301)
        self.run_(case)
        self.assertEqual(self.digest(case), self.reference())

    @unittest.skipUnless(shutil.which("mpirun"), "mpirun is not installed")
    def testMpirunSharesTheSamples(self):
        """Neither program ends its first sample before the other has begun one: else one might do all of them."""
        changes = {"samples": 40}
        case = self.case("mpi", applications="blockTexture \"./meet\" limitAnalysis", **changes)
        with open(os.path.join(case, "meet"), "w", encoding="utf-8") as file:
            file.write("#!/bin/bash\n: > $MEETING/$OMPI_COMM_WORLD_RANK\n"
                       "until [ -e $MEETING/0 -a -e $MEETING/1 ]; do sleep 0.01; done\n")
        os.chmod(os.path.join(case, "meet"), 0o755)
        meeting = os.path.join(self.root.name, "meeting")
        os.mkdir(meeting)
        done = subprocess.run(["mpirun", "--allow-run-as-root", "--oversubscribe", "-np", "2",
                               os.path.join(applications, "ensemble"), "-case", case, "-parallel"],
                              env={**os.environ, "MEETING": meeting},
                              capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        alone = self.case("alone", **changes)
        self.run_(alone, "-jobs", "1")
        self.assertEqual(self.table(case), self.table(alone))
        work = os.path.join(case, "postProcessing/ensemble/0/work")
        self.assertEqual(sum(name.startswith("journal.") for name in os.listdir(work)), 2)

    # Tasks 3 and 7 both took the last third, and none the second one.
    @unittest.skipUnless(shutil.which("cc"), "no C compiler")
    def testTasksOfAnArrayWithHolesComputeAllSamplesWithoutLocks(self):
        """On a file system without locks, which a library that is loaded first makes of this one."""
        library = os.path.join(self.root.name, "noLocks.so")
        subprocess.run(["cc", "-shared", "-fPIC", "-o", library, "-x", "c", "-"], text=True, check=True, timeout=60, input="""
            #define _GNU_SOURCE
            #include <dlfcn.h>
            #include <errno.h>
            #include <fcntl.h>
            #include <stdarg.h>
            static int call(const char *name, int descriptor, int command, void *argument)
            {
                if (command == F_SETLK || command == F_SETLKW || command == F_OFD_SETLK) { errno = ENOLCK; return -1; }
                return ((int (*)(int, int, ...))dlsym(RTLD_NEXT, name))(descriptor, command, argument);
            }
            #define FUNCTION(name) int name(int descriptor, int command, ...) { va_list list; va_start(list, command); \
                void *argument = va_arg(list, void *); va_end(list); return call(#name, descriptor, command, argument); }
            FUNCTION(fcntl)
            FUNCTION(fcntl64)
            """)
        case = self.case("holes")
        tasks = [subprocess.Popen([os.path.join(applications, "ensemble"), "-case", case, "-parallel"],
                                  env={**os.environ, "LD_PRELOAD": library, "SLURM_ARRAY_TASK_ID": task,
                                       "SLURM_ARRAY_TASK_MIN": "1", "SLURM_ARRAY_TASK_MAX": "7",
                                       "SLURM_ARRAY_TASK_STEP": "1", "SLURM_ARRAY_TASK_COUNT": "3"},
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) for task in "137"]
        for task in tasks:
            said = task.communicate(timeout=120)[0]
            self.assertEqual(task.returncode, 0, said)
        done = self.run_(case, "-postProcess")
        self.assertNotIn("Warning", done.stdout + done.stderr)
        self.assertEqual(self.digest(case), self.reference())

    @unittest.skipUnless(shutil.which("mpirun"), "mpirun is not installed")
    def testMpirunWithoutParallelSaysWhatIsMissing(self):
        case = self.case("mpiAlone", applications="\"./wait\" blockTexture limitAnalysis", samples=4)
        with open(os.path.join(case, "wait"), "w", encoding="utf-8") as file:
            file.write("#!/bin/bash\nsleep 20\n")  # that of the other program, which mpirun ends
        os.chmod(os.path.join(case, "wait"), 0o755)
        done = subprocess.run(["mpirun", "--allow-run-as-root", "--oversubscribe", "-np", "2",
                               os.path.join(applications, "ensemble"), "-case", case],
                              capture_output=True, text=True, timeout=120, check=False)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("add -parallel, with which they share the work", done.stderr)

    def testSamplesThatFailAreCountedAndListed(self):
        case = self.case("failing", applications="blockTexture \"./act\" limitAnalysis", samples=8,
                         failures="attempts 2; maximumTime 4; maximumPart 0.3;",
                         statistics="capacity { type distribution; value alpha; }")
        script = os.path.join(case, "act")
        with open(script, "w", encoding="utf-8") as file:
            # By the stratum of the unit length, which is different in each of the 8 samples.
            file.write("#!/bin/bash\n"
                       "length=$(grep -o '^unitLength *0[.][0-9]*' system/blockTextureDict | grep -o '0[.][0-9]*')\n"
                       "case $(awk -v l=$length 'BEGIN { print int((l - 0.35) / 0.0125) }') in\n"
                       "0) kill -SEGV $$ ;;\n1) sleep 100 ;;\n2) echo nonsense >&2; exit 1 ;;\n3) exit 2 ;;\nesac\nexit 0\n")
        os.chmod(script, 0o755)
        done = self.run_(case, status=2)
        self.assertRegex(done.stdout, r"4 of 8 samples have failed")
        rows = {int((float(row[2]) - 0.35) / 0.0125): row for row in self.table(case)[1:]}
        self.assertEqual([rows[i][4:] for i in range(8)],
                         [["4", "2"], ["5", "2"], ["2", "1"], ["3", "1"]] + 4 * [["0", "1"]])
        self.assertTrue(all(rows[i][3] == "nan" for i in range(4)))
        self.assertIn("nonsense", done.stdout)
        self.assertFalse([name for name in os.listdir(os.path.join(case, "postProcessing/ensemble/0/work"))
                          if name.startswith("case.")])

    def testEvaluateAnswersDakotaAndQuoFEM(self):
        case = self.case("driver")
        formats = {
            "dakota": "   2 variables\n 6.5e-01 mu\n 4.0e-01 unit\n 1 functions\n 1 ASV_1:f\n 2 derivative_variables\n",
            "aprepro": "{ DAKOTA_VARS = 2 }\n{ mu = 6.5e-01 }\n{ unit = 4.0e-01 }\n{ DAKOTA_FNS = 1 }\n",
            "quofem": "2\nmu 0.65\nunit 0.4\n"}
        results = os.path.join(case, "results.out")
        for name, text in formats.items():
            parameters = os.path.join(case, name + ".in")
            with open(parameters, "w", encoding="utf-8") as file:
                file.write(text)
            self.run_(case, "-evaluate", parameters, results)
            with open(results, encoding="utf-8") as file:
                self.assertAlmostEqual(float(file.read()), 0.642859, places=6, msg=name)
        for text, says in (("2\nmu 0.65\nunti 0.4\n", "unit"), ("nothing", "no file of parameters"),
                           ("3\nmu 0.65\nunit 0.4\nnu 1\n", "Unknown variable nu"),
                           # What is written twice, or has another number beside it, was taken as it came.
                           ("3\nmu 0.5\n\nmu 0.65\nunit 0.4\n", "two values of mu: remove one.\n\nfile: " + parameters
                            + " at line 4."),
                           ("{ DAKOTA_VARS = 2 }\n{ mu = 0.5 }\n{ mu = 0.65 }\n{ unit = 0.4 }\n", "two values of mu"),
                           ("2\nmu 0.6 5\nunit 0.4\n", "remove `5`")):
            with open(parameters, "w", encoding="utf-8") as file:
                file.write(text)
            self.assertIn(says, self.run_(case, "-evaluate", parameters, results, status=1).stderr)
        with open(parameters, "w", encoding="utf-8") as file:
            file.write("2\nmu -1\nunit 0.4\n")
        self.run_(case, "-evaluate", parameters, results)
        with open(results, encoding="utf-8") as file:
            self.assertEqual(file.read(), "FAIL\n")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
