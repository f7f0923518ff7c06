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
template<int Dim>
class InstantWatch final : public MotionWatch<Dim>
{
public:
    InstantWatch(InstantFigure<Dim> watched, DynamicState<Dim> begin, Take number)
        : figure(std::move(watched)), start(std::move(begin)), take(number)
    {
    }
    void observe(const Motion<Dim>& motion, double) override { values.push_back(figure.at(start, motion)); }
    double value() const override { return taken(values, take); }

private:
    InstantFigure<Dim> figure;
    DynamicState<Dim> start;
    Take take;
    std::vector<double> values;
};

class ReturnTimeWatch final : public MotionWatch<2>
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

template<int Dim, class Make>
WatchMaker<Dim> instantWatch(Take take, Make make)
{
    return [take, make](const DynamicCase<Dim>& scene, const Motion<Dim>& start)
    { return std::make_unique<InstantWatch<Dim>>(make(scene.assembly), start.state, take); };
}

/// \param make of the structure, an assembly of the plane or of space, the figure at one instant
template<class Make>
Figure instantFigure(std::string unit, Take take, Make make)
{
    Figure figure;
    figure.unit = std::move(unit);
    figure.watch = {instantWatch<2>(take, make), instantWatch<3>(take, make)};
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
                      return !settings.direction     ? ""
                             : settings.common.block ? ""
                                                     : "A direction is for one block: give `block`.";
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
    return instantFigure(
        "m", settings.common.take,
        [settings, block = dictionary.locationOf("block"),
         direction = dictionary.locationOf("direction")]<int Dim>(const Assembly<Dim>& assembly)
        {
            return settings.direction
                       ? displacementAlong(assembly, *settings.common.block,
                                           unitDirection<Dim>(*settings.direction, direction), block)
                       : displacementOf(assembly, settings.common.block, block);
        });
}

Figure makeReturnTime(const ReturnTimeSettings& settings, const Dictionary& dictionary)
{
    Figure figure;
    figure.unit = "s";
    std::get<WatchMaker<2>>(figure.watch) =
        [settings, location = dictionary.locationOf("block")](const DynamicCase<2>& scene, const Motion<2>&)
    {
        const std::size_t block = freeBlock(scene.assembly, settings.block, location);
        return std::make_unique<ReturnTimeWatch>(ReturnWatch(block, 3 * scene.free[block] + 2),
                                                 static_cast<std::size_t>(settings.count));
    };
    std::get<WatchMaker<3>>(figure.watch) =
        [location = dictionary.location()](const DynamicCase<3>&,
                                           const Motion<3>&) -> std::unique_ptr<MotionWatch<3>>
    {
        throw FatalIOError(
            "A block of space has no one axis to rock about: returnTime is a figure of the plane. "
            "`type rotation;` is there in space too.",
            location);
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
         model<Figure, FarthestSettings>("motion", "displacement of any corner of any block",
                                         [](const FarthestSettings& settings, const Dictionary& dictionary)
                                         {
                                             return instantFigure(
                                                 "m", settings.take,
                                                 [location = dictionary.location()]<int Dim>(
                                                     const Assembly<Dim>& assembly)
                                                 { return farthestCorner(assembly, location); });
                                         }),
         model<Figure, DisplacementSettings>("displacement", "of the mass centre of a block",
                                             makeDisplacement),
         model<Figure, BlockFigureSettings>(
             "rotation", "of a block, without its sign; in space the angle of its turn, pi at most",
             [](const BlockFigureSettings& settings, const Dictionary& dictionary)
             {
                 return instantFigure("rad", settings.take,
                                      [settings, location = dictionary.locationOf("block")]<int Dim>(
                                          const Assembly<Dim>& assembly)
                                      { return rotationOf(assembly, settings.block, location); });
             }),
         model<Figure, BlockFigureSettings>(
             "drop", "by which the mass centre of a block sinks",
             [](const BlockFigureSettings& settings, const Dictionary& dictionary)
             {
                 return instantFigure("m", settings.take,
                                      [settings, location = dictionary.locationOf("block")]<int Dim>(
                                          const Assembly<Dim>& assembly)
                                      { return dropOf(assembly, settings.block, location); });
             }),
         model<Figure, EnergySettings>("energy", "a part of the ledger of energy",
                                       [](const EnergySettings& settings)
                                       {
                                           return instantFigure(
                                               "J", settings.take,
                                               [part = settings.part]<int Dim>(const Assembly<Dim>&)
                                               { return energyOf<Dim>(part); });
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
