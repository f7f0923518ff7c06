// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Libraries that are loaded while a program runs.
#include "core/LoadedLibrary.h"

#include "../ReportOf.h"
#include "core/Error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace drystone
{

namespace
{

using testing::HasSubstr;

#ifdef __linux__
TEST(LoadedLibrary, ItsFunctionsAreCalled)
{
    const LoadedLibrary library("libm.so.6", "/nowhere");
    double (*squareRoot)(double) = library.symbol("sqrt");
    EXPECT_EQ(squareRoot(9), 3);
}

TEST(LoadedLibrary, AFunctionThatItDoesNotHaveIsNamed)
{
    const LoadedLibrary library("libm.so.6", "/nowhere");
    EXPECT_THAT(reportOf([&] { library.symbol("squareTheCircle"); }),
                testing::AllOf(HasSubstr("libm.so.6"), HasSubstr("squareTheCircle")));
}
#endif

TEST(LoadedLibrary, OneThatIsNotThereIsNamed)
{
    EXPECT_THAT(reportOf([] { LoadedLibrary("libnowhere.so.1", "/nowhere"); }), HasSubstr("libnowhere.so.1"));
}

} // namespace

} // namespace drystone
