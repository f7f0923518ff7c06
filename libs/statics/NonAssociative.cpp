// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "statics/NonAssociative.h"

#include "conic/form/Form.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>

namespace drystone
{
namespace
{

using Eigen::VectorXd;

/// Growth of the penalty on dissipation, from 1. Found on the six walls: faster, and the low multipliers of
/// walls 4 and 5 are passed by.
constexpr double penaltyGrowth = 1.3;
constexpr int penaltyRounds = 16;
constexpr int roundsToTrial = 4; ///< whether the mechanism of a round has forces that suit it

/// Programs of a sequence through the current point, and the share of the old normal forces kept from one to
/// the next. Those that do not settle have found their mechanism all the same.
constexpr int sequenceLength = 40;
constexpr double relaxation = 0.3;

/// Normal forces are changed by up to this share of the largest to choose among the mechanisms of one pair,
/// and so often in vain before the pair is taken for the least.
constexpr double nudge = 1e-4;
constexpr int vainNudges = 6;

/// Points that open or slide by less than this share of the largest rate stand still.
constexpr double stillRate = 1e-7;

/// Change of a multiplier that counts as a lower one.
constexpr double lower = 1e-7;

/// Forces and a mechanism, or one of them.
struct Pair
{
    double alpha = std::numeric_limits<double>::infinity();
    VectorXd contactForce;
    VectorXd mechanism;
};

/// One search, on the program or its mirror image.
class Search
{
public:
    Search(const PlaneConeProgram& program, std::vector<int> joint, const InteriorPointSettings& solver,
           LimitAnalysis& work)
        : program_(program), joint_(std::move(joint)), solver_(solver), work_(work)
    {
        const int joints = joint_.empty() ? 0 : 1 + *std::max_element(joint_.begin(), joint_.end());
        points_.assign(static_cast<std::size_t>(joints), 0);
        for (const int index : joint_)
        {
            ++points_[static_cast<std::size_t>(index)];
        }
    }

    /// Normal force of each joint, not negative.
    VectorXd normalForces(const VectorXd& contactForce) const
    {
        VectorXd normal = VectorXd::Zero(static_cast<Eigen::Index>(points_.size()));
        for (int point = 0; point < program_.points(); ++point)
        {
            normal[joint_[point]] += std::max(0.0, contactForce[2 * point]);
        }
        return normal;
    }

    /// Collapse with cohesion mu N instead of friction.
    std::optional<Pair> mechanismOf(const VectorXd& normal)
    {
        PlaneConeProgram held = program_;
        held.friction.assign(held.friction.size(), 0);
        held.strength.assign(held.friction.size(), {});
        const double negligible = 1e-10 * normal.maxCoeff();
        for (int point = 0; point < held.points(); ++point)
        {
            const int index = joint_[point];
            const double share = program_.friction[point] * normal[index] / points_[index];
            held.strength[point].cohesion = share > negligible ? share : 0;
        }
        return solve(held);
    }

    /// Least alpha + gamma (dissipation) for a mechanism. \return the normal forces
    std::optional<VectorXd> penalisedForces(const VectorXd& mechanism, double gamma)
    {
        PlaneConeProgram reversed = program_;
        reversed.liveLoad = -program_.liveLoad;
        reversed.gap = VectorXd::Zero(2 * program_.points());
        const VectorXd closing = applyTransposed(program_, mechanism);
        for (int point = 0; point < program_.points(); ++point)
        {
            reversed.gap[2 * point] = gamma
                                      * (program_.friction[point] * std::abs(closing[2 * point + 1])
                                         + std::max(0.0, -closing[2 * point]));
        }
        const std::optional<Pair> solved = solve(reversed);
        return solved ? std::optional(normalForces(solved->contactForce)) : std::nullopt;
    }

