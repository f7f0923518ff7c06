// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the kernels of the lane solver are handed: plain arrays, since each kernel is compiled for a
/// processor of its own and may use nothing inline of other headers. Internal to the lane solver.
#pragma once

namespace drystone
{

/// Points of one pair of bodies on one line, with the same friction: all but the arms of their normal forces
/// is the same. The force on the first body is opposite to that on the second.
struct LaneFace
{
    int first;          ///< body in elimination order, or `bodies`, the fixed ground, where both are fixed
    int second;         ///< later than `first`, or `bodies`
    int begin;          ///< of its points
    int end;            ///< likewise
    int friction;       ///< index of its coefficients
    int firstDiagonal;  ///< place of a block of the factor, or -1 where the body is fixed
    int coupling;       ///< likewise; rows of the second, columns of the first body
    int secondDiagonal; ///< likewise
    double normal[2];   ///< force on the first body of a unit of normal force
    double tangent[2];  ///< of a unit of shear
    double tangentMoment[2]; ///< of a unit of shear, on the first and on the second body, scaled
};

/// Moments of a unit of normal force on the first and on the second body, scaled.
struct LanePoint
{
    double normalMoment[2];
};

/// Two blocks L_ik and L_jk whose product L_ij takes away.
struct LaneProduct
{
    int left;
    int right;
};

/// What the programs in the lanes have in common. Not owned.
struct LaneGraph
{
    int bodies;
    int points;
    int faces;
    int blocks; ///< of the factor, column by column, that of the diagonal first
    const LanePoint* point;
    const LaneFace* face;
    const int* columnStart;  ///< of the factor's blocks: bodies + 1
    const int* row;          ///< of each block
    const int* productStart; ///< blocks + 1
    const LaneProduct* product;
    const int* updateStart;    ///< bodies + 1: blocks to the left of a diagonal one,
    const int* updatePosition; ///< as their places,
    const int* updateColumn;   ///< and their columns
};

/// Where another program of the same points was well inside its cones, and its units in those of the program
/// that begins there. Not owned.
struct LaneBegin
{
    const double* friction; ///< of each face
    const double* s;        ///< of each ray
    const double* z;        ///< likewise
    const double* y;        ///< of each row
    const double* resting;  ///< of each ray, or null: none were found
    double alpha;           ///< in units of the program
    double forces;          ///< unit of s
    double openings;        ///< of z and y
};

/// How a program has ended.
struct LaneEnd
{
    bool isAnswered; ///< what is sought was found; of an answer the scaled residuals meet the tolerance but
                     ///< for the balance, which is repaired as far as it goes
    bool isResting;  ///< forces that carry the load alone were found
    int iterations;
};

/// One program. Rays: two a point, (1, mu) and (1, -mu). Rows: 3 a body (force, moment), then 3 of the
/// ground, zero. Not owned.
struct LaneProgram
{
    const double* friction; ///< mu of each index
    const double* load;     ///< f, rows
    const double* liveLoad; ///< L, rows
    double liveWork;        ///< w of L'y = w
    LaneBegin begin;        ///< unless it begins from scratch

    // Out; where iterations begin, before they have ended.
    double* s;       ///< forces of the rays
    double* z;       ///< openings of the rays
    double* y;       ///< rows
    double* resting; ///< forces of the rays that carry the load alone
    double alpha;
    LaneEnd end; ///< none at first
};

/// The numbers of the programs in the lanes and the work of the kernel: `lanes` doubles each, 64-byte
/// aligned.
struct LaneNumbers
{
    double* friction;
    double* load;
    double* liveLoad;
    double* liveWork;
    double* s;
    double* z;
    double* y;
    double* ratioS;         ///< ds/s of the step in hand
    double* ratioZ;         ///< dz/z
    double* correctionS;    ///< of ds/s; its pull, before that is solved for
    double* correctionZ;    ///< of dz/z
    double* inverseZ;       ///< 1/z
    double* inverseProduct; ///< 1/(s z)
    double* leverage;       ///< s / (2 (s + z)), see Centring.cpp
    double *balance, *step, *correction, *target, *liveSolution; ///< rows
    double* blocks;                                              ///< 9 a block of the factor, by columns
};

struct LaneTask
{
    LaneGraph graph;
    LaneNumbers numbers;
    double tolerance;
    /// What is sought: 0, the answer; else the iterate with this mean product s z, near the central path.
    double complementarity;
    bool isBegun; ///< each program as its `begin` says; else from scratch
    LaneProgram*
        programs;      ///< more than there are lanes where they are begun: a lane that is free takes the next
    int programCount;  ///< at least 1
    int frictionCount; ///< of each program
};

/// One text compiled for several processors; which one runs is decided when it runs.
struct LaneKernel
{
    int lanes;
    void (*solve)(LaneTask& task);
};

} // namespace drystone
