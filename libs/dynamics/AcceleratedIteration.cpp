// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Anderson's acceleration.
#include "dynamics/AcceleratedIteration.h"

#include <Eigen/QR>

namespace drystone
{

Eigen::VectorXd AcceleratedIteration::next(const Eigen::VectorXd& x, const Eigen::VectorXd& image)
{
    const Eigen::VectorXd residual = image - x;
    if (lastResidual.size() > 0)
    {
        if (residualChanges.size() == depth)
        {
            residualChanges.erase(residualChanges.begin());
            imageChanges.erase(imageChanges.begin());
        }
        residualChanges.push_back(residual - lastResidual);
        imageChanges.push_back(image - lastImage);
    }
    lastResidual = residual;
    lastImage = image;
    const auto columns = static_cast<Eigen::Index>(residualChanges.size());
    if (columns == 0)
    {
        return image;
    }
    Eigen::MatrixXd changes(residual.size(), columns);
    for (Eigen::Index column = 0; column < columns; ++column)
    {
        changes.col(column) = residualChanges[static_cast<std::size_t>(column)];
    }
    const Eigen::VectorXd weights = changes.colPivHouseholderQr().solve(residual);
    Eigen::VectorXd result = image;
    for (Eigen::Index column = 0; column < columns; ++column)
    {
        result -= weights[column] * imageChanges[static_cast<std::size_t>(column)];
    }
    result = result.cwiseMax(0.0);
    const double reached = image.lpNorm<Eigen::Infinity>();
    if (reached > 2 * x.lpNorm<Eigen::Infinity>() && result.lpNorm<Eigen::Infinity>() < reached / 2)
    {
        residualChanges.clear();
        imageChanges.clear();
        return image;
    }
    return result;
}

} // namespace drystone
