// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// AutoCAD DXF, read group by group. ImportedFile.h says why the reader is our own.
#include "import/DxfFile.h"

#include "core/LowerCase.h"
#include "import/DxfGroups.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace drystone
{

namespace
{

class DxfReader
{
public:
    explicit DxfReader(const ImportedFile& source) : file(source), groups(source) {}

    DxfFile read()
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
                readEntities(result.entities, "ENDSEC");
            }
            while (!groups.starts("ENDSEC"))
            {
                requireMore("ENDSEC");
                groups.advance();
            }
            groups.advance();
        }
        return std::move(result);
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
                    result.unit = found->second;
                }
                else if (unit != 0)
                {
                    result.unknownUnit =
                        fmt::format("the unit of the drawing, $INSUNITS {}, which is not known", unit);
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
            bool isOff = false;
            bool isFrozen = false;
            for (; groups.current().code != 0; groups.advance())
            {
                const DxfGroup& group = groups.current();
                if (group.code == 2)
                {
                    name = group.value;
                }
                isOff = isOff || (group.code == 62 && groups.integer() < 0);
                isFrozen = isFrozen || (group.code == 70 && (groups.integer() & 1) != 0);
            }
            if (isOff || isFrozen)
            {
                result.hidden.insert(lowerCase(name));
            }
            if (isFrozen)
            {
                result.frozen.insert(lowerCase(name));
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
            DxfContent content;
            std::string name;
            for (groups.advance(); groups.current().code != 0; groups.advance())
            {
                const DxfGroup& group = groups.current();
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
            result.blocks[lowerCase(name)] = std::move(content);
        }
    }

    void readEntities(DxfContent& content, std::string_view end)
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
                readOldPolyline(content);
            }
            else if (groups.starts("INSERT"))
            {
                content.inserts.push_back(readInsert());
            }
            else
            {
                constexpr std::size_t mostNames = 100;
                if (groups.current().code == 0)
                {
                    const std::string name = shown(groups.current().value);
                    const bool isNamed = result.others.size() < mostNames || result.others.contains(name);
                    ++result.others[isNamed ? name : "of other names"];
                }
                groups.advance();
            }
        }
    }

    void leaveOutIfSet(DxfEntity& entity, std::string_view said) const
    {
        if (groups.integer() != 0)
        {
            entity.leftOut = said;
        }
    }

    /// What all entities have. \return whether the group is of it
    bool readCommon(DxfEntity& entity)
    {
        const DxfGroup& group = groups.current();
        switch (group.code)
        {
        case 8:
            entity.layer = group.value;
            return true;
        case 60:
            leaveOutIfSet(entity, "entities that are marked invisible");
            return true;
        case 67: // frames and titles of sheets, in the units of these
            leaveOutIfSet(entity, "entities of paper space");
            return true;
        case 210:
        case 220:
            entity.isTilted = entity.isTilted || groups.number() != 0;
            return true;
        case 230:
            entity.isMirrored = groups.number() < 0;
            return true;
        default:
            return false;
        }
    }

    /// Corner by corner: x begins one.
    void readCorner(DxfPolyline& polyline, int& ofCorner)
    {
        const DxfGroup& group = groups.current();
        if (group.code == 10)
        {
            polyline.corners.emplace_back(groups.number(), 0);
            polyline.bulges.push_back(0);
            result.digits.add(group.value);
            ofCorner = 1;
        }
        else if (group.code == 20 && ofCorner > 0)
        {
            polyline.corners.back().y() = groups.number();
            result.digits.add(group.value);
        }
        else if (group.code == 42 && ofCorner > 0)
        {
            polyline.bulges.back() = groups.number();
        }
    }

    DxfPolyline readPolyline()
    {
        DxfPolyline polyline;
        polyline.line = groups.current().line;
        int ofCorner = 0;
        for (groups.advance(); groups.current().code != 0; groups.advance())
        {
            if (groups.current().code == 70)
            {
                polyline.isClosed = (groups.integer() & 1) != 0;
            }
            else if (!readCommon(polyline))
            {
                readCorner(polyline, ofCorner);
            }
        }
        return polyline;
    }

    /// POLYLINE, of which each corner is an entity. Meshes are polylines, too, in name.
    void readOldPolyline(DxfContent& content)
    {
        constexpr int mesh = 16 | 64;
        DxfPolyline polyline;
        polyline.line = groups.current().line;
        bool isMesh = false;
        for (groups.advance(); groups.current().code != 0; groups.advance())
        {
            if (groups.current().code == 70)
            {
                polyline.isClosed = (groups.integer() & 1) != 0;
                isMesh = (groups.integer() & mesh) != 0;
            }
            else
            {
                readCommon(polyline);
            }
        }
        while (groups.starts("VERTEX"))
        {
            readVertex(polyline);
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
        if (isMesh)
        {
            ++result.others["POLYLINE that are meshes"];
            return;
        }
        content.polylines.push_back(std::move(polyline));
    }

    /// Points of the frame by which a spline is controlled are not drawn.
    void readVertex(DxfPolyline& polyline)
    {
        constexpr int ofFrame = 16;
        const std::size_t before = polyline.corners.size();
        bool isOfFrame = false;
        int ofCorner = 0;
        for (groups.advance(); groups.current().code != 0; groups.advance())
        {
            if (groups.current().code == 70)
            {
                isOfFrame = (groups.integer() & ofFrame) != 0;
            }
            readCorner(polyline, ofCorner);
        }
        if (isOfFrame)
        {
            polyline.corners.resize(before);
            polyline.bulges.resize(before);
        }
    }

    DxfInsert readInsert()
    {
        DxfInsert insert;
        insert.line = groups.current().line;
        for (groups.advance(); groups.current().code != 0; groups.advance())
        {
            const DxfGroup& group = groups.current();
            if (readCommon(insert))
            {
                continue;
            }
            switch (group.code)
            {
            case 2:
                insert.block = group.value;
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

    const ImportedFile& file;
    DxfGroups groups;
    DxfFile result;
};

} // namespace

DxfFile readDxfFile(const ImportedFile& file)
{
    if (file.bytes.starts_with("AutoCAD Binary DXF"))
    {
        refuse(file, 0, "This DXF file is in binary form: save it in text form (ASCII DXF).");
    }
    if (file.bytes.starts_with("AC10")) // AC1006 of release 10 to AC1032 of 2018
    {
        refuse(file, 0, "This is a DWG file, whatever its name: save it as DXF in text form (ASCII DXF).");
    }
    return DxfReader(file).read();
}

} // namespace drystone
