// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Errors and warnings as a user sees them: what is wrong, where, and how to repair it.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

/// A place in a user's file.
struct SourceLocation
{
    std::string file;  ///< as the user would name it, e.g. system/blockTextureDict
    std::string entry; ///< path of the entry inside the file, e.g. texture/type; may be empty
    int line = 0;      ///< from 1; 0 when no line is to blame
};

/// Ends the program with a message to the user. `what()` is the message alone, `report()` all that is
/// printed.
class FatalError : public std::runtime_error
{
public:
    explicit FatalError(const std::string& message, int exitStatusOfProgram = 1);
    int exitStatus() const { return status; }
    /// The message between `--> DRYSTONE FATAL ERROR:` and `DRYSTONE exiting`.
    virtual std::string report() const;

private:
    int status;
};

/// A fault in a user's file.
class FatalIOError : public FatalError
{
public:
    FatalIOError(const std::string& message, SourceLocation where, int exitStatusOfProgram = 1);
    const SourceLocation& location() const { return place; }
    std::string report() const override;

private:
    SourceLocation place;
};

/// `file: system/blockTextureDict/texture/type at line 12.`
std::string describe(const SourceLocation& location);

/// Print `--> DRYSTONE Warning :` and the message on standard error.
void printWarning(std::string_view message);
void printWarning(std::string_view message, const SourceLocation& location);
/// The same, unless this program has printed it before: of what is read more than once. Any thread may.
void printWarningOnce(std::string_view message, const SourceLocation& location);

/// Run a program and turn whatever it throws into a message on standard error.
/// \return the program's own exit status, or that of the error (1 unless the error says otherwise)
int runGuarded(const std::function<int()>& program);

/// The candidate that a mistyped word most likely stands for, by the number of letters inserted, removed,
/// changed or swapped with their neighbour; empty when none is near enough to be worth suggesting.
std::string nearestWord(std::string_view word, const std::vector<std::string>& candidates);

/// `Unknown texture type runingBond. Did you mean runningBond?`, a blank line, and
/// `Valid texture types: arch courses polygons runningBond` in alphabetical order.
/// \param family what the word names, in the singular
std::string unknownWordMessage(std::string_view family, std::string_view word,
                               std::vector<std::string> validWords);

} // namespace drystone
