// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A structure and its motion as a picture for papers and web pages, where ParaView is not at hand.
#pragma once

#include "io/JointForces.h"
#include "io/JointMarks.h"
#include "io/PictureFile.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace drystone
{

/// From where a structure in space is seen unless the user says so: from the front's right (the front looks
/// towards -y), and from above.
Vector<3> usualView();

/// The direction towards the viewer of a text: `front`, `back`, `left`, `right`, `top`, or a vector such as
/// `(1 -1.4 0.8)`; of unit length. \throws FatalError for any other text, and for (0 0 0)
Vector<3> viewFrom(const std::string& text);

/// A load as an arrow in the notes below a picture.
struct LoadArrow
{
    Vector<3> direction = Vector<3>::Zero(); ///< of any length; in the plane z = 0
    std::string label = "";                  ///< for instance "live load 24.6 kN"
};

/// Where a part of the load acts, drawn there as an arrow.
struct LoadPlace
{
    Vector<3> place = Vector<3>::Zero(); ///< as built; in the plane z = 0 [m]
    int block = -1;                      ///< with which it moves
    double part = 1;                     ///< of the largest: the length of the arrow
};

struct MechanismPicture
{
    std::string title = "";    ///< for instance "masonryPanels/wall1"
    std::string subtitle = ""; ///< for instance "alpha = 0.642859, 33 blocks, 174 contact points"
    double width = 640;        ///< [px]; the height follows from the structure, up to 1.4 times the width
    /// In the plane drawn through the blocks as built (plane/ThrustLine.h), wider where the force is larger,
    /// with the reactions of fixed blocks as arrows; none when empty.
    std::vector<JointForce<2>> thrust = {};
    Vector<3> towardsViewer = usualView(); ///< of space: a unit vector
    /// Hinges and sliding joints, drawn on the displaced blocks, in space where they are seen.
    std::vector<JointMark> marks = {};
    std::optional<LoadArrow> load = {};     ///< drawn below, where its direction is seen
    std::vector<LoadPlace> loadPlaces = {}; ///< of a load that acts at points, along the direction of `load`
    std::string motion = "";                ///< how far the blocks are drawn from where they are
};

/// The displaced blocks, shaded by their displacement, over the dashed outline of the structure as built;
/// fixed blocks are hatched, hinges and sliding joints coloured unless blocks are drawn as areas without
/// joints. In space seen without perspective, hidden faces behind others (MechanismPicture.cpp in space/) and
/// without the outline as built; fixed blocks are grey. Below are a scale bar, the load and what is said of
/// the motion.
///
/// \param placements one per block
Canvas drawnMechanism(const Assembly<2>& assembly, const std::vector<Placement<2>>& placements,
                      const MechanismPicture& picture);
Canvas drawnMechanism(const Assembly<3>& assembly, const std::vector<Placement<3>>& placements,
                      const MechanismPicture& picture);

/// The same as text of an SVG file.
template<int Dim>
std::string mechanismSvg(const Assembly<Dim>& assembly, const std::vector<Placement<Dim>>& placements,
                         const MechanismPicture& picture);

/// The same as files `<name>.svg`, `.png`, `.pdf`, as writePicture writes them.
template<int Dim>
void writeMechanismPicture(const std::filesystem::path& name, const Assembly<Dim>& assembly,
                           const std::vector<Placement<Dim>>& placements, const MechanismPicture& picture,
                           const PictureFormats& formats)
{
    writePicture(name, drawnMechanism(assembly, placements, picture), formats);
}

} // namespace drystone
