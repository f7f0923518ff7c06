// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// COMPAS JSON in the schema of compas 2.
#include "geometry/space/Frame.h"
#include "import/Zones.h"
#include "import/export/Number.h"

#include <iterator>
#include <map>

namespace drystone
{

namespace
{

void writeBlock(std::string& text, const Polyhedron& shape, const WrittenNumbers& numbers)
{
    const auto out = std::back_inserter(text);
    text += R"({"dtype": "compas_assembly.datastructures/Block", "data": {"attributes": {}, )"
            R"("default_vertex_attributes": {"x": 0.0, "y": 0.0, "z": 0.0}, "default_edge_attributes": {}, )"
            R"("default_face_attributes": {}, "vertex": {)";
    for (std::size_t i = 0; i < shape.vertices.size(); ++i)
    {
        const Vector<3>& vertex = shape.vertices[i];
        fmt::format_to(out, R"({}"{}": {{"x": {}, "y": {}, "z": {}}})", i > 0 ? ", " : "", i,
                       written(vertex.x(), numbers), written(vertex.y(), numbers),
                       written(vertex.z(), numbers));
    }
    text += R"(}, "face": {)";
    for (std::size_t i = 0; i < shape.faces.size(); ++i)
    {
        fmt::format_to(out, R"({}"{}": [{}])", i > 0 ? ", " : "", i, fmt::join(shape.faces[i], ", "));
    }
    fmt::format_to(out, R"(}}, "facedata": {{}}, "edgedata": {{}}, "max_vertex": {}, "max_face": {}}}}})",
                   shape.vertices.size() - 1, shape.faces.size() - 1);
}

/// The names as the reader would take them in any case, which have no characters that JSON escapes.
std::string zoneNames(const std::vector<std::string>& zones)
{
    std::string text;
    for (const std::string& zone : zones)
    {
        text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", zoneName(zone));
    }
    return text;
}

void writeInterface(std::string& text, const StatedJoint<3>& joint, const WrittenNumbers& numbers)
{
    const auto out = std::back_inserter(text);
    text += R"({"dtype": "compas_assembly.datastructures/Interface", "data": {"points": [)";
    Vector<3> centre = Vector<3>::Zero();
    for (std::size_t i = 0; i < joint.points.size(); ++i)
    {
        centre += joint.points[i] / static_cast<double>(joint.points.size());
        fmt::format_to(out, "{}[{}]", i > 0 ? ", " : "", written(joint.points[i], numbers, ", "));
    }
    Vector<3> area = Vector<3>::Zero();
    for (std::size_t i = 0; i < joint.points.size(); ++i)
    {
        area += momentOf(Vector<3>(joint.points[i] - centre),
                         Vector<3>(joint.points[(i + 1) % joint.points.size()] - centre));
    }
    const Eigen::Matrix3d frame = frameOf(-joint.normal); // of a joint it points into the block
    fmt::format_to(
        out,
        R"(], "size": {}, "frame": {{"dtype": "compas.geometry/Frame", "data": {{"point": [{}], "xaxis": [{}], )"
        R"("yaxis": [{}]}}}}, "forces": null}}}})",
        area.norm() / 2, written(centre, {}, ", "), written(Vector<3>(frame.col(1)), {}, ", "),
        written(Vector<3>(frame.col(2)), {}, ", "));
}

} // namespace

std::string compasJsonText(const std::vector<ExportedSolid>& solids,
                           const std::vector<StatedJoint<3>>& joints, const WrittenNumbers& numbers)
{
    std::string text =
        R"({"dtype": "compas_assembly.datastructures/Assembly", "data": {"attributes": {"name": "Assembly"}, "graph": )"
        R"({"dtype": "compas.datastructures/Graph", "data": {"attributes": {}, "default_node_attributes": {"x": 0.0, )"
        R"("y": 0.0, "z": 0.0, "block": null, "is_support": false, "zones": []}, "default_edge_attributes": )"
        R"({"interfaces": null}, )"
        "\n\"node\": {";
    const auto out = std::back_inserter(text);
    for (std::size_t i = 0; i < solids.size(); ++i)
    {
        fmt::format_to(out, "{}\n\"{}\": {{\"block\": ", i > 0 ? "," : "", i);
        writeBlock(text, solids[i].shape, numbers);
        const Vector<3> centre = volumeProperties(solids[i].shape).centroid;
        fmt::format_to(out, R"(, "x": {}, "y": {}, "z": {}, "is_support": {}, "zones": [{}]}})", centre.x(),
                       centre.y(), centre.z(), solids[i].isFixed, zoneNames(solids[i].zones));
    }
    text += "},\n\"edge\": {";
    std::vector<std::map<int, std::vector<const StatedJoint<3>*>>> rows(solids.size());
    for (const StatedJoint<3>& joint : joints)
    {
        rows[static_cast<std::size_t>(joint.block)][joint.neighbour].push_back(&joint);
    }
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
        fmt::format_to(out, "{}\n\"{}\": {{", i > 0 ? "," : "", i);
        const char* separator = "";
        for (const auto& [neighbour, ofPair] : rows[i])
        {
            fmt::format_to(out, "{}\"{}\": {{\"interfaces\": [", separator, neighbour);
            separator = ", ";
            for (std::size_t k = 0; k < ofPair.size(); ++k)
            {
                text += k > 0 ? ", " : "";
                writeInterface(text, *ofPair[k], numbers);
            }
            text += "]}";
        }
        text += "}";
    }
    fmt::format_to(out, "}},\n\"max_node\": {}}}}}}}}}\n", solids.size() - 1);
    return text;
}

} // namespace drystone
