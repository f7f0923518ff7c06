// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Bodies and points of a part, renumbered.
#include "conic/ProgramPart.h"

namespace drystone
{
namespace
{

/// The bodies that are marked, without points. \param number of each body in the part, -1: not in it
template<int Rows, int Forces>
ProgramPart<Rows, Forces> bodiesOf(const ConeProgram<Rows, Forces>& whole, const std::vector<char>& isPart,
                                   std::vector<int>& number)
{
    ProgramPart<Rows, Forces> part;
    number.assign(isPart.size(), -1);
    for (std::size_t body = 0; body < isPart.size(); ++body)
    {
        if (isPart[body])
        {
            number[body] = static_cast<int>(part.bodies.size());
            part.bodies.push_back(static_cast<int>(body));
            if (whole.hasInertia())
            {
                part.program.inertia.push_back(whole.inertia[body]);
            }
        }
    }
    part.program.bodies = static_cast<int>(part.bodies.size());
    part.program.load = takenFrom<Rows>(part.bodies, whole.load);
    part.program.liveLoad = takenFrom<Rows>(part.bodies, whole.liveLoad);
    return part;
}

int numberOf(const std::vector<int>& number, int body)
{
    return body < 0 ? -1 : number[static_cast<std::size_t>(body)];
}

/// \param forces F k at which points between the part and another body are known, or null: these are held
template<int Rows, int Forces>
ProgramPart<Rows, Forces> partOf(const ConeProgram<Rows, Forces>& whole, const std::vector<char>& isPart,
                                 const Eigen::VectorXd* forces)
{
    std::vector<int> number;
    ProgramPart<Rows, Forces> part = bodiesOf(whole, isPart, number);
    for (std::size_t point = 0; point < whole.contacts.size(); ++point)
    {
        ConeColumns<Rows, Forces> columns = whole.contacts[point];
        const int first = numberOf(number, columns.first);
        const int second = numberOf(number, columns.second);
        if (first < 0 && second < 0)
        {
            continue;
        }
        const bool isAtOther = (columns.first >= 0 && first < 0) || (columns.second >= 0 && second < 0);
        columns.first = first;
        columns.second = second;
        if (!forces || !isAtOther)
        {
            part.points.push_back(point);
            part.program.contacts.push_back(columns);
            part.program.friction.push_back(whole.friction[point]);
            if (whole.hasStrength())
            {
                part.program.strength.push_back(whole.strength[point]);
            }
            continue;
        }
        addForce<Rows, Forces>(columns, -forces->segment<Forces>(Forces * static_cast<Eigen::Index>(point)),
                               part.program.load);
    }
    part.program.gap = takenFrom<Forces>(part.points, whole.gap);
    part.program.compliance = takenFrom<Forces>(part.points, whole.compliance);
    return part;
}

} // namespace

template<int Rows, int Forces>
ProgramPart<Rows, Forces> partWithOthersHeld(const ConeProgram<Rows, Forces>& whole,
                                             const std::vector<char>& isPart)
{
    return partOf(whole, isPart, nullptr);
}

template<int Rows, int Forces>
ProgramPart<Rows, Forces> partUnderForces(const ConeProgram<Rows, Forces>& whole,
                                          const Eigen::VectorXd& forces, const std::vector<char>& isPart)
{
    return partOf(whole, isPart, &forces);
}

template<int Rows, int Forces>
std::vector<char> withNeighbours(const ConeProgram<Rows, Forces>& program, std::vector<char> isMarked,
                                 int times)
{
    for (int ring = 0; ring < times; ++ring)
    {
        const std::vector<char> before = isMarked;
        for (const auto& contact : program.contacts)
        {
            if (contact.first >= 0 && contact.second >= 0
                && (before[static_cast<std::size_t>(contact.first)]
                    || before[static_cast<std::size_t>(contact.second)]))
            {
                isMarked[static_cast<std::size_t>(contact.first)] = true;
                isMarked[static_cast<std::size_t>(contact.second)] = true;
            }
        }
    }
    return isMarked;
}

template ProgramPart<3, 2> partWithOthersHeld(const PlaneConeProgram&, const std::vector<char>&);
template ProgramPart<6, 3> partWithOthersHeld(const SpaceConeProgram&, const std::vector<char>&);
template ProgramPart<3, 2> partUnderForces(const PlaneConeProgram&, const Eigen::VectorXd&,
                                           const std::vector<char>&);
template ProgramPart<6, 3> partUnderForces(const SpaceConeProgram&, const Eigen::VectorXd&,
                                           const std::vector<char>&);
template std::vector<char> withNeighbours(const PlaneConeProgram&, std::vector<char>, int);
template std::vector<char> withNeighbours(const SpaceConeProgram&, std::vector<char>, int);

} // namespace drystone
