// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The interior-point solver for contact points of space, where friction cones are round.
#include "conic/Certificate.h"
#include "conic/Divergence.h"
#include "conic/InteriorPoint.h"
#include "conic/SecondOrderCone.h"
#include "conic/SpaceForm.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

using Eigen::Vector3d;
using Eigen::VectorXd;

/// As in the plane: on the diagonal of the scaled Schur system, and on the forces over the square of the
/// largest; see InteriorPoint.cpp.
constexpr double proximal = 1e-9;
constexpr double compliance = 1e-10;

/// Complementarity above which a Newton step needs no refinement.
constexpr double firmComplementarity = 1e-6;
constexpr int mostRefinements = 5;

/// An iterate, or a step between two: forces s and openings z in the cones, displacements y, multiplier.
struct Iterate
{
    VectorXd s;
    VectorXd z;
    VectorXd y;
    double alpha = 0;
};

/// Where to begin.
enum class Start
{
    leastSquares, ///< Mehrotra's; with `compliance`
    unit          ///< all forces and openings e, no compliance
};

/// What is left of the optimality conditions.
struct Residuals
{
    VectorXd balance; ///< f + L alpha - M y - B s
    VectorXd opening; ///< g - B'y - z
    double work = 0;  ///< w - L'y
};

class SpaceInteriorPoint
{
public:
    SpaceInteriorPoint(const SpaceForm& form, SchurSystem<6>& system, const InteriorPointSettings& settings,
                       Sought sought)
        : form_(form),
          system_(system),
          settings_(settings),
          sought_(sought),
          scaling_(form.points.size()),
          d_(form.points.size())
    {
    }

    /// Iterates until the scaled residuals meet the tolerance. \return whether they did
    bool run(Start from);

    const Iterate& iterate() const { return at_; }

    /// Whether the last iterations ended with displacements that show that nothing balances the loads.
    bool falls() const { return falls_; }

    /// Whether they ended with a multiplier so large that there may be no largest one.
    bool grows() const { return grows_; }
    int iterations() const { return iterations_; }
    int factorisations() const { return factorisations_; }
    int solves() const { return solves_; }

private:
    bool start(Start from);
    void computeResiduals();
    bool factorise();
    void solveSchur(VectorXd& x);
    void solveNewton(const VectorXd& pull, Iterate& step);
    VectorXd pullTowards(double aim, const Iterate& predictor) const;
    VectorXd widen(const VectorXd& pull, const Iterate& step, double aim, double primal, double dual) const;
    double stepToBoundary(const VectorXd& x, const VectorXd& dx) const;
    double complementarity() const { return form_.pointCount() ? at_.s.dot(at_.z) / form_.pointCount() : 0; }
    double objectiveSize() const;
    bool converged() const;
    bool diverges() const;
    bool isFalling(double error) const;

    const SpaceForm& form_;
    SchurSystem<6>& system_;
    InteriorPointSettings settings_;
    Sought sought_;
    Iterate at_;
    Residuals residuals_;
    std::vector<NesterovToddScaling> scaling_;
    std::vector<FramedMatrix> d_; ///< (W^-2 + rho I)^-1
    VectorXd liveSolution_;       ///< S^-1 L
    double liveStiffness_ = 0;    ///< L' S^-1 L
    double compliance_ = 0;
    double mu_ = 0; ///< complementarity of the iterate
    bool falls_ = false;
    bool grows_ = false;
    int iterations_ = 0;
    int factorisations_ = 0;
    int solves_ = 0;
    VectorXd coneWork_, coneWork2_, remainder_;
};

double SpaceInteriorPoint::stepToBoundary(const VectorXd& x, const VectorXd& dx) const
{
    double step = 1;
    for (Eigen::Index row = 0; row < x.size(); row += 3)
    {
        step = std::min(step, stepToConeSurface(x.segment<3>(row), dx.segment<3>(row)));
    }
    return step;
}

