// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Small structures and a scratch folder for the tests of libs/io.
#pragma once

#include "../Polygons.h"
#include "../ReportOf.h"

#include "contact/ContactPoint.h"
#include "core/Error.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>

namespace drystone::test
{

/// A folder that exists as long as the object.
class ScratchFolder
{
public:
    ScratchFolder()
        : folder(std::filesystem::temp_directory_path()
                 / ("drystone-io-" + std::to_string(::getpid()) + "-" + std::to_string(count++)))
    {
        std::filesystem::create_directories(folder);
    }
    ~ScratchFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return folder / name; }
    const std::filesystem::path& path() const { return folder; }

private:
    inline static std::atomic<int> count = 0;
    std::filesystem::path folder;
};

inline std::string content(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline ContactPoint<2> contact(int block, int neighbour, int joint, const Vector<2>& position,
                               const Vector<2>& normal)
{
    ContactPoint<2> point;
    point.block = block;
    point.neighbour = neighbour;
    point.joint = joint;
    point.position = position;
    point.normal = normal;
    return point;
}

/// Running bond on ground, of blocks 0.4 x 0.175 m; every other course begins and ends with half a block.
inline Assembly<2> wall(int length, int courses)
{
    Assembly<2> assembly;
    assembly.supports.push_back({"ground", "ground"});
    for (int i = -1; i <= 2 * length; ++i)
    {
        assembly.blocks.push_back({rectangle(0.2 * i, -0.175, 0.2 * (i + 1), 0), 1, 0});
    }
    for (int course = 0; course < courses; ++course)
    {
        const double y = 0.175 * course;
        const double end = 0.4 * length;
        double x = 0;
        double next = course % 2 == 0 ? 0.2 : 0.4;
        while (x < end - 1e-9)
        {
            next = std::min(next, end);
            assembly.blocks.push_back({rectangle(x, y, next, y + 0.175), 1, -1});
            x = next;
            next += 0.4;
        }
    }
    return assembly;
}

/// The part of a wall to the right of a stepped line, rotating about its toe: the mechanism of a panel under
/// a horizontal load.
inline Eigen::Matrix3Xd turningRates(const Assembly<2>& assembly, double length)
{
    Eigen::Matrix3Xd rates = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(assembly.blocks.size()));
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const Vector<2> centroid = areaProperties(assembly.blocks[i].outline).centroid;
        const Vector<2> toe(length, 0);
        if (assembly.blocks[i].support >= 0 || centroid.y() < 0.9 * (length - centroid.x()) - 0.3)
        {
            continue;
        }
        const Vector<2> arm = centroid - toe;
        rates.col(static_cast<Eigen::Index>(i)) << 0.1 * arm.y(), -0.1 * arm.x(), -0.1;
    }
    return rates;
}

} // namespace drystone::test
