# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""What scripts and cases outside the project rely on: options, names of files and columns, keys, and lines of logs. None of
it changes without a reason that users are told; other tests say whether the numbers are right."""
import os
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from caseTest import CaseTest, applications, header  # noqa: E402

solvers = ("limitAnalysis", "contactDynamics", "incrementalDynamics", "ensemble", "accuracyCost")
others = ("checkBlocks", "report", "caseDictionary")

bond = """dimensions 2;
texture
{
    type runningBond; unit (0.4 0.175); thickness 1; length 5; courses %d; firstCourse half;
    openings ( { from (1.5 3); to (2.5 8); } );
}
supports { ground { type ground; segment 0.5; } }
"""
wall = bond % 10
plane = {"constant/g": "value (0 -9.81 0);", "constant/materialProperties": "density 2000;",
         "constant/contactProperties": "friction { type Coulomb; mu 0.65; flowRule associative; }",
         "constant/loads": "dead { type gravity; } live { type inertial; direction (1 0 0); }",
         "system/blockTextureDict": wall,
         "system/solution": "limitAnalysis { solver interiorPoint; tolerance 1e-9; }\n"
                            "contactDynamics { solver automatic; tolerance 1e-9; }",
         "system/schemes": "timeIntegration { type theta; theta 1; } effects { selection asGiven; }",
         "system/controlDict": "application limitAnalysis; startFrom startTime; startTime 0; stopAt endTime; "
                               "endTime 0.02; deltaT 0.002; writeControl timeStep; writeInterval 5; purgeWrite 0; "
                               "writeFormat ascii; writePrecision 10; timeFormat general; timePrecision 6; "
                               "runTimeModifiable no; adjustTimeStep no; functions {}"}
space = {**plane, "constant/g": "value (0 0 -9.81);"}
motion = {**plane, "constant/groundMotion": "direction (1 0 0); acceleration { type constant; value 3.0; }"}
alphaColumns = ("alpha[-] status[-] blocks[-] contactPoints[-] variables[-] iterations[-] primalResidual[-] dualResidual[-] "
                "gap[-] cpuTime[s]")
number = r"[-+0-9.e]+"


class Contract(CaseTest):
    def case(self, usual, files=()):
        """A case with the usual files and others, which replace them."""
        self.count = getattr(self, "count", 0) + 1
        folder = os.path.join(self.root.name, self.id().rsplit(".", 1)[-1] + str(self.count))
        for name, text in {**usual, **dict(files)}.items():
            os.makedirs(os.path.dirname(os.path.join(folder, name)), exist_ok=True)
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(header % os.path.basename(name) + text + "\n")
        return folder

    def call(self, name, *options, status=0, **environment):
        done = subprocess.run([os.path.join(applications, name), *options], capture_output=True, text=True, timeout=120,
                              check=False, **environment)
        self.assertEqual(done.returncode, status, f"{name} {options}\n" + done.stdout[-1500:] + done.stderr)
        return done

    def build(self, case, blocks=None):
        self.call("blockTexture", "-case", case)
        self.assertTrue(os.path.isdir(os.path.join(case, "constant/assembly")))
        self.assertTrue(os.path.exists(os.path.join(case, "VTK/assembly.vtp")))
        if blocks is not None:
            said = self.call("checkBlocks", "-case", case, "-allChecks").stdout
            self.assertIn("Assembly OK.", said)
            self.assertRegex(said, rf"(?m)^\s*(free )?blocks\D*{blocks}\b")
        return case

    def columns(self, case, name):
        return self.read(case, os.path.join("postProcessing", name)).splitlines()[0].lstrip("# ").split()

    def testOptionsOfAllApplications(self):
        for name in ("blockTexture", *solvers, *others):
            with self.subTest(application=name):
                said = self.call(name, "-help", env={}).stdout
                options = ["-case", "-help", "-parallel", "-noFunctionObjects"]
                options += ["-dict"] if name == "blockTexture" else []
                options += ["-postProcess", "-dry-run"] if name in solvers else []
                for option in options:
                    self.assertRegex(said, rf"(?m)^ +{option}\b")
                self.assertRegex(self.call(name, "-version").stdout, r"^Drystone \d+\.\d+\.\d+( at [0-9a-f]+)?\n$")
                self.assertIn("-unheardOf", self.call(name, "-unheardOf", status=1).stderr)
                self.assertIn("-unheardOf", self.call(name, "-help", "-unheardOf", status=1).stderr)
                if name != "ensemble":
                    arguments = ["constant/g"] if name == "caseDictionary" else []
                    said = self.call(name, *arguments, "-parallel", "-case", self.case(plane), status=1).stderr
                    self.assertIn("--> DRYSTONE FATAL ERROR", said)
                    self.assertIn("no parallel mode", said)

    def testDrystoneNewNamesAnUnknownOption(self):
        for options in (("-unheardOf",), ("-help", "-unheardOf")):
            self.assertIn("-unheardOf", self.call("drystone-new", *options, status=1).stderr)

    def testDrystoneNewPrintsADirectoryAsAShellReadsIt(self):
        for name, text in (("wall", "wall"), ("my wall", "'my wall'"), ("it's $HOME", "'it'\\''s $HOME'")):
            with self.subTest(directory=name):
                with tempfile.TemporaryDirectory() as folder:
                    said = self.call("drystone-new", "arch", name, cwd=folder).stdout
                    self.assertIn(f"\n  cd {text}\n", said)
                    command = re.search(r"  (cd .*)", said)[1]
                    self.assertEqual(subprocess.run(["bash", "-c", command + " && ls constant/g"], cwd=folder, text=True,
                                                    capture_output=True, check=True).stdout, "constant/g\n")

    def testCaseDictionaryHasTheOptionsOfFoamDictionary(self):
        case = self.case(plane)
        file = "constant/contactProperties"

        def dictionary(*options, **more):
            return self.call("caseDictionary", "-case", case, file, *options, **more).stdout.strip()

        self.assertEqual(dictionary("-entry", "friction/mu", "-value"), "0.65")
        self.assertEqual(dictionary("-keywords"), "FoamFile\nfriction")
        dictionary("-entry", "friction/mu", "-set", "0.5")
        dictionary("-entry", "friction/cohesion", "-add", "1")
        self.assertEqual(dictionary("-entry", "friction/cohesion", "-value"), "1")
        dictionary("-entry", "friction/cohesion", "-remove")
        self.assertNotIn("cohesion", self.read(case, file))
        self.assertIn("mu", dictionary("-expand"))
        dictionary("-entry", "friction/unheardOf", status=1)

    def testAnErrorOfInput(self):
        case = self.case(plane, files={"system/blockTextureDict": wall.replace("runningBond", "runingBond")})
        said = self.call("blockTexture", "-case", case, status=1).stderr
        self.assertRegex(said, r"(?s)^\s*--> DRYSTONE FATAL IO ERROR:\nUnknown texture type runingBond. Did you mean "
                               r"runningBond\?\n\nValid texture types: arch [^\n]*runningBond\n\n"
                               r"file: \S*system/blockTextureDict/texture/type at line \d+\.\n\nDRYSTONE exiting\n")
        self.assertFalse(os.path.exists(os.path.join(case, "constant/assembly")))

    def testTexturesOfThePlane(self):
        def texture(text, supports="supports { ground { type ground; } }"):
            return self.case(plane, files={"system/blockTextureDict": f"dimensions 2;\ntexture {{ {text} }}\n{supports}"})

        self.build(self.case(plane), 0 or None)
        # The opening of the documented example ends above its six courses.
        self.call("blockTexture", "-case", self.case(plane, files={"system/blockTextureDict": bond % 6}))
        self.build(texture("type courses; unit (0.4 0.175); thickness 1; rows ( (0.5 1 1 0.5) (1 -1 1) );"))
        self.build(texture("type polygons; thickness 1; blocks ( ((0 0) (0 1) (1 1) (1 0)) "
                           "((0 1) (2 1) (2 3) (1 3) (1 2) (0 2)) );", "supports { abutments { type blocks; blocks (0); } }"))
        self.build(texture("type arch; profile circular; radius 1; thickness 0.15; voussoirs 27; depth 1; angle 180;"))

    def testTexturesOfSpace(self):
        ground = "supports { ground { type ground; } }"
        english = """type walls; unit (0.25 0.125 0.065); bond english; courses 20;
            walls { front { from (0 0); direction (1 0); length 8; thickness left; }
                    side { from (0 0); direction (0 1); length 6; thickness right; } }
            openings ( { wall front; from (2 4); to (4 12); lintel 0.5; } );"""
        bonds = [english.replace("english", name) for name in ("flemish", "header")]
        bonds += [english.replace("english", name).replace("(0.25 0.125 0.065)", "(0.2 0.1 0.065)")
                  for name in ("stack", "running")]
        textures = [
            ("type boxes; blocks ( ((0 0 0) (0.4 0.2 0.175)) );", ground),
            ("type polyhedra; blocks ( { vertices ( (0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 1) (1 0 1) (1 1 1) (0 1 1) ); "
             "faces ( (0 3 2 1) (4 5 6 7) (0 1 5 4) (1 2 6 5) (2 3 7 6) (3 0 4 7) ); } );", ground),
            ("type extrusion; of { type runningBond; unit (0.4 0.175); length 5; courses 6; } thickness 0.4;", ground),
            (english, ground), *((text, ground) for text in bonds),
            ("type barrelVault; radius 1; thickness 0.1; voussoirs 27; length 2; slices 4; staggered yes; angle 180;", ground),
            ("type dome; radius 1; thickness 0.1; around 8; rows 8; cap 10;", ground),
            ("type dome; radius 1; thickness 0.1; around 8; rows 8; oculus 20;", ground)]
        for text, supports in textures:
            with self.subTest(texture=text):
                case = self.case(space, files={"system/blockTextureDict":
                                               f"dimensions 3;\ntexture {{ {text} }}\n{supports}"})
                self.build(case)
                self.assertIn("Assembly OK.", self.call("checkBlocks", "-case", case).stdout)
                self.assertRegex(self.call("limitAnalysis", "-case", case).stdout, r"Status: (optimal|unstable|unbounded)")

    def annotatedTexture(self, name):
        """The example of a texture of space in etc/annotated, which has all but the first one in comments."""
        root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")
        text = self.read(root, "etc/annotated/space/system/blockTextureDict")
        examples = re.findall(r"(?ms)^// texture\n(// \{\n.*?^// \}\n)", text)
        example = next(text for text in examples if re.search(rf"(?m)^//     type +{name};", text))
        return "texture\n" + re.sub(r"(?m)^// ?", "", example)

    def testTexturesOfSpaceWithTheKeysOfTheirAnnotatedDictionary(self):
        for name in ("crossVault", "column", "stair", "rubble"):
            with self.subTest(texture=name):
                ground = "" if name == "stair" else "supports { ground { type ground; } }"  # its wall is its support
                files = {"system/blockTextureDict": f"dimensions 3;\n{self.annotatedTexture(name)}\n{ground}"}
                case = self.build(self.case(space, files=files))
                self.assertIn("Assembly OK.", self.call("checkBlocks", "-case", case).stdout)
                self.assertRegex(self.call("limitAnalysis", "-case", case).stdout, r"Status: (optimal|unstable|unbounded)")

    def testRubbleOfSpaceHasASeed(self):
        def blocks(seed):
            text = f"dimensions 3; texture {{ type rubble; size (2 0.5 1); stones 30; seed {seed}; }}"
            case = self.build(self.case(space, files={"system/blockTextureDict": text + "supports { ground { type ground; } }"}))
            return self.read(case, "constant/assembly/blocks")

        self.assertEqual(blocks(1), blocks(1))
        self.assertNotEqual(blocks(1), blocks(2))

    def testAWallOfItsExampleIsImported(self):
        case = self.case(space, files={"system/blockTextureDict": "dimensions 3;\ntexture { type boxes; blocks ( "
                                       "((0 0 0) (400 200 175)) ((0 0 175) (400 200 350)) ); }\nsupports { below { type "
                                       "blocks; blocks (0); } }"})
        self.build(case)
        self.call("exportBlocks", "-case", case, "-output", "constant/triSurface/tower.obj")
        self.call("caseDictionary", "-case", case, "system/blockTextureDict", "-entry", "texture", "-set",
                  '{ type import; file "constant/triSurface/tower.obj"; format auto; scale 0.001; }')
        self.call("caseDictionary", "-case", case, "system/blockTextureDict", "-entry", "supports", "-set",
                  "{ below { type blocks; blocks (0); } }")
        self.build(case)

    def testLimitAnalysis(self):
        case = self.build(self.case(plane))
        said = self.call("limitAnalysis", "-case", case).stdout
        self.assertRegex(said, r"(?m)^Collapse load multiplier alpha = 0\.\d{6,}$")
        self.assertRegex(said, r"(?m)^Status: optimal$")
        for word in ("rimal residual", "ual residual", "gap"):
            self.assertIn(word, said)
        self.assertEqual(self.columns(case, "limitAnalysis/0/limitAnalysis.dat"), alphaColumns.split())
        self.assertTrue(os.path.exists(os.path.join(case, "VTK/blocks.vtp.series")))
        # The three answers.
        def answer(loads, mu="0.65"):
            case = self.build(self.case(plane, files={
                "constant/loads": loads, "constant/contactProperties": f"friction {{ type Coulomb; mu {mu}; }}"}))
            said = self.call("limitAnalysis", "-case", case).stdout
            status = self.read(case, "postProcessing/limitAnalysis/0/limitAnalysis.dat").splitlines()[1].split()[1]
            return re.search(r"(?m)^Status: (\w+)", said).group(1), status

        self.assertEqual(answer(plane["constant/loads"]), ("optimal", "0"))
        self.assertEqual(answer("dead { type inertial; direction (1 0 0); } live { type gravity; }"), ("unstable", "1"))
        self.assertEqual(answer("dead { type gravity; } live { type gravity; }"), ("unbounded", "2"))
        self.assertEqual(answer("dead { type gravity; } live { type force; at (0.1 0.1); value (0 -1000 0); }")[0], "unbounded")

    def testWhatIsOfMotionIsNoPartOfALimitAnalysis(self):
        case = self.build(self.case(plane))
        with open(os.path.join(case, "constant/contactProperties"), "a", encoding="utf-8") as file:
            file.write("restitution { normal 0.5; } damping { massProportional 1; }\n")
        for name in ("0/motion", "constant/groundMotion"):
            os.makedirs(os.path.dirname(os.path.join(case, name)), exist_ok=True)
            with open(os.path.join(case, name), "w", encoding="utf-8"):
                pass
        said = self.call("limitAnalysis", "-case", case, "-dry-run").stdout
        self.assertIn("Not part of limit analysis: restitution damping groundMotion 0/motion", said)
        self.assertNotRegex(said, r"Effects absent:.*(restitution|damping|groundMotion)")
        self.assertRegex(said, r"Effects absent:.*cohesion")

    def testASettlement(self):
        case = self.build(self.case(plane, files={
            "constant/loads": "dead { type gravity; } live { type supportMovement; support right; direction (0 -1 0); }",
            "system/blockTextureDict": "dimensions 2; texture { type polygons; thickness 1; blocks ( ((0 0) (1 0) (1 1) (0 1)) "
            "((2 0) (3 0) (3 1) (2 1)) ((0 1) (3 1) (3 2) (0 2)) ); } supports { left { type blocks; blocks (0); } "
            "right { type blocks; blocks (1); } }"}))
        self.assertRegex(self.call("limitAnalysis", "-case", case).stdout, "(?m)^Status: optimal$")

    def testASolverThatDoesNotReachItsToleranceExitsWith2(self):
        case = self.build(self.case(plane, files={
            "system/solution": "limitAnalysis { solver interiorPoint; tolerance 1e-9; maximumIterations 2; }"}))
        done = self.call("limitAnalysis", "-case", case, status=2)
        self.assertNotIn("alpha =", done.stdout)

    def testContactDynamics(self):
        functions = ("functions { energy { writeControl timeStep; writeInterval 1; } "
                     "blockMotion { blocks (3 7); writeControl timeStep; writeInterval 1; } "
                     "contactForces { writeControl timeStep; writeInterval 1; } "
                     "residuals { writeControl timeStep; writeInterval 1; } }")
        case = self.build(self.case(motion, files={
            "system/controlDict": plane["system/controlDict"].replace("functions {}", functions)}))
        said = self.call("contactDynamics", "-case", case).stdout
        steps = re.findall(r"(?m)^Time = (\S+)", said)
        self.assertEqual((len(steps), steps[0], steps[-1]), (10, "0.002", "0.02"))
        self.assertEqual(len(re.findall(rf"(?m)^\w+:  Solving for contact, Initial residual = {number}, Final residual = "
                                        rf"{number}, No Iterations \d+$", said)), 10)
        self.assertEqual(len(re.findall(rf"(?m)^ExecutionTime = {number} s  ClockTime = {number} s$", said)), 10)
        self.assertEqual(said.rstrip().splitlines()[-1], "End")
        for block in (3, 7):
            self.assertEqual(self.columns(case, f"blockMotion/0/block{block}.dat"),
                             "Time[s] ux[m] uy[m] rz[rad] vx[m/s] vy[m/s] wz[rad/s]".split())
        energy = self.columns(case, "energy/0/energy.dat")
        self.assertEqual(energy[0], "Time[s]")
        for name in ("kinetic", "potential", "xternal", "riction", "mpact", "lgorithmic", "imbalance"):
            self.assertTrue(any(name in column for column in energy), (name, energy))
        self.assertTrue(all(column.endswith("[J]") for column in energy[1:]))
        for name in ("contactForces", "residuals"):
            self.assertEqual(self.columns(case, f"{name}/0/{name}.dat")[0], "Time[s]")
        self.assertTrue(os.path.exists(os.path.join(case, "0.02/state")))
        # A dry run checks and runs nothing; latestTime continues bit for bit.
        self.call("contactDynamics", "-case", case, "-dry-run")
        whole = self.build(self.case(motion))
        self.call("contactDynamics", "-case", whole)
        parts = self.build(self.case(motion, files={
            "system/controlDict": plane["system/controlDict"].replace("endTime 0.02", "endTime 0.01")}))
        self.call("contactDynamics", "-case", parts)
        for entry, value in (("endTime", "0.02"), ("startFrom", "latestTime")):
            self.call("caseDictionary", "-case", parts, "system/controlDict", "-entry", entry, "-set", value)
        self.call("contactDynamics", "-case", parts)
        arrays = [self.read(folder, "0.02/state").split("translation")[1] for folder in (whole, parts)]
        self.assertEqual(*arrays)

    def testColumnsOfMotionInSpace(self):
        case = self.build(self.case(space, files={
            "constant/groundMotion": "direction (1 0 0); acceleration { type constant; value 3.0; }",
            "system/blockTextureDict": "dimensions 3; texture { type boxes; blocks ( ((0 0 0) (0.4 0.2 0.175)) ); } "
                                       "supports { ground { type ground; } }",
            "0/motion": "0 { displacement (0 0 0); rotation (0 0 0); velocity (0.1 0 0); angularVelocity (0 0 0.1); }",
            "system/controlDict": plane["system/controlDict"].replace("functions {}", "functions { blockMotion { blocks (0); } }")}))
        self.call("contactDynamics", "-case", case)
        columns = self.columns(case, "blockMotion/0/block0.dat")
        self.assertEqual(columns[:7], "Time[s] ux[m] uy[m] uz[m] rx[rad] ry[rad] rz[rad]".split())

    def testMotionsOfTheGroundAndOfTheStart(self):
        with open(os.path.join(self.root.name, "a.csv"), "w", encoding="utf-8") as file:
            file.write("0,0\n0.01,1\n0.02,0\n")
        accelerations = ["type constant; value 3.0;", "type rectangularPulse; amplitude 3; duration 0.01; start 0;",
                         "type halfSine; amplitude 3; duration 0.01; start 0.001;",
                         "type sine; amplitude 3; duration 0.01; start 0;",
                         "type table; values ((0 0) (0.01 1) (0.02 0));",
                         f'type table; file "{self.root.name}/a.csv";',
                         f'type record; file "{self.root.name}/a.csv"; format csv; scale 2;']
        for text in accelerations:
            with self.subTest(acceleration=text):
                case = self.build(self.case(motion, files={
                    "constant/groundMotion": f"direction (1 0 0); acceleration {{ {text} }}",
                    "0/motion": "30 { displacement (0 0); rotation 0; velocity (0 0); angularVelocity 0; }\n"
                                "\"3[1-2]\" { velocity (0 0.001); }"}))
                said = self.call("contactDynamics", "-case", case).stdout
                if "format csv" in text:  # in m/s2 unless it says something else
                    self.assertRegex(said, r"(?m)^ +unit +m/s2, assumed")
                    self.assertRegex(said, r"(?m)^ +PGA +2 m/s2")

    def testEffects(self):
        case = self.build(self.case(motion))
        said = self.call("contactDynamics", "-case", case).stdout
        self.assertRegex(said, r"(?i)friction")

    def testAnEnsemble(self):
        records = "".join(f"PEER\nname\nACCELERATION TIME HISTORY IN UNITS OF G\nNPTS= 3, DT= .01 SEC\n 0.0 0.{i} 0.0\n|"
                          for i in (1, 2)).split("|")
        case = self.case(motion, files={
            "constant/groundMotion": 'direction (1 0 0); acceleration { type record; file "a.AT2"; format PEER_AT2; scale 1; }',
            "system/blockTextureDict": "dimensions 2; texture { type rubble; size (1 1); stones 12; seed 1; thickness 1; } "
                                       "supports { ground { type ground; } }",
            "system/ensembleDict": """
