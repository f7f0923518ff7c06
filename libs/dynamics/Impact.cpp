// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The law of impacts, apart from the steps: the law of an instant knows no time integration.
#include "dynamics/Impact.h"

#include "conic/form/Form.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace drystone
{
namespace
{

/// Where Newton's law creates energy: programs solved for the restitution that does not.
constexpr int mostRefinements = 6;

/// They end when energy leaves undecided no more than this part of the restitution.
constexpr double restitutionKnown = 1e-3;

/// A gain that is rounding of the kinetic energy, as a share of it.
constexpr double roundingOfEnergy = 8 * std::numeric_limits<double>::epsilon();

/// Points and bodies of blocks that meet each other, numbered.
struct Groups
{
    std::vector<int> ofBody;  ///< -1: meets nothing
    std::vector<int> ofPoint; ///< one a point that meets
    int count = 0;
};

template<int Dim>
Groups groupsOf(const ImpactProblem<Dim>& problem)
{
    const StepProgram<Dim>& program = problem.program;
    std::vector<int> parent(static_cast<std::size_t>(program.bodies));
    std::iota(parent.begin(), parent.end(), 0);
    const auto rootOf = [&parent](int body)
    {
        while (parent[static_cast<std::size_t>(body)] != body)
        {
            body = parent[static_cast<std::size_t>(body)] =
                parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(body)])];
        }
        return body;
    };
    for (const std::size_t point : problem.meeting)
    {
        const auto& contact = program.contacts[point];
        if (contact.first >= 0 && contact.second >= 0)
        {
            parent[static_cast<std::size_t>(rootOf(contact.first))] = rootOf(contact.second);
        }
    }
    Groups groups;
    groups.ofBody.assign(parent.size(), -1);
    std::vector<int> ofRoot(parent.size(), -1);
    const auto groupOf = [&](int body)
    {
        int& group = ofRoot[static_cast<std::size_t>(rootOf(body))];
        group = group < 0 ? groups.count++ : group;
        return groups.ofBody[static_cast<std::size_t>(body)] = group;
    };
    for (const std::size_t point : problem.meeting)
    {
        const auto& contact = program.contacts[point];
        int group = -1;
        for (const int body : {contact.first, contact.second})
        {
            group = body >= 0 ? groupOf(body) : group;
        }
        groups.ofPoint.push_back(group >= 0 ? group : groups.count++);
    }
    return groups;
}

/// A way for the impact to go.
struct ImpactOutcome
{
    Eigen::VectorXd velocity; ///< v+
    Eigen::VectorXd force;    ///< impulses over the time step [N]
    Eigen::VectorXd share;    ///< k of each group
    Eigen::VectorXd gain;     ///< energy created in each group [J]
};

/// What each group's kinetic energy grows by beyond the work of the supports [J].
template<int Dim>
Eigen::VectorXd gainOf(const ImpactProblem<Dim>& problem, const Groups& groups,
                       const Eigen::VectorXd& velocity, const Eigen::VectorXd& force)
{
    Eigen::VectorXd gain = Eigen::VectorXd::Zero(groups.count);
    for (std::size_t body = 0; body < groups.ofBody.size(); ++body)
    {
        if (groups.ofBody[body] >= 0)
        {
            const auto row = freedomCount<Dim> * static_cast<Eigen::Index>(body);
            const BlockVector<Dim> before = problem.velocity.template segment<freedomCount<Dim>>(row);
            const BlockVector<Dim> after = velocity.segment<freedomCount<Dim>>(row);
            gain[groups.ofBody[body]] +=
                0.5 * times(problem.mass, static_cast<int>(body), after - before).dot(after + before);
        }
    }
    for (std::size_t i = 0; problem.closingBySupports.size() > 0 && i < problem.meeting.size(); ++i)
    {
        gain[groups.ofPoint[i]] -= force.segment<Dim>(Dim * static_cast<Eigen::Index>(i))
                                       .dot(problem.closingBySupports.template segment<Dim>(
                                           Dim * static_cast<Eigen::Index>(problem.meeting[i])));
    }
    return gain;
}