void SpaceInteriorPoint::computeResiduals()
{
    VectorXd& balance = residuals_.balance;
    balance.setZero(form_.load.size());
    addForces(form_, at_.s, balance);
    addInertia(form_, at_.y, balance);
    balance = form_.load - balance;
    if (form_.hasMultiplier())
    {
        balance += at_.alpha * form_.liveLoad;
        residuals_.work = form_.liveWork - form_.liveLoad.dot(at_.y);
    }
    applyTransposed(form_, at_.y, coneWork_);
    residuals_.opening = form_.gap - coneWork_ - at_.z;
}

/// What the gap is compared with, as in Certificate.h.
double SpaceInteriorPoint::objectiveSize() const
{
    return form_.hasMultiplier() ? std::max(form_.liveWork * std::max(1e-3, std::abs(at_.alpha)),
                                            std::abs(form_.load.dot(at_.y)))
                                 : 1.0;
}

bool SpaceInteriorPoint::converged() const
{
    const double tolerance = 0.5 * settings_.tolerance;
    const double balance = residuals_.balance.lpNorm<Eigen::Infinity>();
    if (!form_.hasMultiplier() && !form_.hasInertia() && form_.gap.isZero(0))
    {
        return balance <= tolerance; // any forces will do: y = 0 completes them
    }
    if (sought_ == Sought::fall && at_.s.dot(at_.z) <= complementarityOfFall * objectiveSize()
        && isFalling(0.1 * settings_.tolerance))
    {
        return true;
    }
    const double displacement =
        std::max({at_.y.lpNorm<Eigen::Infinity>(), form_.gap.lpNorm<Eigen::Infinity>(),
                  form_.hasInertia() ? 1.0 : 0.0});
    return balance <= tolerance * std::max(1.0, std::abs(at_.alpha))
           && residuals_.opening.lpNorm<Eigen::Infinity>() <= tolerance * displacement
           && std::abs(residuals_.work) <= tolerance * std::max(1.0, form_.liveWork)
           && at_.s.dot(at_.z) <= tolerance * objectiveSize();
}

/// Without a solution the iterates run off along a ray, which a program of its own then proves.
bool SpaceInteriorPoint::diverges() const
{
    return runsOff(iterations_, at_.y.lpNorm<Eigen::Infinity>(), at_.s.lpNorm<Eigen::Infinity>(),
                   residuals_.balance.lpNorm<Eigen::Infinity>(), at_.alpha, form_.hasInertia());
}

bool SpaceInteriorPoint::isFalling(double error) const
{
    // -B'y = z + r - g misses the cones by no more than r - g does.
    double closing = 0;
    for (Eigen::Index row = 0; row < at_.s.size(); row += 3)
    {
        const Eigen::Vector3d beside = residuals_.opening.segment<3>(row) - form_.gap.segment<3>(row);
        closing = std::max(closing, beside.tail<2>().norm() - beside[0]);
    }
    return isFall(form_.load, form_.liveLoad, at_.y, closing, form_.liveWork - residuals_.work, error);
}

bool SpaceInteriorPoint::factorise()
{
    const double force = std::max(1.0, at_.s.lpNorm<Eigen::Infinity>());
    for (std::size_t point = 0; point < scaling_.size(); ++point)
    {
        const auto row = 3 * static_cast<Eigen::Index>(point);
        scaling_[point] = nesterovToddScaling(at_.s.segment<3>(row), at_.z.segment<3>(row));
        d_[point] = scaling_[point].squared(compliance_ / (force * force));
        if (!d_[point].eigenvalues.allFinite())
        {
            return false;
        }
    }
    // Cancellation may make a pivot negative: then each is raised by what rounding may have taken from it.
    double rounding = 0;
    do
    {
        if (rounding > 1e-6)
        {
            return false;
        }
        assembleSchur(form_, d_, proximal, rounding, system_);
        ++factorisations_;
        rounding = rounding == 0 ? 1e-15 : 10 * rounding;
    } while (!system_.factorise());
    if (form_.hasMultiplier())
    {
        liveSolution_ = form_.liveLoad;
        solveSchur(liveSolution_);
        liveStiffness_ = form_.liveLoad.dot(liveSolution_);
    }
    return true;
}

