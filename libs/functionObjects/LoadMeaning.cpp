// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Resultants of dead and live loads in words, with the multiplier as a force.
#include "functionObjects/LoadMeaning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

template<int Dim>
const LoadVectors& loadsOf(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result)
{
    const auto named =
        std::find_if(structure.combinations.begin(), structure.combinations.end(),
                     [&](const auto& combination) { return combination.first == result.combination; });
    return named == structure.combinations.end() ? structure.loads : named->second;
}

namespace
{

template<int Dim>
std::string directionText(const Vector<Dim>& force)
{
    std::string text = "(";
    for (int row = 0; row < Dim; ++row)
    {
        // Rounding leaves no -0 and no 1e-17.
        const double component = std::round(1e4 * force(row) / force.norm()) / 1e4;
        text += fmt::format("{}{:g}", row == 0 ? "" : " ", component == 0 ? 0 : component);
    }
    return text + ")";
}

} // namespace

std::string forceText(double force)
{
    const double size = std::abs(force);
    if (size >= 1e6)
    {
        return fmt::format("{:.4g} MN", force / 1e6);
    }
    return size >= 1e3 ? fmt::format("{:.4g} kN", force / 1e3) : fmt::format("{:.4g} N", force);
}

template<int Dim>
Vector<Dim> resultantOf(const Eigen::VectorXd& load)
{
    Vector<Dim> resultant = Vector<Dim>::Zero();
    for (Eigen::Index row = 0; row < load.size(); row += freedomCount<Dim>)
    {
        resultant += load.segment<Dim>(row);
    }
    return resultant;
}

namespace
{

/// Of forces that cancel, rounding leaves a little.
template<int Dim>
bool cancels(const Vector<Dim>& resultant, const Eigen::VectorXd& load)
{
    return resultant.norm() <= 1e-9 * load.lpNorm<1>();
}

} // namespace

template<int Dim>
std::vector<std::string> loadMeaning(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result)
{
    const LoadVectors& loads = loadsOf(structure, result);
    const Vector<Dim> dead = resultantOf<Dim>(loads.dead);
    std::vector<std::string> sentences{
        fmt::format("Dead load: {} along {}", forceText(dead.norm()), directionText<Dim>(dead))};
    if (dead.norm() == 0)
    {
        sentences.front() = "Dead load: no resultant force";
    }
    const bool isKnown = result.status == CollapseStatus::optimal;
    if (structure.movement)
    {
        if (isKnown && dead.norm() > 0)
        {
            sentences.push_back(fmt::format(
                "The support {} {}{}, {:.4g} of the dead load", result.alpha < 0 ? "presses with" : "bears",
                forceText(std::abs(result.alpha)), result.alpha < 0 ? " along its movement" : "",
                std::abs(result.alpha) / dead.norm()));
        }
        return sentences;
    }
    const Vector<Dim> live = resultantOf<Dim>(loads.live);
    if (cancels<Dim>(live, loads.live))
    {
        sentences.emplace_back("Live load: its forces cancel, there is no resultant");
        return sentences;
    }
    std::string sentence =
        fmt::format("Live load: {} along {}", forceText(live.norm()), directionText<Dim>(live));
    if (!isKnown)
    {
        sentences.push_back(std::move(sentence));
        return sentences;
    }
    const Vector<Dim> atCollapse = result.alpha * live;
    sentence += fmt::format("; at collapse {}", forceText(atCollapse.norm()));
    if (result.alpha < 0)
    {
        sentence += " against that";
    }
    if (dead.norm() > 0)
    {
        sentence += fmt::format(", {:.4g} of the dead load", atCollapse.norm() / dead.norm());
    }
    sentences.push_back(std::move(sentence));
    return sentences;
}

template<int Dim>
std::vector<std::string> caseMeaning(const LoadVectors& loads)
{
    std::vector<std::string> sentences;
    for (const auto& [name, load] : loads.cases)
    {
        const Vector<Dim> force = resultantOf<Dim>(load);
        sentences.push_back(load.isZero(0) ? fmt::format("Load case {}: no force on any block", name)
                            : cancels<Dim>(force, load)
                                ? fmt::format("Load case {}: its forces cancel, there is no resultant", name)
                                : fmt::format("Load case {}: {} along {}", name, forceText(force.norm()),
                                              directionText<Dim>(force)));
    }
    return sentences;
}

template<int Dim>
std::optional<LoadArrow> loadArrow(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result)
{
    LoadArrow arrow;
    if (structure.movement)
    {
        arrow.direction.template head<Dim>() = structure.movement->direction;
        arrow.label = "movement of the support";
        return arrow;
    }
    const LoadVectors& loads = loadsOf(structure, result);
    const Vector<Dim> live = resultantOf<Dim>(loads.live);
    if (cancels<Dim>(live, loads.live))
    {
        return std::nullopt;
    }
    const bool isKnown = result.status == CollapseStatus::optimal;
    arrow.direction.template head<Dim>() = isKnown && result.alpha < 0 ? -live : live;
    arrow.label =
        isKnown ? fmt::format("live load {}", forceText(std::abs(result.alpha) * live.norm())) : "live load";
    return arrow;
}

template Vector<2> resultantOf<2>(const Eigen::VectorXd& load);
template std::optional<LoadArrow> loadArrow<2>(const LimitAnalysisCase<2>& structure,
                                               const LimitAnalysis& result);
template std::optional<LoadArrow> loadArrow<3>(const LimitAnalysisCase<3>& structure,
                                               const LimitAnalysis& result);
template std::vector<std::string> caseMeaning<2>(const LoadVectors& loads);
template std::vector<std::string> caseMeaning<3>(const LoadVectors& loads);
template Vector<3> resultantOf<3>(const Eigen::VectorXd& load);
template std::vector<std::string> loadMeaning(const LimitAnalysisCase<2>& structure,
                                              const LimitAnalysis& result);
template std::vector<std::string> loadMeaning(const LimitAnalysisCase<3>& structure,
                                              const LimitAnalysis& result);

template const LoadVectors& loadsOf(const LimitAnalysisCase<2>& structure, const LimitAnalysis& result);
template const LoadVectors& loadsOf(const LimitAnalysisCase<3>& structure, const LimitAnalysis& result);

} // namespace drystone
