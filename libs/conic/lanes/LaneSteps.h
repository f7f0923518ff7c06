// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The text of the lane kernels, third part: what an iteration does with all rays in turn. Steps and
/// corrections are those of interiorPoint/{Newton, Centring, StepLength}.h, as ratios: with ds/s and dz/z
/// Newton's equations s dz + z ds = c become the sum of the two, and how far a step may go is their least.
#pragma once

#include "conic/lanes/LaneFaces.h"

namespace drystone
{
namespace
{

template<int lanes>
struct LaneSteps : LaneFaces<lanes>
{
    using Base = LaneFaces<lanes>;
    using Base::addTo;
    using Base::all;
    using Base::along;
    using Base::at;
    using Base::closingOf;
    using Base::forClosings;
    using Base::forForces;
    using Base::graph;
    using Base::larger;
    using Base::numbers;
    using Base::rows;
    using Base::setZero;
    using Base::sizeOf;
    using Base::smaller;
    using typename Base::Closing;
    using typename Base::Force;
    using typename Base::Mask;
    using typename Base::Number;

    static constexpr double farthestStep = 1.02; ///< as in interiorPoint/StepLength.h
    static constexpr double leastAnswer = 0.2;   ///< as in interiorPoint/Centring.cpp

    using Base::Base;

    // Of the iterate, and of what is left of the optimality conditions.
    Number complementarity = {}; ///< s'z
    Number missing = {};         ///< of the balance, the largest
    Number misfit = {};          ///< of the openings, the largest

    // The step in hand: how far it goes, and the weights of its last correction.
    Number stepS = {};
    Number stepZ = {};
    Number weightS = {};
    Number weightZ = {};
    Number primal = {}; ///< longest steps
    Number dual = {};

    /// Goes the step that is in hand, measures what is left there, and prepares the next one: in `balance`
    /// and `step` the balance and the right side of the predictor.
    void moveAndMeasure()
    {
        Base::setLoads(numbers.balance);
        setZero(numbers.step);
        const LaneNumbers to = numbers;
        const Number ofS = weightS;
        const Number ofZ = weightZ;
        Number products = {};
        Number apart = {};
        const auto advance = [&](long ray, Number closing, Number& force)
        {
            Number s = at(to.s, ray);
            Number z = at(to.z, ray);
            // To the last bit as where the correction has become part of the step for another lane's sake.
            s += s * (stepS * (at(to.ratioS, ray) + ofS * at(to.correctionS, ray)));
            z += z * (stepZ * (at(to.ratioZ, ray) + ofZ * at(to.correctionZ, ray)));
            at(to.s, ray) = s;
            at(to.z, ray) = z;
            force = s;
            const Number product = s * z;
            products += product;
            apart = larger(apart, sizeOf(closing + z));
            const Number both = s + z;
            const Number inverse = 1 / (product * both); // one division for all of them
            const Number ofProduct = inverse * both;
            at(to.inverseProduct, ray) = ofProduct;
            at(to.inverseZ, ray) = s * ofProduct;
            at(to.leverage, ray) = 0.5 * s * (inverse * product);
            return s * s * ofProduct * closing;
        };
        for (int index = 0; index < graph.faces; ++index)
        {
            const LaneFace& face = graph.face[index];
            const Closing closing = closingOf(to.y, face);
            Force force;
            Force weighted;
            for (long point = face.begin; point < face.end; ++point)
            {
                const LanePoint& arms = graph.point[point];
                Number s[2];
                const Number one = advance(2 * point, along(arms, closing, 0), s[0]);
                weighted.add(arms, one, advance(2 * point + 1, along(arms, closing, 1), s[1]));
                force.add(arms, s[0], s[1]);
            }
            addTo(to.step, face, weighted);
            addTo(to.balance, face, {-force.normal, -force.tangent, -force.first, -force.second});
        }
        for (long row = 0; row < rows; ++row)
        {
            at(to.step, row) = at(to.balance, row) - at(to.step, row);
        }
        complementarity = products;
        misfit = apart;
        missing = Base::largest(to.balance);
    }

    /// Newton's step straight for the optimum, ds = D B'(y + dy) and dz = -z - B'(y + dy), with y + dy in
    /// `target`. \return s'z at the ends of the longest steps
    Number predict()
    {
        const LaneNumbers to = numbers;
        Number leastS = {};
        Number leastZ = {};
        Number ofS = {};
        Number ofZ = {};
        Number ofBoth = {};
        forClosings(to.target,
                    [&](long ray, Number closing)
                    {
                        const Number ds = at(to.inverseZ, ray) * closing;
                        const Number dz = -1 - ds;
                        at(to.ratioS, ray) = ds;
                        at(to.ratioZ, ray) = dz;
                        leastS = smaller(leastS, ds);
                        leastZ = smaller(leastZ, dz);
                        const Number product = at(to.s, ray) * at(to.z, ray);
                        ofS += product * ds;
                        ofZ += product * dz;
                        ofBoth += product * (ds * dz);
                    });
        primal = stepFor(leastS);
        dual = stepFor(leastZ);
        const Number a = smaller(primal, all(1));
        const Number b = smaller(dual, all(1));
        return complementarity + a * ofS + b * ofZ + a * b * ofBoth;
    }

