// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A product of cones in two ranges, and what interior points do with vectors of it: first rays (x >= 0, one
/// number each, treated as arrays), then round cones (three numbers each, SecondOrderCone.h). A ray is its
/// own Jordan algebra, and its scaling that of Nesterov & Todd: what is written for round cones holds for
/// rays word by word. An empty range costs nothing.
#pragma once

#include "conic/cones/RoundPacks.h"

namespace drystone
{

/// How many cones of each kind there are, and so where each has its entries in a vector.
struct ConeRanges
{
    Eigen::Index rays = 0;
    Eigen::Index rounds = 0;

    Eigen::Index size() const { return rays + 3 * rounds; } ///< of vectors
    Eigen::Index degree() const { return rays + rounds; }   ///< e'e: what complementarity is the mean of
    Eigen::Index at(Eigen::Index round) const { return rays + 3 * round; } ///< first entry of a round cone
};

/// D of the Schur system: one weight a ray, one symmetric matrix a round cone.
template<class Scalar>
struct ConeWeights
{
    VectorOf<Scalar> rays;
    std::vector<FramedMatrix<Scalar>> rounds;

    /// x = D x.
    void apply(VectorOf<Scalar>& x) const
    {
        forParts(rays.size(), [&](long begin, long end)
                 { x.segment(begin, end - begin).array() *= rays.segment(begin, end - begin).array(); });
        forRounds([&](const FramedMatrix<Abreast<Scalar>>& D, Eigen::Index at, int count)
                  { put(D.apply(taken(x, at, count)), at, count, x); });
    }

    /// x += D v.
    void addApplied(const VectorOf<Scalar>& v, VectorOf<Scalar>& x) const
    {
        forParts(rays.size(),
                 [&](long begin, long end)
                 {
                     const long count = end - begin;
                     x.segment(begin, count) +=
                         rays.segment(begin, count).cwiseProduct(v.segment(begin, count));
                 });
        forRounds([&](const FramedMatrix<Abreast<Scalar>>& D, Eigen::Index at, int count)
                  { put<Scalar>(taken(x, at, count) + D.apply(taken(v, at, count)), at, count, x); });
    }

private:
    /// \param function of the matrices of a pack, where its numbers begin, and how many cones it has
    template<class Function>
    void forRounds(const Function& function) const
    {
        forPacks<Abreast<Scalar>>(static_cast<Eigen::Index>(rounds.size()),
                                  [&](const Pack& pack) {
                                      function(taken(rounds, pack), rays.size() + 3 * pack.round, pack.count);
                                  });
    }
};

/// The unit e: 1 for each ray, (1 0 0) for each round cone.
template<class Scalar>
VectorOf<Scalar> unitOf(const ConeRanges& cones);

/// The smallest eigenvalue of any cone; 0 where there are none.
template<class Scalar>
double smallestEigenvalue(const ConeRanges& cones, const VectorOf<Scalar>& x);

/// x += share e.
template<class Scalar>
void addUnits(const ConeRanges& cones, double share, VectorOf<Scalar>& x);

/// Sum of the coefficients along e: e'x.
template<class Scalar>
double sumAlongUnit(const ConeRanges& cones, const VectorOf<Scalar>& x);

/// Where rounding has left a round cone's vector on the surface, where scalings have no meaning, it is put
/// back inside by the last digit.
template<class Scalar>
void keepInside(const ConeRanges& cones, VectorOf<Scalar>& x);

/// x += change, but for each cone no farther than to a tenth of how far x is inside: rays are cut off there,
/// of round cones the change is shortened.
template<class Scalar>
void addWithin(const ConeRanges& cones, const VectorOf<Scalar>& change, VectorOf<Scalar>& x);

/// What is outside its cone is replaced by its mirror image, `reflection` times as far inside as it was out:
/// each negative eigenvalue by so many times its size.
template<class Scalar>
void reflectInside(const ConeRanges& cones, double reflection, VectorOf<Scalar>& x);

/// A step in the scaling of the round cones, W^-1 ds and W dz, in which both start from the same lambda. Rays
/// need none.
template<class Scalar>
struct ScaledStep
{
    std::vector<ConeVector<Abreast<Scalar>>> forces; ///< one a pack
    std::vector<ConeVector<Abreast<Scalar>>> openings;

    /// Adds a correction, with a weight for either.
    void add(const ScaledStep& correction, double ofForces, double ofOpenings);
};

/// The weights at an iterate, D = (W^-2 + rho)^-1 with W z = W^-1 s, and what products are answered with.
template<class Scalar>
struct ConeScaling
{
    ConeWeights<Scalar> weights;
    VectorOf<Scalar> flexibility;                             ///< of rays, 1 / (z + rho s): D = s times that
    std::vector<NesterovToddScaling<Abreast<Scalar>>> rounds; ///< one a pack
    std::vector<FramedMatrix<Abreast<Scalar>>> pulls;         ///< D W^-1 of these
    std::vector<ConeFrame<AbreastInDoubles<Scalar>>> frames;  ///< of their lambda

    /// \return whether all of it is finite
    bool update(const ConeRanges& cones, const VectorOf<Scalar>& s, const VectorOf<Scalar>& z, double rho);

    void scale(const ConeRanges& cones, const VectorOf<Scalar>& ds, const VectorOf<Scalar>& dz,
               ScaledStep<Scalar>& scaled) const;
};

/// How the cones limit steps: the largest, over all of them, of the inverse of the longest step, which is 0
/// where none limits it. \param x, dx of which the rays are looked at \param scaled of the round cones
template<class Number>
double steepestOf(const ConeRanges& cones, const Eigen::VectorXd& x, const Eigen::VectorXd& dx,
                  const std::vector<ConeFrame<Number>>& frames,
                  const std::vector<ConeVector<Number>>& scaled);

} // namespace drystone
