#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Run control of contactDynamics: restart, interruption, a step that is not solved, purging, edits while it runs.

runControl.py BIN CASE       CASE: a block on ground under a pulse, here with two more blocks on top of it
"""
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from caseTest import CaseTest, applications, tutorial, header

texture = header % "blockTextureDict" + """
dimensions 2;
texture
{
    type polygons;
    thickness 1;
    blocks
    (
        ((-4 -0.5) (4 -0.5) (4 0) (-4 0))
        ((0 0) (0.4 0) (0.4 0.5) (0 0.5))
        ((0.02 0.5) (0.42 0.5) (0.42 1) (0.02 1))
        ((0 1) (0.4 1) (0.4 1.5) (0 1.5))
    );
}
supports { ground { type blocks; blocks (0); } }
"""
controls = {"application": "contactDynamics", "startFrom": "latestTime", "startTime": "0", "stopAt": "endTime",
            "endTime": "0.6", "deltaT": "0.002", "writeControl": "runTime", "writeInterval": "0.2"}


class RunControl(CaseTest):
    application = "contactDynamics"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.base = os.path.join(cls.root.name, "base")
        cls.copyInput(tutorial, cls.base)
        with open(os.path.join(cls.base, "system/blockTextureDict"), "w", encoding="utf-8") as file:
            file.write(texture)
        cls.control(cls.base)
        made = subprocess.run([os.path.join(applications, "blockTexture"), "-case", cls.base], capture_output=True,
                              text=True, check=False)
        assert made.returncode == 0, made.stdout + made.stderr

    @staticmethod
    def write(case, name, text):
        path = os.path.join(case, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path + ".new", "w", encoding="utf-8") as file:
            file.write(text)
        os.replace(path + ".new", path)

    @classmethod
    def control(cls, case, **changes):
        entries = {**controls, **changes}
        cls.write(case, "system/controlDict", header % "controlDict" +
                  "".join(f"{key} {value};\n" for key, value in entries.items()))

    def copy(self, name, **changes):
        case = os.path.join(self.root.name, name)
        shutil.copytree(self.base, case)
        self.control(case, **changes)
        return case

    def state(self, case, instant="0.6"):
        with open(os.path.join(case, instant, "state"), "rb") as file:
            return file.read()

    def times(self, case):
        return sorted((entry for entry in os.listdir(case) if re.fullmatch(r"[0-9.]+", entry)), key=float)

    def testADryRunWritesNothingAndNeedsNoFolderToWriteInto(self):
        case = self.copy("dryOnly")
        shutil.rmtree(os.path.join(case, "VTK"))
        with open(os.path.join(case, "VTK"), "w", encoding="utf-8") as file:
            file.write("no folder can be made here")
        before = sorted(os.listdir(case))
        self.assertIn("Advice", self.run_(case, "-dry-run").stdout)
        self.assertEqual(sorted(os.listdir(case)), before)
        self.assertIn("VTK", self.run_(case, status=1).stderr)
        shutil.rmtree(os.path.join(case, "constant/assembly"))
        done = subprocess.run([os.path.join(applications, "blockTexture"), "-case", case, "-dry-run"],
                              capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("Blocks: 3 free, 1 fixed", done.stdout)
        self.assertFalse(os.path.exists(os.path.join(case, "constant/assembly")))

    def testARunWithoutStepsSaysSoAndClaimsNoTables(self):
        functions = "{ motion { type blockMotion; blocks (1); writeControl timeStep; writeInterval 1; } }"
        case = self.copy("noStep", deltaT="2", endTime="0.5", functions=functions)
        done = self.run_(case)
        self.assertIn("No step is computed: from 0 s to endTime 0.5 s is at most half of deltaT 2 s.",
                      done.stdout + done.stderr)
        self.assertNotIn("postProcessing", done.stdout)
        self.control(case, deltaT="0.002", endTime="0.01", functions=functions)
        done = self.run_(case)
        self.assertNotIn("No step", done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"Wrote \S*postProcessing: motion")

    def testARunThatDoesNotEndAtEndTimeSaysSo(self):
        case = self.copy("beyondEnd", deltaT="0.8", endTime="0.5")
        done = self.run_(case, "-dry-run")
        self.assertIn("The run ends at 0.8 s, and not at endTime 0.5 s", done.stdout + done.stderr)
        self.assertIn("such as 0.5,", done.stdout + done.stderr)
        for controls in ({"deltaT": "0.8", "adjustTimeStep": "yes"}, {"deltaT": "0.001"}, {"deltaT": "0.1"}):
            self.control(case, endTime="0.5", **controls)
            done = self.run_(case, "-dry-run")
            self.assertNotIn("The run ends at", done.stdout + done.stderr)

    def testALiveLoadIsNotAppliedAndThatIsSaid(self):
        case = self.copy("liveLoad", endTime="0.01")
        self.write(case, "constant/loads", header % "loads" + "dead { type gravity; }\n")
        self.assertNotIn("live of constant", self.run_(case, "-dry-run").stdout)
        self.write(case, "constant/loads", header % "loads"
                   + "dead { type gravity; } live { type inertial; direction (1 0 0); }\n")
        for options in (("-dry-run",), ()):
            self.assertIn("live of constant/loads is not applied in motion", self.run_(case, *options).stdout)

    @unittest.skipUnless(shutil.which("qemu-x86_64") and os.uname().machine == "x86_64",
                         "qemu-user is not installed: there is no older processor to run on")
    def testAnOlderProcessorIsToldSoBeforeAnInstructionThatItLacks(self):
        done = subprocess.run(["qemu-x86_64", "-cpu", "Nehalem", os.path.join(applications, "contactDynamics"), "-help"],
                              capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("This processor lacks", done.stderr)
        self.assertIn("DRYSTONE_PROCESSOR=x86-64", done.stderr)

    def testARunInPartsEndsInTheSameBytes(self):
        for form in ("ascii", "binary"):
            once = self.copy("once." + form, writeFormat=form)
            self.run_(once)
            parts = self.copy("parts." + form, writeFormat=form, endTime="0.2")
            self.run_(parts)
            self.assertEqual(self.state(parts, "0.2"), self.state(once, "0.2"))
            self.control(parts, writeFormat=form)
            self.run_(parts)
            self.assertEqual(self.state(parts), self.state(once))
            self.assertIn(b"contactForce", self.state(once))

    def testARunOfElasticAndDampedBlocksInPartsEndsInTheSameBytes(self):
        springs = (header % "contactProperties" + "friction { type Coulomb; mu 0.3; flowRule nonAssociative; }\n"
                   "elasticity { normal 1e7; tangential 5e6; }\ndamping { massProportional 1; }\n")
        once, parts = self.copy("springs"), self.copy("springs.parts", endTime="0.2")
        for case in (once, parts):
            self.write(case, "constant/contactProperties", springs)
            self.assertRegex(self.run_(case).stdout, r"Effects simulated: .*elasticity damping")
        self.control(parts)
        self.run_(parts)
        self.assertEqual(self.state(parts), self.state(once))

    def testElasticJointsKeepTheirShearWhereCornersPassEachOther(self):
        """A block that swings on springs of shear, on a base as wide as itself but for 0.1 mm, and on a wide one."""
        ways = {}
        for name, half in (("passing", 0.5001), ("wide", 3)):
            case = self.copy(name, endTime="0.1", deltaT="5e-4",
                             functions="{ blockMotion { blocks (1); writeControl timeStep; } }")
            self.write(case, "system/blockTextureDict", header % "blockTextureDict" + f"""
                dimensions 2;
                texture
                {{
                    type polygons; thickness 1;
                    blocks (((-{half} -1) ({half} -1) ({half} 0) (-{half} 0)) ((-0.5 0) (0.5 0) (0.5 1) (-0.5 1)));
                }}
                supports {{ ground {{ type blocks; blocks (0); }} }}
                """)
            self.write(case, "constant/contactProperties", header % "contactProperties" +
                       "friction { type Coulomb; mu 0.8; flowRule nonAssociative; }\n"
                       "elasticity { normal 1e7; tangential 5e6; }\n")
            self.write(case, "0/motion", header % "motion" + '"1" { velocity (0.02 0); displacement (0 -1e-3); }\n')
            made = subprocess.run([os.path.join(applications, "blockTexture"), "-case", case], capture_output=True,
                                  text=True, check=False)
            self.assertEqual(made.returncode, 0, made.stderr)
            self.run_(case)
            ways[name] = [float(row[1]) for row in self.rows(case, "blockMotion/0/block1.dat")]
        for extreme in (max, min):
            self.assertAlmostEqual(extreme(ways["passing"]) / extreme(ways["wide"]), 1, delta=0.02)

    def testABoxThatLeavesOutBlocksWhereTheyWereBuiltIsDoubted(self):
        case = self.copy("box", endTime="0.01")
        contact = header % "contactProperties" + "friction { type Coulomb; mu 0.3; }\ndeletion { box ((%s -10) (50 50)); }\n"
        self.write(case, "constant/contactProperties", contact % "30")
        self.assertRegex(self.run_(case).stderr, r"(\d+) of \1 free blocks \(.*\) are outside of the box")
        self.write(case, "constant/contactProperties", contact % "-30")
        self.assertNotIn("outside of the box", self.run_(case).stderr)

    def testARunWithAMovingSupportAndBlocksThatLeaveTheBoxInPartsEndsInTheSameBytes(self):
        contact = (header % "contactProperties" + "friction { type Coulomb; mu 0.3; flowRule nonAssociative; }\n"
                   "deletion { box ((0 -10) (10 10)); }\n")
        support = header % "supportMotion" + "ground { direction (-1 0); velocity ((0 0) (0.3 1.5) (0.6 0)); }\n"
        once, parts = self.copy("support"), self.copy("support.parts", endTime="0.2")
        for case in (once, parts):
            self.write(case, "constant/contactProperties", contact)
            self.write(case, "constant/supportMotion", support)
            self.assertRegex(self.run_(case).stdout, r"Effects simulated: .* supportMotion deletion")
        self.control(parts)
        self.run_(parts)
        self.assertEqual(self.state(parts), self.state(once))
        # A block is out by then, at rest where it left the box.
        state = self.state(once).decode()
        velocities = re.search(r"velocity \d+\n\((.*?)\)", state, re.S)[1].split()
        self.assertTrue(any(velocities[3 * i:3 * i + 3] == ["0", "0", "0"] for i in range(3)), velocities)

    def testFramesHaveTheVelocityOfASupportThatMoves(self):
        """A frictionless ground goes away at 2 m/s under blocks that stay."""
        case = self.copy("supportFrame", endTime="0.2")
        self.write(case, "constant/contactProperties", header % "contactProperties")
        self.write(case, "constant/supportMotion", header % "supportMotion" +
                   "ground { direction (1 0); velocity ((0 2) (1 2)); }\n")
        os.remove(os.path.join(case, "constant/groundMotion"))
        self.run_(case)
        frame = self.read(case, "VTK/blocks_000001.vtp")
        self.assertRegex(frame, r'Name="velocity\[m/s\]"[^>]* RangeMin="0" RangeMax="2"')

    def testCtrlCWritesTheStateAndTheRunGoesOnFromIt(self):
        once = self.copy("long", endTime="4", deltaT="0.0005", writeInterval="4")
        self.run_(once)
        case = self.copy("interrupted", endTime="4", deltaT="0.0005", writeInterval="4")
        process = subprocess.Popen([os.path.join(applications, "contactDynamics"), "-case", case],
                                   stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        for line in process.stdout:
            if line.startswith("Time = 0.1"):
                process.send_signal(signal.SIGINT)
                break
        rest, _ = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 130)
        times = self.times(case)
        self.assertIn(f"Stopped at {times[-1]} s by a signal, state kept", rest)
        self.assertNotIn("\nEnd\n", rest)
        self.assertLess(float(times[-1]), 4)
        self.assertGreaterEqual(float(times[-1]), 0.1)
        self.run_(case)
        self.assertEqual(self.state(case, "4"), self.state(once, "4"))

    def testTwoRunsInOneCaseAreRefusedUntilTheFirstHasEnded(self):
        case = self.copy("locked", endTime="400", deltaT="0.0005", writeInterval="400")
        first = subprocess.Popen([os.path.join(applications, "contactDynamics"), "-case", case],
                                 stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        for line in first.stdout:
            if line.startswith("Time = "):
                break
        done = self.run_(case, status=1)
        self.assertIn("Another run is at work", done.stderr)
        if os.path.exists("/proc/locks") and f" {first.pid} " in self.read("/proc", "locks"):
            self.assertIn(f"(process {first.pid})", done.stderr)
        self.assertIn("Another run is at work", self.run_(case, "-postProcess", status=1).stderr)
        for application in ("limitAnalysis", "blockTexture"):
            self.assertIn("Another run is at work", self.runApplication(application, case, status=1).stderr)
        self.run_(case, "-dry-run")
        first.kill()
        first.communicate(timeout=60)
        self.control(case, endTime="0.01")
        self.run_(case)

    def testARunWaitsForWhatIsAboutToEnd(self):
        """As the processes of a run that was killed a moment ago."""
        case = self.copy("ending", endTime="0.01")
        with open(os.path.join(self.root.name, "held"), "w", encoding="ascii") as held:
            ending = subprocess.Popen(["flock", case, "sh", "-c", "echo held; sleep 0.3"], stdout=held)
            while not os.path.getsize(held.name):
                time.sleep(0.01)
            self.run_(case)
            self.assertEqual(ending.wait(timeout=60), 0)

    def testAStepThatIsNotSolvedEndsTheRunWithTheStateItBeganFrom(self):
        once = self.copy("solved")
        self.run_(once)
        case = self.copy("unsolved", endTime="0.2")
        self.run_(case)
        with open(os.path.join(case, "system/solution"), encoding="utf-8") as file:
            good = file.read()
        self.write(case, "system/solution", header % "solution" +
                   "contactDynamics { solver interiorPoint; tolerance 1e-15; maximumIterations 1; }\n")
        self.control(case)
        done = self.run_(case, status=2)
        self.assertIn("was not solved", done.stderr)
        self.assertIn("system/solution/contactDynamics", done.stderr)
        last = self.times(case)[-1]
        self.assertLess(float(last), 0.6)
        self.write(case, "system/solution", good)
        self.run_(case)
        self.assertEqual(self.times(case), self.times(once))
        self.assertEqual(self.state(case), self.state(once))

    def testAStepThatTakesTooMuchWorkEndsTheRunWithTheStateItBeganFrom(self):
        once = self.copy("affordable")
        self.run_(once)
        case = self.copy("expensive")
        with open(os.path.join(case, "system/solution"), encoding="utf-8") as file:
            good = file.read()
        self.write(case, "system/solution", header % "solution" + "contactDynamics { maximumFactorisations 1; }\n")
        done = self.run_(case, status=2)
        self.assertIn("maximumFactorisations of 1 ", done.stderr)
        self.assertIn("smaller deltaT", done.stderr)
        self.assertIn("system/solution/contactDynamics", done.stderr)
        last = self.times(case)[-1]
        self.assertIn(f"after time {last} ", done.stderr)
        self.assertLess(float(last), 0.6)
        self.write(case, "system/solution", good)
        self.run_(case)
        self.assertEqual(self.state(case), self.state(once))

    def testOfSupportsThatSqueezeABlockItIsSaidThatThereIsNoMotion(self):
        case = self.copy("squeezed")
        self.write(case, "system/blockTextureDict", header % "blockTextureDict" + """dimensions 2;
            texture { type polygons; thickness 1; blocks (((-1 0) (-0.2 0) (-0.2 1) (-1 1))
                ((0.2 0) (1 0) (1 1) (0.2 1)) ((-0.18 0.3) (0.18 0.3) (0.18 0.7) (-0.18 0.7))
                ((-0.2 -0.1) (0.2 -0.1) (0.2 0.3) (-0.2 0.3))); }
            supports { left { type blocks; blocks (0); } right { type blocks; blocks (1); }
                floor { type blocks; blocks (3); } }""")
        self.write(case, "constant/supportMotion", header % "supportMotion" +
                   "left { direction (1 0); velocity ((0 0.1) (3 0.1)); }")
        made = subprocess.run([os.path.join(applications, "blockTexture"), "-case", case], capture_output=True,
                              text=True, check=False)
        self.assertEqual(made.returncode, 0, made.stderr)
        done = self.run_(case, status=2)
        self.assertIn("supports that move press blocks together between them", done.stderr)

    def testGaussSeidelSolvesToALooseToleranceAndSaysWhereItDoesNot(self):
        exact = self.copy("exact")
        self.run_(exact)
        case = self.copy("gaussSeidel")
        self.write(case, "system/solution", header % "solution" +
                   "contactDynamics { solver gaussSeidel; tolerance 1e-5; }\n")
        done = self.run_(case)
        self.assertIn("gaussSeidel:  Solving for contact", done.stdout)
        for mine, theirs in zip(self.numbers(case), self.numbers(exact), strict=True):
            self.assertAlmostEqual(mine, theirs, delta=1e-2)
        self.assertNotEqual(self.numbers(case), self.numbers(exact))
        hasty = self.copy("hasty")
        self.write(hasty, "system/solution", header % "solution" +
                   "contactDynamics { solver gaussSeidel; tolerance 1e-12; maximumSweeps 1; }\n")
        done = self.run_(hasty, status=2)
        self.assertIn("was not solved", done.stderr)
        self.assertIn("maximumSweeps", done.stderr)

    def testTheProgramOfAStepIsKeptAndSolvedAgain(self):
        case = self.copy("programs", endTime="0.02")
        self.write(case, "system/solution", header % "solution" + "contactDynamics { writeProgram always; }\n")
        self.run_(case)
        self.assertEqual(sorted(os.listdir(os.path.join(case, "postProcessing/contactDynamics"))),
                         [f"{0.002 * step:g}" for step in range(1, 11)])
        program = "postProcessing/contactDynamics/0.02/coneProgram"
        for solver in ("interiorPoint", "augmentedLagrangian"):
            done = subprocess.run([os.path.join(applications, "solveProgram"), "-case", case, program, "-solver",
                                   solver], capture_output=True, text=True, timeout=60, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertIn("Status: optimal", done.stdout)
        for options, status, says in ((("-solver", "interiorPoint", "-maximumIterations", "1"), 2, "notConverged"),
                                      (("-solver", "gausSeidel"), 1, "Did you mean gaussSeidel"),
                                      (("-tolerance", "-1"), 1, "tolerance")):
            done = subprocess.run([os.path.join(applications, "solveProgram"), "-case", case, program, *options],
                                  capture_output=True, text=True, timeout=60, check=False)
            self.assertEqual(done.returncode, status, done.stdout + done.stderr)
            self.assertIn(says, done.stdout + done.stderr)

    def numbers(self, case):
        """Places of the blocks at the end."""
        text = self.state(case).decode()
        lists = [re.search(name + r"[^(;]*\(([^)]*)\)", text).group(1) for name in ("translation", "rotation")]
        found = [float(word) for text in lists for word in text.split()]
        self.assertEqual(len(found), 12)  # x, y and rotation of four blocks
        return found

    def testPurgeWriteKeepsTheLatest(self):
        case = self.copy("purged", writeInterval="0.1", purgeWrite="2")
        self.run_(case)
        self.assertEqual(self.times(case), ["0.5", "0.6"])

    def editWhileItRuns(self, name, **changes):
        """A run of which controlDict is edited at 0.1 s. \return its case, and what it has said of errors"""
        long = {"endTime": "100", "deltaT": "0.0005", "writeInterval": "100"}
        case = self.copy(name, **long)
        process = subprocess.Popen([os.path.join(applications, "contactDynamics"), "-case", case],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        for line in process.stdout:
            if line.startswith("Time = 0.1"):
                self.control(case, **long, **changes)
                break
        errors = process.communicate(timeout=120)[1]
        self.assertEqual(process.returncode, 0)
        return case, errors

    def testAnEditOfControlDictIsHeardWhileItRuns(self):
        case, _ = self.editWhileItRuns("modified", stopAt="writeNow")
        self.assertLess(float(self.times(case)[-1]), 100)

    def testLogFrequencyThinsTheLogAndChangesNothingElse(self):
        full = self.copy("logFull")
        thin = self.copy("logThin", logFrequency="50")
        said = {case: self.run_(case).stdout for case in (full, thin)}
        self.assertEqual(len(re.findall("^Time = ", said[full], re.M)), 300)
        self.assertEqual(re.findall(r"^Time = (\S+)", said[thin], re.M), ["0.1", "0.2", "0.3", "0.4", "0.5", "0.6"])
        self.assertEqual(len(re.findall("Solving for contact", said[thin])), 6)
        self.assertEqual(self.state(full), self.state(thin))

    def testTheLogClosesWithWhatMovedAndWhatWasWritten(self):
        case = self.copy("closing")
        said = self.run_(case).stdout
        largest = re.search(r"^Largest displacement: (\S+) m, block (\d), at (\S+) s$", said, re.M)
        self.assertGreater(float(largest.group(1)), 0)
        self.assertRegex(said, r"(?m)^The blocks (stand still|have come to rest|are at rest since|move at the end)")
        self.assertIn("Wrote 3 states, 0.2 to 0.6;", said)
        self.assertIn(f"Wrote {case}/VTK: blocks and contacts, 4 frames", said)

    def testAdjustTimeStepTakesLongStepsAtRestAndShortOnesInMotion(self):
        case = self.copy("adjusted", adjustTimeStep="on", writeControl="adjustableRunTime", endTime="1", deltaT="0.0001", writeInterval="1")
        self.write(case, "system/schemes", header % "schemes" + "maxDisplacement 0.01;\nmaxDeltaT 0.02;\n")
        done = self.run_(case)
        instants = [float(word) for word in re.findall(r"^Time = (\S+)", done.stdout, re.M)]
        steps = [b - a for a, b in zip([0.0] + instants, instants)]
        self.assertAlmostEqual(instants[-1], 1)
        self.assertLess(max(steps), 0.0201)
        self.assertGreater(max(steps), 1.5 * min(steps))

    def testAdjustedStepsDoNotLeapOverTheGround(self):
        """Blocks that stand still for eight seconds, and what moves the ground, or a support, then."""
        still = {"adjustTimeStep": "on", "endTime": "9", "writeInterval": "9"}
        ground = "direction (1 0 0);\nacceleration { type %s }\n"
        sine = "halfSine; amplitude 9; duration 0.5; start 8.02;"
        record = "table; values ((8.02 0) (8.27 9) (8.52 0));"
        for name, motion in (("sine", ground % sine), ("record", ground % record)):
            with self.subTest(name):
                case = self.copy("leap." + name, **still)
                self.write(case, "constant/groundMotion", header % "groundMotion" + motion)
                self.write(case, "system/schemes", header % "schemes")
                done = self.run_(case).stdout
                instants = [float(word) for word in re.findall(r"^Time = (\S+)", done, re.M)]
                self.assertLess(len(instants), 1000)
                self.assertTrue(any(abs(instant - 8.02) < 1e-6 for instant in instants), instants)
                largest = float(re.search(r"^Largest displacement: (\S+) m", done, re.M)[1])
                fixed = self.copy("leap.fixed." + name, endTime="9", writeInterval="9")
                self.write(fixed, "constant/groundMotion", header % "groundMotion" + motion)
                self.write(fixed, "system/schemes", header % "schemes")
                expected = float(re.search(r"^Largest displacement: (\S+) m", self.run_(fixed).stdout, re.M)[1])
                self.assertGreater(expected, 0.1)
                self.assertAlmostEqual(largest, expected, delta=0.1 * expected)
        case = self.copy("leap.support", **still)
        self.write(case, "constant/supportMotion", header % "supportMotion" +
                   "ground { direction (1 0 0); velocity ((8 0) (8.2 1) (8.4 0)); }\n")
        self.write(case, "system/schemes", header % "schemes")
        instants = [float(word) for word in re.findall(r"^Time = (\S+)", self.run_(case).stdout, re.M)]
        for change in (8, 8.2, 8.4):
            self.assertTrue(any(abs(instant - change) < 1e-6 for instant in instants), instants)

    def testAdjustedStepsEndWhereFunctionsWriteAndAtTheEnd(self):
        functions = ("{ energy { writeControl adjustableRunTime; writeInterval 0.07; }"
                     "  blockMotion { blocks (3); writeControl adjustableRunTime; writeInterval 0.05; } }")
        adjusting = {"adjustTimeStep": "on", "writeControl": "runTime", "endTime": "0.512", "deltaT": "0.003",
                     "writeInterval": "0.2", "functions": functions}
        case = self.copy("instants", **adjusting)
        self.write(case, "system/schemes", header % "schemes" + "maxDeltaT 0.011;\n")
        done = self.run_(case)
        energy, motion = (self.rows(case, table) for table in ("energy/0/energy.dat", "blockMotion/0/block3.dat"))
        self.assertEqual([row[0] for row in energy], [f"{0.07 * i:.12g}" for i in range(1, 8)])
        self.assertEqual([row[0] for row in motion], [f"{0.05 * i:.12g}" for i in range(1, 11)])
        self.assertEqual(re.findall(r"^Time = (\S+)", done.stdout, re.M)[-1], "0.512")
        # interrupted by an edit and continued: the same bytes
        parts = self.copy("instants.parts", **{**adjusting, "stopAt": "nextWrite"})
        self.write(parts, "system/schemes", header % "schemes" + "maxDeltaT 0.011;\n")
        self.run_(parts)
        self.assertEqual(len(self.times(parts)), 1)
        self.control(parts, **adjusting)
        self.run_(parts)
        self.assertEqual(self.times(parts), self.times(case))
        self.assertEqual(self.state(parts, self.times(parts)[-1]), self.state(case, self.times(case)[-1]))

    def testDryRunChecksAndWritesNothing(self):
        case = self.copy("dry")
        done = self.run_(case, "-dry-run")
        self.assertIn("End", done.stdout)
        # 0.5 g on a block with mu 0.2
        self.assertIn("Peak a/g = 0.5 exceeds what the blocks carry at rest (alpha = 0.2)", done.stdout)
        self.assertIn("joints slide", done.stdout)
        self.assertEqual(self.times(case), [])
        for name in ("VTK", "postProcessing"):
            # blockTexture has left VTK/assembly.vtp
            self.assertFalse([file for file in self.files(case, name) if "assembly" not in file])
        self.write(case, "system/schemes", header % "schemes" + "timeIntegraton { type theta; }\n")
        self.assertIn("timeIntegraton", self.run_(case, "-dry-run", status=1).stderr)

    def testADryRunLeavesTheAnimationOfAnEarlierRun(self):
        case = self.copy("dryKeeps", startFrom="startTime")
        self.run_(case)
        before = self.files(case, "VTK")
        self.run_(case, "-dry-run")
        self.assertEqual(self.files(case, "VTK"), before)

    def testAFrameThatAKilledRunLacksIsWrittenWhenItGoesOn(self):
        once, parts = self.copy("frames"), self.copy("frames.parts", endTime="0.4")
        self.run_(once)
        self.run_(parts)
        os.remove(os.path.join(parts, "VTK/contacts_000002.vtp"))  # as of a run killed between the two
        for name in (".0.36.4194304.tmp", "VTK/contacts_000008.vtp.4194304.tmp"):  # no process has this number
            self.write(parts, name, "half")
        self.control(parts)
        self.run_(parts)
        self.assertEqual(self.files(parts, "VTK"), self.files(once, "VTK"))
        self.assertEqual(self.read(parts, "VTK/contacts.vtp.series"), self.read(once, "VTK/contacts.vtp.series"))
        self.assertEqual([name for name in os.listdir(parts) if name.endswith(".tmp")], [])

    def testTablesOfARunInPartsHaveTheRowsOfARunInOneGo(self):
        functions = ("{ seconds { type energy; writeControl runTime; writeInterval 0.01; }\n"
                     "states { type energy; writeControl writeTime; writeInterval 2; } }")
        settings = {"deltaT": "0.003", "writeControl": "timeStep", "writeInterval": "3", "functions": functions}
        once = self.copy("rows", endTime="0.06", **settings)
        self.run_(once)
        for end in ("0.009", "0.027", "0.036"):
            parts = self.copy("rows" + end, endTime=end, **settings)
            self.run_(parts)
            self.control(parts, endTime="0.06", **settings)
            self.run_(parts)
            for function in ("seconds", "states"):
                rows = [row for start in ("0", end) for row in self.rowsIfAny(parts, f"{function}/{start}/energy.dat")]
                self.assertEqual([row[0] for row in rows],
                                 [row[0] for row in self.rows(once, f"{function}/0/energy.dat")], end)

    def rowsIfAny(self, case, table):
        there = os.path.exists(os.path.join(case, "postProcessing", table))
        return self.rows(case, table) if there else []

    def testARenamedTimeIsRefused(self):
        case = self.copy("renamed", endTime="0.2")
        self.run_(case)
        os.rename(os.path.join(case, "0.2"), os.path.join(case, "0.3"))
        self.control(case)
        self.assertRegex(self.run_(case, status=1).stderr, r"(?s)0\.3 has the state of time 0\.2.*0\.3/state")

    def testAnEditedStateOfBlocksInEachOtherIsRefused(self):
        case = self.copy("edited", endTime="0.2")
        self.run_(case)
        self.control(case)
        written = self.read(case, "0.2/state")
        numbers = re.search(r"\ntranslation (\d+)\n\(\n(.*?)\n\);", written, re.S)
        for number, value, says in ((-1, -0.3, r"block \d is 0\.3\d* m deep in block \d"),
                                    (0, 0.3, r"block 0 \(support ground\) is not where it was built")):
            values = numbers[2].split("\n")
            values[number] = str(float(values[number]) + value)
            self.write(case, "0.2/state", re.sub(r"\nchecksum \S+;\n", "",
                                                 written.replace(numbers[2], "\n".join(values))))
            self.assertRegex(self.run_(case, status=1).stderr, rf"(?s){says}.*0\.2/state")
        self.write(case, "0.2/state", re.sub(r"\nchecksum \S+;\n", "", written))
        self.run_(case)

    def testPostProcessWritesOverNoTableOfARun(self):
        functions = "{ energy { writeControl timeStep; writeInterval 1; } }"
        case = self.copy("postTwice", endTime="0.2", functions=functions)
        self.run_(case)
        self.control(case, functions=functions)
        self.run_(case)
        self.run_(case, "-postProcess", status=1)
        table = self.rows(case, "energy/0.2/energy.dat")
        self.assertGreater(len(table), 50)
        os.rename(os.path.join(case, "postProcessing/energy/0.2"), os.path.join(case, "postProcessing/energy/run"))
        for _ in range(2):  # over its own it may write
            self.run_(case, "-postProcess")
        self.assertEqual(len(self.rows(case, "energy/0.2/energy.dat")), 3)

    def testPostProcessKeepsToTheTimesOfAFunction(self):
        case = self.copy("postWindow", endTime="0.4", writeControl="adjustableRunTime", writeInterval="0.05")
        self.run_(case)
        self.control(case, endTime="0.4", functions="{ energy { timeStart 0.2; timeEnd 0.31; } }")
        shutil.rmtree(os.path.join(case, "postProcessing"), ignore_errors=True)
        self.run_(case, "-postProcess")
        folder = os.path.join(case, "postProcessing/energy")
        times = [row[0] for row in self.rows(case, f"energy/{os.listdir(folder)[0]}/energy.dat")]
        self.assertEqual([float(time) for time in times], [0.2, 0.25, 0.3])

    def testAnotherDeltaTIsTheFirstThatAContinuedRunWants(self):
        case = self.copy("otherStep", endTime="0.2", adjustTimeStep="yes")
        self.run_(case)
        self.control(case, endTime="0.21", adjustTimeStep="yes", deltaT="1e-5",
                     functions="{ energy { writeControl timeStep; writeInterval 1; } }")
        self.run_(case)
        first = float(self.rows(case, "energy/0.2/energy.dat")[0][0])
        self.assertLess(first - 0.2, 2e-5)

    def testAFileBeyondTheLimitIsOneThatCannotBeWritten(self):
        case = self.copy("limited")
        done = subprocess.run(["bash", "-c", 'ulimit -f 4; exec "$@"', "limited",
                               os.path.join(applications, "contactDynamics"), "-case", case],
                              capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("Cannot write", done.stderr)

    def testWhatAnEditOfControlDictDoesNotReachIsNamed(self):
        _, errors = self.editWhileItRuns("unreached", stopAt="noWriteNow", purgeWrite="2", functions="{ energy {} }")
        self.assertIn("functions, purgeWrite of system/controlDict stay as when this run was started", errors)

    def testCoordinatesOfAMapThatLeaveNoDigitsForGapsAreWarnedOf(self):
        for offset, warns in (("0", False), ("1e3", False), ("5e6", True)):
            case = self.copy("map" + offset)
            far = re.sub(r"\((-?[\d.]+) (-?[\d.]+)\)",
                         lambda point: f"({float(point[1]) + float(offset)!r} {point[2]})", texture)
            self.write(case, "system/blockTextureDict", far)
            self.runApplication("blockTexture", case)
            done = self.run_(case, "-dry-run")
            self.assertEqual("neighbours 9.3e-10 m apart" in done.stdout + done.stderr, warns, done.stdout)
            self.assertEqual("`offset (-5000000 -1);`" in done.stdout + done.stderr, warns, done.stderr)
            box = self.runApplication("checkBlocks", case).stdout
            self.assertIn("Bounding box of the free blocks (5000000 0) (5000000.42 1.5)" if warns else "Bounding", box)

    def testABlockThatIsTooLightForTheToleranceIsWarnedOf(self):
        """It hovered, tilted, beside one of 30 m."""
        for size, tolerance, warns in (("3", "1e-9", False), ("30", "1e-9", True), ("30", "1e-11", False)):
            case = self.copy(f"light{size}.{tolerance}")
            self.write(case, "system/blockTextureDict", header % "blockTextureDict" + f"""
