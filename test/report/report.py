# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""A whole report: what its page holds, that it requests nothing, and its viewer driven in headless Chromium."""
import html
import json
import os
import re
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from caseTest import CaseTest, applications, tutorial  # noqa: E402

viewer = os.path.join(applications, "../share/drystone/viewer.js")
hasViewer = shutil.which("chromium") and os.path.exists(viewer) and os.path.getsize(viewer) > 0
noViewer = "viewer not tested: chromium is not installed, or Drystone was built without npm"

# Moves the slider, clicks into the middle and leaves what it saw in the title, which is printed with the page.
drive = """<script>
addEventListener("load", () => {
    const element = document.querySelector(".viewer"), canvas = element.querySelector("canvas");
    const control = (name) => element.querySelector(`[name=${name}]`);
    const seen = { ready: element.dataset.ready, pictures: [], readouts: [], scales: [], shares: [] };
    // The share of a picture that is not white: what the structure covers.
    const share = () => {
        const flat = Object.assign(document.createElement("canvas"), { width: canvas.width, height: canvas.height });
        const context = flat.getContext("2d");
        context.drawImage(canvas, 0, 0);
        const bytes = context.getImageData(0, 0, flat.width, flat.height).data;
        let count = 0;
        for (let i = 0; i < bytes.length; i += 4) { count += bytes[i] + bytes[i + 1] + bytes[i + 2] < 740 ? 1 : 0; }
        return count / (flat.width * flat.height);
    };
    const look = () => {
        seen.pictures.push(canvas.toDataURL());
        seen.readouts.push(element.querySelector(".readout").textContent);
        seen.scales.push(element.querySelector(".scale:not([hidden])")?.textContent ?? "");
        seen.shares.push(share());
    };
    const set = (name, value) => { control(name).value = value; control(name).dispatchEvent(new Event("input")); };
    look();
    set("frame", 0); look();
    set("frame", control("frame").max); look();
    set("quantity", "displacement"); look();
    set("magnification", 0); look();  // where they were built: a block is in the middle
    const box = canvas.getBoundingClientRect();
    const at = { clientX: box.left + box.width / 2, clientY: box.top + box.height / 2, pointerId: 1, bubbles: true };
    canvas.setPointerCapture = canvas.releasePointerCapture = () => {};
    for (const type of ["pointerdown", "pointerup"]) { canvas.dispatchEvent(new PointerEvent(type, at)); }
    look();
    seen.pictures = seen.pictures.map((picture) => seen.pictures.indexOf(picture));
    const result = document.createElement("pre");
    result.id = "seen";
    result.textContent = JSON.stringify(seen);
    document.body.append(result);
});
</script>"""


