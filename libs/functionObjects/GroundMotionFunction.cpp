// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Fills the table of the ground's acceleration.
#include "functionObjects/GroundMotionFunction.h"

namespace drystone
{

template<int Dim>
void GroundMotionFunction<Dim>::write(const StepObservation<Dim>& step)
{
    std::vector<std::string> columns{"Time[s]", "ax[m/s2]", "ay[m/s2]", "az[m/s2]"};
    columns.resize(1 + Dim);
    if (!table)
    {
        table.emplace(output.folder / "groundMotion.dat", columns, output.precision);
    }
    const Eigen::Vector3d acceleration = motion.factor * groundAcceleration(motion, step.time);
    Eigen::Matrix<double, 1 + Dim, 1> row;
    row << step.time, acceleration.template head<Dim>();
    table->write({row.data(), static_cast<std::size_t>(row.size())});
}

template class GroundMotionFunction<2>;
template class GroundMotionFunction<3>;

} // namespace drystone