void SpaceInteriorPoint::solveSchur(VectorXd& x)
{
    system_.solve(x.head(6 * form_.bodies));
    ++solves_;
}

/// Newton's equations in the scaling W of Nesterov and Todd, W z = W^-1 s = lambda. From lambda o (W dz +
/// W^-1 ds) = c follows W^-2 ds + dz = p with the pull p = W^-1 (lambda \ c), and with the compliance rho
///     M dy + B ds - L da = balance,   B'dy + dz = opening,   L'dy = work,   (W^-2 + rho) ds + dz = p.
/// With D = (W^-2 + rho)^-1:  ds = D (p - opening + B'dy), so  (M + B D B') dy - L da = balance - B D (p -
/// opening).
void SpaceInteriorPoint::solveNewton(const VectorXd& pull, Iterate& step)
{
    const auto byD = [this](VectorXd& x)
    {
        for (std::size_t point = 0; point < d_.size(); ++point)
        {
            auto part = x.segment<3>(3 * static_cast<Eigen::Index>(point));
            part = d_[point].apply(part);
        }
    };
    step.s = pull - residuals_.opening;
    byD(step.s);
    step.y = VectorXd::Zero(form_.load.size());
    addForces(form_, step.s, step.y);
    step.y = residuals_.balance - step.y;
    step.y.tail<6>().setZero();
    solveSchur(step.y);
    step.alpha = 0;
    if (form_.hasMultiplier())
    {
        step.alpha = (residuals_.work - form_.liveLoad.dot(step.y)) / liveStiffness_;
        step.y += step.alpha * liveSolution_;
    }
    applyTransposed(form_, step.y, coneWork_);
    coneWork2_ = coneWork_;
    byD(coneWork2_);
    step.s += coneWork2_;

    const int refinements = mu_ > firmComplementarity ? 1 : mostRefinements;
    for (int refinement = 0; refinement < refinements; ++refinement)
    {
        // What rounding and regularisation left of the balance. Corrections are added to ds as they come:
        // computing ds anew from dy would lose them, since D is huge where a point presses.
        remainder_.setZero(form_.load.size());
        addForces(form_, step.s, remainder_);
        addInertia(form_, step.y, remainder_);
        remainder_ = residuals_.balance - remainder_;
        if (form_.hasMultiplier())
        {
            remainder_ += step.alpha * form_.liveLoad;
        }
        remainder_.tail<6>().setZero();
        if (remainder_.lpNorm<Eigen::Infinity>()
            <= std::max(0.1 * settings_.tolerance * std::max(1.0, std::abs(at_.alpha)),
                        1e-2 * residuals_.balance.lpNorm<Eigen::Infinity>()))
        {
            break;
        }
        solveSchur(remainder_);
        if (form_.hasMultiplier())
        {
            const double change = -form_.liveLoad.dot(remainder_) / liveStiffness_;
            remainder_ += change * liveSolution_;
            step.alpha += change;
        }
        step.y += remainder_;
        applyTransposed(form_, remainder_, coneWork2_);
        coneWork_ += coneWork2_;
        byD(coneWork2_);
        step.s += coneWork2_;
    }
    step.z = residuals_.opening - coneWork_;
}

