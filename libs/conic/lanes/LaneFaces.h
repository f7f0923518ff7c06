// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The text of the lane kernels, second part: forces on bodies and motions of points, face by face. Along a
/// face they are summed up in a frame of its own.
#pragma once

#include "conic/lanes/LaneFactor.h"

namespace drystone
{
namespace
{

template<int lanes>
struct LaneFaces : LaneFactor<lanes>
{
    using Base = LaneFactor<lanes>;
    using Base::all;
    using Base::at;
    using Base::graph;
    using Base::rows;
    using typename Base::Number;

    static constexpr double proximal = 1e-9; ///< as in interiorPoint/Newton.h

    explicit LaneFaces(LaneTask& ofTask)
        : Base(ofTask), numbers(ofTask.numbers), rays(2L * ofTask.graph.points)
    {
    }

    const LaneNumbers numbers;
    const long rays;
    Number alpha = {};

    /// How the bodies of a face move to each other: normal and tangential closing at its origin, rotations.
    struct Closing
    {
        Number normal;
        Number tangent; ///< times mu
        Number first;
        Number second;
    };
    Closing closingOf(const double* y, const LaneFace& face) const
    {
        const double* one = y + 3L * lanes * face.first;
        const double* other = y + 3L * lanes * face.second;
        const Number d0 = at(one, 0) - at(other, 0);
        const Number d1 = at(one, 1) - at(other, 1);
        const Number first = at(one, 2);
        const Number second = at(other, 2);
        return {face.normal[0] * d0 + face.normal[1] * d1,
                at(numbers.friction, face.friction)
                    * (face.tangent[0] * d0 + face.tangent[1] * d1 + face.tangentMoment[0] * first
                       + face.tangentMoment[1] * second),
                first, second};
    }
    static Number along(const LanePoint& point, const Closing& closing, int ray)
    {
        const Number normal =
            closing.normal + point.normalMoment[0] * closing.first + point.normalMoment[1] * closing.second;
        return ray == 0 ? normal + closing.tangent : normal - closing.tangent;
    }

    /// The forces of the rays of a face, summed up in its frame.
    struct Force
    {
        Number normal = {};
        Number tangent = {}; ///< over mu
        Number first = {};
        Number second = {};

        void add(const LanePoint& point, Number one, Number other)
        {
            const Number sum = one + other;
            normal += sum;
            tangent += one - other;
            first += point.normalMoment[0] * sum;
            second += point.normalMoment[1] * sum;
        }
    };
    void addTo(double* rowsOfAll, const LaneFace& face, const Force& force) const
    {
        double* one = rowsOfAll + 3L * lanes * face.first;
        double* other = rowsOfAll + 3L * lanes * face.second;
        const Number shear = at(numbers.friction, face.friction) * force.tangent;
        const Number f0 = face.normal[0] * force.normal + face.tangent[0] * shear;
        const Number f1 = face.normal[1] * force.normal + face.tangent[1] * shear;
        at(one, 0) += f0;
        at(one, 1) += f1;
        at(one, 2) += force.first + face.tangentMoment[0] * shear;
        at(other, 0) -= f0;
        at(other, 1) -= f1;
        at(other, 2) += force.second + face.tangentMoment[1] * shear;
    }

    /// function(ray, what the motion y closes of it), for both rays of each point.
    template<class Function>
    void forClosings(const double* y, const Function& function) const
    {
        for (int index = 0; index < graph.faces; ++index)
        {
            const LaneFace& face = graph.face[index];
            const Closing closing = closingOf(y, face);
            for (long point = face.begin; point < face.end; ++point)
            {
                function(2 * point, along(graph.point[point], closing, 0));
                function(2 * point + 1, along(graph.point[point], closing, 1));
            }
        }
    }
    /// rows += B function(ray).
    template<class Function>
    void forForces(double* rowsOfAll, const Function& function) const
    {
        for (int index = 0; index < graph.faces; ++index)
        {
            const LaneFace& face = graph.face[index];
            Force force;
            for (long point = face.begin; point < face.end; ++point)
            {
                const Number one = function(2 * point);
                force.add(graph.point[point], one, function(2 * point + 1));
            }
            addTo(rowsOfAll, face, force);
        }
    }

