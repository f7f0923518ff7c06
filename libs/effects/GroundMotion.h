// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How the ground moves in a case: constant/groundMotion.
///
///     direction (1 0 0);
///     acceleration { type halfSine; amplitude 4.8; duration 0.5; }
///
/// or, to move along several directions at once,
///
///     components
///     {
///         horizontal { direction (1 0 0); acceleration { type record; file constant/north.AT2; } }
///         vertical   { direction (0 1 0); acceleration { type record; file constant/up.AT2; } }
///     }
#pragma once

#include "dictionary/Registry.h"
#include "effects/EffectType.h"
#include "timeSeries/GroundAccelerationTypes.h"

#include <Eigen/Core>

#include <optional>
#include <string>

namespace drystone
{

/// Accelerations of the ground along some directions, each with its own history. A run is seen from the
/// moving ground: each block feels -m a, and displacements and velocities are relative to the ground.
struct GroundMotion
{
    struct Component : DescribedAcceleration
    {
        Eigen::Vector3d direction = Eigen::Vector3d::UnitX(); ///< of unit length
    };
    std::vector<Component> components; ///< empty: the ground is still
    double factor = 1;                 ///< times all of them: the intensity of an incremental analysis
};

/// Acceleration of the ground at a time [m/s2], without the factor; at a jump, after it.
Eigen::Vector3d groundAcceleration(const GroundMotion& motion, double time);

/// Mean acceleration of the ground over a step [m/s2], without the factor: exact, however the kinks of the
/// motion lie in the step. The momentum a step takes from the ground is -m times this times the length of the
/// step.
Eigen::Vector3d meanGroundAcceleration(const GroundMotion& motion, double from, double to);

/// The largest peak among the components [m/s2], without the factor; 0 for a ground at rest.
double peakAcceleration(const GroundMotion& motion);

/// What the log says of the motion: for each component direction, type, peak acceleration [m/s2 and g],
/// duration and, for a record, its file, title, unit and scale. Ends with a line end. `Ground motion: none`
/// for a ground at rest. \param gravity of constant/g, the g of peaks [m/s2]; 0: peaks are in m/s2 only
std::string summary(const GroundMotion& motion, double gravity);

/// One direction of motion.
struct GroundComponentSettings
{
    std::array<double, 3> direction{1, 0, 0}; ///< of any length but zero
    AccelerationMaker acceleration;
};
void declare(Options& options, GroundComponentSettings& settings);

/// constant/groundMotion as it is written: one direction, or several under `components`.
struct GroundMotionSettings
{
    std::optional<std::array<double, 3>> direction; ///< of any length but zero
    AccelerationMaker acceleration;
    std::vector<Named<GroundComponentSettings>> components;
};
void declare(Options& options, GroundMotionSettings& settings);

/// In space directions have all components, since (0 1) is upwards in the plane; there they lie in it.
/// \param dictionary with a `direction`, or none, and such dictionaries in `components`, or none
/// \throws FatalIOError with the place of one that has not
void requireComponents(const Dictionary& dictionary, int dimensions);

/// The motion that constant/groundMotion describes, with its records read.
/// \param dimensions of the case: in space a direction needs all three numbers
/// \throws FatalIOError for what is wrong with the dictionary or with a file it names
GroundMotion readGroundMotion(const Dictionary& dictionary, const std::filesystem::path& caseDirectory,
                              int dimensions);

/// Each block feels -m a, with the mean acceleration of the ground over the step times the factor.
template<int Dim>
class MovingGround final : public Effect<Dim>
{
public:
    explicit MovingGround(GroundMotion ofGround) : motion(std::move(ofGround)) {}
    /// Idle at rest, where it is a load and nothing else.
    EffectTraits traits() const override { return {.isIdleAtRest = true}; }
    /// -M times each direction [N for 1 m/s2].
    std::vector<Eigen::VectorXd> loadDirections(const Structure<Dim>& structure) const override;
    const GroundMotion* groundMotion() const override { return &motion; }
    StepBounds stepBounds(double time) const override;
    void addLoad(const EffectContext<Dim>& context, const EffectState& state,
                 Eigen::VectorXd& load) const override;
    std::string startText(const Structure<Dim>& structure, const EffectState& state) const override;

private:
    GroundMotion motion;
};

/// The motion of the ground among the effects of a case; a still ground where there is none.
template<int Dim>
GroundMotion groundMotionOf(const Effects<Dim>& effects);

/// Gives a case another motion of the ground. It contributes where the one before did, or first.
template<int Dim>
void setGroundMotion(Effects<Dim>& effects, GroundMotion motion);

/// Its entry of the list.
template<int Dim>
EffectType<Dim> groundMotionType();

} // namespace drystone