/// Mehrotra's corrector in the scaling: c = aim e - lambda o lambda - (W^-1 ds) o (W dz) of the predictor, so
/// p = W^-1 (lambda \ (aim e - ...)) - z.
VectorXd SpaceInteriorPoint::pullTowards(double aim, const Iterate& predictor) const
{
    VectorXd pull = -at_.z;
    for (std::size_t point = 0; point < scaling_.size(); ++point)
    {
        const NesterovToddScaling& W = scaling_[point];
        const auto row = 3 * static_cast<Eigen::Index>(point);
        const Vector3d secondOrder =
            jordanProduct(W.applyInverse(predictor.s.segment<3>(row)), W.apply(predictor.z.segment<3>(row)));
        pull.segment<3>(row) +=
            W.applyInverse(jordanDivide(W.lambda, Vector3d(aim * Vector3d::UnitX() - secondOrder)));
    }
    return pull;
}

/// Gondzio's correction: where a longer step would go, products (lambda + W^-1 ds) o (lambda + W dz) with
/// eigenvalues far from the aim are brought near it.
VectorXd SpaceInteriorPoint::widen(const VectorXd& pull, const Iterate& step, double aim, double primal,
                                   double dual) const
{
    VectorXd wider = pull;
    for (std::size_t point = 0; point < scaling_.size(); ++point)
    {
        const NesterovToddScaling& W = scaling_[point];
        const auto row = 3 * static_cast<Eigen::Index>(point);
        const Vector3d product = jordanProduct(W.lambda + primal * W.applyInverse(step.s.segment<3>(row)),
                                               W.lambda + dual * W.apply(step.z.segment<3>(row)));
        const Vector3d correction =
            clampEigenvalues(clampEigenvalues(product, 0.1 * aim, 10 * aim) - product, -10 * aim, 10 * aim);
        wider.segment<3>(row) += W.applyInverse(jordanDivide(W.lambda, correction));
    }
    return wider;
}

/// Mehrotra's start: the least forces that balance the load, and the least openings that are compatible, both
/// pushed inside their cones along e by as much as they lie outside and then apart until neither is out of
/// proportion to the other.
bool SpaceInteriorPoint::start(Start from)
{
    const int points = form_.pointCount();
    at_.s = Vector3d::UnitX().replicate(points, 1);
    at_.z = at_.s;
    at_.y = VectorXd::Zero(form_.load.size());
    at_.alpha = 0;
    compliance_ = from == Start::leastSquares ? compliance : 0;
    if (points == 0 || from == Start::unit)
    {
        return true;
    }
    // With s = z = e the scaling is I, and B B' dy = f, s = B' dy are the least forces.
    if (!factorise())
    {
        return false;
    }
    VectorXd forces = form_.load;
    solveSchur(forces);
    if (form_.hasMultiplier())
    {
        // alpha that makes the forces least: L'(B B')^-1 (f + alpha L) = 0
        at_.alpha = -form_.liveLoad.dot(forces) / liveStiffness_;
        forces += at_.alpha * liveSolution_;
        at_.y = (form_.liveWork / liveStiffness_) * liveSolution_;
    }
    applyTransposed(form_, forces, at_.s);
    applyTransposed(form_, at_.y, coneWork_);
    at_.z = form_.gap - coneWork_;

    double sLeast = 0;
    double zLeast = 0;
    double product = 0;
    double sSum = 0;
    double zSum = 0;
    for (Eigen::Index row = 0; row < at_.s.size(); row += 3)
    {
        sLeast = std::min(sLeast, smallerEigenvalue(at_.s.segment<3>(row)));
        zLeast = std::min(zLeast, smallerEigenvalue(at_.z.segment<3>(row)));
    }
    for (Eigen::Index row = 0; row < at_.s.size(); row += 3)
    {
        at_.s[row] -= 1.5 * sLeast;
        at_.z[row] -= 1.5 * zLeast;
        product += at_.s.segment<3>(row).dot(at_.z.segment<3>(row));
        sSum += at_.s[row];
        zSum += at_.z[row];
    }
    const double sMore =
        std::max(zSum > 0 ? 0.5 * product / zSum : 0, 1e-2 * at_.s.lpNorm<Eigen::Infinity>() + 1e-2);
    const double zMore = std::max(sSum > 0 ? 0.5 * product / sSum : 0,
                                  zSum > 0 ? 1e-2 * at_.z.lpNorm<Eigen::Infinity>() : 1.0);
    for (Eigen::Index row = 0; row < at_.s.size(); row += 3)
    {
        at_.s[row] += sMore;
        at_.z[row] += zMore;
    }
    return true;
}

