// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where the updates of a factorisation by fronts wait for their parents: of FrontalCholesky only.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace drystone
{

/// A pool whose pieces are handed out where they fit first.
class UpdatePool
{
public:
    std::size_t take(std::size_t size)
    {
        const auto fits = std::find_if(unused.begin(), unused.end(),
                                       [size](const Piece& piece) { return piece.size >= size; });
        if (fits == unused.end())
        {
            end += size;
            return end - size;
        }
        const std::size_t begin = fits->begin;
        fits->begin += size;
        fits->size -= size;
        if (fits->size == 0)
        {
            unused.erase(fits);
        }
        return begin;
    }

    void giveBack(std::size_t begin, std::size_t size)
    {
        auto next = std::find_if(unused.begin(), unused.end(),
                                 [begin](const Piece& piece) { return piece.begin > begin; });
        next = unused.insert(next, {begin, size});
        if (next + 1 != unused.end() && begin + size == (next + 1)->begin)
        {
            next->size += (next + 1)->size;
            unused.erase(next + 1);
        }
        if (next != unused.begin() && (next - 1)->begin + (next - 1)->size == begin)
        {
            (next - 1)->size += next->size;
            unused.erase(next);
        }
    }

    std::size_t size() const { return end; }

private:
    struct Piece
    {
        std::size_t begin;
        std::size_t size;
    };
    std::vector<Piece> unused; ///< in order, none next to another
    std::size_t end = 0;
};

} // namespace drystone
