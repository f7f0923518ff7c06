// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The annotated dictionaries in etc/ can be used unchanged.
#include "../MadeStructure.h"
#include "assembly/Loads.h"
#include "assembly/Materials.h"
#include "effects/ContactProperties.h"
#include "effects/EffectList.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace drystone;

namespace
{

TEST(AnnotatedDictionaries, CanBeUsedAsTheyStand)
{
    const std::filesystem::path folder = std::filesystem::path(DRYSTONE_SOURCE_DIR) / "etc/annotated";
    const Assembly<2> assembly = madeStructure(Dictionary::readFile(folder / "system/blockTextureDict"));
    EXPECT_GT(assembly.blocks.size(), 0U);
    EXPECT_GT(madeStructure<3>(Dictionary::readFile(folder / "space/system/blockTextureDict")).blocks.size(),
              0U);
    const Vector<2> gravity = readGravity<2>(folder);
    EXPECT_TRUE(readContactProperties(folder).friction);
    const std::vector<double> masses(assembly.blocks.size(), 1);
    EXPECT_GT(readLoads<2>(folder, {assembly, masses, gravity}, LiveLoad::required).live.norm(), 0);
}

} // namespace