bool SpaceInteriorPoint::run(Start from)
{
    Iterate step;
    Iterate trial;
    if (!start(from))
    {
        return false;
    }
    for (iterations_ = 0; iterations_ <= settings_.maximumIterations; ++iterations_)
    {
        computeResiduals();
        const double mu = mu_ = complementarity();
        falls_ = !form_.hasInertia() && isFalling(possibleFall);
        grows_ = sought_ == Sought::solution && at_.alpha > possiblyUnlimited;
        if (!std::isfinite(mu) || falls_ || grows_ || diverges())
        {
            return false;
        }
        if (converged())
        {
            return true;
        }
        if (iterations_ == settings_.maximumIterations || !factorise())
        {
            break;
        }

        // Predictor: straight for the optimum.
        solveNewton(-at_.z, step);
        double primal = stepToBoundary(at_.s, step.s);
        double dual = stepToBoundary(at_.z, step.z);
        const double muAfter =
            (at_.s + primal * step.s).dot(at_.z + dual * step.z) / std::max(1, form_.pointCount());
        // Complementarity must not run ahead of the balance: no further than the tolerance asks.
        const double enough = form_.hasMultiplier() ? 0.02 * settings_.tolerance * objectiveSize()
                                                          / std::max(1, form_.pointCount())
                                                    : 0;
        const double sigma =
            mu > 0 ? std::max(std::pow(std::max(0.0, muAfter) / mu, 3), std::min(1.0, enough / mu)) : 0;

        // Corrector: aims at sigma mu, with the second-order term of the predictor.
        VectorXd pull = pullTowards(sigma * mu, step);
        solveNewton(pull, step);
        primal = stepToBoundary(at_.s, step.s);
        dual = stepToBoundary(at_.z, step.z);
        // More do not pay: a tower of 200 bodies takes 15 factorisations with four, 20 with eight.
        const int correctors = (settings_.correctors + 1) / 2;
        for (int corrector = 0; corrector < correctors && primal + dual < 1.9; ++corrector)
        {
            const double primalTry = std::min(1.0, 1.1 * primal + 0.1);
            const double dualTry = std::min(1.0, 1.1 * dual + 0.1);
            const VectorXd wider = widen(pull, step, std::max(sigma, 1e-3) * mu, primalTry, dualTry);
            solveNewton(wider, trial);
            const double primalNew = stepToBoundary(at_.s, trial.s);
            const double dualNew = stepToBoundary(at_.z, trial.z);
            if (!(primalNew + dualNew >= primal + dual + 0.01))
            {
                break;
            }
            std::swap(step, trial);
            pull = wider;
            primal = primalNew;
            dual = dualNew;
        }

        if (form_.hasInertia())
        {
            primal = dual = std::min(primal, dual); // y stands in the balance too
        }
        const double back = std::max(0.99, 1 - mu);
        primal *= back;
        dual *= back;
        at_.s += primal * step.s;
        at_.alpha += primal * step.alpha;
        at_.y += dual * step.y;
        at_.z += dual * step.z;
        // Rounding may leave a point on the surface, where the scaling has no meaning.
        for (Eigen::Index row = 0; row < at_.s.size(); row += 3)
        {
            for (VectorXd* x : {&at_.s, &at_.z})
            {
                const double radius = x->segment<2>(row + 1).norm();
                (*x)[row] = std::max((*x)[row], radius * (1 + 1e-15) + 1e-300);
            }
        }
    }
    return false;
}

