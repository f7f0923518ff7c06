// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Records in every dress they are met in, and broken ones. The six real records may not be redistributed:
/// those tests look for them next to the checkout and skip where they are absent.
#include "../ReportOf.h"
#include "core/Error.h"
#include "timeSeries/Record.h"
#include "timeSeries/Spectrum.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

#include <unistd.h>

using namespace drystone;
using testing::AllOf;
using testing::HasSubstr;
using namespace std::string_literals;

namespace
{

/// A file that lives as long as the test.
struct TemporaryFile
{
    std::filesystem::path path;

    explicit TemporaryFile(const std::string& content)
        : path(std::filesystem::temp_directory_path()
               / ("drystone_record_" + std::to_string(getpid()) + ".txt"))
    {
        std::ofstream(path, std::ios::binary) << content;
    }
    TemporaryFile(const TemporaryFile&) = delete;
    ~TemporaryFile() { std::filesystem::remove(path); }
};

Record peer(const std::string& content, const std::string& unit = "")
{
    return readPeerRecord(TemporaryFile(content).path, unit);
}

Record csv(const std::string& content, const CsvLayout& layout)
{
    return readCsvRecord(TemporaryFile(content).path, layout);
}

std::string peerRefusal(const std::string& content)
{
    return reportOf([&] { peer(content); });
}

std::string csvRefusal(const std::string& content, const CsvLayout& layout)
{
    return reportOf([&] { csv(content, layout); });
}

const std::string good = "PEER STRONG MOTION DATABASE RECORD. PROCESSING BY PACIFIC ENGINEERING.\n"
                         "SOMEWHERE 01/01/00, COMMUNITY HOSPITAL, 180\n"
                         "ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.2 Hz LP=12.5 Hz\n"
                         "NPTS=  7, DT= .01000 SEC\n"
                         "   .1000000E-02   .2000000E-02  -.3000000E-02   .4000000E-02   .0000000E+00\n"
                         "  -.5000000E+00   .1000000E-01\n";

std::string replaced(std::string text, const std::string& what, const std::string& with)
{
    const auto place = text.find(what);
    EXPECT_NE(place, std::string::npos);
    return text.replace(place, what.size(), with);
}

std::filesystem::path recordFolder()
{
    return std::filesystem::path(DRYSTONE_SOURCE_DIR) / ".." / "shared" / "records";
}

struct KnownRecord
{
    const char* file;
    std::size_t count;
    double timeStep;
};

const std::vector<KnownRecord> knownRecords{{"A-ELC180.AT2", 4000, 0.01},   {"ARL360.at2", 2000, 0.02},
                                            {"HWA002-N.AT2", 20000, 0.004}, {"IELC180.AT2", 4000, 0.01},
                                            {"TCU109-N.AT2", 18000, 0.005}, {"elCentro.AT2", 1559, 0.02}};

std::string content(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// The largest absolute value after the line with NPTS, found without the reader.
double largestValue(const std::string& text)
{
    std::istringstream values(text.substr(text.find('\n', text.find("NPTS"))));
    double largest = 0;
    for (double value = 0; values >> value;)
    {
        largest = std::max(largest, std::abs(value));
    }
    return largest;
}

} // namespace

TEST(PeerReader, ReadsTheUsualHeader)
{
    const Record record = peer(good);
    EXPECT_EQ(record.title, "SOMEWHERE 01/01/00, COMMUNITY HOSPITAL, 180");
    EXPECT_EQ(record.unit, "G");
    ASSERT_EQ(record.times.size(), 7u);
    EXPECT_DOUBLE_EQ(record.times[6], 0.06);
    EXPECT_EQ(record.accelerations[5], -0.5 * standardGravity);
}

TEST(PeerReader, ReadsEverySpellingOfNumberAndStep)
{
    for (const char* line :
         {"NPTS= 7, DT= .01 SEC", "NPTS=7,DT=0.01", "NPTS=      7, DT=   .0100 SEC,",
          "npts = 7 dt = 1.0D-2 sec", "NPTS:  7   DT: .01SEC", "   7    0.0100    NPTS, DT",
          "NPTS= 7\nDT= 0.01", "7 , 0.01 , NPTS, DT", "NPTS=  7, DT (sec)= .0100"})
    {
        SCOPED_TRACE(line);
        const Record record = peer(replaced(good, "NPTS=  7, DT= .01000 SEC", line));
        EXPECT_EQ(record.times.size(), 7u);
        EXPECT_DOUBLE_EQ(record.times[1], 0.01);
    }
}

TEST(PeerReader, ReadsEveryLineEnd)
{
    const Record expected = peer(good);
    for (const std::string end : {"\r\n", "\r\r\n", "\r", "   \n", "\n\n"})
    {
        std::string text;
        for (const char c : good)
        {
            text += c == '\n' ? end : std::string(1, c);
        }
        EXPECT_EQ(peer(text).accelerations, expected.accelerations);
    }
    EXPECT_EQ(peer(good.substr(0, good.size() - 1)).accelerations, expected.accelerations);
}

TEST(PeerReader, KnowsUnits)
{
    const auto peak = [](const std::string& words)
    { return std::abs(peer(replaced(good, "IN UNITS OF G. FILTER", words + " FILTER")).accelerations[5]); };
    EXPECT_DOUBLE_EQ(peak("IN UNITS OF CM/SEC/SEC."), 0.005);
    EXPECT_DOUBLE_EQ(peak("UNITS: CM/S**2"), 0.005);
    EXPECT_DOUBLE_EQ(peak("(Units are gal)"), 0.005);
    EXPECT_DOUBLE_EQ(peak("in units of m/s^2,"), 0.5);
    EXPECT_DOUBLE_EQ(accelerationUnit("ft/sec2"), 0.3048);
    EXPECT_EQ(accelerationUnit("cm/s"), 0);
    EXPECT_EQ(accelerationUnit(""), 0);
}

TEST(PeerReader, TakesTheDeclaredUnitWhereTheHeaderIsSilent)
{
    const std::string silent = replaced(good, "IN UNITS OF G. ", "");
    EXPECT_DOUBLE_EQ(peer(silent, "cm/s2").accelerations[5], -0.005);
    EXPECT_THAT(peerRefusal(silent), AllOf(HasSubstr("does not say its unit"), HasSubstr("Declare")));
    EXPECT_THAT(reportOf([&] { peer(good, "m/s2"); }),
                AllOf(HasSubstr("says it is in G"), HasSubstr("line 3")));
    EXPECT_NO_THROW(peer(good, "g"));
    EXPECT_THAT(reportOf([&] { peer(silent, "furlong"); }), HasSubstr("furlong"));
}

TEST(PeerReader, RefusesBrokenRecordsWithTheirLine)
{
    EXPECT_THAT(peerRefusal(""), HasSubstr("empty"));
    EXPECT_THAT(peerRefusal("\n \r\n\t\n"), HasSubstr("empty"));
    EXPECT_THAT(peerRefusal(replaced(good, "NPTS=  7", "NPTS=  8")),
                AllOf(HasSubstr("ends after 7 of NPTS = 8"), HasSubstr("line 6")));
    EXPECT_THAT(peerRefusal(replaced(good, "NPTS=  7", "NPTS=  5")),
                AllOf(HasSubstr("More values than NPTS = 5"), HasSubstr("line 6")));
    EXPECT_THAT(peerRefusal(replaced(good, "-.5000000E+00", "NaN")),
                AllOf(HasSubstr("NaN"), HasSubstr("line 6")));
    EXPECT_THAT(peerRefusal(replaced(good, "-.5000000E+00", "1e400")),
                AllOf(HasSubstr("1e400"), HasSubstr("line 6")));
    EXPECT_THAT(peerRefusal(replaced(good, "-.5000000E+00", "1e308")), // g: not finite in m/s2
                AllOf(HasSubstr("1e308"), HasSubstr("line 6")));
    EXPECT_THAT(peerRefusal(replaced(good, "DT= .01000", "DT= 1e308")), HasSubstr("line 4"));
    EXPECT_THAT(peerRefusal(replaced(good, "-.5000000E+00", "-.5x")),
                AllOf(HasSubstr("'-.5x'"), HasSubstr("line 6")));
    EXPECT_THAT(peerRefusal(replaced(good, "DT= .01000", "DT= -.01")),
                AllOf(HasSubstr("-0.01"), HasSubstr("line 4")));
    EXPECT_THAT(peerRefusal(replaced(good, "DT= .01000", "DT= 0")), HasSubstr("line 4"));
    EXPECT_THAT(peerRefusal(replaced(good, "DT= .01000 SEC", "")),
                AllOf(HasSubstr("DT"), HasSubstr("line 4")));
    EXPECT_THAT(peerRefusal(replaced(good, "NPTS=  7", "NPTS= many")),
                AllOf(HasSubstr("NPTS"), HasSubstr("line 4")));
    EXPECT_THAT(peerRefusal(replaced(good, "NPTS=  7", "NPTS= 7.5")), HasSubstr("7.5"));
    EXPECT_THAT(peerRefusal(replaced(good, "NPTS=  7", "NPTS= -7")), HasSubstr("-7"));
    EXPECT_THAT(peerRefusal(replaced(good, "NPTS=  7", "NPTS= 1e300")), HasSubstr("line 4"));
    EXPECT_THAT(peerRefusal("0.1 0.2\n0.3 0.4\n"), AllOf(HasSubstr("NPTS"), HasSubstr("csv")));
    EXPECT_THAT(peerRefusal(std::string("NPTS= 2, DT= .1\n\x7f\x00\x01", 19)),
                HasSubstr("control character"));
    EXPECT_THAT(peerRefusal(replaced(good, "UNITS OF G.", "UNITS OF CM/SEC.")),
                AllOf(HasSubstr("CM/SEC"), HasSubstr("line 3")));
    EXPECT_THAT(reportOf([] { readPeerRecord("/nonexistent/record.AT2"); }),
                HasSubstr("/nonexistent/record.AT2"));
    EXPECT_THAT(reportOf([] { readPeerRecord(std::filesystem::temp_directory_path()); }),
                HasSubstr("directory"));
    EXPECT_THAT(reportOf([] { readPeerRecord("/dev/null"); }), HasSubstr("not an ordinary file"));
}

TEST(PeerReader, RandomDamageIsReadAsNumbersOrRefused)
{
    std::mt19937 random(1);
    const std::string marks = " \n\r\t-+.,;=()0123456789eEdDNPTSxG\x00\xff#%\"["s;
    int readAnyway = 0;
    constexpr int copies = 3000;
    for (int copy = 0; copy < copies; ++copy)
    {
        std::string text = good;
        for (unsigned changes = 1 + random() % 4; changes > 0; --changes)
        {
            const std::size_t place = random() % text.size();
            if (random() % 3 == 0)
            {
                text.erase(place, random() % 30);
            }
            else
            {
                text.insert(place, 1, marks[random() % marks.size()]);
            }
        }
        const TemporaryFile file(text);
        for (const bool asPeer : {true, false})
        {
            const std::string message = reportOf(
                [&]
                {
                    const Record record =
                        asPeer ? readPeerRecord(file.path) : readCsvRecord(file.path, {0, 1, 0, "g"});
                    ++readAnyway;
                    for (std::size_t i = 0; i < record.times.size(); ++i)
                    {
                        EXPECT_TRUE(std::isfinite(record.accelerations[i]));
                        EXPECT_TRUE(i == 0 || record.times[i] > record.times[i - 1]);
                    }
                });
            EXPECT_TRUE(message == "no error" || message.find(file.path.string()) != std::string::npos)
                << message;
        }
    }
    EXPECT_GT(readAnyway, 0);
    EXPECT_LT(readAnyway, copies);
}

TEST(PeerReader, ReadsTheSixRealRecords)
{
    if (!std::filesystem::is_directory(recordFolder()))
    {
        GTEST_SKIP() << "no records in " << recordFolder() << ": they may not be redistributed";
    }
    for (const KnownRecord& known : knownRecords)
    {
        SCOPED_TRACE(known.file);
        const auto file = recordFolder() / known.file;
        const Record record = readPeerRecord(file);
        ASSERT_EQ(record.accelerations.size(), known.count);
        EXPECT_DOUBLE_EQ(record.times[1], known.timeStep);
        EXPECT_EQ(accelerationUnit(record.unit), standardGravity);
        EXPECT_DOUBLE_EQ(figures(record).peakAcceleration / standardGravity, largestValue(content(file)));
    }
}

TEST(PeerReader, RefusesBrokenCopiesOfTheSixRealRecords)
{
    if (!std::filesystem::is_directory(recordFolder()))
    {
        GTEST_SKIP() << "no records in " << recordFolder() << ": they may not be redistributed";
    }
    for (const KnownRecord& known : knownRecords)
    {
        SCOPED_TRACE(known.file);
        const std::string text = content(recordFolder() / known.file);
        const std::string count = std::to_string(known.count);
        const auto half = text.find(' ', text.size() / 2);
        EXPECT_THAT(peerRefusal(text.substr(0, half)), AllOf(HasSubstr("ends after"), HasSubstr("line")));
        EXPECT_THAT(peerRefusal(std::string(text).replace(half, 1, " NaN ")),
                    AllOf(HasSubstr("NaN"), HasSubstr("line")));
        EXPECT_THAT(peerRefusal(std::string(text).replace(half, 1, " 12#4 ")),
                    AllOf(HasSubstr("12#4"), HasSubstr("line")));
        EXPECT_THAT(peerRefusal(std::string(text).replace(half, 1, std::string(1, '\0'))),
                    HasSubstr("control"));
        const auto npts = text.find(count, text.find("NPTS"));
        for (const long change : {-1, 1})
        {
            EXPECT_THAT(peerRefusal(std::string(text).replace(
                            npts, count.size(), std::to_string(static_cast<long>(known.count) + change))),
                        HasSubstr("line"));
        }
        const auto step = text.find('.', text.find("DT="));
        EXPECT_THAT(peerRefusal(std::string(text).insert(step, "-")),
                    AllOf(HasSubstr("DT is -"), HasSubstr("line 4")));
    }
}

TEST(ResponseSpectrum, OfElCentroIsThatOfTheTextbook)
{
    const auto file = recordFolder() / "elCentro.AT2";
    if (!std::filesystem::exists(file))
    {
        GTEST_SKIP() << "no record " << file << ": it may not be redistributed";
    }
    // A. K. Chopra, Dynamics of Structures, section 6.4: deformation for 2% damping, read in inches to three
    // digits
    const ResponseSpectrum spectrum = responseSpectrum(readPeerRecord(file), {0.5, 1, 2}, 0.02);
    const double inch = 0.0254;
    EXPECT_NEAR(spectrum.displacements[0] / inch, 2.67, 0.02);
    EXPECT_NEAR(spectrum.displacements[1] / inch, 5.97, 0.02);
    EXPECT_NEAR(spectrum.displacements[2] / inch, 7.47, 0.02);
}

TEST(CsvReader, ReadsColumnsByNumberOrTitle)
{
    const std::string text = "# a comment\ntime,north [m/s2],east [gal]\n0,1,100\n0.01,-2,-200\n0.03,3,300\n";
    const Record north = csv(text, {});
    EXPECT_EQ(north.times, (std::vector<double>{0, 0.01, 0.03}));
    EXPECT_EQ(north.accelerations, (std::vector<double>{1, -2, 3}));
    const Record east = csv(text, {"time", "east", 0, ""});
    EXPECT_DOUBLE_EQ(east.accelerations[2], 3);
    EXPECT_DOUBLE_EQ(csv(text, {0, 2, 0, "cm/s2"}).accelerations[2], 3);
    EXPECT_THAT(csvRefusal(text, {0, "up", 0, "g"}),
                AllOf(HasSubstr("'up'"), HasSubstr("east"), HasSubstr("line 2")));
}

TEST(CsvReader, AByteOrderMarkBelongsToNoCell)
{
    const Record record = csv("\xEF\xBB\xBFt,a\n0,1\n1,2\n", {0, 1, 0, "g"});
    EXPECT_EQ(record.times.size(), 2u);
    EXPECT_EQ(csv("\xEF\xBB\xBF"
                  "0,1\n1,2\n",
                  {0, 1, 0, "g"})
                  .times.size(),
              2u);
}

TEST(CsvReader, ReadsEverySeparator)
{
    const std::vector<double> expected{0.25, -2, 3};
    EXPECT_EQ(csv("0,0.25\n1,-2\n2,3\n", {0, 1, 0, "m/s2"}).accelerations, expected);
    EXPECT_EQ(csv("0;0,25\n1;-2\n2;3,0\n", {0, 1, 0, "m/s2"}).accelerations, expected);
    EXPECT_EQ(csv("0\t0.25\n1\t-2\n2\t3\n", {0, 1, 0, "m/s2"}).accelerations, expected);
    EXPECT_EQ(csv("  0   0.25\r\n  1  -2\r\n  2  +3\r\n", {0, 1, 0, "m/s2"}).accelerations, expected);
    EXPECT_EQ(csv("\"t\",\"a [m/s2]\"\n0, 0.25\n1, -2\n2, 3", {"t", "a", 0, ""}).accelerations, expected);
}

TEST(CsvReader, AUnitAfterABlankBelongsToItsTitle)
{
    for (const char* titles : {"time [s] a [gal]", "t (s)   a (cm/s2)", "t a [gal]", " t [s] a [gal] \r"})
    {
        EXPECT_DOUBLE_EQ(csv(std::string(titles) + "\n0 1\n0.5 200\n", {}).accelerations[1], 2) << titles;
    }
    EXPECT_DOUBLE_EQ(csv("t [ms] north [g] east [gal]\n0 1 1\n500 2 200\n", {0, "east", 0, ""}).times[1],
                     0.5);
    EXPECT_DOUBLE_EQ(
        csv("t [ms] north [g] east [gal]\n0 1 1\n500 2 200\n", {0, "east", 0, ""}).accelerations[1], 2);
}

// As numpy.savetxt and tables of Drystone have them: accelerations in g were read in m/s2.
TEST(CsvReader, TitlesMayStandInAComment)
{
    for (const char* titles : {"# Time[s]  acc[g]", "# t [s], a [g]", "%t\ta (g)", "# t [s] a [g]\n",
                               "#north of 1995\n# time;a [g]"})
    {
        const Record record = csv(std::string(titles) + "\n0 0\n0.5 2\n", {});
        EXPECT_DOUBLE_EQ(record.accelerations[1], 2 * standardGravity) << titles;
        EXPECT_FALSE(record.unitIsAssumed) << titles;
    }
    EXPECT_DOUBLE_EQ(csv("# time [ms],x [gal],y [g]\n0,1,1\n500,200,2\n", {0, "x", 0, ""}).times[1], 0.5);
    EXPECT_TRUE(csv("# time,acc_gal\n0,1\n1,1\n", {}).unitIsQuestioned);
    EXPECT_THAT(csvRefusal("# t [s] a [g]\n0 1\n", {0, 1, 0, "m/s2"}), HasSubstr("g"));
    // Words are no titles.
    for (const char* words : {"# Kobe (1995)", "# Station (ABC) north", "# two words", "# g", ""})
    {
        const Record record = csv(std::string(words) + "\n0 0\n0.5 2\n", {});
        EXPECT_DOUBLE_EQ(record.accelerations[1], 2) << words;
        EXPECT_DOUBLE_EQ(record.times[1], 0.5) << words;
    }
}

TEST(CsvReader, ReadsEquallySpacedValuesWithoutTimes)
{
    EXPECT_DOUBLE_EQ(csv("acceleration [gal]\n100\n300\n", {.timeStep = 0.01, .unit = ""}).accelerations[1],
                     3);
    const Record record = csv("a\n1\n2\n3\n", {0, "a", 0.02, "gal"});
    EXPECT_EQ(record.times, (std::vector<double>{0, 0.02, 0.04}));
    EXPECT_DOUBLE_EQ(record.accelerations[2], 0.03);
}

TEST(CsvReader, TakesNumbersWithoutAnyUnitForMetresPerSecondSquared)
{
    const Record record = csv("0,1\n1,-2.5\n", {0, 1, 0, ""});
    EXPECT_EQ(record.accelerations, (std::vector<double>{1, -2.5}));
    EXPECT_EQ(record.unit, "m/s2");
    EXPECT_TRUE(record.unitIsAssumed);
    // Whoever says it, the file or the user, nothing is assumed.
    EXPECT_FALSE(csv("0,1\n1,1\n", {0, 1, 0, "m/s2"}).unitIsAssumed);
    EXPECT_FALSE(csv("t,a [g]\n0,1\n", {0, 1, 0, ""}).unitIsAssumed);
    EXPECT_DOUBLE_EQ(csv("t,a [g]\n0,1\n", {0, 1, 0, ""}).accelerations[0], standardGravity);
}

TEST(CsvReader, WarnsOfTitlesThatMayEndInAUnit)
{
    for (const char* title : {"a_g", "acc_g", "acc g", "a-GAL", "acceleration.cm/s2"})
    {
        testing::internal::CaptureStderr();
        const Record record = csv(fmt::format("t,{}\n0,1\n", title), {0, 1, 0, ""});
        EXPECT_EQ(record.accelerations[0], 1);
        EXPECT_TRUE(record.unitIsQuestioned);
        EXPECT_THAT(testing::internal::GetCapturedStderr(),
                    testing::AllOf(testing::HasSubstr(fmt::format("'{}'", title)),
                                   testing::HasSubstr("at line 1"), testing::HasSubstr("[m/s2]")));
    }
    for (const char* text : {"t,a [m/s2]\n0,1\n", "t,ag\n0,1\n", "t,a m/s2\n0,1\n", "t_g,a\n0,1\n", "0,1\n"})
    {
        EXPECT_FALSE(csv(text, {0, 1, 0, ""}).unitIsQuestioned) << text;
    }
    EXPECT_FALSE(csv("t,a_g\n0,1\n", {0, 1, 0, "g"}).unitIsQuestioned);
}

TEST(CsvReader, SaysOfARecordOfPeerThatItIsOne)
{
    const std::string header = "PEER STRONG MOTION DATABASE RECORD\nEVENT\nACCELERATION IN UNITS OF G\n";
    EXPECT_THAT(csvRefusal(header + "NPTS= 2, DT= .01 SEC\n.1 .2\n", {0, 1, 0, ""}),
                testing::AllOf(testing::HasSubstr("format PEER_AT2"), testing::HasSubstr("line 4")));
    EXPECT_EQ(csv("# NPTS 2 DT 0.01\n0,1\n", {0, 1, 0, ""}).accelerations.size(), 1u);
}

TEST(CsvReader, ReadsTimesInTheUnitOfTheirTitle)
{
    const auto lastTime = [](const std::string& title)
    { return csv(title + ",a [m/s2]\n0,0\n1.5,1\n", {}).times.back(); };
    for (const char* title : {"t", "t (s)", "time [sec]", "Seconds [S]"})
    {
        EXPECT_EQ(lastTime(title), 1.5) << title;
    }
    EXPECT_DOUBLE_EQ(lastTime("t (ms)"), 1.5e-3);
    EXPECT_DOUBLE_EQ(lastTime("Time [us]"), 1.5e-6);
    EXPECT_EQ(lastTime("t [min]"), 90);
    EXPECT_EQ(lastTime("t [h]"), 5400);
    EXPECT_THAT(csvRefusal("t [m],a [g]\n0,0\n1,1\n", {}),
                AllOf(HasSubstr("'m', which is not a unit of time"), HasSubstr("line 1")));
    EXPECT_THAT(csvRefusal("t [ms],a [g]\n0,0\n1e308,1\n1e309,1\n", {}), HasSubstr("1e309"));
}

TEST(CsvReader, RefusesATimeStepBesideAColumnOfTimes)
{
    for (const char* title : {"t", "Time", "TIME [s]", "instant (ms)"})
    {
        EXPECT_THAT(csvRefusal(std::string(title) + ",a\n0,1\n1,2\n", {0, 0, 0.1, "g"}),
                    AllOf(HasSubstr(title), HasSubstr("timeStep 0.1"), HasSubstr("Remove `timeStep`")));
    }
    EXPECT_EQ(csv("north,east [g]\n1,2\n", {0, 1, 0.1, ""}).times.size(), 1U);
}

TEST(CsvReader, NamesTheTimeStepWhereThereIsOneColumn)
{
    EXPECT_THAT(csvRefusal("0\n1\n", {0, 1, 0, "g"}), HasSubstr("`timeStep 0.01;`"));
    // Which of two columns has the accelerations is not guessed; one that is empty is none.
    for (const std::string rows : {"0.00, 0.1\n0.01, 0.2\n", "count, a [g]\n1, 0.1\n2, 0.2\n"})
    {
        EXPECT_THAT(csvRefusal(rows, {.timeStep = 0.01, .unit = "g"}),
                    AllOf(HasSubstr("2 columns"), HasSubstr("`accelerationColumn 1;`")));
        EXPECT_EQ(csv(rows, {0, 1, 0.01, "g"}).accelerations.at(1), 0.2 * accelerationUnit("g"));
    }
    EXPECT_EQ(csv("0.1,\n0.2,\n", {.timeStep = 0.01, .unit = "g"}).times.at(1), 0.01);
}

TEST(CsvReader, RefusesBrokenRecordsWithTheirLine)
{
    const CsvLayout layout{0, 1, 0, "g"};
    EXPECT_THAT(csvRefusal("", layout), HasSubstr("empty"));
    EXPECT_THAT(csvRefusal("# only\n# comments\n", layout), HasSubstr("comments only"));
    EXPECT_THAT(csvRefusal("t,a\n", layout), HasSubstr("no values"));
    EXPECT_THAT(csvRefusal("0,1\n1\n", layout), AllOf(HasSubstr("1 columns"), HasSubstr("line 2")));
    EXPECT_THAT(csvRefusal("0,1\n1,nan\n", layout), AllOf(HasSubstr("nan"), HasSubstr("line 2")));
    EXPECT_THAT(csvRefusal("0,1\n1,1e308\n", layout), AllOf(HasSubstr("1e308"), HasSubstr("line 2")));
    EXPECT_THAT(csvRefusal("0,1\n1,\n", layout), HasSubstr("line 2"));
    EXPECT_THAT(csvRefusal("0,1\n1,x\n", layout), AllOf(HasSubstr("'x'"), HasSubstr("line 2")));
    EXPECT_THAT(csvRefusal("0,1\n1,1\n0.5,1\n", layout), AllOf(HasSubstr("0.5"), HasSubstr("line 3")));
    EXPECT_THAT(csvRefusal("0,1\n0,1\n", layout), HasSubstr("line 2"));
    EXPECT_THAT(csvRefusal("0,1\n1,1\n", {0, 1, 0, "m/s"}), HasSubstr("m/s"));
    EXPECT_THAT(csvRefusal("0,1\n1,1\n", {0, 5, 0, "g"}), HasSubstr("column 5"));
    EXPECT_THAT(csvRefusal("0,1\n1,1\n", {0, -1, 0, "g"}), HasSubstr("-1"));
    EXPECT_THAT(csvRefusal("0,1\n1,1\n", {0, 1, -0.1, "g"}), HasSubstr("-0.1"));
    EXPECT_THAT(csvRefusal("0,1\n1,1\n", {"t", 1, 0, "g"}), HasSubstr("no row of titles"));
    EXPECT_THAT(csvRefusal("t,a [m/s]\n0,1\n", {0, 1, 0, ""}), HasSubstr("m/s"));
}
