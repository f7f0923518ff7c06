// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Loads on the blocks: the vectors f of the equilibrium A0 c = f.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Options.h"
#include "dictionary/Registry.h"

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace drystone
{

/// Which multipliers of the live load are asked for.
enum class Multiplier
{
    positive, ///< the largest that is carried
    negative, ///< the least that is carried: the live load reversed
    both      ///< the range between them
};

inline std::array<std::pair<std::string_view, Multiplier>, 3> namesOf(Multiplier)
{
    return {
        {{"positive", Multiplier::positive}, {"negative", Multiplier::negative}, {"both", Multiplier::both}}};
}

/// A support that moves instead of a live load that grows.
struct SupportMovement
{
    int support = -1;           ///< index into Assembly::supports
    Vector<2> direction{0, -1}; ///< unit vector
};

/// Rows of a load vector: 3 for each free block, ux uy [N] and rz [N m] about its centroid, in the order of
/// the free blocks (see freeIndices).
struct LoadVectors
{
    Eigen::VectorXd dead; ///< acts in full
    Eigen::VectorXd live; ///< acts times the load multiplier alpha; size 0 where the case has no live load
    std::optional<SupportMovement> movement = {}; ///< instead of `live`
    Multiplier multiplier = Multiplier::positive;
};

/// Weight of the free blocks. \param masses of all blocks [kg] \param gravity [m/s2]
Eigen::VectorXd gravityLoad(const Assembly<2>& assembly, const std::vector<double>& masses,
                            const Vector<2>& gravity);

/// Each free block's own weight, mass times |gravity|, turned into `direction`, a vector of any length but 0.
Eigen::VectorXd inertialLoad(const Assembly<2>& assembly, const std::vector<double>& masses,
                             const Vector<2>& gravity, const Vector<2>& direction);

/// The block that a force at `point` acts on: the free one that holds the point, or whose outline comes
/// nearest and within `tolerance` [m]; of several the one with the lowest index. Nothing when there is none.
std::optional<int> findLoadedBlock(const Assembly<2>& assembly, const Vector<2>& point, double tolerance);

/// All blocks that may be meant by a force at `point`, by index: those as near as the nearest, to the width
/// of a joint, `same` [m]. More than one where the point lies on a joint.
std::vector<int> findLoadedBlocks(const Assembly<2>& assembly, const Vector<2>& point, double tolerance,
                                  double same);

/// A force [N] at a point [m] of a free block.
Eigen::VectorXd pointLoad(const Assembly<2>& assembly, int block, const Vector<2>& point,
                          const Vector<2>& force);

/// A force per length [N/m] along a straight line, on the blocks that hold its pieces or lie within
/// `tolerance` [m] of them. Nothing where a piece has no free block.
std::optional<Eigen::VectorXd> lineLoad(const Assembly<2>& assembly, const Vector<2>& from,
                                        const Vector<2>& to, const Vector<2>& forcePerLength,
                                        double tolerance);

/// What a load is made from.
struct LoadContext
{
    const Assembly<2>& assembly;
    const std::vector<double>& masses; ///< of all blocks [kg]
    Vector<2> gravity;                 ///< [m/s2]
};

/// Makes a load vector, once blocks and masses are known. \throws FatalIOError when the load does not suit
/// the structure
using LoadMaker = std::function<Eigen::VectorXd(const LoadContext&)>;

/// The loads that `dead { type ...; }` and `live { type ...; }` choose from.
const Registry<LoadMaker>& loadTypes();

/// Loads that act at one time.
struct LoadCombination
{
    LoadMaker dead;
    LoadMaker live;
    Multiplier multiplier = Multiplier::positive;
};

void declare(Options& options, LoadCombination& combination);

/// constant/loads: dead and live load, or several combinations of them.
struct LoadCases
{
    LoadMaker dead; ///< empty where there are combinations
    std::optional<LoadMaker> live;
    Multiplier multiplier = Multiplier::positive;
    std::vector<Named<LoadCombination>> combinations;
};

void declare(Options& options, LoadCases& cases);

/// Whether a computation can do without a live load.
enum class LiveLoad
{
    required,
    optional
};

/// The load vectors of a case. Where a live load is optional, a case without constant/loads has gravity
/// alone. \throws FatalError or FatalIOError when constant/loads is missing or faulty, or does not suit the
/// structure
LoadVectors readLoads(const std::filesystem::path& caseDirectory, const LoadContext& context,
                      LiveLoad liveLoad);

/// The load vectors of each of the `combinations` of constant/loads, by name; live loads are required. None
/// where the case has dead and live load instead. \throws as readLoads
std::vector<std::pair<std::string, LoadVectors>>
readLoadCombinations(const std::filesystem::path& caseDirectory, const LoadContext& context);

} // namespace drystone
