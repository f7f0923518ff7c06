// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Rays as whole arrays; round cones in packs, several abreast where numbers allow it.
#include "conic/cones/ConeProduct.h"

namespace drystone
{
namespace
{

template<class Scalar>
bool isFinite(const FramedMatrix<Scalar>& matrix)
{
    return std::isfinite(leading(matrix.eigenvalues[0])) && std::isfinite(leading(matrix.eigenvalues[1]))
           && std::isfinite(leading(matrix.eigenvalues[2]));
}

/// One of the matrices of a pack.
template<class Scalar, class Number>
FramedMatrix<Scalar> oneOf(const FramedMatrix<Number>& pack, int one)
{
    return {
        {oneOf(pack.direction[0], one), oneOf(pack.direction[1], one)},
        {oneOf(pack.eigenvalues[0], one), oneOf(pack.eigenvalues[1], one), oneOf(pack.eigenvalues[2], one)}};
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
        cones.rays > 0 ? leading(x.head(cones.rays).minCoeff()) : std::numeric_limits<double>::infinity();
    using Number = Abreast<Scalar>;
    for (Eigen::Index round = 0; round < cones.rounds; round += countOf<Number>)
    {
        const int count = static_cast<int>(std::min<Eigen::Index>(countOf<Number>, cones.rounds - round));
        const Number ofPack = smallerEigenvalue(taken(x, cones.at(round), count));
        for (int one = 0; one < count; ++one)
        {
            smallest = std::min(smallest, leading(oneOf(ofPack, one)));
        }
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
    return leading(sum);
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
        const Eigen::Vector3d by = change.template segment<3>(at).template cast<double>();
        const double steepest = steepness(coneFrameOf(from, determinant(from)), by).steepest();
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

template<class Number>
double steepestOf(const ConeRanges& cones, const Eigen::VectorXd& x, const Eigen::VectorXd& dx,
                  const std::vector<ConeFrame<Number>>& frames, const std::vector<ConeVector<Number>>& scaled)
{
    // Largest -dx/x of the rays, found without a branch so that it vectorises.
    double steepest =
        cones.rays > 0 ? (-dx.head(cones.rays).array() / x.head(cones.rays).array()).maxCoeff() : 0;
    Number ofRounds = steepest;
    for (std::size_t pack = 0; pack < frames.size(); ++pack)
    {
        ofRounds = larger(ofRounds, steepness(frames[pack], scaled[pack]).steepest());
    }
    for (int one = 0; one < countOf<Number>; ++one)
    {
        steepest = std::max(steepest, oneOf(ofRounds, one));
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
    using Number = Abreast<Scalar>;
    const auto packs = static_cast<std::size_t>((cones.rounds + countOf<Number> - 1) / countOf<Number>);
    rounds.resize(packs);
    pulls.resize(packs);
    frames.resize(packs);
    weights.rounds.resize(static_cast<std::size_t>(cones.rounds));
    forPacks<Number>(
        cones.rounds,
        [&](const Pack& pack)
        {
            const Eigen::Index at = cones.at(pack.round);
            NesterovToddScaling<Number>& scaling = rounds[pack.number];
            scaling = nesterovToddScaling(taken(s, at, pack.count), taken(z, at, pack.count));
            pulls[pack.number] = scaling.squared(Number(rho));
            for (int one = 0; one < pack.count; ++one)
            {
                weights.rounds[static_cast<std::size_t>(pack.round + one)] =
                    oneOf<Scalar>(pulls[pack.number], one);
            }
            pulls[pack.number].eigenvalues.array() *= scaling.inverse.eigenvalues.array();
            frames[pack.number] = coneFrameOf<AbreastInDoubles<Scalar>>(
                {leading(scaling.lambda[0]), leading(scaling.lambda[1]), leading(scaling.lambda[2])},
                leading(scaling.determinant));
        });
    return std::all_of(weights.rounds.begin(), weights.rounds.end(), isFinite<Scalar>);
}

template<class Scalar>
void ConeScaling<Scalar>::scale(const ConeRanges& cones, const VectorOf<Scalar>& ds,
                                const VectorOf<Scalar>& dz, ScaledStep<Scalar>& scaled) const
{
    scaled.forces.resize(rounds.size());
    scaled.openings.resize(rounds.size());
    forPacks<Abreast<Scalar>>(cones.rounds,
                              [&](const Pack& pack)
                              {
                                  const Eigen::Index at = cones.at(pack.round);
                                  scaled.forces[pack.number] =
                                      rounds[pack.number].inverse.apply(taken(ds, at, pack.count));
                                  scaled.openings[pack.number] =
                                      rounds[pack.number].W.apply(taken(dz, at, pack.count));
                              });
}

template<class Scalar>
void ScaledStep<Scalar>::add(const ScaledStep& correction, double ofForces, double ofOpenings)
{
    using Number = Abreast<Scalar>;
    for (std::size_t pack = 0; pack < forces.size(); ++pack)
    {
        forces[pack] += Number(ofForces) * correction.forces[pack];
        openings[pack] += Number(ofOpenings) * correction.openings[pack];
    }
}

template struct ConeScaling<double>;
template struct ConeScaling<DoubleDouble>;
template struct ScaledStep<double>;
template struct ScaledStep<DoubleDouble>;
template double steepestOf(const ConeRanges&, const Eigen::VectorXd&, const Eigen::VectorXd&,
                           const std::vector<ConeFrame<FourDoubles>>&,
                           const std::vector<ConeVector<FourDoubles>>&);
template double steepestOf(const ConeRanges&, const Eigen::VectorXd&, const Eigen::VectorXd&,
                           const std::vector<ConeFrame<double>>&, const std::vector<ConeVector<double>>&);
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
