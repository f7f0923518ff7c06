// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Supports that move in a prescribed way.
#include "effects/SupportMotion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace drystone
{
namespace
{

using Table = std::vector<std::pair<double, double>>;

/// Velocities of a piecewise linear displacement: constant from point to point.
Table velocitiesOf(const Table& displacement)
{
    Table velocity;
    for (std::size_t i = 0; i + 1 < displacement.size(); ++i)
    {
        const double duration = displacement[i + 1].first - displacement[i].first;
        const double mean = (displacement[i + 1].second - displacement[i].second) / duration;
        velocity.emplace_back(displacement[i].first, mean);
        velocity.emplace_back(displacement[i + 1].first, mean);
    }
    return velocity;
}

enum class Jumps
{
    allowed,
    refused
};

/// What is wrong with a table that is given.
std::string faultIn(const Table& table, Jumps jumps)
{
    if (table.size() < 2)
    {
        return "The table needs two points or more: ((time value) (time value)).";
    }
    for (std::size_t i = 0; i + 1 < table.size(); ++i)
    {
        const double duration = table[i + 1].first - table[i].first;
        if (duration < 0 || (duration == 0 && jumps == Jumps::refused))
        {
            return fmt::format("The times of the table must increase: {:g} s comes after {:g} s.",
                               table[i + 1].first, table[i].first);
        }
    }
    return "";
}

std::string faultIn(const SupportMotionSettings& settings)
{
    const bool translates = !settings.displacement.empty() || !settings.velocity.empty();
    const bool turns = !settings.rotation.empty() || !settings.angularVelocity.empty();
    if (!translates && !turns)
    {
        return "A support that moves needs either displacement or velocity, or rotation or angularVelocity: "
               "a list "
               "((time value) ...).";
    }
    if (!settings.displacement.empty() && !settings.velocity.empty())
    {
        return "Give either displacement or velocity: each follows from the other.";
    }
    if (!settings.rotation.empty() && !settings.angularVelocity.empty())
    {
        return "Give either rotation or angularVelocity: each follows from the other.";
    }
    const auto faultOf = [](const Table& table, Jumps jumps)
    { return table.empty() ? std::string() : faultIn(table, jumps); };
    for (const std::string& fault :
         {faultOf(settings.displacement, Jumps::refused), faultOf(settings.velocity, Jumps::allowed),
          faultOf(settings.rotation, Jumps::refused), faultOf(settings.angularVelocity, Jumps::allowed)})
    {
        if (!fault.empty())
        {
            return fault;
        }
    }
    return "";
}

/// The history of a velocity, given itself or by what it adds up to; null where neither is given.
std::shared_ptr<const GroundAcceleration> historyOf(const Table& displacement, const Table& velocity)
{
    std::vector<double> times;
    std::vector<double> velocities;
    for (const auto& [time, value] : velocity.empty() ? velocitiesOf(displacement) : velocity)
    {
        times.push_back(time);
        velocities.push_back(value);
    }
    return times.empty() ? nullptr
                         : tabulatedAcceleration(std::move(times), std::move(velocities),
                                                 Interpolation::linear, OutOfBounds::zero);
}

/// (R - 1) arm, to the last digits.
Vector<2> swing(const Vector<2>& arm, double rotation)
{
    const double half = std::sin(rotation / 2);
    return std::sin(rotation) * Vector<2>(-arm.y(), arm.x()) - 2 * half * half * arm;
}

} // namespace

void declare(Options& options, SupportMotionSettings& settings)
{
    options
        .optional("direction", settings.direction, "of displacement or velocity; its length does not matter")
        .example("(0 -1 0)");
    options
        .optional("displacement", settings.displacement,
                  "times [s] and displacements from as built [m], straight between them")
        .example("((0 0) (2 0.05))");
    options
        .optional("velocity", settings.velocity,
                  "instead: times [s] and velocities [m/s]; a time that stands twice is a jump")
        .example("((0 0) (0.5 1) (1 0))");
    options.optional("centre", settings.centre, "of rotation, as built; it moves with the support")
        .unit("m")
        .example("(1 0 0)");
    options
        .optional("rotation", settings.rotation,
                  "times [s] and angles [rad] about the centre, straight between them")
        .example("((0 0) (2 0.01))");
    options.optional("angularVelocity", settings.angularVelocity, "instead: times [s] and velocities [rad/s]")
        .example("((0 0) (0.5 0.1) (1 0))");
    options.check("direction",
                  [&settings]
                  {
                      const bool translates = !settings.displacement.empty() || !settings.velocity.empty();
                      return settings.direction.norm() > 0 || !translates
                                 ? ""
                                 : "The direction has no length: give one such as `direction (0 -1 0);`.";
                  });
    options.check("displacement", [&settings] { return faultIn(settings); });
}

void declare(Options& options, SupportMotionFile& file)
{
    options.each(file.supports, "of the support with this name");
}

std::vector<SupportMotion> readSupportMotions(const std::filesystem::path& caseDirectory,
                                              const Assembly<2>& assembly)
{
    const Dictionary dictionary = Dictionary::readFileIfPresent(caseDirectory / "constant/supportMotion");
    std::vector<SupportMotion> motions;
    for (const auto& [name, settings] : readOptions<SupportMotionFile>(dictionary).supports)
    {
        const auto& supports = assembly.supports;
        const auto found = std::find_if(supports.begin(), supports.end(),
                                        [&name = name](const auto& support) { return support.name == name; });
        if (found == supports.end())
        {
            std::string names;
            for (const auto& support : supports)
            {
                names += " " + support.name;
            }
            throw FatalIOError(fmt::format("There is no support {}. Supports of this assembly:{}.", name,
                                           names.empty() ? " none" : names),
                               dictionary.locationOf(name));
        }
        SupportMotion motion;
        motion.support = static_cast<int>(found - supports.begin());
        motion.direction = settings.direction.norm() > 0 ? Vector<2>(settings.direction.normalized())
                                                         : Vector<2>(Vector<2>::Zero());
        motion.centre = settings.centre;
        try
        {
            motion.velocity = historyOf(settings.displacement, settings.velocity);
            motion.angularVelocity = historyOf(settings.rotation, settings.angularVelocity);
        }
        catch (const std::domain_error& error)
        {
            throw FatalIOError(std::string("Not a table of a motion: ") + error.what() + ".",
                               dictionary.locationOf(name));
        }
        motions.push_back(std::move(motion));
    }
    return motions;
}

Vector<3> displacementAfter(const SupportStep& step, double share)
{
    Vector<3> displacement;
    displacement << share * step.translation + swing(step.arm, share * step.rotation), share * step.rotation;
    return displacement;
}

std::vector<SupportStep> supportSteps(const std::vector<SupportMotion>& motions, const Assembly<2>& assembly,
                                      const std::vector<BlockMass<2>>& blocks,
                                      const std::vector<Placement<2>>& placements, double from, double to)
{
    std::vector<SupportStep> steps;
    if (motions.empty())
    {
        return steps;
    }
    steps.resize(assembly.blocks.size());
    for (const SupportMotion& motion : motions)
    {
        SupportStep step;
        if (motion.velocity)
        {
            step.translation = motion.velocity->integral(from, to) * motion.direction;
        }
        step.rotation = motion.angularVelocity ? motion.angularVelocity->integral(from, to) : 0;
        for (std::size_t block = 0; block < steps.size(); ++block)
        {
            if (assembly.blocks[block].support == motion.support)
            {
                const Vector<2> arm = blocks[block].centroid - motion.centre;
                step.arm = arm + swing(arm, placements[block].rotation);
                steps[block] = step;
            }
        }
    }
    return steps;
}

std::vector<Vector<3>> supportVelocities(const std::vector<SupportMotion>& motions,
                                         const Assembly<2>& assembly, const std::vector<BlockMass<2>>& blocks,
                                         const std::vector<Placement<2>>& placements, double from, double to)
{
    std::vector<Vector<3>> velocities(assembly.blocks.size(), Vector<3>::Zero());
    for (const SupportMotion& motion : motions)
    {
        const double spin = motion.angularVelocity ? motion.angularVelocity->mean(from, to) : 0;
        const Vector<2> ofCentre =
            motion.velocity ? Vector<2>(motion.velocity->mean(from, to) * motion.direction) : Vector<2>(0, 0);
        for (std::size_t block = 0; block < velocities.size(); ++block)
        {
            if (assembly.blocks[block].support == motion.support)
            {
                const Vector<2> built = blocks[block].centroid - motion.centre;
                const Vector<2> arm = built + swing(built, placements[block].rotation);
                velocities[block] << ofCentre + spin * Vector<2>(-arm.y(), arm.x()), spin;
            }
        }
    }
    return velocities;
}

void moveWithSupports(std::vector<Placement<2>>& placements, const std::vector<SupportStep>& steps,
                      double share)
{
    for (std::size_t block = 0; block < steps.size(); ++block)
    {
        const Vector<3> displacement = displacementAfter(steps[block], share);
        placements[block].translation += displacement.head<2>();
        placements[block].rotation += displacement[2];
    }
}

Eigen::VectorXd closingBySupports(const std::vector<ContactPoint<2>>& points,
                                  const std::vector<ContactColumns<2>>& columns,
                                  const std::vector<SupportStep>& supports)
{
    if (supports.empty())
    {
        return {};
    }
    Eigen::VectorXd closing(2 * static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const auto part = [&](const ContactColumns<2>::Matrix& column, int block) -> Vector<2>
        { return column.transpose() * displacementAfter(supports[static_cast<std::size_t>(block)]); };
        closing.segment<2>(2 * static_cast<Eigen::Index>(i)) =
            part(columns[i].onBlock, points[i].block) + part(columns[i].onNeighbour, points[i].neighbour);
    }
    return closing;
}

} // namespace drystone
