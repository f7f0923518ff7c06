// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The search for pairs of forces and mechanism by Coulomb's law: its moves, from forces to start with
/// (CollapseStart.h) to pairs (FoundPairs.h). In which order they are made says NonAssociative.h.
#pragma once

#include "conic/coulomb/CollapsePath.h"
#include "conic/form/Form.h"
#include "statics/CollapseStart.h"
#include "statics/FoundPairs.h"
#include "statics/NonAssociative.h"

#include <random>

namespace drystone
{

template<int Rows, int Forces>
class CollapseSearch
{
public:
    using Program = ConeProgram<Rows, Forces>;

    /// \param work the associative analysis, whose work it adds to; of program, as residuals and pairs are
    CollapseSearch(const Program& program, const NonAssociativeSettings& settings,
                   const InteriorPointSettings& solver, LimitAnalysis& work);

    /// \return whether there are forces for the dead load to begin with
    bool findRest();

    /// Whether the search has to end, from the first time on that its time is used up or the settings say so.
    bool isOver();

    /// Whether all that has been done so far took no longer than milliseconds, by its factorisations: the
    /// same on every machine.
    bool isCheap() const;

    /// One path, or programs with cohesion where a path would take too long, and what follows from it.
    void go(int number);

    /// With the forces of the associative collapse a mechanism that does not open where it slides, and what
    /// follows from it: blocks that slide on level joints at alpha = mu. One program at first,
    /// and no more where the search is over.
    void takeAssociativeForces();

    /// Pairs from steps from rest, with the forces of the associative collapse to begin with, or of the dead
    /// load.
    void takeStepsFromRest();

    /// Whether a mechanism is sought for the forces at the end of a path where its own is none.
    bool takesMechanisms = false;
    /// Whether paths that have not led to a pair are repeated with a little dilatancy, until there is one.
    bool wedges = Forces == 2;
    /// Whether starts are followed by paths, which have several pieces for each point, a factorisation each.
    bool followsPaths;
    FoundPairs found;
    ProperFrame<Rows, Forces> frame; ///< in which all forces and mechanisms here are

private:
    ConeSolution solve(const Program& program, const InteriorPointSettings& settings);
    /// What the exchanges of forces and mechanism solve their programs with.
    ProgramSolver<Rows, Forces> solver();
    /// Of programs whose forces are nothing but a start: to this tolerance, if it is larger.
    ProgramSolver<Rows, Forces> roughSolver(double tolerance);
    /// Whether the search is over, for what may take long.
    std::function<bool()> untilOver();
    /// Reports to the observer how far a start has been followed.
    void report(int pieces, double multiplier) const;
    CollapsePair path(const CollapseStart& start, const CollapsePathSettings& settings);
    /// Forces for the dead load with little pressure at random points, moved inwards.
    std::optional<CollapseStart> otherRest();
    /// Forces of a low multiplier that suit the mechanism of a pair, moved inwards.
    std::optional<CollapseStart> lowStart(const CoulombPair& pair, double gamma);

    /// Takes a pair, or one near it. \return whether there is one
    bool take(CoulombPair& pair);
    /// Where a stone slides between others nothing but rounding holds its motion across in the end of a path
    /// in space: its forces are right, and the mechanism follows from them. \return whether that is a pair
    bool takeMechanism(CoulombPair& pair);

    /// Programs with a cohesion in place of friction (FictitiousCohesion.h) from the pressures of a start,
    /// and the multiplier of their pair made least. \return whether they have led to a pair
    bool followCohesion(const CollapseStart& start);
    /// Follows a path, and makes the multiplier of its pair least. \return whether it has led to a pair
    bool follow(const CollapseStart& start, const CollapsePathSettings& settings);
    /// The same with a little dilatancy, which is taken away at the end but for what the tolerance allows;
    /// from the start, and from the forces of the associative collapse, where less has to move until all is
    /// wedged.
    bool followWedged(const CollapseStart& start, CollapsePathSettings settings);
    /// From the mechanism that pressures have (mechanismOfPressures) to the pairs nearby, if there are any.
    void tryPressures(const Eigen::VectorXd& contactForce);
    /// From a pair to lower ones: the least multiplier with its mechanism held, then another mechanism of
    /// those forces, in turn, while the multiplier falls.
    void descend(CoulombPair pair);

    const Program& given; ///< in the frame
    NonAssociativeSettings searchSettings;
    InteriorPointSettings solverSettings;
    LimitAnalysis& effort;
    int ofStructure = 0;               ///< factorisations of it in axes that are not those of the frame
    SymbolicAnalysis symbolicAnalysis; ///< of the last program: most have the same points
    std::mt19937 generator;
    CoulombPair associativePair; ///< where there is one; of the associative law
    PairCriterion<Rows, Forces> criterion;
    Eigen::VectorXd restingForce; ///< for the dead load alone
    double begin;                 ///< on the clock [s]
};

} // namespace drystone
