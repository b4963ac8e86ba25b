// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/message.h>

#include <stdexcept>
#include <string>
#include <string_view>

namespace lacuna {

/// Base class of all errors of the kernel. The message names entities by the user's tags, says what was found
/// and what is needed, and gives one thing to try. `what()` returns its text. `code()` returns a stable code
/// for programs.
class Error : public std::runtime_error {
public:
    explicit Error(Message message);
    /// @param format  see `Message`
    template <class... Arguments>
    Error(std::string_view code, Format<sizeof...(Arguments)> format, const Arguments&... arguments)
        : Error(Message(code, format, arguments...))
    {
    }

    [[nodiscard]] const std::string& code() const noexcept { return message_.code(); }
    [[nodiscard]] const Message& message() const noexcept { return message_; }

private:
    Message message_;
};

/// The caller's input (an option, a file, a role) cannot be used.
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
    Cancelled();
};

} // namespace lacuna
