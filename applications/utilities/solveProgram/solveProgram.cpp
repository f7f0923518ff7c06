// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// solveProgram: solves a cone program stored in a file by limitAnalysis, contactDynamics or another program,
/// and prints status, objective and certificate.
#include "conic/Certificate.h"
#include "conic/ProgramFile.h"
#include "core/Log.h"
#include "runControl/Application.h"

using namespace drystone;

namespace
{

/// The keys of system/solution, from the command line.
SolverChoice choiceOf(const CommandLine& commandLine)
{
    std::string text;
    for (const char* key : {"solver", "tolerance", "maximumIterations", "maximumSweeps"})
    {
        if (const auto value = commandLine.get(key))
        {
            text += fmt::format("{} {};\n", key, *value);
        }
    }
    return readOptions<SolverChoice>(Dictionary::readString(text, "command line"));
}

/// Why a solver takes no program such as this one, and which takes it.
template<int Rows, int Forces>
std::string faultOf(const ConeProgram<Rows, Forces>& program, const SolverChoice& choice)
{
    const bool isGaussSeidel = choice.solver == SolverType::gaussSeidel;
    const bool givesWay = program.hasCompliance() && program.points() > 0;
    if (givesWay && !isGaussSeidel)
    {
        bool areAlike = program.compliance.minCoeff() > 0;
        for (Eigen::Index row = 2; Forces == 3 && row < program.compliance.size(); row += 3)
        {
            areAlike = areAlike && program.compliance[row] == program.compliance[row - 1];
        }
        return program.hasInertia() && !program.hasMultiplier() && !program.hasStrength() && areAlike
                   ? ""
                   : "Programs with a compliance are solved where they have inertia, no live load and no "
                     "strength, and all points give way, in space alike in all shears. With inertia and "
                     "without live load -solver gaussSeidel takes others, in space those without strength.";
    }
    if (isGaussSeidel && Forces == 3 && program.hasStrength())
    {
        return "gaussSeidel takes no strength of points in space. Use -solver interiorPoint.";
    }
    if (choice.solver == SolverType::augmentedLagrangian && program.hasCrushing())
    {
        return "augmentedLagrangian takes no crushing. Use -solver interiorPoint.";
    }
    return "";
}

template<int Rows, int Forces>
int solve(const ConeProgram<Rows, Forces>& program, const SolverChoice& choice)
{
    if (solvesMotionOnly(choice.solver) && (!program.hasInertia() || program.hasMultiplier()))
    {
        throw FatalError(
            nameOf(choice.solver)
            + " solves programs with inertia and without live load only. Use -solver interiorPoint.");
    }
    if (const std::string fault = faultOf(program, choice); !fault.empty())
    {
        throw FatalError(fault);
    }
    info("Bodies: {} in {}, contact points: {}, inertia: {}, multiplier: {}\nSolver: {}, tolerance {:g}\n",
         program.bodies, Forces == 2 ? "the plane" : "space", program.points(),
         program.hasInertia() ? "yes" : "no", program.hasMultiplier() ? "yes" : "no", nameOf(choice.solver),
         choice.tolerance);
    const ConeSolution solution = solveConeProgram(program, choice);
    const Certificate certificate = certify(program, solution);
    info("Status: {}", nameOf(solution.status));
    if (solution.status == SolveStatus::optimal)
    {
        info("Objective = {:.12g}", objective(program, solution));
    }
    info("Certificate: primal residual = {:.3e}, dual residual = {:.3e}, gap = {:.3e}, No Iterations {}\n",
         certificate.primalResidual, certificate.dualResidual, certificate.dualityGap, solution.iterations);
    printExecutionTime();
    printEnd();
    return solution.status == SolveStatus::notConverged ? 2 : 0;
}

int run(const CommandLine& commandLine)
{
    const SolverChoice choice = choiceOf(commandLine);
    return std::visit([&choice](const auto& program) { return solve(program, choice); },
                      readProgram(commandLine.caseDirectory / commandLine.arguments.front()));
}

} // namespace

int main(int argc, char* argv[])
{
    ApplicationDescription description;
    description.name = "solveProgram";
    description.summary =
        "Solves a cone program stored in a file, as `writeProgram always;` in system/solution writes them "
        "to postProcessing/, and prints status, objective (1/2 r'Mbar^-1 r + g'c - alpha) and certificate.";
    description.arguments = {{"PROGRAM", "", "the file, relative to the case directory"}};
    description.options = {
        {"solver", "NAME",
         "one of automatic interiorPoint augmentedLagrangian gaussSeidel; default automatic"},
        {"tolerance", "NUMBER", "on every figure of the certificate (default: 1e-9)"},
        {"maximumIterations", "N", "of each solver (default: 200)"},
        {"maximumSweeps", "N", "of gaussSeidel (default: 10000)"},
    };
    description.examples = {"solveProgram postProcessing/limitAnalysis/0/coneProgram -tolerance 1e-12"};
    return runApplication(argc, argv, description, run);
}
