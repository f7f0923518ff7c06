// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The figures that a run of a case can be queried for, one registry for searches and ensembles:
///
///     alpha { table "postProcessing/limitAnalysis/0/limitAnalysis.dat"; column alpha; }
///     alpha { type multiplier; }
///     drift { type displacement; block 12; }
///     loss  { type energy; part frictionLoss; }
#pragma once

#include "dictionary/Registry.h"
#include "quantities/TableFigure.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tuple>

namespace drystone
{

template<int Dim>
struct DynamicCase;
template<int Dim>
struct Motion;

/// Follows a motion; has a figure of it at the end.
template<int Dim>
class MotionWatch
{
public:
    virtual ~MotionWatch() = default;
    /// To be called before the first step, with 0, and after each one. \param timeStep that led here [s]
    virtual void observe(const Motion<Dim>& motion, double timeStep) = 0;
    /// nan where the run has no such figure
    virtual double value() const = 0;
};

/// Begins to follow a motion. \throws FatalIOError for a block that does not exist, or is fixed, and for what
/// motions of this dimension do not have
template<int Dim>
using WatchMaker =
    std::function<std::unique_ptr<MotionWatch<Dim>>(const DynamicCase<Dim>& scene, const Motion<Dim>& start)>;

/// A figure that is requested: one of the three is there.
struct Figure
{
    std::string unit;                            ///< empty where a table knows it
    std::optional<TableFigure> table;            ///< read from what the applications write
    std::optional<std::string> ofCollapse;       ///< column of limitAnalysis.dat
    std::optional<std::string> ofLeastIntensity; ///< column of leastIntensity.dat
    /// Of a motion of the plane or of space, computed without files: std::get<WatchMaker<Dim>>(watch); either
    /// both are there or none.
    std::tuple<WatchMaker<2>, WatchMaker<3>> watch;

    bool isOfMotion() const { return static_cast<bool>(std::get<WatchMaker<2>>(watch)); }
};

/// All types: table (which `type` need not say), multiplier, motion, displacement, rotation, drop, energy,
/// returnTime.
const Registry<Figure>& figureTypes();

/// Writes `type table;` into those figures under a key that name a table and no type.
void sayTable(Dictionary& dictionary, const std::string& key);

/// The table that limitAnalysis writes, in a case.
inline constexpr const char* limitAnalysisTableName = "postProcessing/limitAnalysis/0/limitAnalysis.dat";
/// That of incrementalDynamics.
inline constexpr const char* leastIntensityTableName =
    "postProcessing/incrementalDynamics/0/leastIntensity.dat";

} // namespace drystone
