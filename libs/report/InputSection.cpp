// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The dictionaries of a case and what describes their keys.
#include "report/ReportSections.h"

#include "assembly/Loads.h"
#include "assembly/Materials.h"
#include "dynamics/InitialMotion.h"
#include "effects/EffectList.h"
#include "effects/GroundMotion.h"
#include "effects/SupportMotion.h"
#include "functionObjects/FunctionList.h"
#include "report/InputTable.h"
#include "runControl/Schemes.h"
#include "statics/LimitAnalysisCase.h"
#include "texture/Texture.h"

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

/// A dictionary of the case and what describes it.
struct Input
{
    std::string file;
    std::vector<OptionDescription> options;
};

OptionDescription subDictionary(const std::string& key, std::vector<OptionDescription> members)
{
    OptionDescription option;
    option.key = key;
    option.form = OptionDescription::Form::dictionary;
    option.members = std::move(members);
    return option;
}

template<int Dim>
std::vector<Input> inputsOf()
{
    return {{"constant/g", describeOptions<Gravity<Dim>>()},
            {"constant/materialProperties", describeOptions<MaterialProperties>()},
            {"constant/contactProperties", describeOptions<CaseEffects<Dim>>()},
            {"constant/loads", describeOptions<LoadCases<Dim>>()},
            {"constant/groundMotion", describeOptions<GroundMotionSettings>()},
            {"constant/supportMotion", describeOptions<SupportMotionFile<Dim>>()},
            {"0/motion", describeOptions<InitialMotion<Dim>>()},
            {"system/controlDict", describeOptions<ControlDictSettings>()},
            {"system/schemes", describeOptions<Schemes>()},
            {"system/solution",
             {subDictionary("limitAnalysis", describeOptions<LimitAnalysisControls>()),
              subDictionary("contactDynamics", describeOptions<SolverChoice>())}},
            {"system/blockTextureDict", describeOptions<BlockTexture<Dim>>()},
            // Of studies, whose keys this library does not know: without units.
            {"system/incrementalDynamicsDict", {}},
            {"system/parameterSearchDict", {}},
            {"system/ensembleDict", {}},
            {"system/accuracyCostDict", {}}};
}

} // namespace

template<int Dim>
void addInputs(HtmlPage& page, const fs::path& caseDirectory)
{
    page.heading("Input");
    for (const Input& input : inputsOf<Dim>())
    {
        std::error_code none;
        if (!fs::exists(caseDirectory / input.file, none))
        {
            continue;
        }
        page.paragraph(input.file);
        page.table({"key", "value", "unit", "what it is"},
                   inputRows(Dictionary::readFile(caseDirectory / input.file), input.options));
    }
}

template void addInputs<2>(HtmlPage& page, const fs::path& caseDirectory);
template void addInputs<3>(HtmlPage& page, const fs::path& caseDirectory);

} // namespace drystone
