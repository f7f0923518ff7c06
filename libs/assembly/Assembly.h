// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The structure: rigid blocks, some of them fixed, as they were built.
#pragma once

#include "geometry/Polygon.h"
#include "geometry/space/Polyhedron.h"

#include <optional>
#include <string>
#include <vector>

namespace drystone
{

template<int Dim>
struct Block;

template<>
struct Block<2>
{
    Polygon outline;      ///< counter-clockwise, in the global frame as built [m]
    double thickness = 1; ///< out of plane [m]
    int support =
        -1; ///< index into Assembly::supports of the support that fixes this block, or -1 when it is free
};

template<>
struct Block<3>
{
    Polyhedron shape; ///< in the global frame as built [m]
    int support =
        -1; ///< index into Assembly::supports of the support that fixes this block, or -1 when it is free
};

/// A named group of fixed blocks: the ground, an abutment. Loads and moving supports refer to it by name.
struct Support
{
    std::string name; ///< as in the dictionary: `ground`, `left`, ...
    std::string type; ///< `ground`, `blocks` or `abutments`: how it was made
};

/// A named set of blocks, such as a layer of the drawing that they were imported from: materials and supports
/// refer to it.
struct Zone
{
    std::string name;
    std::vector<int> blocks; ///< indices into Assembly::blocks, ascending
};

/// A joint that is stated, as by the interfaces of an imported file, instead of found from the shapes of the
/// blocks.
template<int Dim>
struct StatedJoint
{
    int block = -1;                           ///< index into Assembly::blocks
    int neighbour = -1;                       ///< index into Assembly::blocks; block < neighbour
    Vector<Dim> normal = Vector<Dim>::Zero(); ///< unit vector from `neighbour` into `block`
    std::vector<Vector<Dim>> points;          ///< where forces pass, in order round the joint [m]
};

/// What was done to joints whose faces did not quite meet (JointClosure.h).
struct JointClosure
{
    int joints = 0;       ///< that were closed
    double largest = 0;   ///< distance of their faces, or depth in each other, before [m]
    double tolerance = 0; ///< up to which joints are closed [m]
    double alongAxes = 0; ///< the same of faces parallel to an axis or, in space, to a plane of two axes [m]
    double rounding = 0;  ///< unit of the last digit of the coordinates; 0: they have all digits [m]
};

/// All blocks of a structure. A block's index in `blocks` is its name everywhere a user sees it (0/motion,
/// blockMotion, VTK block id); rows of the equilibrium matrix are numbered over the free blocks only.
template<int Dim>
struct Assembly
{
    std::vector<Block<Dim>> blocks;
    std::vector<Support> supports;
    std::optional<double> jointTolerance = {}; ///< as the user states it: faces this near are a joint [m]
    JointClosure closure = {};                 ///< once closeJoints has seen the assembly
    std::vector<Zone> zones = {};
    std::vector<StatedJoint<Dim>> statedJoints = {}; ///< all joints there are; empty: they are found from the
                                                     ///< shapes of the blocks
};

/// For each block its position among the free blocks, or -1 for a fixed one. Size: blocks.
template<int Dim>
std::vector<int> freeIndices(const Assembly<Dim>& assembly);

/// Volume, mass centre and inertia of a block of uniform density.
template<int Dim>
struct BlockMass
{
    double volume = 0;                          ///< [m3]
    Vector<Dim> centroid = Vector<Dim>::Zero(); ///< as built [m]
    Eigen::Matrix<double, rotationCount<Dim>, rotationCount<Dim>>
        inertia; ///< about the centroid, for unit density [m5]
};

template<int Dim>
BlockMass<Dim> blockMass(const Block<Dim>& block);
template<>
BlockMass<2> blockMass(const Block<2>& block);
template<>
BlockMass<3> blockMass(const Block<3>& block);

/// Mass properties of every block, in their order.
template<int Dim>
std::vector<BlockMass<Dim>> blockMasses(const Assembly<Dim>& assembly);

/// The mean size of the free blocks [m], what tolerances relate to: square root of their mean area, in space
/// cube root of their mean volume. Ground of any extent leaves it as it is. 0 without free blocks.
double meanBlockSize(const Assembly<2>& assembly);
double meanBlockSize(const Assembly<3>& assembly);

/// Where a block is, relative to as built: turned about its mass centre, then moved. Used by time stepping
/// (finite rotations) and by every writer.
template<int Dim>
struct Placement;

template<>
struct Placement<2>
{
    Vector<2> translation = Vector<2>::Zero(); ///< of the mass centre [m]
    double rotation = 0;                       ///< [rad], positive counter-clockwise
};

template<>
struct Placement<3>
{
    Vector<3> translation = Vector<3>::Zero(); ///< of the mass centre [m]
    Vector<3> rotation = Vector<3>::Zero();    ///< rotation vector, its length the angle [rad], right hand
};

/// The placements moved by displacements of the free blocks, (ux uy rz) or (ux uy uz rx ry rz) each [m, rad],
/// times `share`. Rotations are finite: angles of the plane add, rotation vectors are composed. \param free
/// see freeIndices
std::vector<Placement<2>> moved(std::vector<Placement<2>> placements, const std::vector<int>& free,
                                const Eigen::VectorXd& displacement, double share = 1);
std::vector<Placement<3>> moved(std::vector<Placement<3>> placements, const std::vector<int>& free,
                                const Eigen::VectorXd& displacement, double share = 1);

/// An outline turned about `centre` by the placement's rotation, then moved [m]. Unchanged to the last bit
/// where the placement is none.
Polygon placed(const Polygon& outline, const Vector<2>& centre, const Placement<2>& placement);

/// The outline of a block where it is now [m].
Polygon placedOutline(const Block<2>& block, const Placement<2>& placement);

/// The polyhedron of a block where it is now [m]. Unchanged to the last bit where the placement is none.
Polyhedron placedShape(const Block<3>& block, const Placement<3>& placement);

} // namespace drystone
