// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// COMPAS JSON, of compas_assembly from 0.19 to today: what differs is how an object is wrapped, and where in
/// it the blocks are.
#include "core/Json.h"
#include "import/Solids.h"

#include <fmt/format.h>

#include <cmath>
#include <unordered_map>

namespace drystone
{

namespace
{

/// A value and its path from the root, for messages.
struct Place
{
    const JsonValue* value;
    std::string path;

    Place member(std::string_view key) const
    {
        const JsonValue* found = value->find(key);
        return {found, path.empty() ? std::string(key) : fmt::format("{}/{}", path, shown(key))};
    }
    explicit operator bool() const { return value != nullptr && !value->isNull(); }
};

class CompasReader
{
public:
    explicit CompasReader(const ImportedFile& source) : file(source) {}

    Solids read()
    {
        JsonValue root;
        try
        {
            root = parseJson(file.bytes);
        }
        catch (const JsonFault& fault)
        {
            refuse(file, fault.line, fmt::format("This is no COMPAS JSON: {}.", fault.what()));
        }
        const Place whole = content({&root, ""});
        if (const JsonValue::List* list = whole.value->asList())
        {
            for (std::size_t i = 0; i < list->size(); ++i)
            {
                readBlock({&(*list)[i], fmt::format("{}{}", whole.path.empty() ? "" : whole.path + "/", i)},
                          {}, {});
            }
        }
        else if (whole.member("assembly"))
        {
            const Place assembly = content(whole.member("assembly"));
            readGraph(assembly, assembly.member("vertex"), content(whole.member("blocks")));
        }
        else if (whole.member("graph"))
        {
            const Place graph = content(whole.member("graph"));
            readGraph(graph, graph.member("node"), {nullptr, ""});
        }
        else if (whole.member("node"))
        {
            readGraph(whole, whole.member("node"), content(whole.member("blocks")));
        }
        else
        {
            readBlock(whole, {}, {});
        }
        if (solids.solids.empty())
        {
            fail(whole, "There is no block in this file.");
        }
        return std::move(solids);
    }

private:
    [[noreturn]] void fail(const Place& place, const std::string& fault) const
    {
        throw FatalIOError(fault, {file.name, place.path, 0});
    }

    /// What `{ "dtype": .., "data": .. }` wraps, `value` before compas 1.
    Place content(Place place) const
    {
        while (place && place.value->find("dtype") != nullptr)
        {
            const Place inner = place.member("data") ? place.member("data") : place.member("value");
            if (!inner)
            {
                fail(place, "This object has a `dtype`, but neither `data` nor `value`.");
            }
            place = inner;
        }
        return place;
    }

    const JsonValue::Object& members(const Place& place, std::string_view what) const
    {
        const JsonValue::Object* object = place ? place.value->asObject() : nullptr;
        if (object == nullptr)
        {
            fail(place,
                 fmt::format("This file is no assembly of COMPAS: there is no object with {} here.", what));
        }
        return *object;
    }

    double number(const Place& place) const
    {
        const double* value = place ? place.value->asNumber() : nullptr;
        if (value == nullptr)
        {
            fail(place, "A number is expected here.");
        }
        return *value;
    }

    /// true or false, or 1 or 0 as Python has them too.
    bool isOn(const Place& place) const
    {
        if (const bool* isTrue = place.value->asSwitch())
        {
            return *isTrue;
        }
        const double* number = place.value->asNumber();
        if (number == nullptr || (*number != 0 && *number != 1))
        {
            fail(place, "true or false is expected here.");
        }
        return *number == 1;
    }

    /// `is_support`, of the node or by default, and the texts of `zones`; what others keep under this name,
    /// and is no list, is theirs.
    std::vector<std::string> zonesOf(const Place& node, const Place& defaults) const
    {
        std::vector<std::string> zones;
        Place support = node.member("is_support");
        if (support.value == nullptr && defaults)
        {
            support = defaults.member("is_support");
        }
        if (support && isOn(support))
        {
            zones.emplace_back("is_support");
        }
        const Place named = node.member("zones");
        if (named && named.value->asList() != nullptr)
        {
            for (const JsonValue& name : *named.value->asList())
            {
                if (name.asText() != nullptr)
                {
                    zones.push_back(*name.asText());
                }
            }
        }
        return zones;
    }

    void readGraph(const Place& graph, const Place& nodes, const Place& blocksBeside)
    {
        std::unordered_map<std::string, int> solidOf;
        std::unordered_map<std::string_view, const JsonValue*> blockOf;
        if (blocksBeside)
        {
            for (const auto& [key, block] : members(blocksBeside, "the blocks of the assembly"))
            {
                blockOf[key] = &block;
            }
        }
        for (const auto& [key, node] : members(nodes, "the nodes of the assembly"))
        {
            const Place place{&node, nodes.path + "/" + shown(key)};
            const Place block = blocksBeside ? Place{blockOf[key], blocksBeside.path + "/" + shown(key)}
                                             : place.member("block");
            if (!content(block))
            {
                fail(place, "This node has no block.");
            }
            solidOf[key] = static_cast<int>(solids.solids.size());
            readBlock(block, zonesOf(place, graph.member("default_node_attributes")), key);
        }
        const Place edges = graph.member("edge");
        if (!edges)
        {
            return;
        }
        for (const auto& [from, row] : members(edges, "the edges of the assembly"))
        {
            const Place place{&row, edges.path + "/" + shown(from)};
            for (const auto& [to, edge] : members(place, "edges"))
            {
                const Place ofEdge{&edge, place.path + "/" + shown(to)};
                const auto solid = solidOf.find(from);
                const auto neighbour = solidOf.find(to);
                if (solid == solidOf.end() || neighbour == solidOf.end() || from == to)
                {
                    fail(ofEdge, fmt::format("This edge is between {} and {}, which are not two nodes.",
                                             shown(from), shown(to)));
                }
                if (edge.asObject() != nullptr)
                {
                    readInterfaces(ofEdge, solid->second, neighbour->second);
                }
            }
        }
    }

