// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads the dictionaries that are named on standard input, one per line, and prints the contents or the
/// fault of each, for compareDictionaries.py.
///
///     readDictionaries [expand] [print]
///
/// expand: expand macros and directives. print: the entries too, not only whether the file could be read.
/// Every answer starts with a line "@@ read FILE" or "@@ failed FILE" and ends with a line "@@ end".
#include "dictionary/Dictionary.h"

#include <iostream>
#include <set>

int main(int count, char** arguments)
{
    const std::set<std::string> options(arguments + 1, arguments + count);
    const auto expansion = options.count("expand") > 0 ? drystone::Expansion::all : drystone::Expansion::none;
    for (std::string file; std::getline(std::cin, file);)
    {
        try
        {
            const auto dictionary = drystone::Dictionary::readFile(file, expansion);
            std::cout << "@@ read " << file << "\n";
            if (options.count("print") > 0)
            {
                std::cout << toText(dictionary);
            }
        }
        catch (const drystone::FatalError& error)
        {
            std::cout << "@@ failed " << file << "\n" << error.report();
        }
        std::cout << "@@ end\n";
    }
    return 0;
}
