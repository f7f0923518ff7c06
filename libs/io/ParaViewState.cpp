// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Fills the case into the script that shows cases in ParaView.
#include "io/ParaViewState.h"

#include "core/WholeFile.h"
#include "runControl/CaseFiles.h"

#include <string>
#include <string_view>

namespace drystone
{

namespace
{

/// A string of Python.
std::string literal(const std::string& text)
{
    std::string quoted = "\"";
    for (const char c : text)
    {
        quoted += c == '"' || c == '\\' ? "\\" : "";
        quoted += c;
    }
    return quoted + "\"";
}

} // namespace

bool writeParaViewState(const std::filesystem::path& caseDirectory)
{
    constexpr std::string_view place = "ownCase = None";
    const std::filesystem::path shared = sharedFolder();
    std::string script = shared.empty() ? "" : contentOfFile(shared / "etc/paraview/drystone.py");
    const std::size_t at = script.find(place);
    if (at == std::string::npos)
    {
        return false;
    }
    script.replace(at, place.size(), "ownCase = " + literal(fullName(caseDirectory).string()));
    writeWholeFile(caseDirectory / "VTK/paraviewState.py", script);
    return true;
}

} // namespace drystone
