#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Broken inputs: the message to the user, and that the case is unchanged.

brokenInputs.py --list                      prints `application name` of each
brokenInputs.py BIN SCRATCH NAME            tries one; exit status 1 when the application does not behave as required

Each broken input is a good case with one fault. The application has to end with exit status 1 within seconds, to report
on standard error the fault, its location (file and line) and its remedy, in the form

    --> DRYSTONE FATAL IO ERROR:
    <the fault, and its remedy>

    file: <file>/<entry> at line <line>.

    DRYSTONE exiting

and to leave the case as it was, to the last byte.
"""
import dataclasses
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys

texture = """dimensions 2;
texture
{
    type        runningBond;
    unit        (0.4 0.175);
    thickness   1;
    length      5;
    courses     6;
    firstCourse half;
    openings    ( { from (1.5 2); to (2.5 4); } );
}
supports { ground { type ground; segment 0.5; } }
"""

# Two walls that meet at the beginning of both, and an opening of the first.
inCorner = """dimensions 3; texture {{ type walls; unit (0.4 0.2 0.2); courses 6; walls {{ a {{ from (0 0); length 4; }}
b {{ from (0 0); direction (0 1); length 2; thickness right; }} }} openings ( {{ wall a; {} }} ); }}
"""

polygons = """dimensions 2;
texture
{
    type        polygons;
    thickness   1;
    blocks
    (
        ((0 0) (1 0) (1 1) (0 1))
        ((0 1) (1 1) (1 2) (0 2))
    );
}
supports { ground { type ground; } }
"""

goodCase = {
    "system/blockTextureDict": texture,
    "system/controlDict": "application limitAnalysis;\nstartFrom latestTime;\nendTime 0.1;\ndeltaT 0.01;\n"
                          "writeControl timeStep;\nwriteInterval 5;\n",
    "system/solution": "limitAnalysis\n{\n    solver interiorPoint;\n    tolerance 1e-9;\n}\n",
    "constant/g": "value (0 -9.81 0);\n",
    "constant/materialProperties": "unitWeight 1000;\n",
    "constant/contactProperties": "friction\n{\n    type Coulomb;\n    mu 0.65;\n    flowRule associative;\n}\n",
    "constant/loads": "dead { type gravity; }\nlive\n{\n    type inertial;\n    direction (1 0 0);\n}\n",
}

MARK = "@@"  # stands in a replacement where the message has to point, and is not written


@dataclasses.dataclass
class Broken:
    """A fault and the required message."""
    application: str
    name: str
    file: str = ""      # the faulty one; where the message has to point
    old: str = ""       # text of it that is replaced ...
    new: str = ""       # ... by this
    content: object = None  # or its whole content: text, bytes, None to leave it; REMOVE removes it
    says: tuple = ()    # regular expressions which the message has to hold, in any order
    lines: tuple = ()   # lines that are right; by default that of MARK, or else where `new` begins
    where: str = ""     # the file which the message names, if another than `file`; "-": none
    files: dict = dataclasses.field(default_factory=dict)  # more files of the case, REMOVE removes one
    before: tuple = ()  # commands which prepare the case
    earlier: dict = dataclasses.field(default_factory=dict)  # files of the case in place before these commands
    arguments: tuple = ()
    stdoutTo: str = ""  # where standard output goes, instead of being kept
    stdout: str = ""    # for checkBlocks: what it prints instead of a message on standard error


REMOVE = object()
dictionary = "system/blockTextureDict"
built = (("blockTexture",),)
boxInSpace = {
    dictionary: "dimensions 3;\ntexture { type boxes; blocks ( ((0 0 0) (1 1 1)) ); }\nsupports { ground { type ground; } }\n",
    "constant/g": "value (0 0 -9.81);\n",
}


def inTexture(name, old, new, *says, **more):
    return Broken("blockTexture", name, dictionary, old, new, says=says, **more)


def inPolygons(name, old, new, *says, **more):
    return Broken("blockTexture", name, dictionary, old, new, says=says, files={dictionary: polygons}, **more)


def inAnalysis(name, file, old, new, *says, **more):
    return Broken("limitAnalysis", name, file, old, new, says=says, before=built, **more)


growing = """intensity
{
    type    bisection;
    unit    g;
    low     0.3;
    high    0.4;
    tolerance 0.01;
}
criterion
{
    type    motion;
    displacement 1e-6;
}
"""


def inStudy(name, old, new, *says, file="system/incrementalDynamicsDict", **more):
    return Broken("incrementalDynamics", name, file, old, new, says=says, before=built,
                  files={"system/incrementalDynamicsDict": growing,
                         "constant/groundMotion": "direction (1 0 0);\nacceleration { type constant; value 1; }\n"}
                  | more.pop("files", {}), **more)


searching = """applications (blockTexture limitAnalysis);
variables
{
    mu
    {
        file "constant/contactProperties";
        entry "friction/mu";
        bounds (0.3 1);
    }
}
results
{
    alpha
    {
        table "postProcessing/limitAnalysis/0/limitAnalysis.dat";
        column alpha;
    }
}
objective { goal minimise; value alpha; }
constraints { strong { value mu; atLeast 0.4; } }
search
(
    { algorithm DIRECT_L; maximumEvaluations 5; }
    { algorithm COBYLA; tolerance 1e-3; }
);
"""


def inSearch(name, old, new, *says, **more):
    return Broken("parameterSearch", name, "system/parameterSearchDict", old, new, says=says,
                  files={"system/parameterSearchDict": searching} | more.pop("files", {}), **more)


sampling = """applications (blockTexture limitAnalysis);
variables
{
    mu
    {
        file "constant/contactProperties";
        entry "friction/mu";
        distribution
        {
            type lognormal;
            median 0.65;
            beta 0.15;
        }
    }
    density
    {
        file "constant/materialProperties";
        entry unitWeight;
        distribution { type uniform; minimum 900; maximum 1100; }
    }
}
correlations ((mu density 0.2));
design { type latinHypercube; samples 4; }
results
{
    alpha
    {
        table "postProcessing/limitAnalysis/0/limitAnalysis.dat";
        column alpha;
    }
}
statistics
{
    capacity { type distribution; value alpha; }
}
"""


def inEnsemble(name, old, new, *says, **more):
    return Broken("ensemble", name, "system/ensembleDict", old, new, says=says,
                  files={"system/ensembleDict": sampling} | more.pop("files", {}), **more)


measuring = """quantities
{
    alpha { type multiplier; reference { type finest; } }
    slide
    {
        type displacement;
        block 0;
        reference { type finest; deltaT 0.005; }
    }
}
sweeps
{
    tolerances { quantity alpha; tolerance (1e-4 1e-8); }
    steps
    {
        quantity slide;
        deltaT (0.02 0.01);
        theta (0.5 1);
    }
}
"""


def inAccuracy(name, old, new, *says, file="system/accuracyCostDict", **more):
    return Broken("accuracyCost", name, file, old, new, says=says, before=built,
                  files={"system/accuracyCostDict": measuring} | more.pop("files", {}), **more)


springs = """friction { type Coulomb; mu 0.65; flowRule associative; }
elasticity
{
    normal 1e8;
    tangential 1e8;
}
damping { massProportional 1; }
"""


def inMotionEffect(name, old, new, *says, **more):
    return Broken("contactDynamics", name, "constant/contactProperties", old, new, says=says, before=built,
                  files={"constant/contactProperties": springs} | more.pop("files", {}), **more)


def inSchemes(name, content, *says, lines=(1,)):
    return Broken("contactDynamics", name, "system/schemes", says=says, before=built, lines=lines,
                  files={"system/schemes": content})


def inSupportMotion(name, content, *says, **more):
    return Broken("contactDynamics", name, "constant/supportMotion", says=says, before=built,
                  files={"constant/supportMotion": content}, **more)


brokenInputs = [
    # The text of a dictionary.
    inTexture("missingSemicolon", "courses     6;", "courses     6", r"`?;`?", lines=(8, 9)),
    inTexture("missingBrace", "}\nsupports", "\nsupports", r"\}", lines=(3, 12, 13)),
    inTexture("strayBrace", "supports", "}\nsupports", r"\}", lines=(12,)),
    inTexture("missingParenthesis", "(0.4 0.175);", "(0.4 0.175;", r"\)", lines=(5,)),
    inTexture("openString", "half;", '"half;', r"(?i)quot|string", lines=(9,)),
    inTexture("openComment", "courses", "/* courses", r"(?i)comment", lines=(8,)),
    inTexture("binaryFile", "", "", r"(?i)binary|text|character", content=bytes(range(256)) * 20, lines=(0, 1, 2)),
    inTexture("archive", "", "", r"(?i)binary|text|character", content=b"\x1f\x8b\x08\x00" + bytes(200), lines=(0, 1)),
    inTexture("emptyFile", "", "", r"texture|dimensions", content="", lines=(0, 1)),
    inTexture("deepNesting", "dimensions 2;", "a " + "{ a " * 5000, r"(?i)nest|deep|level", lines=(1,)),
    inTexture("includeLoop", "dimensions 2;", '#include "other"', r"(?i)loop|itself|includes",
              files={"system/other": '#include "blockTextureDict"\n'}, where="system/", lines=(1,)),
    inTexture("missingInclude", "dimensions 2;", '#include "nowhere"', r"nowhere"),
    inTexture("unknownMacro", "courses     6;", "courses     $storeys;", r"storeys"),
    inTexture("divisionByZero", "courses     6;", 'courses     #calc "6/0";', r"6/0|zero|finite"),
    inTexture("shellCode", "courses     6;", 'courses     #calc "system(\\"true\\")";', r"system"),
    inTexture("missingFile", "", "", r"blockTextureDict", content=REMOVE, lines=(0,)),
    inTexture("directoryForAFile", "", "", r"(?i)directory|cannot be read", content=REMOVE, lines=(0,),
              files={dictionary: REMOVE, dictionary + "/keep": ""}),
    # Its entries.
    inTexture("unknownType", "runningBond", "runingBond", r"Unknown texture type runingBond\. Did you mean runningBond\?",
              r"Valid texture types: arch courses image import polygons rubble runningBond"),
    inTexture("missingType", "    type        runningBond;\n", "", r"type", lines=(2, 3)),
    inTexture("unknownKey", "length      5;", "lenght      5;", r"lenght", r"Did you mean length\?"),
    inTexture("severalFaults", "length      5;", "lenght      5;\n    colour red;", r"Did you mean length\?",
              lines=(8,)),  # of the last one
    Broken("contactDynamics", "missingRecord", "constant/groundMotion", before=built, lines=(5,),
           files={"constant/groundMotion": "direction (1 0 0);\nacceleration\n{\n    type record;\n"
                                           '    file "constant/nowhere.AT2";\n}\n'},
           says=(r"nowhere\.AT2",)),
    Broken("contactDynamics", "timeStepAndTimes", "constant/record.csv", before=built, lines=(1,),
           files={"constant/groundMotion": "direction (1 0 0);\nacceleration\n{\n    type record;\n    format csv;\n"
                                           '    file "constant/record.csv";\n    timeStep 0.1;\n}\n',
                  "constant/record.csv": "time,acceleration\n0,0\n0.1,1\n0.2,-1\n"},
           says=(r"column 'time' has the times", r"Remove `timeStep`")),
    Broken("contactDynamics", "tableAndFile", "constant/groundMotion", before=built, lines=(5,),
           files={"constant/groundMotion": "direction (1 0 0);\nacceleration\n{\n    type table;\n"
                                           '    values ((0 0) (1 1));\n    file "constant/table";\n}\n'},
           says=(r"Both values and file are given",)),
    Broken("contactDynamics", "smoothJump", "constant/groundMotion", before=built, lines=(5,),
           files={"constant/groundMotion": "direction (1 0 0);\nacceleration\n{\n    type table;\n"
                                           '    values ((0 0) (1 0) (1 1));\n    interpolation cubic;\n}\n'},
           says=(r"jumps at 1 s", r"interpolation linear;")),
    inTexture("unknownKeyOutside", "supports", "suports", r"suports", r"Did you mean supports\?"),
    inTexture("missingKey", "    unit        (0.4 0.175);\n", "", r"unit", lines=(2, 3)),
    inTexture("wordForANumber", "6;", "six;", r"six", r"courses"),
    inTexture("numberForAVector", "(0.4 0.175)", "0.4", r"unit"),
    inTexture("threeComponents", "(0.4 0.175)", "(0.4 0.175 0.2)", r"unit|component|plane"),
    inTexture("fractionOfACourse", "6;", "6.5;", r"6\.5"),
    inTexture("wrongDimension", "thickness   1;", "thickness   [0 0 1 0 0 0 0] 1;", r"dimension|\[0 0 1 0 0 0 0\]"),
    inTexture("hugeSize", "(0.4 0.175)", "(1e300 1e300)", r"block 0 has corners 0 and 1 in the same place", r"metres",
              lines=(2,)),
    inTexture("tinySize", "(0.4 0.175)", "(1e-300 1e-300)", r"block 0 has corners", r"too small", lines=(2,)),
    inTexture("negativeSize", "(0.4 0.175)", "(-0.4 0.175)", r"-0\.4", r"unit"),
    inTexture("archOfNothing", "", "", r"has no shape", r"at least 1e-06 m", lines=(1,),
              content="dimensions 2; texture { type arch; radius 1; thickness 1e-300; voussoirs 27; }\n"),
    inTexture("archOfSheets", "", "", r"are 3\.1e-07 m thin", r"give at most 31415", lines=(1,),
              content="dimensions 2; texture { type arch; radius 1; thickness 0.1; voussoirs 10000000; }\n"),
    inTexture("vaultOfTooManyBlocks", "", "", r"more than 10000000 blocks: make it smaller", lines=(1,),
              content="dimensions 3; texture { type barrelVault; radius 1e6; thickness 1; voussoirs 10000000; length 1; "
                      "slices 10000000; }\n"),
    inTexture("zeroThickness", "thickness   1;", "thickness   0;", r"thickness"),
    inTexture("notANumber", "(0.4 0.175)", "(nan 0.175)", r"nan"),
    inTexture("infiniteLength", "length      5;", "length      inf;", r"inf"),
    inTexture("numberTooLarge", "length      5;", "length      1e999;", r"1e999"),
    inTexture("tooManyBlocks", "courses     6;", "courses     2000000000;", r"(?i)courses|blocks"),
    inTexture("openingOutside", "(2.5 4)", "(9.5 4)", r"(?i)opening"),
    inTexture("openingInsideOut", "from (1.5 2); to (2.5 4);", "from (2.5 4); to (1.5 2);", r"(?i)opening|from|to"),
    inTexture("negativeOpening", "from (1.5 2)", "from (-1.5 2)", r"-1\.5|from"),
    inTexture("cutLintel", "( { from (1.5 2); to (2.5 4); } )",
              "( { from (1.5 2); to (2.5 4); lintel 0.5; } { from (1.8 4); to (2.2 5); } )",
              r"Opening 0 .* lintel from 1 to 3 units in course 4", r"Move one of the openings"),
    inTexture("lintelsThatOverlap", "( { from (1.5 2); to (2.5 4); } )",
              "( { from (1.5 2); to (2.5 4); lintel 0.5; } { from (3 2); to (4 4); lintel 0.5; } )",
              r"they overlap", r"Shorten the bearings"),
    inTexture("lintelAtTheCorner", "", "", r"wall b runs through from 0 to 0\.5", r"a course higher or lower", lines=(2,),
              content=inCorner.format("from (0.6 0); to (2 3); lintel 0.5;")),
    inTexture("openingWithinAJunction", "", "", r"junction with wall b", r"End the opening before the junction",
              lines=(2,), content=inCorner.format("from (0.2 0); to (2 3);")),
    inTexture("fourDimensions", "dimensions 2;", "dimensions 4;", r"dimensions is 4"),
    inTexture("spaceTextureInThePlane", "runningBond;", "polyhedra;", r"polyhedra is one of space", r"dimensions 3;"),
    inTexture("planeTextureInSpace", "dimensions 2;", "dimensions 3;", r"Unknown texture type runningBond", r"extrusion",
              lines=(4, 12)),
    inTexture("negativeSegment", "segment 0.5", "segment -0.5", r"segment"),
    inTexture("unknownSupport", "type ground;", "type grund;", r"grund", r"Did you mean ground\?"),
    inPolygons("emptyTexture", "((0 0) (1 0) (1 1) (0 1))\n        ((0 1) (1 1) (1 2) (0 2))", "", r"(?i)block",
               lines=(2, 6, 7)),
    inPolygons("twoCorners", "((0 1) (1 1) (1 2) (0 2))", "((0 1) (1 1))", r"(?i)corner|vert|point", lines=(6, 9)),
    inPolygons("crossingOutline", "((0 1) (1 1) (1 2) (0 2))", "((0 1) (1 1) (0 2) (1 2))", r"(?i)cross|itself|simple",
               lines=(6, 9)),
    inPolygons("flatPolygon", "((0 1) (1 1) (1 2) (0 2))", "((0 1) (1 1) (2 1))", r"(?i)area|line|corner|flat",
               lines=(6, 9)),
    inPolygons("supportOfNoBlock", "type ground;", "type blocks; blocks (0 12);", r"12"),
    # The output: a file in place of a folder, which stops root too.
    inTexture("unwritableDirectory", "", "", r"(?i)constant.*(directory|written|write)", content=None, lines=(0,),
              files={f: REMOVE for f in goodCase if f.startswith("constant")} | {"constant": "in the way\n"}, where="-"),
    # The command line.
    Broken("blockTexture", "noSuchCase", arguments=("-case", "nowhere"), says=(r"nowhere", r"-case"), where="-"),
    Broken("blockTexture", "unknownOption", arguments=("-alchecks",), says=(r"Unknown option -alchecks", r"Valid options"),
           where="-"),
    Broken("blockTexture", "parallel", arguments=("-parallel",), says=(r"no parallel mode",), where="-"),
    Broken("blockTexture", "strayArgument", arguments=("wall",), says=(r"wall",), where="-"),
    Broken("caseDictionary", "twoEdits", arguments=("system/controlDict", "-entry", "endTime", "-set", "2", "-remove"),
           says=(r"-set", r"-remove"), where="-"),
    Broken("caseDictionary", "noSuchEntry", arguments=("system/controlDict", "-entry", "endTimes"), says=(r"endTime\b",),
           where="system/controlDict", lines=(1,)),
    Broken("caseDictionary", "valueWithComment",
           arguments=("system/controlDict", "-entry", "endTime", "-set", "2 // s"), says=(r"ends in a comment",),
           where="the value given", lines=(1,)),
    Broken("caseDictionary", "fullDisk", arguments=("system/controlDict",), says=(r"(?i)standard output", r"room"),
           where="-", stdoutTo="/dev/full"),
    Broken("limitAnalysis", "noCase", files={f: REMOVE for f in goodCase}, says=(r"not a case directory",), where="-"),
    # The blocks.
    Broken("checkBlocks", "overlappingPolygons", before=built, stdout=r"Failed \d+ checks\.",
           files={dictionary: polygons.replace("((0 1) (1 1) (1 2) (0 2))", "((0 0.5) (1 0.5) (1 2) (0 2))")}),
    Broken("checkBlocks", "floatingBlock", before=built, stdout=r"Failed \d+ checks\.",
           files={dictionary: polygons.replace("((0 1) (1 1) (1 2) (0 2))", "((0 3) (1 3) (1 4) (0 4))")}),
    *[Broken(application, "facesThatAlmostMeet", where="constant/assembly/blocks", lines=(0,),
             says=(r"block 0 and block 1 almost meet", r"1e-05 m apart", r"jointTolerance 2e-05;"),
             before=(("blockTexture",),),
             earlier={dictionary: polygons.replace("((0 1) (1 1) (1 2) (0 2))",
                                                   "((0 1.00001) (1 1.00001) (1 2) (0 2))")})
      for application in ("limitAnalysis", "contactDynamics")],
    Broken("limitAnalysis", "jointToleranceOfBlockSize", where="constant/assembly/blocks", lines=(0,),
           says=(r"jointTolerance 1 ", r"at most 0.1 m"), before=(("blockTexture",),),
           earlier={dictionary: "jointTolerance 1;\n" + polygons}),
    Broken("limitAnalysis", "selectionMistyped", "system/schemes", says=(r"automatik", r"Did you mean automatic\?"),
           before=built, lines=(1,), files={"system/schemes": "effects { selection automatik; }\n"}),
    Broken("limitAnalysis", "verifiedAsGiven", "system/schemes", says=(r"verifyInterval needs `selection automatic;`",),
           before=built, lines=(1,), files={"system/schemes": "effects { selection asGiven; verifyInterval 5; }\n"}),
    Broken("checkBlocks", "noAssembly", says=(r"constant/assembly", r"blockTexture"), where="-"),
    Broken("limitAnalysis", "noAssembly", says=(r"constant/assembly", r"blockTexture"), where="-"),
    # The input of an analysis.
    inAnalysis("negativeFriction", "constant/contactProperties", "0.65", "-0.65", r"mu"),
    inAnalysis("frictionInPascal", "constant/contactProperties", "mu 0.65", "mu [1 -1 -2 0 0 0 0] 0.65",
               r"dimension|\[1 -1 -2 0 0 0 0\]"),
    inAnalysis("unknownFrictionLaw", "constant/contactProperties", "Coulomb", "Coulom", r"Did you mean Coulomb\?"),
    inAnalysis("unknownEffect", "constant/contactProperties", "friction\n", "frictoin\n", r"Did you mean friction\?"),
    inAnalysis("missingMu", "constant/contactProperties", "    mu 0.65;\n", "", r"mu", lines=(1, 2)),
    inAnalysis("noMaterial", "constant/materialProperties", "", "", r"materialProperties", content=REMOVE, lines=(0,)),
    inAnalysis("negativeWeight", "constant/materialProperties", "1000", "-1000", r"unitWeight"),
    inAnalysis("weightInKilograms", "constant/materialProperties", "unitWeight 1000", "unitWeight [1 -3 0 0 0 0 0] 1000",
               r"dimension|\[1 -3 0 0 0 0 0\]"),
    inAnalysis("noLoads", "constant/loads", "", "", r"loads", content=REMOVE, lines=(0,)),
    inAnalysis("unknownLoad", "constant/loads", "inertial", "inertia", r"Did you mean inertial\?"),
    inAnalysis("misspelledLive", "constant/loads", "live\n", "lives\n", r"Did you mean live\?"),
    inAnalysis("loadOfNothing", "constant/loads", "live\n", "wind { type gravity; }@@\nlive\n", r"Unknown key wind"),
    inAnalysis("partOfALoad", "constant/loads", "type inertial;\n", "type inertial;\n    part { type gravity; }@@\n",
               r"Unknown key part"),
    inAnalysis("noDirection", "constant/loads", "(1 0 0)", "(0 0 0)", r"direction"),
    inAnalysis("noForce", "constant/loads", "type inertial;\n    direction (1 0 0);",
               "type force;\n    at (0.5 1.02);\n    value (0 0 0);@@", r"value", lines=(6,)),
    inAnalysis("noGravity", "constant/g", "-9.81", "0", r"(?i)zero", r"gravity", where="constant/loads", lines=(2,),
               files={"constant/materialProperties": "density 2000;\n"}),
    inAnalysis("noDeadLoad", "constant/loads", "dead { type gravity; }\n", "", r"dead", r"gravity", lines=(1,)),
    Broken("limitAnalysis", "everyBlockFixed", where="constant/assembly/blocks", lines=(0,), says=(r"(?i)fixed",),
           before=(("caseDictionary", "system/blockTextureDict", "-entry", "supports/ground", "-set",
                    "{ type blocks; blocks (0 1); }"), ("blockTexture",)),
           earlier={dictionary: polygons}),
    inAnalysis("forceBesideTheWall", "constant/loads", "type inertial;\n    direction (1 0 0);",
               "type force;\n    at (50 50);@@\n    value (0 -1 0);", r"(?i)block", lines=(4, 5)),
    inAnalysis("forceOfNothing", "constant/loads", "type inertial;\n    direction (1 0 0);",
               "type force; at (1 0.5); value (0 1e-300 0);@@", r"A force of 1e-300 N cannot be computed with"),
    inAnalysis("forceOnAJoint", "constant/loads", "type inertial;\n    direction (1 0 0);",
               "type force;\n    at (0.6 0.0875);@@\n    value (0 -1 0);", r"on the joint of blocks \d+ and \d+", r"block \d+;",
               lines=(5,)),
    inAnalysis("pressureOnNoFace", "constant/loads", "type inertial;\n    direction (1 0 0);",
               "type pressure;@@\n    value 600;\n    normal (-1 0 0);\n    box ((50 0) (60 1));",
               r"No face of a free block is loaded", lines=(4,)),
    inAnalysis("pressureWithoutNormal", "constant/loads", "type inertial;\n    direction (1 0 0);",
               "type pressure;\n    value 600;\n    normal (0 0 0);@@", r"normal of a face cannot be"),
    inAnalysis("boxWithOneCorner", "constant/loads", "type inertial;\n    direction (1 0 0);",
               "type pressure;\n    value 600;\n    normal (-1 0 0);\n    box ((0 0));@@", r"A box has two corners"),
    inAnalysis("pressureOnNoBlock", "constant/loads", "type inertial;\n    direction (1 0 0);",
               "type pressure;\n    value 600;\n    normal (-1 0 0);\n    blocks (999);@@", r"There is no block 999"),
    inAnalysis("pressureOnNoZone", "constant/loads", "type inertial;\n    direction (1 0 0);",
               "type pressure;\n    value 600;\n    normal (-1 0 0);\n    zones (facade);@@", r"(?i)zone", r"facade"),
    inAnalysis("backfillWithoutLevel", "constant/loads", "type inertial;\n    direction (1 0 0);",
               "type backfill;\n    unitWeight 18000;@@", r"height of its surface", r"level 1.5;"),
    inAnalysis("backfillOfNothing", "constant/loads", "type inertial;\n    direction (1 0 0);", "type backfill;@@", r"a weight or a surcharge", lines=(2, 3, 4)),
    inAnalysis("combinedWithoutCases", "constant/loads", "type inertial;\n    direction (1 0 0);", "type combined;\n    terms ((1.35 wind));@@",
               r"refers to `cases`", r"and there are none"),
    inAnalysis("combinedOfUnknownCase", "constant/loads",
               "dead { type gravity; }\nlive\n{\n    type inertial;\n    direction (1 0 0);",
               "cases { weight { type gravity; } }\ndead { type gravity; }\nlive\n{\n    type combined;\n"
               "    terms ((1 weigth));@@", r"Did you mean weight\?"),
    inAnalysis("movingBesideTheWall", "constant/loads", "type inertial;\n    direction (1 0 0);",
               "type moving;\n    from (50 9);@@\n    to (60 9);\n    value (0 -1 0);", r"meets no free block"),
    inAnalysis("movingNowhere", "constant/loads", "type inertial;\n    direction (1 0 0);",
               "type moving;\n    from (0 9);\n    to (0 9);@@\n    value (0 -1 0);", r"two different ends"),
    inAnalysis("movingBothWays", "constant/loads",
               "live\n{\n    type inertial;\n    direction (1 0 0);",
               "multiplier both;\nlive\n{\n    type moving;@@\n    from (0 9);\n    to (1 9);\n    value (0 -1 0);",
               r"positive multiplier of each place"),
    inAnalysis("movingDeadLoad", "constant/loads", "type gravity;",
               "type moving; from (0 9); to (1 9); value (0 -1 0);@@", r"can only be the live load", lines=(1,)),
    Broken("blockTexture", "supportOfTheName", dictionary, says=(r"makes a support left by itself", r"another name"),
           content="dimensions 2;\ntexture { type arch; radius 5; thickness 0.6; voussoirs 12; }\n"
                   "supports { left { type blocks; blocks (0); } }\n", lines=(3,)),
    inTexture("zoneOfNoBlock", "supports { ground { type ground; segment 0.5; } }",
              "supports { ground { type ground; segment 0.5; } }\nzones { base { type blocks; blocks (999); } }@@",
              r"There is no block 999"),
    inTexture("emptyZone", "supports { ground { type ground; segment 0.5; } }",
              "supports { ground { type ground; segment 0.5; } }\nzones { base { type box; box ((50 0) (60 1)); } }@@",
              r"There is no block in the zone base"),
    inAnalysis("jointOfNoZone", "constant/contactProperties", "mu 0.65;\n    flowRule associative;\n}",
               "mu 0.65;\n    flowRule associative;\n}\njoints { base-shaft { friction { mu 0.2; } } }@@",
               r"There is no joint base-shaft", r"by the zones of both"),
    Broken("contactDynamics", "startInTheGround", "0/motion", before=built, lines=(1,), where="0/motion",
           says=(r"0.1 m deep in block \d+ \(support ground\)",),
           files={"0/motion": "0 { displacement (0 -0.1); }\n"}),
    Broken("contactDynamics", "velocityOfNoBlock", "0/motion", before=built, lines=(1,), where="0/motion",
           says=(r"moves by inf m", r"Give a velocity that a block can have"),
           files={"0/motion": "0 { velocity (1e200 0); }\n"}),
    inAnalysis("unknownSolver", "system/solution", "interiorPoint", "interiorpoint", r"interiorPoint"),
    inAnalysis("solverOfMotion", "system/solution", "interiorPoint", "gaussSeidel", r"steps in time only"),
    inAnalysis("negativeTolerance", "system/solution", "1e-9", "-1e-9", r"tolerance"),
    inAnalysis("unknownApplication", "system/solution", "limitAnalysis", "limitAnalisys",
               r"Did you mean limitAnalysis\?"),
    inAnalysis("solutionIsNoDictionary", "system/solution", "", "", r"sub-dictionary",
               content="limitAnalysis interiorPoint;\n", lines=(1,)),
    inAnalysis("gravityUpIsNoVector", "constant/g", "(0 -9.81 0)", "9.81", r"value"),
    inAnalysis("controlDictKey", "system/controlDict", "writeInterval", "writeIntervall", r"Did you mean writeInterval\?"),
    inAnalysis("functionWithoutType", "system/controlDict", "writeInterval 5;", "functions { e { enabled on; } }",
               r"Unknown function type e\.", r"has no entry type"),
    inAnalysis("functionThatEndsFirst", "system/controlDict", "writeInterval 5;",
               "functions { energy { timeStart 1; timeEnd 0.5; } }", r"ends before timeStart"),
    inAnalysis("unknownFunction", "system/controlDict", "writeInterval 5;", "functions { energi { } }",
               r"Did you mean energy\?"),
    inAnalysis("pictureFormat", "system/controlDict", "writeInterval 5;", "pictureFormats (svg jpg);", r"jpg", r"pdf png svg"),
    inAnalysis("noPictureFormat", "system/controlDict", "writeInterval 5;", "pictureFormats ();", r"at least one of svg, png"),
    inAnalysis("timesOfPictures", "system/controlDict", "writeInterval 5;",
               "functions { motionPictures { times (0.2 0.1); } }", r"must ascend"),
    inAnalysis("functionOfNoBlock", "system/controlDict", "writeInterval 5;",
               "functions { top { type blockMotion; blocks (999); } }", r"999"),
    Broken("limitAnalysis", "nothingToPostProcess", before=built, arguments=("-postProcess",), says=(r"no results",),
           where="-"),
    # An incremental analysis.
    inStudy("noDictionary", "", "", r"incrementalDynamicsDict", content=None, lines=(0,),
            files={"system/incrementalDynamicsDict": REMOVE}),
    inStudy("noCriterion", "criterion", "critreion", r"Did you mean criterion\?"),
    inStudy("unknownCriterion", "motion", "moton", r"Did you mean motion\?"),
    inStudy("unknownIntensity", "bisection", "bisect", r"Valid intensity types: bisection list step"),
    inStudy("unknownUnit", "unit    g", "unit    gal", r"gal", r"m/s2"),
    inStudy("emptyRange", "0.4;", "0.2;", r"range", lines=(7,)),
    inStudy("tooManyIntensities", "0.01", "1e-12", r"100000"),
    inStudy("criterionOfNoBlock", "type    motion;\n    displacement 1e-6;",
            "type    rotation;\n    block   999;@@\n    limit   1;", r"999"),
    inStudy("groundAtRest", "", "", r"constant/groundMotion", where="-",
            files={"constant/groundMotion": REMOVE}),
    inStudy("missingRecord", "criterion", 'records { north { file "constant/north.AT2"; } }\ncriterion', r"(?i)open the record",
            where="constant/north.AT2", lines=(0,)),
    inStudy("recordOutOfThePlane", "criterion", 'records { north { file "n.AT2"; direction (1 0 1); } }\ncriterion',
            r"direction must be 0", lines=(9,)),
    inStudy("recordOfZeros", "criterion", 'records { north { file "n.csv"; format csv; } }\ncriterion',
            r"north is zero throughout", r"complete copy", lines=(9,), files={"n.csv": "0,0\n0.01,0\n0.02,0\n"}),
    inStudy("scaledRecord", "criterion", 'records { north { file "n.AT2"; scale 2; } }\ncriterion', r"remove scale"),
    inStudy("noJobs", "criterion", "jobs 0;\ncriterion", r"jobs"),
    inStudy("endsOtherwise", "endTime 0.1;", "stopAt nextWrite;", r"stopAt endTime", file="system/controlDict"),
    Broken("incrementalDynamics", "postProcess", before=built, arguments=("-postProcess",), says=(r"-postProcess",),
           where="-"),
    # What accuracy costs.
    inAccuracy("noDictionary", "", "", r"accuracyCostDict", content=None, lines=(0,),
               files={"system/accuracyCostDict": REMOVE}),
    inAccuracy("unknownQuantityType", "multiplier", "multiplyer", r"Did you mean multiplier\?"),
    inAccuracy("unknownQuantity", "quantity alpha", "quantity alhpa", r"Did you mean alpha\?"),
    inAccuracy("unknownReference", "type finest; deltaT", "type fine; deltaT", r"Valid reference types: Housner finest value"),
    inAccuracy("noReference", "reference { type finest; deltaT 0.005; }", "", r"reference is missing", lines=(4,)),
    inAccuracy("valueWithoutSource", "type finest; deltaT 0.005;", "type value; value 0.01;", r"source"),
    inAccuracy("unknownKey", "theta (0.5", "tehta (0.5", r"Did you mean theta\?"),
    inAccuracy("explicitTheta", "(0.5 1)", "(0.2 1)", r"from 0.5 to 1"),
    inAccuracy("stepOfNothing", "(0.02 0.01)", "(0.02 0)", r"above 0"),
    inAccuracy("valueTwice", "(0.02 0.01)", "(0.02 0.02)", r"stands twice"),
    inAccuracy("unknownFlowRule", "theta (0.5 1)", "flowRule (associative coulomb)", r"coulomb", r"nonAssociative"),
    inAccuracy("unknownSolver", "theta (0.5 1)", "solver (interiorPoynt)", r"Did you mean interiorPoint\?"),
    inAccuracy("thetaOfAMultiplier", "tolerance (1e-4 1e-8);", "theta (0.5 1);", r"theta is for motions"),
    inAccuracy("pointsOfAMotion", "theta (0.5 1)", "pointsPerJoint (2 5)", r"pointsPerJoint is for multipliers"),
    inAccuracy("pointsOfSpace", "tolerance (1e-4 1e-8)", "pointsPerSide (2 5)", r"write pointsPerJoint"),
    inAccuracy("alongPointsOfAMotion", "theta (0.5 1)", "along pointsPerJoint", r"deltaT or tolerance"),
    inAccuracy("quantityOfNoBlock", "block 0", "block 999", r"There is no block 999"),
    inAccuracy("HousnerOfAWall", "type finest; deltaT 0.005;", "type Housner;", r"does not give this quantity"),
    inAccuracy("referenceOfLongSteps", "deltaT 0.005", "deltaT 0.04", r"goes to 0.01", r"deltaT of at most 0.01"),
    inAccuracy("referenceOfTheCase", "type finest; deltaT 0.005;", "type finest;", r"deltaT of at most 0.001",
               files={"system/accuracyCostDict": measuring.replace("0.02 0.01", "0.01 0.001")}),
    inAccuracy("referenceOfFewPoints", "type finest; }", "type finest; pointsPerJoint 3; }",
               r"pointsPerJoint of at least 5",
               files={"system/accuracyCostDict": measuring.replace("tolerance (1e-4 1e-8)", "pointsPerJoint (2 5)")}),
    inAccuracy("stepsLongerThanTheMotion", "(0.02 0.01)", "(0.2 0.01)", r"0.2 s is longer", r"later endTime"),
    inAccuracy("noPhases", "theta (0.5 1)", "phases 0", r"phases"),
    inAccuracy("nameOfNoFile", "steps", "s.teps", r"cannot be that of a file", lines=(11,)),
    inAccuracy("endsAtOnce", "endTime 0.1;", "endTime 0;", r"raise endTime", file="system/controlDict"),
    Broken("accuracyCost", "postProcess", before=built, arguments=("-postProcess",), says=(r"-postProcess",), where="-"),
    # Effects in motion.
    inMotionEffect("noStiffness", "normal 1e8;", "", r"normal", lines=(2,)),
    inMotionEffect("negativeStiffness", "1e8", "-1e8", r"normal", r"above 0"),
    inMotionEffect("unknownStiffness", "tangential", "tangental", r"Did you mean tangential\?"),
    inMotionEffect("negativeDamping", "massProportional 1", "massProportional -1", r"at least 0"),
    inMotionEffect("emptyBox", "damping { massProportional 1; }", "deletion { box ((1 0) (0 1)); }", r"lower left"),
    inMotionEffect("boxOfThePlane", "damping { massProportional 1; }", "deletion { box ((-9 -9) (9 9)); }",
                   r"2 numbers, but 3 are expected", earlier=boxInSpace),
    inMotionEffect("boxOfSmallDisplacements", "damping { massProportional 1; }",
                   "deletion { box ((-9 -9) (9 9)); }", r"remove deletion",
                   files={"system/schemes": "smallDisplacements yes;\n"}),
    inMotionEffect("twoDampings", "massProportional 1;",
                   "massProportional 1; equivalentToHousner { slenderness 0.2; radius 1; amplitude 0.1; }",
                   r"Remove one of them"),
    inMotionEffect("overturnedAtStart", "massProportional 1;",
                   "equivalentToHousner { slenderness 0.2; radius 1; amplitude 0.2; }", r"below slenderness"),
    inMotionEffect("reboundOfSprings", "damping", "restitution { normal 0.5; }@@\ndamping", r"remove restitution"),
    inMotionEffect("trapezoidalSprings", "elasticity", "elasticity", r"theta 1",
                   files={"system/schemes": "timeIntegration { type theta; theta 0.5; }\n"}),
    inSchemes("everthing", "effects { selection everthing; }\n", r"Did you mean everything\?"),
    inSchemes("everythingWithGaps", "smallDisplacements yes; effects { selection everything; }\n"
              "initialGaps { perturbation 1e-9; }\n", r"remove one of the two", lines=(2,)),
    inSchemes("verifiedEverything", "effects { selection everything; verifyInterval 5; }\n", r"verifyInterval needs"),
    inSchemes("marginOfAllEffects", "effects { margin 0.3; }\n", r"margin needs `selection automatic;`"),
    inMotionEffect("rigidSolver", "elasticity", "elasticity", r"solver automatic",
                   files={"system/solution": "contactDynamics { solver interiorPoint; }\n"}),
    inMotionEffect("gluedSprings", "damping { massProportional 1; }", "cohesion { strength 1e5; }",
                   r"either elastic or hold by cohesion"),
    inMotionEffect("rolling", "damping { massProportional 1; }", "rollingResistance { }", r"rollingResistance"),
    # Combinations of loads, and contact by surfaces.
    inAnalysis("twoKindsOfLoads", "constant/loads", "dead {", "combinations { a { dead { type gravity; } live { type "
               "inertial; direction (1 0 0); } } }\ndead@@ {", r"either dead and live, or combinations"),
    inAnalysis("combinationWithoutLive", "constant/loads", "", "", r"live", lines=(3,),
               files={"constant/loads": "combinations\n{\n    wind { dead { type gravity; } }\n}\n"}),
    inAnalysis("combinedPushover", "system/solution", "tolerance 1e-9;", "tolerance 1e-9;\n    pushover { step 0.01; }",
               r"Remove pushover", lines=(5,),
               files={"constant/loads": "combinations { a { dead { type gravity; } live { type inertial; direction "
                      "(1 0); } } }\n"}),
    Broken("contactDynamics", "combinationsInMotion", "constant/loads", says=(r"for limitAnalysis",), lines=(1,),
           before=built,
           files={"constant/loads": "combinations { a { dead { type gravity; } live { type inertial; direction "
                      "(1 0); } } }\n"}),
    inAnalysis("unknownFormulation", "constant/contactProperties", "friction", "contact { formulation surfaces; }@@\nfriction",
               r"Did you mean surface\?"),
    inAnalysis("crushedSurface", "constant/contactProperties", "friction",
               "crushing { strength 1e6; }\ncontact { formulation surface; }@@\nfriction", r"Remove", r"crushing"),
    inAnalysis("surfaceOfCoulomb", "constant/contactProperties", "friction",
               "contact { formulation surface; }\nfriction", r"associative flow rule only", lines=(1,),
               files={"constant/contactProperties": "friction\n{\n    type Coulomb;\n    mu 0.65;\n    flowRule "
                      "nonAssociative;\n}\n"}),
    inAnalysis("pointsOfTheProgram", "constant/contactProperties", "friction",
               "jointPoints { type adaptve@@; }\nfriction", r"Did you mean adaptive\?", earlier=boxInSpace),
    inAnalysis("adaptivePointsOfCoulomb", "constant/contactProperties", "", "", r"associative flow rule", lines=(1,),
               earlier=boxInSpace, files={"constant/contactProperties": "jointPoints { type adaptive; }\ncohesion { strength 1e4; }\n"
                                   "friction { type Coulomb; mu 0.6; flowRule nonAssociative; }\n"}),
    inAnalysis("adaptivePointsOfSettlement", "constant/contactProperties", "friction",
               "jointPoints { type adaptive; }@@\ncohesion { strength 1e4; }\nfriction", r"remove supportMovement",
               earlier=boxInSpace, files={"constant/loads": "dead { type gravity; }\nlive { type supportMovement; support ground; "
                                   "direction (0 0 -1); }\n"}),
    inMotionEffect("sweepsOfBondsInSpace", "", "", r"set `solver automatic;`", lines=(2,), earlier=boxInSpace,
                   files={"constant/contactProperties": "friction { type Coulomb; mu 0.6; }\ncohesion { strength 1e4; }\n",
                          "system/solution": "contactDynamics { solver gaussSeidel; }\n"}),
    Broken("blockTexture", "vaultWithinItself", dictionary, says=(r"block 12 is no solid", r"beside each other"), lines=(2,),
           files={dictionary: "dimensions 3;\ntexture { type barrelVault; profile pointed; offset 2.908; radius 3.75; "
                              "thickness 0.88125; voussoirs 26; length 1.882; }\nsupports { ground { type ground; } }\n"}),
    # Supports that move.
    inSupportMotion("unknownSupport", "roof { direction (1 0); velocity ((0 0) (1 1)); }\n", r"no support roof",
                    r"ground", lines=(1,)),
    inSupportMotion("noMotion", "ground\n{\n    direction (1 0);\n}\n", r"either displacement or velocity", lines=(1,)),
    inSupportMotion("motionTwice", "ground\n{\n    direction (1 0);\n    displacement ((0 0) (1 1));\n"
                    "    velocity ((0 0) (1 1));\n}\n", r"either displacement or velocity", lines=(4,)),
    inSupportMotion("jumpingSupport", "ground\n{\n    direction (1 0);\n    displacement ((0 0) (0 1));\n}\n",
                    r"must increase", lines=(4,)),
    inSupportMotion("supportThatBeginsElsewhere", "ground\n{\n    direction (1 0);\n    displacement ((0 0.1) (1 0.3));\n}\n",
                    r"displacement begins with 0\.1 at 0 s", r"`displacement \(\(0 0\) \(1 0\.2\)", lines=(4,)),
    inSupportMotion("supportThatBeginsTurned", "ground\n{\n    rotation ((2 0.1) (3 0.3));\n}\n",
                    r"`rotation \(\(2 0\) \(3 0\.2\)", lines=(3,)),
    inSupportMotion("velocitiesBackwards", "ground\n{\n    direction (1 0);\n    velocity ((0 0) (1 1) (0.5 0));\n}\n",
                    r"must increase", lines=(4,)),
    inSupportMotion("noWhere", "ground\n{\n    direction (0 0);\n    velocity ((0 0) (1 1));\n}\n", r"no length",
                    lines=(3,)),
    inSupportMotion("turnedTwice", "ground\n{\n    rotation ((0 0) (1 1));\n    angularVelocity ((0 0) (1 1));\n}\n",
                    r"either rotation or angularVelocity", lines=(1,)),
    # A search.
    inEnsemble("noDictionary", "", "", r"ensembleDict", content=None, lines=(0,),
               files={"system/ensembleDict": REMOVE}),
    inEnsemble("unknownApplication", "limitAnalysis)", "limitAnalysys)", r"Did you mean limitAnalysis\?"),
    inEnsemble("unknownDistribution", "lognormal", "lognormall", r"Did you mean lognormal\?"),
    inEnsemble("missingMedian", "median 0.65;", "", r"median", lines=(8,)),
    inEnsemble("negativeBeta", "beta 0.15", "beta -0.15", r"above 0"),
    inEnsemble("unknownEntry", "friction/mu", "friction/mo", r"cannot be varied", r"mu"),
    inEnsemble("noFile", "constant/contactProperties", "constant/contactPropertis", r"There is no file"),
    inEnsemble("fileOutside", "constant/contactProperties", "../contactProperties", r"within the case"),
    inEnsemble("correlationOfNobody", "(mu density 0.2)", "(mu densty 0.2)", r"Did you mean density\?"),
    inEnsemble("impossibleCorrelation", "0.2)", "1.2)", r"cannot have the correlation"),
    inEnsemble("unknownDesign", "latinHypercube", "latinHypercub", r"Did you mean latinHypercube\?"),
    inEnsemble("noSamples", "samples 4", "samples 0", r"samples", r"1"),
    inEnsemble("unknownTable", "0/limitAnalysis.dat", "0/limit.dat", r"Unknown limitAnalysis table limit", r"limitAnalysis"),
    inEnsemble("unknownColumn", "column alpha", "column alfa", r"has no column alfa", r"alpha\[-\]"),
    inEnsemble("figureOfAMotion", "table \"postProcessing/limitAnalysis/0/limitAnalysis.dat\";", "type rotation;@@",
               r"figure of a motion|Unknown", lines=range(27, 34)),
    inEnsemble("unknownStatistic", "type distribution; value alpha", "type distributon; value alpha",
               r"Did you mean distribution\?"),
    inEnsemble("valueThatIsNone", "distribution { type uniform; minimum 900; maximum 1100; }",
               "distribution { type list; values (900 nan); }", r"values is wrong|`nan` is not a finite number"),
    inEnsemble("valueForAll", "value alpha", "value 2.5", r"depends on no variable"),
    inEnsemble("unknownName", "value alpha", "value \"alpha + beta\"", r"beta", r"results: mu density alpha"),
    inEnsemble("brokenArithmetic", "value alpha", "value \"alpha +\"", r"not arithmetic"),
    inEnsemble("noSensitivity", "type distribution;", "type sensitivity;", r"sensitivity yes"),
    inEnsemble("unknownKey", "samples 4;", "samples 4; sampels 5;@@", r"Did you mean samples\?"),
    inSearch("noDictionary", "", "", r"parameterSearchDict", content=None, lines=(0,),
             files={"system/parameterSearchDict": REMOVE}),
    inSearch("unknownApplication", "limitAnalysis)", "limitAnalysys)", r"Did you mean limitAnalysis\?"),
    inSearch("shellCommand", "limitAnalysis)", "\"rm -rf .\")", r"Valid"),
    inSearch("unknownAlgorithm", "COBYLA", "COBILA", r"Did you mean COBYLA\?"),
    inSearch("noConstraintsTaken", "COBYLA", "BOBYQA", r"BOBYQA takes no constraints", r"COBYLA", lines=(21,)),
    inSearch("unknownEntry", "friction/mu", "friction/mo", r"cannot be varied", r"mu"),
    inSearch("entryIsNoNumber", "friction/mu", "friction/type", r"cannot be varied", r"number"),
    inSearch("noFile", "constant/contactProperties", "constant/contactPropertis", r"There is no file"),
    inSearch("longFileName", "constant/contactProperties", "x" * 300, r"There is no file x+ in this case"),
    inSearch("fileOutside", "constant/contactProperties", "../contactProperties", r"within the case"),
    inSearch("emptyBounds", "(0.3 1)", "(1 0.3)", r"lower one first"),
    inSearch("endlessBounds", "(0.3 1)", "(-1e308 1e308)", r"too wide for numbers"),
    inSearch("entryTwice", "variables\n{", "variables\n{\n    nu { file \"./constant/contactProperties\"; entry \"friction/mu\"; "
             "bounds (0 1); }", r"Two variables set friction/mu of constant/contactProperties", lines=(2,)),
    inSearch("longFirstStep", "COBYLA", "BOBYQA", r"firstStep of mu can be 0\.5 at most", lines=(20,),
             files={"system/parameterSearchDict": searching.replace("(0.3 1);", "(0.3 1); firstStep 0.6;")
                    .replace("constraints { strong { value mu; atLeast 0.4; } }\n", "")}),
    inSearch("smallPopulation", "algorithm COBYLA;", "algorithm CRS2_LM; population 1;", r"population .*2 or more", lines=(20,),
             files={"system/parameterSearchDict": searching.replace("constraints { strong { value mu; atLeast 0.4; } }\n", "")}),
    inSearch("startOutside", "bounds (0.3 1);", "bounds (0.3 1); start 2;@@", r"outside the bounds"),
    inSearch("unknownName", "value alpha", "value \"alpha + beta\"", r"beta", r"Variables and results: mu alpha",
             lines=(19,)),
    inSearch("brokenArithmetic", "value alpha", "value \"alpha +\"", r"not arithmetic", lines=(19,)),
    inSearch("unknownGoal", "minimise", "minimize", r"Did you mean minimise\?"),
    inSearch("nameTwice", "    alpha\n", "    mu\n", r"have the name mu", lines=(10, 11, 12)),
    inSearch("nameOfAConstant", "    alpha\n", "    pi\n", r"has a meaning", lines=(10, 11, 12)),
    inSearch("constraintWithoutLimit", "atLeast 0.4;", "", r"atLeast", r"atMost", lines=(20,)),
    inSearch("limitsCrossed", "atLeast 0.4;", "atLeast 0.4; atMost 0.3;", r"nothing meets both", lines=(20,)),
    inSearch("bisectionOfTwo", "    mu\n    {", "    mu { file \"constant/g\"; entry x; bounds (0 1); }\n    nu\n    {",
             r"(?i)one variable|cannot be varied", lines=(0, 4, 5, 20, 21, 22, 23)),
    inSearch("constraintOnNothing", "value mu", "value 1", r"depends on no variable", r"results: mu alpha", lines=(20,)),
    inSearch("objectiveOfNothing", "value alpha", "value 0", r"depends on no variable", lines=(19,),
             files={"system/parameterSearchDict": searching.replace("constraints { strong { value mu; atLeast 0.4; } }", "")}),
    inSearch("toleranceOfNothing", "tolerance 1e-3;", "tolerance 0;", r"tolerance", r"above 0"),
    inSearch("toleranceOfAll", "tolerance 1e-3;", "tolerance 1e18;", r"tolerance", r"below 1"),
    inSearch("unknownKey", "column alpha;", "colum alpha;", r"Did you mean column\?"),
    inAnalysis("controlDictStep", "system/controlDict", "deltaT 0.01", "deltaT -0.01", r"deltaT"),
]


def write(case, files):
    for name, content in files.items():
        path = case / name
        if content is REMOVE:
            if path.exists():
                path.unlink()
            if path.parent.exists() and path.parent != case and not any(path.parent.iterdir()):
                path.parent.rmdir()
            continue
        if path.is_dir():
            shutil.rmtree(path)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())


def prepare(case, broken, binaries):
    """Makes the good case, runs the preceding applications, inserts the fault; returns the lines that may be named."""
    if case.exists():
        shutil.rmtree(case)
    case.mkdir(parents=True)
    write(case, goodCase | broken.earlier)
    if broken.application != "checkBlocks" and broken.name != "noAssembly":
        good = run(binaries, broken.before, case)
        write(case, broken.files)
    else:
        write(case, broken.files)
        good = run(binaries, () if broken.name == "noAssembly" else broken.before, case)
    if good:
        return None, good
    lines = broken.lines
    if broken.old:
        text = (case / broken.file).read_text()
        if broken.old not in text:
            return None, f"{broken.file} does not hold {broken.old!r}"
        start = text.index(broken.old)
        marked = text.replace(broken.old, broken.new, 1)
        place = marked.index(MARK) if MARK in marked else start
        lines = lines or (marked.count("\n", 0, place) + 1,)
        write(case, {broken.file: marked.replace(MARK, "")})
    elif broken.content is not None:
        if (case / broken.file).is_file():
            write(case, {broken.file: broken.content})
    return lines, ""


def run(binaries, commands, case):
    for command in commands:
        done = subprocess.run([str(binaries / command[0]), *command[1:]], cwd=case, capture_output=True, text=True,
                              timeout=60, stdin=subprocess.DEVNULL)
        if done.returncode != 0:
            return f"{command} in the good case ended with {done.returncode}:\n{done.stdout}{done.stderr}"
    return ""


def snapshot(case):
    return {str(path.relative_to(case)): hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else "folder"
            for path in sorted(case.rglob("*"))}


def judge(broken, lines, status, output, errors):
    """Everything in which the application did not behave as required."""
    faults = []
    if status != 1:
        faults.append(f"exit status {status}, not 1")
    if broken.stdout:
        if not re.search(broken.stdout, output):
            faults.append(f"standard output does not hold {broken.stdout}")
        return faults
    form = re.search(r"--> DRYSTONE FATAL (IO )?ERROR:\n(.*?)\n\n(file: (.*?)( at line (\d+))?\.\n\n)?DRYSTONE exiting\n",
                     errors, re.DOTALL)
    if not form:
        return faults + ["the message has not its form"]
    message, place, file, line = form.group(2), form.group(3), form.group(4), form.group(6)
    for expression in broken.says:
        if not re.search(expression, message, re.DOTALL):
            faults.append(f"the message does not hold {expression}")
    # A single sentence reports the fault, but not its remedy.
    if not re.search(r"[.?:;,]\s+\S", message):
        faults.append("the message does not say how to repair it")
    where = broken.where or broken.file
    if where != "-":
        if not place or where not in file:
            faults.append(f"the message does not point at {where}")
        elif 0 not in lines and (line is None or int(line) not in lines):
            faults.append(f"the message points at line {line}, not {' or '.join(map(str, lines))}")
    return faults


def attempt(broken, binaries, scratch):
    case = scratch / f"{broken.application}-{broken.name}"
    lines, fault = prepare(case, broken, binaries)
    if fault:
        return [fault]
    before = snapshot(case)
    try:
        with open(broken.stdoutTo or os.devnull, "wb") as sink:
            done = subprocess.run([str(binaries / broken.application), *broken.arguments], cwd=case, timeout=30,
                                  stdin=subprocess.DEVNULL, stdout=sink if broken.stdoutTo else subprocess.PIPE,
                                  stderr=subprocess.PIPE)
    except subprocess.TimeoutExpired:
        return ["it hangs: 30 s"]
    output, errors = (done.stdout or b"").decode(errors="replace"), done.stderr.decode(errors="replace")
    print(errors or output)
    faults = judge(broken, lines, done.returncode, output, errors)
    after = snapshot(case)
    if after != before:
        changed = sorted(name for name in before.keys() | after.keys() if before.get(name) != after.get(name))
        faults.append(f"left behind or changed: {' '.join(changed)}")
    if not faults:
        shutil.rmtree(case)
    return faults


def main():
    if sys.argv[1:] == ["--list"]:
        for broken in brokenInputs:
            print(broken.application, broken.name)
        return 0
    binaries, scratch, name = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]), sys.argv[3]
    os.environ.pop("DISPLAY", None)
    if name == "goodCase":
        # The case without its fault must be good: otherwise the fault is not what is reported.
        case = scratch / name
        _, fault = prepare(case, Broken("", name), binaries)
        applications = [(a,) for a in ("blockTexture", "checkBlocks", "limitAnalysis") if (binaries / a).exists()]
        fault = fault or run(binaries, applications, case)
        print(fault or f"the good case passes {applications}")
        return 1 if fault else 0
    wanted = [broken for broken in brokenInputs if f"{broken.application}.{broken.name}" == name]
    if len(wanted) != 1:
        print(f"there is no broken input {name}")
        return 1
    faults = attempt(wanted[0], binaries, scratch)
    for fault in faults:
        print("FAILED:", fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
