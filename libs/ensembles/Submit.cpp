// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Writes and submits Slurm scripts.
#include "ensembles/Submit.h"

#include "core/Log.h"
#include "core/Paragraph.h"
#include "core/WholeFile.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include <sys/wait.h>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

/// As one word of a shell.
std::string quoted(const std::string& text)
{
    std::string word = "'";
    for (const char c : text)
    {
        word += c == '\'' ? "'\\''" : std::string(1, c);
    }
    return word + "'";
}

std::string heading(const fs::path& caseDirectory, const std::vector<std::string>& options,
                    const std::string& name, const std::string& log)
{
    const fs::path folder = ensembleFolder(caseDirectory);
    std::string text =
        fmt::format("#!/bin/bash\n#SBATCH --job-name={}\n#SBATCH --output={}\n#SBATCH --requeue\n"
                    "#SBATCH --open-mode=append\n",
                    name, (folder / log).string());
    for (const std::string& option : options)
    {
        text += "#SBATCH " + option + "\n";
    }
    return text;
}

/// What a program prints. \return its exit status
int outputOf(const std::string& command, std::string& output)
{
    std::FILE* pipe = ::popen(command.c_str(), "r");
    if (!pipe)
    {
        return 127;
    }
    std::array<char, 4096> buffer{};
    for (std::size_t count = 0; (count = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    {
        output.append(buffer.data(), count);
    }
    const int status = ::pclose(pipe);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

std::string submitted(const fs::path& script, const std::string& options)
{
    std::string output;
    const int status =
        outputOf(fmt::format("sbatch --parsable {} {} 2>&1", options, quoted(script.string())), output);
    output.erase(output.find_last_not_of(" \n") + 1);
    if (status != 0)
    {
        throw FatalError(
            fmt::format("sbatch ended with exit status {}: {}\n\nThe script is {}; submit it by hand "
                        "where Slurm is.",
                        status, output, script.string()));
    }
    return output.substr(0, output.find(';')); // the number; after it the cluster
}

} // namespace

std::string slurmScript(const fs::path& program, const fs::path& caseDirectory, const std::string& options)
{
    const std::string command =
        fmt::format("{} -case {} -parallel", quoted(program.string()), quoted(caseDirectory.string()));
    return heading(caseDirectory, wordsOf(options), "ensemble", "log.ensemble.%A_%a")
           + fmt::format("if [ \"${{SLURM_NTASKS:-1}}\" -gt 1 ]\nthen\n    exec srun "
                         "--cpus-per-task=\"${{SLURM_CPUS_PER_TASK:-1}}\" {0}\nfi\nexec {0}\n",
                         command);
}

std::string slurmMergeScript(const fs::path& program, const fs::path& caseDirectory,
                             const std::string& options)
{
    // One process: what concerns the number of tasks is not for it, the partition and the account are.
    std::vector<std::string> own;
    for (const std::string& word : wordsOf(options))
    {
        constexpr std::array<std::string_view, 4> ofTasks{"--array", "--ntasks", "--cpus-per-task",
                                                          "--nodes"};
        const bool isOfTasks = std::any_of(ofTasks.begin(), ofTasks.end(),
                                           [&](std::string_view name) { return word.starts_with(name); });
        if (!isOfTasks)
        {
            own.push_back(word);
        }
    }
    return heading(caseDirectory, own, "ensembleMerge", "log.ensemble.merge")
           + fmt::format("exec {} -case {} -postProcess\n", quoted(program.string()),
                         quoted(caseDirectory.string()));
}

void submitToSlurm(const Ensemble& ensemble, const std::string& options)
{
    const fs::path program = fs::read_symlink("/proc/self/exe");
    const fs::path directory = fs::canonical(ensemble.caseDirectory);
    const fs::path folder = ensembleFolder(directory);
    const fs::path script = folder / "ensemble.sbatch";
    const fs::path merge = folder / "merge.sbatch";
    writeWholeFile(script, slurmScript(program, directory, options));
    writeWholeFile(merge, slurmMergeScript(program, directory, options));
    const std::string job = submitted(script, "");
    const std::string after = submitted(merge, "--dependency=afterany:" + job);
    info("Submitted job {} ({}), and job {} that writes tables and statistics after it", job, script.string(),
         after);
    printLine();
}

} // namespace drystone
