// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Input of programs for discrete elements, with which results are compared: LMGC90 and 3DEC.
#include "geometry/space/PolyhedronOverlap.h"
#include "import/export/Number.h"

#include <iterator>
#include <map>

namespace drystone
{

std::vector<int> concaveBlocks(const std::vector<ExportedSolid>& solids)
{
    std::vector<int> concave;
    for (std::size_t i = 0; i < solids.size(); ++i)
    {
        if (!isConvex(solids[i].shape))
        {
            concave.push_back(static_cast<int>(i));
        }
    }
    return concave;
}

namespace
{

/// Numbers of the materials, one for each density, in the order of the blocks.
std::map<double, int> materialsOf(const std::vector<ExportedSolid>& solids)
{
    std::map<double, int> materials;
    for (const ExportedSolid& solid : solids)
    {
        materials.emplace(solid.density, static_cast<int>(materials.size()));
    }
    return materials;
}

void writeMaterials(std::string& text, const std::map<double, int>& materials)
{
    std::map<int, double> densities;
    for (const auto& [density, index] : materials)
    {
        densities[index] = density;
    }
    for (const auto& [index, density] : densities)
    {
        fmt::format_to(std::back_inserter(text),
                       "stone{} = pre.material(name='ST{:03}', materialType='RIGID', density={})\n"
                       "materials.addMaterial(stone{})\n",
                       index, index, density, index);
    }
}

/// A call of the script's function `block`.
void writeRigidBlock(std::string& text, std::size_t index, const ExportedSolid& solid, int material)
{
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "block([  # {}, {}{}\n", index, solid.layer,
                   isConvex(solid.shape) ? "" : ", not convex");
    for (const Vector<3>& vertex : solid.shape.vertices)
    {
        fmt::format_to(out, "    [{}],\n", written(vertex, {}, ", "));
    }
    text += "], [\n";
    for (const std::vector<int>& face : solid.shape.faces)
    {
        for (const std::array<int, 3>& triangle : trianglesOf(solid.shape, face))
        {
            fmt::format_to(out, "    [{}, {}, {}],\n", triangle[0] + 1, triangle[1] + 1, triangle[2] + 1);
        }
    }
    fmt::format_to(out, "], stone{}, {})\n", material, solid.isFixed ? "True" : "False");
}

} // namespace

std::string lmgc90Text(const std::vector<ExportedSolid>& solids, double friction)
{
    std::string text =
        "# Blocks of Drystone for LMGC90, in metres, z upwards: python3 this file writes DATBOX/.\n"
        "import os\n\nimport numpy\nfrom pylmgc90 import pre\n\n"
        "dimension = 3\nbodies = pre.avatars()\nmaterials = pre.materials()\nmodels = pre.models()\n"
        "visibilities = pre.see_tables()\ncontacts = pre.tact_behavs()\n\n"
        "rigid = pre.model(name='rigid', physics='MECAx', element='Rxx3D', "
        "dimension=dimension)\nmodels.addModel(rigid)\n\n";
    const std::map<double, int> materials = materialsOf(solids);
    writeMaterials(text, materials);
    text +=
        "\n\ndef block(vertices, faces, material, fixed):\n    body = pre.rigidPolyhedron(model=rigid, "
        "material=material, color='BLEUx', generation_type='full',\n                               "
        "vertices=numpy.array(vertices), faces=numpy.array(faces))\n    if fixed:\n        "
        "body.imposeDrivenDof(component=[1, 2, 3, 4, 5, 6], dofty='vlocy')\n    bodies.addAvatar(body)\n\n\n";
    for (std::size_t i = 0; i < solids.size(); ++i)
    {
        writeRigidBlock(text, i, solids[i], materials.at(solids[i].density));
    }
    fmt::format_to(
        std::back_inserter(text),
        "\nlaw = pre.tact_behav(name='iqsc0', law='IQS_CLB', fric={})\ncontacts += law\n"
        "visibilities += pre.see_table(CorpsCandidat='RBDY3', candidat='POLYR', colorCandidat='BLEUx', "
        "behav=law,\n                              CorpsAntagoniste='RBDY3', antagoniste='POLYR', "
        "colorAntagoniste='BLEUx', alert=0.01)\n\n"
        "os.makedirs('DATBOX', exist_ok=True)\n"
        "pre.writeDatbox(dimension, materials, models, bodies, contacts, visibilities)\n",
        friction);
    return text;
}

std::string threeDecText(const std::vector<ExportedSolid>& solids)
{
    std::string text = "; blocks of Drystone for 3DEC, in metres, z upwards\nmodel new\n";
    const auto out = std::back_inserter(text);
    for (std::size_t i = 0; i < solids.size(); ++i)
    {
        const Polyhedron& shape = solids[i].shape;
        fmt::format_to(out, "; block {}, {}{}\n", i, solids[i].layer, solids[i].isFixed ? ", fixed" : "");
        if (!isConvex(shape))
        {
            text += "; left out: it is not convex\n";
            continue;
        }
        text += "block create polyhedron";
        for (const std::vector<int>& face : shape.faces)
        {
            text += " &\n    face";
            for (auto vertex = face.rbegin(); vertex != face.rend(); ++vertex) // clockwise seen from outside
            {
                fmt::format_to(out, " {}",
                               written(shape.vertices[static_cast<std::size_t>(*vertex)], {}, ","));
            }
        }
        text += "\n";
    }
    return text;
}

} // namespace drystone
