// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// cohesion { strength c; } and tension { strength s; } in motion: joints that hold until they break.
#pragma once

#include "effects/EffectType.h"

#include <filesystem>
#include <vector>

namespace drystone
{

/// What holds two blocks together at one end of a joint as built: half of the joint's area. Unbroken it
/// reshapes the cone of the contact point there as in limit analysis, -T <= n and |t| <= C + mu n, and the
/// point neither opens nor slides.
///
/// It is brittle: in a step in which it would give way, opened or sheared by what it cannot hold, it is
/// broken from the start, and the step is solved again without it; then others may give way, until none does.
/// Which do in one go is decided by forces that are redistributed as plastic joints would do it, so a
/// structure at rest breaks at the load multiplier of limit analysis, whatever the step. A broken bond is
/// gone for good; friction stays. Breaking takes no energy: a bond that does not give way does no work, and
/// one that would is not there.
///
/// An impact within a step is met by T dt at most, so that the shorter the step, the weaker the impact that
/// breaks a bond: between rigid blocks its force has no limit. Where impacts are instants of their own
/// (restitution, or a theta below 1) they are met by as much, dt the whole step (Impact.h).
template<int Dim>
struct Bond
{
    int block = -1;                             ///< index in Assembly::blocks
    int neighbour = -1;                         ///< likewise
    Vector<Dim> position = Vector<Dim>::Zero(); ///< as built [m]
    Strength strength;                          ///< of cohesion and tension [N]
};

/// The bonds of a structure, one a contact point in the order of findContactPoints, some perhaps of no
/// strength;
/// empty where no joint has cohesion or tension. \throws FatalIOError, see pointLaws
template<int Dim>
std::vector<Bond<Dim>> jointBonds(const ContactProperties& properties, const Assembly<Dim>& assembly);

/// Whether the two ends of each bond are no longer where they were joined, or it has no strength.
/// \param blocks all of them as built \param reach how far apart they may be [m]
template<int Dim>
std::vector<char> partedBonds(const std::vector<Bond<Dim>>& bonds, const std::vector<BlockMass<Dim>>& blocks,
                              const std::vector<Placement<Dim>>& placements, double reach);

/// Which unbroken bond holds each contact point, or -1.
/// \param points sorted by (block, neighbour), where the blocks are now
template<int Dim>
std::vector<int> bondsOfPoints(const std::vector<Bond<Dim>>& bonds, const std::vector<char>& isBroken,
                               const std::vector<BlockMass<Dim>>& blocks,
                               const std::vector<Placement<Dim>>& placements,
                               const std::vector<ContactPoint<Dim>>& points, double reach);

/// How far apart the two ends of the bond that holds a point are along its normal [m].
template<int Dim>
double openingOf(const Bond<Dim>& bond, const std::vector<BlockMass<Dim>>& blocks,
                 const std::vector<Placement<Dim>>& placements, const ContactPoint<Dim>& point);

/// Whether a bond holds any of the points. \param bondOfPoint see bondsOfPoints
bool isAnyHeld(const std::vector<int>& bondOfPoint);

/// The strengths of points. \param bondOfPoint see bondsOfPoints
template<int Dim>
std::vector<Strength> strengthsOf(const std::vector<Bond<Dim>>& bonds, const std::vector<int>& bondOfPoint);

/// What distinguishes a bond that gives way from one that a solver's tolerance moves.
struct YieldTolerance
{
    double length = 0; ///< opened or slid by less is not [m]
    double force = 0;  ///< of the solver [N]
};

/// The bonds that a solved step would open or shear: those at the limit of what they hold.
/// \param opening z of the points at the end of the step, (normal, tangent) [m] \param contactForce likewise
/// [N]
template<int Dim>
std::vector<int> bondsGivingWay(const StepProgram<Dim>& program, const std::vector<int>& bondOfPoint,
                                const Eigen::VectorXd& opening, const Eigen::VectorXd& contactForce,
                                const YieldTolerance& tolerance);

/// All bonds of a case as an effect. Flags of its state: which of them are broken, with what never was one.
template<int Dim>
class JointBonds final : public Effect<Dim>
{
public:
    explicit JointBonds(std::vector<Bond<Dim>> jointBonds) : bonds(std::move(jointBonds)) {}
    const std::vector<Bond<Dim>>& all() const { return bonds; }
    /// How many are broken that once held.
    int broken(const EffectState& state) const;

    /// Idle at rest: bonds give way by opening or sliding; their strengths are in the program.
    EffectTraits traits() const override { return {.holdsJoints = true, .isIdleAtRest = true}; }
    void start(const Structure<Dim>& structure, const std::vector<Placement<Dim>>& placements,
               EffectState& state) const override;
    /// Lets the bonds that are whole hold their points where they were joined. One that is left without a
    /// point is broken.
    void contribute(const EffectContext<Dim>& context, EffectState& state,
                    StepProgram<Dim>& program) const override;
    /// Takes the bonds that a solved step would open or shear out of its program.
    Review review(const EffectContext<Dim>& context, const EffectSolution& solution, EffectState& state,
                  StepProgram<Dim>& program) const override;
    std::vector<Strength> strengths(const EffectContext<Dim>& context,
                                    const EffectState& state) const override;
    void save(const EffectState& state, EffectArrays& arrays) const override;
    /// A run that continues with bonds which it began without has those whose ends are still together.
    void restore(const EffectArrays& arrays, EffectState& state) const override;
    std::string startText(const Structure<Dim>& structure, const EffectState& state) const override;
    std::string stepText(const EffectState& before, const EffectState& after) const override;

private:
    std::vector<int> bondsAt(const EffectContext<Dim>& context, const std::vector<char>& isBroken) const;

    std::vector<Bond<Dim>> bonds;
};

/// Its entry of the list: it has no keys of its own, and follows from cohesion and tension.
template<int Dim>
EffectType<Dim> bondsType();

} // namespace drystone
