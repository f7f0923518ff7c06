// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/cones/ConeProduct.h"

#include "linear/DoubleDouble.h"

namespace drystone
{
namespace
{

double asDouble(double value)
{
    return value;
}
double asDouble(const DoubleDouble& value)
{
    return value.high;
}

template<class Scalar>
bool isFinite(const FramedMatrix<Scalar>& matrix)
{
    return std::isfinite(asDouble(matrix.eigenvalues[0])) && std::isfinite(asDouble(matrix.eigenvalues[1]))
           && std::isfinite(asDouble(matrix.eigenvalues[2]));
}

} // namespace

template<class Scalar>
bool ConeWeights<Scalar>::allFinite() const
{
    return std::all_of(rounds.begin(), rounds.end(), isFinite<Scalar>);
}

template<class Scalar>
VectorOf<Scalar> unitOf(const ConeRanges& cones)
{
    VectorOf<Scalar> unit = VectorOf<Scalar>::Constant(cones.size(), Scalar(0));
    addUnits(cones, 1, unit);
    return unit;
}

template<class Scalar>
double smallestEigenvalue(const ConeRanges& cones, const VectorOf<Scalar>& x)
{
    double smallest =
        cones.rays > 0 ? asDouble(x.head(cones.rays).minCoeff()) : std::numeric_limits<double>::infinity();
    for (Eigen::Index round = 0; round < cones.rounds; ++round)
    {
        const ConeVector<Scalar> part = x.template segment<3>(cones.at(round));
        smallest = std::min(smallest, asDouble(smallerEigenvalue(part)));
    }
    return cones.degree() > 0 ? smallest : 0;
}

template<class Scalar>
void addUnits(const ConeRanges& cones, double share, VectorOf<Scalar>& x)
{
    x.head(cones.rays).array() += Scalar(share);
    for (Eigen::Index round = 0; round < cones.rounds; ++round)
    {
        x[cones.at(round)] += Scalar(share);
    }
}

template<class Scalar>
double sumAlongUnit(const ConeRanges& cones, const VectorOf<Scalar>& x)
{
    Scalar sum = cones.rays > 0 ? Scalar(x.head(cones.rays).sum()) : Scalar(0);
    for (Eigen::Index round = 0; round < cones.rounds; ++round)
    {
        sum += x[cones.at(round)];
    }
    return asDouble(sum);
}

template<class Scalar>
void keepInside(const ConeRanges& cones, VectorOf<Scalar>& x)
{
    const Scalar beyond = 1 + 4 * Scalar(Eigen::NumTraits<Scalar>::epsilon());
    for (Eigen::Index round = 0; round < cones.rounds; ++round)
    {
        const Eigen::Index at = cones.at(round);
        const Scalar least = x.template segment<2>(at + 1).norm() * beyond + Scalar(1e-300);
        if (x[at] < least)
        {
            x[at] = least;
        }
    }
}

template<class Scalar>
void addWithin(const ConeRanges& cones, const VectorOf<Scalar>& change, VectorOf<Scalar>& x)
{
    constexpr double part = 0.1; // of how far inside x is
    x.head(cones.rays) =
        (x.head(cones.rays) + change.head(cones.rays)).cwiseMax(Scalar(part) * x.head(cones.rays)).eval();
    for (Eigen::Index round = 0; round < cones.rounds; ++round)
    {
        const Eigen::Index at = cones.at(round);
        const double steepest = roundSteepness(x.template segment<3>(at).template cast<double>(),
                                               change.template segment<3>(at).template cast<double>())
                                    .steepest();
        x.template segment<3>(at) +=
            Scalar(1 / std::max(1.0, steepest / (1 - part))) * change.template segment<3>(at);
    }
}

template<class Scalar>
void reflectInside(const ConeRanges& cones, double reflection, VectorOf<Scalar>& x)
{
    const auto reflected = [reflection](const Scalar& value)
    { return value < Scalar(0) ? Scalar(Scalar(-reflection) * value) : value; };
    for (Eigen::Index ray = 0; ray < cones.rays; ++ray)
    {
        x[ray] = reflected(x[ray]);
    }
    for (Eigen::Index round = 0; round < cones.rounds; ++round)
    {
        const ConeVector<Scalar> part = x.template segment<3>(cones.at(round));
        if (smallerEigenvalue(part) < Scalar(0))
        {
            x.template segment<3>(cones.at(round)) = onEigenvalues(part, reflected);
        }
    }
}

RoundSteepness roundSteepness(const Eigen::Vector3d& x, const Eigen::Vector3d& dx)
{
    const double radius = x.tail<2>().norm();
    const Eigen::Vector2d direction = directionOf(x, radius);
    const double along = direction.dot(dx.tail<2>());
    const double across = direction[0] * dx[2] - direction[1] * dx[1];
    const double larger = x[0] + radius;
    const double smaller = x[0] - radius;
    return {(dx[0] + along) / larger, (dx[0] - along) / smaller, across / std::sqrt(larger * smaller)};
}

double steepestOf(const ConeRanges& cones, const Eigen::VectorXd& x, const Eigen::VectorXd& dx)
{
    // Largest -dx/x of the rays, found without a branch so that it vectorises.
    double steepest =
        cones.rays > 0 ? (-dx.head(cones.rays).array() / x.head(cones.rays).array()).maxCoeff() : 0;
    for (Eigen::Index round = 0; round < cones.rounds; ++round)
    {
        const Eigen::Index at = cones.at(round);
        steepest = std::max(steepest, roundSteepness(x.segment<3>(at), dx.segment<3>(at)).steepest());
    }
    return steepest;
}

template<class Scalar>
bool ConeScaling<Scalar>::update(const ConeRanges& cones, const VectorOf<Scalar>& s,
                                 const VectorOf<Scalar>& z, double rho)
{
    const auto rayForces = s.head(cones.rays);
    const auto rayOpenings = z.head(cones.rays);
    flexibility = (rayOpenings + Scalar(rho) * rayForces).cwiseInverse();
    weights.rays = rayForces.cwiseProduct(flexibility);
    rounds.resize(static_cast<std::size_t>(cones.rounds));
    weights.rounds.resize(rounds.size());
    bool finite = true;
    for (std::size_t round = 0; round < rounds.size(); ++round)
    {
        const Eigen::Index at = cones.at(static_cast<Eigen::Index>(round));
        const ConeVector<Scalar> force = s.template segment<3>(at);
        const ConeVector<Scalar> opening = z.template segment<3>(at);
        rounds[round] = nesterovToddScaling(force, opening);
        weights.rounds[round] = rounds[round].squared(Scalar(rho));
        finite = finite && isFinite(weights.rounds[round]);
    }
    return finite;
}

template struct ConeWeights<double>;
template struct ConeWeights<DoubleDouble>;
template struct ConeScaling<double>;
template struct ConeScaling<DoubleDouble>;
template VectorOf<double> unitOf<double>(const ConeRanges&);
template VectorOf<DoubleDouble> unitOf<DoubleDouble>(const ConeRanges&);
template double smallestEigenvalue(const ConeRanges&, const VectorOf<double>&);
template double smallestEigenvalue(const ConeRanges&, const VectorOf<DoubleDouble>&);
template void addUnits(const ConeRanges&, double, VectorOf<double>&);
template void addUnits(const ConeRanges&, double, VectorOf<DoubleDouble>&);
template double sumAlongUnit(const ConeRanges&, const VectorOf<double>&);
template double sumAlongUnit(const ConeRanges&, const VectorOf<DoubleDouble>&);
template void addWithin(const ConeRanges&, const VectorOf<double>&, VectorOf<double>&);
template void addWithin(const ConeRanges&, const VectorOf<DoubleDouble>&, VectorOf<DoubleDouble>&);
template void reflectInside(const ConeRanges&, double, VectorOf<double>&);
template void reflectInside(const ConeRanges&, double, VectorOf<DoubleDouble>&);
template void keepInside(const ConeRanges&, VectorOf<double>&);
template void keepInside(const ConeRanges&, VectorOf<DoubleDouble>&);

} // namespace drystone
