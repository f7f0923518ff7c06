// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Damped, sparse normal equations in units of the largest force and rate; then points change their roles.
#include "statics/PairRefinement.h"

#include <Eigen/SparseCholesky>

#include <cmath>
#include <vector>

namespace drystone
{
namespace
{

using Eigen::VectorXd;

constexpr int mostSteps = 10;
constexpr double solved = 1e-11; // of the equations, in units of the largest force and rate
constexpr double roundingOfRoles = 1e-9;
constexpr int mostRoundsOfRoles = 3; // of roles

/// Of changes in the same units: what the equations leave open stays.
constexpr double leastDamping = 1e-10;
constexpr double largestDamping = 1e-2;

/// Points that press with less than this share of the largest force press with nothing.
constexpr double pressesFrom = 1e-5;

/// And open if they do so by more than this share of the largest rate.
constexpr double opensFrom = 1e-5;

/// What a point does in the mechanism.
struct Role
{
    bool presses = false; ///< otherwise its force is none, or its tension
    bool opens = false;   ///< otherwise (A'y)_n = 0
    bool slides = false;  ///< otherwise (A'y)_t = 0, unless it opens
};

/// The equations with forces in units of the largest, displacements in those of the largest rate, turns times
/// the mean lever arm; unknowns: forces, displacements, multiplier.
template<int Rows, int Forces>
class PairEquations
{
public:
    using Shear = Eigen::Matrix<double, Forces - 1, 1>;
    using ShearDerivative = Eigen::Matrix<double, Forces - 1, Forces - 1>;

    PairEquations(const ConeProgram<Rows, Forces>& structure, const CoulombPair& pair, double slidesFrom)
        : given(structure),
          lever(meanLeverArm(structure)),
          forceUnit(pair.contactForce.template lpNorm<Eigen::Infinity>()),
          roles(static_cast<std::size_t>(structure.points()))
    {
        for (Eigen::Index row = 0; row < pair.mechanism.size(); ++row)
        {
            rateUnit = std::max(rateUnit, std::abs(pair.mechanism[row]) * (isMoment(row) ? lever : 1));
        }
        const double liveUnit = given.liveLoad.template lpNorm<Eigen::Infinity>();
        multiplierUnit = liveUnit > 0 ? forceUnit / liveUnit : 1;
        const VectorXd closing = applyTransposed(given, pair.mechanism);
        for (int point = 0; point < given.points(); ++point)
        {
            const auto at = static_cast<std::size_t>(point);
            const auto force = pair.contactForce.template segment<Forces>(Forces * point);
            const double tension = given.strengthOf(at).tension;
            const double slip = closing.template segment<Forces - 1>(Forces * point + 1).norm();
            Role& role = roles[at];
            role.presses = force[0] + tension > pressesFrom * forceUnit;
            role.opens = !role.presses && -closing[Forces * point] > opensFrom * rateUnit;
            role.slides = slip > slidesFrom * rateUnit;
        }
        unknowns.resize(displacementStart() + given.load.size() + 1);
        unknowns << pair.contactForce / forceUnit, pair.mechanism / rateUnit, pair.alpha / multiplierUnit;
        for (int point = 0; point < given.points(); ++point)
        {
            if (!roles[static_cast<std::size_t>(point)].presses && !given.hasStrength())
            {
                unknowns.segment<Forces>(Forces * point).setZero();
            }
        }
        for (Eigen::Index row = 0; row < given.load.size(); ++row)
        {
            unknowns[displacementStart() + row] *= isMoment(row) ? lever : 1;
        }
    }

    /// What the unknowns leave of the equations, and its derivative.
    void linearise()
    {
        entries.clear();
        const CoulombPair now = pair();
        residual = VectorXd::Zero(given.load.size() + 1 + Forces * given.points());
        addBalance(now);
        Eigen::Index row = given.load.size();
        for (Eigen::Index i = 0; i < given.load.size(); ++i)
        {
            add(row, displacementStart() + i, given.liveLoad[i] * displacementUnit(i));
        }
        residual[row++] = given.liveLoad.dot(now.mechanism) - 1;
        const VectorXd closing = applyTransposed(given, now.mechanism);
        for (int point = 0; point < given.points(); ++point)
        {
            const Role role = roles[static_cast<std::size_t>(point)];
            for (int component = 0; !role.opens && component < (role.slides ? 1 : Forces); ++component)
            {
                addRate(row, point, Eigen::Matrix<double, Forces, 1>::Unit(component));
                residual[row++] = closing[Forces * point + component] / rateUnit;
            }
            if (role.presses && role.slides)
            {
                addSliding(row, point, now, closing);
            }
        }
        residual.conservativeResize(row);
    }

