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

/// What residuals are relative to.
struct ResidualUnits
{
    double load = 0; ///< the largest of a body
    double force = 0;
    double rate = 0;
};

template<int Rows, int Forces>
ResidualUnits unitsOf(const ConeProgram<Rows, Forces>& program, double alpha, const VectorXd& contactForce,
                      const VectorXd& mechanism, double lever)
{
    ResidualUnits units;
    units.load = std::max(largestOfBody<Rows, Forces>(program.load, 1 / lever),
                          std::abs(alpha) * largestOfBody<Rows, Forces>(program.liveLoad, 1 / lever));
    units.force = units.load;
    for (Eigen::Index row = 0; row < contactForce.size(); row += Forces)
    {
        units.force = std::max({units.force, std::abs(contactForce[row]),
                                contactForce.template segment<Forces - 1>(row + 1).norm()});
    }
    units.rate = largestOfBody<Rows, Forces>(mechanism, lever);
    return units;
}

/// Power at the limits of the points.
struct LimitPower
{
    double dissipated = 0;
    double excess = 0; ///< of that over what the forces do
};

/// What a point with its force and the rate at which it closes, normal first, adds to yield, flow and power.
template<int Forces>
void addPoint(const Eigen::Matrix<double, Forces, 1>& force, const Eigen::Matrix<double, Forces, 1>& closing,
              const Strength& strength, double friction, const ResidualUnits& units,
              CoulombResiduals& residuals, LimitPower& power)
{
    using Shear = Eigen::Matrix<double, Forces - 1, 1>;
    const double normal = force[0];
    const Shear shear = force.template tail<Forces - 1>();
    const double limit = std::max(0.0, strength.cohesion + friction * normal);
    const double pressing = normal + strength.tension;   // has to vanish where the point opens
    const double uncrushed = strength.crushing - normal; // where it closes
    residuals.yield =
        std::max({residuals.yield, relative(-pressing, units.force), relative(-uncrushed, units.force),
                  relative(shear.norm() - limit, units.force)});

    const double opening = -closing[0];
    const Shear slip = closing.template tail<Forces - 1>();
    const double opens = std::min(relative(opening, units.rate), relative(pressing, units.force));
    const double closes = std::min(relative(-opening, units.rate), relative(uncrushed, units.force));
    double slides = 0;
    if (slip.norm() > 0)
    {
        const Shear missing = limit * slip / slip.norm() - shear;
        slides = std::min(relative(slip.norm(), units.rate), relative(missing.norm(), units.force));
    }
    residuals.flow = std::max({residuals.flow, opens, closes, slides});
    if (opening < 0 && !strength.isBounded())
    {
        residuals.flow = std::max(residuals.flow, relative(-opening, units.rate));
    }

    power.dissipated += limit * slip.norm();
    power.excess += limit * slip.norm() - shear.dot(slip);
    power.excess += opening > 0 ? pressing * opening : strength.isBounded() ? -uncrushed * opening : 0;
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
    const double lever = meanLeverArm(program);
    const ResidualUnits units = unitsOf(program, alpha, contactForce, mechanism, lever);
    CoulombResiduals residuals;
    LimitPower power;
    VectorXd unbalanced = program.load + alpha * program.liveLoad;
    for (int point = 0; point < program.points(); ++point)
    {
        const auto at = static_cast<std::size_t>(point);
        const auto& columns = program.contacts[at];
        const Eigen::Matrix<double, Forces, 1> force = contactForce.template segment<Forces>(Forces * point);
        const Eigen::Matrix<double, Forces, 1> closing = closingOf(columns, mechanism);
        addForce<Rows, Forces>(columns, -force, unbalanced);
        addPoint<Forces>(force, closing, program.strengthOf(at), program.friction[at], units, residuals,
                         power);
    }
    residuals.balance = std::max(relative(largestOfBody<Rows, Forces>(unbalanced, 1 / lever), units.load),
                                 std::abs(program.liveLoad.dot(mechanism) - liveWork));
    residuals.mismatch =
        relative(std::abs(power.excess), std::max(power.dissipated, std::abs(program.load.dot(mechanism))));
    return residuals;
}

template CoulombResiduals coulombResiduals(const PlaneConeProgram& program, double alpha,
                                           const VectorXd& contactForce, const VectorXd& mechanism,
                                           double liveWork);
template CoulombResiduals coulombResiduals(const SpaceConeProgram& program, double alpha,
                                           const VectorXd& contactForce, const VectorXd& mechanism,
                                           double liveWork);

} // namespace drystone
