// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Time directories of a case, the file format of states: a run continues from one bit for bit.
#pragma once

#include "runControl/Case.h"
#include "runControl/TimeControls.h"

#include <cstddef>
#include <deque>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace drystone
{

/// Named numbers, arrays of numbers and lists of texts; their meaning is known to the library that makes
/// them.
struct State
{
    std::map<std::string, double> scalars;
    std::map<std::string, std::vector<double>> arrays;
    std::map<std::string, std::vector<std::string>> texts; ///< without quotes and line ends; no list is empty
    std::filesystem::path file; ///< where it was read from, for messages; empty before
    bool isEdited = false;      ///< read without a checksum: edited on purpose, or of an older version
};

/// A scalar of the state.
///
/// \throws FatalError naming the file when there is none of this name
double stateScalar(const State& state, const std::string& name);

/// An array of the state.
///
/// \throws FatalError naming the file when there is none of this name, or it has another size
const std::vector<double>& stateArray(const State& state, const std::string& name, std::size_t size);

/// The state as a dictionary of `name value;`, `name N(values);` and `name N("text" ...);`, with `checksum`
/// as its last entry: the fingerprint (Fingerprint.h) of all before it.
///
/// \throws FatalError when a value is not finite, or a text holds a quote or a line end
std::string stateText(const State& state, WriteFormat format);

/// Writes `<case>/<time name>/state`, whole or not at all: a new time directory appears under its name with
/// the state already in it; other files of an existing directory are left unchanged.
///
/// \throws FatalError as writeWholeFile
void writeState(const std::filesystem::path& caseDirectory, const std::string& timeName, const State& state,
                WriteFormat format);

/// Reads a state of either format.
///
/// \throws FatalError with file and line if the file is not a state, is truncated, or does not have the
/// checksum in it. It need not have one
State readState(const std::filesystem::path& file);

/// Writes the states of one run and keeps only the last ones of them.
class StateWriter
{
public:
    /// \param statesToKeep number of time directories to keep of those that this object writes; 0 keeps all
    StateWriter(std::filesystem::path directory, WriteFormat writeFormat, int statesToKeep);
    StateWriter(const StateWriter&) = delete;
    StateWriter& operator=(const StateWriter&) = delete;
    ~StateWriter();

    /// Writes the state, then removes the oldest directory that this object wrote if there are too many, also
    /// one of an earlier run that it wrote over, as OpenFOAM does, but none in which there was more than a
    /// state. A directory that is removed becomes the hidden
    /// `.purgedState`, which the next state is written into before it takes its name: to make and remove
    /// directories takes longer than to write a state. The destructor removes it; of a run that was killed
    /// the next run uses it.
    void write(const std::string& timeName, const State& state);

private:
    void purge(const std::string& timeName);

    std::filesystem::path caseDirectory;
    WriteFormat format;
    std::size_t purgeWrite;
    std::deque<std::string> written;
};

} // namespace drystone
