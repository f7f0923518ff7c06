// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/SupportMotion.h"

#include <fmt/format.h>

#include <algorithm>
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

std::string faultIn(const SupportMotionSettings& settings)
{
    if (settings.displacement.empty() == settings.velocity.empty())
    {
        return "A support that moves needs either displacement or velocity: a list ((time value) ...).";
    }
    const Table& table = settings.velocity.empty() ? settings.displacement : settings.velocity;
    if (table.size() < 2)
    {
        return "The table needs two points or more: ((time value) (time value)).";
    }
    const bool mayJump = !settings.velocity.empty();
    for (std::size_t i = 0; i + 1 < table.size(); ++i)
    {
        const double duration = table[i + 1].first - table[i].first;
        if (duration < 0 || (duration == 0 && !mayJump))
        {
            return fmt::format("The times of the table must increase: {:g} s comes after {:g} s.",
                               table[i + 1].first, table[i].first);
        }
    }
    return "";
}

} // namespace

void declare(Options& options, SupportMotionSettings& settings)
{
    options.required("direction", settings.direction, "of the motion; its length does not matter")
        .example("(0 -1 0)");
    options
        .optional("displacement", settings.displacement,
                  "times [s] and displacements from as built [m], straight between them")
        .example("((0 0) (2 0.05))");
    options
        .optional("velocity", settings.velocity,
                  "instead: times [s] and velocities [m/s]; a time that stands twice is a jump")
        .example("((0 0) (0.5 1) (1 0))");
    options.check("direction",
                  [&settings] {
                      return settings.direction.norm() > 0
                                 ? ""
                                 : "The direction has no length: give one such as (0 -1 0).";
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
        motion.direction = settings.direction.normalized();
        std::vector<double> times;
        std::vector<double> velocities;
        for (const auto& [time, velocity] :
             settings.velocity.empty() ? velocitiesOf(settings.displacement) : settings.velocity)
        {
            times.push_back(time);
            velocities.push_back(velocity);
        }
        try
        {
            motion.velocity = tabulatedAcceleration(std::move(times), std::move(velocities),
                                                    Interpolation::linear, OutOfBounds::zero);
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

std::vector<Vector<2>> supportDisplacements(const std::vector<SupportMotion>& motions,
                                            const Assembly<2>& assembly, double from, double to)
{
    std::vector<Vector<2>> displacements;
    if (motions.empty())
    {
        return displacements;
    }
    displacements.assign(assembly.blocks.size(), Vector<2>::Zero());
    for (const SupportMotion& motion : motions)
    {
        const Vector<2> displacement = motion.velocity->integral(from, to) * motion.direction;
        for (std::size_t block = 0; block < displacements.size(); ++block)
        {
            if (assembly.blocks[block].support == motion.support)
            {
                displacements[block] = displacement;
            }
        }
    }
    return displacements;
}

} // namespace drystone
