// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texts, and the dictionaries read from them.
#include "dictionary/FilesInMemory.h"

#include <algorithm>
#include <stdexcept>

namespace drystone
{
namespace
{

std::string nameOf(const std::filesystem::path& file)
{
    return file.lexically_normal().string();
}

FilesInMemory*& ofThisThread()
{
    thread_local FilesInMemory* files = nullptr;
    return files;
}

} // namespace

FilesInMemory::FilesInMemory()
{
    if (ofThisThread())
    {
        throw std::logic_error("FilesInMemory twice in one thread");
    }
    ofThisThread() = this;
}

FilesInMemory::~FilesInMemory()
{
    ofThisThread() = nullptr;
}

FilesOnDisk::FilesOnDisk() : hidden(ofThisThread())
{
    ofThisThread() = nullptr;
}

FilesOnDisk::~FilesOnDisk()
{
    ofThisThread() = hidden;
}

void FilesInMemory::set(const std::filesystem::path& file, std::string text)
{
    const std::string name = nameOf(file);
    std::erase_if(dictionaries,
                  [&](const auto& kept) { return kept.first == name || kept.second.sources.contains(name); });
    texts[name] = std::move(text);
}

bool FilesInMemory::isIncluded(const std::filesystem::path& file) const
{
    const std::string name = nameOf(file);
    return std::any_of(dictionaries.begin(), dictionaries.end(),
                       [&](const auto& kept)
                       { return kept.first != name && kept.second.sources.contains(name); });
}

FilesInMemory* FilesInMemory::current()
{
    return ofThisThread();
}

const std::string* FilesInMemory::textOf(const std::filesystem::path& file) const
{
    const auto found = texts.find(nameOf(file));
    return found == texts.end() ? nullptr : &found->second;
}

const Dictionary* FilesInMemory::find(const std::filesystem::path& file) const
{
    const auto found = dictionaries.find(nameOf(file));
    return found == dictionaries.end() ? nullptr : &found->second.dictionary;
}

void FilesInMemory::keep(const std::filesystem::path& file, const Dictionary& dictionary,
                         std::set<std::string> sources)
{
    dictionaries.insert_or_assign(nameOf(file), Kept{dictionary, std::move(sources)});
}

bool isInMemory(const std::filesystem::path& file)
{
    const FilesInMemory* files = ofThisThread();
    return files && (files->textOf(file) || files->find(file));
}

} // namespace drystone
