// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Loads on the blocks: the vectors f of the equilibrium A0 c = f.
#pragma once

#include "assembly/BlockSurface.h"
#include "assembly/MovingLoad.h"
#include "dictionary/EntryLocations.h"
#include "dictionary/Options.h"
#include "dictionary/Registry.h"

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace drystone
{

/// Which multipliers of the live load are requested.
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

/// Forces at points of the free blocks. As blocks move the forces keep their sizes and directions, and stay
/// at their points of the blocks (TurnedLoad.h): all that is to be known of the points are the first moments.
struct Load
{
    Eigen::VectorXd rows; ///< as LoadVectors, with the blocks as built
    /// S = sum a f' of each free block [N m], a from its mass centre to the point of the force f: Dim rows,
    /// Dim columns a block. Empty: all forces are at mass centres.
    Eigen::MatrixXd firstMoments = {};
};

/// Rows of a load vector: freedomCount<Dim> for each free block, forces [N], then moments [N m] about its
/// centroid (ux uy rz; ux uy uz rx ry rz), in the order of the free blocks (see freeIndices).
struct LoadVectors
{
    Eigen::VectorXd dead; ///< acts in full
    Eigen::VectorXd live; ///< acts times the load multiplier alpha; size 0 where the case has no live load
    Multiplier multiplier = Multiplier::positive;
    /// What the case names under `cases`, each in full, whether a load has it or not.
    std::vector<std::pair<std::string, Eigen::VectorXd>> cases = {};
    Eigen::MatrixXd firstMomentsOfDead = {}; ///< see Load
    Eigen::MatrixXd firstMomentsOfLive = {};
};

/// A support that moves instead of a live load that grows.
template<int Dim>
struct SupportMovement
{
    int support = -1;                                    ///< index into Assembly::supports
    Vector<Dim> direction = -Vector<Dim>::Unit(Dim - 1); ///< unit vector
};

/// The loads of a case.
template<int Dim>
struct CaseLoads : LoadVectors
{
    std::optional<SupportMovement<Dim>> movement = {}; ///< instead of `live`
    std::vector<LoadPosition<Dim>> positions = {};     ///< of a moving load; `live` is that of the first
    /// Of a moving load: distances along its path at which no axle meets a free block [m]
    std::vector<double> placesLeftOut = {};
    EntryLocations locations = {}; ///< of the entries of constant/loads, for messages
};

/// Weight of the free blocks. \param masses of all blocks [kg] \param gravity [m/s2]
template<int Dim>
Eigen::VectorXd gravityLoad(const Assembly<Dim>& assembly, const std::vector<double>& masses,
                            const std::type_identity_t<Vector<Dim>>& gravity);

/// Each free block's own weight, mass times |gravity|, turned into `direction`, a vector of any length but 0.
template<int Dim>
Eigen::VectorXd inertialLoad(const Assembly<Dim>& assembly, const std::vector<double>& masses,
                             const std::type_identity_t<Vector<Dim>>& gravity,
                             const std::type_identity_t<Vector<Dim>>& direction);

/// The free blocks that may be meant by a force at a point.
struct LoadedBlocks
{
    std::vector<int>
        blocks;          ///< by index; several where the point lies on a joint, none where no block is near
    double distance = 0; ///< of the nearest from the point [m]; 0: the point is in it or on it
};

/// The free blocks that may be meant by a force at `point`: those that hold it or come as near as the
/// nearest, to the width of a joint, and within `tolerance` [m]. None where the point lies in a fixed block:
/// the force would be lost in it.
template<int Dim>
LoadedBlocks findLoadedBlocks(const Assembly<Dim>& assembly, const std::type_identity_t<Vector<Dim>>& point,
                              double tolerance);

/// A force [N] at a point [m] of a free block.
template<int Dim>
Load pointLoad(const Assembly<Dim>& assembly, int block, const std::type_identity_t<Vector<Dim>>& point,
               const std::type_identity_t<Vector<Dim>>& force);

/// A piece of a straight line, and what it lies on.
template<int Dim>
struct LinePiece
{
    Vector<Dim> middle = Vector<Dim>::Zero(); ///< [m]
    double length = 0;                        ///< [m]
    LoadedBlocks on;                          ///< see findLoadedBlocks
};

/// A straight line, cut where it may pass from one free block to another.
template<int Dim>
std::vector<LinePiece<Dim>> piecesOfLine(const Assembly<Dim>& assembly,
                                         const std::type_identity_t<Vector<Dim>>& from,
                                         const std::type_identity_t<Vector<Dim>>& to, double tolerance);

/// A sum of loads, rows as LoadVectors, in which what cancels but for rounding is zero: left in, it would be
/// a load with a multiplier of its own.
template<int Dim>
class SumOfLoads
{
public:
    explicit SumOfLoads(const Assembly<Dim>& structure) : assembly(structure) {}
    void add(const Load& load, double factor = 1);
    Load sum() const;

private:
    const Assembly<Dim>& assembly;
    Eigen::VectorXd total;
    Eigen::VectorXd sizes; ///< of all that was added, by row
    Eigen::MatrixXd firstMoments;
};

/// What is left by rounding where loads cancel, as a part of the sizes of all that was added.
inline constexpr double roundingOfLoads = 1e-12;

/// What a load is made from.
template<int Dim>
struct LoadContext
{
    const Assembly<Dim>& assembly;
    const std::vector<double>& masses; ///< of all blocks [kg]
    Vector<Dim> gravity;               ///< [m/s2]
    /// The parts of faces that others lie on, for loads on faces (contact/CoveredSurface.h); empty: none
    std::function<std::vector<SurfacePiece<Dim>>()> coveredSurface = {};
    std::vector<std::pair<std::string, Load>> cases = {}; ///< see LoadVectors
};

/// Points of different blocks that are this near are one [m].
template<int Dim>
double widthOfAJoint(const Assembly<Dim>& assembly);

/// Makes a load, once blocks and masses are known. \throws FatalIOError when the load does not suit
/// the structure
template<int Dim>
using LoadMaker = std::function<Load(const LoadContext<Dim>&)>;

/// The loads that `dead { type ...; }` and `live { type ...; }` choose from.
template<int Dim>
const Registry<LoadMaker<Dim>>& loadTypes();

/// Loads that act at one time.
template<int Dim>
struct LoadCombination
{
    LoadMaker<Dim> dead;
    LoadMaker<Dim> live;
    Multiplier multiplier = Multiplier::positive;
};

template<int Dim>
void declare(Options& options, LoadCombination<Dim>& combination);

/// constant/loads: dead and live load, or several combinations of them.
template<int Dim>
struct LoadCases
{
    std::vector<Named<LoadMaker<Dim>>> cases; ///< that `type combined;` refers to
    LoadMaker<Dim> dead;                      ///< empty where there are combinations
    std::optional<LoadMaker<Dim>> live;
    Multiplier multiplier = Multiplier::positive;
    std::vector<Named<LoadCombination<Dim>>> combinations;
};

template<int Dim>
void declare(Options& options, LoadCases<Dim>& cases);

/// Whether a computation can do without a live load.
enum class LiveLoad
{
    required,
    optional
};

/// The load vectors of a case. Where a live load is optional, a case without constant/loads has gravity
/// alone. \throws FatalError or FatalIOError when constant/loads is missing or faulty, or does not suit the
/// structure
template<int Dim>
CaseLoads<Dim> readLoads(const std::filesystem::path& caseDirectory, const LoadContext<Dim>& context,
                         LiveLoad liveLoad);

/// The load vectors of each of the `combinations` of constant/loads, by name; live loads are required. None
/// where the case has dead and live load instead. \throws as readLoads
template<int Dim>
std::vector<std::pair<std::string, LoadVectors>>
readLoadCombinations(const std::filesystem::path& caseDirectory, const LoadContext<Dim>& context);

} // namespace drystone
