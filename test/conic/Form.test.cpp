// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Standard cones instead of friction cones, and what is done with them in numbers of either precision.
#include "conic/form/Form.h"
#include "conic/Certificate.h"
#include "conic/form/FormOperators.h"
#include "conic/form/FormSchur.h"
#include "conic/interiorPoint/SolveOnce.h"

#include <gtest/gtest.h>

#include <cmath>

namespace drystone
{
namespace
{

/// A block of 2 x 1 on two points, each at the ends of its base, pushed at half its height.
PlaneConeProgram blockOnGround(double mu)
{
    PlaneConeProgram program;
    program.bodies = 1;
    for (const double x : {-1.0, 1.0})
    {
        ConeColumns<3, 2> columns;
        columns.first = 0;
        columns.second = -1;
        columns.onFirst << 0, -1, -1, 0, -x, -0.5; // A c balances the loads: reversed forces
        columns.onSecond.setZero();
        program.contacts.push_back(columns);
        program.friction.push_back(mu);
    }
    program.load = Eigen::Vector3d(0, -1, 0);
    program.liveLoad = Eigen::Vector3d(1, 0, 0);
    return program;
}

/// Bodies in a row, each of which touches the next and the ground.
PlaneConeProgram longRow(int bodies)
{
    PlaneConeProgram program;
    program.bodies = bodies;
    for (int body = 0; body < bodies; ++body)
    {
        for (const int other : {body + 1 < bodies ? body + 1 : -1, -1})
        {
            ConeColumns<3, 2> columns;
            columns.first = body;
            columns.second = other;
            columns.onFirst << 0, -1, -1, 0, -1, -0.5;
            columns.onSecond << 0, 1, 1, 0, 1, 0.5;
            program.contacts.push_back(columns);
            program.friction.push_back(0.5);
        }
    }
    program.load = Eigen::VectorXd::Ones(3 * bodies);
    return program;
}

// Two threads added to one coupling.
TEST(Form, APairOfBodiesInTwoSharesIsLeftToOneThread)
{
    PlaneConeProgram program = longRow(4000);
    SymbolicAnalysis symbolic;
    Form<3> form = makeForm(program, symbolic);
    schurSystem(form, symbolic);
    EXPECT_GT(form.shares.size(), 1u);

    program.contacts.push_back(program.contacts.front());
    program.friction.push_back(0.5);
    form = makeForm(program, symbolic);
    schurSystem(form, symbolic);
    EXPECT_TRUE(form.shares.empty());
}

TEST(Form, ForcesAndOpeningsComeBackFromTheirRaysWhateverTheFriction)
{
    for (const double mu : {0.3, 4.0, 6.0, 1e6})
    {
        SCOPED_TRACE(mu);
        const PlaneConeProgram program = blockOnGround(mu);
        SymbolicAnalysis symbolic;
        Form<3> form = makeForm(program, symbolic);
        EXPECT_EQ(form.cones().rays, mu < 5 ? 4 : 6);
        const Eigen::VectorXd forces = (Eigen::VectorXd(4) << 1, 0.25, 2, -0.5).finished();
        const Eigen::VectorXd s = conesOf(program, form, forces);
        EXPECT_GE(s.minCoeff(), 0);
        const Eigen::VectorXd none = Eigen::VectorXd::Zero(form.load.size());
        EXPECT_LE((solutionOf(program, form, s, none, 0.0).contactForce - forces).norm(), 1e-9);
        const ConeSolution extended = solutionOf(program, form, s.cast<DoubleDouble>().eval(),
                                                 none.cast<DoubleDouble>().eval(), DoubleDouble(0));
        EXPECT_LE((extended.contactForce - forces).norm(), 1e-9);

        const Eigen::VectorXd opening = (Eigen::VectorXd(4) << 1, 0.1, 0.5, -0.05).finished();
        EXPECT_LE((openingOf(form, conesOfOpening(form, opening)) - opening).norm(), 1e-9);
    }
}

TEST(FormOperators, AreTheSameInBothPrecisions)
{
    const PlaneConeProgram program = blockOnGround(0.65);
    SymbolicAnalysis symbolic;
    Form<3> form = makeForm(program, symbolic);
    SchurSystem<3>& system = schurSystem(form, symbolic);
    SchurSystem<3, DoubleDouble> extended(program.bodies, form.couplings);
    const ConeWeights<double> d{Eigen::Vector4d(1, 2, 3, 4), {}};
    const ConeWeights<DoubleDouble> dExtended{d.rays.cast<DoubleDouble>(), {}};
    assembleSchur(form, d, 0, 0, system);
    assembleSchur(form, dExtended, 0, 0, extended);
    ASSERT_TRUE(system.factorise());
    ASSERT_TRUE(extended.factorise());
    Eigen::VectorXd y = Eigen::VectorXd::Zero(6);
    y.head<3>() << 0.3, -1, 0.7;
    VectorOf<DoubleDouble> yExtended = y.cast<DoubleDouble>();
    system.solve(y.head(3));
    extended.solve(yExtended.head(3));
    EXPECT_LE((y - yExtended.cast<double>()).norm(), 1e-13);

    // S y = B D B' y gives the right side back, to the digits of the numbers.
    VectorOf<DoubleDouble> rays;
    applyTransposed(form, yExtended, rays);
    dExtended.apply(rays);
    VectorOf<DoubleDouble> right = VectorOf<DoubleDouble>::Zero(6);
    addForces(form, rays, right);
    EXPECT_NEAR((right[0] - 0.3).high, 0, 1e-29);
    EXPECT_NEAR((right[1] + 1).high, 0, 1e-29);
    EXPECT_NEAR((right[2] - 0.7).high, 0, 1e-29);
}

TEST(ExtendedNumbers, GivesTheMultiplierOfABlock)
{
    for (const double mu : {0.3, 3.0, 1e6})
    {
        const PlaneConeProgram program = blockOnGround(mu);
        SymbolicAnalysis symbolic;
        Form<3> form = makeForm(program, symbolic);
        schurSystem(form, symbolic);
        const InteriorPointSettings settings{.tolerance = 1e-12};
        EXPECT_TRUE(mayBeExtended(program, settings, symbolic));
        const ConeSolution solution =
            solveOnce(program, settings, {Sought::solution, 0, Numbers::extended}, symbolic);
        EXPECT_EQ(solution.status, SolveStatus::optimal);
        EXPECT_LE(certifyOptimal(program, solution).worst(), 1e-11);
        EXPECT_NEAR(std::abs(solution.multiplier), std::min(mu, 2.0), 1e-11) << mu;
    }
}

TEST(Certificate, DoesNotTakeClosingJointsForAMechanismWhateverTheFriction)
{
    // Straight down, through the ground: a distance from the cone as large as the displacement itself.
    for (const double mu : {0.0, 0.65, 1e3, 1e9})
    {
        PlaneConeProgram program = blockOnGround(mu);
        program.liveLoad.resize(0);
        const Eigen::Vector3d down(0, -1, 0);
        EXPECT_GE(certifyInfeasible(program, down).worst(), 0.99) << mu;
    }
}

} // namespace
} // namespace drystone
