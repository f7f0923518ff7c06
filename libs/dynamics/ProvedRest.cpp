// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The step that a proof of rest stands for.
#include "dynamics/ProvedRest.h"

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

/// Whether the proof is one for where the blocks are. Of points that give way it is one for the forces of the
/// last step, too, from which their shear goes on.
template<int Dim>
bool isOf(const RestProof<Dim>& proof, const Motion<Dim>& motion)
{
    return isSame<Dim>(proof.placements, motion.state.placements)
           && (!proof.program.hasCompliance() || isSame<Dim>(motion.contactForces, proof.forcesOfDeadLoad));
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
    if (motion.restProof && isOf(*motion.restProof, motion))
    {
        return *motion.restProof;
    }
    const DynamicCase<Dim>& scene = step.scene;
    Step<Dim> own(scene, motion, step.scheme.timeStep, step.impacts);
    findContacts(own);
    assemble(own);
    contribute(own);
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

/// Mbar is M over theta dt^2.
template<int Dim>
void setTimeStep(RestProof<Dim>& proof, double timeStep)
{
    const double ratio = proof.timeStep / timeStep;
    for (auto& inertia : proof.program.inertia)
    {
        inertia *= ratio * ratio;
    }
    proof.timeStep = timeStep;
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
    if (proof.timeStep != step.scheme.timeStep)
    {
        setTimeStep(proof, step.scheme.timeStep);
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
