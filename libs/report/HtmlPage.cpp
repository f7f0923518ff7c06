// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The style and the elements of a page; drawings in it have names of their own.
#include "report/HtmlPage.h"

#include "core/Base64.h"
#include "core/MarkupText.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

namespace
{

constexpr std::string_view style = R"(
body { font: 15px/1.5 system-ui, sans-serif; color: #222; max-width: 62em; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.7em; } h2 { font-size: 1.25em; margin-top: 2em; border-bottom: 1px solid #ccc; }
table { border-collapse: collapse; margin: 0.8em 0; } td, th { padding: 0.15em 0.8em 0.15em 0; text-align: left;
vertical-align: top; border-bottom: 1px solid #e6e6e6; } td { font-variant-numeric: tabular-nums; }
figure { margin: 1em 0; } figure svg { max-width: 100%; height: auto; } figcaption { color: #555; }
pre { background: #f6f6f4; padding: 0.6em; white-space: pre-wrap; overflow-wrap: anywhere; }
.viewer canvas { border: 1px solid #ccc; touch-action: none; } .viewer .controls > * { margin-right: 0.8em; }
@media print { .viewer { display: none; } figure { break-inside: avoid; } }
)";

/// Names of a drawing, such as that of what it is cut to, belong to the whole page that it stands in: a
/// prefix distinguishes them from those of other drawings.
std::string withOwnNames(std::string_view svg, std::string_view prefix)
{
    std::string text;
    while (!svg.empty())
    {
        std::size_t next = svg.size();
        for (const std::string_view mark : {" id=\"", "url(#"})
        {
            const std::size_t at = svg.find(mark);
            next = at == std::string_view::npos ? next : std::min(next, at + mark.size());
        }
        text.append(svg.substr(0, next));
        svg.remove_prefix(next);
        if (!svg.empty())
        {
            text.append(prefix);
        }
    }
    return text;
}

} // namespace

void HtmlPage::heading(std::string_view text)
{
    body += fmt::format("<h2>{}</h2>\n", markupText(text));
}

void HtmlPage::paragraph(std::string_view text)
{
    body += fmt::format("<p>{}</p>\n", markupText(text));
}

void HtmlPage::table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows)
{
    const auto line = [&](const std::vector<std::string>& cells, std::string_view tag)
    {
        body += "<tr>";
        for (const std::string& cell : cells)
        {
            body += fmt::format("<{0}>{1}</{0}>", tag, markupText(cell));
        }
        body += "</tr>\n";
    };
    body += "<table>\n";
    if (!head.empty())
    {
        line(head, "th");
    }
    for (const std::vector<std::string>& row : rows)
    {
        line(row, "td");
    }
    body += "</table>\n";
}

void HtmlPage::verbatim(std::string_view text)
{
    body += fmt::format("<pre>{}</pre>\n", markupText(text));
}

void HtmlPage::picture(std::string_view svg, std::string_view caption)
{
    // Inside of a page the drawing begins with its own element, not with the declaration of a file.
    const std::size_t begin = svg.find("<svg");
    if (begin != std::string_view::npos)
    {
        svg.remove_prefix(begin);
    }
    body += fmt::format("<figure>\n{}\n<figcaption>{}</figcaption>\n</figure>\n",
                        withOwnNames(svg, fmt::format("picture{}-", ++pictures)), markupText(caption));
}

void HtmlPage::image(std::string_view png, std::string_view caption)
{
    body += fmt::format(
        "<figure>\n<img alt=\"{0}\" style=\"max-width: 100%\" src=\"data:image/png;base64,{1}\">\n"
        "<figcaption>{0}</figcaption>\n</figure>\n",
        markupText(caption), base64(png));
}

void HtmlPage::markup(std::string_view html)
{
    body += html;
}

std::string HtmlPage::text() const
{
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{0}</title>\n"
        "<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n{2}</body>\n</html>\n",
        markupText(title), style, body);
}

} // namespace drystone
