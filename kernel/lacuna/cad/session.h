// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/core/error.h>

#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna::cad {

class GmshLife;

/// One stay in Gmsh, which is global to the process and not safe for two threads.
///
/// Between construction and destruction this thread has Gmsh to itself, initialised, silent, with LC_NUMERIC
/// "C". At the end the host's current model, options, locale and PYTHONPATH are as they were. Gmsh is
/// finalised only if no host had initialised it, and only when no stay and no `GmshModel` is left. Stays
/// nest.
class Session {
public:
    /// @param subject  what messages name: the file, as a rule.
    explicit Session(std::string subject = {});
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Set an option until the stay ends; one this version of Gmsh does not have is passed over.
    void set(const std::string& option, double value);
    void set(const std::string& option, const std::string& value);
    /// Have an option as it is now at the end of the stay, whatever a script sets meanwhile.
    void keep(const std::string& option);

    /// Do work in Gmsh, its many ways of failing turned into one.
    /// @throw BackendError  Gmsh's own words, after the subject.
    template <class Work>
    auto run(Work&& work)
    {
        try {
            return work();
        } catch (const Error&) {
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

    /// Errors Gmsh has logged since the stay began, without the word "Error".
    [[nodiscard]] std::vector<std::string> logged_errors() const;
    /// @throw BackendError always.
    [[noreturn]] void fail(const std::string& message) const;
    [[nodiscard]] const std::shared_ptr<GmshLife>& life() const { return life_; }

private:
    struct SavedNumber {
        std::string name;
        double value;
    };
    struct SavedString {
        std::string name, value;
    };

    std::unique_lock<std::recursive_mutex> lock_;
    std::string subject_;
    std::string locale_;
    std::shared_ptr<GmshLife> life_;
    std::string host_model_;
    std::vector<SavedNumber> numbers_;
    std::vector<SavedString> strings_;
    std::size_t log_start_ = 0;
    bool own_log_ = false;
};

/// A model of ours in Gmsh, under a name no one else has; removed with the object. It keeps Gmsh alive.
class GmshModel {
public:
    /// Make it, and make it the current one. @pre within the session given.
    explicit GmshModel(Session& session);
    ~GmshModel();
    GmshModel(const GmshModel&) = delete;
    GmshModel& operator=(const GmshModel&) = delete;

    /// Make it the current one for the rest of the stay.
    /// @throw BackendError  the host has finalised Gmsh or removed the model.
    void activate(Session& session) const;

private:
    std::shared_ptr<GmshLife> life_;
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

} // namespace lacuna::cad
