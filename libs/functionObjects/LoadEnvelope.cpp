// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The envelope of a moving load, and what the log says of it.
#include "functionObjects/LoadEnvelope.h"

#include "assembly/BlockShape.h"
#include "core/Log.h"
#include "quantities/LimitAnalysisFigures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace drystone
{
namespace
{

/// Moment r x f of the line of action through r -> the r nearest to the mass centre.
Vector<2> armOf(const Vector<2>& force, const Eigen::Matrix<double, 1, 1>& moment)
{
    return moment(0) / force.squaredNorm() * Vector<2>(force.y(), -force.x());
}
Vector<3> armOf(const Vector<3>& force, const Vector<3>& moment)
{
    return momentOf(force, moment) / force.squaredNorm();
}

/// Where the line of action of a load on one block alone enters it; nothing of other loads.
/// \param live rows as LoadVectors
template<int Dim>
std::vector<LoadPlace> placesOfLoad(const Assembly<Dim>& assembly, const Eigen::VectorXd& live)
{
    int loaded = -1;
    Eigen::Matrix<double, freedomCount<Dim>, 1> load;
    const std::vector<int> indices = freeIndices(assembly);
    for (std::size_t i = 0; i < assembly.blocks.size() && live.size() > 0; ++i)
    {
        if (indices[i] < 0 || live.segment<freedomCount<Dim>>(freedomCount<Dim> * indices[i]).isZero(0))
        {
            continue;
        }
        if (loaded >= 0)
        {
            return {};
        }
        loaded = static_cast<int>(i);
        load = live.segment<freedomCount<Dim>>(freedomCount<Dim> * indices[i]);
    }
    if (loaded < 0 || load.template head<Dim>().isZero(0))
    {
        return {};
    }
    const Block<Dim>& block = assembly.blocks[static_cast<std::size_t>(loaded)];
    const Vector<Dim> force = load.template head<Dim>();
    const Vector<Dim> line =
        blockMass<Dim>(block).centroid + armOf(force, load.template tail<freedomCount<Dim> - Dim>().eval());
    const Vector<Dim> along = force.normalized();
    double first = 0;
    for (const double place : placesToCut(block, line, along))
    {
        if (place < first
            && distanceFrom(block, Vector<Dim>(line + place * along)) <= widthOfAJoint(assembly))
        {
            first = place;
        }
    }
    LoadPlace place;
    place.place.template head<Dim>() = line + first * along;
    place.block = loaded;
    return {place};
}

} // namespace

template<int Dim>
std::vector<EnvelopePoint> envelopeOf(const LimitAnalysisCase<Dim>& structure)
{
    std::vector<EnvelopePoint> points;
    for (std::size_t i = 0; i < structure.envelope.size(); ++i)
    {
        const EnvelopePoint point{structure.loads.positions[i].distance, i,
                                  tabledAlpha(structure.envelope[i].status, structure.envelope[i].alpha)};
        if (points.empty() || points.back().distance != point.distance)
        {
            points.push_back(point);
        }
        else if (std::isnan(points.back().alpha) || point.alpha < points.back().alpha)
        {
            points.back() = point; // that of the other side of a joint may not be known
        }
    }
    return points;
}

template<int Dim>
std::optional<EnvelopePoint> worstPlace(const LimitAnalysisCase<Dim>& structure)
{
    constexpr double same = 1e-7; // as solveLimitAnalyses chooses
    std::optional<EnvelopePoint> worst;
    for (const EnvelopePoint& point : envelopeOf(structure))
    {
        if (std::isfinite(point.alpha) && (!worst || point.alpha < worst->alpha * (1 - same)))
        {
            worst = point;
        }
    }
    return worst;
}

template<int Dim>
std::string placeText(const LimitAnalysisCase<Dim>& structure, const EnvelopePoint& point)
{
    const Vector<Dim>& place = structure.loads.positions[point.position].place;
    return fmt::format("({:.4g})", fmt::join(place.data(), place.data() + Dim, " "));
}

template<int Dim>
std::string pathText(const LimitAnalysisCase<Dim>& structure, const EnvelopePoint& point)
{
    return fmt::format("{:.6g} m along the path, from {}", point.distance, placeText(structure, point));
}

template<int Dim>
std::vector<LoadPlace> loadPlaces(const LimitAnalysisCase<Dim>& structure, const LimitAnalysis& result)
{
    std::vector<LoadPlace> places;
    const std::optional<EnvelopePoint> worst = worstPlace(structure);
    if (!worst)
    {
        const bool isTurned = result.status == CollapseStatus::optimal && result.alpha < 0;
        return placesOfLoad(structure.assembly,
                            Eigen::VectorXd((isTurned ? -1 : 1) * liveLoadOf(structure, result)));
    }
    double largest = 0;
    for (const AxlePlace<Dim>& axle : structure.loads.positions[worst->position].axles)
    {
        LoadPlace place;
        place.place.template head<Dim>() = axle.place;
        place.block = axle.block;
        place.part = axle.factor;
        largest = std::max(largest, axle.factor);
        places.push_back(place);
    }
    for (LoadPlace& place : places)
    {
        place.part /= largest;
    }
    return places;
}

namespace
{

/// `0 to 0.3, 3.7 to 4`: neighbours along the path are put together. \param spacing of its places [m]
std::string rangesText(const std::vector<double>& distances, double spacing)
{
    std::vector<std::string> ranges;
    for (std::size_t i = 0; i < distances.size();)
    {
        std::size_t last = i;
        while (last + 1 < distances.size() && distances[last + 1] - distances[last] < 1.5 * spacing)
        {
            ++last;
        }
        ranges.push_back(i == last ? fmt::format("{:.6g}", distances[i])
                                   : fmt::format("{:.6g} to {:.6g}", distances[i], distances[last]));
        i = last + 1;
    }
    return fmt::format("{}", fmt::join(ranges, ", "));
}

/// The path may be longer than the structure, and may be so by mistake.
template<int Dim>
void printPlacesLeftOut(const CaseLoads<Dim>& loads)
{
    if (loads.placesLeftOut.empty())
    {
        return;
    }
    std::vector<double> all = loads.placesLeftOut;
    for (const LoadPosition<Dim>& position : loads.positions)
    {
        all.push_back(position.distance);
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    info("Places left out, where no axle meets a block that can move: {} of {}, {} m along the path ({})",
         loads.placesLeftOut.size(), all.size(), rangesText(loads.placesLeftOut, all[1] - all[0]),
         describe(loads.locations.of("live/from")));
}

/// Says where by Coulomb's law no collapse has been found: such a place may be worse than the worst of the
/// others.
template<int Dim>
void warnOfPlacesWithoutAnswer(const LimitAnalysisCase<Dim>& structure, std::size_t places)
{
    std::vector<double> distances;
    double bound = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < structure.envelope.size(); ++i)
    {
        if (structure.envelope[i].status == CollapseStatus::upperBound)
        {
            distances.push_back(structure.loads.positions[i].distance);
            bound = std::min(bound, structure.envelope[i].alpha);
        }
    }
    distances.erase(std::unique(distances.begin(), distances.end()), distances.end());
    if (distances.empty())
    {
        return;
    }
    const double length =
        structure.loads.positions.back().distance - structure.loads.positions.front().distance;
    printWarning(fmt::format(
        "At {} of these places, {} m along the path, no collapse by Coulomb's law was found{}: the worst "
        "place is "
        "that of the others. More starts in system/solution/limitAnalysis/nonAssociative may find one.",
        distances.size(),
        rangesText(distances, length / static_cast<double>(std::max<std::size_t>(2, places) - 1)),
        std::isfinite(bound) ? fmt::format(", where by the associative law alpha <= {:.6g}", bound) : ""));
}

/// How many places there are, and at how many of them no load makes the structure collapse.
std::string placesText(const std::vector<EnvelopePoint>& points)
{
    const auto carried = static_cast<std::size_t>(std::count_if(
        points.begin(), points.end(), [](const EnvelopePoint& point) { return std::isinf(point.alpha); }));
    return fmt::format("Moving load: {} places{}", points.size(),
                       carried == 0 ? ""
                       : carried == points.size()
                           ? ", at all of them no load makes the structure collapse"
                           : fmt::format(", at {} of them no load makes the structure collapse", carried));
}

template<int Dim>
std::string worstText(const LimitAnalysisCase<Dim>& structure, const EnvelopePoint& worst)
{
    std::vector<int> blocks = structure.loads.positions[worst.position].blocks;
    std::sort(blocks.begin(), blocks.end()); // two axles may spread over the same
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    return fmt::format("Worst place: {}, on {} {}", pathText(structure, worst),
                       blocks.size() > 1 ? "blocks" : "block", fmt::join(blocks, " "));
}

} // namespace

template<int Dim>
std::vector<std::string> envelopeMeaning(const LimitAnalysisCase<Dim>& structure)
{
    const std::vector<EnvelopePoint> points = envelopeOf(structure);
    if (points.empty())
    {
        return {};
    }
    std::vector<std::string> sentences{placesText(points)};
    if (const std::optional<EnvelopePoint> worst = worstPlace(structure))
    {
        sentences.push_back(worstText(structure, *worst));
    }
    return sentences;
}

template<int Dim>
void printEnvelope(const LimitAnalysisCase<Dim>& structure)
{
    const std::vector<EnvelopePoint> points = envelopeOf(structure);
    if (points.empty())
    {
        return;
    }
    const std::optional<EnvelopePoint> worst = worstPlace(structure);
    printLine(placesText(points));
    if (worst)
    {
        warnOfPlacesWithoutAnswer(structure, points.size());
    }
    printPlacesLeftOut(structure.loads);
    if (!worst)
    {
        return;
    }
    printLine(worstText(structure, *worst));
    const LoadPosition<Dim>& position = structure.loads.positions[worst->position];
    constexpr double worthSaying = 1e-6;
    if (position.beside > worthSaying)
    {
        info(
            "There {:.3g}% of the load meets no block that can move, and is left out: supports or the ground "
            "beside the structure carry it",
            100 * position.beside);
    }
}

template std::vector<EnvelopePoint> envelopeOf(const LimitAnalysisCase<2>& structure);
template std::vector<EnvelopePoint> envelopeOf(const LimitAnalysisCase<3>& structure);
template std::optional<EnvelopePoint> worstPlace(const LimitAnalysisCase<2>& structure);
template std::optional<EnvelopePoint> worstPlace(const LimitAnalysisCase<3>& structure);
template std::string placeText(const LimitAnalysisCase<2>& structure, const EnvelopePoint& point);
template std::string placeText(const LimitAnalysisCase<3>& structure, const EnvelopePoint& point);
template std::string pathText(const LimitAnalysisCase<2>& structure, const EnvelopePoint& point);
template std::string pathText(const LimitAnalysisCase<3>& structure, const EnvelopePoint& point);
template std::vector<std::string> envelopeMeaning(const LimitAnalysisCase<2>& structure);
template std::vector<std::string> envelopeMeaning(const LimitAnalysisCase<3>& structure);
template std::vector<LoadPlace> loadPlaces(const LimitAnalysisCase<2>& structure,
                                           const LimitAnalysis& result);
template std::vector<LoadPlace> loadPlaces(const LimitAnalysisCase<3>& structure,
                                           const LimitAnalysis& result);
template void printEnvelope(const LimitAnalysisCase<2>& structure);
template void printEnvelope(const LimitAnalysisCase<3>& structure);
} // namespace drystone
