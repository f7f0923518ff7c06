// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What attributes of SVG have in place of words: letters and numbers without blanks between them.
#pragma once

#include "import/Drawing.h"

#include <string>
#include <string_view>

namespace drystone
{

/// Letters and numbers of a path, a list of points or a transform: `M0,0l1.5-2e3`. Blanks and commas are
/// passed over. Faults are refused with the line of the element. Neither file nor text is owned.
class SvgScanner
{
public:
    SvgScanner(const ImportedFile& source, int lineOfElement, std::string_view text)
        : file(source), line(lineOfElement), rest(text)
    {
    }
    bool isEnd();
    bool isNumber();
    char letter(); ///< the next character, or '\0' at the end
    /// \param digits counts those of the number \throws FatalIOError where there is none
    double number(DigitCount* digits = nullptr);
    std::string_view word(); ///< up to a blank or `(`
    [[noreturn]] void fail(const std::string& fault) const;

private:
    void skip();

    const ImportedFile& file;
    int line;
    std::string_view rest;
};

} // namespace drystone
