// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads frames with VTK.
#include "io/FrameReader.h"

#include "core/Error.h"
#include "io/VtkSeries.h"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <limits>

namespace drystone
{

namespace
{

BlockFrame readFrame(const std::filesystem::path& file, double time, std::size_t blocks)
{
    const auto fail = [&](const std::string& what)
    {
        throw FatalError(
            fmt::format("{} is no frame of the blocks of this case: {}.\n\nRun the application again that "
                        "wrote it.",
                        file.string(), what));
    };
    vtkNew<vtkXMLPolyDataReader> reader;
    if (!reader->CanReadFile(file.c_str()))
    {
        fail("it is no .vtp file");
    }
    reader->SetFileName(file.c_str());
    reader->Update();
    vtkCellData* fields = reader->GetOutput()->GetCellData();
    vtkDataArray* block = fields->GetArray("blockId");
    vtkDataArray* displacement = fields->GetArray("displacement[m]");
    vtkDataArray* rotation = fields->GetArray("rotation[rad]");
    if (!block || !displacement || !rotation)
    {
        fail("blockId, displacement or rotation is missing");
    }
    const int turns = rotation->GetNumberOfComponents();
    if (block->GetNumberOfComponents() != 1 || displacement->GetNumberOfComponents() != 3
        || (turns != 1 && turns != 3))
    {
        fail(fmt::format(
            "blockId, displacement and rotation have {}, {} and {} components, not 1, 3 and 1 or 3",
            block->GetNumberOfComponents(), displacement->GetNumberOfComponents(), turns));
    }
    const vtkIdType cells = block->GetNumberOfTuples();
    if (displacement->GetNumberOfTuples() != cells || rotation->GetNumberOfTuples() != cells)
    {
        fail(fmt::format("blockId, displacement and rotation have {}, {} and {} rows", cells,
                         displacement->GetNumberOfTuples(), rotation->GetNumberOfTuples()));
    }
    const auto count = static_cast<Eigen::Index>(blocks);
    constexpr double absent = std::numeric_limits<double>::quiet_NaN();
    BlockFrame frame{time, Eigen::Matrix3Xd::Constant(3, count, absent),
                     Eigen::Matrix3Xd::Constant(3, count, absent)};
    const bool isPlane = turns == 1;
    for (vtkIdType cell = 0; cell < cells; ++cell)
    {
        const double number = block->GetTuple1(cell);
        if (!(number >= 0 && number < static_cast<double>(blocks)))
        {
            fail(fmt::format("it shows block {}, and there are {}", number, blocks));
        }
        const auto index = static_cast<Eigen::Index>(number);
        displacement->GetTuple(cell, frame.displacement.col(index).data());
        if (isPlane)
        {
            frame.rotation.col(index).setZero();
            frame.rotation(2, index) = rotation->GetTuple1(cell);
        }
        else
        {
            rotation->GetTuple(cell, frame.rotation.col(index).data());
        }
    }
    return frame;
}

} // namespace

std::vector<BlockFrame> readBlockFrames(const std::filesystem::path& folder, const std::string& name,
                                        std::size_t blocks, std::size_t most)
{
    const std::vector<SeriesFrame> listed = readSeries(folder, name);
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
