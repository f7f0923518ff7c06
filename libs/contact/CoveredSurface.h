// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The parts of the surfaces of blocks that lie on other blocks: what loads on faces do not reach.
#pragma once

#include "assembly/BlockSurface.h"

namespace drystone
{

/// Both sides of each joint (see findContactPoints), as pieces that count negatively and have the normals of
/// the faces that they are taken from: together with surfaceOf they are what is exposed.
template<int Dim>
std::vector<SurfacePiece<Dim>> coveredSurface(const Assembly<Dim>& assembly);

} // namespace drystone
