// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texture `dome`: rings of blocks between two spheres, with a closing stone or an opening at the top,
/// and a drum below if need be.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Options.h"

#include <optional>

namespace drystone
{

/// A ring wall under the dome.
struct Drum
{
    double height = 0.5; ///< [m]
    int courses = 2;
    std::optional<double> thickness =
        {}; ///< outwards from the dome's inner side [m]; absent: that of the dome
};

void declare(Options& options, Drum& drum);

struct Dome
{
    double radius = 1;                 ///< of the middle surface [m]
    double thickness = 0.1;            ///< [m]
    int around = 8;                    ///< blocks of a ring
    int rows = 8;                      ///< rings
    std::optional<double> cap = {};    ///< polar angle of the edge of a closing stone [degree]
    std::optional<double> oculus = {}; ///< polar angle of the edge of an opening [degree]
    std::optional<Drum> drum = {};
};

void declare(Options& options, Dome& dome);

/// The drum's courses from the bottom, then the rings from the springing up, in each anticlockwise from the x
/// axis, then the cap; all free. Corners lie on the spheres of radius R - t/2 and R + t/2, at azimuths 2 pi
/// k/around and at equal polar angles between the edge of the cap or oculus and the springing; all faces are
/// plane. The axis is z; without a drum the springing is at z = 0. The courses of a drum have their joints in
/// turn between those of the dome and below them.
Assembly<3> makeAssembly(const Dome& dome);

} // namespace drystone
