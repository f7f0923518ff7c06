// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// All four figures in one pass over the points, each relative to a load, a force, a rate or a power.
#include "statics/CoulombCheck.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

using Eigen::VectorXd;

/// value / scale, where 0 / 0 is 0.
double relative(double value, double scale)
{
    return value == 0 ? 0 : value / scale;
}

/// The largest force, or moment times a factor, of a body: in space whatever the axes, in the plane by
/// components. Infinite where one is no number. \param rows R b
template<int Rows, int Forces>
double largestOfBody(const VectorXd& rows, double momentFactor)
{
    if constexpr (Forces == 2)
    {
        return largestRow<Rows, Forces>(rows, momentFactor);
    }
    double largest = 0;
    for (Eigen::Index row = 0; row < rows.size(); row += Forces)
    {
        const double size = rows.template segment<Forces>(row).norm() * (row % Rows == 0 ? 1 : momentFactor);
        largest = std::isnan(size) ? std::numeric_limits<double>::infinity() : std::max(largest, size);
    }
    return largest;
}

} // namespace

double CoulombResiduals::worst() const
{
    const double largest = std::max({balance, yield, flow, mismatch});
    return std::isfinite(balance + yield + flow + mismatch) ? largest
                                                            : std::numeric_limits<double>::infinity();
}

template<int Rows, int Forces>
CoulombResiduals coulombResiduals(const ConeProgram<Rows, Forces>& program, double alpha,
                                  const VectorXd& contactForce, const VectorXd& mechanism, double liveWork)
{
    using Shear = Eigen::Matrix<double, Forces - 1, 1>;
    const double lever = meanLeverArm(program);
    const double largestLoad =
        std::max(largestOfBody<Rows, Forces>(program.load, 1 / lever),
                 std::abs(alpha) * largestOfBody<Rows, Forces>(program.liveLoad, 1 / lever));
    double largestForce = largestLoad;
    for (Eigen::Index row = 0; row < contactForce.size(); row += Forces)
    {
        largestForce = std::max({largestForce, std::abs(contactForce[row]),
                                 contactForce.template segment<Forces - 1>(row + 1).norm()});
    }
    const double largestRate = largestOfBody<Rows, Forces>(mechanism, lever);

    CoulombResiduals residuals;
    VectorXd unbalanced = program.load + alpha * program.liveLoad;
    double dissipated = 0; ///< at the limits
    double excess = 0;     ///< of it over what the forces do
    for (int point = 0; point < program.points(); ++point)
    {
        const auto at = static_cast<std::size_t>(point);
        const auto& columns = program.contacts[at];
        const Eigen::Matrix<double, Forces, 1> force = contactForce.template segment<Forces>(Forces * point);
        const Eigen::Matrix<double, Forces, 1> closing = closingOf(columns, mechanism);
        addForce<Rows, Forces>(columns, -force, unbalanced);
        const Strength strength = program.strengthOf(at);
        const double normal = force[0];
        const Shear shear = force.template tail<Forces - 1>();
        const double limit = std::max(0.0, strength.cohesion + program.friction[at] * normal);
        const double pressing = normal + strength.tension;   // has to vanish where the point opens
        const double uncrushed = strength.crushing - normal; // where it closes
        residuals.yield =
            std::max({residuals.yield, relative(-pressing, largestForce), relative(-uncrushed, largestForce),
                      relative(shear.norm() - limit, largestForce)});

        const double opening = -closing[0];
        const Shear slip = closing.template tail<Forces - 1>();
        const double opens = std::min(relative(opening, largestRate), relative(pressing, largestForce));
        const double closes = std::min(relative(-opening, largestRate), relative(uncrushed, largestForce));
        double slides = 0;
        if (slip.norm() > 0)
        {
            const Shear missing = limit * slip / slip.norm() - shear;
            slides = std::min(relative(slip.norm(), largestRate), relative(missing.norm(), largestForce));
        }
        residuals.flow = std::max({residuals.flow, opens, closes, slides});

        dissipated += limit * slip.norm();
        excess += limit * slip.norm() - shear.dot(slip);
        excess += opening > 0 ? pressing * opening : strength.isBounded() ? -uncrushed * opening : 0;
        if (opening < 0 && !strength.isBounded())
        {
            residuals.flow = std::max(residuals.flow, relative(-opening, largestRate));
        }
    }
    residuals.balance = std::max(relative(largestOfBody<Rows, Forces>(unbalanced, 1 / lever), largestLoad),
                                 std::abs(program.liveLoad.dot(mechanism) - liveWork));
    residuals.mismatch =
        relative(std::abs(excess), std::max(dissipated, std::abs(program.load.dot(mechanism))));
    return residuals;
}

template CoulombResiduals coulombResiduals(const PlaneConeProgram& program, double alpha,
                                           const VectorXd& contactForce, const VectorXd& mechanism,
                                           double liveWork);
template CoulombResiduals coulombResiduals(const SpaceConeProgram& program, double alpha,
                                           const VectorXd& contactForce, const VectorXd& mechanism,
                                           double liveWork);

} // namespace drystone
