// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Mehrotra's start, complementarity smoothed on eigenvalues, and a kept iterate moved on with the blocks.
#include "conic/interiorPoint/Starts.h"

#include "conic/form/FormOperators.h"

namespace drystone
{
namespace
{

/// Of a start near a solution, times the square of its error, and within these.
constexpr double complementarityOfNear = 0.1;
constexpr double leastOfNear = 1e-6;
constexpr double largestOfNear = 1e-2;

/// An opening that the displacements make larger than so much of what was kept is taken from them, within:
constexpr double partOfOpening = 0.5;
constexpr double largestOpening = 10; // times what was kept

/// Moves x inside its cones by half as much again as it lies outside.
template<class Scalar>
void pushInside(const ConeRanges& cones, VectorOf<Scalar>& x)
{
    addUnits(cones, std::max(0.0, -1.5 * smallestEigenvalue(cones, x)), x);
}

/// The force and the opening of an eigenvalue d of s - z for the product mu, without cancellation.
struct Smoothed
{
    double force;
    double opening;
};

Smoothed smoothed(double difference, double mu)
{
    const double larger = 0.5 * (std::sqrt(difference * difference + 4 * mu) + std::abs(difference));
    const double force = difference > 0 ? larger : mu / larger;
    return {force, mu / force};
}

/// The products s z of the cones that a start has, which new ones get on average.
struct KnownProducts
{
    double sum = 0;
    Eigen::Index count = 0;

    void add(double product)
    {
        sum += product;
        ++count;
    }
    double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0; }
};

bool isKnownRay(const Iterate<double>& at, Eigen::Index ray)
{
    return at.s[ray] > 0 && at.z[ray] > 0;
}

bool isKnownRound(const Iterate<double>& at, Eigen::Index first)
{
    return smallerEigenvalue<double>(at.s.segment<3>(first)) > 0
           && smallerEigenvalue<double>(at.z.segment<3>(first)) > 0;
}

/// Openings z follow those of the displacements where these are larger.
void followOpeningOfRays(const ConeRanges& cones, const Eigen::VectorXd& opening, Iterate<double>& at,
                         KnownProducts& known)
{
    for (Eigen::Index ray = 0; ray < cones.rays; ++ray)
    {
        if (isKnownRay(at, ray))
        {
            if (opening[ray] > partOfOpening * at.z[ray])
            {
                at.z[ray] = std::min(opening[ray], largestOpening * at.z[ray]);
            }
            known.add(at.s[ray] * at.z[ray]);
        }
    }
}

void followOpeningOfRounds(const ConeRanges& cones, const Eigen::VectorXd& opening, Iterate<double>& at,
                           KnownProducts& known)
{
    for (Eigen::Index round = 0; round < cones.rounds; ++round)
    {
        const Eigen::Index first = cones.at(round);
        if (isKnownRound(at, first))
        {
            const ConeVector<double> ofDisplacements = opening.segment<3>(first);
            const double kept = smallerEigenvalue<double>(at.z.segment<3>(first));
            if (smallerEigenvalue(ofDisplacements) > partOfOpening * kept)
            {
                at.z.segment<3>(first) =
                    ofDisplacements * std::min(1.0, largestOpening * at.z[first] / ofDisplacements[0]);
            }
            known.add(at.s.segment<3>(first).dot(at.z.segment<3>(first)));
        }
    }
}

/// Cones that are new are as open as the displacements say, and have the force for which their product is mu.
void beginNewCones(const ConeRanges& cones, const Eigen::VectorXd& opening, double mu, Iterate<double>& at)
{
    for (Eigen::Index ray = 0; ray < cones.rays; ++ray)
    {
        if (!isKnownRay(at, ray))
        {
            at.z[ray] = std::max(opening[ray], std::sqrt(mu));
            at.s[ray] = mu / at.z[ray];
        }
    }
    for (Eigen::Index round = 0; round < cones.rounds; ++round)
    {
        const Eigen::Index first = cones.at(round);
        if (!isKnownRound(at, first))
        {
            const ConeVector<double> ofDisplacements = opening.segment<3>(first);
            at.z.segment<3>(first) =
                onEigenvalues(ofDisplacements, [mu](double value) { return std::max(value, std::sqrt(mu)); });
            at.s.segment<3>(first) = onEigenvalues(ofDisplacements, [mu](double value)
                                                   { return mu / std::max(value, std::sqrt(mu)); });
        }
    }
}

} // namespace

