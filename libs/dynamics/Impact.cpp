// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The law of impacts, apart from the steps: the law of an instant knows no time integration.
#include "dynamics/Impact.h"

#include "conic/form/Form.h"
#include "dynamics/ImpactGroups.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace drystone
{
namespace
{

/// Where Newton's law creates energy: programs solved for the restitution that does not.
constexpr int mostRefinements = 6;

/// Of a program: those that have a solution are solved in fewer, and those of wedged blocks have none.
constexpr int mostIterations = 60;

/// After so many factorisations what is known of the impact is enough.
constexpr int manyFactorisations = 300;

/// They end when energy leaves undecided no more than this part of the restitution.
constexpr double restitutionKnown = 1e-3;

/// A gain that is rounding of the kinetic energy, as a share of it.
constexpr double roundingOfEnergy = 8 * std::numeric_limits<double>::epsilon();

} // namespace

template<int Dim>
bool isBonded(const StepProgram<Dim>& program, std::size_t point)
{
    return program.hasStrength() && program.strength[point].isBond();
}

namespace
{

/// Velocity at which a point parts by Newton's law, e u_n-, where that is not too slow to count [m/s].
/// \param closing u- of all points
template<int Dim>
double reboundAt(const ImpactProblem<Dim>& problem, const Eigen::VectorXd& closing, std::size_t point)
{
    const double rebound = isBonded(problem.program, point)
                               ? 0
                               : problem.restitution * closing[Dim * static_cast<Eigen::Index>(point)];
    return rebound > problem.slowestRebound ? rebound : 0;
}

/// The program of the impact: a step of theta 1 without loads whose gaps are -dt k e u_n-. Bonds that are
/// stronger than any force hold, and would only cost digits.
template<int Dim>
StepProgram<Dim> impactProgram(const ImpactProblem<Dim>& problem, const ImpactGroups& groups,
                               const Eigen::VectorXd& closing, const Eigen::VectorXd& share, double blockSize)
{
    const StepProgram<Dim>& program = problem.program;
    const double timeStep = problem.timeStep;
    StepProgram<Dim> impact;
    impact.bodies = program.bodies;
    const MassMatrix<Dim> inertia = over(problem.mass, timeStep * timeStep);
    for (int body = 0; body < program.bodies; ++body)
    {
        impact.inertia.push_back(blockOf(inertia, body));
    }
    impact.load = timeStep * times(inertia, problem.velocity);
    impact.gap = Eigen::VectorXd::Zero(Dim * static_cast<Eigen::Index>(problem.meeting.size()));
    for (std::size_t i = 0; i < problem.meeting.size(); ++i)
    {
        const std::size_t point = problem.meeting[i];
        impact.contacts.push_back(program.contacts[point]);
        impact.friction.push_back(program.friction[point]);
        const auto row = Dim * static_cast<Eigen::Index>(i);
        const auto there = Dim * static_cast<Eigen::Index>(point);
        impact.gap[row] = -timeStep * share[groups.ofPoint[i]] * reboundAt(problem, closing, point);
        if (problem.closingBySupports.size() > 0)
        {
            impact.gap.template segment<Dim>(row) -= problem.closingBySupports.template segment<Dim>(there);
        }
    }
    const double strongest = program.hasStrength() ? largestForce(impact, blockSize) : 0;
    for (std::size_t i = 0; program.hasStrength() && i < problem.meeting.size(); ++i)
    {
        Strength strength = program.strength[problem.meeting[i]];
        strength.cohesion = std::min(strength.cohesion * problem.timeOfBonds / timeStep, strongest);
        strength.tension = std::min(strength.tension * problem.timeOfBonds / timeStep, strongest);
        impact.strength.push_back(strength);
    }
    return impact;
}

} // namespace

template<int Dim>
Eigen::VectorXd closingVelocity(const StepProgram<Dim>& program, const Eigen::VectorXd& velocity,
                                const Eigen::VectorXd& closingBySupports, double timeStep)
{
    Eigen::VectorXd closing = applyTransposed(program, velocity);
    if (closingBySupports.size() > 0)
    {
        closing += closingBySupports / timeStep;
    }
    return closing;
}

namespace
{

/// The search for the impact that creates no energy: its programs share a start and a symbolic analysis.
template<int Dim>
class ImpactSearch
{
public:
    ImpactSearch(const ImpactProblem<Dim>& ofBlocks, const StepSettings& settings)
        : problem(ofBlocks),
          groups(impactGroups(problem)),
          closing(closingVelocity(problem.program, problem.velocity, problem.closingBySupports,
                                  problem.timeStep)),
          energy(Eigen::VectorXd::Zero(groups.count)),
          instant(settings),
          isFollowed(settings.flowRule == FlowRule::nonAssociative && settings.overlaps == Overlaps::damped)
    {
        instant.kind = StepKind::impact;
        instant.solver.maximumIterations = std::min(instant.solver.maximumIterations, mostIterations);
        instant.overlaps = isFollowed ? Overlaps::closed : Overlaps::none;
        addUpEnergy();
        takeStart();
    }

    /// \return whether it is solved
    bool find(ImpactOutcome& chosen);

    /// Of the restitution, what is left of it where it is least; 1 where no point rebounds.
    double leastShare(const ImpactOutcome& chosen) const;

    SolverWork work;
    int programs = 0;

private:
    void addUpEnergy();
    void takeStart();
    bool followInstead();
    bool solve(const Eigen::VectorXd& share, FlowRule flowRule, ImpactOutcome& outcome);
    std::vector<char> whichGain(const ImpactOutcome& outcome) const;
    bool solveOfWedged(ImpactOutcome& chosen);
    ImpactOutcome withoutGain(std::vector<char> missing);
    void takeGain(ImpactOutcome& chosen);
    void addRebounds(ImpactOutcome& chosen);
    ImpactOutcome refined(const std::vector<char>& gains, ImpactOutcome low, ImpactOutcome high);

    const ImpactProblem<Dim>& problem;
    ImpactGroups groups;
    Eigen::VectorXd closing;
    Eigen::VectorXd energy; ///< kinetic, of each group before the impact [J]
    StepSettings instant;
    bool isWedged = false; ///< found by the last program
    /// Steps that are followed have unique forces, from which impulses can be followed too.
    bool isFollowed;
    SymbolicAnalysis symbolic; ///< of all programs: they differ in their gaps
    StepGuess guess;
};

template<int Dim>
void ImpactSearch<Dim>::addUpEnergy()
{
    for (std::size_t body = 0; body < groups.ofBody.size(); ++body)
    {
        if (groups.ofBody[body] >= 0)
        {
            const auto row = freedomCount<Dim> * static_cast<Eigen::Index>(body);
            energy[groups.ofBody[body]] +=
                0.5
                * squareOf(problem.mass, static_cast<int>(body),
                           problem.velocity.template segment<freedomCount<Dim>>(row));
        }
    }
}

template<int Dim>
void ImpactSearch<Dim>::takeStart()
{
    if (isFollowed && problem.stepForce)
    {
        guess.contactForce.resize(Dim * static_cast<Eigen::Index>(problem.meeting.size()));
        for (std::size_t i = 0; i < problem.meeting.size(); ++i)
        {
            guess.contactForce.template segment<Dim>(Dim * static_cast<Eigen::Index>(i)) =
                problem.stepForce->template segment<Dim>(Dim * static_cast<Eigen::Index>(problem.meeting[i]));
        }
    }
}

/// Where programs do not lead to Coulomb's law the law of points that give way often does. \return whether it
/// is another way
template<int Dim>
bool ImpactSearch<Dim>::followInstead()
{
    const bool isOther = !isFollowed;
    isFollowed = true;
    instant.overlaps = Overlaps::closed;
    return isOther;
}

/// The impact with a share of the restitution for each group. \return whether it is solved
template<int Dim>
bool ImpactSearch<Dim>::solve(const Eigen::VectorXd& share, FlowRule flowRule, ImpactOutcome& outcome)
{
    instant.flowRule = flowRule;
    StepProgram<Dim> program = impactProgram(problem, groups, closing, share, instant.blockSize);
    const double largest =
        share.isZero(0) ? std::numeric_limits<double>::infinity() : largestForce(program, instant.blockSize);
    const ThetaStep step =
        solveThetaStep(std::move(program), instant, guess, Relinearisation<Dim>(), &symbolic);
    addWork(work, step);
    programs += step.programs;
    isWedged = step.contactForce.template lpNorm<Eigen::Infinity>() > largest;
    if (step.status != SolveStatus::optimal || isWedged)
    {
        return false;
    }
    outcome = {step.displacement / problem.timeStep, step.contactForce, share, {}};
    if (isFollowed)
    {
        guess.contactForce = step.contactForce;
    }
    outcome.gain = gainOf(problem, groups, outcome.velocity, outcome.force);
    return true;
}

template<int Dim>
std::vector<char> ImpactSearch<Dim>::whichGain(const ImpactOutcome& outcome) const
{
    std::vector<char> which(static_cast<std::size_t>(groups.count));
    for (int group = 0; group < groups.count; ++group)
    {
        which[static_cast<std::size_t>(group)] = outcome.gain[group] > roundingOfEnergy * energy[group];
    }
    return which;
}

bool isAny(const std::vector<char>& which)
{
    return std::find(which.begin(), which.end(), true) != which.end();
}

/// What creates no energy for sure: no impulse, and with the tolerance of the solver most often k = 0 with
/// Coulomb's law, or with the associative one, which is a projection. \param missing groups that it is for
template<int Dim>
ImpactOutcome ImpactSearch<Dim>::withoutGain(std::vector<char> missing)
{
    ImpactOutcome low{problem.velocity,
                      Eigen::VectorXd::Zero(Dim * static_cast<Eigen::Index>(groups.ofPoint.size())),
                      Eigen::VectorXd::Zero(groups.count), Eigen::VectorXd::Zero(groups.count)};
    for (const FlowRule flowRule : {FlowRule::nonAssociative, FlowRule::associative})
    {
        const bool isKnown = flowRule == FlowRule::nonAssociative && problem.restitution == 0;
        ImpactOutcome plastic;
        if (!isKnown && isAny(missing) && solve(Eigen::VectorXd::Zero(groups.count), flowRule, plastic))
        {
            const std::vector<char> plasticGains = whichGain(plastic);
            std::vector<char> taken = missing;
            for (std::size_t group = 0; group < taken.size(); ++group)
            {
                taken[group] = missing[group] && !plasticGains[group];
                missing[group] = missing[group] && plasticGains[group];
            }
            takeGroups<Dim>(low, plastic, groups, taken);
        }
    }
    return low;
}

/// Between an impact without a gain of energy and one with it. \param gains groups that gain
template<int Dim>
ImpactOutcome ImpactSearch<Dim>::refined(const std::vector<char>& gains, ImpactOutcome low,
                                         ImpactOutcome high)
{
    const Eigen::VectorXd all = Eigen::VectorXd::Ones(groups.count);
    Eigen::VectorXd roots = rootsBetween(problem, groups, low, high);
    for (int round = 0; round < mostRefinements; ++round)
    {
        const Eigen::VectorXd share = low.share + roots.cwiseProduct(high.share - low.share);
        const double undecided = (high.share - low.share)
                                     .cwiseProduct(roots.cwiseProduct(all - roots))
                                     .template lpNorm<Eigen::Infinity>();
        ImpactOutcome trial;
        if (undecided <= restitutionKnown || work.factorisations > manyFactorisations
            || !solve(share, FlowRule::nonAssociative, trial))
        {
            break;
        }
        const std::vector<char> trialGains = whichGain(trial);
        std::vector<char> lower = gains;
        std::vector<char> higher = gains;
        for (std::size_t group = 0; group < gains.size(); ++group)
        {
            lower[group] = gains[group] && !trialGains[group];
            higher[group] = gains[group] && trialGains[group];
        }
        takeGroups<Dim>(low, trial, groups, lower);
        takeGroups<Dim>(high, trial, groups, higher);
        roots = rootsBetween(problem, groups, low, high);
    }
    return outcomeBetween(problem, groups, low, high, roots);
}

/// A block that is wedged can not part from all points that it meets, as Newton's law requires: the impact
/// without rebound. \return whether there is one
template<int Dim>
bool ImpactSearch<Dim>::solveOfWedged(ImpactOutcome& chosen)
{
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(groups.count);
    return solve(none, FlowRule::nonAssociative, chosen) || solve(none, FlowRule::associative, chosen);
}

/// Takes from an outcome the energy that it creates.
template<int Dim>
void ImpactSearch<Dim>::takeGain(ImpactOutcome& chosen)
{
    const std::vector<char> gains = whichGain(chosen);
    if (isAny(gains))
    {
        ImpactOutcome low = withoutGain(gains);
        std::vector<char> others = gains;
        for (char& isOther : others)
        {
            isOther = !isOther;
        }
        takeGroups<Dim>(low, chosen, groups, others);
        chosen = refined(gains, std::move(low), chosen);
    }
}

/// Where the groups have not all come without rebound for themselves: lets those rebound that can.
template<int Dim>
void ImpactSearch<Dim>::addRebounds(ImpactOutcome& chosen)
{
    for (int group = 0; groups.count > 1 && problem.restitution > 0 && group < groups.count; ++group)
    {
        ImpactOutcome rebound;
        if (work.factorisations <= manyFactorisations
            && solve(Eigen::VectorXd::Unit(groups.count, group), FlowRule::nonAssociative, rebound))
        {
            std::vector<char> only(static_cast<std::size_t>(groups.count), false);
            only[static_cast<std::size_t>(group)] = true;
            takeGain(rebound);
            takeGroups<Dim>(chosen, rebound, groups, only);
        }
    }
}

template<int Dim>
bool ImpactSearch<Dim>::find(ImpactOutcome& chosen)
{
    const Eigen::VectorXd all = Eigen::VectorXd::Ones(groups.count);
    const bool isNewtons = solve(all, FlowRule::nonAssociative, chosen)
                           || (!isWedged && followInstead() && solve(all, FlowRule::nonAssociative, chosen));
    if (!isNewtons && !solveOfWedged(chosen))
    {
        return false;
    }
    takeGain(chosen);
    if (!isNewtons)
    {
        addRebounds(chosen);
    }
    return true;
}

template<int Dim>
double ImpactSearch<Dim>::leastShare(const ImpactOutcome& chosen) const
{
    double least = 1;
    for (std::size_t i = 0; i < problem.meeting.size(); ++i)
    {
        if (reboundAt(problem, closing, problem.meeting[i]) > 0)
        {
            least = std::min(least, chosen.share[groups.ofPoint[i]]);
        }
    }
    return least;
}

} // namespace

template<int Dim>
Impact impactOf(const ImpactProblem<Dim>& problem, const StepSettings& settings)
{
    ImpactSearch<Dim> search(problem, settings);
    ImpactOutcome chosen;
    Impact impact;
    impact.isSolved = search.find(chosen);
    addWork(impact, search.work);
    impact.programs = search.programs;
    if (!impact.isSolved)
    {
        return impact;
    }
    impact.velocity = std::move(chosen.velocity);
    impact.impulse = problem.timeStep * chosen.force;
    impact.restitutionShare = search.leastShare(chosen);
    impact.energyLoss = -chosen.gain.sum();
    for (std::size_t i = 0; problem.closingBySupports.size() > 0 && i < problem.meeting.size(); ++i)
    {
        impact.workOfSupports += chosen.force.segment<Dim>(Dim * static_cast<Eigen::Index>(i))
                                     .dot(problem.closingBySupports.template segment<Dim>(
                                         Dim * static_cast<Eigen::Index>(problem.meeting[i])));
    }
    return impact;
}

template bool isBonded(const StepProgram<2>& program, std::size_t point);
template Impact impactOf(const ImpactProblem<2>& problem, const StepSettings& settings);
template Eigen::VectorXd closingVelocity(const StepProgram<2>& program, const Eigen::VectorXd& velocity,
                                         const Eigen::VectorXd& closingBySupports, double timeStep);
template bool isBonded(const StepProgram<3>& program, std::size_t point);
template Impact impactOf(const ImpactProblem<3>& problem, const StepSettings& settings);
template Eigen::VectorXd closingVelocity(const StepProgram<3>& program, const Eigen::VectorXd& velocity,
                                         const Eigen::VectorXd& closingBySupports, double timeStep);

} // namespace drystone