/// The program of the impact: a step of theta 1 without loads whose gaps are -dt k e u_n-.
template<int Dim>
StepProgram<Dim> impactProgram(const ImpactProblem<Dim>& problem, const Groups& groups,
                               const Eigen::VectorXd& closing, const Eigen::VectorXd& share)
{
    const StepProgram<Dim>& program = problem.program;
    const double timeStep = problem.timeStep;
    StepProgram<Dim> impact;
    impact.bodies = program.bodies;
    const MassMatrix<Dim> inertia = over(problem.mass, timeStep * timeStep);
    for (int body = 0; body < program.bodies; ++body)
    {
        impact.inertia.push_back(blockOf(inertia, body));
    }
    impact.load = timeStep * times(inertia, problem.velocity);
    impact.gap = Eigen::VectorXd::Zero(Dim * static_cast<Eigen::Index>(problem.meeting.size()));
    for (std::size_t i = 0; i < problem.meeting.size(); ++i)
    {
        const std::size_t point = problem.meeting[i];
        impact.contacts.push_back(program.contacts[point]);
        impact.friction.push_back(program.friction[point]);
        const auto row = Dim * static_cast<Eigen::Index>(i);
        const auto there = Dim * static_cast<Eigen::Index>(point);
        const double rebound = problem.restitution * closing[there];
        impact.gap[row] =
            rebound > problem.slowestRebound ? -timeStep * share[groups.ofPoint[i]] * rebound : 0;
        if (problem.closingBySupports.size() > 0)
        {
            impact.gap.template segment<Dim>(row) -= problem.closingBySupports.template segment<Dim>(there);
        }
    }
    return impact;
}

/// Where along the segment from 0, which creates no energy, to 1, which does, none is created any more: the
/// root of low + slope s + curvature s^2, low <= 0.
double rootOfGain(double low, double slope, double curvature)
{
    const double radicand = std::max(slope * slope - 4 * curvature * low, 0.0);
    const double root = slope > 0 ? -2 * low / (slope + std::sqrt(radicand))
                                  : (std::sqrt(radicand) - slope) / (2 * curvature);
    return std::isfinite(root) ? std::clamp(root, 0.0, 1.0) : 0;
}

/// Of each group the last point of the segment from `low` to `high` that creates no energy.
template<int Dim>
Eigen::VectorXd rootsBetween(const ImpactProblem<Dim>& problem, const Groups& groups,
                             const ImpactOutcome& low, const ImpactOutcome& high)
{
    Eigen::VectorXd curvature = Eigen::VectorXd::Zero(groups.count);
    for (std::size_t body = 0; body < groups.ofBody.size(); ++body)
    {
        if (groups.ofBody[body] >= 0)
        {
            const auto row = freedomCount<Dim> * static_cast<Eigen::Index>(body);
            const BlockVector<Dim> change =
                high.velocity.segment<freedomCount<Dim>>(row) - low.velocity.segment<freedomCount<Dim>>(row);
            curvature[groups.ofBody[body]] += 0.5 * squareOf(problem.mass, static_cast<int>(body), change);
        }
    }
    Eigen::VectorXd roots(groups.count);
    for (int group = 0; group < groups.count; ++group)
    {
        const double slope = high.gain[group] - low.gain[group] - curvature[group];
        roots[group] =
            high.gain[group] <= 0 ? 1 : rootOfGain(std::min(low.gain[group], 0.0), slope, curvature[group]);
    }
    return roots;
}

/// Takes over what another outcome has for some groups.
template<int Dim>
void takeGroups(ImpactOutcome& outcome, const ImpactOutcome& other, const Groups& groups,
                const std::vector<char>& which)
{
    for (std::size_t body = 0; body < groups.ofBody.size(); ++body)
    {
        if (groups.ofBody[body] >= 0 && which[static_cast<std::size_t>(groups.ofBody[body])])
        {
            const auto row = freedomCount<Dim> * static_cast<Eigen::Index>(body);
            outcome.velocity.segment<freedomCount<Dim>>(row) = other.velocity.segment<freedomCount<Dim>>(row);
        }
    }
    for (std::size_t i = 0; i < groups.ofPoint.size(); ++i)
    {
        if (which[static_cast<std::size_t>(groups.ofPoint[i])])
        {
            const auto row = Dim * static_cast<Eigen::Index>(i);
            outcome.force.segment<Dim>(row) = other.force.segment<Dim>(row);
        }
    }
    for (int group = 0; group < groups.count; ++group)
    {
        if (which[static_cast<std::size_t>(group)])
        {
            outcome.share[group] = other.share[group];
            outcome.gain[group] = other.gain[group];
        }
    }
}

