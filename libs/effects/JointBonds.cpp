// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Bonds of joints: where they hold, when they break.
#include "effects/JointBonds.h"

#include "effects/JointLaws.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace drystone
{
namespace
{

/// A solver with a loose tolerance leaves forces that much below a strength that is reached.
constexpr double nearlyYielding = 1e-3;

/// The ends of an unbroken bond are no farther apart than this, in mean block sizes: what steps leave of
/// slips adds up.
constexpr double bondReach = 1e-3;

/// A bond gives way when its point moves by more than this part of what the step moves the blocks by, or by
/// more than the error allowed in gaps.
constexpr double yieldsBy = 1e-2;

/// Where a point of a block as built is now.
template<int Dim>
Vector<Dim> placed(const Vector<Dim>& position, int block, const std::vector<BlockMass<Dim>>& blocks,
                   const std::vector<Placement<Dim>>& placements)
{
    const auto index = static_cast<std::size_t>(block);
    const Placement<Dim>& placement = placements[index];
    if (rowsOf(placement.rotation).isZero(0))
    {
        return position + placement.translation;
    }
    const Vector<Dim>& centre = blocks[index].centroid;
    return centre + placement.translation + turned(placement.rotation, position - centre);
}

} // namespace

template<int Dim>
std::vector<Bond<Dim>> jointBonds(const ContactProperties& properties, const Assembly<Dim>& assembly)
{
    const bool isInJoints =
        std::any_of(properties.joints.begin(), properties.joints.end(),
                    [](const auto& joint) { return joint.second.cohesion || joint.second.tension; });
    if (!properties.cohesion && !properties.tension && !isInJoints)
    {
        return {};
    }
    const std::vector<ContactPoint<Dim>> points = findContactPoints(assembly);
    const std::vector<PointLaw> laws = pointLaws(properties, assembly, points, NewJoints::possible);
    std::vector<Bond<Dim>> bonds;
    bonds.reserve(points.size());
    bool isAny = false;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const Strength strength{laws[i].cohesion, laws[i].tension};
        bonds.push_back({points[i].block, points[i].neighbour, points[i].position, strength});
        isAny = isAny || strength.isBond();
    }
    return isAny ? bonds : std::vector<Bond<Dim>>();
}

template<int Dim>
std::vector<char> partedBonds(const std::vector<Bond<Dim>>& bonds, const std::vector<BlockMass<Dim>>& blocks,
                              const std::vector<Placement<Dim>>& placements, double reach)
{
    std::vector<char> isParted;
    isParted.reserve(bonds.size());
    for (const Bond<Dim>& bond : bonds)
    {
        const Vector<Dim> apart = placed(bond.position, bond.block, blocks, placements)
                                  - placed(bond.position, bond.neighbour, blocks, placements);
        const bool isNone = bond.strength.cohesion == 0 && bond.strength.tension == 0;
        isParted.push_back(isNone || apart.norm() > reach);
    }
    return isParted;
}

template<int Dim>
std::vector<int> bondsOfPoints(const std::vector<Bond<Dim>>& bonds, const std::vector<char>& isBroken,
                               const std::vector<BlockMass<Dim>>& blocks,
                               const std::vector<Placement<Dim>>& placements,
                               const std::vector<ContactPoint<Dim>>& points, double reach)
{
    std::vector<int> bondOfPoint(points.size(), -1);
    std::size_t first = 0; // points and bonds are both sorted by pairs of blocks
    for (std::size_t bond = 0; bond < bonds.size(); ++bond)
    {
        if (isBroken[bond])
        {
            continue;
        }
        const std::pair pair(bonds[bond].block, bonds[bond].neighbour);
        const auto pairOf = [&](std::size_t point)
        { return std::pair(points[point].block, points[point].neighbour); };
        while (first < points.size() && pairOf(first) < pair)
        {
            ++first;
        }
        const Vector<Dim> onBlock = placed(bonds[bond].position, bonds[bond].block, blocks, placements);
        const Vector<Dim> onNeighbour =
            placed(bonds[bond].position, bonds[bond].neighbour, blocks, placements);
        double nearest = reach;
        std::size_t found = points.size();
        for (std::size_t point = first; point < points.size() && pairOf(point) == pair; ++point)
        {
            const double distance = std::max((points[point].position - onBlock).norm(),
                                             (points[point].position - onNeighbour).norm());
            if (bondOfPoint[point] < 0 && distance < nearest)
            {
                nearest = distance;
                found = point;
            }
        }
        if (found < points.size())
        {
            bondOfPoint[found] = static_cast<int>(bond);
        }
    }
    return bondOfPoint;
}

