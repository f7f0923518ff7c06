// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The search for faces that almost meet, and what is said of them.
#include "contact/AlmostJoints.h"

#include "assembly/AssemblyFile.h"
#include "assembly/Outlines.h"
#include "contact/Penetration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

/// Whether the faces are where the user says that blocks are apart.
bool isStated(const FacingPiece& piece, const Assembly<2>& assembly)
{
    return assembly.jointTolerance && isApart(piece) && openness(piece) > *assembly.jointTolerance;
}

/// The faces that are a fault, the farthest from meeting first.
std::vector<FacingPiece> faultyPieces(const Assembly<2>& assembly)
{
    std::vector<FacingPiece> pieces = findAlmostJoints(assembly);
    std::erase_if(pieces, [&](const FacingPiece& piece) { return isStated(piece, assembly); });
    std::stable_sort(pieces.begin(), pieces.end(),
                     [](const FacingPiece& a, const FacingPiece& b) { return openness(a) > openness(b); });
    return pieces;
}

std::string faultText(const Assembly<2>& assembly, const std::vector<FacingPiece>& pieces)
{
    const FacingPiece& worst = pieces.front();
    const double most = openness(worst);
    std::string text = fmt::format(
        "{} and {} almost meet: at ({:.6g} {:.6g}) their faces are {:.3g} m {}, where joints are closed up "
        "to "
        "{:.3g} m.{} Without these joints the answer would be that of another structure.\n\nCorrect the "
        "coordinates in system/blockTextureDict",
        blockName(assembly, worst.block), blockName(assembly, worst.neighbour), worst.from.x(),
        worst.from.y(), most, isApart(worst) ? "apart" : "in each other",
        std::max(assembly.closure.tolerance, CheckLimits{}.jointTolerance * meanBlockSize(assembly)),
        pieces.size() > 1 ? fmt::format(" {} pairs of faces do so.", pieces.size()) : "");
    // One digit more than the faces need.
    const double unit = std::pow(10.0, std::floor(std::log10(most)));
    if (!assembly.jointTolerance)
    {
        text += fmt::format(", or state there `jointTolerance {:g};` [m]: what is nearer is closed, what is "
                            "farther apart is so on purpose",
                            std::ceil(1.01 * most / unit) * unit);
    }
    return text + ". Then run blockTexture again; checkBlocks lists such faces.";
}

} // namespace

double openness(const FacingPiece& piece)
{
    return std::max(std::abs(piece.gapAtFrom), std::abs(piece.gapAtTo));
}

bool isApart(const FacingPiece& piece)
{
    return piece.gapAtFrom + piece.gapAtTo > 0;
}

std::vector<FacingPiece> findAlmostJoints(const Assembly<2>& assembly, const CheckLimits& limits)
{
    const double size = meanBlockSize(assembly);
    const double jointTolerance = limits.jointTolerance * size;
    FacingTolerance tolerance;
    tolerance.distance = limits.gap * size;
    tolerance.angle = limits.gapAngle;
    tolerance.straight = jointTolerance / 2;
    tolerance.leastLength = tolerance.distance;
    std::vector<FacingPiece> pieces = findFacingPieces(assembly, tolerance);
    std::erase_if(pieces,
                  [&](const FacingPiece& piece)
                  {
                      // Outer faces of thin blocks that lie on each other have passed each other, too.
                      return openness(piece) <= jointTolerance
                             || (!isApart(piece)
                                 && overlapDepth(assembly.blocks[piece.block].outline,
                                                 assembly.blocks[piece.neighbour].outline)
                                        <= jointTolerance / 2);
                  });
    return pieces;
}

std::string blockName(const Assembly<2>& assembly, int block)
{
    const int support = assembly.blocks[block].support;
    return support < 0 ? fmt::format("block {}", block)
                       : fmt::format("block {} (support {})", block, assembly.supports[support].name);
}

std::string almostJointsText(const Assembly<2>& assembly)
{
    const std::vector<FacingPiece> pieces = faultyPieces(assembly);
    return pieces.empty() ? "" : faultText(assembly, pieces);
}

void refuseAlmostJoints(const Assembly<2>& assembly, const std::filesystem::path& caseDirectory)
{
    const std::vector<FacingPiece> pieces = faultyPieces(assembly);
    if (!pieces.empty())
    {
        const Dictionary dictionary = Dictionary::readFile(assemblyFile(caseDirectory));
        throw FatalIOError(faultText(assembly, pieces),
                           dictionary.get<Outlines>("outlines").places[pieces.front().neighbour]);
    }
}

int facesApartOnPurpose(const Assembly<2>& assembly)
{
    if (!assembly.jointTolerance)
    {
        return 0;
    }
    const std::vector<FacingPiece> pieces = findAlmostJoints(assembly);
    return static_cast<int>(std::count_if(
        pieces.begin(), pieces.end(), [&](const FacingPiece& piece) { return isStated(piece, assembly); }));
}

} // namespace drystone
