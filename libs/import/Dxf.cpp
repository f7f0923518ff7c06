// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// AutoCAD DXF. ImportedFile.h says why the reader is our own.
#include "import/Drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace drystone
{

namespace
{

/// Two lines of the file: what a value means, and the value.
struct Group
{
    int code = 0;
    std::string_view value;
    int line = 0;
};

class GroupReader
{
public:
    explicit GroupReader(const ImportedFile& source) : file(source), lines(source.bytes) { advance(); }

    const Group& current() const { return group; }
    bool isEnd() const { return isAtEnd; }
    /// To the next group that is no comment.
    void advance()
    {
        constexpr int comment = 999;
        do
        {
            readGroup();
        } while (group.code == comment);
    }
    bool starts(std::string_view name) const { return group.code == 0 && group.value == name; }
    double number() const { return numberOf(file, group.line + 1, group.value); }
    int integer() const { return integerOf(file, group.line + 1, group.value); }

private:
    void readGroup()
    {
        std::string_view line;
        if (!lines.next(line))
        {
            if (!isAtEnd && group.value != "EOF")
            {
                refuse(file, lines.number(), "The file ends without `EOF`: get a complete copy of it.");
            }
            isAtEnd = true;
            group = {0, "EOF", lines.number()};
            return;
        }
        group.line = lines.number();
        group.code = integerOf(file, group.line, trimmed(line));
        if (!lines.next(line))
        {
            refuse(file, group.line, "The file ends after a group code: get a complete copy of it.");
        }
        group.value = trimmed(line);
    }

    const ImportedFile& file;
    LineReader lines;
    Group group;
    bool isAtEnd = false;
};

/// A polyline as it is drawn: corner i with the bulge of the segment that follows, the tangent of a quarter
/// of its angle.
struct Polyline
{
    std::vector<Vector<2>> corners;
    std::vector<double> bulges;
    std::string layer;
    bool isClosed = false;
    bool isMirrored = false; ///< its extrusion direction is -z: x counts the other way
    int line = 0;
};

struct Insert
{
    std::string block;
    std::string layer;
    Vector<2> place = Vector<2>::Zero();
    Vector<2> factor = Vector<2>::Ones();
    double angle = 0; ///< [rad]
    int columns = 1;
    int rows = 1;
    Vector<2> spacing = Vector<2>::Zero();
    int line = 0;
};

struct Content
{
    Vector<2> base = Vector<2>::Zero();
    std::vector<Polyline> polylines;
    std::vector<Insert> inserts;
};

/// A transform of the plane: p becomes matrix p + shift.
struct Transform
{
    Eigen::Matrix2d matrix = Eigen::Matrix2d::Identity();
    Vector<2> shift = Vector<2>::Zero();
};

constexpr int deepest = 16;
constexpr std::size_t mostInserts = 1'000'000;

class DxfReader
{
public:
    DxfReader(const ImportedFile& source, const ChordSettings& chordSettings)
        : file(source),
          groups(source),
          chords(chordSettings),
          mostCorners(std::max<std::size_t>(1'000'000, source.bytes.size()))
    {
    }

    Drawing read()
    {
        while (!groups.isEnd() && !groups.starts("EOF"))
        {
            if (!groups.starts("SECTION"))
            {
                refuse(file, groups.current().line + 1,
                       fmt::format("`SECTION` is expected, but `{}` found: is this a DXF file in text form?",
                                   shown(groups.current().value)));
            }
            groups.advance();
            const std::string_view name = groups.current().value;
            groups.advance();
            if (name == "HEADER")
            {
                readHeader();
            }
            else if (name == "TABLES")
            {
                readTables();
            }
            else if (name == "BLOCKS")
            {
                readBlocks();
            }
            else if (name == "ENTITIES")
            {
                readEntities(entities, "ENDSEC");
            }
            while (!groups.starts("ENDSEC"))
            {
                requireMore("ENDSEC");
                groups.advance();
            }
            groups.advance();
        }
        expand(entities, {}, "", 0);
        for (const auto& [name, count] : others)
        {
            drawing.ignored.push_back(fmt::format("{} entities {}", count, name));
        }
        for (const auto& [what, count] : unused)
        {
            drawing.ignored.push_back(fmt::format("{} {}", count, what));
        }
        drawing.rounding = digits.unit();
        return std::move(drawing);
    }

private:
    void requireMore(std::string_view what) const
    {
        if (groups.isEnd() || groups.starts("EOF"))
        {
            refuse(file, groups.current().line,
                   fmt::format("The file ends before `{}`: get a complete copy of it.", what));
        }
    }

    void readHeader()
    {
        while (!groups.starts("ENDSEC"))
        {
            requireMore("ENDSEC");
            const bool isUnits = groups.current().code == 9 && groups.current().value == "$INSUNITS";
            groups.advance();
            if (isUnits && groups.current().code == 70)
            {
                static const std::map<int, double> metres{{1, 0.0254}, {2, 0.3048}, {4, 0.001},   {5, 0.01},
                                                          {6, 1},      {7, 1000},   {10, 0.9144}, {14, 0.1}};
                const int unit = groups.integer();
                if (const auto found = metres.find(unit); found != metres.end())
                {
                    drawing.unit = found->second;
                }
                else if (unit != 0)
                {
                    drawing.ignored.push_back(
                        fmt::format("the unit of the drawing, $INSUNITS {}, which is not known", unit));
                }
            }
        }
    }

    /// Layers that are off or frozen.
    void readTables()
    {
        while (!groups.starts("ENDSEC"))
        {
            requireMore("ENDSEC");
            const bool isLayer = groups.starts("LAYER");
            groups.advance();
            if (!isLayer)
            {
                continue;
            }
            std::string name;
            bool isHidden = false;
            for (; groups.current().code != 0; groups.advance())
            {
                const Group& group = groups.current();
                if (group.code == 2)
                {
                    name = group.value;
                }
                isHidden = isHidden || (group.code == 70 && (groups.integer() & 1) != 0)
                           || (group.code == 62 && groups.integer() < 0);
            }
            if (isHidden)
            {
                hidden.insert(name);
            }
        }
    }

    void readBlocks()
    {
        while (!groups.starts("ENDSEC"))
        {
            requireMore("ENDSEC");
            if (!groups.starts("BLOCK"))
            {
                groups.advance();
                continue;
            }
            Content content;
            std::string name;
            for (groups.advance(); groups.current().code != 0; groups.advance())
            {
                const Group& group = groups.current();
                if (group.code == 2)
                {
                    name = group.value;
                }
                else if (group.code == 10 || group.code == 20)
                {
                    content.base[group.code / 10 - 1] = groups.number();
                }
            }
            readEntities(content, "ENDBLK");
            blocks[name] = std::move(content);
        }
    }

    void readEntities(Content& content, std::string_view end)
    {
        while (!groups.starts(end))
        {
            requireMore(end);
            if (groups.starts("ENDSEC"))
            {
                refuse(file, groups.current().line, fmt::format("`{}` is missing before `ENDSEC`.", end));
            }
            if (groups.starts("LWPOLYLINE"))
            {
                content.polylines.push_back(readPolyline());
            }
            else if (groups.starts("POLYLINE"))
            {
                content.polylines.push_back(readOldPolyline());
            }
            else if (groups.starts("INSERT"))
            {
                content.inserts.push_back(readInsert());
            }
            else
            {
                constexpr std::size_t mostNames = 100;
                if (groups.current().code == 0 && others.size() < mostNames)
                {
                    ++others[shown(groups.current().value)];
                }
                groups.advance();
            }
        }
    }

    /// What all polylines have. \return whether the group is one of these
    bool readCommon(Polyline& polyline)
    {
        const Group& group = groups.current();
        if (group.code == 8)
        {
            polyline.layer = group.value;
        }
        else if (group.code == 70)
        {
            polyline.isClosed = (groups.integer() & 1) != 0;
        }
        else if (group.code == 230)
        {
            polyline.isMirrored = groups.number() < 0;
        }
        else
        {
            return false;
        }
        return true;
    }

    /// Corner by corner: x begins one.
    void readCorner(Polyline& polyline, int& ofCorner)
    {
        const Group& group = groups.current();
        if (group.code == 10)
        {
            polyline.corners.emplace_back(groups.number(), 0);
            polyline.bulges.push_back(0);
            digits.add(group.value);
            ofCorner = 1;
        }
        else if (group.code == 20 && ofCorner > 0)
        {
            polyline.corners.back().y() = groups.number();
            digits.add(group.value);
        }
        else if (group.code == 42 && ofCorner > 0)
        {
            polyline.bulges.back() = groups.number();
        }
    }

    Polyline readPolyline()
    {
        Polyline polyline;
        polyline.line = groups.current().line;
        int ofCorner = 0;
        for (groups.advance(); groups.current().code != 0; groups.advance())
        {
            if (!readCommon(polyline))
            {
                readCorner(polyline, ofCorner);
            }
        }
        return polyline;
    }

    Polyline readOldPolyline()
    {
        Polyline polyline;
        polyline.line = groups.current().line;
        for (groups.advance(); groups.current().code != 0; groups.advance())
        {
            readCommon(polyline);
        }
        while (groups.starts("VERTEX"))
        {
            int ofCorner = 0;
            for (groups.advance(); groups.current().code != 0; groups.advance())
            {
                readCorner(polyline, ofCorner);
            }
        }
        if (!groups.starts("SEQEND"))
        {
            refuse(file, groups.current().line + 1, "The vertices of a POLYLINE end without `SEQEND`.");
        }
        groups.advance();
        while (groups.current().code != 0)
        {
            groups.advance();
        }
        return polyline;
    }

    Insert readInsert()
    {
        Insert insert;
        insert.line = groups.current().line;
        for (groups.advance(); groups.current().code != 0; groups.advance())
        {
            const Group& group = groups.current();
            switch (group.code)
            {
            case 2:
                insert.block = group.value;
                break;
            case 8:
                insert.layer = group.value;
                break;
            case 10:
            case 20:
                insert.place[group.code / 10 - 1] = groups.number();
                break;
            case 41:
            case 42:
                insert.factor[group.code - 41] = groups.number();
                break;
            case 44:
            case 45:
                insert.spacing[group.code - 44] = groups.number();
                break;
            case 50:
                insert.angle = groups.number() * std::numbers::pi / 180;
                break;
            case 70:
                insert.columns = std::max(1, groups.integer());
                break;
            case 71:
                insert.rows = std::max(1, groups.integer());
                break;
            default:
                break;
            }
        }
        return insert;
    }

    /// The outlines of what is drawn, at its place. \param layer of the insert that draws it: that of
    /// entities on layer 0
    void expand(const Content& content, const Transform& transform, const std::string& layer, int depth)
    {
        for (const Polyline& polyline : content.polylines)
        {
            addOutline(polyline, transform, layer);
        }
        for (const Insert& insert : content.inserts)
        {
            const auto block = blocks.find(insert.block);
            if (block == blocks.end())
            {
                refuse(file, insert.line,
                       fmt::format("There is no block {} to insert.", shown(insert.block)));
            }
            if (depth >= deepest)
            {
                refuse(file, insert.line,
                       fmt::format("Blocks are inserted in each other to more than {} levels.", deepest));
            }
            const std::string own = insert.layer.empty() || insert.layer == "0" ? layer : insert.layer;
            for (int row = 0; row < insert.rows; ++row)
            {
                for (int column = 0; column < insert.columns; ++column)
                {
                    if (++inserted > mostInserts)
                    {
                        refuse(file, insert.line,
                               fmt::format("More than {} blocks are inserted.", mostInserts));
                    }
                    Eigen::Matrix2d turn;
                    turn << std::cos(insert.angle), -std::sin(insert.angle), std::sin(insert.angle),
                        std::cos(insert.angle);
                    Transform inner;
                    inner.matrix = transform.matrix * turn * insert.factor.asDiagonal();
                    const Vector<2> step(column * insert.spacing.x(), row * insert.spacing.y());
                    inner.shift = transform.matrix * (insert.place + turn * step) + transform.shift
                                  - inner.matrix * block->second.base;
                    expand(block->second, inner, own, depth + 1);
                }
            }
        }
    }

    void addOutline(const Polyline& polyline, const Transform& transform, const std::string& layer)
    {
        if (++corners > mostCorners) // those without an outline take time, too
        {
            refuse(file, polyline.line, fmt::format("The drawing has more than {} corners.", mostCorners));
        }
        DrawnOutline outline;
        outline.layer = polyline.layer.empty() || polyline.layer == "0"
                            ? (layer.empty() ? polyline.layer : layer)
                            : polyline.layer;
        outline.line = polyline.line;
        if (hidden.contains(outline.layer))
        {
            ++unused["outlines on layers that are off or frozen"];
            return;
        }
        const std::size_t count = polyline.corners.size();
        const bool endsMeet = count > 3 && polyline.corners.front() == polyline.corners.back();
        if (!polyline.isClosed && !endsMeet)
        {
            ++unused["open polylines"];
            return;
        }
        for (std::size_t i = 0; i < count; ++i)
        {
            addSegment(polyline, i, transform, outline.corners);
            if (corners + outline.corners.size() > mostCorners)
            {
                refuse(file, polyline.line,
                       fmt::format("The drawing has more than {} corners.", mostCorners));
            }
        }
        corners += outline.corners.size();
        drawing.outlines.push_back(std::move(outline));
    }

    /// Corner i, and those of the chords of the arc that follows it. An arc of angle t has the bulge b =
    /// tan(t/4): its centre is (1 - b^2)/(4 b) chords to the left of the middle of the chord.
    void addSegment(const Polyline& polyline, std::size_t i, const Transform& transform,
                    Polygon& outline) const
    {
        const auto add = [&](Vector<2> place)
        {
            if (polyline.isMirrored)
            {
                place.x() = -place.x();
            }
            outline.emplace_back(transform.matrix * place + transform.shift);
        };
        const Vector<2>& from = polyline.corners[i];
        const Vector<2>& to = polyline.corners[(i + 1) % polyline.corners.size()];
        const double bulge = polyline.bulges[i];
        add(from);
        const Vector<2> chord = to - from;
        if (bulge == 0 || !(chord.norm() > 0))
        {
            return;
        }
        const double angle = 4 * std::atan(bulge);
        const double wanted = std::abs(angle) / (2 * std::numbers::pi) * chords.chordsPerCircle;
        const int pieces = std::max(1, static_cast<int>(std::ceil(wanted - 1e-9)));
        if (pieces == 1)
        {
            return;
        }
        const Vector<2> centre = (from + to) / 2 + (1 - bulge * bulge) / (4 * bulge) * perpendicular(chord);
        for (int piece = 1; piece < pieces; ++piece)
        {
            const double turned = angle * piece / pieces;
            const Vector<2> arm = from - centre;
            add(centre + std::cos(turned) * arm + std::sin(turned) * perpendicular(arm));
        }
    }

    const ImportedFile& file;
    GroupReader groups;
    ChordSettings chords;
    std::size_t mostCorners; ///< of all outlines: memory is bounded by the size of the file
    std::size_t corners = 0;
    std::size_t inserted = 0;
    Content entities;
    std::map<std::string, Content, std::less<>> blocks;
    std::set<std::string, std::less<>> hidden;
    std::map<std::string, int> others; ///< entities that are not read, by their names
    std::map<std::string, int> unused;
    DigitCount digits;
    Drawing drawing;
};

} // namespace

Drawing readDxf(const ImportedFile& file, const ChordSettings& chords)
{
    if (file.bytes.starts_with("AutoCAD Binary DXF"))
    {
        refuse(file, 0, "This DXF file is in binary form: save it in text form (ASCII DXF).");
    }
    return DxfReader(file, chords).read();
}

} // namespace drystone
