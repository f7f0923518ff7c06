// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// From the settings of the texture `import` to the reader of its format.
#include "import/Import.h"

#include "core/ByteOrderMark.h"
#include "core/Log.h"
#include "core/NamedFile.h"
#include "core/ShownList.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

template<int Dim>
void declareFile(Options& options, Import<Dim>& settings)
{
    options.required("file", settings.file, "file that another program made, relative to the case")
        .example(Dim == 2 ? "\"constant/triSurface/facade.dxf\"" : "\"constant/triSurface/tower.obj\"");
    options.optional("format", settings.format, "of the file; auto: by the ending of its name");
}

std::string_view nameOf(ImportFormat format)
{
    for (const auto& [name, value] : namesOf(format))
    {
        if (value == format)
        {
            return name;
        }
    }
    return {};
}

ImportFormat byEnding(const fs::path& file, const SourceLocation& place)
{
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    using Ending = std::pair<std::string_view, ImportFormat>;
    static constexpr std::array<Ending, 6> endings{{{".obj", ImportFormat::obj},
                                                    {".ply", ImportFormat::ply},
                                                    {".stl", ImportFormat::stl},
                                                    {".json", ImportFormat::compasJson},
                                                    {".dxf", ImportFormat::dxf},
                                                    {".svg", ImportFormat::svg}}};
    const auto found =
        std::find_if(endings.begin(), endings.end(), [&](const Ending& one) { return one.first == ending; });
    if (found == endings.end())
    {
        throw FatalIOError(
            fmt::format("The name of the file ends in `{}`, which says no format. State it: `format` "
                        "is obj, ply, stl, compasJson, dxf or svg.",
                        shown(ending)),
            place);
    }
    return found->second;
}

bool isDrawing(ImportFormat format)
{
    return format == ImportFormat::dxf || format == ImportFormat::svg;
}

/// Refuses a text in UTF-16, of which every other byte is 0: the readers would find none of their words.
/// Those of SVG know it; PLY and STL have bytes of their own.
void refuseWideText(const ImportedFile& file, ImportFormat format)
{
    const bool isText =
        format == ImportFormat::obj || format == ImportFormat::dxf || format == ImportFormat::compasJson;
    const std::string_view start = std::string_view(file.bytes).substr(0, 2);
    if (isText && (start == "\xFF\xFE" || start == "\xFE\xFF" || start.find('\0') != std::string_view::npos))
    {
        refuse(file, 1, "The text is in UTF-16, which Windows calls Unicode: save it in UTF-8.");
    }
}

/// The file and its format. \throws FatalIOError when it is of the other dimension
template<int Dim>
std::pair<ImportedFile, ImportFormat> open(const Import<Dim>& settings, const fs::path& caseDirectory,
                                           const SourceLocation& place)
{
    const fs::path file = caseDirectory / settings.file; // or the file, where it is absolute
    const ImportFormat format =
        settings.format == ImportFormat::automatic ? byEnding(file, place) : settings.format;
    if (isDrawing(format) != (Dim == 2))
    {
        throw FatalIOError(
            Dim == 2 ? fmt::format("A file of format {} has solids: set `dimensions 3;`.", nameOf(format))
                     : fmt::format(
                         "A file of format {} has drawings of the plane: set `dimensions 2;`, or give it "
                         "depth by `type extrusion; of {{ type import; ... }}`.",
                         nameOf(format)),
            place);
    }
    requireFile(file, place);
    ImportedFile source = readSource(file);
    refuseWideText(source, format);
    // The header of a binary STL may begin with any bytes.
    const std::string_view text = withoutByteOrderMark(source.bytes);
    if (format != ImportFormat::stl || text.starts_with("solid"))
    {
        source.bytes.erase(0, source.bytes.size() - text.size());
    }
    info("Import: {}, format {}", source.name, nameOf(format));
    return {std::move(source), format};
}

constexpr const char* docOfOffset =
    "added to all coordinates, as where a drawing begins below the ground, which is at 0";

template<int Dim>
void printZones(const Assembly<Dim>& assembly)
{
    std::vector<std::string> zones;
    for (const Zone& zone : assembly.zones)
    {
        zones.push_back(fmt::format("{} ({})", zone.name, zone.blocks.size()));
    }
    info("Import: {} blocks{}{}", assembly.blocks.size(), zones.empty() ? "" : ", zones ",
         shownList(zones, 20));
}

} // namespace

void declare(Options& options, Import<2>& settings)
{
    declareFile(options, settings);
    options
        .optional("scale", settings.drawing.scale,
                  "metres a unit of the drawing; absent: as the file says ($INSUNITS, width), or 1")
        .above(0)
        .example("0.001");
    options.optional("offset", settings.drawing.offset, docOfOffset).unit("m");
    options.optional("thickness", settings.drawing.thickness, "out of plane").unit("m").above(0);
    options.optional("layers", settings.drawing.layers, "layers that have blocks; all if absent")
        .example("(stones)");
    options
        .optional("tolerance", settings.drawing.tolerance,
                  "corners that are this near are one, and faces a joint; absent: as jointTolerance")
        .unit("m")
        .above(0)
        .example("0.001");
    options
        .optional("chordsPerCircle", settings.chords.chordsPerCircle,
                  "chords that a whole circle of arcs becomes")
        .atLeast(4)
        .atMost(3600);
}

void declare(Options& options, Import<3>& settings)
{
    declareFile(options, settings);
    options.optional("scale", settings.solid.scale, "metres a unit of the file").above(0);
    options.optional("up", settings.solid.up, "axis of the file that points upwards");
    options.optional("offset", settings.solid.offset, docOfOffset).unit("m");
    options
        .optional(
            "tolerance", settings.solid.tolerance,
            "corners that are this near are one, faces this uneven are made plane, and faces this near are a "
            "joint; absent: 1.75 units of the last digit of the coordinates")
        .unit("m")
        .above(0)
        .example("0.001");
    options.optional("interfaces", settings.solid.interfaces,
                     "of a COMPAS assembly; contacts: they are the joints, instead of those found from the "
                     "shapes; absent: "
                     "contacts where the file has some");
}

Assembly<2> makeAssembly(const Import<2>& settings, const fs::path& caseDirectory,
                         const SourceLocation& place)
{
    const auto [file, format] = open(settings, caseDirectory, place);
    const Drawing drawing = format == ImportFormat::dxf ? readDxf(file, settings.chords) : readSvg(file);
    Assembly<2> assembly = drawnBlocks(drawing, settings.drawing, file);
    printZones(assembly);
    return assembly;
}

Assembly<3> makeAssembly(const Import<3>& settings, const fs::path& caseDirectory,
                         const SourceLocation& place)
{
    const auto [file, format] = open(settings, caseDirectory, place);
    Solids solids = format == ImportFormat::obj   ? readObj(file)
                    : format == ImportFormat::ply ? readPly(file)
                    : format == ImportFormat::stl ? readStl(file)
                                                  : readCompasJson(file);
    Assembly<3> assembly = solidBlocks(std::move(solids), settings.solid, file);
    printZones(assembly);
    return assembly;
}

} // namespace drystone
