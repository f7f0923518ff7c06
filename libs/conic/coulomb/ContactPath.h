// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The forces of a step in time found by following them from those of the step before, through each change of
/// a point between open, sticking and sliding: Coulomb's law, or the associative one, from a warm start.
#pragma once

#include "conic/coulomb/PathExit.h"
#include "conic/coulomb/PieceMatrix.h"

#include <functional>
#include <limits>

namespace drystone
{

struct ContactPathSettings
{
    Sliding sliding = Sliding::coulomb;
    double stiffness = 0;     ///< k of every point to begin with, in both directions [N/m]
    double tolerance = 1e-12; ///< on the equations of motion, relative to the largest load
    int maximumPivots = 1000; ///< changes of state of single points, in one call
    /// Of a walk that does not leave its start: it swings there between too many points that are nearly open,
    /// or nearly slide.
    int maximumPivotsAtStart = std::numeric_limits<int>::max();
    int maximumFactorisations = std::numeric_limits<int>::max(); ///< of all calls
    /// Called before each change of state: where it is true the solution is not reached. May be empty.
    std::function<bool()> isOver = {};
};

/// Solves, for a program with inertia,
///
///     Mbar y + A c = f,      c_k = law of  w_k = k (A'y - g)_k   at each point k        (SlidingLaw.h)
///
/// the step of rigid blocks whose points give way by 1/k: as little as is wanted, since y tends to that of
/// rigid points as k grows, and c to the least |c| among the forces that rigid points may carry. These are
/// not unique, and a solver that takes any of them finds another set of points that stick in each step; the
/// least forces change only as the motion does.
///
/// With w instead of y in front the law is linear on pieces, and so is the whole problem. Where a start has
/// forces c0 and any w0 with law(w0) = c0,
///
///     Mbar y + A law(w) = f - (1 - t) r0,      w = k (A'y - g) + (1 - t) (w0 - k (A'y0 - g))
///
/// is solved by the start at t = 0 and is the problem at t = 1: r0 is what the start leaves of the equations
/// of motion. The path in between is piecewise linear. It is followed from piece to piece, one point changing
/// its state at a time (the parametric active set: Best 1996; Ferreau, Bock & Diehl 2008; for laws that are
/// not monotone Eaves & Scarf 1976): with the new piece's matrix the path goes on beyond the side, forwards
/// or, where the determinant changes its sign, backwards in t. A step without changes of state costs one
/// factorisation, and each change one solve: the pieces' matrices differ by rank 1.
///
/// In space the shear of a point that slides turns with w, and the side round a point that sticks is curved.
/// The path is that of the law's tangents then, and at its end it goes on with those of the end: Newton's
/// method, whose linear problems have the changes of state in them (Robinson 1994; the path search of Dirkse
/// & Ferris 1995).
template<int Rows, int Forces>
class ContactPath
{
public:
    using VectorXd = Eigen::VectorXd;
    using Program = ConeProgram<Rows, Forces>;

    /// \param program with inertia, without multiplier, compliance and crushing, and with
    /// Sliding::associative of the plane and without strengths \param start forces and displacements, sized
    /// as in the solution \param symbolic kept from program to program (form/Form.h), not owned \throws
    /// std::invalid_argument for any other program or start
    ContactPath(const Program& program, const ConeSolution& start, const ContactPathSettings& settings,
                SymbolicAnalysis& symbolic);

    /// Goes to the solution from the start, or from the last one where columns, loads and gaps have changed
    /// since. \return whether it was reached
    bool follow(const Program& program);

    /// In the plane, from a solution that was followed to that of the same program with points of another
    /// stiffness, by way of all between them (StiffeningPath.cpp): where `follow` swings between forces of
    /// points that are much softer and much stiffer, this does not. \return whether it was reached
    bool stiffen(double toStiffness);

    VectorXd displacement() const;
    const VectorXd& contactForce() const { return force; }

    int pivots = 0;
    int factorisations() const { return matrix.factorisations; }

private:
    using Force = Eigen::Matrix<double, Forces, 1>;

    using Derivative = typename PieceMatrix<Rows, Forces>::Derivative;

    using Exit = PathExit<Forces>;

    void findForces();
    void findPieces();
    VectorXd forceOnPieces() const;
    VectorXd residual() const;
    bool factorise();
    bool walk(const VectorXd& residualOfStart, const VectorXd& change);
    Force trialOf(std::size_t point) const
    {
        return w.template segment<Forces>(Forces * static_cast<Eigen::Index>(point));
    }
    /// The force of its state, linear in w.
    PointForce<Forces> onPiece(std::size_t point) const
    {
        return forceOn<Forces>(laws[point], states[point], trialOf(point));
    }
    bool followTangents();
    bool cross(const Exit& exit, VectorXd& direction, VectorXd& rate);
    void findSides();
    VectorXd forceChange(const VectorXd& change) const;
    double senseBeyond(const Exit& last, const VectorXd& rate) const;
    void settleOnPieces();
    double farthestOutside() const;
    struct Travel;
    bool walkStiffening(Travel& travel, double length, double farthest);
    bool changePiece(int point, const Force& u, const Force& v, const Derivative& derivative,
                     VectorXd& direction, VectorXd& rate);
    bool isRounding(const VectorXd& left) const;
    bool polish();

    const ContactPathSettings settings;
    double stiffness; ///< k now
    ContactSystem<Rows, Forces> system;
    PieceMatrix<Rows, Forces> matrix;             ///< of `states`
    std::vector<ConeColumns<Rows, Forces>> given; ///< of the program
    std::vector<SlidingLaw> laws;
    VectorXd start;
    VectorXd load; ///< of x with y = start + L'^-1 x
    VectorXd gap;  ///< likewise
    double enough; ///< of the residual
    VectorXd x, w;
    VectorXd force; ///< law(w)
    std::vector<PointState<Forces>> states;
    std::vector<PieceSides<Forces>> sides; ///< of `states`
    int mostPivots = 0;
};

extern template class ContactPath<3, 2>;
extern template class ContactPath<6, 3>;

} // namespace drystone
