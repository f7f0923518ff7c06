#!/bin/bash
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
# What recipe.yaml runs: the two libraries that conda-forge does not have into a folder of their own, then Drystone.
set -eu

own=$PWD/own
cmake -S pegtl -B build-pegtl -G Ninja -D CMAKE_INSTALL_PREFIX="$own" -D PEGTL_BUILD_TESTS=OFF -D PEGTL_BUILD_EXAMPLES=OFF
cmake --install build-pegtl

# Its CMakeLists.txt is from before CMake 3.5.
cmake -S clipper/cpp -B build-clipper -G Ninja -D CMAKE_INSTALL_PREFIX="$own" -D CMAKE_POLICY_VERSION_MINIMUM=3.5 \
    -D BUILD_SHARED_LIBS=OFF -D CMAKE_BUILD_TYPE=Release -D CMAKE_POSITION_INDEPENDENT_CODE=ON
cmake --build build-clipper --target install

# CMAKE_ARGS has the prefix and the toolchain of conda-build.
cmake -S drystone -B build-drystone -G Ninja ${CMAKE_ARGS-} -D CMAKE_BUILD_TYPE=Release -D CMAKE_INSTALL_PREFIX="$PREFIX" \
    -D CMAKE_PREFIX_PATH="$own;$PREFIX" -D DRYSTONE_PROCESSOR=x86-64 -D DRYSTONE_TESTS=OFF
cmake --build build-drystone --target applications
# Without the static libraries, which conda-forge has in no package of applications.
for component in applications python; do
    cmake --install build-drystone --component $component
done
