// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The search itself: a tree of bounding boxes, built anew for each call, which needs nothing but
/// coordinates.
#include "geometry/BroadPhase.h"

#include <algorithm>
#include <numeric>

namespace drystone
{

namespace
{

constexpr int leafSize = 8; ///< boxes in a leaf: fewer costs more nodes, more costs more comparisons

template<int Dim>
struct Node
{
    Box<Dim> box;
    int first = 0; ///< of the boxes below this node, in the tree's order
    int last = 0;
    int right = -1; ///< the left child follows its parent; -1 marks a leaf
};

template<int Dim>
bool isEmpty(const Box<Dim>& box)
{
    return !contains(box, Box<Dim>{box.lower, box.lower});
}

template<int Dim>
struct Tree
{
    std::vector<Node<Dim>> nodes;
    std::vector<int> order;       ///< of the boxes, so that those of a node follow each other
    std::vector<Box<Dim>> sorted; ///< the boxes in that order
};

template<int Dim>
int build(Tree<Dim>& tree, const std::vector<Box<Dim>>& boxes, int first, int last)
{
    const int index = static_cast<int>(tree.nodes.size());
    Node<Dim> node;
    node.first = first;
    node.last = last;
    Box<Dim> centres;
    for (int i = first; i < last; ++i)
    {
        const Box<Dim>& box = boxes[tree.order[i]];
        extend(node.box, box);
        extend<Dim>(centres, Vector<Dim>(box.lower + box.upper));
    }
    tree.nodes.push_back(node);
    if (last - first <= leafSize)
    {
        return index;
    }
    const Vector<Dim> extent = centres.upper - centres.lower;
    int axis = 0;
    for (int other = 1; other < Dim; ++other)
    {
        axis = extent[other] > extent[axis] ? other : axis;
    }
    const int middle = first + (last - first) / 2;
    std::nth_element(tree.order.begin() + first, tree.order.begin() + middle, tree.order.begin() + last,
                     [&boxes, axis](int a, int b)
                     {
                         const double centreA = boxes[a].lower[axis] + boxes[a].upper[axis];
                         const double centreB = boxes[b].lower[axis] + boxes[b].upper[axis];
                         return centreA != centreB ? centreA < centreB : a < b;
                     });
    build(tree, boxes, first, middle);
    const int right = build(tree, boxes, middle, last);
    tree.nodes[index].right = right;
    return index;
}

/// The tree of all boxes that are not empty; no nodes where all are.
template<int Dim>
Tree<Dim> treeOf(const std::vector<Box<Dim>>& boxes)
{
    Tree<Dim> tree;
    tree.order.reserve(boxes.size());
    for (int i = 0; i < static_cast<int>(boxes.size()); ++i)
    {
        if (!isEmpty(boxes[i]))
        {
            tree.order.push_back(i);
        }
    }
    if (tree.order.empty())
    {
        return tree;
    }
    tree.nodes.reserve(2 * boxes.size() / leafSize + 2);
    build(tree, boxes, 0, static_cast<int>(tree.order.size()));
    tree.sorted.reserve(tree.order.size());
    for (const int i : tree.order)
    {
        tree.sorted.push_back(boxes[i]);
    }
    return tree;
}

/// Adds the pairs (i, j) of a box i with boxes j > `after` of the tree that it meets, sorted. \param waiting
/// scratch
template<int Dim>
void addPairs(const Tree<Dim>& tree, const Box<Dim>& box, int i, int after,
              std::vector<std::pair<int, int>>& pairs, std::vector<int>& waiting)
{
    if (isEmpty(box))
    {
        return;
    }
    const std::size_t before = pairs.size();
    waiting.assign(1, 0);
    while (!waiting.empty())
    {
        const int index = waiting.back();
        waiting.pop_back();
        const Node<Dim>& node = tree.nodes[index];
        if (!meet(box, node.box))
        {
            continue;
        }
        if (node.right >= 0)
        {
            waiting.push_back(node.right);
            waiting.push_back(index + 1);
            continue;
        }
        for (int k = node.first; k < node.last; ++k)
        {
            if (tree.order[k] > after && meet(box, tree.sorted[k]))
            {
                pairs.emplace_back(i, tree.order[k]);
            }
        }
    }
    std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(before), pairs.end());
}

} // namespace

BoundingBox boundingBox(const Polygon& polygon)
{
    return boxAround<2>(polygon);
}

Box<3> boundingBox(const Polyhedron& polyhedron)
{
    return boxAround<3>(polyhedron.vertices);
}

template<int Dim>
std::vector<std::pair<int, int>> findMeetingPairs(const std::vector<Box<Dim>>& boxes)
{
    std::vector<std::pair<int, int>> pairs;
    const Tree<Dim> tree = treeOf(boxes);
    if (tree.nodes.empty())
    {
        return pairs;
    }
    pairs.reserve(4 * boxes.size());
    std::vector<int> waiting;
    for (int i = 0; i < static_cast<int>(boxes.size()); ++i)
    {
        addPairs(tree, boxes[i], i, i, pairs, waiting);
    }
    return pairs;
}

template<int Dim>
std::vector<std::pair<int, int>> findMeetingPairs(const std::vector<Box<Dim>>& boxes,
                                                  const std::vector<Box<Dim>>& others)
{
    std::vector<std::pair<int, int>> pairs;
    const Tree<Dim> tree = treeOf(others);
    std::vector<int> waiting;
    for (int i = 0; !tree.nodes.empty() && i < static_cast<int>(boxes.size()); ++i)
    {
        addPairs(tree, boxes[i], i, -1, pairs, waiting);
    }
    return pairs;
}

template std::vector<std::pair<int, int>> findMeetingPairs(const std::vector<Box<2>>& boxes);
template std::vector<std::pair<int, int>> findMeetingPairs(const std::vector<Box<3>>& boxes);

template std::vector<std::pair<int, int>> findMeetingPairs(const std::vector<Box<2>>& boxes,
                                                           const std::vector<Box<2>>& others);
template std::vector<std::pair<int, int>> findMeetingPairs(const std::vector<Box<3>>& boxes,
                                                           const std::vector<Box<3>>& others);

} // namespace drystone
