// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which faces of an assembly a fill comes to that is poured from above: pure geometry of blocks, for loads
/// on surfaces.
#pragma once

#include "assembly/BlockSurface.h"
#include "geometry/Box.h"

#include <optional>
#include <vector>

namespace drystone
{

/// Whether a fill that comes down from its level lies against faces. Level with a point of a face it does
/// where no block stands opposite, or where something between the face and that block is open to the sky; the
/// underside of a span and the sides of an opening it would have to rise to, or come in from their sides
/// where its level is below the span.
template<int Dim>
class FillFromAbove
{
public:
    /// \param levelOfFill height of its surface [m]; none: above all blocks. Holds a reference to the
    /// assembly
    FillFromAbove(const Assembly<Dim>& structure, std::optional<double> levelOfFill);

    /// \param pieces of one face, those that are taken away included. A part on which another block lies is
    /// taken away from its face, and so is pressed as the face is: the answer is that of the whole face.
    bool reaches(const std::vector<SurfacePiece<Dim>>& pieces) const;

    /// Whether another block stands above part of a face that looks up and apart from it, but does not stand
    /// on the fill.
    bool isSheltered(const std::vector<SurfacePiece<Dim>>& pieces) const;

private:
    bool isOpenAbove(const Vector<Dim>& place, const Vector<Dim>& toOpposite) const;
    /// How far along a ray, of unit length, the first block begins [m]; infinite where it meets none.
    double firstBlockAlong(const std::vector<std::size_t>& among, const Vector<Dim>& from,
                           const Vector<Dim>& direction) const;

    const Assembly<Dim>& assembly;
    std::optional<double> level;
    double width; ///< of a joint [m]
    std::vector<Box<Dim>> boxes;
    std::vector<std::size_t> every; ///< block
    Box<Dim> all;                   ///< around them
    const Vector<Dim> up = Vector<Dim>::Unit(Dim - 1);
};

} // namespace drystone
