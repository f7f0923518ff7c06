// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Hard cases of limit analysis. Each answer must bring a certificate of 1e-9.
#include "DisturbedAssembly.h"
#include "Suite.h"

#include "conic/Towers.h"
#include "statics/Structures.h"
#include "texture/Arch.h"

#include <fmt/format.h>

#include <random>

namespace drystone
{
namespace
{

std::string_view nameOf(CollapseStatus status)
{
    constexpr std::array<std::string_view, 4> names{"optimal", "unstable", "unbounded", "notConverged"};
    return names[static_cast<std::size_t>(status)];
}

/// Solves, and says what is wrong: another status, or a certificate that proves nothing.
LimitAnalysis solved(const PlaneConeProgram& program, CollapseStatus expected, Outcome& outcome)
{
    const LimitAnalysis result = solveLimitAnalysis(program);
    if (result.status != expected)
    {
        outcome.broken = fmt::format("status {} where {} is right", nameOf(result.status), nameOf(expected));
    }
    else if (!(result.certificate.worst() <= 1e-9))
    {
        outcome.broken = fmt::format("certificate {:.1e}", result.certificate.worst());
    }
    return result;
}

/// Relative error of a multiplier; absolute below 1e-6.
void compareMultiplier(const PlaneConeProgram& program, double exact, Outcome& outcome)
{
    const LimitAnalysis result = solved(program, CollapseStatus::optimal, outcome);
    worsen(outcome, std::abs(result.alpha - exact) / std::max(exact, 1e-6));
}

/// A tower against its closed form, in the plane and in space.
Outcome towerOutcome(Tower tower)
{
    Outcome outcome;
    compareMultiplier(planeLimitAnalysis(tower), towerMultiplier(tower, 2), outcome);
    tower.push = {0.8, 0.6};
    const SpaceConeProgram space = spaceLimitAnalysis(tower);
    const ConeSolution solution = solveInteriorPoint(space);
    if (solution.status != SolveStatus::optimal)
    {
        outcome.broken += fmt::format(" in space: {}", nameOf(solution.status));
    }
    const double exact = towerMultiplier(tower, 3);
    worsen(outcome, std::abs(solution.multiplier - exact) / std::max(exact, 1e-6));
    return outcome;
}

/// Boxes of the given heights, 1 wide and deep, of a density of 1.
Tower towerOfHeights(const std::vector<double>& heights, double mu)
{
    Tower tower;
    tower.mu = mu;
    double top = 0;
    for (const double height : heights)
    {
        tower.boxes.push_back({{0, 0, top + height / 2}, {0.5, 0.5, height / 2}, height});
        top += height;
    }
    return tower;
}

/// Least thickness at which a semicircular arch of 27 voussoirs stands, by bisection to 1e-6. What is neither
/// proved to stand nor to fall counts as falling.
template<class Change>
double leastThickness(const Change& change)
{
    double falls = 0.10;
    double stands = 0.12;
    while (stands - falls > 1e-6)
    {
        Arch arch;
        arch.thickness = (falls + stands) / 2;
        const WeighedStructure structure(change(makeAssembly(arch)));
        const LimitAnalysis result = solveLimitAnalysis(structure.program(10, structure.weightLoads()));
        (result.status == CollapseStatus::optimal ? stands : falls) = arch.thickness;
    }
    return stands;
}

Outcome criticalArch()
{
    const auto same = [](Assembly<2> arch) { return arch; };
    const auto noisy = [](Assembly<2> arch) { return disturbed(std::move(arch), 1e-15); };
    const double plain = leastThickness(same);
    Outcome outcome{std::abs(plain - 0.106721)};
    worsen(outcome, std::abs(leastThickness(noisy) - plain));
    worsen(outcome, std::abs(leastThickness(mirrored) - plain));
    return outcome;
}

/// Of wall 1 with another unit of length and of force.
Outcome scaledWall(double lengths, double forces)
{
    const auto multiplier = [](const WeighedStructure& structure, double unit, Outcome& outcome)
    {
        return solved(structure.program(0.65, structure.weightLoads(unit)), CollapseStatus::optimal, outcome)
            .alpha;
    };
    Outcome outcome;
    RunningBond bond = paperWalls()[0].bond;
    const double reference = multiplier(standing(bond), 1, outcome);
    bond.unit *= lengths;
    bond.thickness *= lengths;
    worsen(outcome, std::abs(multiplier(standing(bond), forces, outcome) / reference - 1));
    worsen(outcome, std::abs(reference - 0.642859) - 5e-7);
    return outcome;
}

/// A block, twice as high as wide, on a ground that is not quite parallel to its lower face.
Outcome outOfParallel(double angle)
{
    Assembly<2> assembly;
    assembly.supports = {{"ground", "ground"}};
    assembly.blocks.push_back(rectangle(-2, -1, 2, 0, 0));
    assembly.blocks.push_back({{{-0.5, 0}, {0.5, angle}, {0.5, 2}, {-0.5, 2}}, 1, -1});
    const WeighedStructure structure(std::move(assembly));
    Outcome outcome;
    const PlaneConeProgram program = structure.program(0.65, structure.weightLoads());
    if (angle > 2e-6) // beyond the tolerance of findContactPoints there is no joint, and the block falls
    {
        outcome.figure = solved(program, CollapseStatus::unstable, outcome).certificate.worst();
        outcome.note = "no joint: unstable";
        return outcome;
    }
    compareMultiplier(program, 0.5, outcome);
    return outcome;
}

/// A keystone of half-angle b between fixed springers, lifted, so that only friction holds it.
Outcome keystone(double share)
{
    const double tangent = std::tan(0.4);
    Assembly<2> assembly;
    assembly.supports = {{"springers", "blocks"}};
    const double upper = 0.5 + tangent;
    assembly.blocks.push_back({{{-0.5, 0}, {0.5, 0}, {upper, 1}, {-upper, 1}}, 1, -1});
    assembly.blocks.push_back({{{0.5, 0}, {3, 0}, {3, 1}, {upper, 1}}, 1, 0});
    assembly.blocks.push_back({{{-3, 0}, {-0.5, 0}, {-upper, 1}, {-3, 1}}, 1, 0});
    const WeighedStructure structure(std::move(assembly));
    LoadVectors loads = structure.weightLoads();
    loads.live = -loads.dead;
    Outcome outcome;
    const LimitAnalysis result =
        solved(structure.program(share * tangent, loads),
               share > 1 ? CollapseStatus::unbounded : CollapseStatus::optimal, outcome);
    outcome.figure = result.certificate.worst();
    outcome.note = nameOf(result.status);
    return outcome;
}

/// n bricks that overhang by `factor` times as much as they can.
Outcome overhang(int bricks, double factor)
{
    Assembly<2> assembly;
    assembly.supports = {{"table", "blocks"}};
    assembly.blocks.push_back(rectangle(-3, -1, 0, 0, 0));
    double end = 0;
    for (int brick = 0; brick < bricks; ++brick)
    {
        end += factor * 0.5 / (bricks - brick);
        assembly.blocks.push_back(rectangle(end - 1, 0.2 * brick, end, 0.2 * (brick + 1)));
    }
    const WeighedStructure structure(std::move(assembly));
    Outcome outcome;
    const LimitAnalysis result =
        solved(structure.program(0.65, structure.weightLoads()),
               factor < 1 ? CollapseStatus::optimal : CollapseStatus::unstable, outcome);
    outcome.figure = result.certificate.worst();
    outcome.note = nameOf(result.status);
    return outcome;
}

/// A block between two fixed walls that fits exactly and hangs by friction alone.
Outcome hangingBlock()
{
    Assembly<2> assembly;
    assembly.supports = {{"walls", "blocks"}};
    assembly.blocks = {rectangle(0, 0, 1, 1), rectangle(-1, -1, 0, 2, 0), rectangle(1, -1, 2, 2, 0)};
    const WeighedStructure structure(std::move(assembly));
    Outcome outcome;
    const LimitAnalysis result =
        solved(structure.program(0.1, structure.weightLoads()), CollapseStatus::unbounded, outcome);
    outcome.figure = result.certificate.worst();
    outcome.note = "statics alone calls it stable under any push";
    return outcome;
}

/// Wall 1 several times, each copy on its own: every copy may be the one that fails.
Outcome twins(int copies)
{
    const WeighedStructure one = standing(paperWalls()[0].bond);
    Assembly<2> assembly;
    assembly.supports = one.assembly.supports;
    for (int copy = 0; copy < copies; ++copy)
    {
        for (Block<2> block : one.assembly.blocks)
        {
            for (auto& vertex : block.outline)
            {
                vertex.x() += 64 * copy;
            }
            assembly.blocks.push_back(block);
        }
    }
    Outcome outcome;
    const double alpha = solved(one.program(0.65, one.weightLoads()), CollapseStatus::optimal, outcome).alpha;
    const WeighedStructure all(std::move(assembly));
    compareMultiplier(all.program(0.65, all.weightLoads()), alpha, outcome);
    return outcome;
}

/// Each contact point of wall 1 several times.
Outcome duplicates(int times)
{
    WeighedStructure structure = standing(paperWalls()[0].bond);
    Outcome outcome;
    const double alpha =
        solved(structure.program(0.65, structure.weightLoads()), CollapseStatus::optimal, outcome).alpha;
    const std::vector<ContactPoint<2>> points = structure.points;
    structure.points.clear();
    for (const auto& point : points)
    {
        structure.points.insert(structure.points.end(), static_cast<std::size_t>(times), point);
    }
    compareMultiplier(structure.program(0.65, structure.weightLoads()), alpha, outcome);
    return outcome;
}

/// Wall 1 whose ground has gone.
Outcome removedSupport()
{
    const WeighedStructure structure(makeAssembly(paperWalls()[0].bond));
    Outcome outcome;
    const LimitAnalysis result =
        solved(structure.program(0.65, structure.weightLoads()), CollapseStatus::unstable, outcome);
    outcome.figure = result.certificate.worst();
    return outcome;
}

} // namespace

std::vector<StabilityCase> limitAnalysisCases()
{
    std::vector<StabilityCase> cases;
    const auto add = [&cases](std::string name, std::string hard, std::string measure, double limit,
                              std::function<Outcome()> run)
    {
        cases.push_back({std::move(name), std::move(hard), std::move(measure), limit, limit, staticSolvers(),
                         [run = std::move(run)](SolverType) { return run(); }});
    };
    const std::string ofMultiplier = "relative error of the multiplier, plane and space";

    for (const auto& [ratio, text] : {std::pair(1.0, "1"), {1e4, "1e4"}, {1e8, "1e8"}})
    {
        add(fmt::format("static_massRatio_{}", text),
            "rows of the balance differ as the masses do: what is rounding of one is the load of another",
            ofMultiplier, 1e-6, [ratio = ratio] { return towerOutcome(evenTower(5, ratio)); });
    }
    for (const int blocks : {20, 200})
    {
        add(fmt::format("static_tower_{}", blocks),
            "forces pass through every block, and the lever arm of the push is that of all of them",
            ofMultiplier, 1e-6, [blocks] { return towerOutcome(evenTower(blocks)); });
    }
    for (const int slenderness : {1, 10, 100})
    {
        add(fmt::format("static_slenderness_{}", slenderness),
            "a slender block has moments that dwarf its forces, and a multiplier near zero", ofMultiplier,
            1e-6, [slenderness] { return towerOutcome(towerOfHeights({double(slenderness)}, 0.65)); });
    }
    for (const int points : {2, 300})
    {
        add(fmt::format("static_pointsOnFace_{}", points),
            "forces of many points on a face are not unique: the Schur system is near singular", ofMultiplier,
            1e-6, [points] { return towerOutcome(evenTower(3, 1, 0.65, points)); });
    }
    for (const auto& [mu, text] :
         {std::pair(0.0, "0"), {1e-12, "1em12"}, {1.5, "1p5"}, {3.0, "3"}, {1e6, "1e6"}})
    {
        add(fmt::format("static_mu_{}", text),
            "cones degenerate to rays (mu = 0), or have room for forces far larger than the loads",
            ofMultiplier, 1e-6, [mu = mu] { return towerOutcome(evenTower(2, 1, mu)); });
    }
    for (const auto& [scale, text] : {std::pair(1e-6, "1em6"), {1e-3, "1em3"}, {1e3, "1e3"}, {1e6, "1e6"}})
    {
        add(fmt::format("static_lengths_{}", text), "an absolute tolerance anywhere shows",
            "relative change of wall 1's multiplier", 1e-6, [scale = scale] { return scaledWall(scale, 1); });
        add(fmt::format("static_loads_{}", text), "an absolute tolerance anywhere shows",
            "relative change of wall 1's multiplier", 1e-6, [scale = scale] { return scaledWall(1, scale); });
    }
    add("static_criticalArch",
        "at the least thickness a single thrust line fits, touching both faces in turn",
        "least thickness of 27 voussoirs: error, and change by noise of 1e-15 m and by mirroring [m]", 5e-6,
        criticalArch);
    for (const auto& [angle, text] : anglesOutOfParallel)
    {
        add(fmt::format("static_outOfParallel_{}", text),
            "whether two faces touch along their length is a matter of the tolerance",
            "relative error of the multiplier; of no joint, certificate that it falls", 1e-6,
            [angle = angle] { return outOfParallel(angle); });
    }
    add("static_slivers", "blocks 1e-4 thin among full ones: contact points close to their centres",
        ofMultiplier, 1e-6,
        [] {
            return towerOutcome(towerOfHeights({1, 1e-4, 1, 1e-4, 1}, 0.65));
        });
    for (const auto& [share, text] : {std::pair(1e-3, "1em3"), {1e-4, "1em4"}, {1e-6, "1em6"}})
    {
        add(fmt::format("static_keystone_above_{}", text),
            "mu just above tan b: wedged without bound by vast forces", "certificate of the status", 1e-9,
            [share = share] { return keystone(1 + share); });
        add(fmt::format("static_keystone_below_{}", text),
            "mu just below tan b: forces of 1/this times the weight", "certificate of the status", 1e-9,
            [share = share] { return keystone(1 - share); });
    }
    for (const int bricks : {4, 20})
    {
        add(fmt::format("static_overhang_{}_inside", bricks), "stands by a millionth of the overhang",
            "certificate of the status", 1e-9, [bricks] { return overhang(bricks, 1 - 1e-6); });
        add(fmt::format("static_overhang_{}_outside", bricks), "falls by a millionth of the overhang",
            "certificate of the status", 1e-9, [bricks] { return overhang(bricks, 1 + 1e-6); });
    }
    add("static_hangingBlock", "balance is possible with forces that nothing has set up: statics cannot know",
        "certificate of the status", 1e-9, hangingBlock);
    for (const int copies : {2, 8})
    {
        add(fmt::format("static_twins_{}", copies),
            "mechanisms are not unique: any mixture of the copies' does",
            "relative change of wall 1's multiplier", 1e-8, [copies] { return twins(copies); });
    }
    for (const int times : {2, 10})
    {
        add(fmt::format("static_duplicatePoints_{}", times), "columns of the equilibrium matrix repeat",
            "relative change of wall 1's multiplier", 1e-8, [times] { return duplicates(times); });
    }
    add("static_removedSupport", "nothing holds the wall, and it may move as one in any way",
        "certificate that it is unstable", 1e-9, removedSupport);
    return cases;
}

} // namespace drystone
