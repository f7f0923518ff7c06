// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The function object that lists the motion of the ground with what it causes.
#pragma once

#include "effects/GroundMotion.h"
#include "functionObjects/FunctionObject.h"

namespace drystone
{

/// The acceleration of the ground at the end of each step, in groundMotion.dat: `Time[s] ax[m/s2] ay[m/s2]`,
/// in space az[m/s2] too.
template<int Dim>
class GroundMotionFunction final : public FunctionObject<Dim>
{
public:
    GroundMotionFunction(FunctionOutput functionOutput, GroundMotion ofGround)
        : output(std::move(functionOutput)), motion(std::move(ofGround))
    {
    }
    void write(const StepObservation<Dim>& step) override;

private:
    FunctionOutput output;
    GroundMotion motion;
    std::optional<ColumnFile> table;
};

} // namespace drystone
