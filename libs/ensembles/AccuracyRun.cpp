// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The first step is shortened to its phase, others where they are not solved; the largest hover is kept.
#include "ensembles/AccuracyRun.h"

#include "conic/UnitOfWork.h"
#include "core/Log.h"
#include "core/Signals.h"
#include "dynamics/Advance.h"

#include <algorithm>

namespace drystone
{
namespace
{

/// The largest gap at a point that carries force [m]: at least a hundredth of the largest force or load,
/// since solvers that end inside the cones leave small forces, within their tolerance, at points far apart.
template<int Dim>
double hoverOf(const DynamicCase<Dim>& scene, const Motion<Dim>& motion)
{
    constexpr double carriesForce = 1e-2;
    double largestForce =
        scene.deadLoad.rows.template lpNorm<Eigen::Infinity>(); // about mass centres: no moments
    for (const Vector<Dim>& force : motion.contactForces)
    {
        largestForce = std::max(largestForce, force[0]);
    }
    double hover = 0;
    for (std::size_t point = 0; point < motion.points.size(); ++point)
    {
        if (motion.contactForces[point][0] > carriesForce * largestForce)
        {
            hover = std::max(hover, motion.points[point].gap);
        }
    }
    return hover;
}

} // namespace

template<int Dim>
DynamicCase<Dim> sceneWith(const AccuracyCase<Dim>& study, const RunSetting& setting)
{
    DynamicCase<Dim> scene = *study.scene;
    scene.schemes.timeIntegration.theta = setting.theta;
    scene.schemes.smallDisplacements = setting.displacements == Displacements::small;
    if (setting.contactOverlap > 0)
    {
        scene.schemes.contactOverlap = setting.contactOverlap;
    }
    scene.schemes.effects.selection = setting.effects;
    scene.solution.solver = setting.solver;
    scene.solution.tolerance = setting.tolerance;
    if (scene.contact.friction)
    {
        scene.contact.friction->flowRule = setting.flowRule;
    }
    addLeftOut(scene);
    return scene;
}

template<int Dim>
Measurement stepThrough(const DynamicCase<Dim>& scene, const AccuracyCase<Dim>& study,
                        const RunSetting& setting, const StepPhase& phase,
                        const std::type_identity_t<MotionObserver<Dim>>& observe)
{
    Measurement result;
    const double begin = cpuTime();
    Motion<Dim> motion = startMotion(scene, study.start);
    bool goesOn = observe(motion, 0);
    double stepLength = phase.firstStep() * setting.deltaT;
    while (goesOn && motion.state.time < study.endTime)
    {
        if (stopSignal() != 0)
        {
            result.end = RunEnd::interrupted;
            break;
        }
        const bool isLast = study.endTime - motion.state.time <= stepLength * (1 + 1e-9);
        const double stepEnd = isLast ? study.endTime : motion.state.time + stepLength;
        double part = stepEnd - motion.state.time; // of a step that was shortened
        while (goesOn && motion.state.time < stepEnd)
        {
            const bool endsStep = stepEnd - motion.state.time <= part * (1 + 1e-9);
            const double timeStep = endsStep ? stepEnd - motion.state.time : part;
            const ShortenedStep taken = advanceOrShorten(scene, motion, timeStep);
            if (!taken.isSolved)
            {
                result.end = RunEnd::unsolved;
                break;
            }
            part = taken.timeStep;
            if (endsStep && taken.timeStep == timeStep)
            {
                motion.state.time = stepEnd; // the sum of the steps may differ from it in the last digit
            }
            ++result.steps;
            result.hover = std::max(result.hover, hoverOf(scene, motion));
            result.worstResidual = std::max(result.worstResidual, motion.residuals.worst());
            goesOn = observe(motion, taken.timeStep);
        }
        if (result.end == RunEnd::unsolved)
        {
            break;
        }
        stepLength = setting.deltaT;
    }
    result.cpuTime = cpuTime() - begin;
    return result;
}

template<int Dim>
double unitOfWork(const AccuracyCase<Dim>& study, const RunSetting& setting, QuantityKind kind)
{
    if (kind == QuantityKind::limitAnalysis)
    {
        return unitOfWork(study.structures.at(jointPointsOf<Dim>(setting)).program);
    }
    const DynamicCase<Dim>& scene = *study.scene;
    const std::vector<ContactPoint<Dim>> points = findContactPoints(scene.assembly);
    const double mu = scene.contact.friction ? scene.contact.friction->mu : 0;
    return unitOfWork(thetaStepProgram(
        massAt(scene, study.start.placements), Eigen::VectorXd::Zero(scene.mass.size()), scene.deadLoad.rows,
        points, equilibriumColumns(scene.assembly, scene.blocks, points),
        std::vector<double>(points.size(), mu), {setting.theta, setting.deltaT}));
}

template Measurement stepThrough(const DynamicCase<2>& scene, const AccuracyCase<2>& study,
                                 const RunSetting& setting, const StepPhase& phase,
                                 const MotionObserver<2>& observe);
template DynamicCase<2> sceneWith(const AccuracyCase<2>& study, const RunSetting& setting);
template double unitOfWork(const AccuracyCase<2>& study, const RunSetting& setting, QuantityKind kind);
template Measurement stepThrough(const DynamicCase<3>& scene, const AccuracyCase<3>& study,
                                 const RunSetting& setting, const StepPhase& phase,
                                 const MotionObserver<3>& observe);
template DynamicCase<3> sceneWith(const AccuracyCase<3>& study, const RunSetting& setting);
template double unitOfWork(const AccuracyCase<3>& study, const RunSetting& setting, QuantityKind kind);

} // namespace drystone
