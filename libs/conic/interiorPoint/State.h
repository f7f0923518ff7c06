// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the iterations of the interior point know: the program in its form, the iterate, what is left of the
/// optimality conditions, and whether that is an end. Internal to the interior point.
#pragma once

#include "conic/InteriorPoint.h"
#include "conic/form/Form.h"
#include "conic/interiorPoint/Divergence.h"

#include <type_traits>

namespace drystone
{

/// An iterate, or a step between two: forces s and openings z in the cones, displacements y, multiplier.
template<class Scalar>
struct Iterate
{
    VectorOf<Scalar> s;
    VectorOf<Scalar> z;
    VectorOf<Scalar> y;
    Scalar alpha = 0;
};

/// What is left of the optimality conditions.
template<class Scalar>
struct Residuals
{
    VectorOf<Scalar> balance; ///< f + L alpha - M y - B s
    VectorOf<Scalar> opening; ///< g - B'y - z
    Scalar work = 0;          ///< w - L'y
};

/// Largest |entry|.
template<class Scalar>
double largestOf(const VectorOf<Scalar>& values)
{
    return values.size() > 0 ? leading(Scalar(values.template lpNorm<Eigen::Infinity>())) : 0;
}

/// A vector of either precision as doubles; one of doubles as it is.
inline const Eigen::VectorXd& asDoubles(const Eigen::VectorXd& values)
{
    return values;
}
inline Eigen::VectorXd asDoubles(const VectorOf<DoubleDouble>& values)
{
    return values.cast<double>();
}
inline const std::vector<ConeVector<FourDoubles>>& asDoubles(const std::vector<ConeVector<FourDoubles>>& of)
{
    return of;
}
inline std::vector<ConeVector<double>> asDoubles(const std::vector<ConeVector<DoubleDouble>>& of)
{
    std::vector<ConeVector<double>> doubles;
    doubles.reserve(of.size());
    for (const ConeVector<DoubleDouble>& one : of)
    {
        doubles.push_back(one.cast<double>());
    }
    return doubles;
}

/// What a form gives, in numbers of either precision: doubles are not copied.
template<class Scalar>
using Given =
    std::conditional_t<std::is_same_v<Scalar, double>, const Eigen::VectorXd&, const VectorOf<Scalar>>;

/// Tolerance of the scaled residuals, of that of the certificate.
constexpr double ofResiduals = 0.7;

template<int Rows, class Scalar>
class State
{
public:
    State(const Form<Rows>& ofForm, const InteriorPointSettings& toSettings, Sought ofSought);

    const Form<Rows>& form;
    const ConeRanges cones;
    const InteriorPointSettings settings;
    const Sought sought;
    const Given<Scalar> load; ///< of the form, as the next two
    const Given<Scalar> liveLoad;
    const Given<Scalar> gap;

    Iterate<Scalar> at;
    Residuals<Scalar> residuals;
    double mu = 0; ///< complementarity of the iterate
    int waits = 0; ///< iterations that objectives which differ have been given to meet

    /// Brings residuals and complementarity up to date with the iterate.
    void measure();

    double complementarity() const { return complementarityOf(at.s, at.z); }
    double complementarityOf(const VectorOf<Scalar>& s, const VectorOf<Scalar>& z) const
    {
        return cones.degree() > 0 ? leading(Scalar(s.dot(z))) / static_cast<double>(cones.degree()) : 0;
    }
    double forceSize() const { return std::max(1.0, std::abs(leading(at.alpha))); }
    /// What is missing from the balance.
    double missing() const { return largestOf(residuals.balance); }
    double tolerance() const { return ofResiduals * settings.tolerance; }

    /// What the duality gap is compared with, as in Certificate.h.
    double objectiveSize() const;

    /// Whether the scaled residuals meet the tolerance.
    bool isConverged();
    /// Whether all but the balance does.
    bool isBalanceMissing() const
    {
        return form.hasMultiplier() && !form.hasInertia() && isCompatible()
               && missing() > tolerance() * forceSize();
    }
    /// Without a solution the iterates run off along a ray; that ray is then found, and proved, by a program
    /// of its own.
    bool diverges(int iterations) const;
    /// Whether displacements show that nothing balances the loads, but for this error.
    bool isFalling(double error) const;

private:
    bool isCompatible() const;
    bool isObjectiveReached();

    VectorOf<Scalar> rowWork;
};

} // namespace drystone
