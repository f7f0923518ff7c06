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

namespace drystone
{

template<int Dim>
struct DynamicCase;
template<int Dim>
struct Motion;

/// Follows a motion; has a figure of it at the end.
class MotionWatch
{
public:
    virtual ~MotionWatch() = default;
    /// To be called before the first step, with 0, and after each one. \param timeStep that led here [s]
    virtual void observe(const Motion<2>& motion, double timeStep) = 0;
    /// nan where the run has no such figure
    virtual double value() const = 0;
};

/// A figure that is requested: one of the three is there.
struct Figure
{
    std::string unit;                            ///< empty where a table knows it
    std::optional<TableFigure> table;            ///< read from what the applications write
    std::optional<std::string> ofCollapse;       ///< column of limitAnalysis.dat
    std::optional<std::string> ofLeastIntensity; ///< column of leastIntensity.dat
    /// Of a motion, computed without files. \throws FatalIOError for a block that does not exist, or is fixed
    std::function<std::unique_ptr<MotionWatch>(const DynamicCase<2>& scene, const Motion<2>& start)> watch;
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