    /// Mehrotra's corrector: its pull, in `correctionS`, and its right side, in `correction`.
    void pullToPath(Number aim)
    {
        const LaneNumbers to = numbers;
        setZero(to.correction);
        forForces(to.correction,
                  [&](long ray)
                  {
                      const Number ds = at(to.ratioS, ray);
                      const Number dz = -1 - ds;
                      const Number pull = (aim * at(to.inverseProduct, ray) - ds * dz)
                                          * inverseAnswer(at(to.leverage, ray), 1 + ds, 1 + dz);
                      at(to.correctionS, ray) = pull;
                      return -at(to.s, ray) * pull;
                  });
    }

    /// Gondzio's, for the steps that are asked for; the last correction becomes part of the step.
    void pullIntoBox(Number least, Number most, Number primalAsked, Number dualAsked)
    {
        const LaneNumbers to = numbers;
        const Number ofS = weightS;
        const Number ofZ = weightZ;
        setZero(to.correction);
        forForces(to.correction,
                  [&](long ray)
                  {
                      const Number ds = at(to.ratioS, ray) + ofS * at(to.correctionS, ray);
                      const Number dz = at(to.ratioZ, ray) + ofZ * at(to.correctionZ, ray);
                      at(to.ratioS, ray) = ds;
                      at(to.ratioZ, ray) = dz;
                      const Number force = 1 + primalAsked * ds;
                      const Number opening = 1 + dualAsked * dz;
                      const Number product = force * opening;
                      const Number unit = at(to.inverseProduct, ray);
                      const Number largest = most * unit;
                      const Number asked = larger(least * unit - product,
                                                  larger(smaller(largest - product, Number{}), -largest));
                      const Number pull = asked * inverseAnswer(at(to.leverage, ray), force, opening);
                      at(to.correctionS, ray) = pull;
                      return -at(to.s, ray) * pull;
                  });
        weightS = weightZ = Number{};
    }

    /// A weight of a correction, and the step that it allows.
    struct Weighted
    {
        Number weight;
        Number step;
    };

    /// The correction of a pull that is solved for, and the weights from `least` to 1 that let it go
    /// farthest.
    void weighCorrection(Number least, Weighted& ofForces, Weighted& ofOpenings)
    {
        constexpr int weights = 3;
        const LaneNumbers to = numbers;
        const Number weight[weights] = {all(1), 0.5 * (1 + least), least};
        Number leastS[weights] = {};
        Number leastZ[weights] = {};
        forClosings(to.correction,
                    [&](long ray, Number closing)
                    {
                        const Number change = at(to.inverseZ, ray) * closing;
                        const Number ofS = at(to.correctionS, ray) + change;
                        at(to.correctionS, ray) = ofS;
                        at(to.correctionZ, ray) = -change;
                        const Number ds = at(to.ratioS, ray);
                        const Number dz = at(to.ratioZ, ray);
                        for (int k = 0; k < weights; ++k)
                        {
                            leastS[k] = smaller(leastS[k], ds + weight[k] * ofS);
                            leastZ[k] = smaller(leastZ[k], dz - weight[k] * change);
                        }
                    });
        ofForces = {weight[0], stepFor(leastS[0])};
        ofOpenings = {weight[0], stepFor(leastZ[0])};
        for (int k = 1; k < weights; ++k)
        {
            takeLonger({weight[k], stepFor(leastS[k])}, ofForces);
            takeLonger({weight[k], stepFor(leastZ[k])}, ofOpenings);
        }
    }

    /// B ds of the step with its corrections, taken from what is in rows; the last correction becomes part of
    /// it.
    void takeStepFrom(double* rowsOfAll)
    {
        const LaneNumbers to = numbers;
        const Number ofS = weightS;
        const Number ofZ = weightZ;
        forForces(rowsOfAll,
                  [&](long ray)
                  {
                      const Number ds = at(to.ratioS, ray) + ofS * at(to.correctionS, ray);
                      at(to.ratioS, ray) = ds;
                      at(to.ratioZ, ray) += ofZ * at(to.correctionZ, ray);
                      return -at(to.s, ray) * ds;
                  });
        weightS = weightZ = Number{};
    }

    /// The step with what the motion in `correction` adds to it, and how far it may go.
    void addRefinement(Mask which)
    {
        const LaneNumbers to = numbers;
        Number leastS = {};
        Number leastZ = {};
        forClosings(to.correction,
                    [&](long ray, Number closing)
                    {
                        const Number change = at(to.inverseZ, ray) * closing;
                        const Number ds = at(to.ratioS, ray) + change;
                        const Number dz = at(to.ratioZ, ray) - change;
                        at(to.ratioS, ray) = ds;
                        at(to.ratioZ, ray) = dz;
                        leastS = smaller(leastS, ds);
                        leastZ = smaller(leastZ, dz);
                    });
        primal = which ? stepFor(leastS) : primal;
        dual = which ? stepFor(leastZ) : dual;
    }

private:
    /// The longest step, from the least of dx/x.
    static Number stepFor(Number least) { return 1 / larger(-least, all(1 / farthestStep)); }

    /// 1 / the answer of the products to what is asked for, as in Centring.cpp. \param force and opening at
    /// the end of the step, relative
    static Number inverseAnswer(Number leverage, Number force, Number opening)
    {
        force = larger(force, Number{});
        opening = larger(opening, Number{});
        return Base::roughInverseRoot(larger(opening + leverage * (force - opening), all(leastAnswer)));
    }

    static void takeLonger(Weighted other, Weighted& best)
    {
        const Mask isLonger = other.step > best.step * (1 + 1e-9);
        best.weight = isLonger ? other.weight : best.weight;
        best.step = isLonger ? other.step : best.step;
    }
};

} // namespace
} // namespace drystone
