// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading of materials and gravity.
#include "assembly/Materials.h"

#include "assembly/CaseFile.h"

#include <fmt/format.h>

namespace drystone
{

namespace
{

/// Moon to models in a small centrifuge; no gravity at all is a choice.
constexpr double weakestGravity = 1;
constexpr double strongestGravity = 25;

std::string doubtAbout(const Gravity& gravity)
{
    const Vector<2>& g = gravity.value;
    if (g.y() > 0)
    {
        return fmt::format("Gravity ({:g} {:g}) [m/s2] points upwards: the blocks fall away from the ground. "
                           "Usual is (0 -9.81).",
                           g.x(), g.y());
    }
    if (const double size = g.norm(); size > 0 && (size < weakestGravity || size > strongestGravity))
    {
        return fmt::format("Gravity of {:g} m/s2 is unusual: usual is 9.81, from {:g} to {:g}. It is used as "
                           "it stands.",
                           size, weakestGravity, strongestGravity);
    }
    return {};
}

} // namespace

void declare(Options& options, MaterialProperties& material)
{
    options.optional("density", material.density, "mass of a volume")
        .unit("kg/m3")
        .above(0)
        .usual(300, 8000, "brick has some 1800, stone 2200 to 2800")
        .example("2000");
    options.optional("unitWeight", material.unitWeight, "weight of a volume, instead of the density")
        .unit("N/m3")
        .above(0)
        .usual(1000, 80000, "brick has some 18000, stone 22000 to 28000")
        .example("20000");
    options.check("density",
                  [&material]() -> std::string
                  {
                      if (material.density && material.unitWeight)
                      {
                          return "Both density and unitWeight are given. Remove one of them.";
                      }
                      if (!material.density && !material.unitWeight)
                      {
                          return "Give density [kg/m3], for instance `density 2000;`, or unitWeight [N/m3].";
                      }
                      return {};
                  });
}

void declare(Options& options, Gravity& gravity)
{
    options.readElsewhere({"dimensions"}, "[0 1 -2 0 0 0 0]");
    options.required("value", gravity.value, "acceleration of gravity").unit("m/s2").example("(0 -9.81 0)");
    options.question("value", [&gravity] { return doubtAbout(gravity); });
}

Vector<2> readGravity(const std::filesystem::path& caseDirectory)
{
    const Dictionary dictionary = readCaseFile(caseDirectory, "constant/g", "value (0 -9.81 0);");
    if (const Entry* dimensions = dictionary.find("dimensions"))
    {
        dimensions->markUsed();
        TokenCursor cursor(*dimensions);
        readDimensions(cursor, "m/s2");
        cursor.expectEnd();
    }
    return readOptions<Gravity>(dictionary).value;
}

std::vector<double> readDensities(const std::filesystem::path& caseDirectory, const Assembly<2>& assembly,
                                  const Vector<2>& gravity)
{
    const Dictionary dictionary = readCaseFile(caseDirectory, "constant/materialProperties", "density 2000;");
    const auto material = readOptions<MaterialProperties>(dictionary);
    if (material.unitWeight && gravity.isZero())
    {
        throw FatalIOError(
            "unitWeight says nothing of the mass where gravity is 0 (constant/g). Give density instead.",
            dictionary.locationOf("unitWeight"));
    }
    const double density = material.density ? *material.density : *material.unitWeight / gravity.norm();
    return std::vector<double>(assembly.blocks.size(), density);
}

std::vector<double> massesOf(const std::vector<BlockMass<2>>& blocks, const std::vector<double>& densities)
{
    std::vector<double> masses;
    masses.reserve(blocks.size());
    for (std::size_t i = 0; i < blocks.size(); ++i)
    {
        masses.push_back(densities[i] * blocks[i].volume);
    }
    return masses;
}

} // namespace drystone
