// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The processor that the program was compiled for and the one it runs on: of core, since nothing of the
/// program may run before they are compared.
#pragma once

namespace drystone
{

/// Ends the program with status 1 and a message on standard error where this processor lacks what the program
/// was compiled for (DRYSTONE_PROCESSOR of CMakeLists.txt); without it, the first such instruction would end
/// it with "Illegal instruction". Runs by itself before the constructors of other files; a call from a
/// program has no other effect than to have it linked.
void requireProcessor();

} // namespace drystone
