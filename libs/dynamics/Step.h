// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A time step while it is taken: its stages, and what they hand to each other.
#pragma once

#include "dynamics/Motion.h"
#include "effects/StepEnergy.h"

namespace drystone
{

/// Where in a step blocks collide that are apart at its start.
struct ImpactChoice
{
    ImpactInstant instant = ImpactInstant::stepStart;
    double tolerance = 0;       ///< blocks that would meet within this time meet now [s]
    double shortestFlight = 0;  ///< blocks that would be back before this time do not rebound [s]
    double wholeStep = 0;       ///< that the step is a part of [s]; 0: itself
    bool isOfAllBlocks = false; ///< see Step: points collided in another part
};

/// Points of a step and the forces that they carry.
template<int Dim>
struct PointForces
{
    std::vector<ContactPoint<Dim>> points;
    std::vector<Vector<Dim>> forces; ///< one a point, (normal, tangent) [N]
};

/// Forces that attempts at the parts of one step have found: Coulomb's law is followed from them to those of
/// the next attempt, which are more alike than those of the last step.
template<int Dim>
struct AttemptForces
{
    PointForces<Dim> start;   ///< where the next attempt begins; empty: with those of the last step
    PointForces<Dim> meeting; ///< of the first attempt at a part, in the course of which blocks meet
    PointForces<Dim> apart;   ///< of the last one, as if they did not meet
};

/// What is known of the end of a step.
struct StepSolution
{
    ThetaStep result;
    bool isSolved = false;
    /// Below 1: blocks meet after this part of the step, and it is to be solved again that long.
    double length = 1;
    Eigen::VectorXd velocity;    ///< that the step starts from: after the impacts
    Eigen::VectorXd flight;      ///< displacement of blocks in free flight beyond the step's; or empty: none
    double lostInImpacts = 0;    ///< [J]
    double rubbedInImpacts = 0;  ///< of it by friction [J]
    double workOfSupports = 0;   ///< in impacts, and on bodies that they stop [J]
    double restitutionShare = 1; ///< the least of the impacts, see Impact
    Eigen::VectorXd impulse;     ///< of all impacts, Dim a point [N s]; empty: there were none
    int impacts = 0;             ///< [-]
    std::vector<std::size_t> collided; ///< points of the last impact
    bool sticks = false;   ///< solved by the associative law in place of Coulomb's, as nothing slides
    bool collides = false; ///< points meet, or part and are back before its end
    bool slides = false;   ///< Coulomb's law has made a point slide that carries a force, see StickingStep.h
    double slowest = 0;    ///< points that close more slowly do not collide [m/s], set by the first impact
};

/// Steps with less than everything are solved with errors in their gaps of this part of those allowed. With
/// everything they take a second program more often, after which gaps are far better than they are required
/// to be; and an error in a gap is several times as much at the far end of a body.
constexpr double partOfGapWithLess = 0.1;

/// Some of the points of a step.
struct MeasuredPoints
{
    std::vector<std::size_t> points;
    std::vector<int> free; ///< as of the structure, with -1 for blocks at which none of the points is
};

/// One step that is not parted, from `motion` on. Members are filled by the stage under whose name they
/// stand. Its own lists refer to each other, and so it stays where it was made.
template<int Dim>
struct Step
{
    /// What acts on the blocks in the step.
    /// \param ofAttempts kept by the caller; null: there are none
    Step(const DynamicCase<Dim>& dynamicCase, Motion<Dim>& current, double length, const ImpactChoice& choice,
         AttemptForces<Dim>* ofAttempts = nullptr);
    Step(const Step<Dim>&) = delete;
    Step<Dim>& operator=(const Step<Dim>&) = delete;

    const DynamicCase<Dim>& scene;
    Motion<Dim>& motion; ///< but for `attempt`, `work`, `stageTimes` and what is found again (see `advance`)
                         ///< changed by `move` and later
    ImpactChoice impacts;
    AttemptForces<Dim>* attemptForces; ///< of other attempts at parts of the step; not owned, null: none
    ThetaScheme scheme;
    StepSettings settings;
    MassMatrix<Dim> mass;     ///< with the blocks where they are at the start
    Eigen::VectorXd deadLoad; ///< mean over the step: as the blocks stand in the middle of it
    Eigen::VectorXd load;     ///< mean over the step of all that acts on the blocks but the contacts
    double acceleration = 0;  ///< the largest that the loads alone give a block [m/s2]
    std::vector<SupportStep<Dim>> supports; ///< see supportSteps

    // findContacts
    /// Displacements by which the step ended before with blocks in each other: what meets there is looked for
    /// too.
    std::vector<Eigen::VectorXd> overlooking;
    std::vector<ContactPoint<Dim>> points;    ///< with their gaps at the start
    std::vector<ContactColumns<Dim>> columns; ///< lever arms where the momenta of the step want them
    std::vector<ContactColumns<Dim>>
        arrivals; ///< those at the start, where impacts need them; or empty: same

    // assemble, contribute
    StepProgram<Dim> program;
    StepGuess guess;
    Eigen::VectorXd nearForce;     ///< of another attempt, at the points of this one [N]; or empty
    Eigen::VectorXd gapsOfEffects; ///< what effects, and overlaps that stay, have put into the gaps; or empty
    Eigen::VectorXd bySupports;    ///< by how much points close because supports move [m]; or empty
    std::vector<EffectState> effectStates; ///< as they are at the end of the step
    Relinearisation<Dim> relinearise;      ///< empty with smallDisplacements
    Eigen::VectorXd loadAtStart;           ///< of the program, before impacts change the momenta

