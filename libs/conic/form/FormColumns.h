// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The columns of a form as its operators and its Schur matrix read them, in numbers of either precision.
/// Internal to the form.
#pragma once

#include "conic/form/Form.h"
#include "linear/DoubleDouble.h"

namespace drystone
{

template<int Rows, class Scalar>
using ColumnOf = Eigen::Matrix<Scalar, Form<Rows>::columnSize, 1>;

template<int Rows, class Scalar>
using RowsOf = Eigen::Matrix<Scalar, Rows, 1>;

/// By reference where that is possible: the copy of a ray is stored in halves, and the processor waits for
/// both when it is then read as one.
template<int Rows, class Scalar>
decltype(auto) rayOf(const Form<Rows>& form, int ray)
{
    if constexpr (std::is_same_v<Scalar, double>)
    {
        return (form.rays[ray]);
    }
    else
    {
        return ColumnOf<Rows, Scalar>(form.rays[ray].template cast<Scalar>());
    }
}

/// What a column does to the rows of its two bodies.
template<int Rows, class Scalar>
RowsOf<Rows, Scalar> onFirst(const ColumnOf<Rows, Scalar>& column)
{
    return column.template head<Rows>();
}
template<int Rows, class Scalar>
RowsOf<Rows, Scalar> onSecond(const ColumnOf<Rows, Scalar>& column)
{
    // At once: parts written one by one are slow to read back as a whole.
    if constexpr (Rows == 3)
    {
        return {-column[0], -column[1], column[3]};
    }
    else
    {
        return {-column[0], -column[1], -column[2], column[6], column[7], column[8]};
    }
}

/// How the displacements of two bodies close a point of both: what its columns are multiplied with.
template<int Rows, class Scalar>
ColumnOf<Rows, Scalar> closingOf(const typename Form<Rows>::Group& group, const VectorOf<Scalar>& y)
{
    const auto first = y.template segment<Rows>(Rows * group.first);
    const auto second = y.template segment<Rows>(Rows * group.second);
    if constexpr (Rows == 3)
    {
        return {first[0] - second[0], first[1] - second[1], first[2], second[2]};
    }
    else
    {
        return {first[0] - second[0],
                first[1] - second[1],
                first[2] - second[2],
                first[3],
                first[4],
                first[5],
                second[3],
                second[4],
                second[5]};
    }
}

} // namespace drystone
