// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The matrix of a step in time whose points carry forces by a law of their own closings, and products with
/// its parts.
#pragma once

#include "conic/coulomb/SlidingLaw.h"
#include "conic/form/Form.h"
#include "linear/BlockLu.h"

#include <vector>

namespace drystone
{

/// The law of each point of a program.
template<int Rows, int Forces>
std::vector<SlidingLaw> slidingLaws(const ConeProgram<Rows, Forces>& program, Sliding sliding);

/// S = 1 + sum_k A_k rho_k D_k A_k' in units that make the inertia 1: with Mbar = L L' columns are L^-1 A and
/// displacements x = L'y. D_k is the derivative of the law of point k (SlidingLaw.h): symmetric where the law
/// is associative, and then factorised by Cholesky's method, else by LU.
///
/// Sizes: displacements and rows of bodies R b, forces and closings F k.
template<int Rows, int Forces>
class ContactSystem
{
public:
    using VectorXd = Eigen::VectorXd;

    /// \param program with inertia \param symbolic brought up to date; its factors are used, and must live as
    /// long
    ContactSystem(const ConeProgram<Rows, Forces>& program, Sliding slidingLaw, SymbolicAnalysis& symbolic);

    /// R b.
    Eigen::Index rows() const { return Rows * static_cast<Eigen::Index>(root.size()); }

    /// Those of the program, of the same bodies and points.
    void setColumns(const ConeProgram<Rows, Forces>& program);

    /// L^-1 rows, and L'^-1 x: displacements in the units of the program.
    VectorXd scaledRows(VectorXd rows) const;
    VectorXd displacementOf(VectorXd x) const;

    /// A c.
    VectorXd forcesOnBodies(const VectorXd& contactForce) const;
    /// Of one point only, added to `rows`.
    void addForce(int point, const Eigen::Matrix<double, Forces, 1>& contactForce, VectorXd& rows) const;
    /// a'a of the normal's column a of L^-1 A: what the inverse of the inertia that a point moves is.
    double normalCompliance(int point) const;

    /// A'x.
    VectorXd closings(const VectorXd& x) const;
    /// Of one point only.
    Eigen::Matrix<double, Forces, 1> closing(int point, const VectorXd& x) const;

    /// \param rho one a point \param pieces D, likewise \return false where it cannot be factorised
    bool factorise(const VectorXd& rho, const std::vector<PointForce<Forces>>& pieces);

    /// S^-1 rows.
    VectorXd solve(const VectorXd& rows);

private:
    using Block = Eigen::Matrix<double, Rows, Rows>;
    using PieceForces = Eigen::Matrix<double, Rows, Forces>;

    int placeOf(int body) const { return position[static_cast<std::size_t>(body)]; }
    Block& diagonal(int body);
    void setToIdentity();
    void addCoupling(std::size_t point, const PieceForces& first, const PieceForces& second);

    const Sliding sliding;
    std::vector<Block> root;                        ///< L
    std::vector<ConeColumns<Rows, Forces>> columns; ///< L^-1 A
    std::vector<int> position;                      ///< of each body in elimination order
    std::vector<int> slot;                          ///< of each point's pair in the pattern, or -1
    SchurSystem<Rows>* symmetric = nullptr;         ///< not owned; or null
    BlockLu<Rows>* unsymmetric = nullptr;           ///< likewise
    std::vector<Block> lower, upperTransposed;      ///< of the unsymmetric one
    VectorXd ordered;                               ///< work: rows in elimination order
};

extern template std::vector<SlidingLaw> slidingLaws(const PlaneConeProgram& program, Sliding sliding);
extern template std::vector<SlidingLaw> slidingLaws(const SpaceConeProgram& program, Sliding sliding);
extern template class ContactSystem<3, 2>;
extern template class ContactSystem<6, 3>;

} // namespace drystone
