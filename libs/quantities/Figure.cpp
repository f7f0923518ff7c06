// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The registry of figures.
#include "quantities/Figure.h"

#include "quantities/MotionFigures.h"

#include <fmt/format.h>

#include <cmath>

namespace drystone
{
namespace
{

/// One number of those that a figure has at the instants of a motion.
class InstantWatch final : public MotionWatch
{
public:
    InstantWatch(InstantFigure watched, DynamicState<2> begin, Take number)
        : figure(std::move(watched)), start(std::move(begin)), take(number)
    {
    }
    void observe(const Motion<2>& motion, double) override { values.push_back(figure.at(start, motion)); }
    double value() const override { return taken(values, take); }

private:
    InstantFigure figure;
    DynamicState<2> start;
    Take take;
    std::vector<double> values;
};

class ReturnTimeWatch final : public MotionWatch
{
public:
    ReturnTimeWatch(ReturnWatch watched, std::size_t number) : returns(watched), count(number) {}
    void observe(const Motion<2>& motion, double timeStep) override { returns.observe(motion, timeStep); }
    double value() const override
    {
        return returns.returns().size() < count ? std::nan("") : returns.returns()[count - 1];
    }

private:
    ReturnWatch returns;
    std::size_t count;
};

/// \param make of the structure the figure at one instant
template<class Make>
Figure instantFigure(std::string unit, Take take, Make make)
{
    Figure figure;
    figure.unit = std::move(unit);
    figure.watch = [take, make](const DynamicCase<2>& scene, const Motion<2>& start)
    { return std::make_unique<InstantWatch>(make(scene.assembly), start.state, take); };
    return figure;
}

void declareTake(Options& options, Take& take)
{
    options.optional("take", take,
                     "which of the numbers at the ends of the steps; largest: the one farthest from zero, "
                     "without its sign");
}

struct MultiplierSettings
{
};
void declare(Options&, MultiplierSettings&) {}

struct FarthestSettings
{
    Take take = Take::largest;
};
void declare(Options& options, FarthestSettings& settings)
{
    declareTake(options, settings.take);
}

struct BlockFigureSettings
{
    std::optional<int> block;
    Take take = Take::largest;
};
void declare(Options& options, BlockFigureSettings& settings)
{
    options.optional("block", settings.block, "index of the block; absent: the largest of all")
        .atLeast(0)
        .example("0");
    declareTake(options, settings.take);
}

struct DisplacementSettings
{
    BlockFigureSettings common;
    std::optional<std::array<double, 3>> direction;
};
void declare(Options& options, DisplacementSettings& settings)
{
    declare(options, settings.common);
    options
        .optional("direction", settings.direction,
                  "along which the way of the mass centre of the block counts, with its sign; absent: its "
                  "length counts")
        .example("(1 0 0)");
    options.check("direction",
                  [&settings]
                  {
                      return !settings.direction      ? ""
                             : !settings.common.block ? "A direction is for one block: give `block`."
                             : std::hypot((*settings.direction)[0], (*settings.direction)[1]) > 0
                                 ? ""
                                 : "The direction has no length in the plane.";
                  });
}

struct EnergySettings
{
    EnergyPart part = EnergyPart::dissipation;
    Take take = Take::last;
};
void declare(Options& options, EnergySettings& settings)
{
    options.optional(
        "part", settings.part,
        "mechanical: kinetic and potential; dissipation: friction, impacts, damping and what the "
        "integration loses");
    declareTake(options, settings.take);
}

struct ReturnTimeSettings
{
    int block = 0;
    int count = 1;
};
void declare(Options& options, ReturnTimeSettings& settings)
{
    options.required("block", settings.block, "index of the block that rocks").atLeast(0).example("1");
    options.optional("count", settings.count, "how many times it has come back upright")
        .atLeast(1)
        .atMost(1000);
}

Figure makeTable(const TableFigure& settings)
{
    Figure figure;
    figure.table = settings;
    if (settings.table == limitAnalysisTableName)
    {
        figure.ofCollapse = settings.column;
    }
    if (settings.table == leastIntensityTableName)
    {
        figure.ofLeastIntensity = settings.column;
    }
    return figure;
}

Figure makeDisplacement(const DisplacementSettings& settings, const Dictionary& dictionary)
{
    return instantFigure("m", settings.common.take,
                         [settings, location = dictionary.locationOf("block")](const Assembly<2>& assembly)
                         {
                             if (!settings.direction)
                             {
                                 return displacementOf(assembly, settings.common.block, location);
                             }
                             const Vector<2> direction((*settings.direction)[0], (*settings.direction)[1]);
                             return displacementAlong(assembly, *settings.common.block,
                                                      direction.normalized(), location);
                         });
}

Figure makeReturnTime(const ReturnTimeSettings& settings, const Dictionary& dictionary)
{
    Figure figure;
    figure.unit = "s";
    figure.watch =
        [settings, location = dictionary.locationOf("block")](const DynamicCase<2>& scene, const Motion<2>&)
    {
        const std::size_t block = freeBlock(scene.assembly, settings.block, location);
        return std::make_unique<ReturnTimeWatch>(ReturnWatch(block, 3 * scene.free[block] + 2),
                                                 static_cast<std::size_t>(settings.count));
    };
    return figure;
}

} // namespace

const Registry<Figure>& figureTypes()
{
    static const Registry<Figure> registry{
        "figure",
        {model<Figure, TableFigure>("table", "a number in a table that the applications write", makeTable),
         model<Figure, MultiplierSettings>(
             "multiplier", "the collapse load multiplier of limitAnalysis",
             [](const MultiplierSettings&)
             {
                 Figure figure;
                 figure.unit = "-";
                 figure.ofCollapse = "alpha";
                 figure.table = TableFigure{limitAnalysisTableName, "alpha", Take::first};
                 return figure;
             }),
         model<Figure, FarthestSettings>(
             "motion", "displacement of any corner of any block",
             [](const FarthestSettings& settings, const Dictionary& dictionary)
             {
                 return instantFigure("m", settings.take,
                                      [location = dictionary.location()](const Assembly<2>& assembly)
                                      { return farthestCorner(assembly, location); });
             }),
         model<Figure, DisplacementSettings>("displacement", "of the mass centre of a block",
                                             makeDisplacement),
         model<Figure, BlockFigureSettings>(
             "rotation", "of a block, without its sign",
             [](const BlockFigureSettings& settings, const Dictionary& dictionary)
             {
                 return instantFigure(
                     "rad", settings.take,
                     [settings, location = dictionary.locationOf("block")](const Assembly<2>& assembly)
                     { return rotationOf(assembly, settings.block, location); });
             }),
         model<Figure, BlockFigureSettings>(
             "drop", "by which the mass centre of a block sinks",
             [](const BlockFigureSettings& settings, const Dictionary& dictionary)
             {
                 return instantFigure(
                     "m", settings.take,
                     [settings, location = dictionary.locationOf("block")](const Assembly<2>& assembly)
                     { return dropOf(assembly, settings.block, location); });
             }),
         model<Figure, EnergySettings>("energy", "a part of the ledger of energy",
                                       [](const EnergySettings& settings)
                                       {
                                           return instantFigure("J", settings.take,
                                                                [part = settings.part](const Assembly<2>&)
                                                                { return energyOf(part); });
                                       }),
         model<Figure, ReturnTimeSettings>("returnTime", "when a block that rocks is upright again",
                                           makeReturnTime)}};
    return registry;
}

void sayTable(Dictionary& dictionary, const std::string& key)
{
    Entry* results = dictionary.findExact(key);
    if (!results || !results->isDictionary())
    {
        return; // a fault that is reported when the entry is read
    }
    Dictionary& named = results->dictionary();
    for (const std::string& name : named.keywords())
    {
        Entry* entry = named.findExact(name);
        if (entry && entry->isDictionary() && !entry->dictionary().found("type")
            && entry->dictionary().found("table"))
        {
            entry->dictionary().set("type", "table");
        }
    }
}

} // namespace drystone
