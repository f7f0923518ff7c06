// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Minimum degree by AMD, nested dissection by METIS, and the postorder. AMD and METIS are called as they
/// are: CHOLMOD, which has both, brings a BLAS whose threads cost a small run more than all else.
#include "linear/EliminationOrder.h"

#include <amd.h>
#include <metis.h>

#include <algorithm>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <type_traits>

namespace drystone
{
namespace
{

/// Bodies from which the order is by nested dissection instead of minimum degree: below it factors cost the
/// same, above it those of dissection cost less (test/benchmark/results/TUNING.md).
constexpr int dissectionBodies = 3000;

/// Neighbours of each body, ascending, without itself: those of body b are in neighbour[start[b]] to
/// neighbour[start[b + 1] - 1].
struct Graph
{
    std::vector<int> start;
    std::vector<int> neighbour;
};

Graph graphOf(int bodies, const std::vector<Coupling>& couplings)
{
    std::vector<Coupling> pairs;
    pairs.reserve(2 * couplings.size());
    for (const Coupling& pair : couplings)
    {
        if (pair[0] != pair[1])
        {
            pairs.push_back(pair);
            pairs.push_back({pair[1], pair[0]});
        }
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    Graph graph;
    graph.start.assign(static_cast<std::size_t>(bodies) + 1, 0);
    for (const Coupling& pair : pairs)
    {
        ++graph.start[pair[0] + 1];
        graph.neighbour.push_back(pair[1]);
    }
    std::partial_sum(graph.start.begin(), graph.start.end(), graph.start.begin());
    return graph;
}

std::vector<int> minimumDegree(Graph& graph, int bodies)
{
    std::vector<int> order(bodies);
    if (amd_order(bodies, graph.start.data(), graph.neighbour.data(), order.data(), nullptr, nullptr) < 0)
    {
        throw std::bad_alloc();
    }
    return order;
}

std::vector<int> nestedDissection(Graph& graph, int bodies)
{
    static_assert(std::is_same_v<idx_t, int>);
    std::vector<int> order(bodies);
    std::vector<int> place(bodies);
    // METIS draws numbers from the process's rand(), which it seeds: a thread at a time, or orders would
    // depend on what others draw.
    static std::mutex drawing;
    const std::lock_guard lock(drawing);
    if (METIS_NodeND(&bodies, graph.start.data(), graph.neighbour.data(), nullptr, nullptr, order.data(),
                     place.data())
        != METIS_OK)
    {
        throw std::bad_alloc();
    }
    return order;
}

/// The elimination tree of the ordered graph (Liu 1990): the parent of each place in the order is that of the
/// first body below its column of the factor, -1 at a root.
std::vector<int> eliminationTree(const Graph& graph, const std::vector<int>& order)
{
    const int bodies = static_cast<int>(order.size());
    const std::vector<int> place = placesIn(order);
    std::vector<int> parent(bodies, -1);
    std::vector<int> ancestor(bodies, -1); // a shortcut towards the root
    for (int i = 0; i < bodies; ++i)
    {
        for (int entry = graph.start[order[i]]; entry < graph.start[order[i] + 1]; ++entry)
        {
            for (int below = place[graph.neighbour[entry]]; below != -1 && below < i;)
            {
                const int next = ancestor[below];
                ancestor[below] = i;
                if (next == -1)
                {
                    parent[below] = i;
                }
                below = next;
            }
        }
    }
    return parent;
}

/// The places so that each follows all of its subtree.
std::vector<int> postorder(const std::vector<int>& parent)
{
    const int count = static_cast<int>(parent.size());
    std::vector<int> firstChild(count, -1);
    std::vector<int> nextSibling(count, -1);
    std::vector<int> stack;
    for (int i = count; i-- > 0;)
    {
        if (parent[i] >= 0)
        {
            nextSibling[i] = firstChild[parent[i]];
            firstChild[parent[i]] = i;
        }
        else
        {
            stack.push_back(i);
        }
    }
    std::vector<int> places;
    places.reserve(parent.size());
    while (!stack.empty())
    {
        const int top = stack.back();
        const int child = firstChild[top];
        if (child >= 0)
        {
            firstChild[top] = nextSibling[child];
            stack.push_back(child);
        }
        else
        {
            stack.pop_back();
            places.push_back(top);
        }
    }
    return places;
}

} // namespace

std::vector<int> eliminationOrder(int bodies, const std::vector<Coupling>& couplings)
{
    std::vector<int> order(bodies);
    std::iota(order.begin(), order.end(), 0);
    Graph graph = graphOf(bodies, couplings);
    if (bodies < 2 || graph.neighbour.empty())
    {
        return order;
    }
    order = bodies < dissectionBodies ? minimumDegree(graph, bodies) : nestedDissection(graph, bodies);
    std::vector<int> result;
    result.reserve(order.size());
    for (const int place : postorder(eliminationTree(graph, order)))
    {
        result.push_back(order[place]);
    }
    return result;
}

std::vector<int> placesIn(const std::vector<int>& order)
{
    std::vector<int> places(order.size());
    for (std::size_t place = 0; place < order.size(); ++place)
    {
        places[static_cast<std::size_t>(order[place])] = static_cast<int>(place);
    }
    return places;
}

std::vector<Coupling> couplingsByPlace(std::vector<Coupling> couplings, const std::vector<int>& places)
{
    for (Coupling& pair : couplings)
    {
        pair = {places[static_cast<std::size_t>(pair[0])], places[static_cast<std::size_t>(pair[1])]};
    }
    return couplings;
}

} // namespace drystone