/// The outcome at a part of the way from one to another, another part for each group.
template<int Dim>
ImpactOutcome between(const ImpactProblem<Dim>& problem, const Groups& groups, const ImpactOutcome& low,
                      const ImpactOutcome& high, const Eigen::VectorXd& part)
{
    ImpactOutcome outcome = low;
    for (std::size_t body = 0; body < groups.ofBody.size(); ++body)
    {
        if (groups.ofBody[body] >= 0)
        {
            const auto row = freedomCount<Dim> * static_cast<Eigen::Index>(body);
            outcome.velocity.segment<freedomCount<Dim>>(row) +=
                part[groups.ofBody[body]]
                * (high.velocity.segment<freedomCount<Dim>>(row)
                   - low.velocity.segment<freedomCount<Dim>>(row));
        }
    }
    for (std::size_t i = 0; i < groups.ofPoint.size(); ++i)
    {
        const auto row = Dim * static_cast<Eigen::Index>(i);
        outcome.force.segment<Dim>(row) +=
            part[groups.ofPoint[i]] * (high.force.segment<Dim>(row) - low.force.segment<Dim>(row));
    }
    outcome.share += part.cwiseProduct(high.share - low.share);
    outcome.gain = gainOf(problem, groups, outcome.velocity, outcome.force);
    return outcome;
}

} // namespace

template<int Dim>
Eigen::VectorXd closingVelocity(const StepProgram<Dim>& program, const Eigen::VectorXd& velocity,
                                const Eigen::VectorXd& closingBySupports, double timeStep)
{
    Eigen::VectorXd closing = applyTransposed(program, velocity);
    if (closingBySupports.size() > 0)
    {
        closing += closingBySupports / timeStep;
    }
    return closing;
}

