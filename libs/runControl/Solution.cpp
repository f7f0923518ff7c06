// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The part of system/solution that is an application's.
#include "runControl/Solution.h"

#include "dictionary/Options.h"

namespace drystone
{

const std::vector<std::string>& solutionApplications()
{
    static const std::vector<std::string> applications{"accuracyCost", "contactDynamics", "limitAnalysis"};
    return applications;
}

Dictionary readSolution(const std::filesystem::path& caseDirectory, const std::string& application)
{
    const Dictionary dictionary = Dictionary::readFileIfPresent(caseDirectory / "system/solution");
    Options options;
    options.readElsewhere(solutionApplications());
    options.readFrom(dictionary);
    const Entry* own = dictionary.find(application);
    return own ? own->dictionary() : Dictionary();
}

} // namespace drystone
