// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a run through time comes to, in a few lines of the log: how far blocks went, and whether they rest.
#pragma once

#include "dynamics/DynamicCase.h"
#include "dynamics/StepObservation.h"

#include <string>
#include <vector>

namespace drystone
{

/// Displacements up to this are small [mean block size]: lever arms as built, and with them the loads at
/// which blocks turn over, are wrong by about as much.
constexpr double mostSmallDisplacement = 0.05;

/// Whether a step misses Coulomb's law by so much that it is said: by more than gaps may be off.
/// \param flowError see StepResiduals [m]
template<int Dim>
bool missesFlow(const DynamicCase<Dim>& scene, double flowError)
{
    return flowError > scene.schemes.contactTolerance * scene.blockSize;
}

/// Whether blocks end a step so deep in each other, where no contact was foreseen, that it is said.
/// \param depth see StepResiduals::overlookedDepth [m]
template<int Dim>
bool overlooksContacts(const DynamicCase<Dim>& scene, double depth)
{
    constexpr double mostOverlooked = 1e-4; // of the mean block size; what rounded edges enter by is less
    return depth > mostOverlooked * scene.blockSize;
}

/// The steps of a run with an error so large that it is said.
struct StepsInError
{
    int count = 0;
    double largest = 0;     ///< error [m]
    double timeOfFirst = 0; ///< [s]

    /// \param error of a step that ends at \param time [m], [s]
    void add(double error, double time);
};

/// Largest displacement of a mass centre during a run and the state at its end. Holds a reference to the
/// scene. Displacements are from the structure as built, relative to the ground.
template<int Dim>
class MotionSummary
{
public:
    explicit MotionSummary(const DynamicCase<Dim>& dynamicCase);

    /// To be called at the end of each step. \param residuals of it
    void observe(const DynamicState<Dim>& state, const StepResiduals& residuals = {});

    /// `Largest displacement: 0.0402 m, block 12, at 1.34 s`, and whether the blocks rest at the end, have
    /// come to rest, or move. They rest when all are slower than restSpeed, and have been for so long that
    /// this is no turning point of a block that rocks. Then, where steps miss Coulomb's law, how many do, and
    /// by how much, and likewise where they overlook contacts or have no rebounds. None before the first
    /// step.
    std::vector<std::string> lines(const DynamicState<Dim>& last) const;

    /// With `smallDisplacements yes;`: that a block has moved or turned so far that contact points and lever
    /// arms as built are wrong. Empty where none has.
    std::string doubtAboutDisplacements() const;

    /// Speed below which a block counts as at rest [m/s]: that of a fall through 1e-8 of the mean block size.
    double restSpeed() const;

private:
    /// Speeds of a block at its mass centre and, by its turning, at about its corners: the larger [m/s].
    double speedOf(const DynamicState<Dim>& state, int free) const;

    std::string largestDisplacementLine() const;
    std::string restLine(const DynamicState<Dim>& last) const;
    std::string farBlocksLine(const DynamicState<Dim>& last) const;
    std::string missedFlowLine() const;
    std::string overlookedContactsLine() const;
    std::string withoutReboundsLine() const;

    const DynamicCase<Dim>& scene;
    double largest = 0; ///< [m]
    int farthestBlock = -1;
    double timeOfLargest = 0;
    double largestTurn = 0; ///< [rad]
    int turnedBlock = -1;
    double fastest = 0;    ///< speed at any time of the run [m/s]
    double restsSince = 0; ///< end of the first step from which no block was faster than restSpeed [s]
    bool rests = false;
    int steps = 0;                   ///< observed
    StepsInError missedFlow;         ///< by dilatancy, see missesFlow
    StepsInError overlookedContacts; ///< by depth, see overlooksContacts
    StepsInError withoutRebounds;    ///< see StepResiduals, without an error that is measured
};

} // namespace drystone
