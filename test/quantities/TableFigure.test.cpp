// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Columns of tables that an application, or a user, has written.
#include "quantities/TableFigure.h"

#include "../ReportOf.h"
#include "core/Error.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace drystone
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

TEST(ReadColumn, TakesTheColumnOfTheNameWithOrWithoutItsUnit)
{
    const auto file =
        std::filesystem::temp_directory_path() / fmt::format("drystone-column-{}.dat", ::getpid());
    std::ofstream(file) << "# made by hand\n# Time[s]  alpha[-] alpha2\n0 1.5 3\n0.5 nan 4\n";
    EXPECT_THAT(*readColumn(file, "alpha2"), ElementsAre(3, 4));
    EXPECT_THAT(*readColumn(file, "Time[s]"), ElementsAre(0, 0.5));
    EXPECT_TRUE(std::isnan(readColumn(file, "alpha")->back()));
    EXPECT_THAT(reportOf([&] { readColumn(file, "beta"); }),
                HasSubstr("Its columns: Time[s] alpha[-] alpha2"));
    std::ofstream(file) << "# Time[s]  alpha[-]\n0 1.5\n0.5\n";
    EXPECT_THROW(readColumn(file, "alpha"), FatalError);
    std::filesystem::remove(file);
    EXPECT_FALSE(readColumn(file, "alpha"));
}

} // namespace
} // namespace drystone
