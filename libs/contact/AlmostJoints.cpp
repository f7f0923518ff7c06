// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What is said of faces that almost meet; the search for them is in plane/ and space/.
#include "contact/AlmostJoints.h"

#include "assembly/AssemblyFile.h"
#include "contact/JointClosure.h"
#include "contact/space/StatedJointChecks.h"
#include "geometry/PointText.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace drystone
{

namespace
{

/// What faces each other: a piece of an edge, a patch of a face.
template<int Dim>
using Facing = std::conditional_t<Dim == 2, FacingPiece, FacingPatch>;

/// Whether the faces are where the user, or the digits of a file, say that blocks are apart.
template<int Dim>
bool isApartByTolerance(const Facing<Dim>& piece, const Assembly<Dim>& assembly)
{
    return assembly.jointTolerance && isApart(piece) && openness(piece) > *assembly.jointTolerance;
}

/// Faces that almost meet, the farthest from meeting first.
template<int Dim>
struct AlmostMeeting
{
    std::vector<Facing<Dim>> atFault;
    std::vector<Facing<Dim>> apart; ///< by Assembly::jointTolerance
};

template<int Dim>
AlmostMeeting<Dim> findAlmostMeeting(const Assembly<Dim>& assembly)
{
    std::vector<Facing<Dim>> pieces = findAlmostJoints(assembly);
    std::stable_sort(pieces.begin(), pieces.end(),
                     [](const Facing<Dim>& a, const Facing<Dim>& b) { return openness(a) > openness(b); });
    const auto apart = std::stable_partition(pieces.begin(), pieces.end(),
                                             [&](const Facing<Dim>& piece)
                                             { return !isApartByTolerance<Dim>(piece, assembly); });
    return {{pieces.begin(), apart}, {apart, pieces.end()}};
}

/// One digit, and more than the faces need. \param most of what faces are apart [m]
double closingTolerance(double most)
{
    const double unit = std::pow(10.0, std::floor(std::log10(most)));
    return std::ceil(1.01 * most / unit) * unit;
}

/// \param pieces one or more at fault
template<int Dim>
std::string faultText(const Assembly<Dim>& assembly, const std::vector<Facing<Dim>>& pieces)
{
    const Facing<Dim>& worst = pieces.front();
    const double most = openness(worst);
    std::string text =
        fmt::format("{} and {} almost meet: at {} their faces are {:.3g} m {}, where joints are closed up to "
                    "{:.3g} m.{} Without these joints the answer would be that of another "
                    "structure.\n\nCorrect the coordinates in system/blockTextureDict",
                    blockName(assembly, worst.block), blockName(assembly, worst.neighbour),
                    asWritten<Dim>(placeOf(worst)), most, isApart(worst) ? "apart" : "in each other",
                    worst.isOblique ? usualObliqueTolerance(assembly) : usualToleranceAlongAxes(assembly),
                    pieces.size() > 1 ? fmt::format(" {} pairs of faces do so.", pieces.size()) : "");
    if (!assembly.jointTolerance)
    {
        text += fmt::format(", or state there `jointTolerance {:g};` [m]: what is nearer is closed, what is "
                            "farther apart is so on purpose",
                            closingTolerance(most));
    }
    return text + ". Then run blockTexture again; checkBlocks lists such faces.";
}

/// \param pieces one or more that the digits of an imported file keep apart
template<int Dim>
std::string apartByDigitsText(const Assembly<Dim>& assembly, const std::vector<Facing<Dim>>& pieces)
{
    const Facing<Dim>& worst = pieces.front();
    return fmt::format(
        "{} and {} almost meet: at {} their faces are {:.3g} m apart, where joints of this file "
        "are closed up to {:.3g} m, as its coordinates are rounded.{} Without these joints the "
        "answer is that of another structure.\n\nWhere blocks are to touch, state "
        "`jointTolerance {:g};` [m] in system/blockTextureDict; where they are apart on purpose, "
        "`jointTolerance {:g};`. Then run blockTexture again; checkBlocks lists such faces.",
        blockName(assembly, worst.block), blockName(assembly, worst.neighbour),
        asWritten<Dim>(placeOf(worst)), openness(worst), *assembly.jointTolerance,
        pieces.size() > 1 ? fmt::format(" {} pairs of faces do so.", pieces.size()) : "",
        closingTolerance(openness(worst)), *assembly.jointTolerance);
}

} // namespace

template<int Dim>
std::string blockName(const Assembly<Dim>& assembly, int block)
{
    const int support = assembly.blocks[block].support;
    return support < 0 ? fmt::format("block {}", block)
                       : fmt::format("block {} (support {})", block, assembly.supports[support].name);
}

template<int Dim>
std::string almostJointsText(const Assembly<Dim>& assembly, ToleranceOrigin tolerance)
{
    if constexpr (Dim == 3)
    {
        if (!assembly.statedJoints.empty())
        {
            return misplacedJointsText(assembly);
        }
    }
    const AlmostMeeting<Dim> faces = findAlmostMeeting(assembly);
    if (!faces.atFault.empty())
    {
        return faultText<Dim>(assembly, faces.atFault);
    }
    const bool areNamed = tolerance == ToleranceOrigin::ofDigits && !faces.apart.empty();
    return areNamed ? apartByDigitsText<Dim>(assembly, faces.apart) : "";
}

namespace
{

/// The second block of the joint at fault.
template<int Dim>
std::size_t secondAtFault(const Assembly<Dim>& assembly)
{
    if constexpr (Dim == 3)
    {
        if (!assembly.statedJoints.empty())
        {
            const int joint = misplacedJoints(assembly).front().joint;
            return static_cast<std::size_t>(assembly.statedJoints[static_cast<std::size_t>(joint)].neighbour);
        }
    }
    return static_cast<std::size_t>(findAlmostMeeting(assembly).atFault.front().neighbour);
}

} // namespace

template<int Dim>
void refuseAlmostJoints(const Assembly<Dim>& assembly, const std::filesystem::path& caseDirectory)
{
    if (const std::string text = almostJointsText(assembly); !text.empty())
    {
        throw FatalIOError(text, blockPlaces<Dim>(caseDirectory)[secondAtFault(assembly)]);
    }
}

template<int Dim>
int facesApartOnPurpose(const Assembly<Dim>& assembly)
{
    return assembly.jointTolerance ? static_cast<int>(findAlmostMeeting(assembly).apart.size()) : 0;
}

template std::string blockName(const Assembly<2>& assembly, int block);
template std::string almostJointsText(const Assembly<2>& assembly, ToleranceOrigin tolerance);
template void refuseAlmostJoints(const Assembly<2>& assembly, const std::filesystem::path& caseDirectory);
template int facesApartOnPurpose(const Assembly<2>& assembly);
template std::string blockName(const Assembly<3>& assembly, int block);
template std::string almostJointsText(const Assembly<3>& assembly, ToleranceOrigin tolerance);
template void refuseAlmostJoints(const Assembly<3>& assembly, const std::filesystem::path& caseDirectory);
template int facesApartOnPurpose(const Assembly<3>& assembly);

} // namespace drystone
