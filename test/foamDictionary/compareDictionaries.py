#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Our reading of dictionaries against that of OpenFOAM 1912's own foamDictionary.

compareDictionaries.py shipped  READER   every dictionary in etc/ and tutorials/: foamDictionary reads it, and sees
                                         the same entries (#calc is left as it stands)
compareDictionaries.py examples READER   the dictionaries of package openfoam-examples: at least 99% are read, and a
                                         seeded sample of 500 has the same entries
compareDictionaries.py macros   READER   dictionaries of ours with macros and directives: the same entries when
                                         both expand
compareDictionaries.py options  CASEDICTIONARY   caseDictionary's options print the same and end with the same status

READER is the program readDictionaries. Exit status 77 (skipped) where OpenFOAM is not installed. What counts as the
same: the same words, strings and brackets in the same order, numbers to 1e-5 relative (foamDictionary prints six
digits); FoamFile headers aside.
"""
import concurrent.futures
import dataclasses
import gzip
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

examples = pathlib.Path("/usr/share/doc/openfoam-examples/examples")
environment = {**os.environ, "WM_PROJECT_DIR": "/usr/share/openfoam"}
sampleSize = 500
seed = 20170615
demandedShare = 0.99

# Independent of our own grammar, so that an error in it is detected.
token = re.compile(r'"(?:\\.|[^"\\])*"|#\{.*?#\}|[(){}\[\];]|(?:[^\s(){}\[\];"/]|/(?![/*]))+', re.DOTALL)


def tokensOf(text):
    """The tokens of printed entries, words broken where foamDictionary would put blanks."""
    found = []
    for piece in token.findall(text):
        if piece[0] in '"#' or piece in "(){}[];":
            found.append(piece)
            continue
        # foamDictionary knows numbers, words, and punctuation apart: 2D is printed 2 D, a.b/c is printed a.b / c.
        found += re.findall(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?=$|[-+*/:,=])|[-+*/:,=]|[^-+*/:,=]+", piece)
    return found


def isNumber(piece):
    try:
        float(piece)
        return piece[-1].isdigit() or piece[-1] == "."
    except ValueError:
        return False


def joinedTokens(tokens):
    """Tokens with numbers made numbers and everything else pasted together, so that blanks mean nothing."""
    result = []
    for piece in tokens:
        if isNumber(piece):
            result.append(float(piece))
        elif result and isinstance(result[-1], str):
            result[-1] += piece
        else:
            result.append(piece)
    return result


def firstDifference(ours, theirs):
    """A line about the first place where the entries differ, None when they are the same."""
    a, b = joinedTokens(tokensOf(ours)), joinedTokens(tokensOf(theirs))
    for x, y in zip(a, b):
        if isinstance(x, float) and isinstance(y, float):
            if abs(x - y) > 1e-5 * max(abs(x), abs(y)):
                return f"{x} against {y}"
        elif x != y:
            i = 0
            x, y = str(x), str(y)
            while i < min(len(x), len(y)) and x[i] == y[i]:
                i += 1
            return f"...{x[max(0, i - 40):i + 40]!r} against ...{y[max(0, i - 40):i + 40]!r}"
    if len(a) != len(b):
        return f"{len(a)} against {len(b)} pieces, after ...{a[-1] if a else ''!r:.60}"
    return None


def withoutHeader(text):
    return re.sub(r'^\s*FoamFile\s*\{.*?\}', "", text, count=1, flags=re.DOTALL | re.MULTILINE)


def readByUs(reader, files, *options):
    """{file: (was read, printed entries or message)}"""
    run = subprocess.run([reader, *options], input="\n".join(map(str, files)) + "\n", capture_output=True, text=True,
                         errors="surrogateescape",
                         env={**os.environ, "DRYSTONE_ETC": environment["WM_PROJECT_DIR"] + "/etc"})
    if run.returncode != 0:
        sys.exit(f"{reader} ended with {run.returncode}: {run.stderr[-2000:]}")
    result = {}
    for answer in re.findall(r"^@@ (read|failed) (.*?)\n(.*?)^@@ end$", run.stdout, re.DOTALL | re.MULTILINE):
        result[answer[1]] = (answer[0] == "read", answer[2])
    return result


def readByFoam(file, *options):
    """(was read, printed entries or message)"""
    run = subprocess.run(["foamDictionary", *options, str(file)], capture_output=True, text=True,
                         env={**environment, "PWD": str(file.parent)}, errors="surrogateescape", cwd=file.parent)
    return run.returncode == 0, run.stdout if run.returncode == 0 else run.stderr


def plain(text):
    """Without what foamDictionary prints in a way of its own: unexpanded directives, macros that are entries, and
    the number before a list without a keyword, which it adds."""
    text = re.sub(r'^\s*"?#.*$', "", text, flags=re.MULTILINE)
    text = re.sub(r'^(\s*)"(\$\S*)"', r"\1\2", text, flags=re.MULTILINE)
    text = re.sub(r"^\d+ // entry\d+$", "", text, flags=re.MULTILINE)
    return re.sub(r"^\d+\(", "(", text, flags=re.MULTILINE)


def compareShipped(reader):
    """Dictionaries that we ship: all that are no scripts, readmes or data."""
    files = []
    for folder in ("etc", "tutorials"):
        for path in sorted(pathlib.Path(folder).rglob("*")):
            isCase = folder == "etc" or path.parent.name in ("system", "constant", "0", "assembly")
            if path.is_file() and isCase and path.suffix == "" and \
                    not path.read_bytes().startswith(b"#!") and b"FoamFile" in path.read_bytes():
                files.append(path.resolve())
    # foamDictionary evaluates #calc by compiling it, which it does not do for a superuser, so such a file is compared
    # unexpanded; our own evaluation is covered by the tests of the expressions.
    calculated = [file for file in files if re.search(rb'^[^/]*#calc', file.read_bytes(), re.MULTILINE)]
    ours = readByUs(reader, files, "expand", "print")
    unexpanded = readByUs(reader, calculated, "print")
    byFoam = {}
    failures = []
    for file in files:
        wasRead, text = ours[str(file)]
        if wasRead and file in calculated:
            wasRead, text = unexpanded[str(file)]
        # A start of foamDictionary takes 25 ms: it reads files of the same text once, unless that names other files.
        content = file.read_bytes()
        same = (content, file.parent if b"#include" in content else None)
        if same not in byFoam:
            byFoam[same] = readByFoam(file, *(["-disableFunctionEntries"] if file in calculated else []))
        foamRead, foamText = byFoam[same]
        if not wasRead or not foamRead:
            failures.append(f"{file}: {'' if wasRead else 'we: ' + text}{'' if foamRead else 'foamDictionary: ' + foamText}")
            continue
        difference = firstDifference(withoutHeader(text), withoutHeader(foamText))
        if difference:
            failures.append(f"{file}: {difference}")
    print("\n".join(failures))
    print(f"{len(files)} dictionaries that we ship, {len(failures)} differ from foamDictionary")
    return 1 if failures else 0


def corpus(scratch):
    """Every file of the examples with a FoamFile header in plain text; compressed ones are unpacked to scratch."""
    files = []
    for path in sorted(examples.rglob("*")):
        if not path.is_file() or path.is_symlink():
            continue
        content = path.read_bytes()
        if path.suffix == ".gz":
            content = gzip.decompress(content)
        if b"FoamFile" not in content:
            continue
        header = re.search(rb"^\s*FoamFile\s*\{(.*?)\}", content, re.DOTALL | re.MULTILINE)
        isScript = content.startswith(b"#!") or path.name.removesuffix(".gz").endswith(".m4")
        if not header or isScript or b"\0" in content or re.search(rb"format\s+binary", header.group(1)):
            continue
        if path.suffix == ".gz":
            path = pathlib.Path(scratch) / path.relative_to(examples).with_suffix("")
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        files.append(path)
    return files


@dataclasses.dataclass
class Comparison:
    isExpanded: bool
    differences: list  # at most one


def comparedWithFoam(reader, files):
    """A Comparison of each file, None where foamDictionary refuses it."""
    # Expanded if possible: neither of the two runs code here, and some pieces lack their context.
    expanded = readByUs(reader, files, "expand", "print")
    unexpanded = readByUs(reader, files, "print")

    def comparison(file):
        (wasRead, text), isExpanded = expanded[str(file)], True
        foamRead, foamText = readByFoam(file) if wasRead else (False, "")
        if not foamRead:
            (wasRead, text), isExpanded = unexpanded[str(file)], False
            foamRead, foamText = readByFoam(file, "-disableFunctionEntries")
        if not foamRead:
            return None
        difference = firstDifference(plain(withoutHeader(text)), plain(withoutHeader(foamText))) if wasRead else text
        return Comparison(isExpanded, [f"{file}: {difference}"] if difference else [])

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as threads:
        return list(threads.map(comparison, files))


def compareExamples(reader):
    if not examples.exists():
        print("package openfoam-examples is not installed: skipped")
        return 77
    with tempfile.TemporaryDirectory() as scratch:
        files = corpus(scratch)
        results = readByUs(reader, files)
        failed = [file for file in files if not results[str(file)][0]]
        for file in failed[:40]:
            print(f"not read: {file}: {' '.join(results[str(file)][1].splitlines()[1:-1])}")
        share = 1 - len(failed) / len(files)
        print(f"{len(files)} dictionaries of openfoam-examples, {100 * share:.2f}% read")

        # The sample is of what foamDictionary reads itself (some examples are pieces to be included).
        chosen = random.Random(seed).sample(files, len(files))
        chosen = [file for file in chosen if file.stat().st_size <= 1_000_000]
        compared, expanded, differing, refused = 0, 0, [], 0
        while compared < sampleSize and chosen:
            count = sampleSize - compared
            batch, chosen = chosen[:count], chosen[count:]
            comparisons = [comparison for comparison in comparedWithFoam(reader, batch) if comparison]
            compared += len(comparisons)
            refused += len(batch) - len(comparisons)
            expanded += sum(comparison.isExpanded for comparison in comparisons)
            differing += [difference for comparison in comparisons for difference in comparison.differences]
    print("\n".join(differing))
    print(f"{compared} of a sample (seed {seed}) compared, {expanded} of them expanded, {len(differing)} differ; "
          f"foamDictionary refused {refused} others")
    return 1 if share < demandedShare or differing or compared < sampleSize else 0


def main():
    if not shutil.which("foamDictionary") or not pathlib.Path(environment["WM_PROJECT_DIR"]).exists():
        print("OpenFOAM's foamDictionary is not installed: skipped (etc/bootstrap test installs it)")
        return 77
    what, reader = sys.argv[1], str(pathlib.Path(sys.argv[2]).resolve())
    return {"shipped": compareShipped, "examples": compareExamples, "macros": compareMacros,
            "options": compareOptions}[what](reader)


def compareMacros(reader):
    files = sorted(pathlib.Path("test/foamDictionary/macros").resolve().iterdir())
    failures = []
    ours = readByUs(reader, files, "expand", "print")
    for file in files:
        wasRead, text = ours[str(file)]
        foamRead, foamText = readByFoam(file)
        if not wasRead or not foamRead:
            failures.append(f"{file}: we: {text[:500]} foamDictionary: {foamText[:1500]}")
            continue
        difference = firstDifference(withoutHeader(text), withoutHeader(foamText))
        if difference:
            failures.append(f"{file}: {difference}\n--- ours\n{text}\n--- foamDictionary\n{foamText}")
    print("\n".join(failures))
    print(f"{len(files)} dictionaries with macros, {len(failures)} differ from foamDictionary")
    return 1 if failures or not files else 0


def compareOptions(caseDictionary):
    """The same options on the same file: output, exit status, and what the file says afterwards."""
    text = """FoamFile { version 2.0; format ascii; class dictionary; object some; }
a 5; b { c 1; d (1 $a 3); e "a string"; f [0 1 0 0 0 0 0] 3; "p.*" q; g { h $..c; } }
"""
    lines = ["", "-expand", "-keywords", "-entry a", "-entry b", "-entry b/c", "-entry b.c", "-entry b/g/h -value",
             "-entry b -keywords", "-entry b -value", "-entry b/pattern", "-entry b/d -value", "-entry nowhere",
             "-entry b/nowhere -value", "-entry a/b", "-entry b/c -set 7", "-entry b/new -set 7", "-entry new -set 7",
             "-entry b/c -add 8", "-entry b/new -add 8", "-entry b/g -remove", "-entry b/nowhere -remove",
             "-entry nowhere/new -set 1", "-entry nowhere/new -add 1"]
    calls = [line.split() for line in lines] + [["-entry", "a", "-set", "(1 2 3)"], ["-entry", "a", "-set", "{ x 1; }"]]
    failures = []
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        for call in calls:
            answers = []
            for program in (caseDictionary, "foamDictionary"):
                file = folder / "some"
                # foamDictionary expands macros permanently when it edits; we keep them.
                isEdit = any(option in call for option in ("-set", "-add", "-remove"))
                file.write_text(text.replace("$a", "5").replace("$..c", "1") if isEdit else text)
                run = subprocess.run([program, *call, "some"], cwd=folder, capture_output=True, text=True,
                                     env={**environment, "PWD": scratch})
                output = re.sub(r"/\*.*?\*/|^//.*?$", "", run.stdout, flags=re.DOTALL | re.MULTILINE)
                output = re.sub(r"--> FOAM Warning :.*?(?=^\S+ +\S*;)", "", output, flags=re.DOTALL | re.MULTILINE)
                file.write_text(re.sub(r"/\*.*?\*/", "", file.read_text(), flags=re.DOTALL))
                after = readByFoam(file)[1]
                answers.append((run.returncode, output, after))
            (ourStatus, ourOutput, ourFile), (theirStatus, theirOutput, theirFile) = answers
            if ourStatus != theirStatus:
                failures.append(f"{call}: status {ourStatus} against {theirStatus}")
            difference = firstDifference(withoutHeader(ourOutput), withoutHeader(theirOutput)) or \
                firstDifference(withoutHeader(ourFile), withoutHeader(theirFile))
            if difference and ourStatus == 0:
                failures.append(f"{call}: {difference}")
    print("\n".join(failures))
    print(f"{len(calls)} calls of caseDictionary, {len(failures)} differ from foamDictionary")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
