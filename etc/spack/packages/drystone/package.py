# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Recipe for Spack:  spack repo add etc/spack && spack install drystone"""

import os

from spack.package import *


class Drystone(CMakePackage):
    """Limit analysis and dynamics of structures of rigid blocks with dry joints: masonry walls, arches, stacks of stones.
    A result comes with a certificate that can be checked independently."""

    # The clone that holds this recipe.
    git = "file://" + os.path.abspath(os.path.join(os.path.dirname(__file__), *[os.pardir] * 4))

    license("GPL-3.0-or-later", checked_by="the Drystone authors")

    version("main", branch="main")

    depends_on("c", type="build")  # VTK's package requires it
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("git", type="build")

    depends_on("eigen@3.4")
    depends_on("fmt@9:")
    depends_on("pegtl@3.2")
    depends_on("muparser@2.3:")
    depends_on("nlohmann-json@3.11:")
    depends_on("suite-sparse@5.12:")
    depends_on("metis@5.1:")
    depends_on("gsl@2.7:")
    depends_on("nlopt@2.7:")
    depends_on("polyclipping@6.4")
    depends_on("voropp@0.4.6")
    depends_on("vtk@9.1: ~mpi")
    depends_on("libdeflate")
    depends_on("pugixml")
    depends_on("libpng")
    depends_on("cairo@1.16: +pdf +png")
    depends_on("jemalloc@5:")

    generator("ninja")

    conflicts("%gcc@:11", msg="Drystone is C++20")
    conflicts("%clang@:13", msg="Drystone is C++20")

    def cmake_args(self):
        # Spack's compiler wrapper compiles for its target: the last -march of a command counts, and this is the first.
        return [self.define("DRYSTONE_PROCESSOR", "x86-64"), self.define("DRYSTONE_TESTS", False)]

    @run_after("install")
    @on_package_attributes(run_tests=True)
    def check_install(self):
        """The thinnest arch, as a user would run it: it compares itself with its reference."""
        with working_dir("check", create=True):
            install_tree(join_path(self.prefix.share, "drystone", "tutorials", "limitAnalysis", "arch"), "arch")
            with working_dir("arch"), set_env(PATH=self.prefix.bin + os.pathsep + os.environ["PATH"]):
                Executable("./Allrun")()
