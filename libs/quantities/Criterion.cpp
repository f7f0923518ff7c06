// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The registry of criteria.
#include "quantities/Criterion.h"

#include <fmt/format.h>

#include <numbers>

namespace drystone
{
namespace
{

/// \param make of an assembly, of the plane or of space, the criterion
template<class Make>
CriterionMaker forBoth(Make make)
{
    return {make, make};
}

template<int Dim>
Criterion<Dim> above(InstantFigure<Dim> figure, double limit)
{
    std::string summary = fmt::format("{} above {:g} {}", figure.subject, limit, figure.unit);
    return {std::move(figure), limit, std::move(summary)};
}

void declareBlock(Options& options, std::optional<int>& block)
{
    options.optional("block", block, "index of the block to watch; absent: all").atLeast(0).example("0");
}

struct MotionSettings
{
    double displacement = 1e-6;
};

void declare(Options& options, MotionSettings& settings)
{
    options
        .optional("displacement", settings.displacement,
                  "of any corner of any block, from where the run began: beyond this it has moved")
        .unit("m")
        .above(0);
}

CriterionMaker makeMotion(const MotionSettings& settings, const Dictionary& dictionary)
{
    return forBoth([settings, location = dictionary.location()]<int Dim>(const Assembly<Dim>& assembly)
                   { return above(farthestCorner(assembly, location), settings.displacement); });
}

struct DisplacementLimit
{
    std::optional<int> block;
    double limit = 0;
};

void declare(Options& options, DisplacementLimit& settings)
{
    declareBlock(options, settings.block);
    options.required("limit", settings.limit, "of the displacement of the mass centre")
        .unit("m")
        .above(0)
        .example("0.05");
}

CriterionMaker makeDisplacementCriterion(const DisplacementLimit& settings, const Dictionary& dictionary)
{
    return forBoth(
        [settings, location = dictionary.locationOf("block")]<int Dim>(const Assembly<Dim>& assembly)
        { return above(displacementOf(assembly, settings.block, location), settings.limit); });
}

struct RotationSettings
{
    std::optional<int> block;
    double limit = 0;
};

void declare(Options& options, RotationSettings& settings)
{
    declareBlock(options, settings.block);
    options
        .required("limit", settings.limit,
                  "of the rotation, either way; in space the angle of the turn, which is pi at most")
        .unit("rad")
        .above(0)
        .example("0.2");
}

CriterionMaker makeRotation(const RotationSettings& settings, const Dictionary& dictionary)
{
    return forBoth(
        [settings, location = dictionary.locationOf("block"),
         ofLimit = dictionary.locationOf("limit")]<int Dim>(const Assembly<Dim>& assembly)
        {
            if (Dim == 3 && settings.limit >= std::numbers::pi)
            {
                throw FatalIOError(
                    "In space the rotation of a block is the angle of the turn from where it began, "
                    "which is pi at most: it is never above this limit.\n\nGive a limit below pi.",
                    ofLimit);
            }
            return above(rotationOf(assembly, settings.block, location), settings.limit);
        });
}

struct CollapseSettings
{
    std::optional<int> block;
    double drop = 0.5;
};

void declare(Options& options, CollapseSettings& settings)
{
    declareBlock(options, settings.block);
    options
        .optional("drop", settings.drop,
                  "how far the mass centre of a block sinks when it falls, in mean block sizes (the root of "
                  "the mean area, in space the cube root of the mean volume)")
        .above(0);
}

CriterionMaker makeCollapse(const CollapseSettings& settings, const Dictionary& dictionary)
{
    return forBoth(
        [settings, location = dictionary.locationOf("block")]<int Dim>(const Assembly<Dim>& assembly)
        {
            Criterion<Dim> criterion =
                above(dropOf(assembly, settings.block, location), settings.drop * meanBlockSize(assembly));
            criterion.summary = fmt::format(
                "{} falls by more than {:g} m",
                settings.block ? fmt::format("block {}", *settings.block) : "any block", criterion.limit);
            return criterion;
        });
}

} // namespace

const Registry<CriterionMaker>& criterionTypes()
{
    static const Registry<CriterionMaker> registry{
        "criterion",
        {model<CriterionMaker, MotionSettings>("motion", "something moves at all", makeMotion),
         model<CriterionMaker, DisplacementLimit>("displacement", "a block is displaced by more than this",
                                                  makeDisplacementCriterion),
         model<CriterionMaker, RotationSettings>("rotation", "a block turns by more than this", makeRotation),
         model<CriterionMaker, CollapseSettings>("collapse", "a block falls", makeCollapse)}};
    return registry;
}

} // namespace drystone
