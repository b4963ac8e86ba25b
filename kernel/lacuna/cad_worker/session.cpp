// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad_worker/session.h>

#include <lacuna/cad_worker/detail/gmsh_api.h>

#include <algorithm>
#include <clocale>
#include <iostream>
#include <sstream>
#include <string_view>

namespace lacuna::cad_worker {

namespace {

bool model_exists(const std::string& name)
{
    std::vector<std::string> names;
    gmsh::model::list(names);
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Number of open sessions: the session of a solid stays open while others open and
/// close. Gmsh allows one logger only.
int sessions = 0;

} // namespace

Gmsh::Gmsh()
{
    // No arguments, as Gmsh exits on unknown ones; no start-up files of the user.
    gmsh::initialize(0, nullptr, false);
    std::setlocale(LC_ALL, "C");
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.Verbosity", 2);    // warnings and errors
    gmsh::option::setNumber("General.AbortOnError", 2); // throw
}

Gmsh::~Gmsh()
{
    try {
        gmsh::finalize();
    } catch (...) { // Nothing can be done here, and a destructor must not throw.
    }
}

std::string Gmsh::version()
{
    std::string version;
    gmsh::option::getString("General.Version", version);
    return version;
}

Session::Session(std::string subject) : subject_(std::move(subject))
{
    run([&] {
        keep("General.Terminal");
        keep("General.Verbosity");
        keep("General.AbortOnError");
        if (sessions++ == 0) gmsh::logger::start();
        std::vector<std::string> log;
        gmsh::logger::get(log);
        log_start_ = log.size();
    });
}

Session::~Session()
{
    try {
        if (--sessions == 0) gmsh::logger::stop();
        for (auto saved = numbers_.rbegin(); saved != numbers_.rend(); ++saved)
            gmsh::option::setNumber(saved->name, saved->value);
        for (auto saved = strings_.rbegin(); saved != strings_.rend(); ++saved)
            gmsh::option::setString(saved->name, saved->value);
    } catch (...) { // A destructor must not throw.
    }
}

void Session::set(const std::string& option, double value)
{
    SavedNumber saved{option, 0};
    try {
        gmsh::option::getNumber(option, saved.value);
    } catch (...) {
        return;
    }
    if (saved.value == value) return;
    gmsh::option::setNumber(option, value);
    numbers_.push_back(std::move(saved));
}

void Session::set(const std::string& option, const std::string& value)
{
    SavedString saved{option, {}};
    try {
        gmsh::option::getString(option, saved.value);
    } catch (...) {
        return;
    }
    if (saved.value == value) return;
    gmsh::option::setString(option, value);
    strings_.push_back(std::move(saved));
}

void Session::keep(const std::string& option)
{
    SavedNumber saved{option, 0};
    try {
        gmsh::option::getNumber(option, saved.value);
    } catch (...) {
        return;
    }
    numbers_.push_back(std::move(saved));
}

std::vector<std::string> Session::logged_errors() const
{
    std::vector<std::string> log;
    try {
        gmsh::logger::get(log);
    } catch (...) {
        return {};
    }
    std::vector<std::string> errors;
    constexpr std::string_view kPrefix = "Error: ";
    for (std::size_t i = log_start_; i < log.size(); ++i) {
        if (log[i].starts_with(kPrefix)) errors.push_back(log[i].substr(kPrefix.size()));
    }
    return errors;
}

void Session::fail(const std::string& message) const
{
    std::string words = message;
    if (words.empty()) {
        const std::vector<std::string> errors = logged_errors();
        words = errors.empty() ? "it gave no reason" : errors.back();
    }
    if (words.starts_with("Out of memory")) throw std::bad_alloc(); // Gmsh's allocator reports this as text
    refuse("cad.gmsh", "Gmsh failed: " + words);
}

void Session::refuse(const std::string& code, const std::string& words) const
{
    throw BackendError(code, (subject_.empty() ? "" : subject_ + ": ") + words);
}

GmshModel::GmshModel(Session& session)
{
    static unsigned counter = 0;
    session.run([&] {
        do {
            name_ = "lacuna:" + std::to_string(++counter);
        } while (model_exists(name_));
        gmsh::model::add(name_);
    });
}

GmshModel::~GmshModel()
{
    try {
        if (!model_exists(name_)) return;
        gmsh::model::setCurrent(name_);
        gmsh::model::remove();
    } catch (...) { // A destructor must not throw.
    }
}

void GmshModel::activate(Session& session) const
{
    session.run([&] { gmsh::model::setCurrent(name_); });
}

struct CapturedOutput::Impl {
    std::ostringstream text;
    std::streambuf* before = nullptr;
};

CapturedOutput::CapturedOutput() : impl_(std::make_unique<Impl>())
{
    impl_->before = std::cout.rdbuf(impl_->text.rdbuf());
}

CapturedOutput::~CapturedOutput() { std::cout.rdbuf(impl_->before); }

std::string CapturedOutput::text() const
{
    std::string plain;
    const std::string raw = impl_->text.str();
    for (std::size_t i = 0; i < raw.size(); ++i) {
        if (raw[i] == '\x1b') {
            while (i < raw.size() && raw[i] != 'm') ++i;
        } else if (raw[i] == '\n' || raw[i] == '*') {
            if (!plain.empty() && plain.back() != ' ') plain += ' ';
        } else {
            plain += raw[i];
        }
    }
    while (!plain.empty() && plain.back() == ' ') plain.pop_back();
    return plain;
}

} // namespace lacuna::cad_worker
