// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Drawings as PNG and PDF: read again by libpng, and by poppler where it is installed.
#include "io/PictureFile.h"

#include "core/Error.h"
#include "core/WholeFile.h"
#include "io/CairoPicture.h"
#include "io/SvgText.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <png.h>
#include <set>
#include <unistd.h>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

struct Pixels
{
    unsigned width = 0;
    unsigned height = 0;
    std::vector<unsigned char> rgb; ///< rows from above

    std::array<int, 3> at(unsigned x, unsigned y) const
    {
        const std::size_t i = 3 * (static_cast<std::size_t>(y) * width + x);
        return {rgb[i], rgb[i + 1], rgb[i + 2]};
    }
};

Pixels pixelsOf(const std::string& png)
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, png.data(), png.size()) == 0)
    {
        throw FatalError(std::string("no PNG: ") + image.message);
    }
    image.format = PNG_FORMAT_RGB;
    Pixels pixels{image.width, image.height, std::vector<unsigned char>(PNG_IMAGE_SIZE(image))};
    if (png_image_finish_read(&image, nullptr, pixels.rgb.data(), 0, nullptr) == 0)
    {
        throw FatalError(std::string("a damaged PNG: ") + image.message);
    }
    return pixels;
}

/// A red square, a blue line, a hatch cut by a clip, and text.
Canvas drawing()
{
    Canvas canvas(200, 100);
    canvas.polygon({{20, 20}, {40, 20}, {40, 40}, {20, 40}}, {.fill = "#ff0000"});
    canvas.line({60, 30}, {100, 30}, {.stroke = "#0000ff", .strokeWidth = 4});
    canvas.defineHatch("strokes", "#00ff00", 7);
    canvas.beginClip("frame", {120, 20}, 20, 20);
    canvas.polygon({{120, 20}, {180, 20}, {180, 40}, {120, 40}}, {.fill = "url(#strokes)"});
    canvas.endClip();
    canvas.text({20, 80}, "thrust 10⁻³ µm <N>\x01", {.size = 14, .weight = "bold"});
    return canvas;
}

class PictureFile : public testing::Test
{
protected:
    PictureFile() { fs::create_directories(folder); }
    ~PictureFile() override { fs::remove_all(folder); }
    const fs::path folder = fs::temp_directory_path() / ("drystonePictureFile." + std::to_string(getpid()));
};

TEST_F(PictureFile, PngHasTwoPixelsToEachOfTheDrawingAndItsColours)
{
    const Pixels pixels = pixelsOf(pngContent(drawing()));
    ASSERT_EQ(pixels.width, 400u);
    ASSERT_EQ(pixels.height, 200u);
    EXPECT_EQ(pixels.at(60, 60), (std::array<int, 3>{255, 0, 0}));
    EXPECT_EQ(pixels.at(160, 60), (std::array<int, 3>{0, 0, 255}));
    EXPECT_EQ(pixels.at(160, 70), (std::array<int, 3>{255, 255, 255}));
    EXPECT_EQ(pixels.at(300, 60), (std::array<int, 3>{255, 255, 255})); // clipped
    std::set<std::array<int, 3>> hatch;
    int ink = 0;
    for (unsigned x = 0; x < 400; ++x)
    {
        for (unsigned y = 40; y < 80; ++y)
        {
            if (x > 242 && x < 278)
            {
                hatch.insert(pixels.at(x, y));
            }
        }
        for (unsigned y = 130; y < 170; ++y)
        {
            ink += pixels.at(x, y)[0] < 128 ? 1 : 0;
        }
    }
    EXPECT_GT(hatch.size(), 2u); // stripes, white, and the blends at their edges
    EXPECT_GT(ink, 300);         // the text
}

TEST_F(PictureFile, PngIsWhiteUpToItsLastRow)
{
    const Pixels pixels = pixelsOf(pngContent(Canvas(20.3, 10.2)));
    ASSERT_EQ(pixels.width, 41u);
    ASSERT_EQ(pixels.height, 21u);
    EXPECT_EQ(pixels.at(40, 20), (std::array<int, 3>{255, 255, 255}));
}

TEST_F(PictureFile, PdfIsOfOnePageAndTheSameEachTime)
{
    const std::string pdf = pdfContent(drawing());
    EXPECT_THAT(pdf, StartsWith("%PDF-1."));
    EXPECT_THAT(pdf, HasSubstr("%%EOF"));
    EXPECT_THAT(pdf, HasSubstr("/MediaBox [ 0 0 150 75 ]")); // 72 points for 96 px
    EXPECT_EQ(pdf, pdfContent(drawing()));
    if (std::system("command -v pdftoppm >/dev/null 2>&1") != 0)
    {
        GTEST_SKIP() << "pdftoppm is not installed: what the page shows is not compared";
    }
    writeWholeFile(folder / "drawing.pdf", pdf);
    const std::string stem = (folder / "page").string();
    ASSERT_EQ(std::system(("pdftoppm -png -r 192 " + (folder / "drawing.pdf").string() + " " + stem).c_str()),
              0);
    const Pixels pixels = pixelsOf(contentOfFile(stem + "-1.png"));
    ASSERT_EQ(pixels.width, 400u);
    EXPECT_EQ(pixels.at(60, 60), (std::array<int, 3>{255, 0, 0}));
    EXPECT_EQ(pixels.at(300, 60), (std::array<int, 3>{255, 255, 255}));
}

TEST_F(PictureFile, OneAndTheSameDrawingAsSvg)
{
    const std::string svg = svgText(drawing());
    EXPECT_THAT(svg, HasSubstr("points=\"20,20 40,20 40,40 20,40\" fill=\"#ff0000\""));
    EXPECT_THAT(svg, HasSubstr("thrust 10⁻³ µm &lt;N&gt;</text>"));
}

TEST_F(PictureFile, RefusesAColourAndAFillThatItCannotDraw)
{
    Canvas named(10, 10);
    named.rectangle({0, 0}, 5, 5, {.fill = "red"});
    EXPECT_THROW(pngContent(named), FatalError);
    Canvas unknown(10, 10);
    unknown.rectangle({0, 0}, 5, 5, {.fill = "url(#none)"});
    EXPECT_THROW(pdfContent(unknown), FatalError);
    EXPECT_THROW(pngContent(Canvas(1e6, 1e6)), FatalError);
}

TEST_F(PictureFile, WritesTheFormatsThatAreRequestedAndRemovesTheOthers)
{
    const fs::path name = folder / "deep/scatter_friction.mu"; // a dot that is no ending
    writePicture(name, drawing(), {PictureFormat::pdf, PictureFormat::svg, PictureFormat::png});
    EXPECT_THAT(contentOfFile(name.string() + ".svg"), StartsWith("<?xml"));
    EXPECT_THAT(contentOfFile(name.string() + ".png"), StartsWith("\x89PNG"));
    EXPECT_THAT(contentOfFile(name.string() + ".pdf"), StartsWith("%PDF"));
    writePicture(name, drawing(), {PictureFormat::png});
    EXPECT_FALSE(fs::exists(name.string() + ".svg"));
    EXPECT_TRUE(fs::exists(name.string() + ".png"));
    EXPECT_FALSE(fs::exists(name.string() + ".pdf"));
    removePicture(name);
    EXPECT_TRUE(fs::is_empty(folder / "deep"));
}

} // namespace
} // namespace drystone
