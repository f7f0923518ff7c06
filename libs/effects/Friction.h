// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// friction { type Coulomb; mu 0.65; flowRule associative; }: shear that normal forces carry at the contacts,
/// an effect of every program.
#pragma once

#include "dictionary/Registry.h"
#include "effects/EffectList.h"

namespace drystone
{

void declare(Options& options, CoulombFriction& friction);
void declare(Options& options, JointFriction& friction);

/// The friction laws that `friction { type ...; }` chooses from.
const Registry<CoulombFriction>& frictionTypes();

/// Its key among those of a joint.
void declareFriction(Options& options, JointProperties& properties);

/// The friction coefficients of joints as built that have one of their own, sorted by (block, neighbour).
using FrictionOfJoints = std::vector<std::pair<std::pair<int, int>, double>>;
template<int Dim>
FrictionOfJoints frictionOfJoints(const std::filesystem::path& caseDirectory,
                                  const ContactProperties& contact, const Assembly<Dim>& assembly);

/// Friction coefficient of each point: that of its joint as built where that has one of its own.
template<int Dim>
std::vector<double> frictionAt(const ContactProperties& contact, const FrictionOfJoints& ofJoints,
                               const std::vector<ContactPoint<Dim>>& points);

/// Its line of the log of a motion; empty without friction.
std::string frictionText(const ContactProperties& contact);

/// Its entry of the list.
template<int Dim>
EffectType<Dim> frictionType();

} // namespace drystone
