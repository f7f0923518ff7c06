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
        const Eigen::Vector3d from = x.template segment<3>(at).template cast<double>();
        const double steepest = steepness(coneFrameOf(from, determinant(from)),
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

double steepestOf(const ConeRanges& cones, const Eigen::VectorXd& x, const Eigen::VectorXd& dx,
                  const std::vector<ConeFrame>& frames, const Eigen::VectorXd& scaled)
{
    // Largest -dx/x of the rays, found without a branch so that it vectorises.
    double steepest =
        cones.rays > 0 ? (-dx.head(cones.rays).array() / x.head(cones.rays).array()).maxCoeff() : 0;
    for (std::size_t round = 0; round < frames.size(); ++round)
    {
        const auto at = static_cast<Eigen::Index>(3 * round);
        steepest = std::max(steepest, steepness(frames[round], scaled.segment<3>(at)).steepest());
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
    pulls.resize(rounds.size());
    frames.resize(rounds.size());
    bool finite = true;
    for (std::size_t round = 0; round < rounds.size(); ++round)
    {
        const Eigen::Index at = cones.at(static_cast<Eigen::Index>(round));
        const ConeVector<Scalar> force = s.template segment<3>(at);
        const ConeVector<Scalar> opening = z.template segment<3>(at);
        rounds[round] = nesterovToddScaling(force, opening);
        weights.rounds[round] = rounds[round].squared(Scalar(rho));
        pulls[round] = weights.rounds[round];
        pulls[round].eigenvalues.array() *= rounds[round].inverse.eigenvalues.array();
        frames[round] =
            coneFrameOf(rounds[round].lambda.template cast<double>(), asDouble(rounds[round].determinant));
        finite = finite && isFinite(weights.rounds[round]);
    }
    return finite;
}

template<class Scalar>
void ConeScaling<Scalar>::scale(const ConeRanges& cones, const VectorOf<Scalar>& ds,
                                const VectorOf<Scalar>& dz, ScaledStep<Scalar>& scaled) const
{
    scaled.forces.resize(3 * cones.rounds);
    scaled.openings.resize(3 * cones.rounds);
    for (std::size_t round = 0; round < rounds.size(); ++round)
    {
        const auto to = static_cast<Eigen::Index>(3 * round);
        const Eigen::Index from = cones.rays + to;
        scaled.forces.template segment<3>(to) = rounds[round].inverse.apply(ds.template segment<3>(from));
        scaled.openings.template segment<3>(to) = rounds[round].W.apply(dz.template segment<3>(from));
    }
}

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
