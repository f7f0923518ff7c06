// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// From forces, openings and displacements of a cone program to those of its form, and back.
#include "conic/form/Form.h"
#include "conic/form/PointCones.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// Whether a point, of a program without strength, has a ray along its normal in addition to its cone.
template<int Rows>
bool hasNormalRay(const Form<Rows>& form, std::size_t point)
{
    const int first = form.firstRay[point];
    const int rays = form.firstRay[point + 1] - first;
    return Rows == 3 ? rays == 3 && form.directions[static_cast<std::size_t>(first) + 2][1] == 0
                     : rays == 1 && form.firstRound[point + 1] > form.firstRound[point];
}

/// Forces of the cones of one point of the plane for its normal force and its shear without what cohesion
/// holds, in units of the form.
void setPressing(const Form<3>& form, int point, double mu, double normal, double shear, Eigen::VectorXd& s)
{
    const int first = form.firstRay[point];
    if (hasNormalRay(form, static_cast<std::size_t>(point)))
    {
        const double sliding = std::min(std::abs(shear) / mu, std::max(0.0, normal)); // its normal force
        s[shear > 0 ? first : first + 1] = sliding / form.directions[first].x();
        s[first + 2] = std::max(0.0, normal - sliding);
    }
    else if (mu > 0)
    {
        const double length = 1 / form.directions[first].x();
        s[first] = std::max(0.0, length * (normal + shear / mu) / 2);
        s[first + 1] = std::max(0.0, length * (normal - shear / mu) / 2);
    }
    else
    {
        s[first] = std::max(0.0, normal);
    }
}

void setPressing(const Form<6>& form, int point, double mu, double normal, const Eigen::Vector2d& shear,
                 Eigen::VectorXd& s)
{
    const auto at = static_cast<std::size_t>(point);
    if (!(mu > 0))
    {
        s[form.firstRay[at]] = std::max(0.0, normal);
        return;
    }
    double pressing = normal;
    if (hasNormalRay(form, at))
    {
        pressing = std::min(shear.norm() / mu, std::max(0.0, normal));
        s[form.firstRay[at]] = std::max(0.0, normal - pressing);
    }
    const int round = form.firstRound[at];
    const Eigen::Vector3d& scale = form.roundScales[static_cast<std::size_t>(round)];
    const Eigen::Vector3d force(pressing / scale[0], shear[0] / scale[1], shear[1] / scale[2]);
    s.segment<3>(form.cones().at(round)) = projectOntoCone(force).point;
}

/// What of a point's shear cohesion holds, set in its cone; `alone` in units of the form.
double holdShear(const Form<3>& form, int point, double alone, double shear, Eigen::VectorXd& s)
{
    const double held = alone > 0 ? std::clamp(shear, -alone, alone) : 0;
    if (alone > 0)
    {
        s[form.firstRay[static_cast<std::size_t>(point) + 1] - 1] = held + alone;
    }
    return held;
}

Eigen::Vector2d holdShear(const Form<6>& form, int point, double alone, const Eigen::Vector2d& shear,
                          Eigen::VectorXd& s)
{
    if (!(alone > 0))
    {
        return Eigen::Vector2d::Zero();
    }
    const double size = shear.norm();
    const Eigen::Vector2d held = size > alone ? Eigen::Vector2d(shear * (alone / size)) : shear;
    const Eigen::Index at = form.cones().at(form.firstRound[static_cast<std::size_t>(point) + 1] - 1);
    s.segment<3>(at) << alone, held;
    return held;
}

/// Openings of the one point of the plane, or of space, in units of the form.
Eigen::Vector2d pointOpening(const Form<3>& form, std::size_t point, const Eigen::VectorXd& z)
{
    const int first = form.firstRay[point];
    const Eigen::Vector2d& direction = form.directions[static_cast<std::size_t>(first)];
    if (form.firstRay[point + 1] - first == 1)
    {
        return {z[first] / direction.x(), 0};
    }
    if (hasNormalRay(form, point))
    {
        return {z[first + 2], (z[first] - z[first + 1]) / (2 * direction.y())};
    }
    // The directions mirror one another: z = (n u_n + t u_t, n u_n - t u_t).
    return {(z[first] + z[first + 1]) / (2 * direction.x()), (z[first] - z[first + 1]) / (2 * direction.y())};
}

