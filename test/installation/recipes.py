# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""That the recipes for Spack and conda-forge are Python and YAML, have the version of the project, and name every library
of etc/bootstrap."""
import ast
import os
import re
import subprocess
import sys
import unittest

root = os.path.abspath(sys.argv.pop(1))

# Names of the same library: Debian's package, Spack's, conda-forge's (None: built by etc/conda/build.sh).
libraries = {
    "libeigen3-dev": ("eigen", "eigen"), "libfmt-dev": ("fmt", "fmt"), "tao-pegtl-dev": ("pegtl", None),
    "libmuparser-dev": ("muparser", "muparser"), "nlohmann-json3-dev": ("nlohmann-json", "nlohmann_json"),
    "libsuitesparse-dev": ("suite-sparse", "suitesparse"), "libmetis-dev": ("metis", "metis"),
    "libgsl-dev": ("gsl", "gsl"), "libnlopt-dev": ("nlopt", "nlopt"), "libpolyclipping-dev": ("polyclipping", None),
    "voro++-dev": ("voropp", "voro"), "libvtk9-dev": ("vtk", "vtk-base"), "libdeflate-dev": ("libdeflate", "libdeflate"),
    "libpugixml-dev": ("pugixml", "pugixml"), "libpng-dev": ("libpng", "libpng"),
    "libcairo2-dev": ("cairo", "cairo"), "libjemalloc-dev": ("jemalloc", "jemalloc"),
}
# Tools, and a package that only Debian's VTK asks for.
notLibraries = {"g++", "cmake", "ninja-build", "ccache", "git", "libvtk9.1-qt"}


def read(name):
    with open(os.path.join(root, name), encoding="utf-8") as file:
        return file.read()


class Recipes(unittest.TestCase):
    def setUp(self):
        listed = subprocess.run([os.path.join(root, "etc/bootstrap"), "--list"], capture_output=True, text=True, check=True)
        self.packages = set(listed.stdout.split()) - notLibraries
        self.version = re.search(r"project\(drystone VERSION (\S+)", read("CMakeLists.txt")).group(1)

    def testEveryLibraryIsKnownHere(self):
        self.assertEqual(self.packages, set(libraries))

    def testVersionsAreThatOfTheProject(self):
        self.assertEqual(re.findall(r"(?m)^version: (\S+)$", read("CITATION.cff")), [self.version])
        self.assertEqual(re.findall(r'(?m)^version = "(\S+)"$', read("python/pyproject.toml")), [self.version])

    def testSpack(self):
        tree = ast.parse(read("etc/spack/packages/drystone/package.py"))
        recipe = next(node for node in tree.body if isinstance(node, ast.ClassDef))
        self.assertEqual((recipe.name, recipe.bases[0].id), ("Drystone", "CMakePackage"))
        needed = {re.split("[@~+ ]", call.args[0].value)[0] for call in ast.walk(recipe)
                  if isinstance(call, ast.Call) and getattr(call.func, "id", "") == "depends_on"}
        self.assertLessEqual({names[0] for names in libraries.values()}, needed)
        own = ast.parse(read("etc/spack/packages/polyclipping/package.py"))
        self.assertEqual([node.name for node in own.body if isinstance(node, ast.ClassDef)], ["Polyclipping"])

    def testCondaForge(self):
        try:
            import yaml
        except ImportError:
            self.skipTest("PyYAML is not installed")
        recipe = yaml.safe_load(read("etc/conda/recipe.yaml"))
        self.assertEqual(recipe["context"]["version"], self.version)
        needed = {entry.split()[0] for entry in recipe["requirements"]["host"]}
        self.assertLessEqual({names[1] for names in libraries.values() if names[1]}, needed)
        folders = {source["target_directory"] for source in recipe["source"]}
        script = read("etc/conda/" + recipe["build"]["script"])
        self.assertEqual(folders, set(re.findall(r"-S (\w+)", script)))
        subprocess.run(["bash", "-n", os.path.join(root, "etc/conda/build.sh")], check=True)


if __name__ == "__main__":
    unittest.main()