    // solve, collide, review
    StepSolution solved;
    double workBeforeSolution = 0; ///< of Motion::work, done until then
    int overlapsLeft = 0;          ///< see Motion, after the step
    std::vector<char> isAwake;     ///< likewise
    std::vector<int> bodies;       ///< likewise
    bool isInVain = false; ///< fewer bodies were tried and gained little, or were not tried, as they had not
    /// Of each free block, whether it is taken as one body with others, so that forces between them are not
    /// known yet and its moments follow from its motion; empty: none is.
    std::vector<char> isShared;
    /// What the relinearisation measures while the other points are within bodies, with theta 1: the points
    /// of the program that it is given, in their order; null: all. Not owned.
    const MeasuredPoints* measuredPoints = nullptr;

    bool isOfAllBlocks = false; ///< since points collide: none is held, or one with others

    // move
    Eigen::VectorXd velocityAtEnd; ///< in space angular velocities in axes that have not turned in the step
    double keptInFlight = 0;       ///< algorithmic loss that blocks in free flight do not have [J]
    double lostInStopping = 0;     ///< by bodies that stand still and had a velocity left [J]

    std::vector<ContactPoint<Dim>> pointsAtEnd;

    // measureEnergy
    StepEnergy energy;
};

/// Whether a program of the case has impacts of their own; otherwise it is the plastic impact itself.
template<int Dim>
bool hasImpacts(const DynamicCase<Dim>& scene);

/// Whether points have collided in each of the last steps: a program with fewer bodies, whose steps are taken
/// again with all blocks where points collide, probably leads to nothing.
template<int Dim>
bool keepsColliding(const Motion<Dim>& motion);

/// What effects may look at in the step, as far as it is known. The step is not owned.
template<int Dim>
EffectContext<Dim> contextOf(const Step<Dim>& step);

/// Finds the contact points of the step: where blocks touch, or may meet within it.
template<int Dim>
void findContacts(Step<Dim>& step);

/// What the step that is solved moves the blocks by, free flight included.
template<int Dim>
Eigen::VectorXd displacementAtEnd(const Step<Dim>& step);

/// By how much the step that is solved ends with blocks in each other, between which other corners and edges
/// meet than were foreseen [m].
template<int Dim>
double overlookedDepth(const Step<Dim>& step);

/// Makes the program of the rigid step, and a guess of its solution from the last one.
template<int Dim>
void assemble(Step<Dim>& step);

/// Adds what effects and moving supports put into the program.
template<int Dim>
void contribute(Step<Dim>& step);

/// Lets all overlaps stay that there are when the step begins. A stone that is wedged between others, as a
/// hook in a hook, cannot leave one by the associative law, whose program begins each step by Coulomb's: it
/// has no solution then, however small the overlap is. \return whether there was any to be closed
template<int Dim>
bool leaveAllOverlaps(Step<Dim>& step);

/// Solves the program as it stands.
template<int Dim>
void solve(Step<Dim>& step);

/// Forgets what was solved: the step begins again at its start.
template<int Dim>
void beginAgain(Step<Dim>& step);

/// Impacts of their own, where restitution or a theta below 1 requires them (Impact.h): finds the points that
/// the solution closes, and gives the blocks the velocities after the impact there. \return whether the step
/// is to be solved again from these
///
/// With `located` a point that is apart when the step begins, and closes in it, does not collide before it is
/// there: the step is solved as if it was not, which gives the gap at the end; with gap and closing velocity
/// at the start that makes a parabola, whose root is the instant. For one body under constant forces that is
/// exact for every theta, and else right to third order in the step. `solved.length` then says where that is,
/// and the caller takes the step up to there, and the rest, which begins with the impact.
///
/// With restitution and theta above 1/2 blocks in free flight, which no contact force acts on, move by the
/// mean of their velocities: exact under constant loads, where backward Euler would take g dt from the
/// velocity of every bounce.
template<int Dim>
bool collide(Step<Dim>& step);

/// Effects examine the solution, whose residuals are kept in `attempt`. \return whether one has changed the
/// program, which is to be solved again
template<int Dim>
bool review(Step<Dim>& step);

/// Moves the blocks by finite rotations, gives them their velocities and measures the contact points there.
template<int Dim>
void move(Step<Dim>& step);

/// Measures where the energy of the step went.
template<int Dim>
void measureEnergy(Step<Dim>& step);

/// Whether contacts have done work on the blocks, more than a tenth of the energy that they had or got, and
/// than closing a ten thousandth of a block takes: as where blocks turn too far in a step, or are found in
/// each other.
template<int Dim>
bool createsEnergy(const Step<Dim>& step);

/// Keeps the ledger of energy, stops blocks that effects leave out, and leaves contact points and forces for
/// the next step.
template<int Dim>
void account(Step<Dim>& step);

/// Adds what a solution has taken to the counts of the attempt and of the work allowed.
template<int Dim>
void countWork(Step<Dim>& step, int iterations, int factorisations, int programs);

/// Gaps, and minus the slips, where displacements take the blocks, Dim a point [m].
template<int Dim>
Eigen::VectorXd openingAtEnd(const Step<Dim>& step, const Eigen::VectorXd& displacement,
                             const Eigen::VectorXd& contactForce);

} // namespace drystone
