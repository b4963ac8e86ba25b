// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/core/error.h>

#include <functional>
#include <new>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace lacuna::cad_worker {

/// Initialises Gmsh silently, without the start-up files of the user, and finalises it.
class Gmsh {
public:
    Gmsh();
    ~Gmsh();
    Gmsh(const Gmsh&) = delete;
    Gmsh& operator=(const Gmsh&) = delete;
    [[nodiscard]] static std::string version();
};

/// A scope for calls of Gmsh. At its end, two kinds of options are restored: those that the session has set,
/// and those on which later calls depend and which a script may have set.
/// @pre  a `Gmsh` object exists.
class Session {
public:
    /// @param subject  prefix of messages, usually the file.
    explicit Session(std::string subject = {});
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Set an option until the session ends. Options that this version of Gmsh does not have are ignored.
    void set(const std::string& option, double value);
    void set(const std::string& option, const std::string& value);
    /// Set Gmsh's options so that it makes elements of order 1, sized by the given boundary mesh alone.
    void set_sizes_from_boundary();

    /// Run calls of Gmsh and translate their different kinds of failure.
    /// @throw BackendError    with the subject and the message of Gmsh.
    /// @throw std::bad_alloc  the memory limit was reached.
    template <class Work>
    auto run(Work&& work)
    {
        try {
            return work();
        } catch (const Error&) {
            throw;
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::string& message) {
            fail(message);
        } catch (const char* message) {
            fail(message);
        } catch (const std::exception& error) {
            fail(error.what());
        } catch (int) {
            fail({});
        }
    }

    /// @throw BackendError  always; its text is the subject and the message of Gmsh.
    [[noreturn]] void fail(const std::string& message) const;
    /// @throw BackendError  always; its text is the subject and the message.
    [[noreturn]] void refuse(const Message& message) const;

private:
    template <class Value>
    void save(const std::string& option, const std::optional<Value>& next);

    std::string subject_;
    std::string last_error_;                      ///< Gmsh's last error before the session
    std::vector<std::function<void()>> restores_; ///< restore the changed options
};

/// A Gmsh model with a unique name; removed by the destructor.
class GmshModel {
public:
    /// Create the model and make it the current one.
    explicit GmshModel(Session& session);
    ~GmshModel();
    GmshModel(const GmshModel&) = delete;
    GmshModel& operator=(const GmshModel&) = delete;

    /// Make this model the current one.
    void activate(Session& session) const;

private:
    std::string name_;
};

/// Captures std::cout, where Open CASCADE reports its errors.
class CapturedOutput {
public:
    CapturedOutput();
    ~CapturedOutput();
    CapturedOutput(const CapturedOutput&) = delete;
    CapturedOutput& operator=(const CapturedOutput&) = delete;
    /// The output so far as one line, without terminal colours.
    [[nodiscard]] std::string text() const;

private:
    std::ostringstream text_;
    std::streambuf* before_;
};

} // namespace lacuna::cad_worker