Eigen::Vector3d pointOpening(const Form<6>& form, std::size_t point, const Eigen::VectorXd& z)
{
    Eigen::Vector3d opening = Eigen::Vector3d::Zero();
    if (form.firstRound[point + 1] > form.firstRound[point])
    {
        const int round = form.firstRound[point];
        opening = z.segment<3>(form.cones().at(round))
                      .cwiseQuotient(form.roundScales[static_cast<std::size_t>(round)]);
    }
    if (form.firstRay[point + 1] > form.firstRay[point])
    {
        opening[0] = z[form.firstRay[point]];
    }
    return opening;
}

} // namespace

template<int Rows, int Forces>
Eigen::VectorXd conesOf(const ConeProgram<Rows, Forces>& program, const Form<Rows>& form,
                        const Eigen::VectorXd& contactForce)
{
    Eigen::VectorXd s = Eigen::VectorXd::Zero(form.cones().size());
    for (int point = 0; point < program.points(); ++point)
    {
        const double alone = shearAlone(program, point) / form.scaling.load;
        const double tension = program.strengthOf(static_cast<std::size_t>(point)).tension;
        const double normal = (contactForce[Forces * point] + tension) / form.scaling.load;
        if constexpr (Forces == 2)
        {
            const double whole = contactForce[2 * point + 1] / form.scaling.load;
            const double shear = whole - holdShear(form, point, alone, whole, s);
            setPressing(form, point, program.friction[point], normal, shear, s);
        }
        else
        {
            const Eigen::Vector2d whole = contactForce.segment<2>(3 * point + 1) / form.scaling.load;
            const Eigen::Vector2d shear = whole - holdShear(form, point, alone, whole, s);
            setPressing(form, point, program.friction[point], normal, shear, s);
        }
    }
    return s;
}

template<int Rows>
Eigen::VectorXd conesOfOpening(const Form<Rows>& form, const Eigen::VectorXd& opening)
{
    constexpr int forces = Form<Rows>::forces;
    Eigen::VectorXd z = Eigen::VectorXd::Zero(form.cones().size());
    for (Eigen::Index point = 0; forces * point < opening.size(); ++point)
    {
        const auto at = static_cast<std::size_t>(point);
        const auto ofPoint = opening.segment<forces>(forces * point);
        for (int ray = form.firstRay[at]; ray < form.firstRay[at + 1]; ++ray)
        {
            z[ray] = form.directions[static_cast<std::size_t>(ray)].dot(ofPoint) / form.scaling.displacement;
        }
        for (int round = form.firstRound[at]; round < form.firstRound[at + 1]; ++round)
        {
            z.segment<forces>(form.cones().at(round)) =
                form.roundScales[static_cast<std::size_t>(round)].template head<forces>().cwiseProduct(
                    ofPoint)
                / form.scaling.displacement;
        }
    }
    return z;
}

template<int Rows>
Eigen::VectorXd openingOf(const Form<Rows>& form, const Eigen::VectorXd& z)
{
    constexpr int forces = Form<Rows>::forces;
    const std::size_t points = form.firstRay.size() - 1;
    Eigen::VectorXd opening(forces * static_cast<Eigen::Index>(points));
    for (std::size_t point = 0; point < points; ++point)
    {
        opening.segment<forces>(forces * static_cast<Eigen::Index>(point)) = pointOpening(form, point, z);
    }
    return form.scaling.displacement * opening;
}

