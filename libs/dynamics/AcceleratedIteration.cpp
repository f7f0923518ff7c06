// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Anderson's acceleration.
#include "dynamics/AcceleratedIteration.h"

#include <Eigen/QR>

namespace drystone
{
namespace
{

/// By how much more than the image of an expanding map, which plain iteration leaves by a few per cent at
/// times.
constexpr double away = 2;

} // namespace

Eigen::VectorXd AcceleratedIteration::next(const Eigen::VectorXd& x, const Eigen::VectorXd& image)
{
    const Eigen::VectorXd residual = image - x;
    const bool isExpanding = lastResidual.size() > 0 && growsMore(x, image, residual);
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
    const bool leadsBack = result.lpNorm<Eigen::Infinity>() < reached / 2;
    if (leadsBack && (isExpanding || reached > 2 * x.lpNorm<Eigen::Infinity>()))
    {
        residualChanges.clear();
        imageChanges.clear();
        return isExpanding ? Eigen::VectorXd(away * image) : image;
    }
    return result;
}

bool AcceleratedIteration::growsMore(const Eigen::VectorXd& x, const Eigen::VectorXd& image,
                                     const Eigen::VectorXd& residual) const
{
    const double before = (lastImage - lastResidual).lpNorm<Eigen::Infinity>();
    const double now = x.lpNorm<Eigen::Infinity>();
    return before < now && now < image.lpNorm<Eigen::Infinity>()
           && residual.lpNorm<Eigen::Infinity>() > lastResidual.lpNorm<Eigen::Infinity>();
}

} // namespace drystone
