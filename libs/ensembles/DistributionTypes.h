// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The distributions of the registry that are of some values. Internal to the distributions of ensembles.
#pragma once

#include "ensembles/Distribution.h"

namespace drystone
{

Model<Distribution> discreteDistribution();
Model<Distribution> listDistribution();
Model<Distribution> tableDistribution();

} // namespace drystone
