// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers in binary files, one after the other: what LineReader is for text.
#pragma once

#include "import/ImportedFile.h"

#include <bit>
#include <cstdint>
#include <cstring>

namespace drystone
{

class ByteReader
{
public:
    /// \param from byte of the file where it begins \param order of the bytes of a number
    ByteReader(const ImportedFile& source, std::size_t from, std::endian order)
        : file(source), at(from), isSwapped(order != std::endian::native)
    {
    }

    std::size_t place() const { return at; }
    std::size_t remaining() const { return file.bytes.size() - at; }

    /// \throws FatalIOError at the end of the file
    template<class Number>
    Number take()
    {
        Number value{};
        if (remaining() < sizeof value)
        {
            refuseEnd();
        }
        char bytes[sizeof value];
        std::memcpy(bytes, file.bytes.data() + at, sizeof value);
        for (std::size_t i = 0; isSwapped && i < sizeof value / 2; ++i)
        {
            std::swap(bytes[i], bytes[sizeof value - 1 - i]);
        }
        std::memcpy(&value, bytes, sizeof value);
        at += sizeof value;
        return value;
    }
    void skip(std::size_t bytes)
    {
        if (remaining() < bytes)
        {
            refuseEnd();
        }
        at += bytes;
    }

private:
    [[noreturn]] void refuseEnd() const
    {
        refuse(file, 0,
               "The file ends in the middle of its data, after " + std::to_string(file.bytes.size())
                   + " bytes: get a complete copy of it.");
    }

    const ImportedFile& file;
    std::size_t at;
    bool isSwapped;
};

} // namespace drystone
