# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""The Python package on cases that were just computed, with NumPy where that is installed and without it."""
import fractions
import math
import os
import pathlib
import subprocess
import sys
import unittest

here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(here, ".."))
sys.path.insert(0, os.path.join(here, "../../python"))
import drystone  # noqa: E402
from caseTest import CaseTest, applications, tutorial  # noqa: E402


class Package(CaseTest):
    def case(self, name="basePulse"):
        case = drystone.Case(self.copyOf(os.path.join(tutorial, name)), applications)
        case.run("blockTexture")
        return case

    def wall(self):
        return self.case("../../limitAnalysis/masonryPanels/wall1")

    def testReadsAMultiplierAndItsMechanism(self):
        wall = self.wall()
        self.assertIn("Status: optimal", wall.run("limitAnalysis"))
        table = wall.table("limitAnalysis")
        self.assertAlmostEqual(table["alpha"][0], 0.642859003, places=8)
        self.assertEqual(table.units["cpuTime"], "s")
        frames = list(wall.frames())
        self.assertEqual(len(frames), 21)
        self.assertEqual([frames[0].time, frames[-1].time], [0, 1])
        self.assertEqual(frames[0].largestDisplacement(), 0)
        self.assertGreater(frames[-1].largestDisplacement(), 0.01)
        self.assertEqual(sorted(int(block) for block in frames[0]["blockId"]), list(range(43)))
        self.assertEqual(len(frames[0].points), 172)
        self.assertEqual(len(frames[0].polygons), 43)
        self.assertEqual(sorted(i for polygon in frames[0].polygons for i in polygon), list(range(172)))
        brick = [frames[0].points[i] for i in frames[0].polygons[0]]
        self.assertEqual(len({(round(float(x), 6), round(float(y), 6)) for x, y, _ in brick}), 4)
        moved = frames[-1].pointFields["pointDisplacement[m]"]
        self.assertEqual(len(moved), 172)
        # Four corners a block; the ground is shown as far as the structure reaches.
        for i, (point, built, displacement) in enumerate(zip(frames[-1].points, frames[0].points, moved)):
            if frames[0]["support"][i // 4] < 0:
                self.assertAlmostEqual(point[0] - displacement[0], built[0], delta=1e-6)
        self.assertEqual(len(next(iter(wall.frames("contacts")))["contactForce"]), 174)

    def testSetsWhatADictionaryCanHave(self):
        case = self.case()
        values = [(True, "yes"), (False, "no"), (3, "3"), (-0.5, "-0.5"), (0.1, "0.1"), (1e-20, "1e-20"), ("off", "off"),
                  ((0, -9.81), "(0 -9.81)"), (range(3), "(0 1 2)"), ([(0, 1), (1, 2)], "((0 1) (1 2))"),
                  ([True, "a"], "(yes a)"), ([], "()"), (fractions.Fraction(1, 4), "0.25"),
                  (pathlib.Path("constant/a b.csv"), '"constant/a b.csv"')]
        try:
            import numpy
        except ImportError:
            pass
        else:
            values += [(numpy.float64(0.5), "0.5"), (numpy.float32(0.1), "0.1"), (numpy.int64(3), "3"),
                       (numpy.bool_(True), "yes"), (numpy.array(0.25), "0.25"), (numpy.array([0.0, -9.81]), "(0.0 -9.81)"),
                       (numpy.eye(2), "((1.0 0.0) (0.0 1.0))"), (numpy.array([True, False]), "(yes no)"),
                       ([numpy.float64(1), numpy.arange(2)], "(1.0(0 1))")]
        for value, text in values:
            case.set("constant/g", "value", value)
            self.assertEqual(case.get("constant/g", "value"), text, repr(value))
        case.set("constant/g", "inner", {"a": 1, "b": {"c": (1, 2), "d": True}, "e": []})
        self.assertEqual(case.get("constant/g", "inner/b/c"), "(1 2)")
        self.assertEqual(case.get("constant/g", "inner/b/d"), "yes")
        for value, fault in ((None, TypeError), ({1, 2}, TypeError), (b"a", TypeError), (1j, TypeError),
                             (float("nan"), ValueError), ({"a b": 1}, ValueError), ({1: 2}, ValueError)):
            with self.assertRaises(fault):
                case.set("constant/g", "value", value)
        # As what it is meant: contactDynamics knows no True.
        case.set("system/controlDict", "adjustTimeStep", False)
        case.set("constant/g", "value", (0, -9.81))
        self.runApplication("caseDictionary", case.directory, "constant/g", "-entry", "inner", "-remove")
        case.run("contactDynamics", "-dry-run")

    def testADirectoryMayBeRelative(self):
        wall, before = self.wall(), os.getcwd()
        os.chdir(os.path.dirname(wall.directory))
        try:
            relative = drystone.Case(os.path.basename(wall.directory), applications)
            relative.run("limitAnalysis")
            self.assertAlmostEqual(relative.table("limitAnalysis")["alpha"][0], 0.642859003, places=8)
            self.assertEqual(len(relative.table("limitAnalysis", "thrust.dat")["normalForce"]) > 0, True)
        finally:
            os.chdir(before)

    def testVariesAnEntryInACopy(self):
        wall = self.wall()
        other = wall.copy(str(wall.directory) + "Copy")
        with self.assertRaises(FileExistsError):
            wall.copy(other.directory)
        other = wall.copy(other.directory, replace=True)
        other.set("constant/contactProperties", "friction/mu", 0.3)
        other.set("constant/g", "value", (0, -9.81, 0))
        self.assertEqual(other.get("constant/contactProperties", "friction/mu"), "0.3")
        other.run("blockTexture")
        other.run("limitAnalysis")
        wall.run("limitAnalysis")
        self.assertLess(other.table("limitAnalysis")["alpha"][0], wall.table("limitAnalysis")["alpha"][0])

    def testACopyOfAProtectedCaseIsNotProtected(self):
        wall = self.wall()
        os.chmod(wall.directory / "constant/g", 0o440)
        copy = wall.copy(str(wall.directory) + "Copy")
        self.assertEqual(os.stat(copy.directory / "constant/g").st_mode & 0o777, 0o640)

    def testACopyDoesNotRemoveItsSource(self):
        wall = self.wall()
        for place in (wall.directory, wall.directory.parent, wall.directory / "inside"):
            os.makedirs(wall.directory.parent / "system", exist_ok=True)  # as if it were a case
            with self.assertRaises(ValueError):
                wall.copy(place, replace=True)
        self.assertTrue((wall.directory / "system/blockTextureDict").is_file())

    def testACopyHasNoTimesButZero(self):
        wall = self.wall()
        for time in ("0", "1e-05", "0.5", "2"):
            os.makedirs(wall.directory / time)
        copy = wall.copy(str(wall.directory) + "Copy")
        self.assertEqual([name for name in os.listdir(copy.directory) if name[0].isdigit()], ["0"])

    def testARowThatIsCutWithinANumberIsLeftOut(self):
        file = self.wall().directory / "cut.dat"
        file.write_text("# Time[s] loss[J]\n0.1 1.5e-08\n0.2 1.6934059", encoding="utf-8")
        self.assertEqual(list(drystone.readTable(file)["loss"]), [1.5e-08])

    def testWhatIsBetweenQuotesIsOneWordOfATable(self):
        file = os.path.join(self.root.name, "samples.dat")
        with open(file, "w", encoding="utf-8") as table:
            table.write('# sample[-] file alpha\n0 a.dxf 0.5\n1 "b 2.dxf" 0.6\n')
        read = drystone.readTable(file)
        self.assertEqual(list(read["file"]), ["a.dxf", "b 2.dxf"])
        self.assertEqual(list(read["alpha"]), [0.5, 0.6])

    @unittest.skipUnless(drystone.hasNumPy, "NumPy is not installed")
    def testTablesAndFramesAreArraysOfNumPy(self):
        import numpy
        wall = self.wall()
        wall.run("limitAnalysis")
        self.assertIsInstance(wall.table("limitAnalysis")["alpha"], numpy.ndarray)
        frame = list(wall.frames())[-1]
        self.assertEqual(frame["displacement"].shape, (43, 3))
        self.assertAlmostEqual(float(numpy.linalg.norm(frame["displacement"], axis=1).max()), frame.largestDisplacement())
        try:
            import pandas
        except ImportError:
            self.skipTest("pandas is not installed")
        table = wall.table("limitAnalysis").pandas()
        self.assertIsInstance(table, pandas.DataFrame)
        self.assertEqual(list(table.columns[:2]) + [table.shape[0]], ["alpha[-]", "status[-]", 1])

    def testReadsAMotion(self):
        case = self.case()
        case.run("contactDynamics")
        functions = sorted(os.listdir(os.path.join(case.directory, "postProcessing")))
        self.assertTrue(functions)
        frames = list(case.frames())
        self.assertGreater(len(frames), 1)
        self.assertTrue(all(a.time < b.time for a, b in zip(frames, frames[1:])))
        self.assertTrue(math.isfinite(frames[-1].largestDisplacement()))

    def testFailuresAreRaisedWithWhatWasSaid(self):
        wall = self.wall()
        wall.set("constant/contactProperties", "friction/mu", -1)
        with self.assertRaisesRegex(drystone.RunError, "out of range"):
            wall.run("limitAnalysis")
        with self.assertRaisesRegex(KeyError, "alpha"):
            drystone.Table({"alpha": []}, {"alpha": "-"})["beta"]
        with self.assertRaises(ValueError):
            drystone.readTable(os.path.join(here, "../../python/pyproject.toml"))
        with self.assertRaises(FileNotFoundError):
            drystone.Case(wall.directory, "/nowhere").run("limitAnalysis")
        with self.assertRaisesRegex(FileNotFoundError, "no case directory /nonexistent"):
            drystone.Case("/nonexistent", wall.applications).run("limitAnalysis")

    def testWorksWithoutNumPy(self):
        wall = self.wall()
        wall.run("limitAnalysis")
        script = ("import sys; sys.modules['numpy'] = None\n"
                  f"sys.path.insert(0, {os.path.join(here, '../../python')!r})\n"
                  f"import drystone; case = drystone.Case({str(wall.directory)!r})\n"
                  "frame = list(case.frames())[-1]\n"
                  "print(type(case.table('limitAnalysis')['alpha']).__name__, len(frame['displacement'][0]))")
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(done.stdout.strip(), "list 3", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
