// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The function object that draws the structure at chosen times of its motion.
#pragma once

#include "functionObjects/FunctionObject.h"
#include "geometry/Vector.h"
#include "runControl/PictureFormats.h"

#include <string>

namespace drystone
{

/// How a motion is drawn.
struct MotionPictureSettings
{
    double magnification = 1;                     ///< of displacements and rotations
    Vector<3> towardsViewer = Vector<3>::UnitY(); ///< of structures in space: a unit vector
    std::string title = "";                       ///< name of the case
    PictureFormats formats{PictureFormat::svg};
};

/// The blocks where they are, over the outline of the structure as built, as motion_<time>.svg (.png, .pdf).
template<int Dim>
class MotionPicturesFunction final : public FunctionObject<Dim>
{
public:
    MotionPicturesFunction(FunctionOutput functionOutput, MotionPictureSettings pictureSettings)
        : output(std::move(functionOutput)), settings(std::move(pictureSettings))
    {
    }
    void write(const StepObservation<Dim>& step) override;

private:
    FunctionOutput output;
    MotionPictureSettings settings;
};

} // namespace drystone
