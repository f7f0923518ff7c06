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
/// differs from lane to lane and reads what has come of it, in the units of the program.
class LaneGeometry
{
public:
    LaneGeometry(const PlaneConeProgram& program, int laneCount);
    LaneGeometry(const LaneGeometry&) = delete;
    LaneGeometry& operator=(const LaneGeometry&) = delete;

    /// Whether a program has these points.
    bool isOf(const PlaneConeProgram& program) const;

    /// \param ofLane a program for each lane
    void setPrograms(const std::vector<const PlaneConeProgram*>& ofLane);

    /// \param program in the lane \return what its kernel has ended with; no status
    ConeSolution solutionOf(const PlaneConeProgram& program, int lane) const;

    /// What the kernel has ended with in a lane, in units of `scaleOf` it.
    LaneIterate iterateOf(int lane) const;
    std::vector<double> restingOf(int lane) const; ///< likewise; empty where there is none
    const LaneScale& scaleOf(int lane) const { return scales[lane]; }
    std::vector<double> frictionOfFaces(const PlaneConeProgram& program) const;

    LaneTask task{};

private:
    void addPoint(const ConeColumns<3, 2>& columns);
    void listProducts();
    void allot();
    void setFriction(const std::vector<const PlaneConeProgram*>& ofLane);
    std::vector<double> columnOf(const double* numbers, std::size_t count, int lane) const;
    double setRows(const Eigen::VectorXd& rowsOfProgram, int lane, double* rows) const;
    Eigen::VectorXd forcesOf(const PlaneConeProgram& program, const double* s, int lane) const;
    Eigen::VectorXd displacementOf(int lane) const;

    const std::vector<ConeColumns<3, 2>> contacts;
    const int bodies;
    const int lanes;
    const double lever;
    std::vector<int> position; ///< of each body in elimination order
    FactorPattern pattern;
    std::vector<int> productStart;
    std::vector<LaneProduct> products;
    std::vector<LaneFace> faces;
    std::vector<LanePoint> points;
    std::vector<double> memory;
    std::vector<LaneScale> scales; ///< of each lane
};

/// Whether two programs have the same contact points.
bool haveSamePoints(const std::vector<ConeColumns<3, 2>>& one, const std::vector<ConeColumns<3, 2>>& other);

} // namespace drystone
