// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Whether results of studies that a case keeps follow from the input that it has now.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// For who shows the results of studies together with the input of now: warns of those that follow from other
/// input, and of an ensemble whose dictionary wants other samples. \return the warnings
std::vector<std::string> compareStudies(const std::filesystem::path& caseDirectory);

} // namespace drystone
