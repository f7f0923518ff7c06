// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What programs of the same contact points have in common, and the arrays of their lanes. Internal to the
/// lane solver.
#pragma once

#include "conic/ConeProgram.h"
#include "conic/lanes/LaneTask.h"
#include "linear/BlockPattern.h"

#include <vector>

namespace drystone
{

/// Of rays, faces and rows as in LaneTask.h, in units of its own.
struct LaneIterate
{
    std::vector<double> s, z, y;
    double alpha = 0;
};

/// Of the numbers of one program, powers of two: see Form::Scaling.
struct LaneScale
{
    double load = 1;
    double liveLoad = 1;
    double displacement = 1;
};

/// The task of a kernel for all programs with these points: faces, pattern of the factor, memory. Sets what
/// differs from program to program and reads what has come of it, in the units of the program.
class LaneGeometry
{
public:
    LaneGeometry(const PlaneConeProgram& program, int laneCount);
    LaneGeometry(const LaneGeometry&) = delete;
    LaneGeometry& operator=(const LaneGeometry&) = delete;

    /// Whether a program has these points.
    bool isOf(const PlaneConeProgram& program) const;

    /// The programs of the task, at least one; not kept.
    void setPrograms(const std::vector<const PlaneConeProgram*>& programs);

    /// \param program that was set as the one with this index \return what the kernel has ended with; no
    /// status
    ConeSolution solutionOf(const PlaneConeProgram& program, std::size_t index) const;

    /// What the kernel has ended with, in units of `scaleOf` the program.
    LaneIterate iterateOf(std::size_t index) const;
    std::vector<double> restingOf(std::size_t index) const; ///< likewise; empty where there is none
    const LaneScale& scaleOf(std::size_t index) const { return scales[index]; }
    std::vector<double> frictionOfFaces(const PlaneConeProgram& program) const;

    LaneTask task{};

private:
    void addPoint(const ConeColumns<3, 2>& columns);
    void listProducts();
    void allotLanes(std::size_t lanes);
    void allotPrograms(std::size_t count);
    int setFriction(const std::vector<const PlaneConeProgram*>& ofPrograms);
    double setRows(const Eigen::VectorXd& rowsOfProgram, double* rows) const;
    Eigen::VectorXd forcesOf(const PlaneConeProgram& program, const double* s, double scale) const;
    Eigen::VectorXd displacementOf(const double* y, double scale) const;
    std::size_t rows() const { return 3 * (static_cast<std::size_t>(bodies) + 1); } ///< with the ground's
    std::size_t rays() const { return 2 * points.size(); }

    struct ProgramRows
    {
        std::vector<double> friction, load, liveLoad, s, z, y, resting;
    };

    const std::vector<ConeColumns<3, 2>> contacts;
    const int bodies;
    const double lever;
    std::vector<int> position; ///< of each body in elimination order
    FactorPattern pattern;
    std::vector<int> productStart;
    std::vector<LaneProduct> products;
    std::vector<LaneFace> faces;
    std::vector<LanePoint> points;
    std::vector<double> memory;        ///< of the lanes
    std::vector<ProgramRows> rowsOf;   ///< of as many programs as there were at most
    std::vector<LaneProgram> programs; ///< likewise; what the task points to
    std::vector<LaneScale> scales;     ///< of each program
};

/// Whether two programs have the same contact points.
bool haveSamePoints(const std::vector<ConeColumns<3, 2>>& one, const std::vector<ConeColumns<3, 2>>& other);

} // namespace drystone
