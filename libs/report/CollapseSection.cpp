// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What limitAnalysis has found, as its tables have it.
#include "report/ReportSections.h"

#include "contact/SupportPaths.h"
#include "core/WholeFile.h"
#include "functionObjects/CollapseProgressLog.h"
#include "functionObjects/Histories.h"
#include "functionObjects/LimitAnalysisLog.h"
#include "functionObjects/LimitAnalysisResults.h"
#include "functionObjects/LoadEnvelope.h"
#include "functionObjects/LoadMeaning.h"
#include "quantities/TableLine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

struct NamedAnswer
{
    std::string name; ///< of a combination
    double alpha = 0; ///< NaN where the row has none
};

/// Combinations of loads are named in a table of their own, in the order of their answers. None where the two
/// do not agree: names would belong to other answers.
std::vector<NamedAnswer> namesOfAnswers(HtmlPage& page, const fs::path& caseDirectory,
                                        const std::vector<double>& multipliers)
{
    std::vector<NamedAnswer> named;
    const fs::path file = limitAnalysisTable(caseDirectory).replace_filename("combinations.dat");
    std::istringstream combinations(contentOfFile(file));
    for (TableLine line; nextLine(combinations, line);)
    {
        if (!line.isHeading && !line.words.empty())
        {
            const std::optional<double> alpha =
                line.words.size() > 1 ? numberIn(line.words[1]) : std::nullopt;
            named.push_back({line.words.front(), alpha.value_or(std::numeric_limits<double>::quiet_NaN())});
        }
    }
    const auto isSame = [](const NamedAnswer& answer, double alpha)
    { return answer.alpha == alpha || (std::isnan(answer.alpha) && std::isnan(alpha)); };
    if (!named.empty()
        && !std::equal(named.begin(), named.end(), multipliers.begin(), multipliers.end(), isSame))
    {
        const std::string fault =
            fmt::format("{} does not have the {} answers of limitAnalysis.dat: one of the two is damaged, "
                        "and answers are given "
                        "without the names of their combinations. Run limitAnalysis again.",
                        fs::relative(file, caseDirectory).string(), multipliers.size());
        printWarning(fault);
        page.paragraph(fault);
        named.clear();
    }
    return named;
}

/// The answers of limitAnalysis as its tables have them.
std::vector<LimitAnalysis> storedAnswers(HtmlPage& page, const fs::path& caseDirectory,
                                         const NumberTable& table)
{
    const std::vector<NamedAnswer> names = namesOfAnswers(page, caseDirectory, table.columns.front());
    std::vector<LimitAnalysis> answers;
    for (std::size_t row = 0; row < table.columns.front().size(); ++row)
    {
        LimitAnalysis answer;
        answer.alpha = table.columns[0][row];
        answer.status = storedStatus(table.columns[1][row]).value_or(CollapseStatus::notConverged);
        answer.combination = row < names.size() ? names[row].name : "";
        answers.push_back(std::move(answer));
    }
    return answers;
}

/// What limitAnalysis has said of what its search for collapses by Coulomb's law has found, and not how it
/// went on; none where its log is not kept.
std::vector<std::string> searchInLog(const fs::path& caseDirectory)
{
    std::vector<std::string> sentences;
    std::istringstream log(contentOfFile(caseDirectory / "log.limitAnalysis"));
    for (std::string line; std::getline(log, line);)
    {
        if (line.starts_with(coulombWords) && !isCollapseProgress(line))
        {
            sentences.push_back(line + ".");
        }
    }
    return sentences;
}

/// Says of each search that maximumTime has ended what that means.
std::vector<std::string> searchesCutShort(const fs::path& caseDirectory,
                                          const std::vector<LimitAnalysis>& answers)
{
    std::vector<std::string> sentences;
    const std::vector<std::string> suffixes = suffixesOfAnswers(answers);
    for (std::size_t i = 0; i < answers.size(); ++i)
    {
        const NumberTable table = readNumberTable(
            limitAnalysisTable(caseDirectory).replace_filename("coulomb" + suffixes[i] + ".dat"));
        const std::optional<std::size_t> column = findColumn(table.names, "cutShortAfter");
        if (column && !table.columns[*column].empty())
        {
            sentences.push_back(fmt::format(
                "{}The search was ended by maximumTime after {:.3g} s, before all was tried: {}",
                answers[i].combination.empty() ? "" : "Combination " + answers[i].combination + ": ",
                table.columns[*column].front(),
                answers[i].status == CollapseStatus::upperBound
                    ? "that no collapse was found says little."
                    : "there may be lower multipliers than the one below."));
        }
    }
    return sentences;
}

