// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad/session.h>

#include <lacuna/cad/detail/gmsh_api.h>
#include <lacuna/cad/load.h>

#include <algorithm>
#include <atomic>
#include <clocale>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <sstream>

namespace lacuna::cad {

namespace {

/// Gmsh is one thing in the process, so what guards it must be too. Never destroyed: a host's own statics may
/// hold exact geometry until the very end.
std::recursive_mutex& gmsh_mutex()
{
    static auto* mutex = new std::recursive_mutex;
    return *mutex;
}

std::weak_ptr<GmshLife>& living()
{
    static auto* life = new std::weak_ptr<GmshLife>;
    return *life;
}

/// Puts PYTHONPATH and LC_NUMERIC back, which gmsh::initialize() sets.
class EnvironmentGuard {
public:
    EnvironmentGuard()
    {
        if (const char* path = std::getenv("PYTHONPATH")) python_path_ = path;
        if (const char* locale = std::setlocale(LC_NUMERIC, nullptr)) locale_ = locale;
    }
    ~EnvironmentGuard()
    {
#ifdef _WIN32
        _putenv_s("PYTHONPATH", python_path_.value_or("").c_str());
#else
        if (python_path_) {
            ::setenv("PYTHONPATH", python_path_->c_str(), 1);
        } else {
            ::unsetenv("PYTHONPATH");
        }
#endif
        std::setlocale(LC_NUMERIC, locale_.c_str());
    }
    EnvironmentGuard(const EnvironmentGuard&) = delete;
    EnvironmentGuard& operator=(const EnvironmentGuard&) = delete;

private:
    std::optional<std::string> python_path_;
    std::string locale_ = "C";
};

bool model_exists(const std::string& name)
{
    std::vector<std::string> names;
    gmsh::model::list(names);
    return std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace

/// Whoever holds it needs Gmsh initialised.
class GmshLife {
public:
    GmshLife() { ensure(); }
    ~GmshLife()
    {
        const std::lock_guard lock(gmsh_mutex());
        if (!ours_ || !gmsh_is_initialized()) return;
        const EnvironmentGuard environment;
        try {
            gmsh::finalize();
        } catch (...) { // Nothing is left to be done, and a destructor must not throw.
        }
    }
    GmshLife(const GmshLife&) = delete;
    GmshLife& operator=(const GmshLife&) = delete;

    /// A host may finalise Gmsh between two stays.
    void ensure()
    {
        if (gmsh_is_initialized()) return;
        const EnvironmentGuard environment;
        // Without arguments, as an unknown word there ends the process; without the user's own start-up
        // files.
        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
        ours_ = true;
    }

private:
    bool ours_ = false;
};

Session::Session(std::string subject) : lock_(gmsh_mutex()), subject_(std::move(subject))
{
    if (const char* locale = std::setlocale(LC_NUMERIC, nullptr)) locale_ = locale;
    run([&] {
        life_ = living().lock();
        if (!life_) {
            life_ = std::make_shared<GmshLife>();
            living() = life_;
        }
        life_->ensure();
        if (locale_ != "C") std::setlocale(LC_NUMERIC, "C");
        gmsh::model::getCurrent(host_model_);
        set("General.Terminal", 0);
        set("General.Verbosity", 2);    // warnings and errors
        set("General.AbortOnError", 2); // throw
        // When the host has a logger running, that says so in its own log, and we read on from there.
        gmsh::logger::start();
        std::vector<std::string> log;
        gmsh::logger::get(log);
        own_log_ = log.empty();
        log_start_ = log.size();
    });
}

Session::~Session()
{
    try {
        if (own_log_) gmsh::logger::stop();
        for (auto saved = numbers_.rbegin(); saved != numbers_.rend(); ++saved) {
            gmsh::option::setNumber(saved->name, saved->value);
        }
        for (auto saved = strings_.rbegin(); saved != strings_.rend(); ++saved) {
            gmsh::option::setString(saved->name, saved->value);
        }
        if (model_exists(host_model_)) gmsh::model::setCurrent(host_model_);
    } catch (...) { // A host that finalised Gmsh meanwhile has nothing left to restore.
    }
    life_.reset(); // may finalise, so before the lock goes
    if (locale_ != "C") std::setlocale(LC_NUMERIC, locale_.c_str());
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
    throw BackendError("cad.gmsh",
                       (subject_.empty() ? "" : subject_ + ": ") + std::string("Gmsh failed: ") + words);
}

GmshModel::GmshModel(Session& session) : life_(session.life())
{
    static std::atomic<unsigned> counter{0};
    session.run([&] {
        do {
            name_ = "lacuna:" + std::to_string(++counter);
        } while (model_exists(name_));
        gmsh::model::add(name_);
    });
}

GmshModel::~GmshModel()
{
    const std::lock_guard lock(gmsh_mutex());
    try {
        if (!gmsh_is_initialized() || !model_exists(name_)) return;
        std::string current;
        gmsh::model::getCurrent(current);
        gmsh::model::setCurrent(name_);
        gmsh::model::remove();
        if (current != name_ && model_exists(current)) gmsh::model::setCurrent(current);
    } catch (...) { // As above: the model is gone with Gmsh.
    }
}

void GmshModel::activate(Session& session) const
{
    session.run([&] {
        if (!model_exists(name_)) {
            throw BackendError("cad.model_gone", "the CAD model has been removed from Gmsh by the program "
                                                 "that hosts Lacuna; load the file again");
        }
        gmsh::model::setCurrent(name_);
    });
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

std::string gmsh_version()
{
    Session session;
    std::string version;
    session.run([&] { gmsh::option::getString("General.Version", version); });
    return version;
}

} // namespace lacuna::cad
