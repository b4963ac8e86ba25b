// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace lacuna {

/// Base class of every error of the kernel. `what()` is for a person: it names the entity by the user's tag,
/// what was found, what is needed, and one thing to try. `code()` is stable, for programs.
class Error : public std::runtime_error {
public:
    Error(std::string code, const std::string& message) : std::runtime_error(message), code_(std::move(code))
    {
    }
    [[nodiscard]] const std::string& code() const noexcept { return code_; }

private:
    std::string code_; ///< "folder.what_went_wrong", for example "topology.unknown_face"
};

/// An input of the caller cannot be used: an option, a file, a role.
class InvalidInput : public Error {
public:
    using Error::Error;
};

/// The open volume cannot be closed with the given options.
class NotClosed : public Error {
public:
    using Error::Error;
};

/// The closed volume cannot be filled with valid hexahedra.
class NotSweepable : public Error {
public:
    using Error::Error;
};

/// A library (Gmsh, Open CASCADE) or the file system failed; the message includes its own text.
class BackendError : public Error {
public:
    using Error::Error;
};

/// The host asked to stop the computation.
class Cancelled : public Error {
public:
    Cancelled() : Error("core.cancelled", "cancelled") {}
};

} // namespace lacuna
