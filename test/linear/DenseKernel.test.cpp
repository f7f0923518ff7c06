// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The dense kernels compared with Eigen's products, of every shape that their tiles and slices meet.
#include "linear/DenseKernel.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace drystone
{
namespace
{

constexpr double untouched = 7;

TEST(DenseKernel, TheBaselineIsAlwaysThereAndOneIsChosen)
{
    EXPECT_STREQ(availableDenseKernels().back().name, "baseline");
    EXPECT_STREQ(denseKernel().name, availableDenseKernels().front().name);
}

TEST(DenseKernel, WorkBeginsAtAMultipleOf64BytesAndStaysWhereItIs)
{
    std::vector<double> numbers;
    double* const first = alignedWork(numbers);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(first) % 64, 0U);
    EXPECT_LE(first + denseKernelWork, numbers.data() + numbers.size());
    EXPECT_EQ(alignedWork(numbers), first);
}

TEST(DenseKernel, UpdatesOnAndBelowTheDiagonalOnly)
{
    std::mt19937 random(3);
    std::vector<double> work;
    const auto upTo = [&](int most) { return std::uniform_int_distribution<int>(1, most)(random); };
    for (const DenseKernel& kernel : availableDenseKernels())
    {
        SCOPED_TRACE(kernel.name);
        for (int instance = 0; instance < 120; ++instance)
        {
            // Small ones meet the ends of tiles, large ones those of slices: 256 deep, 192 high, 2,048 wide.
            const bool isLarge = instance % 20 == 0;
            const int rows = isLarge ? 2000 + upTo(300) : upTo(90);
            const int columns = instance % 3 == 0 ? rows : upTo(rows);
            const int depth = isLarge ? 20 : upTo(instance % 7 == 0 ? 600 : 60);
            const int aStride = rows + upTo(5) - 1;
            const int cStride = rows + upTo(5) - 1;
            const Eigen::MatrixXd a = Eigen::MatrixXd::Random(aStride, depth);
            Eigen::MatrixXd c = Eigen::MatrixXd::Random(cStride, columns);
            c.bottomRows(cStride - rows).setConstant(untouched);
            const Eigen::MatrixXd before = c;
            const Eigen::MatrixXd product = a.topRows(rows) * a.topRows(columns).transpose();
            DenseUpdate task;
            task.target = instance % 2 == 0 ? DenseUpdate::Target::set : DenseUpdate::Target::subtract;
            task.rows = rows;
            task.columns = columns;
            task.depth = depth;
            task.a = a.data();
            task.aStride = aStride;
            task.c = c.data();
            task.cStride = cStride;
            kernel.update(task, alignedWork(work));
            const bool isSet = task.target == DenseUpdate::Target::set;
            double error = 0;
            bool isElsewhereUntouched = true;
            for (int column = 0; column < columns; ++column)
            {
                for (int row = 0; row < cStride; ++row)
                {
                    if (row < column || row >= rows)
                    {
                        isElsewhereUntouched = isElsewhereUntouched && c(row, column) == before(row, column);
                        continue;
                    }
                    const double expected = (isSet ? 0 : before(row, column)) - product(row, column);
                    error = std::max(error, std::abs(c(row, column) - expected));
                }
            }
            EXPECT_LE(error, 1e-15 * (depth + 4)) << rows << ' ' << columns << ' ' << depth;
            EXPECT_TRUE(isElsewhereUntouched) << rows << ' ' << columns << ' ' << depth;
        }
    }
}

// Several threads may share the rows, however they are divided.
TEST(DenseKernel, NumbersComeOutTheSameInAnyPartsOfTheRows)
{
    constexpr int rows = 700;
    constexpr int columns = 390;
    constexpr int depth = 300;
    const Eigen::MatrixXd a = Eigen::MatrixXd::Random(rows, depth);
    const Eigen::MatrixXd before = Eigen::MatrixXd::Random(rows, columns);
    std::vector<double> work;
    for (const DenseKernel& kernel : availableDenseKernels())
    {
        const auto update = [&](Eigen::MatrixXd& c, int firstRow, int lastRow)
        {
            kernel.update({.rows = lastRow,
                           .columns = std::min(columns, lastRow),
                           .firstRow = firstRow,
                           .depth = depth,
                           .a = a.data(),
                           .aStride = rows,
                           .c = c.data(),
                           .cStride = rows},
                          alignedWork(work));
        };
        Eigen::MatrixXd whole = before;
        update(whole, 0, rows);
        EXPECT_GT((whole - before).norm(), 1);
        for (const std::vector<int>& ends :
             {std::vector<int>{0, 1, rows}, std::vector<int>{0, 193, 256, 391, 400, rows}})
        {
            Eigen::MatrixXd inParts = before;
            for (std::size_t part = 1; part < ends.size(); ++part)
            {
                update(inParts, ends[part - 1], ends[part]);
            }
            EXPECT_TRUE(inParts == whole) << kernel.name;
        }
    }
}

} // namespace
} // namespace drystone
