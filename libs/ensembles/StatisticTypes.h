// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The statistics of the registry, one file each. Internal to the statistics of ensembles.
#pragma once

#include "ensembles/Statistic.h"

namespace drystone
{

Model<Statistic> distributionStatistic(); ///< DistributionStatistic.cpp
Model<Statistic> fragilityStatistic();    ///< FragilityStatistic.cpp
Model<Statistic> fractilesStatistic();    ///< FractilesStatistic.cpp
Model<Statistic> sensitivityStatistic();  ///< SensitivityStatistic.cpp

} // namespace drystone
