// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where the iterations of programs begin that are much like some whose paths are known. Internal to the lane
/// solver.
#pragma once

#include "conic/lanes/LaneGeometry.h"

namespace drystone
{

/// Iterates of reference programs near their central paths, at several complementarities. A program begins at
/// the nearest reference, the closer to its solution the more the two are alike: which one follows from the
/// program and the references alone, and with it all bits of the answer.
class LaneBeginnings
{
public:
    /// Follows the paths of the references. \param geometry of their points \param references alike; what
    /// has no path is left out
    LaneBeginnings(LaneGeometry& geometry, const LaneKernel& kernel,
                   const std::vector<PlaneConeProgram>& references, double tolerance);

    /// Whether no reference has a path.
    bool isEmpty() const { return references.empty(); }

    /// Sets where a program begins. \param geometry with the program set as the one with this index
    void begin(LaneGeometry& geometry, const PlaneConeProgram& program, std::size_t index) const;

    const double tolerance;

private:
    struct Reference
    {
        const PlaneConeProgram* program = nullptr; ///< while it is followed
        std::vector<double> friction;              ///< of each face
        Eigen::VectorXd load;
        Eigen::VectorXd liveLoad;
        LaneScale scale;
        std::vector<double> resting;     ///< of each ray, or empty; in units of its load as in `scale`
        std::vector<LaneIterate> stages; ///< at the complementarities, as far as they were reached
    };

    /// How a program differs from a reference, and its loads as multiples of those of that.
    struct Difference
    {
        double size = 0;
        double load = 1;
        double liveLoad = 1;
    };

    void seekRest(LaneGeometry& geometry, const LaneKernel& kernel, double share);
    void follow(LaneGeometry& geometry, const LaneKernel& kernel);
    static Difference differenceOf(const std::vector<double>& friction, const PlaneConeProgram& program,
                                   const Reference& reference, double most);
    static LaneBegin beginAt(const LaneScale& scale, const Reference& reference, const LaneIterate& iterate,
                             const Difference& difference);

    std::vector<Reference> references;
};

} // namespace drystone
