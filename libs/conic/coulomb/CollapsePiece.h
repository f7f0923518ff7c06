// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One contact point on a collapse path: the piece of its law that it is on, and how far it goes before it
/// leaves it. Internal to CollapsePath.
#pragma once

#include "conic/ConeProgram.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drystone
{

/// Where a piece of the law ends.
enum class Boundary : char
{
    none,
    opening,  ///< w_n = -T
    crushing, ///< w_n = N
    sliding,  ///< |w_t| = C + mu c_n
    turning   ///< w_t = 0 of a point that is open and dilates: the piece goes on with the opposite slip
};

/// The force c of a point as a function of w, its force at the start of the path plus stiffness times
/// closing (Alart & Curnier 1991, with the strengths of the point): where it presses without sliding c = w;
/// else, with d = w_t/|w_t| and slip lambda times stiffness,
///
///     c_t = (C + mu c_n) d,    c_n = w_n + psi lambda put between -T and N,    lambda = |w_t| - |c_t| >= 0:
///
/// a slip opens by psi times itself, psi = 0 being Coulomb's law, psi = mu the associative one. The law is
/// one smooth function on each piece; with one component of shear it is linear there.
template<int Forces>
struct CollapsePiece
{
    static constexpr int shears = Forces - 1;
    using Force = Eigen::Matrix<double, Forces, 1>;
    using Shear = Eigen::Matrix<double, shears, 1>;
    using Matrix = Eigen::Matrix<double, Forces, Forces>;

    enum class Normal : char
    {
        open,
        presses,
        crushes
    };

    double friction = 0;
    double dilatancy = 0; ///< psi
    Strength strength;
    Normal normal = Normal::presses;
    bool isSliding = false;

    static double shearOf(const Force& w)
    {
        if constexpr (shears == 1)
        {
            return std::abs(w[1]); // no root: each piece of a path evaluates all points
        }
        return w.template tail<shears>().norm();
    }

    /// The piece that w, within the limits or at them, lies on.
    void find(const Force& w)
    {
        normal = w[0] <= -strength.tension   ? Normal::open
                 : w[0] >= strength.crushing ? Normal::crushes
                                             : Normal::presses;
        isSliding = isFree() || shearOf(w) >= strength.cohesion + friction * w[0];
    }

    /// Shear at which a point slides whose normal force would be that of w: of its bound where it has one.
    /// Below zero, of a point that dilates, where the slip alone makes it press.
    double slidingLimit(const Force& w) const { return strength.cohesion + friction * boundOr(w[0]); }

    double normalForce(const Force& w) const
    {
        return normal == Normal::presses && isSliding
                   ? (w[0] + dilatancy * (shearOf(w) - strength.cohesion)) / (1 + friction * dilatancy)
                   : boundOr(w[0]);
    }

    /// Whether the point neither presses nor holds any shear: it has no say.
    bool isFree() const { return normal == Normal::open && strength.cohesion <= friction * strength.tension; }

    Force force(const Force& w) const
    {
        Force result = w;
        result[0] = normalForce(w);
        if (isSliding)
        {
            const double size = shearOf(w);
            const double most = std::max(0.0, strength.cohesion + friction * result[0]);
            result.template tail<shears>() *= size > 0 ? most / size : 0;
        }
        return result;
    }

    /// dc/dw
    Matrix derivative(const Force& w) const
    {
        Matrix result = Matrix::Zero();
        if (isFree())
        {
            return result;
        }
        if (!isSliding)
        {
            result.setIdentity();
            result(0, 0) = normal == Normal::presses ? 1 : 0;
            return result;
        }
        const double size = shearOf(w);
        const Shear direction = size > 0 ? Shear(w.template tail<shears>() / size) : Shear(Shear::Zero());
        if (normal == Normal::presses)
        {
            result(0, 0) = 1;
            result.template topRightCorner<1, shears>() = dilatancy * direction.transpose();
            result.template topRows<1>() /= 1 + friction * dilatancy;
            result.template bottomRows<shears>() = friction * direction * result.template topRows<1>();
        }
        if (shears > 1 && size > 0)
        {
            result.template bottomRightCorner<shears, shears>() +=
                std::max(0.0, strength.cohesion + friction * normalForce(w)) / size
                * (Eigen::Matrix<double, shears, shears>::Identity() - direction * direction.transpose());
        }
        return result;
    }

    /// Rate of what is positive on the near side of a boundary of this piece and negative beyond.
    double rateWithin(Boundary boundary, const Force& w, const Force& rate) const
    {
        const double shearRate = rateOfShear(w, rate);
        if (boundary == Boundary::sliding)
        {
            const double beyond = shearRate - (normal == Normal::presses ? friction * rate[0] : 0);
            return isSliding ? beyond : -beyond;
        }
        const double normalRate = rate[0] + (isSliding ? dilatancy * shearRate : 0);
        const bool isUpwards = (boundary == Boundary::opening) == (normal == Normal::presses);
        return isUpwards ? normalRate : -normalRate;
    }

    /// Crosses a boundary.
    void cross(Boundary boundary)
    {
        if (boundary == Boundary::sliding)
        {
            isSliding = !isSliding;
        }
        else if (boundary != Boundary::turning)
        {
            normal = normal != Normal::presses       ? Normal::presses
                     : boundary == Boundary::opening ? Normal::open
                                                     : Normal::crushes;
        }
        isSliding = isSliding || isFree();
    }

    /// Takes a point that a step has taken beyond the cone, or opened, to where it is. \return whether it was
    bool returnToLaw(const Force& w, double tolerance)
    {
        const CollapsePiece before = *this;
        if (normal == Normal::presses && normalForce(w) < -strength.tension - tolerance)
        {
            cross(Boundary::opening);
        }
        if (!isSliding && shearOf(w) > slidingLimit(w) + tolerance)
        {
            cross(Boundary::sliding);
        }
        return before.normal != normal || before.isSliding != isSliding;
    }

    struct Exit
    {
        double distance = std::numeric_limits<double>::infinity();
        Boundary boundary = Boundary::none;
    };

    /// The first boundary along w + s rate, s >= 0. \param still rates that are nothing but rounding
    /// \param nearest an exit of another point, returned where this one's is farther
    Exit exit(const Force& w, const Force& rate, double still, const Exit& nearest = {}) const
    {
        Exit result = nearest;
        const auto meet = [&](double room, double speed, Boundary boundary)
        {
            // A division only for what is nearest so far, which few of the points are.
            if (speed < -still && std::max(0.0, room) < result.distance * -speed)
            {
                result = {std::max(0.0, room) / -speed, boundary};
            }
        };
        const double shearRate = rateOfShear(w, rate);
        const double beyond = isSliding ? dilatancy * (shearOf(w) - slidingLimit(w)) : 0;
        const double beyondRate = rate[0] + (isSliding ? dilatancy * shearRate : 0);
        switch (normal)
        {
        case Normal::open:
            meet(-strength.tension - w[0] - beyond, -beyondRate, Boundary::opening);
            break;
        case Normal::crushes:
            meet(w[0] + beyond - strength.crushing, beyondRate, Boundary::crushing);
            break;
        case Normal::presses:
            meet((normalForce(w) + strength.tension) * (isSliding ? 1 + friction * dilatancy : 1), beyondRate,
                 Boundary::opening);
            if (strength.isBounded())
            {
                meet((strength.crushing - normalForce(w)) * (isSliding ? 1 + friction * dilatancy : 1),
                     -beyondRate, Boundary::crushing);
            }
            break;
        }
        if (isFree())
        {
            if (shears == 1 && dilatancy > 0)
            {
                meet(shearOf(w), shearRate, Boundary::turning);
            }
            return result;
        }
        const double most = slidingLimit(w);
        const double mostRate = normal == Normal::presses ? friction * rate[0] : 0;
        if constexpr (shears == 1)
        {
            if (isSliding)
            {
                const double sense = w[1] < 0 ? -1 : 1;
                meet(sense * w[1] - most, sense * rate[1] - mostRate, Boundary::sliding);
            }
            else
            {
                meet(most - w[1], mostRate - rate[1], Boundary::sliding);
                meet(most + w[1], mostRate + rate[1], Boundary::sliding);
            }
        }
        else
        {
            exitCone(w, rate, still, most, mostRate, result);
        }
        return result;
    }

private:
    double boundOr(double value) const
    {
        return normal == Normal::open      ? -strength.tension
               : normal == Normal::crushes ? strength.crushing
                                           : value;
    }

    static double rateOfShear(const Force& w, const Force& rate)
    {
        constexpr double none = 1e-13; // of the largest load
        const double size = shearOf(w);
        if constexpr (shears == 1)
        {
            return size > none ? std::copysign(1.0, w[1]) * rate[1] : std::abs(rate[1]);
        }
        return size > none ? w.template tail<shears>().dot(rate.template tail<shears>()) / size
                           : rate.template tail<shears>().norm();
    }

    /// The root of |w_t + s w_t'| = l + s l' at which the point leaves its side of the cone.
    void exitCone(const Force& w, const Force& rate, double still, double most, double mostRate,
                  Exit& result) const
    {
        const Shear shear = w.template tail<shears>();
        const Shear shearRate = rate.template tail<shears>();
        // room = a s^2 + 2 b s + c, positive within
        const double sense = isSliding ? 1 : -1;
        const double a = sense * (shearRate.squaredNorm() - mostRate * mostRate);
        const double b = sense * (shear.dot(shearRate) - most * mostRate);
        const double size = shear.norm();
        const double c = sense * (size - most) * (size + most);
        const double speed = b / std::max({size, most, std::numeric_limits<double>::min()});
        const double none = std::numeric_limits<double>::infinity();
        double distance = none;
        if (c <= 0)
        {
            distance = speed < -still ? 0 : none;
            if (distance == none && a < 0 && b > 0)
            {
                distance = -2 * b / a; // it goes in and leaves again
            }
        }
        else
        {
            const double discriminant = b * b - a * c;
            if (discriminant >= 0)
            {
                const double root = std::sqrt(discriminant);
                // The lesser positive root, without cancellation: c over the larger of the two sums.
                if (b < 0)
                {
                    distance = c / (-b + root);
                }
                else if (a < 0)
                {
                    distance = (b + root) / -a;
                }
            }
            if (!(std::max(std::abs(mostRate), shearRate.norm()) > still))
            {
                distance = none;
            }
        }
        if (distance < result.distance)
        {
            result = {distance, Boundary::sliding};
        }
    }
};

} // namespace drystone