    /// f + alpha L.
    void setLoads(double* rowsOfAll) const
    {
        for (long row = 0; row < rows; ++row)
        {
            at(rowsOfAll, row) = at(numbers.load, row) + alpha * at(numbers.liveLoad, row);
        }
    }
    void setZero(double* rowsOfAll) const
    {
        for (long row = 0; row < rows + 3; ++row)
        {
            at(rowsOfAll, row) = Number{};
        }
    }

    /// S = proximal + sum of d b b', d = s/z.
    void assemble()
    {
        for (long place = 0; place < 9L * graph.blocks; ++place)
        {
            at(numbers.blocks, place) = Number{};
        }
        for (int body = 0; body < graph.bodies; ++body)
        {
            double* block = Base::blockAt(numbers.blocks, graph.columnStart[body]);
            at(block, 0) = at(block, 4) = at(block, 8) = all(proximal);
        }
        for (int index = 0; index < graph.faces; ++index)
        {
            if (graph.face[index].firstDiagonal >= 0)
            {
                assembleFace(graph.face[index]);
            }
        }
    }

private:
    /// With the weight [nn nt; nt tt] of each point and a, b the moments of its normal force.
    void assembleFace(const LaneFace& face)
    {
        const LaneNumbers to = numbers;
        Number sum = {}, difference = {}, a = {}, b = {}, aDifference = {}, bDifference = {}, aa = {},
               ab = {}, bb = {};
        for (long point = face.begin; point < face.end; ++point)
        {
            const double* arm = graph.point[point].normalMoment;
            const Number one = at(to.s, 2 * point) * at(to.inverseZ, 2 * point);
            const Number other = at(to.s, 2 * point + 1) * at(to.inverseZ, 2 * point + 1);
            const Number both = one + other;
            const Number less = one - other;
            sum += both;
            difference += less;
            a += arm[0] * both;
            b += arm[1] * both;
            aDifference += arm[0] * less;
            bDifference += arm[1] * less;
            aa += arm[0] * arm[0] * both;
            ab += arm[0] * arm[1] * both;
            bb += arm[1] * arm[1] * both;
        }
        const Number mu = at(to.friction, face.friction);
        const Number nt = mu * difference;
        const Number tt = mu * mu * sum;
        const double n0 = face.normal[0], n1 = face.normal[1], t0 = face.tangent[0], t1 = face.tangent[1];
        const double p = face.tangentMoment[0], q = face.tangentMoment[1];
        // Of normal force and shear, on force and moments.
        const Number x0 = n0 * sum + t0 * nt;
        const Number y0 = n0 * nt + t0 * tt;
        const Number x1 = n1 * sum + t1 * nt;
        const Number y1 = n1 * nt + t1 * tt;
        const Number aShear = mu * aDifference;
        const Number bShear = mu * bDifference;
        const Number x2 = a + p * nt;
        const Number y2 = aShear + p * tt;
        const Number x3 = b + q * nt;
        const Number y3 = bShear + q * tt;
        const Number p00 = x0 * n0 + y0 * t0;
        const Number p10 = x1 * n0 + y1 * t0;
        const Number p11 = x1 * n1 + y1 * t1;
        const Number p20 = x2 * n0 + y2 * t0;
        const Number p21 = x2 * n1 + y2 * t1;
        double* block = Base::blockAt(to.blocks, face.firstDiagonal);
        at(block, 0) += p00;
        at(block, 1) += p10;
        at(block, 2) += p20;
        at(block, 4) += p11;
        at(block, 5) += p21;
        at(block, 8) += aa + p * aShear + p * y2;
        if (face.coupling < 0)
        {
            return;
        }
        const Number p30 = x3 * n0 + y3 * t0;
        const Number p31 = x3 * n1 + y3 * t1;
        block = Base::blockAt(to.blocks, face.coupling);
        at(block, 0) -= p00;
        at(block, 1) -= p10;
        at(block, 2) += p30;
        at(block, 3) -= p10;
        at(block, 4) -= p11;
        at(block, 5) += p31;
        at(block, 6) -= p20;
        at(block, 7) -= p21;
        at(block, 8) += ab + q * aShear + p * y3;
        block = Base::blockAt(to.blocks, face.secondDiagonal);
        at(block, 0) += p00;
        at(block, 1) += p10;
        at(block, 2) -= p30;
        at(block, 4) += p11;
        at(block, 5) -= p31;
        at(block, 8) += bb + q * bShear + q * y3;
    }
};

} // namespace
} // namespace drystone
