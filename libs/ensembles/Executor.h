// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Carries out many pieces of work: one after the other, or on threads of this process. (Processes that share
/// a folder are in Workers.h.)
#pragma once

#include <cstddef>
#include <functional>

namespace drystone
{

/// Calls `work` for 0 .. count - 1, on `threads` threads, and `report` for each as soon as all before it are
/// complete: in the order of the numbers, from one thread at a time.
/// \param report may be empty
/// \throws what the work, or its report, with the lowest number that failed has thrown, after all threads
/// have ended; nothing after it is reported, and no more work is begun
void carryOutAll(std::size_t count, int threads, const std::function<void(std::size_t)>& work,
                 const std::function<void(std::size_t)>& report = {});

} // namespace drystone
