// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Supports that move in a prescribed way.
#include "effects/SupportMotion.h"

#include "assembly/BlockShape.h"
#include "core/Degrees.h"
#include "core/Error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string_view>

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

/// What is wrong with a table, where it is given.
std::string faultIn(const Table& table, Jumps jumps)
{
    if (table.size() == 1)
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

/// What is wrong with the first point of a table of displacements or angles: supports begin as built, and do
/// not jump.
std::string faultInBeginning(const Table& table, std::string_view key)
{
    if (table.empty() || table.front().second == 0)
    {
        return "";
    }
    const auto& [time, value] = table.front();
    return fmt::format("{} begins with {:g} at {:g} s: a support is as built until then, and does not jump. "
                       "Begin with 0, for instance `{} (({:g} 0) ({:g} {:g}) ...);`, with {:g} less at each "
                       "time, or move it there from a time before.",
                       key, value, time, key, time, table[1].first, table[1].second - value, value);
}

template<int Dim>
std::string faultIn(const SupportMotionSettings<Dim>& settings)
{
    const bool translates = !settings.displacement.empty() || !settings.velocity.empty();
    const bool turns = !settings.rotation.empty() || !settings.angularVelocity.empty();
    if (!translates && !turns)
    {
        return "A support that moves needs either displacement or velocity, or rotation or angularVelocity: "
               "a list ((time value) ...).";
    }
    if (!settings.displacement.empty() && !settings.velocity.empty())
    {
        return "Give either displacement or velocity: each follows from the other.";
    }
    if (!settings.rotation.empty() && !settings.angularVelocity.empty())
    {
        return "Give either rotation or angularVelocity: each follows from the other.";
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

/// What a support turns about: in the plane there is no choice.
void declareAxis(Options&, SupportMotionSettings<2>&) {}
void declareAxis(Options& options, SupportMotionSettings<3>& settings)
{
    options.optional("axis", settings.axis, "of rotation, right hand; its length does not matter")
        .example("(0 0 1)");
    options.check("axis",
                  [&settings] {
                      return settings.axis.norm() > 0
                                 ? ""
                                 : "The axis has no length: give one such as `axis (0 0 1);`.";
                  });
}

double unitAxisOf(double axis)
{
    return axis;
}
Vector<3> unitAxisOf(const Vector<3>& axis)
{
    return axis.normalized();
}

} // namespace

template<int Dim>
void declare(Options& options, SupportMotionSettings<Dim>& settings)
{
    options
        .optional("direction", settings.direction, "of displacement or velocity; its length does not matter")
        .example("(0 -1 0)");
    options
        .optional("displacement", settings.displacement,
                  "times [s] and displacements from as built [m], straight between them; the first is 0")
        .example("((0 0) (2 0.05))");
    options
        .optional("velocity", settings.velocity,
                  "instead: times [s] and velocities [m/s], zero after the last; a time that stands twice is "
                  "a jump")
        .example("((0 0) (0.5 1) (1 0))");
    declareAxis(options, settings);
    options.optional("centre", settings.centre, "of rotation, as built; it moves with the support")
        .unit("m")
        .example("(1 0 0)");
    options
        .optional("rotation", settings.rotation,
                  "times [s] and angles [rad] about the centre, straight between them; the first is 0")
        .example("((0 0) (2 0.01))");
    options
        .optional("angularVelocity", settings.angularVelocity,
                  "instead: times [s] and velocities [rad/s], zero after the last")
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
    const auto checkPlaces = [&options](const char* key, const Table& table)
    {
        options.check(key,
                      [&table, key]
                      {
                          const std::string fault = faultIn(table, Jumps::refused);
                          return fault.empty() ? faultInBeginning(table, key) : fault;
                      });
    };
    checkPlaces("displacement", settings.displacement);
    checkPlaces("rotation", settings.rotation);
    options.check("velocity", [&settings] { return faultIn(settings.velocity, Jumps::allowed); });
    options.check("angularVelocity",
                  [&settings] { return faultIn(settings.angularVelocity, Jumps::allowed); });
}

template<int Dim>
void declare(Options& options, SupportMotionFile<Dim>& file)
{
    options.each(file.supports, "of the support with this name");
}

namespace
{

/// Diagonal of the box around all blocks [m].
template<int Dim>
double sizeOf(const Assembly<Dim>& assembly)
{
    const Box<Dim> all = boundingBox(assembly);
    return assembly.blocks.empty() ? 0 : (all.upper - all.lower).norm();
}

/// The value of a table that is farthest from 0; 0 where it has none.
double farthestOf(const Table& table)
{
    double farthest = 0;
    for (const auto& [time, value] : table)
    {
        farthest = std::abs(value) > std::abs(farthest) ? value : farthest;
    }
    return farthest;
}

/// The places at the times of a table of velocities, from 0.
Table placesOf(const Table& velocity)
{
    const std::shared_ptr<const GroundAcceleration> history = historyOf({}, velocity);
    Table places;
    for (const auto& [time, value] : velocity)
    {
        places.emplace_back(time, history->integral(velocity.front().first, time));
    }
    return places;
}

/// Questions a support that moves farther than the structure is large: millimetres, probably.
template<int Dim>
void questionDistance(const SupportMotionSettings<Dim>& settings, const Dictionary& given,
                      const Assembly<Dim>& assembly)
{
    const bool isByVelocity = !settings.velocity.empty();
    const double farthest =
        std::abs(farthestOf(isByVelocity ? placesOf(settings.velocity) : settings.displacement));
    const double size = sizeOf(assembly);
    if (size > 0 && farthest > size)
    {
        printWarning(fmt::format("The support moves {:.4g} m away, farther than the whole structure of "
                                 "{:.4g} m is large. {}; were they in millimetres, it would be {:.4g} m. It "
                                 "is used as it stands.",
                                 farthest, size,
                                 isByVelocity ? "Velocities are in m/s" : "Displacements are in metres",
                                 farthest / 1000),
                     given.locationOf(isByVelocity ? "velocity" : "displacement"));
    }
}

/// Says what has no effect, and which motions are probably in millimetres or degrees. \param given the motion
/// of one support
template<int Dim>
void questionMotion(const SupportMotionSettings<Dim>& settings, const Dictionary& given,
                    const Assembly<Dim>& assembly)
{
    const bool translates = !settings.displacement.empty() || !settings.velocity.empty();
    const bool turns = !settings.rotation.empty() || !settings.angularVelocity.empty();
    const auto warnIfGiven = [&given](const char* key, const char* without)
    {
        if (given.find(key))
        {
            printWarning(fmt::format("{} has no effect without {}.", key, without), given.locationOf(key));
        }
    };
    if (!translates)
    {
        warnIfGiven("direction", "displacement or velocity");
    }
    if (!turns)
    {
        warnIfGiven("axis", "rotation or angularVelocity");
        warnIfGiven("centre", "rotation or angularVelocity");
    }
    questionDistance(settings, given, assembly);
    const double farthest = farthestOf(settings.rotation);
    if (std::abs(farthest) > 2 * std::numbers::pi)
    {
        printWarning(doubtAboutDegrees(farthest, "(time ", ")"), given.locationOf("rotation"));
    }
}

} // namespace

template<int Dim>
std::vector<SupportMotion<Dim>> readSupportMotions(const Dictionary& dictionary,
                                                   const Assembly<Dim>& assembly)
{
    std::vector<SupportMotion<Dim>> motions;
    for (const auto& [name, settings] : readOptions<SupportMotionFile<Dim>>(dictionary).supports)
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
        SupportMotion<Dim> motion;
        motion.support = static_cast<int>(found - supports.begin());
        motion.direction = settings.direction.norm() > 0 ? Vector<Dim>(settings.direction.stableNormalized())
                                                         : Vector<Dim>(Vector<Dim>::Zero());
        motion.axis = unitAxisOf(settings.axis);
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
        questionMotion(settings, dictionary.subDict(name), assembly);
        motions.push_back(std::move(motion));
    }
    return motions;
}

template<int Dim>
std::vector<SupportStep<Dim>> MovingSupports<Dim>::supportSteps(const Structure<Dim>& structure,
                                                                const std::vector<Placement<Dim>>& placements,
                                                                double from, double to) const
{
    std::vector<SupportStep<Dim>> steps(structure.assembly.blocks.size());
    for (const SupportMotion<Dim>& motion : motions)
    {
        SupportStep<Dim> step;
        if (motion.velocity)
        {
            step.translation = motion.velocity->integral(from, to) * motion.direction;
        }
        if (motion.angularVelocity)
        {
            step.rotation = motion.angularVelocity->integral(from, to) * motion.axis;
        }
        for (std::size_t block = 0; block < steps.size(); ++block)
        {
            if (structure.assembly.blocks[block].support == motion.support)
            {
                const Vector<Dim> arm = structure.blocks[block].centroid - motion.centre;
                step.arm = arm + swing(placements[block].rotation, arm);
                steps[block] = step;
            }
        }
    }
    return steps;
}

template<int Dim>
StepBounds MovingSupports<Dim>::stepBounds(double time) const
{
    StepBounds bounds;
    for (const SupportMotion<Dim>& motion : motions)
    {
        for (const GroundAcceleration* history : {motion.velocity.get(), motion.angularVelocity.get()})
        {
            bounds.tighten(history ? history->stepBounds(time) : StepBounds());
        }
    }
    return bounds;
}

template<int Dim>
std::vector<BlockVector<Dim>>
MovingSupports<Dim>::supportVelocities(const Structure<Dim>& structure,
                                       const std::vector<Placement<Dim>>& placements, double from,
                                       double to) const
{
    std::vector<BlockVector<Dim>> velocities(structure.assembly.blocks.size(), BlockVector<Dim>::Zero());
    for (const SupportMotion<Dim>& motion : motions)
    {
        const Turn<Dim> spin =
            (motion.angularVelocity ? motion.angularVelocity->mean(from, to) : 0) * motion.axis;
        const Vector<Dim> ofCentre =
            (motion.velocity ? motion.velocity->mean(from, to) : 0) * motion.direction;
        for (std::size_t block = 0; block < velocities.size(); ++block)
        {
            if (structure.assembly.blocks[block].support == motion.support)
            {
                const Vector<Dim> built = structure.blocks[block].centroid - motion.centre;
                const Vector<Dim> arm = built + swing(placements[block].rotation, built);
                velocities[block] << ofCentre + velocityOfArm(spin, arm), rowsOf(spin);
            }
        }
    }
    return velocities;
}

template<int Dim>
EffectType<Dim> supportMotionType()
{
    return fileEffectType<Dim>("supportMotion",
                               [](const Dictionary& dictionary,
                                  const EffectSource<Dim>& source) -> std::shared_ptr<const Effect<Dim>>
                               {
                                   auto motions = readSupportMotions(dictionary, source.structure.assembly);
                                   return motions.empty()
                                              ? nullptr
                                              : std::make_shared<MovingSupports<Dim>>(std::move(motions));
                               });
}

template void declare(Options& options, SupportMotionSettings<2>& settings);
template void declare(Options& options, SupportMotionFile<2>& file);
template std::vector<SupportMotion<2>> readSupportMotions(const Dictionary& dictionary,
                                                          const Assembly<2>& assembly);
template class MovingSupports<2>;
template EffectType<2> supportMotionType<2>();
template void declare(Options& options, SupportMotionSettings<3>& settings);
template void declare(Options& options, SupportMotionFile<3>& file);
template std::vector<SupportMotion<3>> readSupportMotions(const Dictionary& dictionary,
                                                          const Assembly<3>& assembly);
template class MovingSupports<3>;
template EffectType<3> supportMotionType<3>();

} // namespace drystone
