// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Places of entries that outlive their dictionary.
#include "dictionary/EntryLocations.h"

#include <gtest/gtest.h>

using namespace drystone;

TEST(EntryLocations, NameFilePathAndLineOfEntriesAndOfWhatIsAroundThem)
{
    EntryLocations locations;
    {
        const Dictionary dictionary = Dictionary::readString("friction { mu 0.5; }\njoints\n{\n"
                                                             "    3-7 { tension { strength 1; } }\n}\n",
                                                             "constant/contactProperties");
        locations = EntryLocations(dictionary);
    }
    EXPECT_TRUE(locations.has("joints/3-7/tension"));
    EXPECT_FALSE(locations.has("joints/3-8"));
    EXPECT_EQ(locations.of("friction/mu").line, 1);
    EXPECT_EQ(locations.of("joints/3-7/tension").line, 4);
    EXPECT_EQ(locations.of("joints/3-8/tension").line, 2) << "the nearest that is there";
    EXPECT_EQ(locations.of("joints/3-7/tension").file, "constant/contactProperties");
}

TEST(EntryLocations, AreEmptyWhereNothingWasRead)
{
    const EntryLocations none;
    EXPECT_FALSE(none.has("friction"));
    EXPECT_EQ(none.of("friction/mu").line, SourceLocation{}.line);
}
