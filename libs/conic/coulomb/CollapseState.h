// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where a collapse path is: the forces of its points, each on a piece of its law, and the multiplier.
/// Internal to CollapsePath.
#pragma once

#include "conic/coulomb/CollapsePath.h"
#include "conic/coulomb/CollapseSystem.h"

#include <vector>

namespace drystone
{

/// Forces and multiplier in the units of `system`, in which equations and steps are written.
template<int Rows, int Forces>
class CollapseState
{
public:
    using VectorXd = Eigen::VectorXd;
    using Piece = CollapsePiece<Forces>;
    using Force = typename Piece::Force;

    /// A residual of the equations below this is left to the next step.
    static constexpr double sufficientBalance = 1e-12;

    /// Points with stiffnesses at random, at forces that balance the load. \param contactForce F k
    /// \param multiplierThere alpha of the program at these forces
    CollapseState(const ConeProgram<Rows, Forces>& program, const VectorXd& contactForce,
                  double multiplierThere, const CollapsePathSettings& settings);

    int count() const { return static_cast<int>(pieces.size()); }
    /// Of F k numbers those of a point.
    static Force partOf(const VectorXd& numbers, int point)
    {
        return numbers.template segment<Forces>(Forces * point);
    }
    /// w of a point.
    Force at(int point) const { return partOf(stretch, point); }
    /// c(w), F k
    VectorXd contactForces() const;
    /// k times a closing, F k
    VectorXd stretched(VectorXd closing) const;

    /// Tells the system that a point has changed its piece, or its place on one that is curved.
    void update(int point)
    {
        system.change(point,
                      stiffnesses[point] * pieces[static_cast<std::size_t>(point)].derivative(at(point)));
    }
    /// Points that a step in space has taken beyond their piece are put on that where they are.
    void returnToLaw();
    /// Another psi from now on, with the same forces and slips.
    void changeDilatancy(double dilatancy);
    /// Steps of Newton's method back to the path, across its direction. \param pushed p, K p = L \return
    /// whether they lead there
    bool correct(const VectorXd& pushed);

    /// The first point to leave its piece of the law. \param rate of w, F k \param ignored rates that are
    /// nothing but rounding \param leaving set to that point
    typename Piece::Exit firstExit(const VectorXd& rate, double ignored, int& leaving) const;
    /// How far until the slip of a point has turned by as much as a step may; no limit in the plane.
    double turningDistance(const VectorXd& stretchRate) const;

    CollapseSystem<Rows, Forces> system;
    VectorXd stiffnesses;      ///< k of each point
    std::vector<Piece> pieces; ///< of each point
    VectorXd stretch;          ///< w, F k
    double multiplier = 0;     ///< alpha
};

extern template class CollapseState<3, 2>;
extern template class CollapseState<6, 3>;

} // namespace drystone