template<int Dim>
Impact impactOf(const ImpactProblem<Dim>& problem, const StepSettings& settings)
{
    const Groups groups = groupsOf(problem);
    const Eigen::VectorXd closing =
        closingVelocity(problem.program, problem.velocity, problem.closingBySupports, problem.timeStep);
    Eigen::VectorXd energy = Eigen::VectorXd::Zero(groups.count); // kinetic, before
    for (std::size_t body = 0; body < groups.ofBody.size(); ++body)
    {
        if (groups.ofBody[body] >= 0)
        {
            const auto row = freedomCount<Dim> * static_cast<Eigen::Index>(body);
            energy[groups.ofBody[body]] +=
                0.5
                * squareOf(problem.mass, static_cast<int>(body),
                           problem.velocity.template segment<freedomCount<Dim>>(row));
        }
    }

    Impact impact;
    StepSettings instant = settings;
    instant.kind = StepKind::impact;
    // Steps that are followed have unique forces, from which impulses can be followed too.
    const bool isFollowed =
        settings.flowRule == FlowRule::nonAssociative && settings.overlaps == Overlaps::damped;
    instant.overlaps = isFollowed ? Overlaps::closed : Overlaps::none;
    SymbolicAnalysis symbolic; // of all programs: they differ in their gaps
    StepGuess guess;
    if (isFollowed && problem.stepForce)
    {
        guess.contactForce.resize(Dim * static_cast<Eigen::Index>(problem.meeting.size()));
        for (std::size_t i = 0; i < problem.meeting.size(); ++i)
        {
            guess.contactForce.template segment<Dim>(Dim * static_cast<Eigen::Index>(i)) =
                problem.stepForce->template segment<Dim>(Dim * static_cast<Eigen::Index>(problem.meeting[i]));
        }
    }
    const auto solve = [&](const Eigen::VectorXd& share, FlowRule flowRule, ImpactOutcome& outcome)
    {
        instant.flowRule = flowRule;
        const ThetaStep step = solveThetaStep(impactProgram(problem, groups, closing, share), instant, guess,
                                              Relinearisation<Dim>(), &symbolic);
        impact.iterations += step.iterations;
        impact.factorisations += step.factorisations;
        impact.programs += step.programs;
        if (step.status != SolveStatus::optimal)
        {
            return false;
        }
        outcome = {step.displacement / problem.timeStep, step.contactForce, share, {}};
        if (isFollowed)
        {
            guess.contactForce = step.contactForce;
        }
        outcome.gain = gainOf(problem, groups, outcome.velocity, outcome.force);
        return true;
    };
    const auto whichGain = [&](const ImpactOutcome& outcome)
    {
        std::vector<char> which(static_cast<std::size_t>(groups.count));
        for (int group = 0; group < groups.count; ++group)
        {
            which[static_cast<std::size_t>(group)] = outcome.gain[group] > roundingOfEnergy * energy[group];
        }
        return which;
    };
    const auto isAny = [](const std::vector<char>& which)
    { return std::find(which.begin(), which.end(), true) != which.end(); };
    const Eigen::VectorXd all = Eigen::VectorXd::Ones(groups.count);

    ImpactOutcome chosen;
    if (!solve(all, FlowRule::nonAssociative, chosen))
    {
        return impact;
    }
    std::vector<char> gains = whichGain(chosen);
    if (isAny(gains))
    {
        // What creates no energy for sure: no impulse, and with the tolerance of the solver most often k = 0
        // with Coulomb's law, or with the associative one, which is a projection.
        ImpactOutcome low{problem.velocity,
                          Eigen::VectorXd::Zero(Dim * static_cast<Eigen::Index>(groups.ofPoint.size())),
                          Eigen::VectorXd::Zero(groups.count), Eigen::VectorXd::Zero(groups.count)};
        std::vector<char> missing = gains;
        for (const FlowRule flowRule : {FlowRule::nonAssociative, FlowRule::associative})
        {
            const bool isKnown = flowRule == FlowRule::nonAssociative && problem.restitution == 0;
            ImpactOutcome plastic;
            if (!isKnown && isAny(missing) && solve(Eigen::VectorXd::Zero(groups.count), flowRule, plastic))
            {
                const std::vector<char> plasticGains = whichGain(plastic);
                std::vector<char> taken = missing;
                for (std::size_t group = 0; group < taken.size(); ++group)
                {
                    taken[group] = missing[group] && !plasticGains[group];
                    missing[group] = missing[group] && plasticGains[group];
                }
                takeGroups<Dim>(low, plastic, groups, taken);
            }
        }
        ImpactOutcome high = chosen;
        std::vector<char> others = gains;
        for (char& isOther : others)
        {
            isOther = !isOther;
        }
        takeGroups<Dim>(low, chosen, groups, others);
        Eigen::VectorXd roots = rootsBetween(problem, groups, low, high);
        for (int round = 0; round < mostRefinements; ++round)
        {
            const Eigen::VectorXd share = low.share + roots.cwiseProduct(high.share - low.share);
            const double undecided = (high.share - low.share)
                                         .cwiseProduct(roots.cwiseProduct(all - roots))
                                         .lpNorm<Eigen::Infinity>();
            ImpactOutcome trial;
            if (undecided <= restitutionKnown || !solve(share, FlowRule::nonAssociative, trial))
            {
                break;
            }
            const std::vector<char> trialGains = whichGain(trial);
            std::vector<char> lower = gains;
            std::vector<char> higher = gains;
            for (std::size_t group = 0; group < gains.size(); ++group)
            {
                lower[group] = gains[group] && !trialGains[group];
                higher[group] = gains[group] && trialGains[group];
            }
            takeGroups<Dim>(low, trial, groups, lower);
            takeGroups<Dim>(high, trial, groups, higher);
            roots = rootsBetween(problem, groups, low, high);
        }
        chosen = between(problem, groups, low, high, roots);
    }

    impact.isSolved = true;
    impact.velocity = std::move(chosen.velocity);
    impact.impulse = problem.timeStep * chosen.force;
    impact.restitutionShare = problem.restitution > 0 ? chosen.share.minCoeff() : 1;
    impact.energyLoss = -chosen.gain.sum();
    for (std::size_t i = 0; problem.closingBySupports.size() > 0 && i < problem.meeting.size(); ++i)
    {
        impact.workOfSupports += chosen.force.segment<Dim>(Dim * static_cast<Eigen::Index>(i))
                                     .dot(problem.closingBySupports.template segment<Dim>(
                                         Dim * static_cast<Eigen::Index>(problem.meeting[i])));
    }
    return impact;
}

template Impact impactOf(const ImpactProblem<2>& problem, const StepSettings& settings);
template Eigen::VectorXd closingVelocity(const StepProgram<2>& program, const Eigen::VectorXd& velocity,
                                         const Eigen::VectorXd& closingBySupports, double timeStep);
template Impact impactOf(const ImpactProblem<3>& problem, const StepSettings& settings);
template Eigen::VectorXd closingVelocity(const StepProgram<3>& program, const Eigen::VectorXd& velocity,
                                         const Eigen::VectorXd& closingBySupports, double timeStep);

} // namespace drystone