dimensions 2;
texture
{{
    type polygons;
    thickness 1;
    blocks (((-4 -1) (40 -1) (40 0) (-4 0)) ((0 0) (0.01 0) (0.01 0.03) (0 0.03)) ((1 0) (32 0) (32 {size}) (1 {size})));
}}
supports {{ ground {{ type blocks; blocks (0); }} }}
""")
            self.write(case, "system/solution", header % "solution" + f"contactDynamics {{ tolerance {tolerance}; }}\n")
            self.runApplication("blockTexture", case)
            self.assertEqual(bool(re.search(r"Block 1 has a mass of .* block 2 is .* times as heavy",
                                            self.run_(case, "-dry-run").stderr)), warns, size)

    def testATimeWithoutAStartIsNamedWithItsLine(self):
        case = self.copy("noStart", startFrom="startTime", startTime="0.3")
        self.assertRegex(self.run_(case, status=1).stderr,
                         r"(?s)nothing to start from at time 0.3.*latestTime.*controlDict/startTime at line 4")
        self.control(case, startFrom="latestTime")
        os.makedirs(os.path.join(case, "0.2"))
        self.assertRegex(self.run_(case, status=1).stderr,
                         r"(?s)nothing to start from at time 0.2.*Remove the directory 0.2.*startFrom at line 3")

    def testEveryApplicationMayBeThatOfACase(self):
        case = self.copy("applications")
        for name in os.listdir(applications):
            if name.isalpha() and name != "drystoneRunFunctions":
                self.control(case, application=name)
                done = self.run_(case, "-dry-run")
                self.assertNotIn("none of Drystone", done.stdout + done.stderr)

    def testAnOverlapThatNoStepLooksAtIsWarnedOf(self):
        case = self.copy("overlap")
        for law, theta, says in (("nonAssociative", 1, ""), ("associative", 1, "with the associative flow rule"),
                                 ("nonAssociative", 0.5, "with theta below 1")):
            self.write(case, "constant/contactProperties", header % "contactProperties"
                       + "friction { type Coulomb; mu 0.2; flowRule %s; }\n" % law)
            self.write(case, "system/schemes", header % "schemes"
                       + "contactOverlap 1e-9; timeIntegration { type theta; theta %s; }\n" % theta)
            done = self.run_(case, "-dry-run")
            warned = re.search(r"contactOverlap is not used: (.*) contact points(?s:.*)schemes\S* at line 2",
                               done.stdout + done.stderr)
            self.assertEqual(warned.group(1) if warned else "", says)

    def testOtherSettingsThatNoStepLooksAtAreWarnedOf(self):
        case = self.copy("unused")
        for schemes, says in (("impacts stepStart;", "impacts is not used"),
                              ("impacts stepStart; timeIntegration { type theta; theta 0.5; }", ""),
                              ("maxDeltaT 0.01;", "maxDeltaT is not used: deltaT is fixed"),
                              ("maxDisplacement 0.01;", "maxDisplacement is not used: deltaT is fixed")):
            self.write(case, "system/schemes", header % "schemes" + schemes + "\n")
            done = self.run_(case, "-dry-run")
            warned = re.search(r"\w+ is not used(: deltaT is fixed)?(?=(?s:.*)schemes\S* at line 2)",
                               done.stdout + done.stderr)
            self.assertEqual(warned.group(0) if warned else "", says)
        self.control(case, adjustTimeStep="yes")
        done = self.run_(case, "-dry-run")
        self.assertNotIn("is not used", done.stdout + done.stderr)

    def testPostProcessGivesTheRowsOfTheRunAtTheTimesThatWereWritten(self):
        functions = "{ energy {} blockMotion { blocks (1 2); } contactForces {} residuals {} }"
        case = self.copy("post", startFrom="startTime", functions=functions)
        self.assertIn("no time directory", self.run_(case, "-postProcess", status=1).stderr)
        self.run_(case)
        self.run_(case, "-postProcess")
        for table in ("energy/{}/energy.dat", "blockMotion/{}/block2.dat", "contactForces/{}/contactForces.dat",
                      "residuals/{}/residuals.dat"):
            during, after = (self.rows(case, table.format(start)) for start in ("0", "0.2"))
            self.assertEqual([row[0] for row in after], ["0.2", "0.4", "0.6"])
            self.assertEqual([row for row in during if row[0] in ("0.2", "0.4", "0.6")], after)

    def bouncing(self, name, theta, restitution, motion, **changes):
        """One block, 1.2 x 0.5 m of 2000 kg/m3, thrown on ground."""
        case = self.copy(name, endTime="1.2", deltaT="0.004", writeInterval="0.4", writePrecision="17",
                         functions="{ blockMotion { blocks (1); writePrecision 17; } "
                                   "contactForces { points yes; writePrecision 17; } }", **changes)
        self.write(case, "system/blockTextureDict", header % "blockTextureDict" + """
