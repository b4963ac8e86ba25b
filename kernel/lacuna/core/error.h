// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/message.h>

#include <stdexcept>
#include <string>
#include <string_view>

namespace lacuna {

/// Base class of every error of the kernel. Its message names entities by the user's tags, what was found,
/// what is needed, and one thing to try; `what()` is its text, `code()` is stable, for programs.
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
    Cancelled();
};

} // namespace lacuna
