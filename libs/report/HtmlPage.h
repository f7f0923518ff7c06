// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A page of HTML that needs nothing but itself, the form in which a case is reported.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

/// Collects a page from top to bottom. What is passed as text is escaped; what is passed as markup is not.
class HtmlPage
{
public:
    explicit HtmlPage(std::string pageTitle) : title(std::move(pageTitle)) {}

    void heading(std::string_view text);
    void paragraph(std::string_view text);
    /// \param head of the columns \param rows of as many texts each
    void table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows);
    void verbatim(std::string_view text);
    /// An SVG drawing, the text of its file, with a caption. Its names get a prefix, since those of all
    /// drawings of a page are in one space.
    void picture(std::string_view svg, std::string_view caption);
    /// A PNG image, the bytes of its file, with a caption.
    void image(std::string_view png, std::string_view caption);
    void markup(std::string_view html);

    /// The whole page.
    std::string text() const;

private:
    std::string title;
    std::string body;
    int pictures = 0; ///< so far
};

} // namespace drystone