template<int Rows, class Scalar>
bool startFrom(Start from, State<Rows, Scalar>& state, NewtonSystem<Rows, Scalar>& newton)
{
    const ConeRanges& cones = state.cones;
    Iterate<Scalar>& at = state.at;
    at.s = unitOf<Scalar>(cones);
    at.z = at.s;
    at.y = VectorOf<Scalar>::Constant(state.load.size(), Scalar(0));
    at.alpha = 0;
    state.mu = 1;
    state.waits = 0;
    newton.begin(from == Start::leastSquares ? regularisation<Scalar>.compliance : 0);
    if (cones.degree() == 0 || from == Start::unit)
    {
        return true;
    }
    if (!newton.factorise())
    {
        return false;
    }
    newton.leastSquares(at);
    pushInside(cones, at.s);
    pushInside(cones, at.z);
    const double product = leading(Scalar(at.s.dot(at.z)));
    const double sSum = sumAlongUnit(cones, at.s);
    const double zSum = sumAlongUnit(cones, at.z);
    const double sLargest = leading(Scalar(at.s.maxCoeff()));
    const double zLargest = leading(Scalar(at.z.maxCoeff()));
    // Openings of a step in time are of order one: smaller ones, of gaps that rounding leaves, say nothing.
    const double zLeast = state.form.hasInertia() ? 1e-2 : 0;
    addUnits(cones, std::max(zSum > 0 ? 0.5 * product / zSum : 0, 1e-2 * sLargest + 1e-2), at.s);
    addUnits(cones, std::max(sSum > 0 ? 0.5 * product / sSum : 0, zSum > 0 ? 1e-2 * zLargest + zLeast : 1.0),
             at.z);
    return true;
}

template<int Rows>
void startNear(const Eigen::VectorXd& s, const Eigen::VectorXd& y, double error, State<Rows, double>& state)
{
    const ConeRanges& cones = state.cones;
    const double mu = std::clamp(complementarityOfNear * error * error, leastOfNear, largestOfNear);
    Iterate<double>& at = state.at;
    at.y = y;
    at.alpha = 0;
    state.mu = 1;
    state.waits = 0;
    Eigen::VectorXd closing;
    applyTransposed(state.form, y, closing);
    const Eigen::VectorXd difference = s - (state.gap - closing);
    at.s.resize(cones.size());
    at.z.resize(cones.size());
    const Eigen::ArrayXd ofRays = difference.head(cones.rays);
    const Eigen::ArrayXd sum = (ofRays.square() + 4 * mu).sqrt();
    const Eigen::ArrayXd larger = 0.5 * (sum + ofRays.abs());
    at.s.head(cones.rays) = (ofRays > 0).select(larger, mu / larger); // without cancellation
    at.z.head(cones.rays) = mu / at.s.head(cones.rays).array();
    for (Eigen::Index round = 0; round < cones.rounds; ++round)
    {
        const Eigen::Index first = cones.at(round);
        const ConeVector<double> ofRound = difference.segment<3>(first);
        at.s.segment<3>(first) =
            onEigenvalues(ofRound, [mu](double value) { return smoothed(value, mu).force; });
        at.z.segment<3>(first) =
            onEigenvalues(ofRound, [mu](double value) { return smoothed(value, mu).opening; });
    }
}

template<int Rows>
bool startInside(Iterate<double> interior, const Eigen::VectorXd& displacement, State<Rows, double>& state)
{
    const ConeRanges& cones = state.cones;
    Iterate<double>& at = state.at;
    at = std::move(interior);
    at.y += displacement;
    at.alpha = 0;
    state.mu = 1;
    state.waits = 0;
    Eigen::VectorXd opening;
    applyTransposed(state.form, at.y, opening);
    opening = state.gap - opening;

    KnownProducts known;
    followOpeningOfRays(cones, opening, at, known);
    followOpeningOfRounds(cones, opening, at, known);
    const double mu = known.mean();
    if (2 * known.count < cones.degree() || !(mu > 0.01 * complementarityOfInterior)
        || !(mu < 100 * complementarityOfInterior))
    {
        return false;
    }
    beginNewCones(cones, opening, mu, at);
    return true;
}

template bool startFrom(Start, State<3, double>&, NewtonSystem<3, double>&);
template bool startFrom(Start, State<6, double>&, NewtonSystem<6, double>&);
template bool startFrom(Start, State<3, DoubleDouble>&, NewtonSystem<3, DoubleDouble>&);
template bool startFrom(Start, State<6, DoubleDouble>&, NewtonSystem<6, DoubleDouble>&);
template void startNear(const Eigen::VectorXd&, const Eigen::VectorXd&, double, State<3, double>&);
template void startNear(const Eigen::VectorXd&, const Eigen::VectorXd&, double, State<6, double>&);
template bool startInside(Iterate<double>, const Eigen::VectorXd&, State<3, double>&);
template bool startInside(Iterate<double>, const Eigen::VectorXd&, State<6, double>&);

} // namespace drystone