class Report(CaseTest):
    application = "report"

    def caseOf(self, name):
        case = self.copyOf(os.path.join(tutorial, name))
        self.runApplication("blockTexture", case)
        return case

    def wall(self):
        return self.caseOf("wall1")

    def testHoldsInputResultAndHowToRepeatIt(self):
        case = self.wall()
        with open(os.path.join(case, "log.limitAnalysis"), "w", encoding="utf-8") as log:
            log.write(self.runApplication("limitAnalysis", case).stdout + "--> DRYSTONE Warning :\nA <doubt>.\n\nfile: x at line 1.\n\n")
        self.assertIn("Wrote " + os.path.join(case, "report.html"), self.run_(case).stdout)
        page = self.read(case, "report.html")
        for part in ("alpha = 0.642859", "at collapse 1.35 kN", "primal residual", "33 free, 10 fixed",
                     "<td>friction/mu</td><td>0.65</td><td>-</td>", "A &lt;doubt&gt;.", "limitAnalysis -case", "<svg"):
            self.assertIn(part, page)
        # It requests nothing: no element names a file or an address.
        markup = re.sub(r"<script.*?</script>", "", page, flags=re.DOTALL)
        self.assertEqual(re.findall(r"<(?:link|img|script|iframe)[^>]*(?:src|href)=", markup), [])

    def testSaysThatCollapsesByCoulombsLawAreNotUnique(self):
        case = self.wall()
        self.edit(case, "constant/contactProperties", "friction/flowRule", "nonAssociative")
        with open(os.path.join(case, "log.limitAnalysis"), "w", encoding="utf-8") as log:
            log.write(self.runApplication("limitAnalysis", case).stdout)
        self.run_(case)
        page = html.unescape(self.read(case, "report.html"))
        self.assertNotIn("largest that the structure carries", page)
        self.assertRegex(page, r"Coulomb's law: lowest of the collapses found, alpha .* associative, an upper bound: 0.64")

    def testSaysWhereTheTimeOfASearchWasUsedUp(self):
        case = self.wall()
        self.edit(case, "constant/contactProperties", "friction/flowRule", "nonAssociative")
        lines = self.read(case, "system/solution").splitlines()
        place = next(i for i, line in enumerate(lines) if line.strip() == "limitAnalysis") + 2
        self.assertEqual(lines[place - 1].strip(), "{")

        def limit(entry):
            with open(os.path.join(case, "system/solution"), "w", encoding="utf-8") as file:
                file.write("\n".join([*lines[:place], "nonAssociative { " + entry + " }", *lines[place:]]) + "\n")

        for entry, said in {"maximumTime 0;": "maximumTime", "maximumTime -1;": "maximumTime",
                            "maximumTme 60;": "maximumTime", "maximumTime long;": "maximumTime"}.items():
            limit(entry)
            done = self.runApplication("limitAnalysis", case, "-dry-run", status=1)
            self.assertIn(said, done.stderr)
            self.assertIn(f"at line {place + 1}.", done.stderr)
        limit("maximumTime 1000;")
        self.runApplication("limitAnalysis", case)
        self.assertNotIn("cutShort", self.read(case, "postProcessing/limitAnalysis/0/coulomb.dat"))
        limit("maximumTime 1e-9;")
        done = self.runApplication("limitAnalysis", case)
        self.assertIn("Collapse load multiplier alpha <= 0.642859", done.stdout)
        self.assertRegex(done.stdout, r"(?m)^The search was ended by maximumTime after [\d.e-]+ s, before all was tried: ")
        self.assertIn("Status: upper bound", done.stdout)
        self.assertIn("Raise it, or remove it", done.stderr)
        self.assertRegex(done.stderr, rf"system/solution/limitAnalysis/nonAssociative/maximumTime at line {place + 1}\.")
        names, row = self.read(case, "postProcessing/limitAnalysis/0/coulomb.dat").splitlines()
        self.assertEqual(names.split()[-1], "cutShortAfter[s]")
        self.assertEqual(len(row.split()), len(names.split()) - 1)
        progress = ("Coulomb's law: path 1, 20 pieces, at 0.1 times the live load\n"
                    "Coulomb's law: start 2, 7 programs, at 0.2 times the live load\n")
        for log in ("", progress + done.stdout):
            with open(os.path.join(case, "log.limitAnalysis"), "w", encoding="utf-8") as file:
                file.write(log)
            self.run_(case)
            page = html.unescape(self.read(case, "report.html"))
            self.assertRegex(page, r"The search was ended by maximumTime after [\d.e-]+ s, before all was tried")
            self.assertNotIn("20 pieces", page)
            self.assertNotIn("7 programs", page)

    def testSaysWhichResultsAreMissingOrDamaged(self):
        case = self.wall()
        self.runApplication("limitAnalysis", case)
        name = "postProcessing/limitAnalysis/0/limitAnalysis.dat"
        good = self.read(case, name)
        heading, row = good.splitlines()
        for content, said in {None: "is missing", "garbage x y\n": "holds no multiplier",
                              f"{heading}\nnan {row.split(maxsplit=1)[1]}\n": "holds no multiplier",
                              f"{heading}\n{row.split()[0]} nan {row.split(maxsplit=2)[2]}\n": "holds no multiplier",
                              f"{good}0.1 abc\n": "is damaged in line 3",
                              good.replace(" 33 ", " 55 ", 1): "is of 55 free blocks, and this case has 33"}.items():
            os.remove(os.path.join(case, name))
            if content is not None:
                with open(os.path.join(case, name), "w", encoding="utf-8") as file:
                    file.write(content)
            done = self.run_(case)
            self.assertIn(f"{name} {said}", done.stdout + done.stderr)
            self.assertIn(f"{name} {said}", self.read(case, "report.html"))
            if content is None:
                with open(os.path.join(case, name), "w", encoding="utf-8") as file:
                    file.write(good)
        with open(os.path.join(case, name), "w", encoding="utf-8") as file:
            file.write(good)
        self.checkWarnsOfNothing(case)

    def testNamesOfCombinationsAreThoseOfTheirAnswers(self):
        case = self.caseOf("../combinedLoads/combinations")
        self.runApplication("limitAnalysis", case)
        self.run_(case)
        self.assertIn("Combination pulled: alpha = 4.905", self.read(case, "report.html"))
        name = "postProcessing/limitAnalysis/0/limitAnalysis.dat"
        heading, first, _, last = self.read(case, name).splitlines()
        with open(os.path.join(case, name), "w", encoding="utf-8") as file:
            file.write(f"{heading}\n{first}\n{last}\n")
        done = self.run_(case)
        fault = "combinations.dat does not have the 2 answers of limitAnalysis.dat"
        self.assertIn(fault, done.stdout + done.stderr)
        page = self.read(case, "report.html")
        self.assertIn(fault, page)
        self.assertNotIn("Combination loaded", page)

    def edit(self, case, name, entry, value):
        self.runApplication("caseDictionary", case, name, "-entry", entry, "-set", value)

    def checkWarns(self, case, warning):
        """In the log and on the page."""
        done = self.run_(case)
        self.assertRegex(done.stdout + done.stderr, warning)
        page = html.unescape(self.read(case, "report.html"))
        self.assertIn("Results of other input", page)
        self.assertRegex(page, warning)

    def checkWarnsOfNothing(self, case):
        done = self.run_(case)
        self.assertNotIn("Warning", done.stdout + done.stderr)
        self.assertNotIn("other input", self.read(case, "report.html"))

    def testWarnsOfAMultiplierOfOtherInput(self):
        case = self.wall()
        self.runApplication("limitAnalysis", case)
        self.checkWarnsOfNothing(case)
        self.edit(case, "constant/contactProperties", "friction/mu", "0.01")
        self.checkWarns(case, "results of limitAnalysis are those of other input: constant/contactProperties has changed")
        self.edit(case, "constant/contactProperties", "friction/mu", "0.65")
        self.checkWarnsOfNothing(case)

    def testWarnsOfAMotionOfOtherInput(self):
        case = self.caseOf("../../contactDynamics/fallingWall/wall")
        self.edit(case, "system/controlDict", "endTime", "0.5")
        self.runApplication("contactDynamics", case)
        self.checkWarnsOfNothing(case)
        self.edit(case, "constant/contactProperties", "friction/mu", "0.01")
        self.checkWarns(case, "results at time .*0.5 are those of other input .* constant/contactProperties has changed")

    def testTheStartOfAMotionIsThatOfItsBeginning(self):
        case = self.caseOf("../../contactDynamics/bouncingBlock")
        os.makedirs(os.path.join(case, "0"), exist_ok=True)
        with open(os.path.join(case, "0/motion"), "w", encoding="utf-8") as file:
            file.write('"1" { displacement (0 1); }\n')
        self.edit(case, "system/controlDict", "startFrom", "latestTime")
        self.runApplication("contactDynamics", case)
        self.checkWarnsOfNothing(case)
        self.edit(case, "0/motion", "1/displacement", "(0 0.7)")
        self.checkWarns(case, "results at time .* are those of other input .* 0/motion has changed")

    def testWarnsOfSamplesOfOtherInput(self):
        case = self.wall()
        with open(os.path.join(case, "system/ensembleDict"), "w", encoding="utf-8") as file:
            file.write("""applications (limitAnalysis);
variables { mu { file "constant/contactProperties"; entry "friction/mu"; distribution { type uniform; minimum 0.3; maximum 0.4; } } }
design { type random; samples 3; seed 3; }
results { alpha { table "postProcessing/limitAnalysis/0/limitAnalysis.dat"; column alpha; } }
""")
        self.runApplication("ensemble", case)
        self.checkWarnsOfNothing(case)
        self.edit(case, "constant/materialProperties", "unitWeight", "1500")
        self.checkWarns(case, "results of ensemble are those of other input: constant/materialProperties has changed")
        self.edit(case, "constant/materialProperties", "unitWeight", "1000")
        self.edit(case, "system/ensembleDict", "variables/mu/distribution/maximum", "0.5")
        self.checkWarns(case, "other input: .*variables of system/ensembleDict have changed")
        os.truncate(os.path.join(case, "postProcessing/ensemble/0/work/plan"), 0)
        self.assertIn("work/plan does not say from which input the results of ensemble were computed", self.run_(case).stdout)

    def testHasTheAnswersOfStudiesAlsoWithoutBlocks(self):
        case = self.wall()
        with open(os.path.join(case, "system/ensembleDict"), "w", encoding="utf-8") as file:
            file.write("""applications (blockTexture limitAnalysis);
variables { mu { file "constant/contactProperties"; entry "friction/mu"; distribution { type uniform; minimum -0.05; maximum 0.4; } } }
design { type random; samples 40; seed 3; }
results { alpha { table "postProcessing/limitAnalysis/0/limitAnalysis.dat"; column alpha; } }
failures { maximumPart 1; }
statistics { capacity { type distribution; value alpha; } }
""")
        for folder in ("VTK", "postProcessing", "constant/assembly"):
            shutil.rmtree(os.path.join(case, folder), ignore_errors=True)
        self.runApplication("ensemble", case)
        self.run_(case)
        page = self.read(case, "report.html")
        self.assertIn("Study: ensemble", page)
        self.assertRegex(page, r"40 samples; done: \d+, an application ended with an error: \d+")
        self.assertIn("lognormalMedian", page)

    def testOfACaseWithoutResultsSaysWhatToRun(self):
        case = self.wall()
        shutil.rmtree(os.path.join(case, "VTK"))
        done = self.run_(case, status=1)
        self.assertIn("has no results", done.stderr)
        self.assertFalse(os.path.exists(os.path.join(case, "report.html")))

    def testIsWrittenByTheSolverAndElsewhereOnRequest(self):
        case = self.wall()
        self.runApplication("limitAnalysis", case, "-report")
        page = self.read(case, "report.html")
        self.run_(case, "-output", os.path.join(case, "other.html"))
        # But for the log, which is not there, they are the same.
        self.assertEqual(page, self.read(case, "other.html"))

    def seenIn(self, case):
        """What a reader sees who drives the viewer of the page of a case."""
        page = self.read(case, "report.html").replace("</body>", drive + "</body>")
        with open(os.path.join(case, "driven.html"), "w", encoding="utf-8") as file:
            file.write(page)
        done = subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-dev-shm-usage", "--use-gl=angle",
                               "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--virtual-time-budget=10000",
                               "--user-data-dir=" + os.path.join(case, "chromium"), "--dump-dom",
                               "file://" + os.path.join(case, "driven.html")],
                              capture_output=True, text=True, timeout=200, check=False)
        found = re.search(r'<pre id="seen">(.*?)</pre>', done.stdout, re.DOTALL)
        self.assertTrue(found, done.stderr[-2000:])
        return json.loads(html.unescape(found.group(1)))

    def checkViewer(self, case, momentName, first, last):
        seen = self.seenIn(case)
        self.assertEqual(seen["ready"], "yes")
        # Shown first is the end: at the beginning it looks different, at its end again the same; colours and
        # magnification change the picture, and a click the colour of the block.
        self.assertEqual(seen["pictures"], [0, 1, 0, 3, 4, 5])
        self.assertGreater(min(seen["shares"]), 0.02)
        self.assertEqual(seen["scales"][:3], ["", "", ""])  # of one colour
        self.assertRegex(seen["scales"][3], r"^0 +[0-9.]*[1-9][0-9.e+-]* m$")
        self.assertIn(f"{momentName} {last}", seen["readouts"][0])
        self.assertIn(f"{momentName} {first}", seen["readouts"][1])
        self.assertRegex(seen["readouts"][5], r"Block \d+: displacement \([-0-9.e ]+\) m, rotation [0-9.e-]+ rad")

    @unittest.skipUnless(hasViewer, noViewer)
    def testTheViewerOfWall6FollowsSliderAndClick(self):
        case = self.caseOf("wall6")
        self.runApplication("limitAnalysis", case, "-report")
        self.checkViewer(case, "part of the mechanism", "0.000.", "1.000.")
        self.assertLess(os.path.getsize(os.path.join(case, "report.html")), 1.2e6)

    @unittest.skipUnless(hasViewer, noViewer)
    def testTheViewerOfAWallThatFallsUnderARecord(self):
        case = self.caseOf("../../contactDynamics/fallingWall/wall")
        self.runApplication("caseDictionary", case, "system/controlDict", "-entry", "endTime", "-set", "3.5")
        self.runApplication("contactDynamics", case, "-report")
        self.checkViewer(case, "time", "0.000 s.", "3.500 s.")
        page = self.read(case, "report.html")
        for part in ("After 3.5 s the largest displacement of a block is", "motion_3.5.svg", "groundMotion_m_s2.svg",
                     "<td>acceleration/peakAcceleration</td>"):
            self.assertIn(part, page)
        self.assertRegex(page, r"in these frames is [01]\.\d+ m, of block \d+ at 3\.5 s")
        self.assertRegex(page, r"[1-9]\d* of 146 blocks are farther from their places")
        # Moments in their order.
        self.assertEqual(re.findall(r"collapse/0/motion_([\d.]+)\.svg", page), ["2.5", "3", "3.5"])

    def testABlockThatStillSlidesIsNotSaidToStand(self):
        slide = "../../contactDynamics/slidingBlock/slide"
        case = self.caseOf(slide)
        shutil.copytree(os.path.join(tutorial, slide, "0"), os.path.join(case, "0"))
        # It has slid and rests for 0.3 s, which the way since the frame before does not say.
        for end, interval, said in (
                ("0.1", "0.05", r"0 of 1 blocks .* but block 1 still moves there, by 0\.411\d m/s\."),
                ("0.5", "0.05", "0 of 1 blocks .*: the structure stands"),
                ("0.5", "0.5", "0 of 1 blocks .*: the structure stands")):
            self.edit(case, "system/controlDict", "writeInterval", interval)
            self.edit(case, "system/controlDict", "endTime", end)
            self.runApplication("contactDynamics", case, "-report")
            self.assertRegex(self.read(case, "report.html"), said)

    def testFramesAreOfWhatWasRun(self):
        case = self.caseOf("wall6")
        self.edit(case, "system/controlDict", "application", "contactDynamics")
        self.runApplication("limitAnalysis", case, "-report")
        page = self.read(case, "report.html")
        self.assertIn(">Mechanism<", page)
        self.assertNotIn("largest displacement of a block", page)

    def testWithoutFramesOfTheEndNothingIsSaidOfIt(self):
        slide = "../../contactDynamics/slidingBlock/slide"
        case = self.caseOf(slide)
        shutil.copytree(os.path.join(tutorial, slide, "0"), os.path.join(case, "0"))
        self.edit(case, "system/controlDict", "endTime", "0.5")
        for interval in ("0.2", "7"):
            shutil.rmtree(os.path.join(case, "postProcessing"), ignore_errors=True)
            self.edit(case, "system/controlDict", "writeInterval", interval)
            self.runApplication("contactDynamics", case, "-report")
            page = self.read(case, "report.html")
            self.assertNotIn("the structure stands", page)
            self.assertIn("The run went on to 0.5 s without another frame", page)

    def testOfARunBeforeItsEndNothingIsConcluded(self):
        slide = "../../contactDynamics/slidingBlock/slide"
        case = self.caseOf(slide)
        shutil.copytree(os.path.join(tutorial, slide, "0"), os.path.join(case, "0"))
        self.edit(case, "system/controlDict", "endTime", "0.5")
        self.runApplication("contactDynamics", case)
        self.run_(case)
        self.assertIn("the structure stands", self.read(case, "report.html"))
        self.edit(case, "system/controlDict", "endTime", "12")
        done = self.run_(case)
        page = self.read(case, "report.html")
        for said in (page, done.stdout + done.stderr):
            self.assertIn("The run has come to 0.5 s, and endTime is 12 s", said)
        self.assertNotIn("the structure stands", page)
        shutil.rmtree(os.path.join(case, "VTK"))
        self.run_(case)
        self.assertIn("There are states, but no frames", self.read(case, "report.html"))

    def testWithoutAnAnswerSaysSo(self):
        case = self.wall()
        self.runApplication("caseDictionary", case, "system/solution", "-entry", "limitAnalysis/maximumIterations", "-add", "3")
        self.runApplication("limitAnalysis", case, status=2)
        done = self.run_(case)
        for said in (done.stdout + done.stderr, self.read(case, "report.html")):
            self.assertIn("There is no answer to report", said)
        self.runApplication("caseDictionary", case, "system/solution", "-entry", "limitAnalysis/maximumIterations", "-remove")
        self.runApplication("limitAnalysis", case)
        shutil.rmtree(os.path.join(case, "postProcessing"))
        self.run_(case)  # a mechanism without its multiplier
        self.assertIn("limitAnalysis.dat is missing", self.read(case, "report.html"))

    def testAPictureThatIsCutOffIsLeftOut(self):
        case = self.wall()
        self.runApplication("limitAnalysis", case)
        picture = os.path.join(case, "postProcessing/limitAnalysis/0/mechanism.svg")
        whole = os.path.getsize(picture)
        for size in (whole // 2, 0):
            os.truncate(picture, size)
            done = self.run_(case)
            page = self.read(case, "report.html")
            for said in (done.stdout + done.stderr, page):
                self.assertIn("mechanism.svg is cut off, or empty, and left out", said)
            self.assertEqual(page.count("<svg"), page.count("</svg>"))

    def testAPictureWithAScriptIsLeftOut(self):
        case = self.wall()
        self.runApplication("limitAnalysis", case)
        picture = "postProcessing/limitAnalysis/0/mechanism.svg"
        whole = self.read(case, picture)
        for added in ("<script>alert(1)</script></svg>", "<g\nONCLICK = 'alert(1)'/></svg>",
                      "<a href=\"javascript:alert(1)\"/></svg>"):
            with open(os.path.join(case, picture), "w", encoding="utf-8") as file:
                file.write(whole.replace("</svg>", added))
            done = self.run_(case)
            self.assertIn("mechanism.svg has a script", done.stdout + done.stderr)
            self.assertNotIn("alert(1)", self.read(case, "report.html"))

    def testSaysWhichLawTheForcesObey(self):
        for name, said in (("../jointStrength/tension", "balance it with tension up to a strength"),
                           ("../jointStrength/cohesion", "and cohesion"),
                           ("../jointStrength/crushing", "pressure up to a strength")):
            case = self.caseOf(name)
            self.runApplication("limitAnalysis", case, "-report")
            self.assertIn(said, self.read(case, "report.html"), name)
            shutil.rmtree(case)

    def testOfAStructureThatDoesNotStandNothingIsSaidOfAlpha(self):
        case = self.caseOf("../arch/falls")
        self.runApplication("limitAnalysis", case, "-report")
        page = self.read(case, "report.html")
        self.assertIn("unstable: the blocks cannot carry their dead load", page)
        self.assertNotIn("largest that the structure carries", page)

    def testAnAlphaOfOtherInputIsNotMultipliedByALoadOfNow(self):
        case = self.wall()
        self.runApplication("limitAnalysis", case, "-report")
        self.assertIn("at collapse", self.read(case, "report.html"))
        self.edit(case, "constant/materialProperties", "unitWeight", "2000")
        self.run_(case)
        self.assertNotIn("at collapse", self.read(case, "report.html"))

    def testSaysWhereAStudyHasNotEnded(self):
        case = self.wall()
        with open(os.path.join(case, "system/ensembleDict"), "w", encoding="utf-8") as file:
            file.write("""applications (blockTexture limitAnalysis);
variables { mu { file "constant/contactProperties"; entry "friction/mu"; distribution { type uniform; minimum 0.2; maximum 0.4; } } }
design { type random; samples 4; seed 3; }
results { alpha { table "postProcessing/limitAnalysis/0/limitAnalysis.dat"; column alpha; } }
statistics { capacity { type distribution; value alpha; } }
""")
        shutil.rmtree(os.path.join(case, "constant/assembly"))
        self.runApplication("ensemble", case)
        self.run_(case)
        page = self.read(case, "report.html")
        self.assertIn("system/ensembleDict", page)
        for samples in ("3", "4"):  # of an ensemble that was made smaller, and larger again
            self.edit(case, "system/ensembleDict", "design/samples", samples)
            self.runApplication("ensemble", case)
            self.run_(case)
            page = self.read(case, "report.html")
            self.assertIn(f"{samples} samples; done", page)
            self.assertNotIn("samples of the design", page)
        folder = os.path.join(case, "postProcessing/ensemble/0")
        samples = self.read(folder, "samples.dat")
        for name, text, said in (("samples.dat", samples.rsplit("\n", 2)[0] + "\n", "samples.dat has 3 of the 4 samples"),
                                 ("statistics.dat", "", "statistics.dat has nothing of capacity"),
                                 ("samples.dat", None, "samples.dat is missing or holds nothing")):
            self.assertNotIn(said, page)
            os.remove(os.path.join(folder, name))
            if name == "samples.dat" and text is None:
                os.remove(os.path.join(folder, "statistics.dat"))
            if text is not None:
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            done = self.run_(case)
            page = self.read(case, "report.html")
            for where in (done.stdout + done.stderr, page):
                self.assertIn(said, where)

    def testWarnsOfASearchOfAnotherObjective(self):
        case = self.copyOf(os.path.join(tutorial, "../../parameterSearch/frictionFromTilting"))
        self.runApplication("parameterSearch", case)
        self.checkWarnsOfNothing(case)
        self.edit(case, "system/parameterSearchDict", "objective/goal", "maximise")
        self.checkWarns(case, "parameterSearch are those of other input: system/parameterSearchDict has changed")

    def testWarnsOfAnIncrementalAnalysisOfAnotherCriterion(self):
        case = self.copyOf(os.path.join(tutorial, "../../incrementalDynamics/masonryPanels/wall"))
        shutil.copy(os.path.join(tutorial, "wall1/system/blockTextureDict"), os.path.join(case, "system"))
        dictionary = "system/incrementalDynamicsDict"
        self.edit(case, "system/controlDict", "endTime", "0.02")
        self.edit(case, dictionary, "intensity/tolerance", "0.3")
        self.runApplication("blockTexture", case)
        self.runApplication("incrementalDynamics", case)
        self.checkWarnsOfNothing(case)
        self.edit(case, dictionary, "criterion/displacement", "1e-3")
        self.checkWarns(case, "incrementalDynamics are those of other input: system/incrementalDynamicsDict has changed")

    def testOfASettlementAlphaIsAReaction(self):
        case = self.caseOf("../settlement/vertical")
        self.runApplication("limitAnalysis", case, "-report")
        page = self.read(case, "report.html")
        self.assertIn("alpha is the least reaction [N]", page)
        self.assertNotIn("is the largest that the structure carries", page)

    def testOfAMovingLoadTheWorstPlaceCounts(self):
        case = self.caseOf("../movingLoad/axles")
        said = self.runApplication("limitAnalysis", case, "-report").stdout
        collapse = re.search(r"at collapse [\d.]+ kN", said)[0]
        page = self.read(case, "report.html")
        self.assertIn(collapse, page)
        for sentence in ("Moving load: 109 places, at 12 of them no load makes the structure collapse.",
                         re.search(r"(?m)^Worst place: .*", said)[0] + "."):
            self.assertIn(sentence, page)
        # A place without an answer, as by Coulomb's law, made the first place the worst.
        table = "postProcessing/limitAnalysis/0/movingLoad.dat"
        with open(os.path.join(case, table), "r+", encoding="utf-8") as file:
            text = file.read().replace(" inf 2", " nan 4", 1)
            file.seek(0)
            file.truncate()
            file.write(text)
        self.run_(case)
        self.assertIn(collapse, self.read(case, "report.html"))

    @unittest.skipUnless(hasViewer, noViewer)
    def testTheViewerOfAHouseInSpace(self):
        case = self.caseOf("../space/house/structure")
        self.runApplication("limitAnalysis", case, "-report")
        self.checkViewer(case, "part of the mechanism", "0.000.", "1.000.")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
