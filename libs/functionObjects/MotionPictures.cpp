// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Draws the blocks of a step with the pictures of mechanisms.
#include "functionObjects/MotionPictures.h"

#include "io/MechanismPicture.h"
#include "runControl/TimeControls.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

template<int Dim>
void MotionPicturesFunction<Dim>::write(const StepObservation<Dim>& step)
{
    std::vector<Placement<Dim>> placements(step.placements.begin(), step.placements.end());
    double largest = 0;
    for (std::size_t block = 0; block < placements.size(); ++block)
    {
        Placement<Dim>& placement = placements[block];
        largest = std::max(largest, placement.translation.norm());
        placement.translation *= settings.magnification;
        placement.rotation = turnOf<Dim>((settings.magnification * rowsOf(placement.rotation)).eval());
    }
    MechanismPicture picture;
    picture.title = settings.title;
    picture.subtitle =
        fmt::format("t = {:.6g} s, largest displacement of a mass centre {:.4g} m", step.time, largest);
    picture.motion = settings.magnification == 1
                         ? "displacements to scale"
                         : fmt::format("displacements drawn {:g} times as large", settings.magnification);
    picture.towardsViewer = settings.towardsViewer;
    writeMechanismPicture(output.folder / ("motion_" + timeName(step.time)), *step.assembly, placements,
                          picture, settings.formats);
}

template class MotionPicturesFunction<2>;
template class MotionPicturesFunction<3>;

} // namespace drystone