applications (blockTexture limitAnalysis);
variables
{
    mu     { file "constant/contactProperties"; entry "friction/mu"; distribution { type lognormal; median 0.65; beta 0.15; minimum 0.2; maximum 1.2; } }
    record { file "constant/groundMotion"; entry "acceleration/file"; distribution { type list; values ("a.AT2" "b.AT2"); } }
    stones { file "system/blockTextureDict"; entry "texture/seed"; distribution { type seed; } }
    unit   { file "constant/materialProperties"; entry "density"; distribution { type normal; mean 2000; standardDeviation 100; } }
}
correlations ( (mu unit 0.3) );
design { type latinHypercube; samples 6; seed 1; }
results { alpha { table "postProcessing/limitAnalysis/0/limitAnalysis.dat"; column alpha; } }
failures { attempts 2; maximumTime 600; maximumPart 0.01; }
statistics { capacity { type distribution; value alpha; fractiles (0.05 0.5 0.95); } }
"""})
        for name, text in zip(("a.AT2", "b.AT2"), records):
            with open(os.path.join(case, name), "w", encoding="utf-8") as file:
                file.write(text)
        self.call("ensemble", "-case", case)
        columns = self.columns(case, "ensemble/0/samples.dat")
        self.assertEqual(columns[0], "sample[-]")
        self.assertEqual(columns[-3:], ["status[-]", "attempts[-]", "cpuTime[s]"])
        self.assertEqual([name.split("[")[0] for name in columns[1:-3]], ["mu", "record", "stones", "unit", "alpha"])
        rows = self.read(case, "postProcessing/ensemble/0/samples.dat").splitlines()[1:]
        self.assertEqual([row.split()[0] for row in rows], [str(i) for i in range(6)])
        for name in ("samples.csv", "statistics.dat"):
            self.assertTrue(os.path.exists(os.path.join(case, "postProcessing/ensemble/0", name)), name)
        said = self.call("ensemble", "-help").stdout
        for option in ("-submit", "-parallel"):
            self.assertRegex(said, rf"(?m)^ +{option}\b")
        for design in ("random", "latinHypercube", "sobol", "grid", "table"):
            self.assertRegex(said, rf"\b{design}\b")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
