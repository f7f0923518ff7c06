// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Ctrl-C and termination: a run that is requested to stop finishes its step, writes its state and ends.
#pragma once

namespace drystone
{

/// From now on SIGINT (Ctrl-C), SIGTERM and SIGHUP only leave a note, which `stopSignal` reads. A second one
/// of the same kind ends the program at once.
void catchStopSignals();

/// The signal that requested the program to stop; 0 when none did.
int stopSignal();

/// What a shell expects of a program that a signal has ended: 128 + signal, 130 for Ctrl-C.
int exitStatusOfSignal(int signal);

/// Forget the signal: for tests, and for programs that go on with something else.
void forgetStopSignal();

} // namespace drystone