/// Whether there is a multiplier; of a damaged table there may be none.
bool isMultiplier(const LimitAnalysis& answer)
{
    return answer.status == CollapseStatus::optimal && std::isfinite(answer.alpha);
}

std::string verdict(const LimitAnalysis& answer, FlowRule flowRule)
{
    switch (answer.status)
    {
    case CollapseStatus::optimal:
        if (!isMultiplier(answer))
        {
            break;
        }
        return fmt::format("alpha = {:.6g}", answer.alpha);
    case CollapseStatus::unstable:
        return "unstable: the blocks cannot carry their dead load";
    case CollapseStatus::unbounded:
        // Whether that is proved for Coulomb's law is in the log, which is quoted above.
        return flowRule == FlowRule::nonAssociative
                   ? "unbounded: some forces carry any multiple of the live load, and no collapse by "
                     "Coulomb's law was found with others"
                   : "unbounded: no load of this direction makes it collapse";
    case CollapseStatus::upperBound:
        return "no collapse by Coulomb's law was found: alpha is no larger in size than that of the "
               "associative "
               "law, which may be infinite, as the log says";
    case CollapseStatus::notConverged:
        break;
    }
    return "no answer";
}

/// Of a moving load the answer is that of its worst position. The table of all positions has their
/// multipliers: none are known where it has others than the case has now.
template<int Dim>
void moveToWorstPosition(LimitAnalysisCase<Dim>& structure, const fs::path& caseDirectory)
{
    const NumberTable table =
        readNumberTable(limitAnalysisTable(caseDirectory).replace_filename("movingLoad.dat"));
    constexpr std::size_t ofAlpha = Dim + 2; // distance, place, block, alpha, status
    if (table.columns.size() != ofAlpha + 2
        || table.columns[ofAlpha].size() != structure.loads.positions.size())
    {
        return;
    }
    for (std::size_t row = 0; row < table.columns[ofAlpha].size(); ++row)
    {
        structure.envelope.push_back(
            {storedStatus(table.columns[ofAlpha + 1][row]).value_or(CollapseStatus::notConverged),
             table.columns[ofAlpha][row]});
    }
    if (const std::optional<EnvelopePoint> worst = worstPlace(structure))
    {
        structure.loads.live = structure.loads.positions[worst->position].live;
    }
}

/// What the forces at a joint obey: `without tension and with friction`, or with the strengths of the case.
std::string lawOfJoints(const ContactProperties& contact)
{
    const auto isAny = [&](std::optional<JointStrength> ContactProperties::*ofAll,
                           std::optional<JointStrength> JointProperties::*ofOne)
    {
        return contact.*ofAll
               || std::any_of(contact.joints.begin(), contact.joints.end(),
                              [&](const auto& joint) { return (joint.second.*ofOne).has_value(); });
    };
    const bool hasTension = isAny(&ContactProperties::tension, &JointProperties::tension);
    std::string law =
        hasTension ? "with tension up to a strength, friction" : "without tension and with friction";
    const bool hasCohesion = isAny(&ContactProperties::cohesion, &JointProperties::cohesion);
    law += hasCohesion ? hasTension ? ", cohesion" : " and cohesion" : "";
    const bool hasCrushing = isAny(&ContactProperties::crushing, &JointProperties::crushing);
    law += hasCrushing ? ", and pressure up to a strength" : "";
    return law;
}

/// What alpha is.
template<int Dim>
std::string meaningOfAlpha(const LimitAnalysisCase<Dim>& structure)
{
    const std::string law = lawOfJoints(structure.contact);
    if (structure.movement)
    {
        return fmt::format(
            "Support {} moves, and there is no live load: alpha is the least reaction [N] of the support "
            "against its own movement: positive where it gives way to the structure, negative where it has "
            "to push. Forces between the blocks balance the loads {}, and a mechanism in which the support "
            "moves shows that the reaction is not less (Portioli and Cascini 2016).",
            structure.assembly.supports[static_cast<std::size_t>(structure.movement->support)].name, law);
    }
    if (flowRuleOf(structure.contact) == FlowRule::nonAssociative)
    {
        return fmt::format(
            "Under the live load times the multiplier alpha the structure may collapse by Coulomb's law: "
            "forces between the blocks balance it {}, and blocks slide without opening in a mechanism of "
            "these forces. Such a pair is not unique, and alpha is the lowest that a search has met. Forces "
            "alone may balance more, up to the multiplier of the associative law.",
            law);
    }
    return fmt::format(
        "The live load times the multiplier alpha is the largest that the structure carries: forces "
        "between the blocks balance it {}, and a mechanism shows that more cannot be carried "
        "(Portioli, Cascini and Landolfo 2017, eq. 10).",
        law);
}

