// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The surface of blocks as built, in pieces that loads on faces are integrated over, in the plane and in
/// space: one text for both.
#pragma once

#include "assembly/Assembly.h"

#include <array>
#include <vector>

namespace drystone
{

/// A simplex of the surface of a block: a straight piece of an outline, a triangle of a face. Faces that are
/// not triangles are sums of several, of which some may count negatively.
template<int Dim>
struct SurfacePiece
{
    int block = -1;                           ///< index in Assembly::blocks
    Vector<Dim> normal = Vector<Dim>::Zero(); ///< of its face, unit vector that points out of the block
    std::array<Vector<Dim>, Dim> corners;     ///< in any order [m]
    double weight = 1; ///< in the plane the thickness of the block [m], in space 1; negative: taken away
};

/// The surface of a block.
std::vector<SurfacePiece<2>> surfaceOf(const Assembly<2>& assembly, int block);
std::vector<SurfacePiece<3>> surfaceOf(const Assembly<3>& assembly, int block);

/// A plane polygon in pieces: triangles from its first corner to its edges, signed, so that they add up to it
/// where it is concave, too. \param corners in order round it \param sign of the whole
void addPolygon(std::vector<SurfacePiece<3>>& pieces, int block, const Vector<3>& normal,
                const std::vector<Vector<3>>& corners, double sign);

/// Its area [m2], negative where it counts negatively.
double areaOf(const SurfacePiece<2>& piece);
double areaOf(const SurfacePiece<3>& piece);

/// The parts of pieces where direction . x <= offset; those that lie there to rounding are among them.
template<int Dim>
std::vector<SurfacePiece<Dim>> partBelow(const std::vector<SurfacePiece<Dim>>& pieces,
                                         const std::type_identity_t<Vector<Dim>>& direction, double offset);

/// Places and weights of a rule over a piece that is exact for polynomials of degree 2: the integral of f is
/// the sum of weight * f(place). Weights have the sign of the piece and add up to its area [m2].
std::array<std::pair<Vector<2>, double>, 3> quadratureOf(const SurfacePiece<2>& piece);
std::array<std::pair<Vector<3>, double>, 3> quadratureOf(const SurfacePiece<3>& piece);

} // namespace drystone
