// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where blocks are, from the fields of frames.
#include "io/FrameReader.h"

#include "core/Error.h"
#include "core/WholeFile.h"
#include "io/VtkField.h"
#include "io/VtkSeries.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace drystone
{

namespace
{

/// The fields of a frame, a value a cell.
struct FrameFields
{
    Field block;        ///< a component
    Field displacement; ///< three
    Field rotation;     ///< one in the plane, three in space
};

[[noreturn]] void failToRead(const std::filesystem::path& file, const std::string& what)
{
    throw FatalError(
        fmt::format("{} is no frame of the blocks of this case: {}.\n\nRun the application again that "
                    "wrote it.",
                    file.string(), what));
}

FrameFields readFields(const std::filesystem::path& file)
{
    const std::string bytes = contentOfFile(file);
    std::optional<Field> block = cellField(bytes, "blockId");
    std::optional<Field> displacement = cellField(bytes, "displacement[m]");
    std::optional<Field> rotation = cellField(bytes, "rotation[rad]");
    if (!block || !displacement || !rotation)
    {
        failToRead(file, "blockId, displacement or rotation is missing or damaged");
    }
    if (block->components != 1 || displacement->components != 3)
    {
        failToRead(file, fmt::format("blockId and displacement have {} and {} components, not 1 and 3",
                                     block->components, displacement->components));
    }
    const auto turns = static_cast<std::size_t>(rotation->components);
    const std::size_t cells = block->values.size();
    if (displacement->values.size() != 3 * cells || rotation->values.size() != turns * cells)
    {
        failToRead(file, fmt::format("blockId, displacement and rotation have {}, {} and {} rows", cells,
                                     displacement->values.size() / 3, rotation->values.size() / turns));
    }
    return {std::move(*block), std::move(*displacement), std::move(*rotation)};
}

BlockFrame readFrame(const std::filesystem::path& file, double time, std::size_t blocks)
{
    const FrameFields fields = readFields(file);
    const auto count = static_cast<Eigen::Index>(blocks);
    constexpr double absent = std::numeric_limits<double>::quiet_NaN();
    BlockFrame frame{time, Eigen::Matrix3Xd::Constant(3, count, absent),
                     Eigen::Matrix3Xd::Constant(3, count, absent)};
    for (std::size_t cell = 0; cell < fields.block.values.size(); ++cell)
    {
        const double number = fields.block.values[cell];
        if (!(number >= 0 && number < static_cast<double>(blocks)))
        {
            failToRead(file, fmt::format("it shows block {}, and there are {}", number, blocks));
        }
        const auto index = static_cast<Eigen::Index>(number);
        const auto from = [cell](const Field& field, std::size_t component)
        { return field.values[cell * static_cast<std::size_t>(field.components) + component]; };
        const bool turnsInSpace = fields.rotation.components == 3;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            const auto row = static_cast<Eigen::Index>(axis);
            frame.displacement(row, index) = from(fields.displacement, axis);
            frame.rotation(row, index) = turnsInSpace ? from(fields.rotation, axis) : 0;
        }
        if (fields.rotation.components == 1)
        {
            frame.rotation(2, index) = from(fields.rotation, 0);
        }
    }
    return frame;
}

} // namespace

std::vector<BlockFrame> readBlockFrames(const std::filesystem::path& folder, const std::string& name,
                                        std::size_t blocks, std::size_t most)
{
    const std::vector<SeriesFrame> listed = readSeries(folder, name).frames;
    const std::size_t count = std::min(listed.size(), most);
    std::vector<BlockFrame> frames;
    for (std::size_t i = 0; i < count; ++i)
    {
        const std::size_t chosen = count == 1 ? listed.size() - 1 : i * (listed.size() - 1) / (count - 1);
        frames.push_back(readFrame(folder / listed[chosen].file, listed[chosen].time, blocks));
    }
    return frames;
}

} // namespace drystone
