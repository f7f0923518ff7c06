// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The iterations of the interior point: Mehrotra's predictor and corrector, Gondzio's correctors with the
/// weights of Colombo & Gondzio, for rays and round cones alike, in the plane and in space, in numbers of
/// either precision. Internal to the interior point.
#pragma once

#include "conic/interiorPoint/Centring.h"
#include "conic/interiorPoint/Newton.h"
#include "conic/interiorPoint/Starts.h"
#include "conic/interiorPoint/StepLength.h"
#include "conic/interiorPoint/Trace.h"

namespace drystone
{

template<int Rows, class Scalar = double>
class InteriorPointLoop
{
public:
    using Vector = VectorOf<Scalar>;

    InteriorPointLoop(const Form<Rows>& form, SchurSystem<Rows, Scalar>& system,
                      const InteriorPointSettings& settings, Sought sought);

    /// Iterates until the scaled residuals meet the tolerance. \return whether they did
    bool run(Start from, const Centring& centring);

    /// Iterates likewise from about forces s and displacements y. \param error e of their certificate
    bool runNear(const Eigen::VectorXd& s, const Eigen::VectorXd& y, double error);

    /// Iterates likewise from where an earlier program passed (see startInside).
    bool runInside(Iterate<double> interior, const Eigen::VectorXd& displacement);

    const Iterate<Scalar>& iterate() const { return state.at; }
    Ending ending() const { return end; } ///< of the last iterations

    /// s in the cones with B s = f, found on the way; empty when none were.
    const Vector& forcesOfLoadAlone() const { return forcesOfLoad; }

    /// An iterate well inside the cones that was passed on the way, or with empty vectors where none was.
    const Iterate<Scalar>& interior() const { return passed; }

    int iterations() const { return iterationsOfAllRuns; }
    int factorisations() const { return newton.factorisations; }
    int solves() const { return newton.solves; }

private:
    /// Whether an iterate that is passed well inside the cones is kept.
    enum class Passed
    {
        kept,
        left
    };
    bool iterate(const Centring& centring, Passed whatIsPassed, int mostIterations, int shortStepsAllowed);
    std::optional<Ending> findEnd(Passed whatIsPassed, int mostIterations);
    void keepBalance();
    void measureSteps();
    bool addCorrection(double least, double largestLoss);
    double centre(const Centring& centring);
    void correctTowards(const Centring& centring, double sigma);
    void move();
    void seekForcesOfLoadAlone();

    State<Rows, Scalar> state;
    NewtonSystem<Rows, Scalar> newton;
    Iterate<Scalar> step;
    ScaledStep<Scalar> scaledStep;
    Iterate<Scalar> correction;
    ScaledStep<Scalar> scaledCorrection;
    Vector pull;
    Iterate<Scalar> passed;
    Iterate<Scalar> firm; ///< the last one that was balanced, while there is no compliance
    double firmMissing = 0;
    Vector forcesOfLoad;
    Blocking blocking;
    double primal = 0;   ///< how far the forces of the step in hand may go, at most `farthestStep`
    double dual = 0;     ///< likewise its openings
    double expected = 0; ///< to be missing from the balance at most
    int stalls = 0;      ///< full steps that left the balance as it was
    int standstills = 0; ///< steps in a row that hardly moved
    int iteration = 0;   ///< of the run in hand
    int iterationsOfAllRuns = 0;
    Ending end = Ending::tooManyIterations;
    IterationTrace* trace;
};

} // namespace drystone
