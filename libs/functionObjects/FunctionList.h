// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The `functions` of controlDict: which tables are written, and when.
///
///     functions
///     {
///         energy { writeInterval 10; }                       // the type is the name unless it is given
///         crown  { type blockMotion; blocks (7); writeControl runTime; writeInterval 0.05; }
///     }
#pragma once

#include "dictionary/Registry.h"
#include "functionObjects/FunctionObject.h"
#include "runControl/OutputControl.h"
#include "runControl/ThreadControls.h"
#include "runControl/Time.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace drystone
{

/// A function object as specified in the dictionary; not yet constructed.
template<int Dim>
struct FunctionPlan
{
    bool enabled = true;
    OutputSettings control;          ///< when to write; each step unless the dictionary gives it
    std::optional<double> timeStart; ///< not before [s]
    std::optional<double> timeEnd;   ///< not after [s]
    std::vector<double> times;       ///< to write at, ascending [s]; when there are some `control` has no say
    int writePrecision = 12;         ///< significant digits
    bool pictures = false;           ///< whether its tables are drawn over time when the run ends

    /// \throws FatalIOError when the function requests what the assembly does not have
    std::function<std::unique_ptr<FunctionObject<Dim>>(FunctionOutput, const Assembly<Dim>&)> make;
};

/// All types of function object: energy, blockMotion, contactForces, residuals, stageTimes, groundMotion,
/// motionPictures.
template<int Dim>
const Registry<FunctionPlan<Dim>>& functionTypes();

/// system/controlDict as a whole, for -help and the annotated dictionaries: time reads the one part of it,
/// function objects the other.
struct ControlDictSettings
{
    SteppedTimeControls controls;
    ThreadControls threads;
    std::vector<Named<FunctionPlan<2>>> functions;
};
void declare(Options& options, ControlDictSettings& settings);

/// The function objects of a run.
template<int Dim>
class FunctionList
{
public:
    /// None: `-noFunctionObjects`, or a case without functions.
    FunctionList() = default;

    /// Reads and checks all functions; nothing is written yet.
    /// \param functions     the sub-dictionary of controlDict
    /// \param caseDirectory postProcessing/ is made in it
    /// \param startName     name of the time at which this run starts or continues
    /// \param begin         that time
    /// \param startTime     of controlDict, from which intervals of time are counted [s]
    /// \throws FatalIOError for what is wrong with the dictionary
    FunctionList(const Dictionary& functions, const std::filesystem::path& caseDirectory,
                 const std::string& startName, const TimePoint& begin, double startTime,
                 const Assembly<Dim>& assembly);

    /// Lets each function write that is due. To be called once per step, in order.
    /// \throws FatalError when a table cannot be written
    void write(const StepObservation<Dim>& step, const TimePoint& now);

    /// Lets each function write of a state that was stored, whatever its interval: between its timeStart and
    /// timeEnd, and where it has `times`, at the first state from each of them on. In order.
    void writeStored(const StepObservation<Dim>& step, const TimePoint& now);

    /// Draws the tables of the functions with `pictures yes;` and prints which. To be called when the run
    /// ends. \throws FatalError naming what cannot be written
    void writePictures() const;

    /// How long until the next instant of a function with adjustableRunTime, or the next of its `times`;
    /// infinite when there is none [s].
    double timeToNextWrite(double time, double deltaT) const;

    /// Warns of functions that write nothing, or not at all their times, in a run with this endTime [s].
    void questionTimes(double endTime, double deltaT) const;

    /// Warns, after a run that ended at this time [s], of functions that have written nothing though they
    /// were meant to by then.
    void questionUnwritten(double end) const;

    /// Warns of `times` that have passed when the run begins, which is where its motion does.
    void questionTimesBeforeMotion() const;

    /// Names in the order of the dictionary, for the log; functions that are not enabled are not in the list.
    std::vector<std::string> names() const;

    /// Those of them with something in their folders.
    std::vector<std::string> writtenNames() const;

private:
    struct Function
    {
        std::string name;
        SourceLocation place; ///< of its entry
        FunctionPlan<Dim> plan;
        OutputControl control;
        std::filesystem::path folder; ///< postProcessing/<name>/<start>
        std::unique_ptr<FunctionObject<Dim>> object;
        bool hasWritten = false;
    };
    std::vector<Function> functions;
    std::string title; ///< of the case
    PictureFormats pictureFormats{PictureFormat::svg};
    double written = 0; ///< up to where `times` have been written [s]
};

} // namespace drystone