    /// Least alpha among the forces that suit the mechanism: none where points open, the limit of friction
    /// against the slip where they slide. The columns of the latter are put together into one.
    std::optional<Pair> leastMultiplier(const VectorXd& mechanism)
    {
        const VectorXd closing = applyTransposed(program_, mechanism);
        const double still = stillRate * closing.lpNorm<Eigen::Infinity>();
        PlaneConeProgram suited = program_;
        suited.liveLoad = -program_.liveLoad;
        suited.contacts.clear();
        suited.friction.clear();
        std::vector<int> kept;
        std::vector<double> slope; // t = slope n, where that is given
        for (int point = 0; point < program_.points(); ++point)
        {
            if (-closing[2 * point] > still)
            {
                continue;
            }
            auto columns = program_.contacts[point];
            double friction = program_.friction[point];
            double ratio = 0;
            if (std::abs(closing[2 * point + 1]) > still)
            {
                ratio = std::copysign(friction, closing[2 * point + 1]);
                columns.onFirst.col(0) += ratio * columns.onFirst.col(1);
                columns.onSecond.col(0) += ratio * columns.onSecond.col(1);
                friction = 0;
            }
            suited.contacts.push_back(columns);
            suited.friction.push_back(friction);
            kept.push_back(point);
            slope.push_back(ratio);
        }
        const std::optional<Pair> solved = solve(suited);
        if (!solved)
        {
            return std::nullopt;
        }
        Pair pair;
        pair.alpha = -solved->alpha;
        pair.mechanism = mechanism;
        pair.contactForce = VectorXd::Zero(2 * program_.points());
        for (std::size_t i = 0; i < kept.size(); ++i)
        {
            const auto from = static_cast<Eigen::Index>(2 * i);
            const double normal = std::max(0.0, solved->contactForce[from]);
            pair.contactForce[2 * kept[i]] = normal;
            pair.contactForce[2 * kept[i] + 1] =
                slope[i] != 0 ? slope[i] * normal : solved->contactForce[from + 1];
        }
        return pair;
    }

    /// Leads normal forces to where low multipliers are. \param meet is handed every pair met on the way
    template<class Meet>
    VectorXd wander(VectorXd normal, const Meet& meet)
    {
        double gamma = 1;
        for (int round = 1; round <= penaltyRounds; ++round, gamma *= penaltyGrowth)
        {
            const std::optional<Pair> collapse = mechanismOf(normal);
            if (collapse && round % roundsToTrial == 0)
            {
                meet(leastMultiplier(collapse->mechanism));
            }
            const std::optional<VectorXd> next =
                collapse ? penalisedForces(collapse->mechanism, gamma) : std::nullopt;
            if (!next)
            {
                break;
            }
            normal = *next;
        }
        return normal;
    }

    /// The sequence with a yield surface through the current point, until forces and mechanism agree.
    std::optional<Pair> settle(VectorXd normal, double tolerance)
    {
        std::optional<Pair> last;
        for (int step = 0; step < sequenceLength; ++step)
        {
            std::optional<Pair> collapse = mechanismOf(normal);
            if (!collapse)
            {
                break;
            }
            last = std::move(collapse);
            if (coulombResiduals(program_, joint_, last->alpha, last->contactForce, last->mechanism).worst()
                <= tolerance)
            {
                break;
            }
            normal = relaxation * normal + (1 - relaxation) * normalForces(last->contactForce);
        }
        return last;
    }

    /// Lowers a pair's multiplier for as long as another mechanism of the same normal forces allows it.
    Pair descend(Pair pair, std::mt19937& random)
    {
        for (int vain = 0; vain < vainNudges;)
        {
            VectorXd normal = normalForces(pair.contactForce);
            const double most = nudge * normal.maxCoeff();
            for (double& force : normal)
            {
                force += most * uniform(random);
            }
            const std::optional<Pair> other = mechanismOf(normal);
            std::optional<Pair> least = other ? leastMultiplier(other->mechanism) : std::nullopt;
            if (least && least->alpha < pair.alpha - lower * std::max(1.0, std::abs(pair.alpha)))
            {
                pair = std::move(*least);
                vain = 0;
            }
            else
            {
                ++vain;
            }
        }
        return pair;
    }