void addIfAny(HtmlPage& page, const std::string& sentence)
{
    if (!sentence.empty())
    {
        page.paragraph(sentence);
    }
}

/// The certificate of each answer. \param table that of limitAnalysis, with all of its columns
void addCertificates(HtmlPage& page, const NumberTable& table)
{
    std::vector<std::vector<std::string>> rows;
    for (std::size_t row = 0; row < table.columns.front().size(); ++row)
    {
        const auto value = [&](std::size_t column)
        { return fmt::format("{:.3g}", table.columns[column][row]); };
        rows.push_back({fmt::format("{:.9g}", table.columns[0][row]), value(6), value(7), value(8),
                        fmt::format("{:g}", table.columns[5][row]), value(9) + " s"});
    }
    page.paragraph("Certificate: the residual of equilibrium and of the cones, that of the mechanism, and "
                   "the gap between the bounds that they give, each relative.");
    page.table({"alpha", "primal residual", "dual residual", "gap", "iterations", "CPU time"}, rows);
}

} // namespace

std::optional<CollapseStatus> storedStatus(double number)
{
    for (const CollapseStatus status :
         {CollapseStatus::optimal, CollapseStatus::unstable, CollapseStatus::unbounded,
          CollapseStatus::notConverged, CollapseStatus::upperBound})
    {
        if (number == static_cast<double>(status))
        {
            return status;
        }
    }
    return std::nullopt;
}

template<int Dim>
void addCollapse(HtmlPage& page, const fs::path& caseDirectory, InputOfResults input)
{
    const NumberTable table = readNumberTable(limitAnalysisTable(caseDirectory));
    if (table.columns.size() < 10)
    {
        return;
    }
    page.heading("Collapse");
    LimitAnalysisCase<Dim> structure = readLimitAnalysisCase<Dim>(caseDirectory);
    moveToWorstPosition(structure, caseDirectory);
    const std::vector<LimitAnalysis> answers = storedAnswers(page, caseDirectory, table);
    const bool hasMultiplier = std::any_of(answers.begin(), answers.end(), isMultiplier);
    if (hasMultiplier)
    {
        page.paragraph(meaningOfAlpha(structure));
    }
    const FlowRule flowRule = flowRuleOf(structure.contact);
    if (flowRule == FlowRule::nonAssociative)
    {
        for (const std::string& sentence : searchInLog(caseDirectory))
        {
            page.paragraph(sentence);
        }
        for (const std::string& sentence : searchesCutShort(caseDirectory, answers))
        {
            page.paragraph(sentence);
        }
    }
    for (const LimitAnalysis& answer : answers)
    {
        page.paragraph((answer.combination.empty() ? "" : "Combination " + answer.combination + ": ")
                       + verdict(answer, flowRule) + ".");
        if (answer.status == CollapseStatus::unstable && input == InputOfResults::same)
        {
            addIfAny(page, instabilityCause(structure.assembly, structure.points));
        }
        if ((isMultiplier(answer) || structure.loads.positions.empty()) && input == InputOfResults::same)
        {
            for (const std::string& sentence : loadMeaning(structure, answer))
            {
                page.paragraph(sentence + ".");
            }
        }
    }
    if (input == InputOfResults::same)
    {
        for (const std::string& sentence : envelopeMeaning(structure))
        {
            page.paragraph(sentence + ".");
        }
    }
    addIfAny(page, missingForceText(structure.assembly, structure.points));
    addCertificates(page, table);
}

template void addCollapse<2>(HtmlPage& page, const fs::path& caseDirectory, InputOfResults input);
template void addCollapse<3>(HtmlPage& page, const fs::path& caseDirectory, InputOfResults input);

} // namespace drystone
