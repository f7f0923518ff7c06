// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Drawings as PNG and PDF, for documents that take no SVG. Drawn by cairo, which these two functions hide.
#pragma once

#include "io/Canvas.h"

#include <string>

namespace drystone
{

/// The drawing as a PNG file with two pixels to each of the drawing, which is 192 an inch.
/// \throws FatalError when cairo cannot make it, for instance since it is too large
std::string pngContent(const Canvas& canvas);

/// The drawing as a PDF file of one page with its text as text; 96 px of the drawing are an inch. The same
/// drawing gives the same bytes. \throws FatalError likewise
std::string pdfContent(const Canvas& canvas);

} // namespace drystone
