// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// friction { type Coulomb; mu 0.65; flowRule associative; }: shear that normal forces carry at the contacts,
/// an effect of every program.
#pragma once

#include "dictionary/Registry.h"
#include "effects/EffectType.h"

#include <array>
#include <string_view>
#include <utility>

namespace drystone
{

/// Which way a sliding joint moves.
enum class FlowRule
{
    associative,   ///< normal to the cone: a joint that slides by s opens by mu s
    nonAssociative ///< Coulomb's law: a joint slides without opening
};

inline std::array<std::pair<std::string_view, FlowRule>, 2> namesOf(FlowRule)
{
    return {{{"associative", FlowRule::associative}, {"nonAssociative", FlowRule::nonAssociative}}};
}

/// Coulomb friction: |t| <= mu n.
struct CoulombFriction
{
    double mu = 0; ///< friction coefficient, 0 to 1e6
    FlowRule flowRule = FlowRule::associative;
};

/// Friction of some joints only. The flow rule is that of all.
struct JointFriction
{
    double mu = 0; ///< friction coefficient, 0 to 1e6
};

void declare(Options& options, CoulombFriction& friction);
void declare(Options& options, JointFriction& friction);

/// The friction laws that `friction { type ...; }` chooses from.
const Registry<CoulombFriction>& frictionTypes();

/// Friction coefficients of pairs of blocks, sorted by (block, neighbour).
using FrictionOfJoints = std::vector<std::pair<std::pair<int, int>, double>>;

/// Those of all joints as built; empty where `joints` gives none that differs from that of all.
template<int Dim>
FrictionOfJoints frictionOfJoints(const ContactProperties& contact, const Assembly<Dim>& assembly);

/// Those of pairs that are not known yet, by what `joints` says of their names and zones: patterns are slow
/// to match, and a motion adds them to what it knows. \param known empty: there are none in the case \param
/// points sorted by (block, neighbour)
template<int Dim>
FrictionOfJoints frictionOfNewPairs(const ContactProperties& contact, const Assembly<Dim>& assembly,
                                    const FrictionOfJoints& known,
                                    const std::vector<ContactPoint<Dim>>& points);

/// Friction coefficient of each of `points` contact points: 0 without friction. Not for cases with `joints`.
std::vector<double> frictionCoefficients(const ContactProperties& contact, std::size_t points);

/// Friction coefficient of each point: that of its pair where it is known, or else as of new pairs. Arguments
/// as above.
template<int Dim>
std::vector<double> frictionAt(const ContactProperties& contact, const Assembly<Dim>& assembly,
                               const FrictionOfJoints& known, const std::vector<ContactPoint<Dim>>& points);

/// Its line of the log of a motion; empty without friction.
std::string frictionText(const ContactProperties& contact);

/// Its entry of the list.
template<int Dim>
EffectType<Dim> frictionType();

} // namespace drystone
