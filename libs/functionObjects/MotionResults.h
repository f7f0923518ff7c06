// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Results of time stepping in a case: time directories, the animation, and the tables of the functions. It
/// combines dynamics with output, which dynamics does not see.
#pragma once

#include "core/WritingThread.h"
#include "dictionary/Fingerprint.h"
#include "dynamics/Motion.h"
#include "functionObjects/EffectHistory.h"
#include "functionObjects/FunctionList.h"
#include "io/TimeDirectory.h"
#include "io/VtkSeries.h"

#include <filesystem>

namespace drystone
{

/// The motion at the time a run starts from. `<time>/state`, written by an earlier run, is continued bit for
/// bit; without one, `<time>/motion`, or the structure as built at rest.
/// \throws FatalError when a run is to continue at a time that has no state, or the state is of another
/// structure. Warns when it is of other input (KeptResults.h)
template<int Dim>
Motion<Dim> startOrContinue(const std::filesystem::path& caseDirectory, const DynamicCase<Dim>& scene,
                            Time& time);

/// With adjustTimeStep: from deltaT, or that which was wanted when the state was written. To be called after
/// startOrContinue, once the time knows all instants that steps end on; MotionResults does.
template<int Dim>
void chooseFirstTimeStep(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, Time& time);

/// Lets the solver write its cone programs as postProcessing/contactDynamics/<time>/coneProgram, when
/// `writeProgram` of system/solution requests it. \param time of the run; must outlive the scene
template<int Dim>
void writePrograms(DynamicCase<Dim>& scene, const std::filesystem::path& caseDirectory, const Time& time);

/// Whether the functions of controlDict are run.
enum class FunctionObjects
{
    asInControlDict,
    none
};

/// Writes the results of one run. Holds references to the scene, the motion and the time of the run, and
/// makes the time end adjusted steps where its functions write: it must therefore not be moved, and must live
/// as long as the time steps.
template<int Dim>
class MotionResults
{
public:
    /// Checks the functions and the folders; writes nothing yet.
    /// \throws FatalIOError for faults in the functions, FatalError for a folder that cannot be written
    MotionResults(std::filesystem::path directory, const DynamicCase<Dim>& dynamicCase,
                  const Motion<Dim>& currentMotion, Time& runTime, FunctionObjects functionObjects);
    MotionResults(const MotionResults&) = delete;
    MotionResults& operator=(const MotionResults&) = delete;

    /// The frame of the state that the run starts from, unless an earlier run has written it.
    void writeFirstFrames();

    /// To be called after each step: the functions that are due, and at the times of writeControl a time
    /// directory and a frame of VTK/blocks.vtp.series and VTK/contacts.vtp.series, and with `selection
    /// automatic` what the steps so far have called for. These are written while
    /// the run steps on, each before the next ones begin: a run that is killed continues from the last state
    /// that is there, and writes the frame of it if that is missing. \throws FatalError for what cannot be
    /// written, of a state or frame with the next one or with finish
    void write();

    /// Writes time directory and frames at the present time, due or not: before a run is abandoned.
    void writeNow();

    /// Waits until all frames are written. \throws FatalError for what could not be
    void finish();

    /// What was written and where, on standard output; after finish.
    void printWritten() const;

    const FunctionList<Dim>& functions() const { return functionList; }

private:
    /// What VTK/ shows of one time.
    struct Frames
    {
        double time;
        PolyData<Dim> blocks;
        PolyData<Dim> contacts;
    };
    Frames framesNow() const;
    void write(const Frames& frames);
    /// postProcessing/effects/<startTime>
    std::filesystem::path effectsFolder() const;

    std::filesystem::path caseDirectory;
    const DynamicCase<Dim>& scene;
    const Motion<Dim>& motion;
    Time& time;
    FunctionList<Dim> functionList;
    std::vector<InputFile> input; ///< that the motion follows from, the steps last
    StateWriter states;
    std::optional<EffectHistory<Dim>> effects; ///< with `selection automatic`, unless functions are off
    std::vector<std::string> statesWritten;    ///< names of their times
    VtkSeries blocks;
    VtkSeries contacts;
    bool hasState = false; ///< VTK/paraviewState.py was written
    WritingThread writing; ///< the one user of states, blocks and contacts from the first frame on
};

} // namespace drystone
