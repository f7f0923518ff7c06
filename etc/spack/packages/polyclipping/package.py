# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Clipper 6, which Drystone clips polygons with and Spack does not have."""

from spack.package import *


class Polyclipping(CMakePackage):
    """Clipper: intersection, union and difference of polygons, and their offsets (version 6, C++)."""

    homepage = "http://www.angusj.com/delphi/clipper.php"
    url = "https://downloads.sourceforge.net/project/polyclipping/clipper_ver6.4.2.zip"

    license("BSL-1.0")

    version("6.4.2", sha256="a14320d82194807c4480ce59c98aa71cd4175a5156645c4e2b3edd330b930627", expand=True)

    depends_on("cxx", type="build")
    depends_on("cmake@3.5:", type="build")

    # The archive has no folder of its own: Spack expands it into one.
    root_cmakelists_dir = "cpp"

    def cmake_args(self):
        # Its CMakeLists.txt is from before CMake 3.5.
        return [self.define("CMAKE_POLICY_VERSION_MINIMUM", "3.5")]