    /// One step of Levenberg and Marquardt, damped until it lessens what is left of the equations. \return
    /// whether there is one
    bool step()
    {
        const double before = residual.norm();
        Eigen::SparseMatrix<double> derivative(residual.size(), unknowns.size());
        derivative.setFromTriplets(entries.begin(), entries.end());
        const Eigen::SparseMatrix<double> normal = derivative.transpose() * derivative;
        Eigen::SparseMatrix<double> identity(unknowns.size(), unknowns.size());
        identity.setIdentity();
        const VectorXd gradient = derivative.transpose() * residual;
        const VectorXd from = unknowns;
        for (; damping <= largestDamping; damping *= 100)
        {
            const Eigen::SparseMatrix<double> damped = normal + damping * identity;
            const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(damped);
            if (factor.info() == Eigen::Success)
            {
                unknowns = from - factor.solve(gradient);
                linearise();
                if (residual.norm() < before)
                {
                    damping = std::max(leastDamping, damping / 100);
                    return true;
                }
            }
        }
        unknowns = from;
        linearise();
        return false;
    }

    /// Points that pull press no longer, and open ones that close are closed. \return whether any has changed
    bool changeRoles()
    {
        bool isChanged = false;
        const VectorXd closing = applyTransposed(given, pair().mechanism);
        for (int point = 0; point < given.points(); ++point)
        {
            Role& role = roles[static_cast<std::size_t>(point)];
            if (role.presses && !given.hasStrength() && unknowns[Forces * point] < -roundingOfRoles)
            {
                role.presses = false;
                role.opens = true;
                unknowns.segment<Forces>(Forces * point).setZero();
                isChanged = true;
            }
            else if (role.opens && closing[Forces * point] > roundingOfRoles * rateUnit)
            {
                role.opens = false;
                isChanged = true;
            }
        }
        return isChanged;
    }

    double error() const { return residual.template lpNorm<Eigen::Infinity>(); }

    CoulombPair pair() const
    {
        CoulombPair now;
        now.contactForce = forceUnit * unknowns.head(displacementStart());
        now.mechanism.resize(given.load.size());
        for (Eigen::Index row = 0; row < given.load.size(); ++row)
        {
            now.mechanism[row] = displacementUnit(row) * unknowns[displacementStart() + row];
        }
        now.alpha = multiplierUnit * unknowns[unknowns.size() - 1];
        return now;
    }

private:
    static bool isMoment(Eigen::Index row) { return row % Rows >= Forces; }
    Eigen::Index displacementStart() const { return Forces * static_cast<Eigen::Index>(given.points()); }
    double displacementUnit(Eigen::Index row) const { return isMoment(row) ? rateUnit / lever : rateUnit; }
    /// Of a row of the balance.
    double loadUnit(Eigen::Index row) const { return isMoment(row) ? forceUnit * lever : forceUnit; }

    void add(Eigen::Index row, Eigen::Index column, double value)
    {
        if (value != 0)
        {
            entries.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
        }
    }

    void addBalance(const CoulombPair& now)
    {
        const VectorXd lacking =
            applyEquilibrium(given, now.contactForce) - given.load - now.alpha * given.liveLoad;
        for (Eigen::Index row = 0; row < given.load.size(); ++row)
        {
            residual[row] = lacking[row] / loadUnit(row);
            add(row, unknowns.size() - 1, -given.liveLoad[row] * multiplierUnit / loadUnit(row));
        }
        for (int point = 0; point < given.points(); ++point)
        {
            if (roles[static_cast<std::size_t>(point)].presses)
            {
                forEachSide(point,
                            [&](Eigen::Index first, const Eigen::Matrix<double, Rows, Forces>& columns)
                            {
                                for (int i = 0; i < Rows * Forces; ++i)
                                {
                                    const Eigen::Index row = first + i % Rows;
                                    add(row, Forces * point + i / Rows,
                                        columns(i % Rows, i / Rows) * forceUnit / loadUnit(row));
                                }
                            });
            }
        }
    }

