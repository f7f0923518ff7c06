// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What follows from contact properties for the points.
#include "contact/ContactProperties.h"

namespace drystone
{

std::vector<double> frictionCoefficients(const ContactProperties& properties, std::size_t points)
{
    return std::vector<double>(points, properties.friction ? properties.friction->mu : 0);
}

} // namespace drystone