    void readInterfaces(const Place& edge, int solid, int neighbour)
    {
        if (const Place list = content(edge.member("interfaces")))
        {
            if (list.value->asList() == nullptr)
            {
                fail(list, "A list of interfaces is expected here.");
            }
            for (std::size_t i = 0; i < list.value->asList()->size(); ++i)
            {
                const Place one{&(*list.value->asList())[i], fmt::format("{}/{}", list.path, i)};
                readInterface(content(one).member("points"), solid, neighbour);
            }
        }
        else if (const Place one = content(edge.member("interface")))
        {
            readInterface(one.member("points"), solid, neighbour);
        }
        else if (const Place points = edge.member("interface_points"))
        {
            readInterface(points, solid, neighbour);
        }
    }

    void readInterface(const Place& points, int solid, int neighbour)
    {
        const JsonValue::List* list = points ? points.value->asList() : nullptr;
        if (list == nullptr)
        {
            fail(points, "An interface has a list of points; there is none here.");
        }
        SolidInterface interface {
            solid, neighbour, {}
        };
        for (std::size_t i = 0; i < list->size(); ++i)
        {
            interface.points.push_back(
                readPoint(content({&(*list)[i], fmt::format("{}/{}", points.path, i)})));
        }
        if (interface.points.size() < 3)
        {
            fail(points, fmt::format("An interface has at least 3 points; this one has {}.",
                                     interface.points.size()));
        }
        solids.interfaces.push_back(std::move(interface));
    }

    Vector<3> readPoint(const Place& place) const
    {
        const JsonValue::List* list = place ? place.value->asList() : nullptr;
        if (list == nullptr || list->size() != 3)
        {
            fail(place, "A point is a list of 3 numbers.");
        }
        Vector<3> point;
        for (int axis = 0; axis < 3; ++axis)
        {
            point[axis] =
                number({&(*list)[static_cast<std::size_t>(axis)], fmt::format("{}/{}", place.path, axis)});
        }
        return point;
    }

    /// A mesh: vertices by keys, with coordinates or without (then those of the defaults), and faces by keys.
    void readBlock(const Place& wrapped, std::vector<std::string> zones, const std::string& name)
    {
        const Place mesh = content(wrapped);
        Solid solid;
        solid.name = name;
        solid.zones = std::move(zones);
        Place defaults = mesh ? mesh.member("default_vertex_attributes") : mesh;
        if (mesh && !defaults)
        {
            defaults = mesh.member("dva");
        }
        if (!mesh)
        {
            fail(wrapped, "A mesh is expected here.");
        }
        std::unordered_map<std::string, int> vertexOf;
        const Place vertices = mesh.member("vertex");
        for (const auto& [key, vertex] : members(vertices, "the vertices of a mesh"))
        {
            vertexOf[key] = static_cast<int>(solid.vertices.size());
            solid.vertices.push_back(vertexPosition({&vertex, vertices.path + "/" + shown(key)}, defaults));
        }
        const Place faces = mesh.member("face");
        for (const auto& [key, face] : members(faces, "the faces of a mesh"))
        {
            solid.faces.push_back(faceCorners({&face, faces.path + "/" + shown(key)}, vertexOf));
        }
        solids.solids.push_back(std::move(solid));
    }

    /// \param defaults of the mesh, or nothing
    Vector<3> vertexPosition(const Place& place, const Place& defaults) const
    {
        Vector<3> position = Vector<3>::Zero();
        for (int axis = 0; axis < 3; ++axis)
        {
            const std::string_view coordinate =
                std::string_view("xyz").substr(static_cast<std::size_t>(axis), 1);
            if (const Place own = place.member(coordinate);
                own.value != nullptr) // null: could not be computed
            {
                position[axis] = number(own);
            }
            else if (const Place usual = defaults ? defaults.member(coordinate) : defaults)
            {
                position[axis] = number(usual);
            }
            else
            {
                fail(place, fmt::format("This vertex has no {}, and the mesh no default of it.", coordinate));
            }
        }
        return position;
    }

    std::vector<int> faceCorners(const Place& face,
                                 const std::unordered_map<std::string, int>& vertexOf) const
    {
        const JsonValue::List* list = face.value->asList();
        if (list == nullptr || list->size() < 3)
        {
            fail(face, "A face is a list of at least 3 vertices.");
        }
        std::vector<int> corners;
        for (const JsonValue& corner : *list)
        {
            corners.push_back(vertexNamed(corner, vertexOf, face));
        }
        return corners;
    }

    /// Keys are texts in objects, and numbers in lists.
    int vertexNamed(const JsonValue& corner, const std::unordered_map<std::string, int>& vertexOf,
                    const Place& face) const
    {
        const auto keyOf = [](double number)
        { return number == std::floor(number) ? fmt::format("{:.0f}", number) : fmt::format("{}", number); };
        const std::string key = corner.asText() != nullptr     ? *corner.asText()
                                : corner.asNumber() != nullptr ? keyOf(*corner.asNumber())
                                                               : "";
        const auto found = vertexOf.find(key);
        if (found == vertexOf.end())
        {
            fail(face, fmt::format("This face has the vertex {}, which its mesh does not have.", shown(key)));
        }
        return found->second;
    }

    const ImportedFile& file;
    Solids solids;
};

} // namespace

Solids readCompasJson(const ImportedFile& file)
{
    return CompasReader(file).read();
}

} // namespace drystone
