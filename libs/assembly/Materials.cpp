// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading of materials and gravity.
#include "assembly/Materials.h"

#include "assembly/CaseFile.h"
#include "assembly/NamedZones.h"
#include "core/Error.h"
#include "geometry/PointText.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

/// Moon to models in a small centrifuge; no gravity at all is a choice.
constexpr double weakestGravity = 1;
constexpr double strongestGravity = 25;

template<int Dim>
std::string doubtAbout(const Gravity<Dim>& gravity)
{
    const Vector<Dim>& g = gravity.value;
    const std::string usual = asWritten<Dim>(-9.81 * Vector<Dim>::Unit(Dim - 1));
    if (g[Dim - 1] > 0)
    {
        return fmt::format("Gravity {} [m/s2] points upwards: the blocks fall away from the ground. "
                           "Usual is {}.",
                           asWritten<Dim>(g), usual);
    }
    if (Dim == 3 && g[1] != 0 && g[0] == 0 && g[2] == 0)
    {
        return fmt::format("Gravity {} [m/s2] is horizontal: in space z is up. Usual is {}.",
                           asWritten<Dim>(g), usual);
    }
    if (Dim == 2 && std::abs(g[0]) > std::abs(g[Dim - 1]))
    {
        return fmt::format("Gravity {} [m/s2] points to the side more than down: was a component left out? "
                           "Usual is {}. It is used as it stands.",
                           asWritten<Dim>(g), usual);
    }
    if (const double size = g.norm(); size > 0 && (size < weakestGravity || size > strongestGravity))
    {
        return fmt::format("Gravity of {:g} m/s2 is unusual: usual is 9.81, from {:g} to {:g}. It is used as "
                           "it stands.",
                           size, weakestGravity, strongestGravity);
    }
    return {};
}

double densityOf(const Material& material, double weight, const Dictionary& dictionary)
{
    if (material.unitWeight && weight == 0)
    {
        throw FatalIOError(
            "unitWeight says nothing of the mass where gravity is 0 (constant/g). Give density instead.",
            dictionary.locationOf("unitWeight"));
    }
    return material.density ? *material.density : *material.unitWeight / weight;
}

} // namespace

void declare(Options& options, Material& material)
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

void declare(Options& options, MaterialProperties& material)
{
    declare(options, material.ofAll);
    options
        .optional("zones", material.zones,
                  "other blocks than most, by the zone of constant/assembly/blocks that they are in")
        .example("brick");
}

template<int Dim>
void declare(Options& options, Gravity<Dim>& gravity)
{
    options.readElsewhere({"dimensions"}, "those of an acceleration, as OpenFOAM has them: [0 1 -2 0 0 0 0]");
    options.required("value", gravity.value, "acceleration of gravity")
        .unit("m/s2")
        .example(Dim == 2 ? "(0 -9.81 0)" : "(0 0 -9.81)");
    options.question("value", [&gravity] { return doubtAbout(gravity); });
}

template<int Dim>
Vector<Dim> readGravity(const std::filesystem::path& caseDirectory)
{
    const Dictionary dictionary =
        readCaseFile(caseDirectory, "constant/g", Dim == 2 ? "value (0 -9.81 0);" : "value (0 0 -9.81);");
    if (const Entry* dimensions = dictionary.find("dimensions"))
    {
        dimensions->markUsed();
        TokenCursor cursor(*dimensions);
        readDimensions(cursor, "m/s2");
        cursor.expectEnd();
    }
    return readOptions<Gravity<Dim>>(dictionary).value;
}

namespace
{

/// Says of blocks of a zone that another one has given a density already, by its name.
template<int Dim>
void questionZone(const Assembly<Dim>& assembly, const Zone& zone, const std::vector<std::string>& named,
                  const SourceLocation& place)
{
    std::vector<char> isInZone(assembly.blocks.size(), false);
    for (const int block : zone.blocks)
    {
        isInZone[static_cast<std::size_t>(block)] = true;
    }
    for (const Zone& other : assembly.zones)
    {
        const bool isNamed = std::find(named.begin(), named.end(), other.name) != named.end();
        const auto shared =
            std::find_if(other.blocks.begin(), other.blocks.end(),
                         [&](int block) { return isInZone[static_cast<std::size_t>(block)] != 0; });
        if (isNamed && other.name != zone.name && shared != other.blocks.end())
        {
            printWarningOnce(fmt::format("Block {} is in the zones {} and {}: the density of {}, which comes "
                                         "later, counts.",
                                         *shared, other.name, zone.name, zone.name),
                             place);
        }
    }
}

} // namespace

template<int Dim>
std::vector<double> readDensities(const std::filesystem::path& caseDirectory, const Assembly<Dim>& assembly,
                                  const std::type_identity_t<Vector<Dim>>& gravity)
{
    const Dictionary dictionary = readCaseFile(caseDirectory, "constant/materialProperties", "density 2000;");
    const auto material = readOptions<MaterialProperties>(dictionary);
    const double weight = gravity.norm();
    std::vector<double> densities(assembly.blocks.size(), densityOf(material.ofAll, weight, dictionary));
    std::vector<std::string> named; // zones so far, without those that patterns match
    for (const auto& [name, ofZone] : material.zones)
    {
        const Dictionary& ownDictionary = dictionary.subDict("zones").subDict(name.text);
        const double density = densityOf(ofZone, weight, ownDictionary);
        requireZone(name, assembly.zones, ownDictionary.location());
        for (const Zone& zone : assembly.zones)
        {
            // As everywhere a name counts before patterns, which may come later.
            const bool hasEntryOfItsOwn =
                name.text != zone.name
                && std::any_of(material.zones.begin(), material.zones.end(),
                               [&zone](const auto& entry) { return entry.first.text == zone.name; });
            if (name.matches(zone.name) && !hasEntryOfItsOwn)
            {
                if (name.text == zone.name)
                {
                    questionZone(assembly, zone, named, ownDictionary.location());
                    named.push_back(zone.name);
                }
                for (const int block : zone.blocks)
                {
                    densities[static_cast<std::size_t>(block)] = density;
                }
            }
        }
    }
    return densities;
}

template void declare(Options& options, Gravity<2>& gravity);
template void declare(Options& options, Gravity<3>& gravity);
template Vector<2> readGravity<2>(const std::filesystem::path& caseDirectory);
template Vector<3> readGravity<3>(const std::filesystem::path& caseDirectory);
template std::vector<double> readDensities(const std::filesystem::path& caseDirectory,
                                           const Assembly<2>& assembly, const Vector<2>& gravity);
template std::vector<double> readDensities(const std::filesystem::path& caseDirectory,
                                           const Assembly<3>& assembly, const Vector<3>& gravity);

} // namespace drystone
