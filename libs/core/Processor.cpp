// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Asks for each extension that the compiler's macros name, as a constructor before those of other files.
#include "core/Processor.h"

#include <cstdio>
#include <cstdlib>

namespace drystone
{

// Compiled like everything else, so that the compiler's macros say what it may use; nothing here is worth a
// vector instruction, of which this function must be free. 101 is the first priority that is not the
// implementation's own.
[[gnu::constructor(101)]] void requireProcessor()
{
#if defined(__x86_64__)
    __builtin_cpu_init();
    const char* missing = nullptr;
#if defined(__AVX2__)
    if (!__builtin_cpu_supports("avx2"))
    {
        missing = "AVX2";
    }
#endif
#if defined(__FMA__)
    if (!__builtin_cpu_supports("fma"))
    {
        missing = "FMA";
    }
#endif
#if defined(__BMI2__)
    if (!__builtin_cpu_supports("bmi2"))
    {
        missing = "BMI2";
    }
#endif
#if defined(__AVX512F__)
    if (!__builtin_cpu_supports("avx512f"))
    {
        missing = "AVX-512";
    }
#endif
    if (missing)
    {
        std::fputs("--> DRYSTONE FATAL ERROR:\nThis processor lacks ", stderr);
        std::fputs(missing, stderr);
        std::fputs(
            ", which the applications were compiled for. Compile them for any processor of its kind by\n\n"
            "    cmake --preset release -D DRYSTONE_PROCESSOR=x86-64 && cmake --build --preset release\n\n",
            stderr);
        std::_Exit(EXIT_FAILURE);
    }
#endif
}

} // namespace drystone
