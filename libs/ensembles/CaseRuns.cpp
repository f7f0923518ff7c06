// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Runs of applications in copies of a case, and what their failures mean for the study.
#include "ensembles/CaseRuns.h"

#include "core/Error.h"
#include "core/Log.h"
#include "ensembles/CaseCopy.h"
#include "ensembles/CopyMessages.h"

#include <fmt/format.h>

#include <cstdint>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

enum class Depth
{
    results,
    beginning ///< what computes does not
};

bool computes(const std::string& application)
{
    return application != "blockTexture" && application != "checkBlocks";
}

CaseRun runIn(const fs::path& caseDirectory, const fs::path& copy, const CaseApplications& applications,
              Depth depth)
{
    CaseRun run;
    for (const std::string& directory : applications.cases)
    {
        for (const std::string& application : applications.applications)
        {
            std::vector<std::string> options = applications.options;
            if (depth == Depth::beginning && isScript(application))
            {
                break; // nobody knows what a script does
            }
            if (depth == Depth::beginning && computes(application))
            {
                options.emplace_back("-dry-run");
            }
            const fs::path there = (copy / directory).lexically_normal();
            static_cast<ApplicationRun&>(run) = runInCase(application, there, options);
            run.application = application;
            run.directory = directory;
            for (std::string& warning : warningsOfCopy(run.firstErrors, copy, caseDirectory))
            {
                run.warnings.push_back(std::move(warning));
            }
            if (run.isInterrupted || run.status != 0)
            {
                return run;
            }
        }
    }
    return run;
}

void copyWith(const fs::path& caseDirectory, const fs::path& target, const std::vector<OtherEntry>& entries)
{
    copyCase(caseDirectory, target);
    for (const auto& [place, text] : entries)
    {
        setEntry(target, place, text);
    }
}

/// Removes a folder at the end, and those above it that were not there before.
class PassingFolder
{
public:
    explicit PassingFolder(fs::path of) : folder(std::move(of))
    {
        for (top = folder; !fs::exists(top.parent_path()); top = top.parent_path())
        {
        }
    }
    ~PassingFolder()
    {
        std::error_code ignored;
        fs::remove_all(folder, ignored);
        for (fs::path above = folder; above != top;)
        {
            above = above.parent_path();
            fs::remove(above, ignored); // empty ones only
        }
    }
    PassingFolder(const PassingFolder&) = delete;
    PassingFolder& operator=(const PassingFolder&) = delete;

private:
    fs::path folder;
    fs::path top;
};

/// An application that a full disk has ended says nothing of the values it was given, and its own message may
/// have had no room either. \throws FatalError
void requireRoom(const fs::path& copy, const CaseRun& failed)
{
    constexpr std::uintmax_t little = 1 << 20; // [bytes]; what could not be written whole is removed again
    std::error_code unknown;
    const fs::space_info space = fs::space(copy, unknown);
    if (!unknown && space.available < little)
    {
        throw FatalError(fmt::format(
            "{} ended with exit status {} in {}, and its disk has less than 1 MB left: that is no "
            "result.\n\nMake room on the disk, and start again; it goes on from here.",
            failed.application, failed.status, copy.string()));
    }
}

} // namespace

CaseRun runCopy(const fs::path& caseDirectory, const fs::path& target, const std::vector<OtherEntry>& entries,
                const CaseApplications& applications)
{
    copyWith(caseDirectory, target, entries);
    CaseRun run = runIn(caseDirectory, target, applications, Depth::results);
    if (run.status != 0 && !run.isInterrupted)
    {
        requireRoom(target, run);
    }
    return run;
}

CaseRun tryCopy(const fs::path& caseDirectory, const fs::path& target, const std::vector<OtherEntry>& entries,
                const CaseApplications& applications)
{
    const PassingFolder folder(fs::absolute(target));
    copyWith(caseDirectory, target, entries);
    return runIn(caseDirectory, target, applications, Depth::beginning);
}

std::vector<std::string> requireReadableCase(const fs::path& caseDirectory, const fs::path& target,
                                             const std::vector<std::vector<OtherEntry>>& sets,
                                             const CaseApplications& applications)
{
    std::error_code unwritable;
    {
        const PassingFolder folder(fs::absolute(target));
        fs::create_directories(target, unwritable);
    }
    if (unwritable)
    {
        info("The input of the runs is not checked: {} cannot be written ({}).", target.string(),
             unwritable.message());
        return {};
    }
    std::optional<CaseRun> first;
    for (const std::vector<OtherEntry>& entries : sets)
    {
        const CaseRun run = tryCopy(caseDirectory, target, entries, applications);
        if (run.isInterrupted || run.status == 0)
        {
            return run.warnings;
        }
        first = first ? first : run;
    }
    if (first)
    {
        throw FatalError(
            fmt::format("The case cannot be run, tried with {} of values of its variables: {} ends with exit "
                        "status {}.\n\n{}",
                        sets.size() == 1 ? "a set" : fmt::format("{} sets", sets.size()), first->application,
                        first->status, faultOfCopy(first->errorOutput, target)));
    }
    return {};
}

} // namespace drystone
