// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Base 64, of no model, hence in core.
#include "core/Base64.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace drystone
{

namespace
{

constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr unsigned noDigit = 64;

/// What each character stands for.
constexpr std::array<unsigned char, 256> valuesOfCharacters()
{
    std::array<unsigned char, 256> values{};
    values.fill(noDigit);
    for (std::size_t i = 0; i < digits.size(); ++i)
    {
        values[static_cast<unsigned char>(digits[i])] = static_cast<unsigned char>(i);
    }
    return values;
}

} // namespace

std::string base64(std::string_view bytes)
{
    std::string text((bytes.size() + 2) / 3 * 4, '=');
    char* to = text.data();
    for (std::size_t i = 0; i < bytes.size(); i += 3, to += 4)
    {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k)
        {
            three = three << 8U | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        }
        for (std::size_t k = 0; k <= count; ++k)
        {
            to[k] = digits[three >> (18U - 6U * k) & 63U];
        }
    }
    return text;
}

std::optional<std::string> bytesOfBase64(std::string_view text)
{
    static constexpr std::array<unsigned char, 256> values = valuesOfCharacters();
    const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with("=") ? 1 : 0;
    if (text.size() % 4 != 0)
    {
        return std::nullopt;
    }
    std::string bytes(text.size() / 4 * 3, '\0');
    for (std::size_t i = 0; i < text.size() / 4; ++i)
    {
        std::uint32_t three = 0;
        for (std::size_t k = 4 * i; k < 4 * i + 4; ++k)
        {
            const bool isPadding = k >= text.size() - padding;
            const unsigned value = isPadding ? 0 : values[static_cast<unsigned char>(text[k])];
            if (value == noDigit)
            {
                return std::nullopt;
            }
            three = three << 6U | value;
        }
        for (std::size_t k = 0; k < 3; ++k)
        {
            bytes[3 * i + k] = static_cast<char>(three >> (16U - 8U * k) & 255U);
        }
    }
    bytes.erase(bytes.size() - padding); // shortens, where a compiler has to expect resize() to lengthen
    return bytes;
}

} // namespace drystone