template<int Rows>
Eigen::VectorXd rowsOf(const Form<Rows>& form, const Eigen::VectorXd& displacement)
{
    Eigen::VectorXd y = Eigen::VectorXd::Zero(form.rows());
    for (int body = 0; body < form.bodies; ++body)
    {
        Eigen::Matrix<double, Rows, 1> rows = displacement.segment<Rows>(Rows * body);
        rows.template tail<Form<Rows>::moments>() *= form.scaling.lever;
        y.segment<Rows>(Rows * form.position[body]) = rows / form.scaling.displacement;
    }
    return y;
}

template<int Rows, int Forces, class Scalar>
ConeSolution solutionOf(const ConeProgram<Rows, Forces>& program, const Form<Rows>& form,
                        const VectorOf<Scalar>& s, const VectorOf<Scalar>& y, const Scalar& multiplier)
{
    const typename Form<Rows>::Scaling& scaling = form.scaling;
    ConeSolution solution;
    solution.multiplier = static_cast<double>(multiplier) * scaling.load / scaling.liveLoad;
    solution.contactForce = Eigen::VectorXd::Zero(Forces * program.points());
    for (int point = 0; point < program.points(); ++point)
    {
        Eigen::Matrix<Scalar, Forces, 1> force = origin(program, point).template cast<Scalar>();
        for (int ray = form.firstRay[point]; ray < form.firstRay[point + 1]; ++ray)
        {
            force += form.directions[ray].template cast<Scalar>() * s[ray] * Scalar(scaling.load);
        }
        for (int round = form.firstRound[point]; round < form.firstRound[point + 1]; ++round)
        {
            for (int component = 0; component < Forces; ++component)
            {
                force[component] += Scalar(form.roundScales[round][component])
                                    * s[form.cones().at(round) + component] * Scalar(scaling.load);
            }
        }
        solution.contactForce.segment<Forces>(Forces * point) = force.template cast<double>();
    }
    solution.displacement = Eigen::VectorXd::Zero(Rows * program.bodies);
    for (int body = 0; body < program.bodies; ++body)
    {
        Eigen::Matrix<double, Rows, 1> rows =
            y.template segment<Rows>(Rows * form.position[body]).template cast<double>()
            * scaling.displacement;
        rows.template tail<Form<Rows>::moments>() /= scaling.lever;
        solution.displacement.segment<Rows>(Rows * body) = rows;
    }
    return solution;
}

template Eigen::VectorXd conesOf(const PlaneConeProgram&, const Form<3>&, const Eigen::VectorXd&);
template Eigen::VectorXd conesOf(const SpaceConeProgram&, const Form<6>&, const Eigen::VectorXd&);
template Eigen::VectorXd conesOfOpening(const Form<3>&, const Eigen::VectorXd&);
template Eigen::VectorXd conesOfOpening(const Form<6>&, const Eigen::VectorXd&);
template Eigen::VectorXd openingOf(const Form<3>&, const Eigen::VectorXd&);
template Eigen::VectorXd openingOf(const Form<6>&, const Eigen::VectorXd&);
template Eigen::VectorXd rowsOf(const Form<3>&, const Eigen::VectorXd&);
template Eigen::VectorXd rowsOf(const Form<6>&, const Eigen::VectorXd&);
template ConeSolution solutionOf(const PlaneConeProgram&, const Form<3>&, const VectorOf<double>&,
                                 const VectorOf<double>&, const double&);
template ConeSolution solutionOf(const SpaceConeProgram&, const Form<6>&, const VectorOf<double>&,
                                 const VectorOf<double>&, const double&);
template ConeSolution solutionOf(const PlaneConeProgram&, const Form<3>&, const VectorOf<DoubleDouble>&,
                                 const VectorOf<DoubleDouble>&, const DoubleDouble&);
template ConeSolution solutionOf(const SpaceConeProgram&, const Form<6>&, const VectorOf<DoubleDouble>&,
                                 const VectorOf<DoubleDouble>&, const DoubleDouble&);

} // namespace drystone