    /// The derivative of a component of A'y, in units of rates.
    void addRate(Eigen::Index row, int point, const Eigen::Matrix<double, Forces, 1>& component)
    {
        forEachSide(point,
                    [&](Eigen::Index first, const Eigen::Matrix<double, Rows, Forces>& columns)
                    {
                        const Eigen::Matrix<double, Rows, 1> derivative = columns * component;
                        for (int i = 0; i < Rows; ++i)
                        {
                            add(row, displacementStart() + first + i,
                                derivative[i] * displacementUnit(first + i) / rateUnit);
                        }
                    });
    }

    /// t - (C + mu n) s / |s|.
    void addSliding(Eigen::Index& row, int point, const CoulombPair& now, const VectorXd& closing)
    {
        const auto at = static_cast<std::size_t>(point);
        const double friction = given.friction[at];
        const double cohesion = given.strengthOf(at).cohesion;
        const Shear slip = closing.template segment<Forces - 1>(Forces * point + 1);
        const Shear direction = slip / slip.norm();
        const double limit = (cohesion + friction * now.contactForce[Forces * point]) / forceUnit;
        const Shear lacking =
            now.contactForce.template segment<Forces - 1>(Forces * point + 1) / forceUnit - limit * direction;
        const ShearDerivative bySlip = -limit * rateUnit / slip.norm()
                                       * (ShearDerivative::Identity() - direction * direction.transpose());
        for (int i = 0; i < Forces - 1; ++i)
        {
            add(row, Forces * point + 1 + i, 1);
            add(row, Forces * point, -friction * direction[i]);
            Eigen::Matrix<double, Forces, 1> component = Eigen::Matrix<double, Forces, 1>::Zero();
            component.template tail<Forces - 1>() = bySlip.row(i);
            addRate(row, point, component);
            residual[row++] = lacking[i];
        }
    }

    template<typename Use>
    void forEachSide(int point, const Use& use) const
    {
        const auto& columns = given.contacts[static_cast<std::size_t>(point)];
        if (columns.first >= 0)
        {
            use(static_cast<Eigen::Index>(Rows) * columns.first, columns.onFirst);
        }
        if (columns.second >= 0)
        {
            use(static_cast<Eigen::Index>(Rows) * columns.second, columns.onSecond);
        }
    }

    const ConeProgram<Rows, Forces>& given;
    double lever;
    double forceUnit;
    double rateUnit = 0;
    double multiplierUnit = 1;
    std::vector<Role> roles;
    VectorXd unknowns;
    VectorXd residual;
    double damping = leastDamping;
    std::vector<Eigen::Triplet<double>> entries;
};

} // namespace

template<int Rows, int Forces>
std::optional<CoulombPair> refinedPair(const ConeProgram<Rows, Forces>& given, const CoulombPair& pair,
                                       double slidesFrom, const std::function<bool()>& isOver)
{
    if (given.hasCrushing())
    {
        return std::nullopt;
    }
    PairEquations<Rows, Forces> equations(given, pair, slidesFrom);
    for (int round = 0; round < mostRoundsOfRoles; ++round)
    {
        equations.linearise();
        for (int step = 0; step < mostSteps && equations.error() > solved; ++step)
        {
            if (isOver && isOver())
            {
                return std::nullopt;
            }
            if (!equations.step())
            {
                break;
            }
        }
        if (!equations.changeRoles())
        {
            break;
        }
    }
    return equations.pair();
}

template std::optional<CoulombPair> refinedPair(const PlaneConeProgram& given, const CoulombPair& pair,
                                                double slidesFrom, const std::function<bool()>& isOver);
template std::optional<CoulombPair> refinedPair(const SpaceConeProgram& given, const CoulombPair& pair,
                                                double slidesFrom, const std::function<bool()>& isOver);

} // namespace drystone