dimensions 2;
texture
{
    type polygons;
    thickness 1;
    blocks ( ((-9 -0.5) (9 -0.5) (9 0) (-9 0)) ((0 0) (1.2 0) (1.2 0.5) (0 0.5)) );
}
supports { ground { type blocks; blocks (0); } }
""")
        subprocess.run([os.path.join(applications, "blockTexture"), "-case", case], check=True, capture_output=True)
        self.write(case, "constant/materialProperties", header % "materialProperties" + "density 2000;\n")
        self.write(case, "constant/contactProperties", header % "contactProperties" +
                   "friction { type Coulomb; mu 0.5; flowRule nonAssociative; }\n"
                   f"restitution {{ normal {restitution}; }}\n")
        self.write(case, "system/schemes", header % "schemes" + f"timeIntegration {{ type theta; theta {theta}; }}\n")
        self.write(case, "0/motion", header % "motion" + motion)
        os.remove(os.path.join(case, "constant/groundMotion"))
        return case

    def testReactionsAndGravityExplainTheMomentumOfABlockThatBounces(self):
        mass, gravity, step = 1.2 * 0.5 * 2000, 9.81, 0.004
        for theta in (1, 0.5):
            for restitution in (0, 0.5, 0.8, 1):
                for name, motion in (("flat", "1 { displacement (0 0.2); }"),
                                     ("thrown", "1 { displacement (0 0.5); rotation 0.4; velocity (-2 -1); "
                                                "angularVelocity 3; }")):
                    case = self.bouncing(f"momentum.{theta}.{restitution}.{name}", theta, restitution, motion)
                    self.run_(case)
                    velocity = [0, 0] if name == "flat" else [-2, -1]
                    worst = impulse = 0
                    moved = self.rows(case, "blockMotion/0/block1.dat")
                    carried = self.rows(case, "contactForces/0/contactForces.dat")
                    self.assertEqual(len(moved), len(carried))
                    for block, reaction in zip(moved, carried):
                        self.assertEqual(block[0], reaction[0])
                        for axis, weight in ((0, 0), (1, mass * gravity)):
                            after = float(block[4 + axis])
                            given = float(reaction[7 + axis]) * step
                            impulse += abs(given)
                            worst = max(worst, abs(mass * (after - velocity[axis]) - given + weight * step))
                            velocity[axis] = after
                    self.assertGreater(impulse, mass * gravity * 0.5)  # it has met the ground
                    self.assertLess(worst, 1e-9 * impulse, case)

    def testABounceInPartsEndsInTheSameBytesAndPostProcessGivesItsReactions(self):
        motion = "1 { displacement (0 0.2); }"
        once = self.bouncing("bounce", 0.5, 0.5, motion)
        self.run_(once)
        # Parted where a step has just thrown it back.
        hardest = max(self.rows(once, "contactForces/0/contactForces.dat"), key=lambda row: float(row[8]))
        instant = f"{float(hardest[0]):g}"
        whole, parts = (self.bouncing(name, 0.5, 0.5, motion) for name in ("bounce.whole", "bounce.parts"))
        for case, end in ((whole, "1.2"), (parts, instant)):
            self.control(case, endTime=end, deltaT="0.004", writeInterval=instant,
                         functions="{ contactForces {} }")
            self.run_(case)
        self.assertIn(b"contactForceMean", self.state(parts, instant))
        self.control(parts, endTime="1.2", deltaT="0.004", writeInterval=instant)
        self.run_(parts)
        last = self.times(whole)[-1]
        self.assertEqual(self.state(parts, last), self.state(whole, last))
        self.run_(whole, "-postProcess")
        during = self.rows(whole, "contactForces/0/contactForces.dat")
        after = self.rows(whole, f"contactForces/{instant}/contactForces.dat")
        self.assertEqual([row for row in during if row[0] == instant], after[:1])

    @staticmethod
    def rows(case, table):
        with open(os.path.join(case, "postProcessing", table), encoding="utf-8") as file:
            return [line.split() for line in file if not line.startswith("#")]

    @staticmethod
    def files(case, name):
        return [file for _, _, files in os.walk(os.path.join(case, name)) for file in files]

    def testFaultsOf0motionAreToldWithFileAndLine(self):
        for name, entry, message in (("unknown", "7 { velocity (1 0); }", "no block 7"),
                                     ("fixed", "0 { velocity (1 0); }", "Block 0 is fixed"),
                                     ("pattern", '"9.*" { velocity (1 0); }', "no block 9"),
                                     ("key", "1 { speed (1 0); }", "speed")):
            case = self.copy("motion." + name)
            self.write(case, "0/motion", header % "motion" + "\n" + entry + "\n")
            done = self.run_(case, status=1)
            self.assertIn(message, done.stderr)
            self.assertRegex(done.stderr, r"0/motion\S* at line 3")
            self.assertEqual(self.times(case), ["0"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
