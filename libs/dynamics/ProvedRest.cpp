// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The step that a proof of rest stands for.
#include "dynamics/ProvedRest.h"

#include "dynamics/ClosedPoints.h"
#include "dynamics/EffectCalls.h"
#include "dynamics/RestingStep.h"

namespace drystone
{
namespace
{

template<int Dim>
bool isSame(const std::vector<Placement<Dim>>& some, const std::vector<Placement<Dim>>& others)
{
    return some.size() == others.size()
           && std::equal(some.begin(), some.end(), others.begin(),
                         [](const Placement<Dim>& a, const Placement<Dim>& b) {
                             return a.translation == b.translation
                                    && rowsOf(a.rotation) == rowsOf(b.rotation);
                         });
}

/// \param all Dim a point
template<int Dim>
bool isSame(const std::vector<Vector<Dim>>& some, const Eigen::VectorXd& all)
{
    bool isEqual = Dim * static_cast<Eigen::Index>(some.size()) == all.size();
    for (std::size_t i = 0; isEqual && i < some.size(); ++i)
    {
        isEqual = some[i] == all.segment<Dim>(Dim * static_cast<Eigen::Index>(i));
    }
    return isEqual;
}

/// Whether a proof is that of where the blocks are, and at points that are closed in a step of this length:
/// as if it had been made in it, so that a run which is continued is the same as one that is not. Of points
/// that give way it is one for the forces of the last step, from which their shear goes on.
template<int Dim>
bool isStillRight(RestProof<Dim>& proof, const Step<Dim>& step)
{
    const Motion<Dim>& motion = step.motion;
    const bool isElastic = proof.program.hasCompliance();
    if (!isSame<Dim>(proof.placements, motion.state.placements)
        || (isElastic && !isSame<Dim>(motion.contactForces, proof.forcesOfDeadLoad)))
    {
        return false;
    }
    if (proof.timeStep == step.scheme.timeStep)
    {
        return true;
    }
    proof.timeStep = step.scheme.timeStep;
    setInertia(proof.program, step.mass, step.scheme);
    return isElastic || closedPoints<Dim>(proof.program, proof.deadLoad, proof.tolerance) == proof.isClosed;
}

/// All that effects may load the structure with.
template<int Dim>
std::vector<Eigen::VectorXd> loadDirections(const DynamicCase<Dim>& scene)
{
    std::vector<Eigen::VectorXd> loads;
    for (const auto& effect : scene.effects)
    {
        for (Eigen::VectorXd& load : effect->loadDirections(scene))
        {
            loads.push_back(std::move(load));
        }
    }
    return loads;
}

/// The proof for where the blocks are, made if there is none.
template<int Dim>
RestProof<Dim>& keptProof(Step<Dim>& step)
{
    Motion<Dim>& motion = step.motion;
    if (motion.restProof && isStillRight(*motion.restProof, step))
    {
        return *motion.restProof;
    }
    const DynamicCase<Dim>& scene = step.scene;
    Step<Dim> own(scene, motion, step.scheme.timeStep, step.impacts);
    findContacts(own);
    assemble(own);
    contribute(own);
    setInertia(own.program, own.mass, own.scheme); // what rests is not damped, see isStillRight
    motion.restProof =
        own.program.hasCompliance()
            ? proofOfElasticRest<Dim>(std::move(own.program), step.scheme.timeStep, own.guess.contactForce)
            : proofOfRest<Dim>(std::move(own.program), step.scheme.timeStep, own.deadLoad,
                               loadDirections(scene), step.settings.solver.tolerance);
    motion.restProof->points = std::move(own.points);
    motion.restProof->placements = motion.state.placements;
    return *motion.restProof;
}

/// Whether all effects are idle in the step, as far as they can be known without solving it.
template<int Dim>
bool areEffectsIdle(const Step<Dim>& step)
{
    return traitsOf(step.scene.effects).isIdleAtRest
           && std::all_of(step.supports.begin(), step.supports.end(), isStill<Dim>);
}

} // namespace

template<int Dim>
bool staysAtRest(Step<Dim>& step)
{
    const DynamicCase<Dim>& scene = step.scene;
    Motion<Dim>& motion = step.motion;
    if (scene.schemes.effects.selection != EffectSelection::automatic || !motion.state.velocity.isZero(0)
        || !areEffectsIdle(step))
    {
        return false;
    }
    const StageTimer timer(motion.stageTimes, Stage::rest);
    RestProof<Dim>& proof = keptProof(step);
    const Eigen::VectorXd forces = forcesAtRest(proof, step.load, scene.schemes.effects.margin);
    if (forces.size() == 0)
    {
        return false;
    }
    proof.program.load = step.load;
    const Rest rest = restWith(proof.program, forces);
    if (rest.certificate.worst() > step.settings.solver.tolerance)
    {
        return false;
    }
    motion.state.time += step.scheme.timeStep;
    motion.points = proof.points;
    motion.contactForces.resize(motion.points.size());
    for (std::size_t point = 0; point < motion.points.size(); ++point)
    {
        motion.contactForces[point] = forces.segment<Dim>(Dim * static_cast<Eigen::Index>(point));
    }
    motion.meanForces.clear();
    motion.interior = {};
    motion.restitutionShare = 1;
    motion.slides = false;
    motion.collisions = 0;
    motion.stepsInVain = 0;
    motion.attempt = {};
    motion.attempt.initialResidual = rest.certificate.worst();
    motion.attempt.primalResidual = rest.certificate.primalResidual;
    motion.attempt.dualResidual = rest.certificate.dualResidual;
    motion.attempt.dualityGap = rest.certificate.dualityGap;
    motion.residuals = motion.attempt;
    motion.isAwake.assign(scene.free.size(), false);
    motion.bodies.assign(scene.free.size(), -1);
    motion.effectCalls.assign(namesOfEffects(scene).size(), 0);
    ++motion.effectUse.atRest;
    return true;
}

template bool staysAtRest(Step<2>& step);
template bool staysAtRest(Step<3>& step);

} // namespace drystone