    /// In [0, 1), the same on every machine.
    static double uniform(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

private:
    std::optional<Pair> solve(const PlaneConeProgram& program)
    {
        ConeSolution solution = solveInteriorPoint(program, solver_, &symbolic_);
        work_.iterations += solution.iterations;
        work_.factorisations += solution.factorisations;
        work_.solves += solution.solves;
        if (solution.status != SolveStatus::optimal)
        {
            return std::nullopt;
        }
        return Pair{solution.multiplier, std::move(solution.contactForce), std::move(solution.displacement)};
    }

    const PlaneConeProgram& program_;
    SymbolicAnalysis symbolic_; ///< of the last program: most have the same points
    std::vector<int> joint_;
    InteriorPointSettings solver_;
    LimitAnalysis& work_;
    std::vector<int> points_; ///< of each joint
};

/// The structure seen from behind, its bodies and points counted from the other end, so that a solver takes
/// another path: ux, rz and shear change sign.
PlaneConeProgram mirrored(const PlaneConeProgram& program)
{
    const Eigen::Vector3d rows(-1, 1, -1);
    const Eigen::Vector2d forces(1, -1);
    const int last = program.bodies - 1;
    PlaneConeProgram mirror = program;
    std::reverse(mirror.contacts.begin(), mirror.contacts.end());
    std::reverse(mirror.friction.begin(), mirror.friction.end());
    for (auto& columns : mirror.contacts)
    {
        columns.first = columns.first < 0 ? -1 : last - columns.first;
        columns.second = columns.second < 0 ? -1 : last - columns.second;
        columns.onFirst = rows.asDiagonal() * columns.onFirst * forces.asDiagonal();
        columns.onSecond = rows.asDiagonal() * columns.onSecond * forces.asDiagonal();
    }
    for (int body = 0; body <= last; ++body)
    {
        mirror.load.segment<3>(3 * body) = rows.cwiseProduct(program.load.segment<3>(3 * (last - body)));
        mirror.liveLoad.segment<3>(3 * body) =
            rows.cwiseProduct(program.liveLoad.segment<3>(3 * (last - body)));
    }
    return mirror;
}

/// A pair of the mirror image, as one of the program itself.
Pair mirrored(const Pair& pair)
{
    Pair result = pair;
    const Eigen::Index points = pair.contactForce.size() / 2;
    for (Eigen::Index point = 0; point < points; ++point)
    {
        result.contactForce.segment<2>(2 * point) =
            pair.contactForce.segment<2>(2 * (points - 1 - point)).cwiseProduct(Eigen::Vector2d(1, -1));
    }
    const Eigen::Index bodies = pair.mechanism.size() / 3;
    for (Eigen::Index body = 0; body < bodies; ++body)
    {
        result.mechanism.segment<3>(3 * body) =
            pair.mechanism.segment<3>(3 * (bodies - 1 - body)).cwiseProduct(Eigen::Vector3d(-1, 1, -1));
    }
    return result;
}

/// value / scale, where 0 / 0 is 0.
double relative(double value, double scale)
{
    return value == 0 ? 0 : value / scale;
}

} // namespace

void declare(Options& options, NonAssociativeSettings& settings)
{
    options.optional("starts", settings.starts, "sequences from different normal forces; as many mirrored")
        .atLeast(1)
        .atMost(1000);
    options.optional("seed", settings.seed, "of the random numbers that later starts are made from")
        .atLeast(0);
    options.optional("tolerance", settings.tolerance, "on the residuals of yield and flow")
        .above(0)
        .atMost(1e-3);
}

std::vector<int> jointsOf(const std::vector<ContactPoint<2>>& points)
{
    std::vector<int> joint;
    joint.reserve(points.size());
    for (const ContactPoint<2>& point : points)
    {
        joint.push_back(point.joint);
    }
    return joint;
}

double CoulombResiduals::worst() const
{
    return std::max({balance, yield, flow, mismatch});
}

CoulombResiduals coulombResiduals(const PlaneConeProgram& program, const std::vector<int>& joint,
                                  double alpha, const Eigen::VectorXd& contactForce,
                                  const Eigen::VectorXd& mechanism)
{
    const double lever = meanLeverArm(program);
    const auto scaled = [](VectorXd rows, double factor)
    {
        for (Eigen::Index row = 2; row < rows.size(); row += 3)
        {
            rows[row] *= factor;
        }
        return rows.lpNorm<Eigen::Infinity>();
    };
    const VectorXd load = program.load + alpha * program.liveLoad;
    CoulombResiduals residuals;
    residuals.balance = std::max(
        relative(scaled(applyEquilibrium(program, contactForce) - load, 1 / lever), scaled(load, 1 / lever)),
        std::abs(program.liveLoad.dot(mechanism) - 1));

    const VectorXd closing = applyTransposed(program, mechanism);
    const double largestForce = contactForce.lpNorm<Eigen::Infinity>();
    const double largestRate = scaled(mechanism, lever);
    const int joints = joint.empty() ? 0 : 1 + *std::max_element(joint.begin(), joint.end());
    VectorXd normal = VectorXd::Zero(joints);
    VectorXd shear = VectorXd::Zero(joints);
    VectorXd friction = VectorXd::Zero(joints);
    double power = 0;
    double excess = 0;
    for (int point = 0; point < program.points(); ++point)
    {
        const double n = contactForce[2 * point];
        const double opening = -closing[2 * point];
        normal[joint[point]] += n;
        shear[joint[point]] += contactForce[2 * point + 1];
        friction[joint[point]] = program.friction[point];
        residuals.yield = std::max(residuals.yield, relative(-n, largestForce));
        residuals.flow = std::max(residuals.flow, relative(-opening, largestRate));
        if (n > 1e-6 * largestForce)
        {
            residuals.flow = std::max(residuals.flow, relative(opening, largestRate));
        }
        const double slip = closing[2 * point + 1];
        power += program.friction[point] * std::max(0.0, n) * std::abs(slip);
        // Shears may be shared otherwise among the points of a joint, which slip alike: only the sum counts.
        excess += program.friction[point] * std::max(0.0, n) * std::abs(slip)
                  - contactForce[2 * point + 1] * slip + n * opening;
    }
    for (Eigen::Index index = 0; index < joints; ++index)
    {
        residuals.yield = std::max(
            residuals.yield,
            relative(std::abs(shear[index]) - friction[index] * std::max(0.0, normal[index]), largestForce));
    }
    residuals.mismatch = relative(std::abs(excess), std::max(power, std::abs(program.load.dot(mechanism))));
    return residuals;
}

LimitAnalysis solveNonAssociative(const PlaneConeProgram& program, const std::vector<int>& joint,
                                  const NonAssociativeSettings& settings, const InteriorPointSettings& solver)
{
    if (program.hasStrength())
    {
        throw std::invalid_argument("solveNonAssociative needs cones: no strengths");
    }
    LimitAnalysis result = solveLimitAnalysis(program, solver);
    // What no forces in the friction cones can carry falls with either law.
    if (result.status == CollapseStatus::unstable || result.status == CollapseStatus::notConverged)
    {
        return result;
    }
    const CollapseStatus associative = result.status;
    CoulombRange range;
    range.associative =
        associative == CollapseStatus::unbounded ? std::numeric_limits<double>::infinity() : result.alpha;
    const PlaneConeProgram mirror = mirrored(program);
    const std::vector<int> mirrorJoint(joint.rbegin(), joint.rend());
    Search straight(program, joint, solver, result);
    Search behind(mirror, mirrorJoint, solver, result);

    const VectorXd first = straight.normalForces(result.contactForce);
    std::mt19937 random(static_cast<std::mt19937::result_type>(settings.seed));
    range.lowest = std::numeric_limits<double>::infinity();
    range.highest = -range.lowest;
    Pair lowest;
    const auto consider = [&](const std::optional<Pair>& pair)
    {
        // Below zero the mechanism would be driven by the dead load, which is carried where loading begins.
        if (!pair || pair->alpha < 0
            || coulombResiduals(program, joint, pair->alpha, pair->contactForce, pair->mechanism).worst()
                   > settings.tolerance)
        {
            return false;
        }
        range.lowest = std::min(range.lowest, pair->alpha);
        range.highest = std::max(range.highest, pair->alpha);
        if (!(pair->alpha >= lowest.alpha))
        {
            lowest = *pair;
        }
        return true;
    };
    for (int start = 0; start < settings.starts; ++start)
    {
        VectorXd normal = first;
        for (Eigen::Index index = 0; start > 1 && index < normal.size(); ++index)
        {
            normal[index] *= std::exp(Search::uniform(random) - 0.5);
        }
        for (Search* search : {&straight, &behind})
        {
            const bool isMirror = search == &behind;
            const auto asBuilt = [&](const std::optional<Pair>& pair)
            { return pair && isMirror ? std::optional(mirrored(*pair)) : pair; };
            ++range.starts;
            bool found = false;
            const auto meet = [&](std::optional<Pair> pair)
            {
                if (consider(asBuilt(pair)))
                {
                    found = true;
                    consider(asBuilt(search->descend(std::move(*pair), random)));
                }
            };
            // The first start is the sequence of Gilbert et al. by itself; the others look around before.
            const std::optional<Pair> settled =
                search->settle(start == 0 ? normal : search->wander(normal, meet), settings.tolerance);
            found = consider(asBuilt(settled)) || found;
            if (settled)
            {
                meet(search->leastMultiplier(settled->mechanism));
            }
            range.converged += found;
        }
    }
    if (lowest.contactForce.size() == 0)
    {
        result.status = associative == CollapseStatus::unbounded ? CollapseStatus::unbounded
                                                                 : CollapseStatus::notConverged;
        return result;
    }
    const CoulombResiduals residuals =
        coulombResiduals(program, joint, lowest.alpha, lowest.contactForce, lowest.mechanism);
    result.status = CollapseStatus::optimal;
    result.alpha = lowest.alpha;
    result.contactForce = lowest.contactForce;
    result.mechanism = lowest.mechanism / lowest.mechanism.lpNorm<Eigen::Infinity>();
    result.certificate = {std::max(residuals.balance, residuals.yield), residuals.flow, residuals.mismatch};
    result.coulomb = range;
    return result;
}

} // namespace drystone
