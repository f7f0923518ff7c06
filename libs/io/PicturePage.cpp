// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "io/PicturePage.h"

#include <algorithm>

namespace drystone
{

PicturePage makePicturePage(const MechanismPicture& picture, const Vector<2>& world)
{
    constexpr double margin = 16;
    constexpr double legend = 44;
    const double head = picture.title.empty() && picture.subtitle.empty() ? margin : 64;
    const double scale = std::min((picture.width - 2 * margin) / world.x(), 1.4 * picture.width / world.y());
    const Vector<2> room = scale * world;
    PicturePage page{scale,
                     {(picture.width - room.x()) / 2, head},
                     room,
                     SvgDrawing(picture.width, head + room.y() + legend)};
    if (!picture.title.empty())
    {
        page.drawing.text({picture.width / 2, 28}, picture.title,
                          {.size = 17, .anchor = TextAnchor::middle, .weight = "bold"});
    }
    if (!picture.subtitle.empty())
    {
        page.drawing.text({picture.width / 2, 50}, picture.subtitle,
                          {.size = 14, .anchor = TextAnchor::middle});
    }
    return page;
}

} // namespace drystone
