// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Groups of blocks that meet each other: their energy, and outcomes put together from several.
#include "dynamics/ImpactGroups.h"

#include "core/DisjointSets.h"

#include <algorithm>
#include <cmath>

namespace drystone
{

template<int Dim>
ImpactGroups impactGroups(const ImpactProblem<Dim>& problem)
{
    const StepProgram<Dim>& program = problem.program;
    DisjointSets together(static_cast<std::size_t>(program.bodies));
    for (const std::size_t point : problem.meeting)
    {
        const auto& contact = program.contacts[point];
        if (contact.first >= 0 && contact.second >= 0)
        {
            together.join(contact.first, contact.second);
        }
    }
    ImpactGroups groups;
    groups.ofBody.assign(static_cast<std::size_t>(program.bodies), -1);
    std::vector<int> ofFirst(groups.ofBody.size(), -1);
    const auto groupOf = [&](int body)
    {
        int& group = ofFirst[static_cast<std::size_t>(together.firstOf(body))];
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

template<int Dim>
Eigen::VectorXd gainOf(const ImpactProblem<Dim>& problem, const ImpactGroups& groups,
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

namespace
{

/// Where along the segment from 0, which creates no energy, to 1, which does, none is created any more: the
/// root of low + slope s + curvature s^2, low <= 0.
double rootOfGain(double low, double slope, double curvature)
{
    const double radicand = std::max(slope * slope - 4 * curvature * low, 0.0);
    const double root = slope > 0 ? -2 * low / (slope + std::sqrt(radicand))
                                  : (std::sqrt(radicand) - slope) / (2 * curvature);
    return std::isfinite(root) ? std::clamp(root, 0.0, 1.0) : 0;
}

} // namespace

template<int Dim>
Eigen::VectorXd rootsBetween(const ImpactProblem<Dim>& problem, const ImpactGroups& groups,
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

template<int Dim>
void takeGroups(ImpactOutcome& outcome, const ImpactOutcome& other, const ImpactGroups& groups,
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

template<int Dim>
ImpactOutcome outcomeBetween(const ImpactProblem<Dim>& problem, const ImpactGroups& groups,
                             const ImpactOutcome& low, const ImpactOutcome& high, const Eigen::VectorXd& part)
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

template ImpactGroups impactGroups(const ImpactProblem<2>& problem);
template Eigen::VectorXd gainOf(const ImpactProblem<2>& problem, const ImpactGroups& groups,
                                const Eigen::VectorXd& velocity, const Eigen::VectorXd& force);
template Eigen::VectorXd rootsBetween(const ImpactProblem<2>& problem, const ImpactGroups& groups,
                                      const ImpactOutcome& low, const ImpactOutcome& high);
template void takeGroups<2>(ImpactOutcome& outcome, const ImpactOutcome& other, const ImpactGroups& groups,
                            const std::vector<char>& which);
template ImpactOutcome outcomeBetween(const ImpactProblem<2>& problem, const ImpactGroups& groups,
                                      const ImpactOutcome& low, const ImpactOutcome& high,
                                      const Eigen::VectorXd& part);
template ImpactGroups impactGroups(const ImpactProblem<3>& problem);
template Eigen::VectorXd gainOf(const ImpactProblem<3>& problem, const ImpactGroups& groups,
                                const Eigen::VectorXd& velocity, const Eigen::VectorXd& force);
template Eigen::VectorXd rootsBetween(const ImpactProblem<3>& problem, const ImpactGroups& groups,
                                      const ImpactOutcome& low, const ImpactOutcome& high);
template void takeGroups<3>(ImpactOutcome& outcome, const ImpactOutcome& other, const ImpactGroups& groups,
                            const std::vector<char>& which);
template ImpactOutcome outcomeBetween(const ImpactProblem<3>& problem, const ImpactGroups& groups,
                                      const ImpactOutcome& low, const ImpactOutcome& high,
                                      const Eigen::VectorXd& part);

} // namespace drystone
