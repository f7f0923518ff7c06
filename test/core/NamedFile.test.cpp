// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Names with typing errors, in folders that are there and that are not.
#include "core/NamedFile.h"

#include "../ReportOf.h"
#include "core/WholeFile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace drystone
{
namespace
{

using testing::HasSubstr;
using testing::Not;

TEST(NamedFile, ANameWithATypingErrorIsRefusedWithTheFileThatMayBeMeant)
{
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "namedFile";
    std::filesystem::create_directories(folder / "tower");
    writeWholeFile(folder / "tower.obj", "o\n");
    writeWholeFile(folder / "wall.dxf", "0\n");
    const auto report = [&](const std::string& name) {
        return reportOf([&] { requireFile(folder / name, {"system/blockTextureDict", "texture/file", 5}); });
    };
    EXPECT_EQ(report("tower.obj"), "no error");
    EXPECT_THAT(report("tover.obj"),
                AllOf(HasSubstr("There is no file "), HasSubstr("tover.obj. Did you mean tower.obj?"),
                      HasSubstr("texture/file at line 5")));
    EXPECT_THAT(report("Tower.OBJ"), HasSubstr("Did you mean tower.obj?"));
    EXPECT_THAT(report("facade.svg"), Not(HasSubstr("Did you mean")));
    EXPECT_THAT(report("towers"), Not(HasSubstr("Did you mean"))) << "a folder is no file";
    EXPECT_THAT(report("triSurface/tower.obj"),
                AllOf(HasSubstr("triSurface/tower.obj."), Not(HasSubstr("Did you mean"))));
    std::filesystem::remove_all(folder);
}

} // namespace
} // namespace drystone
