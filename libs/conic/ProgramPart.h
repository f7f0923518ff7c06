// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Some bodies of a cone program as a program of their own: what solvers and their callers solve in parts.
#pragma once

#include "conic/ConeProgram.h"

namespace drystone
{

/// A program of some bodies and points of another, in ascending order of their indices there.
template<int Rows, int Forces>
struct ProgramPart
{
    ConeProgram<Rows, Forces> program;
    std::vector<int> bodies;         ///< of the part, in the whole
    std::vector<std::size_t> points; ///< likewise
};

/// The bodies that are marked with all points at one of them, the other bodies held as one with the ground.
/// Fewer motions are possible than in the whole: forces of the whole are forces of the part too, and a
/// mechanism of the part is one of the whole. \param isPart one a body
template<int Rows, int Forces>
ProgramPart<Rows, Forces> partWithOthersHeld(const ConeProgram<Rows, Forces>& whole,
                                             const std::vector<char>& isPart);

/// The bodies that are marked under the forces that the other bodies give them, which become a part of their
/// load: forces of the part are, with those of all others, forces of the whole. \param forces F k of the
/// whole; read at points between a body that is marked and one that is not \param isPart one a body
template<int Rows, int Forces>
ProgramPart<Rows, Forces> partUnderForces(const ConeProgram<Rows, Forces>& whole,
                                          const Eigen::VectorXd& forces, const std::vector<char>& isPart);

/// Whether each body is marked, or a neighbour of one that is, so many times: bodies are neighbours where
/// they touch. \param isMarked one a body
template<int Rows, int Forces>
std::vector<char> withNeighbours(const ConeProgram<Rows, Forces>& program, std::vector<char> isMarked,
                                 int times);

/// The numbers of some of many that have `size` each: rows of bodies, or of points. What is empty stays so.
template<int size, class Index>
Eigen::VectorXd takenFrom(const std::vector<Index>& some, const Eigen::VectorXd& whole)
{
    Eigen::VectorXd own(whole.size() > 0 ? size * static_cast<Eigen::Index>(some.size()) : 0);
    for (Eigen::Index i = 0; size * i < own.size(); ++i)
    {
        own.segment<size>(size * i) =
            whole.segment<size>(size * static_cast<Eigen::Index>(some[static_cast<std::size_t>(i)]));
    }
    return own;
}

/// The other way.
template<int size, class Index>
void putInto(const std::vector<Index>& some, const Eigen::VectorXd& own, Eigen::VectorXd& whole)
{
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(some.size()); ++i)
    {
        whole.segment<size>(size * static_cast<Eigen::Index>(some[static_cast<std::size_t>(i)])) =
            own.segment<size>(size * i);
    }
}

} // namespace drystone
