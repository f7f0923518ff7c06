// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How many programs of one command there are, as mpirun and Slurm start them.
#pragma once

namespace drystone
{

/// Which of several programs this one is, as the launcher says in the environment (Open MPI, MPICH and
/// others, Slurm); one of one where it says nothing.
struct LaunchedAs
{
    int rank = 0;
    int size = 1;
    bool isArray = false; ///< a task of a Slurm array, which ends when there is nothing left to begin
    /// A task of an array with holes, as 1,3,7: that knows the first and the last number of its tasks and how
    /// many there are, not which, so that others may have its rank, or none a rank that there should be.
    bool isIrregular = false;
    double beginning = 0; ///< where in work that is shared this program begins, from 0 to below 1
};
LaunchedAs launchedAs();

} // namespace drystone
