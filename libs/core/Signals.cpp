// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Signal handlers, which may do hardly more than set a flag.
#include "core/Signals.h"

#include <csignal>
#include <initializer_list>

#include <signal.h>

namespace drystone
{

namespace
{

// A handler has nowhere else to leave its note.
volatile std::sig_atomic_t received = 0;

extern "C" void noteStopSignal(int signal)
{
    received = signal;
}

} // namespace

void catchStopSignals()
{
    struct sigaction action = {};
    action.sa_handler = noteStopSignal;
    sigemptyset(&action.sa_mask);
    // RESETHAND: the second signal does what it always does. RESTART: reading and writing go on undisturbed.
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    {
        struct sigaction current = {};
        sigaction(signal, nullptr, &current);
        // What nohup or a background shell has switched off stays so.
        if (current.sa_handler != SIG_IGN)
        {
            sigaction(signal, &action, nullptr);
        }
    }
}

int stopSignal()
{
    return received;
}

int exitStatusOfSignal(int signal)
{
    return 128 + signal;
}

void forgetStopSignal()
{
    received = 0;
}

} // namespace drystone
