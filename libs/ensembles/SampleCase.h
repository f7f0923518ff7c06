// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The case of an ensemble in memory, as each sample in turn has it.
#pragma once

#include "dictionary/FilesInMemory.h"
#include "ensembles/Ensemble.h"
#include "statics/LimitAnalysisCase.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace drystone
{

/// The texts of a case with the entries of a sample, and what of its structure is kept for the next. While it
/// is there, dictionaries of this thread are read from it.
class SampleCase
{
public:
    /// \param ensemble not owned
    explicit SampleCase(const Ensemble& ensemble);

    /// From now on the case has these values of the variables.
    void setEntries(const std::vector<SampleValue>& values);

    /// The dictionary of the blocks: of a texture, or of the assembly that is there.
    Dictionary dictionaryOfBlocks() const;

    /// 2 (plane) or 3 (space). \param blocks see dictionaryOfBlocks
    int dimensions(const Dictionary& blocks) const;

    /// The blocks of this dictionary, with their contact points. Most samples differ in properties or loads,
    /// not in blocks: those of the last sample are kept. \throws FatalError
    template<int Dim>
    const SoundStructure<Dim>& soundOf(const Dictionary& dictionary);

    /// Has the case the blocks of this texture, for applications that read an assembly.
    template<int Dim>
    void build(const Dictionary& texture);

    /// The limit analysis of the sample, where the case is one of the plane. \throws FatalError
    std::optional<LimitAnalysisCase<2>> readPlane();

    /// Likewise of several samples. \param read gets the numbers of those that are of the plane and have no
    /// fault
    std::vector<LimitAnalysisCase<2>> readAll(const std::vector<std::vector<SampleValue>>& samples,
                                              std::vector<std::size_t>& read);

    /// Keeps a structure that has been analysed, and not changed meanwhile, for samples that differ from it
    /// in contact properties alone.
    void keepAlike(LimitAnalysisCase<2>& structure);

private:
    /// The blocks of the last sample, and the fingerprint of the dictionary that they are made of.
    template<int Dim>
    struct KeptStructure
    {
        std::uint64_t key = 0;
        std::optional<SoundStructure<Dim>> blocks;
    };

    const std::string& original(const std::string& file);
    template<int Dim>
    Assembly<Dim> assemblyOf(const Dictionary& dictionary) const;
    std::optional<LimitAnalysisCase<2>> readAlike();

    const Ensemble& ensemble;
    FilesInMemory files;
    std::map<std::string, std::string> originals;
    std::tuple<KeptStructure<2>, KeptStructure<3>> kept;
    std::vector<LimitAnalysisCase<2>> alike; ///< read for other samples
};

/// As a dictionary has it: words with signs between quotes.
std::string entryText(const SampleValue& value);

} // namespace drystone
