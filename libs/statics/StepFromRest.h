// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Collapses by Coulomb's law from where a structure begins to move, as in a step in time: a start of
/// non-associative limit analysis where its paths end nowhere.
#pragma once

#include "statics/CoulombExchange.h"

namespace drystone
{

/// A structure of points that give way a little has least forces, which Coulomb's law with inertia follows as
/// the live load grows (conic/coulomb/ContactPath.h). Beyond where motion begins the displacements of a step
/// from rest, and what the forces differ by from those that balance the loads, are linear in how far beyond
/// it is:
///
///     Mbar y + A c = f + alpha L,    y = (alpha - alpha*) y',    c = c* + (alpha - alpha*) c'.
///
/// So two steps give alpha*, with the forces c* and the mechanism y', which obey the law without inertia.
/// Mbar only chooses among the mechanisms; it is that which the points of each body feel, sum_k A_k A_k'.
///
/// \param given without crushing \param begins a live load beyond which motion is looked for, and below where
/// there is any there \param forces for that load, or the dead one, to begin with \param isPair judges forces
/// and mechanism \param factorisations those taken are added \param isOver called on the way, which ends
/// where it says so; may be empty \return the pair, L'y = 1; none where no step leads to one
template<int Rows, int Forces>
std::optional<CoulombPair> pairFromRest(const ConeProgram<Rows, Forces>& given, double begins,
                                        const Eigen::VectorXd& forces,
                                        const std::function<bool(CoulombPair&)>& isPair, int& factorisations,
                                        const std::function<bool()>& isOver = {});

} // namespace drystone
