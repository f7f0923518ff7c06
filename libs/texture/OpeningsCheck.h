// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The check of a texture's openings, of walls in the plane and in space alike: the first that does not fit
/// is named by its place in the list.
#pragma once

#include "dictionary/Options.h"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace drystone
{

/// \param openings kept by reference, as the options keep what they fill in \param fault of one of them, as a
/// predicate that continues "Opening 3 "; empty where there is none
template<class Opening, class Fault>
void checkOpenings(Options& options, const std::vector<Opening>& openings, const Fault& fault)
{
    options.check("openings",
                  [&openings, fault]() -> std::string
                  {
                      for (std::size_t i = 0; i < openings.size(); ++i)
                      {
                          const std::string found = fault(openings[i]);
                          if (!found.empty())
                          {
                              return fmt::format("Opening {} {}", i, found);
                          }
                      }
                      return {};
                  });
}

} // namespace drystone
