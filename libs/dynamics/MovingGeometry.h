// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where a step takes blocks and contact points: the geometry of finite displacements that the linear program
/// of a step does not see.
#pragma once

#include "dynamics/Step.h"
#include "geometry/Rotation.h"

#include <optional>

namespace drystone
{

/// The placements that a step leads to, or a share of the way there; where only some points are measured
/// those of blocks at other points are as at the start.
template<int Dim>
std::vector<Placement<Dim>> placementsAfter(const Step<Dim>& step, const Eigen::VectorXd& displacement,
                                            double share = 1);

/// The contact columns of points with the blocks at these placements.
template<int Dim>
std::vector<ContactColumns<Dim>> columnsAt(const DynamicCase<Dim>& scene,
                                           const std::vector<Placement<Dim>>& placements,
                                           const std::vector<ContactPoint<Dim>>& points);

/// Takes gaps as small as rounding for none. Otherwise a structure at rest, whose corners lie on its edges
/// but for rounding, could only be certified to stand as well as rounding compares with what gravity moves a
/// block in one step: 1e-11.
template<int Dim>
void forgetRounding(const DynamicCase<Dim>& scene, std::vector<ContactPoint<Dim>>& points);

/// The components of shear at a point.
template<int Dim>
using Shear = Eigen::Matrix<double, Dim - 1, 1>;

/// How blocks are displaced between two placements, each found when it is first needed. Neither is owned.
template<int Dim>
class BlockMotions
{
public:
    struct Motion
    {
        Vector<Dim> translation; ///< of the mass centre [m]
        Turn<Dim> turn;
        Swing<Dim> swing;
    };

    BlockMotions(const std::vector<Placement<Dim>>& placementsBefore,
                 const std::vector<Placement<Dim>>& placementsAfter)
        : from(placementsBefore), to(placementsAfter), motions(from.size())
    {
    }

    const Motion& of(int block)
    {
        const auto index = static_cast<std::size_t>(block);
        if (!motions[index])
        {
            const Turn<Dim> turn = turnBetween(from[index].rotation, to[index].rotation);
            motions[index].emplace(
                Motion{to[index].translation - from[index].translation, turn, Swing<Dim>(turn)});
        }
        return *motions[index];
    }

private:
    const std::vector<Placement<Dim>>& from;
    const std::vector<Placement<Dim>>& to;
    std::vector<std::optional<Motion>> motions;
};

/// By how far the neighbour has slid past the block at a contact point of the step, along the edge or face
/// there [m]. \param motions from the start of the step to where it leads \param columns of the point, whose
/// directions the shear has
Shear<2> slip(const Step<2>& step, BlockMotions<2>& motions, std::size_t point,
              const ConeColumns<3, 2>& columns);
Shear<3> slip(const Step<3>& step, BlockMotions<3>& motions, std::size_t point,
              const ConeColumns<6, 3>& columns);

/// What finite rotations change in the balance of angular momentum of a step. In the plane nothing. In space,
/// with W the angular velocity in axes that turn with a block, R0 and R1 its orientations and J its inertia
/// in these axes, the theta method (Simo & Wong 1991 for theta 1/2) is
///
///     R1 J W1 - R0 J W0 = dt m,    R1 = exp(r) R0,    r = dt R0 (theta W1 + (1 - theta) W0).
///
/// The axis of r is the same seen from R0 and from R1, so that r'm is the work of the moments m to the last
/// digits, and the kinetic energy changes by r'm - (theta - 1/2) |W1 - W0|_J^2, as for translations. With w =
/// R0 W and J0 = R0 J R0' the first equation is
///
///     J0 (w1 - w0) = dt m + (exp(-r) - 1)(J0 w0 + dt m),
///
/// that of the program but for the last term, the gyroscopic one, which is put into its load over dt. Damping
/// by a takes a exp(theta r) J0 r, a times the momentum where theta weighs it, from the right hand side of
/// the first one; seen from R0, and with theta 1, that is the a J0 r of the program. With theta below 1 the
/// rest, a (exp((theta - 1) r) - 1) J0 r, is put into the load, too: without it damping turns momenta, to
/// first order in the step. \return the largest change that makes in the rotations, times the block size [m]
inline double turnMomenta(const Step<2>&, const Eigen::VectorXd&, const Eigen::VectorXd&, StepProgram<2>&)
{
    return 0;
}
double turnMomenta(const Step<3>& step, const Eigen::VectorXd& displacement,
                   const Eigen::VectorXd& contactForce, StepProgram<3>& program);

/// Corrects the linear prediction of the gaps and slips of moving contacts; see Relinearisation. The step is
/// not owned.
///
/// The angular momentum of a block about a fixed point changes over a step by c1 x m v1 - c0 x m v0 + J (w1 -
/// w0), c its mass centre. With c1 - c0 = dt (theta v1 + (1 - theta) v0) the first two are (c0 + (1 - theta)
/// (c1 - c0)) x m (v1 - v0): lever arms are to be taken there. For theta 1 these are the arms at the start,
/// for theta 1/2 those halfway.
///
/// Blocks that turn together by a finite angle do not slide on each other, but by the linear prediction they
/// do, in proportion to the square of the angle; and where many blocks do so, locked together, no forces
/// would make that slip vanish.
template<int Dim>
Relinearisation<Dim> movingContactGeometry(const Step<Dim>& step);

} // namespace drystone