/// Solves one program; `optimal` in its status means that the scaled residuals met the tolerance, `unbounded`
/// that there may be no largest multiplier.
ConeSolution solveOnce(const SpaceConeProgram& program, const InteriorPointSettings& settings, Sought sought)
{
    SpaceForm form = makeSpaceForm(program);
    if (sought == Sought::fall || sought == Sought::carried)
    {
        form.liveWork = 0;
    }
    SchurSystem<6> system = makeSchurSystem(form);
    SpaceInteriorPoint solver(form, system, settings, sought);
    const bool converged = program.hasInertia()
                               ? solver.run(Start::unit) || solver.run(Start::leastSquares)
                               : solver.run(Start::leastSquares)
                                     || (!solver.falls() && !solver.grows() && solver.run(Start::unit));
    const Iterate& at = solver.iterate();
    ConeSolution solution = fromCones(program, form, at.s, at.y, at.alpha);
    solution.iterations = solver.iterations();
    solution.factorisations = solver.factorisations();
    solution.solves = solver.solves();
    solution.status = converged        ? SolveStatus::optimal
                      : solver.grows() ? SolveStatus::unbounded
                                       : SolveStatus::notConverged;
    return solution;
}

/// Forces that carry the live load alone are the ray. \param solution gets the work, and the ray and its
/// status where there is one \return whether there is
bool proveUnbounded(const SpaceConeProgram& program, const InteriorPointSettings& settings,
                    ConeSolution& solution)
{
    const ConeSolution carried = solveOnce(liveLoadAlone(program), settings, Sought::carried);
    addWork(solution, carried);
    if (!(certifyUnbounded(program, carried.contactForce).worst() <= settings.tolerance))
    {
        return false;
    }
    solution.status = SolveStatus::unbounded;
    solution.contactForce = carried.contactForce;
    return true;
}

/// Whether forces balance the loads at a large multiplier. \param solution gets the work
bool isLargeMultiplierCarried(const SpaceConeProgram& program, const InteriorPointSettings& settings,
                              ConeSolution& solution)
{
    const SpaceConeProgram loaded = atLargeMultiplier(program);
    ConeSolution balanced = solveOnce(loaded, settings, Sought::solution);
    addWork(solution, balanced);
    balanced.displacement.setZero();
    return certifyOptimal(loaded, balanced).worst() <= settings.tolerance;
}

} // namespace

ConeSolution solveInteriorPoint(const SpaceConeProgram& program, const InteriorPointSettings& settings)
{
    ConeSolution solution = solveOnce(program, settings, Sought::solution);
    if (solution.status == SolveStatus::unbounded)
    {
        if (isLargeMultiplierCarried(program, settings, solution)
            && proveUnbounded(program, settings, solution))
        {
            return solution;
        }
        ConeSolution farther = solveOnce(program, settings, Sought::farther);
        addWork(farther, solution);
        solution = std::move(farther);
    }
    if (solution.status == SolveStatus::optimal)
    {
        if (!program.hasMultiplier() && !program.hasInertia() && program.gap.size() == 0)
        {
            solution.displacement.setZero();
        }
        if (!(certifyOptimal(program, solution).worst() <= settings.tolerance))
        {
            solution.status = SolveStatus::notConverged;
        }
        return solution;
    }
    if (program.hasInertia())
    {
        return solution;
    }

    // Least r with r + A c = f + alpha L: where it does not vanish, y = Mbar^-1 r proves that nothing
    // balances f, since the optimality conditions are -A'y in the dual cone, L'y = 0 and f'y = r' Mbar^-1 r >
    // 0.
    const ConeSolution moved = solveOnce(withUnitInertia(program), settings, Sought::fall);
    addWork(solution, moved);
    if (certifyInfeasible(program, moved.displacement).worst() <= settings.tolerance)
    {
        solution.status = SolveStatus::infeasible;
        solution.displacement = moved.displacement;
        return solution;
    }
    if (!program.hasMultiplier())
    {
        return solution;
    }
    proveUnbounded(program, settings, solution);
    return solution;
}

} // namespace drystone
