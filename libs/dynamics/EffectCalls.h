// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where a solved step shows each effect of its case: what it would have been another without.
#pragma once

#include "dynamics/Step.h"

namespace drystone
{

/// The effects of a case by name, large displacements among them, in the order of all lists about them.
template<int Dim>
std::vector<std::string> namesOfEffects(const DynamicCase<Dim>& scene);

/// What an effect acts on, for a table: `points that slide`, `blocks that move`.
std::string_view placesOf(std::string_view effect);

/// The share of the points, or blocks, on which each effect acts in a solved step; zero: the step is the same
/// without it. Friction, whose law of flow matters where points slide, at these; restitution at points that
/// collide; cohesion and tension where forces are outside the cone of friction; elasticity and moving
/// supports everywhere; what else there is on blocks that move, as those at rest are there by a proof. One an
/// effect of namesOfEffects. To be called before the step is accounted
template<int Dim>
std::vector<double> effectCalls(const Step<Dim>& step);

} // namespace drystone
