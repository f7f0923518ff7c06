// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "linear/DoubleDouble.h"

#include "linear/PivotBlock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace drystone
{
namespace
{

constexpr double digits = 1e-31;

TEST(DoubleDouble, KeepsWhatSumsInDoubleLose)
{
    const double small = std::ldexp(1.0, -80);
    const DoubleDouble sum = DoubleDouble(1) + small;
    EXPECT_EQ(sum.high, 1.0);
    EXPECT_EQ((sum - 1).high, small);
    EXPECT_EQ((DoubleDouble(0.1) - 0.1).high, 0.0);
    // Both parts cancel.
    const DoubleDouble left = (sum * sum - 1) - 2 * DoubleDouble(small);
    EXPECT_NEAR(left.high, 0, digits);
}

TEST(DoubleDouble, ProductsQuotientsAndRootsAgreeToThirtyOneDigits)
{
    for (const double value : {3.0, 0.7, 1e-5, 123456.789, 1e150})
    {
        const DoubleDouble third = DoubleDouble(value) / 3;
        EXPECT_LE(std::abs((third * 3 - value).high), digits * value) << value;
        const DoubleDouble root = sqrt(DoubleDouble(value));
        EXPECT_LE(std::abs((root * root - value).high), digits * value) << value;
    }
    EXPECT_EQ(sqrt(DoubleDouble(0)).high, 0.0);
}

TEST(DoubleDouble, ComparesTheSmallerPartWhereTheLargerOnesAreEqual)
{
    const DoubleDouble more = DoubleDouble(1) + 1e-25;
    EXPECT_TRUE(DoubleDouble(1) < more);
    EXPECT_TRUE(more > 1);
    EXPECT_TRUE(more >= more);
    EXPECT_FALSE(more <= 1);
    EXPECT_FALSE(more == 1);
    EXPECT_EQ(abs(-more).high, 1.0);
    EXPECT_FALSE(isfinite(DoubleDouble(std::numeric_limits<double>::infinity())));
    EXPECT_FALSE(isfinite(sqrt(DoubleDouble(-1))));
}

TEST(DoubleDouble, FactorisesABlockThatIsSingularInDouble)
{
    // [1 1; 1 1 + 1e-20], whose second pivot is 1e-20.
    Eigen::Matrix<DoubleDouble, 2, 2> block;
    block << 1, 1, 1, DoubleDouble(1) + 1e-20;
    Eigen::Matrix<DoubleDouble, 2, 2> inverse;
    ASSERT_TRUE((invertFactor<2, DoubleDouble>(block, inverse)));
    EXPECT_NEAR(inverse(1, 1).high, 1e10, 1e-1);
    Eigen::Matrix2d rounded = block.cast<double>();
    Eigen::Matrix2d ofRounded;
    EXPECT_FALSE((invertFactor<2, double>(rounded, ofRounded)));
}

} // namespace
} // namespace drystone
