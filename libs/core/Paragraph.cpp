// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Breaks text into lines and words.
#include "core/Paragraph.h"

#include <algorithm>
#include <sstream>

namespace drystone
{

namespace
{

/// Length of the next line: up to the last blank within `width`, up to a newline, or to the end of a long
/// word.
std::size_t lengthOfLine(std::string_view text, std::size_t width)
{
    const std::size_t newline = std::min(text.find('\n'), text.size());
    if (newline <= width)
    {
        return newline;
    }
    const std::size_t blank = text.substr(0, width + 1).rfind(' ');
    return blank != std::string_view::npos && blank > 0 ? blank
                                                        : std::min(text.find_first_of(" \n"), text.size());
}

} // namespace

std::string paragraph(std::string_view text, int width)
{
    std::string lines;
    while (!text.empty())
    {
        const std::size_t length = lengthOfLine(text, static_cast<std::size_t>(width));
        lines.append(text.substr(0, length)).append("\n");
        text.remove_prefix(std::min(length + 1, text.size()));
    }
    return lines;
}

std::string hangingParagraph(std::string_view term, std::string_view description, int indentation, int width)
{
    const std::string margin(static_cast<std::size_t>(indentation), ' ');
    std::string text(term);
    if (description.empty())
    {
        return text + "\n";
    }
    if (text.size() < margin.size())
    {
        text.append(margin.size() - text.size(), ' ');
    }
    else
    {
        text += "\n" + margin;
    }
    std::string lines = paragraph(description, width - indentation);
    for (std::size_t end = lines.find('\n'); end + 1 < lines.size(); end = lines.find('\n', end + 1))
    {
        lines.insert(end + 1, margin);
    }
    return text + lines;
}

std::vector<std::string> wordsOf(const std::string& text)
{
    std::istringstream stream(text);
    std::vector<std::string> words;
    for (std::string word; stream >> word;)
    {
        words.push_back(word);
    }
    return words;
}

} // namespace drystone
