// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Whether an assembly is fit to be computed with: what `checkBlocks` prints.
#pragma once

#include "assembly/Assembly.h"

#include <string>
#include <vector>

namespace drystone
{

enum class CheckExtent
{
    standard,
    all ///< also short joints, and corners and edges that bear on another block without a joint
};

/// The limits of the checks. Sizes are relative to meanBlockSize.
struct CheckLimits
{
    double jointTolerance = 1e-6; ///< edges this near are a joint; deeper overlaps are faults
    double depth = 1e-4;    ///< of the smaller block's extent: tips that reach deeper into a neighbour are
                            ///< faults, however little both have in common
    double gap = 1e-2;      ///< edges nearer than this that are no joint are taken for a fault
    double gapAngle = 0.02; ///< of the edges of such a gap, from parallel [rad]
    double volumeRatio = 1e-10; ///< least volume of a block, relative to the mean
    double gyration = 1e4; ///< largest polar moment of area relative to the area squared (square: 1/6); in
                           ///< space trace of the inertia relative to the volume^(5/3) (cube: 1/2)
    double compactness = 1e-2; ///< least 4 pi area / perimeter^2, in space 36 pi volume^2 / surface^3
    double angle = 1e-2;       ///< least angle at a corner [rad]
    double edge = 1e-4; ///< least length of an edge, relative to the square root of the block's area, or the
                        ///< cube root of its volume
    double duplicate =
        1 - 1e-6; ///< blocks that overlap by more than this part of both are the same block twice
    double jointLength = 1e-3; ///< least length of a joint
};

/// Two blocks that share space.
template<int Dim>
struct Overlap
{
    int block = -1;
    int neighbour = -1;  ///< block < neighbour
    double common = 0;   ///< area of the common part [m2], in space its volume [m3]
    double fraction = 0; ///< of the smaller block's
};

/// Pairs of blocks that share more than the joint tolerance explains, the same block twice among them.
template<int Dim>
std::vector<Overlap<Dim>> findOverlaps(const Assembly<Dim>& assembly, const CheckLimits& limits = {});

/// The outcome of one check.
struct CheckResult
{
    std::string name;                ///< `volumes`, `inertia`, `duplicates`, `overlaps`, ...
    std::string message;             ///< one line for the user: what was found, with the figures
    int failures = 0;                ///< blocks or pairs at fault; 0: OK
    std::vector<std::string> faults; ///< a line each for the first few, naming the blocks
};

/// Counts of an assembly.
template<int Dim>
struct AssemblyStatistics
{
    int blocks = 0;
    int freeBlocks = 0;
    int supports = 0;
    int vertices = 0;
    int concaveBlocks = 0;
    int joints = 0;
    int contactPoints = 0;
    Vector<Dim> lower = Vector<Dim>::Zero(); ///< corner of the box round the free blocks [m]
    Vector<Dim> upper = Vector<Dim>::Zero(); ///< [m]
};

/// Counts an assembly, joints and contact points included.
template<int Dim>
AssemblyStatistics<Dim> countAssembly(const Assembly<Dim>& assembly);

template<int Dim>
struct AssemblyReport
{
    AssemblyStatistics<Dim> statistics;
    std::vector<CheckResult> checks;
};

/// Runs the checks, in the order in which they are printed. Outlines must be simple and counter-clockwise,
/// polyhedra solids, as readAssembly makes sure.
template<int Dim>
AssemblyReport<Dim> checkAssembly(const Assembly<Dim>& assembly, CheckExtent extent = CheckExtent::standard,
                                  const CheckLimits& limits = {});

/// Number of checks that failed.
template<int Dim>
int failedChecks(const AssemblyReport<Dim>& report);

/// The report as `checkBlocks` prints it, ending in `Assembly OK.` or `Failed N checks.`
template<int Dim>
std::string printedReport(const Assembly<Dim>& assembly, const AssemblyReport<Dim>& report);

} // namespace drystone
