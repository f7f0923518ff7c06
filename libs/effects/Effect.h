// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What an effect is: terms in the program of a time step, and what follows from them.
#pragma once

#include "conic/ConeProgram.h"
#include "contact/ContactPoint.h"
#include "effects/StepEnergy.h"
#include "effects/Structure.h"
#include "effects/SupportStep.h"
#include "timeSeries/GroundAcceleration.h"

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drystone
{

/// Whether contact points and lever arms follow the blocks, or stay as built.
enum class Displacements
{
    large,
    small
};

constexpr std::array<std::pair<std::string_view, Displacements>, 2> namesOf(Displacements)
{
    return {{{"large", Displacements::large}, {"small", Displacements::small}}};
}

/// The program of a step.
template<int Dim>
using StepProgram = ConeProgram<freedomCount<Dim>, Dim>;

struct GroundMotion;

/// What an effect remembers from step to step. A step that is not solved leaves it as it was.
struct EffectState
{
    std::vector<char> flags;     ///< whatever the effect keeps, one a bond, a block ..
    std::vector<double> numbers; ///< likewise
    std::vector<int> ofPoints;   ///< of the points of the step, from `contribute` to `review`
};

/// What an effect may look at in a step. Nothing is owned.
template<int Dim>
struct EffectContext
{
    const Structure<Dim>& structure;
    const std::vector<Placement<Dim>>& placements; ///< one a block: at the start of the step, in `account`
                                                   ///< at its end
    const std::vector<ContactPoint<Dim>>& points;  ///< of the step, with their gaps at its start; none before
                                                   ///< they are found
    const Eigen::VectorXd& forcesBefore;           ///< of the last step at these points [N], Dim a point
    const std::vector<Vector<Dim>>& allForcesBefore; ///< at the points of the last step (normal, tangent) [N]
    const MassMatrix<Dim>& mass; ///< M with the blocks where they are at the start of the step
    Displacements displacements = Displacements::large;
    double theta = 1;            ///< weight of the end of the step
    double start = 0;            ///< of the step [s]
    double timeStep = 0;         ///< [s]
    double acceleration = 0;     ///< the largest that the loads give a block [m/s2]
    double contactTolerance = 0; ///< error allowed in the gaps at the end of the step [m]
    double tolerance = 0;        ///< of the solver
};

/// A solved step, for effects. Nothing is owned.
struct EffectSolution
{
    const Eigen::VectorXd& displacement; ///< y, rows of each free block [m, rad]
    const Eigen::VectorXd& contactForce; ///< c, (normal, shear) of each point, mean over the step [N]
    const std::function<Eigen::VectorXd()>& openingAtEnd; ///< gaps, and minus the slips, at its end [m]
};

/// What an effect makes of a solution.
enum class Review
{
    accepted,
    solveAgain ///< the program has been changed
};

/// What others have to know of an effect.
struct EffectTraits
{
    bool isCompliant = false;  ///< contact points give way under force
    bool holdsJoints = false;  ///< joints have strengths in addition to friction
    bool actsOnBlocks = false; ///< blocks that touch nothing feel it too, and not as a load
    bool movesSupports = false;
    /// A step from rest to rest is the same without it, but for the load that it adds and for what it puts
    /// into the program, which is the same in each such step; steps in which supports move are none. Said by
    /// each effect, with the reason.
    bool isIdleAtRest = false;
    double stiffness = 0; ///< of compliant contact points against pressing [N/m]
    double damping = 0;   ///< force over momentum of each block, as part of the program's inertia [1/s]
};

/// Numbers under names, as a state keeps them.
using EffectArrays = std::map<std::string, std::vector<double>>;

/// Values that an effect has written with the blocks, one a block.
struct EffectField
{
    std::string name;
    std::vector<double> values;
};

/// One effect of a case. Immutable, so that threads may share it; what changes is in an EffectState. Whatever
/// an effect has nothing to do with it leaves as it is here.
template<int Dim>
class Effect
{
public:
    virtual ~Effect() = default;
    virtual EffectTraits traits() const { return {}; }

    /// What it remembers at the start of a motion.
    virtual void start(const Structure<Dim>&, const std::vector<Placement<Dim>>&, EffectState&) const {}

    /// Adds to the forces [N] and moments [N m] on the blocks, freedomCount<Dim> rows each: those that are
    /// known before the step is solved.
    virtual void addLoad(const EffectContext<Dim>&, const EffectState&, Eigen::VectorXd& /*load*/) const {}

    /// Loads of which addLoad adds a sum with factors that change in time, if it does: what the structure
    /// carries of each is found before it acts. In a case always the same; rows of each free block.
    virtual std::vector<Eigen::VectorXd> loadDirections(const Structure<Dim>&) const { return {}; }

    /// The motion of the ground that the run is seen from; null: the effect is none of that.
    virtual const GroundMotion* groundMotion() const { return nullptr; }

    /// What it requires of a step that begins at a time and chooses its length: an effect that is a given
    /// function of time must not be stepped over.
    virtual StepBounds stepBounds(double /*time*/) const { return {}; }

    /// How each block goes with its support between two instants; not at all for all others; empty: nothing
    /// moves supports. \param placements at the first instant
    virtual std::vector<SupportStep<Dim>> supportSteps(const Structure<Dim>&,
                                                       const std::vector<Placement<Dim>>& /*placements*/,
                                                       double /*from*/, double /*to*/) const
    {
        return {};
    }

    /// The mean velocities (ux uy rz), in space (ux uy uz rx ry rz), of the mass centres of all blocks
    /// between two instants, zero where no support moves them; of one at an instant where they are the same
    /// [m/s and rad/s]. Empty: likewise
    virtual std::vector<BlockVector<Dim>> supportVelocities(const Structure<Dim>&,
                                                            const std::vector<Placement<Dim>>& /*placements*/,
                                                            double /*from*/, double /*to*/) const
    {
        return {};
    }

    /// Adds to the program, which has the terms of the rigid step; its load is addLoad's.
    virtual void contribute(const EffectContext<Dim>&, EffectState&, StepProgram<Dim>&) const {}

    /// Examines a solution.
    virtual Review review(const EffectContext<Dim>&, const EffectSolution&, EffectState&,
                          StepProgram<Dim>&) const
    {
        return Review::accepted;
    }

    /// Takes what is the effect's own out of the energies of the rigid step, and names it.
    virtual void account(const EffectContext<Dim>&, const EffectSolution&, StepEnergy&) const {}

    /// Blocks that are left out from now on: they stop, touch nothing and feel no load.
    /// \param placements at the end of a step
    virtual std::vector<int> leaveOut(const Structure<Dim>&,
                                      const std::vector<Placement<Dim>>& /*placements*/, EffectState&) const
    {
        return {};
    }

    /// The strengths that it gives the points; empty: none.
    virtual std::vector<Strength> strengths(const EffectContext<Dim>&, const EffectState&) const
    {
        return {};
    }

    /// What a restart needs, and gets.
    virtual void save(const EffectState&, EffectArrays&) const {}
    virtual void restore(const EffectArrays&, EffectState&) const {}

    /// What is written with the blocks.
    virtual std::vector<EffectField> blockFields(const EffectState&) const { return {}; }

    /// A line of the log before the first step, and one after a step; empty: none.
    virtual std::string startText(const Structure<Dim>&, const EffectState&) const { return {}; }
    virtual std::string stepText(const EffectState& /*before*/, const EffectState& /*after*/) const
    {
        return {};
    }
};

/// The effects of a case, in the order in which they contribute.
template<int Dim>
using Effects = std::vector<std::shared_ptr<const Effect<Dim>>>;

/// What all of them together are: idle at rest where each of them is, the rest where any of them is.
template<int Dim>
EffectTraits traitsOf(const Effects<Dim>& effects);

/// As of one effect, for the one among them that moves supports.
template<int Dim>
std::vector<SupportStep<Dim>> supportSteps(const Effects<Dim>& effects, const Structure<Dim>& structure,
                                           const std::vector<Placement<Dim>>& placements, double from,
                                           double to);
/// Likewise; one a block in any case.
template<int Dim>
std::vector<BlockVector<Dim>> supportVelocities(const Effects<Dim>& effects, const Structure<Dim>& structure,
                                                const std::vector<Placement<Dim>>& placements, double from,
                                                double to);

} // namespace drystone
