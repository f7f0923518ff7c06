// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// CVXOPT, run in Python on program files, one process for all of them.
#include "Peers.h"
#include "Subprocess.h"

#include <fmt/format.h>

#include <sys/stat.h>

#include <cstdio>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <utility>

namespace drystone
{
namespace
{

/// A Python that has CVXOPT: Debian's own, or that of PATH.
std::string pythonWithCvxopt()
{
    for (const char* python : {"/usr/bin/python3", "python3"})
    {
        if (runProgram(std::string(python) + " -c 'import cvxopt'").status == 0)
        {
            return python;
        }
    }
    return {};
}

/// The process, started with the first program.
class CvxoptProcess
{
public:
    explicit CvxoptProcess(std::string interpreter) : python(std::move(interpreter)) {}
    ~CvxoptProcess() { stop(); }
    CvxoptProcess(const CvxoptProcess&) = delete;
    CvxoptProcess& operator=(const CvxoptProcess&) = delete;

    /// Waits until the solution of a program is written, if there is one. \return its file
    std::filesystem::path solve(const AnyConeProgram& any, double tolerance);

private:
    void start();
    void stop();

    std::string python;
    Scratch scratch;
    std::FILE* requests = nullptr;
    std::ifstream answers;
};

void CvxoptProcess::start()
{
    const std::filesystem::path pipe = scratch.folder / "answers";
    if (mkfifo(pipe.c_str(), S_IRUSR | S_IWUSR) != 0)
    {
        throw std::runtime_error("no pipe can be made in " + scratch.folder.string());
    }
    // The shell opens the pipe, so that it is open at both ends whatever becomes of Python.
    requests = popen(fmt::format("exec {} '{}' > '{}' 2> /dev/null", python,
                                 DRYSTONE_PEERS "/solveWithCvxopt.py", pipe.string())
                         .c_str(),
                     "w");
    answers.open(pipe);
}

void CvxoptProcess::stop()
{
    if (requests)
    {
        pclose(requests);
    }
    requests = nullptr;
    answers = {};
    std::filesystem::remove(scratch.folder / "answers");
}

std::filesystem::path CvxoptProcess::solve(const AnyConeProgram& any, double tolerance)
{
    if (!requests)
    {
        start();
    }
    const std::filesystem::path solution = scratch.folder / "solution";
    std::filesystem::remove(solution);
    std::visit([&](const auto& program) { writeProgram(scratch.folder / "program", program); }, any);
    fmt::print(requests, "{} {} {}\n", (scratch.folder / "program").string(), solution.string(), tolerance);
    std::fflush(requests);
    std::string answer;
    if (!std::getline(answers, answer)) // it has crashed: the next program gets another
    {
        stop();
    }
    return solution;
}

} // namespace

std::optional<Peer> cvxopt()
{
    const std::string python = pythonWithCvxopt();
    if (python.empty())
    {
        return {};
    }
    const auto solve = [process = std::make_shared<CvxoptProcess>(python)](
                           const AnyConeProgram& any, double tolerance) -> std::optional<PeerAnswer>
    {
        std::ifstream stream(process->solve(any, tolerance));
        PeerAnswer answer;
        ConeSolution& solution = answer.solution;
        std::visit(
            [&](const auto& program)
            {
                solution.contactForce.setZero(program.points()
                                              * (program.load.size() == 3 * program.bodies ? 2 : 3));
                solution.displacement.setZero(program.load.size());
            },
            any);
        stream >> answer.seconds >> solution.iterations >> solution.multiplier;
        for (Eigen::VectorXd* vector : {&solution.contactForce, &solution.displacement})
        {
            for (double& entry : *vector)
            {
                stream >> entry;
            }
        }
        if (!stream)
        {
            solution.displacement.setConstant(std::numeric_limits<double>::quiet_NaN());
        }
        return answer;
    };
    return Peer{"CVXOPT", ContactLaw::associative, solve};
}

} // namespace drystone
