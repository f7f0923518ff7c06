// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Runs a fuzz target without libFuzzer: on the kept inputs of a folder, then on as many damaged copies of
/// them, the same on all machines. An input that ends the program is in the file `last` of the working
/// directory.
///
///     replayDictionary FOLDER [COPIES [SEED]]
#include <algorithm>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace
{

/// The input being read, for the signal handler.
const std::string* current = nullptr;

/// Writes the input to the file `last`; calls only functions that are safe in a signal handler.
extern "C" void leaveInput(int signal)
{
    const int file = ::open("last", O_CREAT | O_WRONLY | O_TRUNC, 0666);
    if (file >= 0 && current != nullptr && ::write(file, current->data(), current->size()) >= 0)
    {
        ::close(file);
    }
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

void run(const std::string& text)
{
    current = &text;
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

/// Bytes changed, pieces removed, duplicated, or taken from another input, numbers made extreme.
std::string damaged(std::string text, const std::string& other, std::mt19937_64& random)
{
    const auto upTo = [&random](std::size_t most) { return static_cast<std::size_t>(random() % (most + 1)); };
    const std::string words[] = {
        "nan", "inf",  "-1",  "0",    "1e308",           "1e-320",   "2147483648", "(",  ")",  "{",
        "}",   ";",    "\"",  "$",    "#calc",           "#if",      "/*",         "$x", "\n", "\\",
        "[",   "-nan", "1e9", "0x10", "100000000000000", "((((((((", "..",         ":"};
    for (std::size_t changes = 1 + upTo(4); changes > 0; --changes)
    {
        const std::size_t at = upTo(text.size());
        const std::size_t length = upTo(std::min<std::size_t>(40, text.size() - at));
        switch (upTo(5))
        {
        case 0:
            text.insert(at, 1, static_cast<char>(random() % 256));
            break;
        case 1:
            text.erase(at, length);
            break;
        case 2:
            text.insert(at, text.substr(at, length));
            break;
        case 3:
            text.replace(at, length, other.substr(upTo(other.size()), length));
            break;
        case 4:
            text.insert(at, words[upTo(std::size(words) - 1)]);
            break;
        default:
        {
            // A number is replaced by another one.
            const std::size_t digit = text.find_first_of("0123456789", at);
            if (digit != std::string::npos)
            {
                const std::size_t end = text.find_first_not_of("0123456789.", digit);
                text.replace(digit, (end == std::string::npos ? text.size() : end) - digit, words[upTo(6)]);
            }
        }
        }
    }
    return text;
}

} // namespace

int main(int count, char** arguments)
{
    for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGILL, SIGTERM})
    {
        std::signal(signal, leaveInput);
    }
    std::vector<std::filesystem::path> files;
    for (const auto& file : std::filesystem::directory_iterator(count > 1 ? arguments[1] : "."))
    {
        files.push_back(file.path());
    }
    std::sort(files.begin(), files.end()); // the same order on all machines
    std::vector<std::string> inputs;
    for (const auto& file : files)
    {
        std::ifstream stream(file, std::ios::binary);
        inputs.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
        run(inputs.back());
    }
    if (inputs.empty())
    {
        return 1;
    }
    const int copies = count > 2 ? std::atoi(arguments[2]) : 0;
    std::mt19937_64 random(count > 3 ? std::strtoul(arguments[3], nullptr, 10) : 1);
    for (int copy = 0; copy < copies; ++copy)
    {
        const std::string text =
            damaged(inputs[random() % inputs.size()], inputs[random() % inputs.size()], random);
        run(text);
    }
    std::cout << inputs.size() << " inputs, " << copies << " damaged copies\n";
    return 0;
}
