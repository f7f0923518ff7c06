#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Checks which library includes which: the arrows of CONTRIBUTING.md, and one user for each third-party library.

checkLayers.py [ROOT]        prints each forbidden #include as file:line, exit status 1 when there is one
checkLayers.py --self-test   plants violations in a scratch tree and demands that each is found
"""
import pathlib
import re
import sys
import tempfile

import checkTree

# What each library may include besides itself. Sorted from the bottom up; a library only sees those below it.
below = {
    "core": "",
    "dictionary": "core",
    "runControl": "core dictionary",
    "linear": "core",
    "timeSeries": "core dictionary",
    "conic": "core dictionary linear",
    "geometry": "core",
    "assembly": "core dictionary runControl geometry",
    "import": "core dictionary geometry assembly",
    "texture": "core dictionary geometry assembly import",
    "contact": "core dictionary runControl geometry assembly",
    "effects": "core dictionary runControl timeSeries geometry assembly conic contact",
    "io": "core dictionary runControl geometry assembly contact",
    "statics": "core dictionary runControl timeSeries geometry assembly conic contact effects",
    "dynamics": "core dictionary runControl timeSeries geometry assembly conic contact effects",
    "quantities": "core dictionary runControl timeSeries geometry assembly conic contact effects statics dynamics",
    "functionObjects": "core dictionary runControl timeSeries geometry assembly conic contact effects statics dynamics "
                       "quantities io",
    "report": "core dictionary runControl timeSeries geometry assembly texture conic contact effects statics dynamics io "
              "quantities functionObjects",
    "ensembles": "core dictionary runControl timeSeries geometry texture assembly conic contact effects statics dynamics "
                 "quantities io functionObjects",
}
allLibraries = set(below)

# Third-party headers by the pattern of their name. Each belongs to one library; Eigen and fmt may be used by all.
thirdParty = {
    "Eigen": r"(unsupported/)?Eigen/",
    "fmt": r"fmt/",
    "PEGTL": r"tao/pegtl",
    "muParser": r"muParser",
    "nlohmann-json": r"nlohmann/",
    "VTK": r"vtk",
    "GSL": r"gsl/",
    "NLopt": r"nlopt",
    "SuiteSparse": r"(suitesparse/)?(cholmod|amd|colamd|ccolamd|camd|umfpack|SuiteSparse)",
    "METIS": r"metis\.h",
    "BLAS and LAPACK": r"(cblas|lapacke?|openblas)",
    "Clipper": r"polyclipping/",
    "Voro++": r"voro\+\+/",
    "pugixml": r"pugixml\.hpp",
    "libpng": r"png\.h",
    "cairo": r"cairo",
    "zlib": r"zlib\.h",
    "libdeflate": r"libdeflate\.h",
    "OpenMP": r"omp\.h",
}
everyones = {"Eigen", "fmt", "OpenMP"}
# GSL is many libraries in one: integrals, splines and spectra of histories, inverse distributions of ensembles.
severalUsers = {"GSL": {"timeSeries", "ensembles"}}

# Headers of C, C++ and POSIX: names without an ending, and these.
system = re.compile(r"[a-z_]+$|(sys|netinet|arpa)/[a-z]+\.h$|"
                    r"(unistd|fcntl|signal|dirent|limits|malloc|pthread|sched|pwd|poll|spawn|termios|dlfcn|fenv)\.h$")
include = re.compile(r'\s*#\s*include\s*([<"])([^>"]+)[>"]')


def sourceFiles(root):
    """Every source file of libs/ and applications/ with the library it belongs to."""
    for path in sorted(root.glob("libs/*/**/*")) + sorted(root.glob("applications/*/*/**/*")):
        if path.suffix in (".h", ".cpp"):
            parts = path.relative_to(root).parts
            yield path, parts[1] if parts[0] == "libs" else "applications"


def violations(root):
    """Each forbidden include as a line `file:line: what is wrong`."""
    found = []
    usersOf = {}  # third-party library: {owner: first place}
    for path, owner in sourceFiles(root):
        name = path.relative_to(root)
        if owner != "applications" and owner not in allLibraries:
            found.append(f"{name}:1: libs/{owner} is a library that test/layers/checkLayers.py does not know")
            continue
        allowed = allLibraries if owner == "applications" else set(below[owner].split()) | {owner}
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
            match = include.match(line)
            if not match:
                continue
            header = match.group(2)
            place = f"{name}:{number}"
            if match.group(1) == '"':
                target = header.split("/")[0]
                if "/" not in header:
                    # A file in the same folder: only applications have their own.
                    if owner != "applications" or not (path.parent / header).exists():
                        found.append(f'{place}: "{header}" is to be included with its library, as "{owner}/{header}"')
                elif not (root / "libs" / header).exists():
                    found.append(f'{place}: there is no libs/{header}')
                elif target not in allowed:
                    found.append(f"{place}: {owner} may not see {target}" +
                                 (f" (only {' '.join(sorted(allowed - {owner}))})" if allowed - {owner} else ""))
                continue
            library = next((key for key, pattern in thirdParty.items() if re.match(pattern, header)), None)
            if library is None:
                if not system.match(header):
                    found.append(f"{place}: <{header}> is of a library that test/layers/checkLayers.py does not know")
                continue
            if library in everyones:
                continue
            usersOf.setdefault(library, {}).setdefault(owner, place)
            if path.suffix == ".h":
                found.append(f"{place}: {library} in a header: files that include it would see {library} too")
    for library, users in usersOf.items():
        if "applications" in users:
            found.append(f"{users['applications']}: an application may not use {library} itself")
        if len(users) > 1 and not set(users) <= severalUsers.get(library, set()):
            found.append(f"{library} is to be used by one library only, but is by {' and '.join(users)}: " +
                         " ".join(users.values()))
    return found


def withoutOpening(root):
    """Each source whose second line, after the licence, does not say why it is in its library."""
    found = []
    for path, _ in sourceFiles(root):
        second = (path.read_text(encoding="utf-8").splitlines() + ["", ""])[1]
        if not second.startswith("/// "):
            found.append(f"{path.relative_to(root)}:2: begin with a line `/// ...` that says why the file is here")
    return found


def selfTest():
    """Every kind of violation, each of which must be found, and alone."""
    good = {"libs/core/Error.h": "#pragma once\n#include <string>\n#include <fmt/format.h>\n#include <unistd.h>\n",
            "libs/dictionary/Dictionary.cpp": "#include <tao/pegtl.hpp>\n",
            "libs/geometry/Polygon.h": '#include "core/Error.h"\n#include <Eigen/Core>\n',
            "libs/conic/Program.h": '#include "core/Error.h"\n',
            "libs/statics/LimitAnalysis.h": '#include "conic/Program.h"\n#include "geometry/Polygon.h"\n',
            "libs/dynamics/Step.h": '#include "conic/Program.h"\n',
            "libs/io/Series.cpp": "#include <vtkNew.h>\n",
            "applications/solvers/limitAnalysis/limitAnalysis.cpp":
                '#include "statics/LimitAnalysis.h"\n#include "report.h"\n',
            "applications/solvers/limitAnalysis/report.h": "#include <string>\n"}
    planted = {
        ("libs/core/Error.h", '#include "geometry/Polygon.h"'): "core may not see geometry",
        ("libs/conic/Program.h", '#include "geometry/Polygon.h"'): "conic may not see geometry",
        ("libs/statics/LimitAnalysis.h", '  # include "dynamics/Step.h"'): "statics may not see dynamics",
        ("libs/dynamics/Step.h", '#include "statics/LimitAnalysis.h"'): "dynamics may not see statics",
        ("libs/geometry/Clip.cpp", "#include <vtkPolygon.h>"): "VTK is to be used by one library only",
        ("libs/dictionary/Options.h", "#include <tao/pegtl.hpp>"): "PEGTL in a header",
        ("libs/core/Error.cpp", "#include <boost/geometry.hpp>"): "does not know",
        ("libs/core/Error.cpp", '#include "Error.h"'): 'as "core/Error.h"',
        ("libs/core/Error.cpp", '#include "core/Eror.h"'): "there is no libs/core/Eror.h",
        ("libs/masonry/Wall.h", "#include <vector>"): "is a library that test",
        ("applications/solvers/limitAnalysis/limitAnalysis.cpp", "#include <nlopt.h>"): "an application may not use",
    }

    def tree(files):
        root = pathlib.Path(scratch) / f"tree{len(list(pathlib.Path(scratch).iterdir()))}"
        for name, text in files.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        return root

    failures = []
    with tempfile.TemporaryDirectory() as scratch:
        clean = violations(tree(good))
        if clean:
            failures.append(f"the clean tree: {clean}")
        for (name, line), message in planted.items():
            found = violations(tree({**good, name: good.get(name, "") + line + "\n"}))
            if len(found) != 1 or message not in found[0]:
                failures.append(f"{line} in {name}: expected '{message}', got {found}")
        licence = "// SPDX-License-Identifier: GPL-3.0-or-later\n"
        if withoutOpening(tree({"libs/core/Error.h": licence + "/// What programs say.\n"})):
            failures.append("a source with its opening line is refused")
        if len(withoutOpening(tree({"libs/core/Error.h": licence, "libs/core/Error.cpp": licence + "#include <x>\n"}))) != 2:
            failures.append("sources without an opening line are not found")
    return len(planted) + 2, failures


def check(root):
    found = violations(root) + withoutOpening(root)
    count = len(list(sourceFiles(root)))
    return found if count else ["no source files"], f"{count} files, {len(found)} violations"


if __name__ == "__main__":
    sys.exit(checkTree.run(check, selfTest))
