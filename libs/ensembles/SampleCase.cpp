// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Sets entries in texts in memory; blocks, and structures of which friction alone changes, are kept.
#include "ensembles/SampleCase.h"

#include "assembly/AssemblyFile.h"
#include "assembly/AssemblyOrigin.h"
#include "contact/ClosedAssembly.h"
#include "contact/JointClosure.h"
#include "core/WholeFile.h"
#include "dictionary/DictionaryEdit.h"
#include "dictionary/Fingerprint.h"
#include "texture/Texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

constexpr const char* textureFile = "system/blockTextureDict";
constexpr const char* contactFile = "constant/contactProperties";

} // namespace

std::string entryText(const SampleValue& value)
{
    const bool isPlain =
        !std::isnan(value.number)
        || std::all_of(value.text.begin(), value.text.end(),
                       [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; });
    return isPlain ? value.text : fmt::format("\"{}\"", value.text);
}

SampleCase::SampleCase(const Ensemble& of) : ensemble(of) {}

void SampleCase::setEntries(const std::vector<SampleValue>& values)
{
    std::map<std::string, std::string> changed;
    for (std::size_t k = 0; k < values.size(); ++k)
    {
        const CaseEntry& place = ensemble.settings.variables[k].second.place;
        auto [text, isNew] = changed.try_emplace(place.file);
        if (isNew)
        {
            text->second = original(place.file);
        }
        text->second = withEntrySet(text->second, place.file, place.entry, entryText(values[k]));
    }
    for (auto& [file, text] : changed)
    {
        files.set(ensemble.caseDirectory / file, std::move(text));
    }
}

const std::string& SampleCase::original(const std::string& file)
{
    const auto [text, isNew] = originals.try_emplace(file);
    if (isNew)
    {
        text->second = contentOfFile(ensemble.caseDirectory / file);
    }
    return text->second;
}

template<int Dim>
const SoundStructure<Dim>& SampleCase::soundOf(const Dictionary& dictionary)
{
    auto& [key, blocks] = std::get<KeptStructure<Dim>>(kept);
    const std::uint64_t wanted = fingerprint(dictionary);
    if (!blocks || key != wanted)
    {
        blocks.reset(); // also where those of the dictionary are refused
        blocks = soundStructure(ensemble.caseDirectory, assemblyOf<Dim>(dictionary));
        key = wanted;
    }
    return *blocks;
}

/// Joints closed.
template<int Dim>
Assembly<Dim> SampleCase::assemblyOf(const Dictionary& dictionary) const
{
    if (!ensemble.settings.runs("blockTexture"))
    {
        return readAssembly<Dim>(ensemble.caseDirectory);
    }
    Assembly<Dim> assembly = makeStructure<Dim>(dictionary, ensemble.caseDirectory);
    closeJoints(assembly);
    return assembly;
}

template<int Dim>
void SampleCase::build(const Dictionary& texture)
{
    const fs::path& directory = ensemble.caseDirectory;
    files.set(assemblyFile(directory), assemblyText(makeStructure<Dim>(texture, directory),
                                                    originOf(directory / textureFile, directory)));
}

Dictionary SampleCase::dictionaryOfBlocks() const
{
    const fs::path& directory = ensemble.caseDirectory;
    return ensemble.settings.runs("blockTexture") ? Dictionary::readFile(directory / textureFile)
                                                  : readFileOfBlocks(directory);
}

int SampleCase::dimensions(const Dictionary& blocks) const
{
    return ensemble.settings.runs("blockTexture") ? dimensionsOf(blocks) : dimensionsOfBlocks(blocks);
}

std::optional<LimitAnalysisCase<2>> SampleCase::readPlane()
{
    const Dictionary dictionary = dictionaryOfBlocks();
    if (dimensions(dictionary) != 2)
    {
        return {};
    }
    return readLimitAnalysisCase<2>(ensemble.caseDirectory, soundOf<2>(dictionary));
}

/// As readPlane, of a structure that has been read for another sample where there is one.
std::optional<LimitAnalysisCase<2>> SampleCase::readAlike()
{
    if (!alike.empty())
    {
        LimitAnalysisCase<2> structure = std::move(alike.back());
        alike.pop_back();
        if (readContactAnew(structure, ensemble.caseDirectory))
        {
            return structure;
        }
    }
    return readPlane();
}

void SampleCase::keepAlike(LimitAnalysisCase<2>& structure)
{
    const auto& variables = ensemble.settings.variables;
    if (std::all_of(variables.begin(), variables.end(),
                    [&](const Named<EnsembleVariable>& variable)
                    { return variable.second.place.file == contactFile; })
        && !files.isIncluded(ensemble.caseDirectory / contactFile))
    {
        alike.push_back(std::move(structure));
    }
}

std::vector<LimitAnalysisCase<2>> SampleCase::readAll(const std::vector<std::vector<SampleValue>>& samples,
                                                      std::vector<std::size_t>& read)
{
    std::vector<LimitAnalysisCase<2>> structures;
    structures.reserve(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i)
    {
        setEntries(samples[i]);
        try
        {
            if (std::optional<LimitAnalysisCase<2>> structure = readAlike())
            {
                structures.push_back(std::move(*structure));
                read.push_back(i);
            }
        }
        catch (const FatalError&)
        {
            // Reported where the sample is run by itself.
        }
    }
    return structures;
}

template const SoundStructure<2>& SampleCase::soundOf(const Dictionary& dictionary);
template const SoundStructure<3>& SampleCase::soundOf(const Dictionary& dictionary);
template void SampleCase::build<2>(const Dictionary& texture);
template void SampleCase::build<3>(const Dictionary& texture);

} // namespace drystone
