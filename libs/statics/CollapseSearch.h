// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The search for pairs of forces and mechanism by Coulomb's law: its moves, and what they have found. In
/// which order they are made says NonAssociative.h.
#pragma once

#include "conic/coulomb/CollapsePath.h"
#include "conic/form/Form.h"
#include "statics/CoulombExchange.h"
#include "statics/NonAssociative.h"
#include "statics/ProperFrame.h"

#include <optional>
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
    /// Whether all pairs are near the ends of paths, but were not met by them.
    bool isByRefinement = false;
    CoulombRange range;
    ProperFrame<Rows, Forces> frame; ///< in which all forces and mechanisms here are
    CoulombPair lowest;
    CoulombPair fall;  ///< the lowest, on whose mechanism the live load does no work
    CoulombPair below; ///< the highest of those below zero

private:
    /// Forces and what they carry in addition to the dead load.
    struct Start
    {
        double alpha = 0;
        Eigen::VectorXd contactForce;
    };

    ConeSolution solve(const Program& program, const InteriorPointSettings& settings);
    /// What the exchanges of forces and mechanism solve their programs with.
    ProgramSolver<Rows, Forces> solver();
    /// Of a program whose forces are nothing but a start.
    ConeSolution solveRoughly(const Program& program, double tolerance);
    /// Reports to the observer how far a start has been followed.
    void report(int pieces, double multiplier) const;
    CollapsePair path(const Start& start, const CollapsePathSettings& settings);
    /// In [0, 1), the same on every machine.
    double uniform();

    Start movedInwards(double alpha, const Eigen::VectorXd& contactForce) const;
    /// Forces for the dead load with little pressure at random points.
    std::optional<Start> otherRest();
    /// Forces of a low multiplier that suit the mechanism of a pair.
    std::optional<Start> lowForces(const CoulombPair& pair, double gamma);

    /// How far a pair is from the law, in the structure. \param liveWork what the live load's work has to be
    CoulombResiduals judged(const CoulombPair& pair, double liveWork) const;
    /// Judges a pair, and takes it if it meets the tolerance. \return whether it does
    bool consider(CoulombPair& pair);
    /// Takes blocks that fall under the dead load alone.
    void considerFall(const CollapsePair& found);
    /// Takes a pair, or one near it. \return whether there is one
    bool take(CoulombPair& pair);
    /// Where a stone slides between others nothing but rounding holds its motion across in the end of a path
    /// in space: its forces are right, and the mechanism follows from them. \return whether that is a pair
    bool takeMechanism(CoulombPair& pair);
    /// Takes the pair to its last digits, where it is near one. \return whether that is one
    bool refine(CoulombPair& pair);

    /// Programs with a cohesion in place of friction (FictitiousCohesion.h) from the pressures of a start,
    /// and the multiplier of their pair made least. \return whether they have led to a pair
    bool followCohesion(const Start& start);
    /// Follows a path, and makes the multiplier of its pair least. \return whether it has led to a pair
    bool follow(const Start& start, const CollapsePathSettings& settings);
    /// The same with a little dilatancy, which is taken away at the end but for what the tolerance allows;
    /// from the start, and from the forces of the associative collapse, where less has to move until all is
    /// wedged.
    bool followWedged(const Start& start, CollapsePathSettings settings);
    /// From the mechanism that pressures have (mechanismOfPressures) to the pairs nearby, if there are any.
    void tryPressures(const Eigen::VectorXd& contactForce);
    /// From a pair to lower ones: the least multiplier with its mechanism held, then another mechanism of
    /// those forces, in turn, while the multiplier falls.
    void descend(CoulombPair pair);

    const Program& structure; ///< as it is in its own axes, in which pairs are judged
    const Program& given;     ///< in the frame
    NonAssociativeSettings searchSettings;
    InteriorPointSettings solverSettings;
    LimitAnalysis& effort;
    int ofStructure = 0;               ///< factorisations of it in axes that are not those of the frame
    SymbolicAnalysis symbolicAnalysis; ///< of the last program: most have the same points
    std::mt19937 generator;
    CoulombPair associativePair; ///< where there is one; of the associative law
    Start restingStart;
    double begin; ///< on the clock [s]
    CoulombPair latestPair;
};

} // namespace drystone
