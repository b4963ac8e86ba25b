// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace lacuna {

/// What every failure of the kernel is. `what()` is one sentence or more for a person: the entity by
/// the tag they know, what was expected, what was found, and what to try. `code()` is stable, for programs.
class Error : public std::runtime_error {
public:
    Error(std::string code, const std::string& message) : std::runtime_error(message), code_(std::move(code))
    {
    }
    [[nodiscard]] const std::string& code() const noexcept { return code_; }

private:
    std::string code_; ///< "folder.what_went_wrong", as "topology.unknown_face"
};

/// What the caller handed over cannot be used: an option, a file, a role.
class InvalidInput : public Error {
public:
    using Error::Error;
};

/// The open volume cannot be sealed as asked.
class NotClosed : public Error {
public:
    using Error::Error;
};

/// The sealed volume cannot be filled with valid hexahedra.
class NotSweepable : public Error {
public:
    using Error::Error;
};

/// A library underneath (Gmsh, the file system) failed; the message carries its own words.
class BackendError : public Error {
public:
    using Error::Error;
};

/// The host asked the work to stop.
class Cancelled : public Error {
public:
    Cancelled() : Error("core.cancelled", "cancelled") {}
};

} // namespace lacuna
