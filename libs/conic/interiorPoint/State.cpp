// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What is left of balance, openings and work, each compared with the size of its own terms.
#include "conic/interiorPoint/State.h"

#include "conic/form/FormOperators.h"

namespace drystone
{
namespace
{

template<class Scalar>
Given<Scalar> inNumbers(const Eigen::VectorXd& given)
{
    if constexpr (std::is_same_v<Scalar, double>)
    {
        return given;
    }
    else
    {
        return given.template cast<Scalar>();
    }
}

} // namespace

template<int Rows, class Scalar>
State<Rows, Scalar>::State(const Form<Rows>& ofForm, const InteriorPointSettings& toSettings, Sought ofSought)
    : form(ofForm),
      cones(ofForm.cones()),
      settings(toSettings),
      sought(ofSought),
      load(inNumbers<Scalar>(ofForm.load)),
      liveLoad(inNumbers<Scalar>(ofForm.liveLoad)),
      gap(inNumbers<Scalar>(ofForm.gap))
{
}

template<int Rows, class Scalar>
void State<Rows, Scalar>::measure()
{
    VectorOf<Scalar>& balance = residuals.balance;
    balance = load;
    if (form.hasMultiplier())
    {
        balance += at.alpha * liveLoad;
        residuals.work = Scalar(form.liveWork) - liveLoad.dot(at.y);
    }
    rowWork.setConstant(balance.size(), Scalar(0));
    addForces(form, at.s, rowWork);
    addInertia(form, at.y, rowWork);
    balance -= rowWork;
    applyTransposed(form, at.y, residuals.opening);
    residuals.opening = gap - residuals.opening - at.z;
    mu = complementarity();
}

template<int Rows, class Scalar>
double State<Rows, Scalar>::objectiveSize() const
{
    if (form.hasMultiplier())
    {
        return std::max(form.liveWork * std::max(1e-3, std::abs(leading(at.alpha))),
                        std::abs(leading(Scalar(load.dot(at.y)))));
    }
    if (form.hasInertia())
    {
        return std::max(1.0, leading(Scalar(load.cwiseProduct(at.y).template lpNorm<1>())));
    }
    return std::max(1e-3 * largestOf(gap), std::abs(leading(Scalar(load.dot(at.y)))));
}

template<int Rows, class Scalar>
bool State<Rows, Scalar>::isConverged()
{
    if (!form.hasMultiplier() && !form.hasInertia() && form.gap.isZero(0))
    {
        return missing() <= tolerance(); // any forces will do: y = 0 completes them
    }
    if (sought == Sought::fall && leading(Scalar(at.s.dot(at.z))) <= complementarityOfFall * objectiveSize()
        && isFalling(0.1 * settings.tolerance))
    {
        return true;
    }
    return missing() <= tolerance() * forceSize() && isCompatible()
           && (!form.hasMultiplier() || isObjectiveReached());
}

/// Whether the displacements are those of a mechanism, and nothing that presses opens.
template<int Rows, class Scalar>
bool State<Rows, Scalar>::isCompatible() const
{
    const double displacement = std::max({largestOf(at.y), largestOf(gap), form.hasInertia() ? 1.0 : 0.0});
    return largestOf(residuals.opening) <= tolerance() * displacement
           && std::abs(leading(residuals.work)) <= tolerance() * std::max(1.0, form.liveWork)
           && leading(Scalar(at.s.dot(at.z))) <= tolerance() * objectiveSize();
}

/// What is left of the balance does work on the displacements, and where these are large it keeps the
/// objectives apart, alpha w and g's - f'y, which the certificate compares. A few more iterations repair
/// that, or rounding does not let them.
template<int Rows, class Scalar>
bool State<Rows, Scalar>::isObjectiveReached()
{
    constexpr int mostWaits = 3;
    const Scalar apart = Scalar(form.liveWork) * at.alpha + load.dot(at.y) - gap.dot(at.s);
    return std::abs(leading(apart)) <= tolerance() * objectiveSize() || ++waits > mostWaits;
}

template<int Rows, class Scalar>
bool State<Rows, Scalar>::diverges(int iterations) const
{
    const IterateSizes sizes{.displacement = largestOf(at.y),
                             .force = largestOf(at.s),
                             .balance = missing(),
                             .multiplier = leading(at.alpha)};
    return runsOff(sizes) || (!form.hasInertia() && runsOffSlowly(sizes, iterations));
}

/// -B'y = z + r - g misses the cones by no more than r - g does, where r is what is left of the openings.
template<int Rows, class Scalar>
bool State<Rows, Scalar>::isFalling(double error) const
{
    double closing = 0;
    if (cones.degree() > 0)
    {
        const VectorOf<Scalar> beside = residuals.opening - gap;
        closing = std::max(0.0, -smallestEigenvalue(cones, beside));
    }
    return isFall(form.load, form.liveLoad, asDoubles(at.y), closing,
                  leading(Scalar(form.liveWork - residuals.work)), error);
}

template class State<3, double>;
template class State<6, double>;
template class State<3, DoubleDouble>;
template class State<6, DoubleDouble>;

} // namespace drystone
