// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Newton's equations of the interior point: one factorisation, and the steps that are solved for with it.
/// Internal to the interior point.
#pragma once

#include "conic/interiorPoint/State.h"

namespace drystone
{

/// What an iterate's rounding requires in the arithmetic it is done in.
struct Regularisation
{
    double proximal;        ///< on the diagonal of the scaled Schur system
    double compliance;      ///< on the cones, over the square of the largest force; 0: none
    double leastRounding;   ///< share that the diagonal is raised by where a pivot is not positive,
    double largestRounding; ///< ten times as much at each attempt, up to here
    double evenFlexibility; ///< largest flexibility when forces are balanced that are right but for that
    int balancings;         ///< at most, of these
};

/// Without the proximal term the factorisation fails near the optimum, where bodies of the mechanism are held
/// by nothing but the forces that vanish there. Refinement takes its effect out of the steps. Where a point
/// presses, s / z grows without limit, and with it the rounding of the system; a compliance rho spoils the
/// steps where rho s exceeds z = mu / s, so it is a number over the square of the largest force: harmless
/// down to a mu of this order. Flexibilities of 1e8 leave the system no longer definite for rounding.
template<class Scalar>
inline constexpr Regularisation regularisation{1e-9, 1e-10, 1e-15, 1e-6, 1e5, 4};
template<>
inline constexpr Regularisation regularisation<DoubleDouble>{1e-28, 0, 1e-31, 1e-24, 1e5, 0};

/// With R the fraction of the residuals to remove and p a pull on s and z:
///
///     M dy + B ds - L da = R balance,  B'dy + dz = R opening,  L'dy = R work,  (W^-2 + rho) ds + dz = p.
///
/// W is the scaling of Nesterov & Todd, W z = W^-1 s = lambda; the last line follows from the wish that the
/// product (lambda + W^-1 ds) o (lambda + W dz) change by c, with p = W^-1 (lambda \ c): on a ray W^-2 = z/s
/// and p = c/s. With D = (W^-2 + rho)^-1:  ds = D (p - R opening + B'dy), so
///
///     (M + B D B') dy - L da = R balance - B D (p - R opening).
template<int Rows, class Scalar>
class NewtonSystem
{
public:
    using Vector = VectorOf<Scalar>;

    NewtonSystem(State<Rows, Scalar>& ofState, SchurSystem<Rows, Scalar>& withSystem)
        : state(ofState), system(withSystem)
    {
    }

    ConeScaling<Scalar> scaling; ///< of the iterate
    int factorisations = 0;
    int solves = 0;

    /// Forgets what pivots were raised by. \param coneCompliance as Regularisation has it
    void begin(double coneCompliance);
    bool isCompliant() const { return compliance > 0; }

    /// Factorises the Schur system of the iterate. \return false where it is not definite
    bool factorise();

    /// The step straight for the optimum: R = 1 and c = -lambda o lambda. S^-1 L comes with it.
    void predict(Iterate<Scalar>& step);

    /// A step with R = 0. \param weightedPull D p, used up
    void correct(Vector& weightedPull, Iterate<Scalar>& step);

    /// The least forces that balance the load, and the least openings that are compatible: Mehrotra's start,
    /// not yet inside the cones. Needs a factorisation at s = z = e.
    void leastSquares(Iterate<Scalar>& at);

    /// Newton's steps lose the balance in the end: they change forces that press by D B'dy with D = s/z =
    /// s^2/mu, while a rest r of the balance makes a dy of r/mu along the mechanism, whose rounding alone
    /// leaves more than r below a mu of about 1e-8 s. When all but the balance meets the tolerance, the
    /// forces need no more than a small change that balances them, and nearly any will do: the least one in
    /// the metric of V = min(D, a constant), in which forces that press are alike and those that open still
    /// hardly change,
    ///
    ///     B V B' dy - L da = r,  L'dy = 0,  ds = V B'dy.
    ///
    /// \return whether all residuals meet the tolerance then; else nothing is changed
    bool repairBalance();
    bool mayRepairBalance() const { return repairs < regularisation<Scalar>.balancings; }

    /// Forces that balance f alone, without the live load: those of the iterate are changed by the least, in
    /// the metric of D, that does so, s + D B' S^-1 (f - B s); what comes out outside the cones is reflected,
    /// farther than it is out, for the next pass takes most of that back; and so on. Alternating projections
    /// find a point in the interior of the intersection in finitely many passes (Bauschke & Borwein 1996),
    /// each of which costs a solve. To know none costs a program of its own, some three factorisations: where
    /// these are expensive compared with solves, more passes are worth it. \param iteration 0 or 1
    /// \return s, or an empty vector
    Vector forcesOfLoadAlone(int iteration);

    double factorisationOverSolve() const { return system.factorisationOverSolve(); }

private:
    void finishStep(double reduction, Iterate<Scalar>& step);
    void solve(Vector& x);
    void solve(Vector& one, Vector& other);
    void solveRoughly(Vector& x);
    Scalar takeLiveWork(Vector& y) const;

    State<Rows, Scalar>& state;
    SchurSystem<Rows, Scalar>& system;
    Vector liveSolution;      ///< S^-1 L
    Scalar liveStiffness = 0; ///< L' S^-1 L
    double compliance = 0;
    double rounding = 0; ///< share that the diagonal of the Schur system is raised by
    int repairs = 0;
    Vector weighted, remainder, rowWork;
};

} // namespace drystone
