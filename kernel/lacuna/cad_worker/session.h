// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/core/error.h>

#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace lacuna::cad_worker {

/// Gmsh for as long as the process works with it: initialised silently, with no start-up files of the user's.
class Gmsh {
public:
    Gmsh();
    ~Gmsh();
    Gmsh(const Gmsh&) = delete;
    Gmsh& operator=(const Gmsh&) = delete;
    [[nodiscard]] static std::string version();
};

/// One piece of work in Gmsh: options set for it, and kept from what a script sets, are as before at its end.
/// @pre  a `Gmsh` lives.
class Session {
public:
    /// @param subject  what messages name: the file, as a rule.
    explicit Session(std::string subject = {});
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Set an option until the session ends; one this version of Gmsh does not have is passed over.
    void set(const std::string& option, double value);
    void set(const std::string& option, const std::string& value);
    /// Have an option as it is now at the end of the session, whatever a script sets meanwhile.
    void keep(const std::string& option);

    /// Do work in Gmsh, its many ways of failing turned into one.
    /// @throw BackendError    Gmsh's own words, after the subject.
    /// @throw std::bad_alloc  the memory limit.
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

    /// Errors Gmsh has logged since the session began, without the word "Error".
    [[nodiscard]] std::vector<std::string> logged_errors() const;
    /// @throw BackendError always: what Gmsh said, after the subject.
    [[noreturn]] void fail(const std::string& message) const;
    /// @throw BackendError always: words of one's own under a code, after the subject.
    [[noreturn]] void refuse(const std::string& code, const std::string& words) const;

private:
    struct SavedNumber {
        std::string name;
        double value;
    };
    struct SavedString {
        std::string name, value;
    };

    std::string subject_;
    std::vector<SavedNumber> numbers_;
    std::vector<SavedString> strings_;
    std::size_t log_start_ = 0;
};

/// A model in Gmsh under a name no one else has; removed with the object.
class GmshModel {
public:
    /// Make it, and make it the current one.
    explicit GmshModel(Session& session);
    ~GmshModel();
    GmshModel(const GmshModel&) = delete;
    GmshModel& operator=(const GmshModel&) = delete;

    /// Make it the current one.
    void activate(Session& session) const;

private:
    std::string name_;
};

/// Lets what is written to std::cout be read instead; Open CASCADE reports its troubles there.
class CapturedOutput {
public:
    CapturedOutput();
    ~CapturedOutput();
    CapturedOutput(const CapturedOutput&) = delete;
    CapturedOutput& operator=(const CapturedOutput&) = delete;
    /// What was written so far, without terminal colours, as one line.
    [[nodiscard]] std::string text() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace lacuna::cad_worker
