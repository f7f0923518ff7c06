// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The diagonal blocks of Cholesky factors.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace drystone
{

/// Inverse of the Cholesky factor of a small symmetric block. By hand, so that the compiler unrolls it.
/// \param pivot the block, of which the lower triangle is read and becomes the factor \return false when it
/// is not positive definite
template<int Rows, class Scalar>
[[gnu::always_inline]] inline bool invertFactor(Eigen::Matrix<Scalar, Rows, Rows>& pivot,
                                                Eigen::Matrix<Scalar, Rows, Rows>& inverse)
{
    using std::isfinite;
    using std::sqrt;
    inverse.setZero();
    for (int k = 0; k < Rows; ++k)
    {
        Scalar diagonal = pivot(k, k);
        for (int m = 0; m < k; ++m)
        {
            diagonal -= pivot(k, m) * pivot(k, m);
        }
        if (!(diagonal > 0) || !isfinite(diagonal))
        {
            return false;
        }
        pivot(k, k) = sqrt(diagonal);
        const Scalar scale = 1 / pivot(k, k);
        for (int i = k + 1; i < Rows; ++i)
        {
            Scalar value = pivot(i, k);
            for (int m = 0; m < k; ++m)
            {
                value -= pivot(i, m) * pivot(k, m);
            }
            pivot(i, k) = value * scale;
        }
        inverse(k, k) = scale;
        for (int j = 0; j < k; ++j)
        {
            Scalar value = 0;
            for (int m = j; m < k; ++m)
            {
                value -= pivot(k, m) * inverse(m, j);
            }
            inverse(k, j) = value * scale;
        }
    }
    return true;
}

} // namespace drystone
