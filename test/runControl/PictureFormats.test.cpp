// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "runControl/PictureFormats.h"

#include "../ReportOf.h"
#include "core/Error.h"
#include "core/WholeFile.h"
#include "runControl/Time.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

namespace drystone
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

class PictureFormatsTest : public testing::Test
{
protected:
    ~PictureFormatsTest() override { std::filesystem::remove_all(folder); }
    void give(const std::string& controlDict)
    {
        writeWholeFile(folder / "system/controlDict", controlDict);
        std::filesystem::create_directories(folder / "constant");
    }
    std::string refusal() const
    {
        return reportOf([&] { readPictureFormats(folder); });
    }
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("drystonePictureFormats." + std::to_string(getpid()));
};

TEST_F(PictureFormatsTest, AreSvgUnlessControlDictSaysOtherwise)
{
    EXPECT_THAT(readPictureFormats(folder), ElementsAre(PictureFormat::svg));
    give("deltaT 0.1;\nendTime 1;\n");
    EXPECT_THAT(readPictureFormats(folder), ElementsAre(PictureFormat::svg));
    give("deltaT 0.1;\nendTime 1;\npictureFormats (png pdf);\n");
    EXPECT_THAT(readPictureFormats(folder), ElementsAre(PictureFormat::png, PictureFormat::pdf));
    EXPECT_THAT(Time(folder).controls().pictureFormats, ElementsAre(PictureFormat::png, PictureFormat::pdf));
}

TEST_F(PictureFormatsTest, RefuseWhatCannotBeWrittenWithItsLine)
{
    give("deltaT 0.1;\npictureFormats (svg jpg);\n");
    EXPECT_THAT(refusal(), HasSubstr("jpg"));
    EXPECT_THAT(refusal(), HasSubstr("svg"));
    EXPECT_THAT(refusal(), HasSubstr("line 2"));
    EXPECT_THROW(Time time(folder), FatalIOError);
    give("pictureFormats ();\n");
    EXPECT_THAT(refusal(), HasSubstr("at least one of svg, png and pdf"));
    EXPECT_THROW(Time time(folder), FatalIOError);
    give("pictureFormats svg;\n");
    EXPECT_THROW(readPictureFormats(folder), FatalIOError);
}

TEST_F(PictureFormatsTest, AreNamedInTheLog)
{
    EXPECT_EQ(pictureNames("thrust", {PictureFormat::svg}), "thrust.svg");
    EXPECT_EQ(pictureNames("thrust", {PictureFormat::pdf, PictureFormat::png}), "thrust.png, thrust.pdf");
}

} // namespace
} // namespace drystone