template<int Dim>
double openingOf(const Bond<Dim>& bond, const std::vector<BlockMass<Dim>>& blocks,
                 const std::vector<Placement<Dim>>& placements, const ContactPoint<Dim>& point)
{
    return point.normal.dot(placed(bond.position, bond.block, blocks, placements)
                            - placed(bond.position, bond.neighbour, blocks, placements));
}

bool isAnyHeld(const std::vector<int>& bondOfPoint)
{
    return std::any_of(bondOfPoint.begin(), bondOfPoint.end(), [](int bond) { return bond >= 0; });
}

template<int Dim>
std::vector<Strength> strengthsOf(const std::vector<Bond<Dim>>& bonds, const std::vector<int>& bondOfPoint)
{
    std::vector<Strength> strengths;
    strengths.reserve(bondOfPoint.size());
    for (const int bond : bondOfPoint)
    {
        strengths.push_back(bond < 0 ? Strength{} : bonds[static_cast<std::size_t>(bond)].strength);
    }
    return strengths;
}

template<int Dim>
std::vector<int> bondsGivingWay(const StepProgram<Dim>& program, const std::vector<int>& bondOfPoint,
                                const Eigen::VectorXd& opening, const Eigen::VectorXd& contactForce,
                                const YieldTolerance& tolerance)
{
    std::vector<int> givingWay;
    for (std::size_t point = 0; point < bondOfPoint.size(); ++point)
    {
        if (bondOfPoint[point] < 0)
        {
            continue;
        }
        const Eigen::Index row = Dim * static_cast<Eigen::Index>(point);
        const Strength& strength = program.strength[point];
        const double normal = contactForce[row];
        const double shear = contactForce.segment<Dim - 1>(row + 1).norm();
        const bool opens =
            opening[row] > tolerance.length
            && normal + strength.tension <= nearlyYielding * strength.tension + tolerance.force;
        const bool slides = opening.segment<Dim - 1>(row + 1).norm() > tolerance.length
                            && strength.cohesion + program.friction[point] * normal - shear
                                   <= nearlyYielding * strength.cohesion + tolerance.force;
        if (opens || slides)
        {
            givingWay.push_back(bondOfPoint[point]);
        }
    }
    return givingWay;
}

template<int Dim>
int JointBonds<Dim>::broken(const EffectState& state) const
{
    int count = 0;
    for (std::size_t bond = 0; bond < bonds.size(); ++bond)
    {
        count += bonds[bond].strength.isBond() && state.flags[bond] ? 1 : 0;
    }
    return count;
}

template<int Dim>
void JointBonds<Dim>::start(const Structure<Dim>& structure, const std::vector<Placement<Dim>>& placements,
                            EffectState& state) const
{
    state.flags = partedBonds(bonds, structure.blocks, placements, bondReach * structure.blockSize);
}

template<int Dim>
std::vector<int> JointBonds<Dim>::bondsAt(const EffectContext<Dim>& context,
                                          const std::vector<char>& isBroken) const
{
    if (context.displacements == Displacements::large)
    {
        return bondsOfPoints(bonds, isBroken, context.structure.blocks, context.placements, context.points,
                             bondReach * context.structure.blockSize);
    }
    std::vector<int> bondOfPoint(context.points.size()); // they stay as built, in the order of the bonds
    for (std::size_t point = 0; point < bondOfPoint.size(); ++point)
    {
        bondOfPoint[point] = isBroken[point] ? -1 : static_cast<int>(point);
    }
    return bondOfPoint;
}

template<int Dim>
void JointBonds<Dim>::contribute(const EffectContext<Dim>& context, EffectState& state,
                                 StepProgram<Dim>& program) const
{
    state.ofPoints = bondsAt(context, state.flags);
    state.flags.assign(bonds.size(), true);
    for (std::size_t point = 0; point < state.ofPoints.size(); ++point)
    {
        if (state.ofPoints[point] < 0)
        {
            continue;
        }
        const auto bond = static_cast<std::size_t>(state.ofPoints[point]);
        state.flags[bond] = false;
        if (context.displacements == Displacements::large)
        {
            const double opening =
                openingOf(bonds[bond], context.structure.blocks, context.placements, context.points[point]);
            program.gap[Dim * static_cast<Eigen::Index>(point)] =
                std::abs(opening) <= context.structure.roundingGap ? 0 : opening;
        }
    }
    if (isAnyHeld(state.ofPoints))
    {
        program.strength = strengthsOf(bonds, state.ofPoints);
    }
}

template<int Dim>
Review JointBonds<Dim>::review(const EffectContext<Dim>& context, const EffectSolution& solution,
                               EffectState& state, StepProgram<Dim>& program) const
{
    if (!program.hasStrength())
    {
        return Review::accepted;
    }
    const double farthest = farthestMotion<Dim>(solution.displacement, context.structure.blockSize);
    // What a solver leaves of forces out of balance moves the blocks as well: the gap of its certificate is
    // of second order in them.
    const double leftover =
        std::sqrt(context.tolerance) * context.acceleration * context.timeStep * context.timeStep;
    const YieldTolerance tolerance{std::max(leftover, std::min(context.contactTolerance, yieldsBy * farthest))
                                       + 2 * context.structure.roundingGap,
                                   10 * context.tolerance * solution.contactForce.lpNorm<Eigen::Infinity>()};
    std::vector<int>& bondOfPoint = state.ofPoints;
    const std::vector<int> givingWay =
        bondsGivingWay(program, bondOfPoint, solution.openingAtEnd(), solution.contactForce, tolerance);
    for (const int bond : givingWay)
    {
        state.flags[static_cast<std::size_t>(bond)] = true;
        const auto point = static_cast<std::size_t>(std::find(bondOfPoint.begin(), bondOfPoint.end(), bond)
                                                    - bondOfPoint.begin());
        bondOfPoint[point] = -1;
        program.strength[point] = {};
    }
    if (!isAnyHeld(bondOfPoint))
    {
        program.strength.clear();
    }
    return givingWay.empty() ? Review::accepted : Review::solveAgain;
}

template<int Dim>
std::vector<Strength> JointBonds<Dim>::strengths(const EffectContext<Dim>& context,
                                                 const EffectState& state) const
{
    return strengthsOf(bonds, bondsAt(context, state.flags));
}

template<int Dim>
void JointBonds<Dim>::save(const EffectState& state, EffectArrays& arrays) const
{
    arrays["bondBroken"].assign(state.flags.begin(), state.flags.end());
}

template<int Dim>
void JointBonds<Dim>::restore(const EffectArrays& arrays, EffectState& state) const
{
    const auto saved = arrays.find("bondBroken");
    if (saved == arrays.end())
    {
        return;
    }
    if (saved->second.size() != bonds.size())
    {
        throw FatalError(
            fmt::format("The state to start from has {} values of bondBroken, but the structure {} "
                        "bonds. Start from time 0.",
                        saved->second.size(), bonds.size()));
    }
    state.flags.assign(saved->second.begin(), saved->second.end());
}

template<int Dim>
std::string JointBonds<Dim>::startText(const Structure<Dim>&, const EffectState& state) const
{
    return fmt::format("Bonds: {} at contact points, {} of them broken",
                       std::count_if(bonds.begin(), bonds.end(),
                                     [](const Bond<Dim>& bond) { return bond.strength.isBond(); }),
                       broken(state));
}

template<int Dim>
std::string JointBonds<Dim>::stepText(const EffectState& before, const EffectState& after) const
{
    const int now = broken(after);
    const int newly = now - broken(before);
    return newly > 0 ? fmt::format("{} bonds broke, {} are broken", newly, now) : "";
}

template<int Dim>
EffectType<Dim> bondsType()
{
    return jointEffectType<Dim>(
        "", [](Options&, ContactProperties&) {}, [](const ContactProperties&) { return false; },
        [](const EffectSource<Dim>& source) -> std::shared_ptr<const Effect<Dim>>
        {
            std::vector<Bond<Dim>> bonds = jointBonds(source.contact, source.structure.assembly);
            if (Dim == 3 && !bonds.empty() && source.solver == SolverType::gaussSeidel)
            {
                const ContactProperties& contact = source.contact;
                throw FatalIOError(
                    "In space gaussSeidel solves joints that have friction alone: set `solver "
                    "automatic;` for contactDynamics in system/solution, or remove cohesion and "
                    "tension.",
                    contact.locations.of(contact.cohesion  ? "cohesion"
                                         : contact.tension ? "tension"
                                                           : "joints"));
            }
            return bonds.empty() ? nullptr : std::make_shared<JointBonds<Dim>>(std::move(bonds));
        },
        {});
}

template class JointBonds<2>;
template EffectType<2> bondsType<2>();
template class JointBonds<3>;
template EffectType<3> bondsType<3>();

} // namespace drystone
